# SPDX-License-Identifier: MIT
"""Local axes of contact points, and how the points move, as far as the host tells."""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import dataclass, field

import numpy as np

from usersub.check.hosts.clock import clock
from usersub.check.hosts.evidence import Evidence, Followed
from usersub.check.hosts.log import Call

#: Relative difference up to which a slip is made of a motion.
_SAME_SIZE = {False: 1e-6, True: 1e-3}


@dataclass(frozen=True)
class Step:
    """A contact point in an increment: position in the call (from 0), local axes, slip."""

    call: Call
    index: int
    t1: np.ndarray
    n: np.ndarray
    slip: float


@dataclass
class Path:
    """A contact point over increments without a gap, and its motion in each against the main
    surface; None where it is not known."""

    points: list[Step] = field(default_factory=list)
    motions: list[np.ndarray | None] = field(default_factory=list)

    def steps(self, lag: int = 0) -> Iterator[tuple[Step, np.ndarray]]:
        """Increments with the motion of the one `lag` later."""
        for point, moved in zip(self.points, self.motions[lag:], strict=False):
            if moved is not None and point.slip > 0:
                yield point, moved

    def lag(self) -> int | None:
        """How much later the host tells the motion that a slip is made of: 0 or 1 increments;
        None if sizes do not tell, or only one of them fits by accident."""
        fits = [lag for lag in (0, 1) if self._fits(lag)]
        return fits[0] if len(fits) == 1 else None

    def _fits(self, lag: int) -> bool:
        count = 0
        for now, moved in self.steps(lag):
            size = float(np.linalg.norm(moved - now.n * (moved @ now.n)))
            if abs(size - now.slip) > _SAME_SIZE[now.call.single] * now.slip:
                return False
            count += 1
        return count > 2


def directions(call: Call) -> tuple[np.ndarray, np.ndarray] | None:
    """Direction 1 and normal in columns, in double precision."""
    t1, n = call.array("dirCosSl"), call.array("dircosN")
    if t1 is None or n is None or t1.shape != n.shape:
        return None
    return t1.astype(float), n.astype(float)


def second(t1: np.ndarray, n: np.ndarray) -> np.ndarray:
    """Direction 2 in columns: n x t1 in three dimensions, else nothing."""
    if t1.shape[0] != 3:
        return np.zeros_like(t1)
    return np.cross(n, t1, axis=0)


def keys_of(nodes: np.ndarray) -> list[Hashable]:
    """What tells the contact points of a call apart: the secondary nodes of each."""
    columns = nodes.reshape(1, -1) if nodes.ndim == 1 else nodes
    return [tuple(column) for column in columns.T.tolist()]


def paths(evidence: Evidence) -> Iterator[Path]:
    """The contact points whose motion the host tells."""
    for analysis in evidence.analyses:
        open_paths: dict[Hashable, Path] = {}
        last: dict[Hashable, tuple] = {}
        followed = Followed()
        for attempt in analysis.attempts:
            going_on: dict[Hashable, Path] = {}
            twice: set[Hashable] = set()
            for call in attempt.calls:
                for key, point, moved in _points(call, last, followed):
                    if key in going_on:
                        twice.add(key)  # a node with several points: nothing tells them apart
                        continue
                    path = open_paths.pop(key, None) or Path()
                    path.points.append(point)
                    path.motions.append(moved)
                    going_on[key] = path
            for key in twice:
                going_on.pop(key)
            yield from open_paths.values()
            open_paths = going_on
        yield from open_paths.values()


def _points(
    call: Call, last: dict[Hashable, tuple], followed: Followed
) -> Iterator[tuple[Hashable, Step, np.ndarray | None]]:
    found, slips, when = directions(call), call.array("dSlipFric"), clock(call)
    nodes = call.array("jConSecid" if call.face.name == "vfric" else "jConSecUid")
    if found is None or slips is None or when is None or nodes is None:
        return
    t1, n = found
    moved = _displacement(call, last)
    velocity = _velocity(call)
    if velocity is not None:
        moved = velocity * when.time_increment
    keys = keys_of(nodes)
    for k in followed.among(keys):
        key = keys[k]
        point = Step(call, k, t1[:, k], n[:, k], float(slips[0, k]))
        yield key, point, None if moved is None else moved[:, k]


def _velocity(call: Call) -> np.ndarray | None:
    """VFRICTION: velocity of the secondary against the main surface in columns, where the host
    gives velocities and shape functions."""
    if call.face.name != "vfriction":
        return None
    secondary, main = call.array("velSec"), call.array("velMain")
    weights, others = call.array("shapeSec"), call.array("shapeMain")
    if secondary is None or main is None or weights is None or others is None:
        return None
    if not np.any(secondary) and not np.any(main):
        return None
    points = secondary.shape[2]
    if secondary.shape[1] == 1:
        weights = np.ones((1, 1))
    made = np.einsum("dbk,bk->dk", secondary, _for_points(weights, points))
    return made - np.einsum("dmk,mk->dk", _for_points(main, points), _for_points(others, points))


def _for_points(values: np.ndarray, points: int) -> np.ndarray:
    """One value that serves all points, for each of them."""
    values = values.astype(float)
    if values.shape[-1] == points:
        return values
    return np.repeat(values[..., :1], points, axis=-1)


def _displacement(call: Call, last: dict[Hashable, tuple]) -> np.ndarray | None:
    """VFRIC: how far the secondary nodes went since the call before, where the main surface stood
    still."""
    if call.face.name != "vfric":
        return None
    secondary, main = call.array("coordSec"), call.array("coordMain")
    node, when = call.array("jConSecid"), clock(call)
    if secondary is None or node is None or when is None or not np.any(secondary):
        return None
    before = last.get(call.names)
    last[call.names] = secondary, main, when
    if before is None or before[2].increment + 1 != when.increment:
        return None
    still = main is None or before[1] is None or np.array_equal(main, before[1])
    if not still or before[0].shape != secondary.shape:
        return None
    moved = secondary.astype(float) - before[0].astype(float)
    if not np.any(moved) or not node.size or node.min() < 1 or node.max() > secondary.shape[1]:
        return None
    return moved[:, node - 1]
