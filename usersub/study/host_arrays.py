# SPDX-License-Identifier: MIT
"""Arrays of an imagined host, for runs that only cost time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from usersub.driver.base import Driver
    from usersub.driver.scene import Scene

#: Of enforcement by the driver, which these scenes leave to the host.
_UNBOUND = ("mass", "predicted_velocity", "previous_force", "closed", "multiplier")
_RANGES = {
    "slip_increment": (1e-4, 1e-3),
    "normal": (-0.2, 0.2),
    "contact_stiffness": (1e3, 2e3),
    "shape_main": (0.2, 0.3),
    "shape_secondary": (0.4, 0.6),
}


def host_arrays(driver: Driver) -> dict[str, np.ndarray]:
    """Arrays of a host for everything that the driver's scene has: points that slide, all closed.

    Node numbers are those of a regular mesh, so that neighbours lie together in memory.
    """
    numbers = np.random.default_rng(5)
    layout, scene, found = driver.layout, driver.scene, {}
    for name, port in layout.ports.items():
        shape = layout.shapes[name]
        if port.role != "in" or 0 in shape or name in _UNBOUND:
            continue
        if driver.keeps(name) and name not in driver._bound:
            continue  # the driver's own: it enforces sticking
        if port.kind == "int":
            values = _integers(name, shape, scene)
        else:
            low, high = _RANGES.get(name, (0.5, 1.5))
            values = numbers.uniform(low, high, shape)
        found[name] = np.asfortranarray(values.astype(layout.dtypes[name]))
    if "normal" in found:
        _lay_in_plane(found["slip_increment"], found["normal"])
    if "rotation" in found:
        found["rotation"][...] = np.eye(2)[:, :, None]
    return found


def _integers(name: str, shape: tuple[int, ...], scene: Scene) -> np.ndarray:
    """Numbers of nodes and elements."""
    side = {"secondary": "secondary_nodes", "main": "main_nodes"}.get(name.partition("_")[0], "")
    nodes = scene["nodes"] or (scene[side] if side else 0) or scene["points"]
    points = np.arange(shape[-1])
    steps = np.arange(shape[0])[:, None] if len(shape) > 1 else 0
    return np.asarray(points + steps) % nodes + 1


def _lay_in_plane(slip: np.ndarray, normal: np.ndarray) -> None:
    """Makes the normals unit vectors and takes the normal part out of the slip."""
    normal[-1] = 1.0
    normal /= np.sqrt((normal**2).sum(axis=0))
    slip -= normal * (slip * normal).sum(axis=0)
