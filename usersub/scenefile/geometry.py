# SPDX-License-Identifier: MIT
"""The small model behind a history for the explicit interfaces: every point slides on one flat
facet of the main surface, whose normal is the last coordinate direction."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from usersub.ports import PORTS

_HALF_EDGE = 0.5


class FlatModel:
    """Surfaces, node numbers, coordinates and shape functions for `points` contact points.

    The slip of the history has the components of the coordinate directions before the last; the
    points begin at the origin. Node numbers count from one: first the secondary nodes, point by
    point, then the corners of the facet.
    """

    def __init__(self, interface: str, settings: dict, reach: float) -> None:
        self.points, self.dimension = settings["points"], settings["dimension"]
        self.size = 2.0 * reach + 1.0
        contact = settings.get("contact", "node-to-facet")
        self.analytical = contact == "analytical-rigid"
        self.edges = 2 if contact == "edge-to-edge" and interface != "vfric" else 1
        self.surfaces = interface == "vfric"
        flat = {1: [[0.0]], 2: [[-1.0], [1.0]]}
        square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
        if self.analytical:
            corners = flat[1]
        elif self.dimension == 2 or self.edges == 2:
            corners = flat[2]
        else:
            corners = square
        self._corners = np.zeros((len(corners), self.dimension))
        self._corners[:, : len(corners[0])] = np.array(corners) * self.size
        self._active = len(corners[0]) if len(corners) > 1 else 0
        if self.surfaces:
            self.secondary_nodes = settings["secondary_nodes"]
            self.main_nodes = settings["main_nodes"]
        else:
            self.nodes = settings["nodes"]

    @property
    def corners(self) -> int:
        """Nodes of the main facet."""
        return len(self._corners)

    def fixed(self, area: np.ndarray) -> dict[str, np.ndarray]:
        """Arrays that do not change, in Fortran order; `area` is that of each point."""
        columns = 1 if self.analytical else self.points
        last = self.points * self.edges
        main = 1 + np.arange(self.corners, dtype=np.int32)
        normal = np.zeros((self.dimension, self.points))
        normal[-1] = 1.0
        out: dict[str, np.ndarray] = {"normal": normal}
        if self.surfaces:
            out["secondary_node"] = np.arange(1, self.points + 1, dtype=np.int32)
            out["main_node"] = np.tile(main[:, None], (1, self.points))
            out["secondary_number"] = np.arange(1, self.secondary_nodes + 1, dtype=np.int32)
            out["main_number"] = self.secondary_nodes + np.arange(
                1, self.main_nodes + 1, dtype=np.int32
            )
            out["area"] = np.ones(self.secondary_nodes)
            out["area"][: self.points] = area
        else:
            secondary = np.arange(1, last + 1, dtype=np.int32)
            out["secondary_node"] = secondary.reshape(self.edges, self.points, order="F")
            out["main_node"] = np.tile(last + main[:, None], (1, columns))
            out["shape_secondary"] = np.full((self.edges, self.points), 1.0 / self.edges)
            out["area"] = np.array(area)
        return {k: np.asfortranarray(v) for k, v in out.items()}

    def moving(self, position: np.ndarray, velocity: np.ndarray) -> dict[str, np.ndarray]:
        """Arrays that follow slip `position` and slip rate `velocity` (`[point, direction]`)."""
        place = np.zeros((self.points, self.dimension))
        place[:, : position.shape[1]] = position
        speed = np.zeros_like(place)
        speed[:, : velocity.shape[1]] = velocity
        out = {"shape_main": self._shape(place)}
        if self.surfaces:
            out["coord_secondary"] = _padded(place, self.secondary_nodes)
            out["coord_main"] = _padded(self._corners, self.main_nodes)
            return out
        offsets = np.zeros((self.edges, self.dimension))
        if self.edges == 2:
            offsets[:, 1] = (-_HALF_EDGE, _HALF_EDGE)  # across the main edge
        nodes = (place[:, None, :] + offsets).reshape(-1, self.dimension)
        speeds = np.repeat(speed, self.edges, axis=0)
        out["coord"] = _padded(np.concatenate([nodes, self._corners]), self.nodes)
        out["velocity"] = _padded(speeds, self.nodes)
        return out

    def _shape(self, place: np.ndarray) -> np.ndarray:
        """Shape functions of the facet's corners at each point: `[corner, point]`."""
        if self._active == 0:
            return np.ones((self.corners, 1 if self.analytical else self.points), order="F")
        local = place[:, : self._active] / self.size
        signs = self._corners[:, : self._active] / self.size
        return np.asfortranarray(np.prod(0.5 * (1.0 + signs[:, None, :] * local), axis=2))

    def per_main(self, values: np.ndarray) -> np.ndarray:
        """Values of the main surface, of which an analytical rigid one has a single column."""
        return values[..., :1] if self.analytical else values


def _padded(rows: np.ndarray, count: int) -> np.ndarray:
    """`rows` (`[node, direction]`) as `[direction, node]` with zeros up to `count` nodes."""
    out = np.zeros((rows.shape[1], count), order="F")
    out[:, : len(rows)] = rows.T
    return out


class Bound:
    """Arrays bound once to a driver and then filled in place; those it has not are left out."""

    def __init__(self, driver, interface: str, precision: str) -> None:
        self._driver = driver
        self._known = {p.name for p in PORTS if interface in p.drivers}
        self._real = np.float32 if precision == "single" else np.float64
        self._arrays: dict[str, np.ndarray] = {}

    def put(self, values: dict[str, np.ndarray]) -> None:
        """Copies values into the bound arrays; binds those that are new."""
        fresh = {}
        for name, value in values.items():
            kept = self._arrays.get(name)
            if name not in self._known:
                continue
            if kept is None:
                kind = np.int32 if value.dtype.kind == "i" else self._real
                fresh[name] = np.array(value, dtype=kind, order="F")
            else:
                kept[...] = value
        self._arrays.update(fresh)
        if fresh:
            self._driver.bind(**fresh)


Progress = Callable[[int, int], None]
