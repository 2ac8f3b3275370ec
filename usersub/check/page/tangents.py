# SPDX-License-Identifier: MIT
"""The error of a routine's derivatives entry by entry, as numbers for a figure.

Every entry is compared with differences of the routine's own response: forward, backward and
central ones of several steps, of which the closest counts. So an entry on the border of stick and
slip is right if it is the derivative on one of its sides.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from usersub.check.case import Case, Step
from usersub.check.page.figures import Data, Refused, alike
from usersub.check.page.names import load_name

if TYPE_CHECKING:
    from usersub.check.respond import Answer
    from usersub.check.subject import Subject

_MOTIONS = 21
_LOADS = 9
_ANGLE = 0.5  # of the motion to the first direction: all entries are different
_STEPS = {"double": (1e-3, 1e-4, 1e-5, 1e-6), "single": (1e-1, 3e-2, 1e-2, 3e-3)}  # over motion
#: Smallest error shown: below it is what differences can tell.
FLOOR = {"double": 1e-8, "single": 1e-4}


def tangent(subject: Subject) -> Data:
    """Relative error of DDTDDG and DDTDDP (FRIC), over motion and pressure."""
    sizes, loads = _grid(subject)
    motion = sizes * np.array([np.cos(_ANGLE), np.sin(_ANGLE)])[:, None]
    base = _answer(subject, motion, loads)
    if base.tangent is None or base.by_pressure is None:
        raise Refused("The routine gives no tangent.")
    free = base.lm == 0 if base.lm is not None else np.ones(loads.size, dtype=bool)
    if not free.any():
        raise Refused("No point has LM = 0 here, so that no tangent is used.")
    columns = []
    for j in range(3):  # by the motion in both directions, by the pressure
        scale = loads if j == 2 else sizes
        columns.append(_differences(subject, (motion, loads), base, j, scale))
    given = np.concatenate([base.tangent, base.by_pressure[:, None]], axis=1)
    entries = [
        {"name": name, "error": _error(subject, given, columns, i, j, free)}
        for i in range(2)
        for j, name in enumerate((f"DDTDDG({i + 1},1)", f"DDTDDG({i + 1},2)", f"DDTDDP({i + 1})"))
    ]
    return {
        "motions": sizes[: _MOTIONS * _LOADS : _LOADS].tolist(),
        "loads": loads[:_LOADS].tolist(),
        "entries": entries,
        "load_name": load_name(subject),
        "floor": FLOOR[subject.precision],
    }


def _grid(subject: Subject) -> tuple[np.ndarray, np.ndarray]:
    """Motion and pressure of every point: all pairs, the pressure runs fastest."""
    scales = subject.scales
    low = 0.1 * scales.stick if scales.stick > 0 else 1e-3 * scales.slip
    sizes = np.geomspace(low, scales.slip, _MOTIONS)
    loads = scales.load * np.geomspace(0.1, 10.0, _LOADS)
    return np.repeat(sizes, _LOADS), np.tile(loads, _MOTIONS)


def _answer(subject: Subject, motion: np.ndarray, loads: np.ndarray) -> Answer:
    n, dt = loads.size, subject.scales.dt
    pressures = tuple(loads.tolist())
    touch = alike(subject, Step(((0.0, 0.0),) * n, pressures, dt))
    slide = replace(touch, motion=tuple(map(tuple, motion.T.tolist())))
    answers = subject.respond(Case((touch, slide)))
    if answers[-1].failure is not None:
        raise answers[-1].failure
    return answers[-1]


def _differences(
    subject: Subject,
    at: tuple[np.ndarray, np.ndarray],
    base: Answer,
    j: int,
    scale: np.ndarray,
) -> list[np.ndarray]:
    """Quotients of differences by variable j (two motions, pressure), each of shape (2, N)."""
    assert base.friction is not None
    found = []
    for step in _STEPS[subject.precision]:
        sides = []
        for sign in (1.0, -1.0):
            motion, loads = at[0].copy(), at[1].copy()
            (loads if j == 2 else motion[j])[...] += sign * step * scale
            exact = (loads - at[1]) if j == 2 else (motion[j] - at[0][j])
            moved = _answer(subject, motion, loads).friction
            assert moved is not None
            sides.append((moved - base.friction) / exact)
        found += [*sides, 0.5 * (sides[0] + sides[1])]
    return found


def _error(
    subject: Subject,
    given: np.ndarray,
    columns: list[list[np.ndarray]],
    i: int,
    j: int,
    free: np.ndarray,
) -> list[list[float]]:
    """Error of an entry over the largest of its kind at the point, shape (loads, motions)."""
    kind = (0, 1) if j < 2 else (2,)
    top = np.max([np.abs(columns[c][-1]) for c in kind], axis=(0, 1))
    top = np.maximum(top, np.max(np.abs(given[:, list(kind)]), axis=(0, 1)))
    off = np.min([np.abs(given[i, j] - d[i]) for d in columns[j]], axis=0)
    error = np.where(top > 0, off / np.where(top > 0, top, 1.0), 0.0)
    error = np.where(free, np.maximum(error, FLOOR[subject.precision]), np.nan)
    return error.reshape(_MOTIONS, _LOADS).T.tolist()
