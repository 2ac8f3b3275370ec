# SPDX-License-Identifier: MIT
"""A small explicit host: points on planes of different directions, none in the surface's order."""

from __future__ import annotations

import law_cases
import numpy as np
from law_cases import column

import usersub
from usersub import laws

#: Powers of two, so that pressure = force / area is exact.
AREAS = np.array([0.5, 2.0, 1.0, 4.0, 0.25])
#: A stick force beyond every friction force, in single precision too.
NO_STICK = 1e30


class Surface:
    """Planes, areas and node numbers of `points` contact points."""

    def __init__(self, points: int, interface: str, *, analytical: bool = False):
        n = points
        self.general = interface != "vfric"
        self.n, self.analytical = n, analytical
        self.area = np.resize(AREAS, n)
        self.normal, self.along, self.across = (np.zeros((3, n)) for _ in range(3))
        k = np.arange(n)
        sign = np.where(k % 2, -1.0, 1.0)
        self.normal[(2 + k) % 3, k] = 1.0
        self.along[k % 3, k] = sign
        self.across[:] = np.cross(self.normal.T, self.along.T).T
        self.order = np.random.default_rng(7).permutation(n)

    def sizes(self) -> dict[str, object]:
        """Settings of the scene."""
        corners = 1 if self.analytical else 4
        contact = {"contact": "analytical-rigid"} if self.analytical else {}
        if self.general:
            return {"nodes": self.n + corners, **contact}
        return {"secondary_nodes": self.n, "main_nodes": corners, **contact}

    def arrays(self) -> dict[str, np.ndarray]:
        """What does not change with time."""
        node = (self.order + 1).astype(np.int32)
        by_node = np.empty(self.n)
        by_node[self.order] = self.area
        found = {
            "normal": self.normal,
            "area": self.area if self.general else by_node,
            "secondary_node": node.reshape(1, self.n, order="F") if self.general else node,
        }
        if self.general:
            corners = (1, 1) if self.analytical else (4, self.n)
            found["main_node"] = np.full(corners, self.n + 1, np.int32, order="F")
        return found

    def means(self, points: list[dict]) -> dict[str, np.ndarray]:
        """Temperatures and fields; only the mean counts: alternately one surface has all of it."""
        odd = np.arange(self.n) % 2
        temperature = column(points, "temperature")
        found = {
            "temperature_secondary": 2.0 * temperature * odd,
            "temperature_main": 2.0 * temperature * (1 - odd),
        }
        if points[0]["fields"]:
            fields = column(points, "fields")
            found |= {
                "field_secondary": 2.0 * fields * (1 - odd),
                "field_main": 2.0 * fields * odd,
            }
        return found

    def states(self, driver) -> np.ndarray:
        """A copy of the states by contact point, shape (S, N)."""
        kept = driver.state["state"]
        return kept[:, self.order].copy() if not self.general else kept[:, 0].copy()

    def set_states(self, driver, values: np.ndarray) -> None:
        """Sets the states of all contact points, shape (S, N)."""
        kept = driver.state["state"]
        if self.general:
            kept[...] = values[:, np.newaxis]
        else:
            kept[:, self.order] = values


def driver_of(
    law: str, interface: str, precision: str, language: str, case: dict, points: list, **more: int
):
    """The explicit driver of a law for points of a case, and its surface; `more` settings."""
    surface = Surface(len(points), interface)
    settings = law_cases.scene_of(law, case, interface, points, **surface.sizes(), **more)
    routine = laws.routine(law, interface, language, precision=precision)
    driver = usersub.ExplicitDriver(routine, usersub.Scene(**settings, precision=precision))
    return driver, surface


def step(driver, surface: Surface, dt: float, points: list, slip: np.ndarray, stick: object):
    """One increment: friction forces against `slip` (3, N), shape (3, N)."""
    real = law_cases.REAL[driver.scene.precision]
    arrays = {
        **surface.arrays(),
        **surface.means(points),
        "slip_increment": slip,
        "normal_force": column(points, "pressure") * surface.area,
        "stick_force": np.broadcast_to(stick, surface.n).astype(float),
    }
    arrays = {
        k: np.asfortranarray(a if a.dtype == np.int32 else a.astype(real))
        for k, a in arrays.items()
        if k in driver.layout.ports
    }
    return driver.step(dt, **arrays).force
