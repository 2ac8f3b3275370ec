# SPDX-License-Identifier: MIT
"""P14: parallel elements: backbone, Masing's rule, return-point memory."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from usersub.problems.path_host import PRESSURE, Path, outcome
from usersub.problems.problem import Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Coefficient of all elements; their stiffnesses and shares of the strength.
MU = 0.5
STIFFNESS = np.array([4e3, 3e3, 2e3, 1e3, 500.0])
SHARE = np.array([0.1, 0.15, 0.25, 0.3, 0.2])

#: Turning points of the path: a loop, loops in it, and the way on along the first.
TURNS = (3e-3, -2e-3, 1e-3, -1e-3, 0.5e-3, -1.5e-3, 4e-3)

#: Increments between two turning points; of one, and of many.
_INCREMENTS = (1, 16)

_RATE = 0.01
_TOLERANCES = {"double": 1e-14, "single": 2e-6}


def backbone(motion: float) -> float:
    """Traction from rest, for motions of either sign."""
    limit = MU * PRESSURE * SHARE
    return float(np.sign(motion) * np.minimum(STIFFNESS * abs(motion), limit).sum())


def path_traction(places: list[float]) -> list[float]:
    """Traction at each of `places`, by Masing's rule and the memory of turning points.

    No element is looked at: each branch is the backbone twice as large, begun at its last turning
    point; where it meets the turning point before, the loop closes and the branch before goes on.
    """
    found, turns, here, way = [], [(0.0, 0.0)], 0.0, 0.0
    for place in places:
        if place != here:
            now = np.sign(place - here)
            if way and now != way:
                turns.append((here, found[-1]))
            way = now
            # A loop closes where the branch passes the turning point before the last.
            while len(turns) > 2 and way * (place - turns[-2][0]) >= 0.0:
                del turns[-2:]
            if len(turns) == 2 and way * place >= abs(turns[1][0]):
                del turns[1:]
        start, traction = turns[-1]
        if len(turns) == 1:
            found.append(backbone(place))
        else:
            found.append(traction + 2.0 * backbone(0.5 * (place - start)))
        here = place
    return found


def _places(increments: int) -> list[float]:
    found: list[float] = []
    before = 0.0
    for turn in TURNS:
        found += [before + (turn - before) * (i + 1) / increments for i in range(increments)]
        found[-1], before = turn, turn
    return found


def _props(law: str) -> list[float]:
    elements = [len(STIFFNESS), *STIFFNESS, *SHARE]
    if law == "iwan":
        return [MU, *elements]
    # No Stribeck curve: then elements that slip stand at their limit, whatever attracts them.
    return [MU, MU, 1.0, 2.0, 1e3, 0.0, *elements]


def run(routine: Routine, law: str, precision: str, method: str, *, points: int = 8) -> Outcome:
    """One run against the rules, relative to full slip."""
    errors, full = {}, MU * PRESSURE * float(SHARE.sum())
    for increments in _INCREMENTS:
        path = Path(routine, law, _props(law), points, precision)
        places = _places(increments)
        exact, before, worst = path_traction(places), 0.0, 0.0
        for place, traction in zip(places, exact, strict=True):
            found = path.move(place - before, max(abs(place - before), 1e-9) / _RATE)
            before = place
            worst = np.maximum(worst, np.abs(found - traction).max() / full)
        errors[f"{increments} increments"] = float(worst)
    return outcome(
        "P14", routine, law, precision, method, path, errors, _TOLERANCES[precision], 0.6,
        "traction",
    )  # fmt: skip


PROBLEM = Problem(
    name="P14",
    title="Parallel elements of spring and slider: backbone, loops in loops",
    statement="Contact points go forth and back between turning points that lie inside one "
    "another. The backbone is piecewise linear; every branch is the backbone twice as large "
    "(Masing); a loop that closes leaves no trace (return-point memory). Exact for any increments.",
    laws=("iwan", "maxwell_slip"),
    methods=dict.fromkeys(("fric", "vfric", "vfriction"), ("loops in loops",)),
    runner=run,
    options={"points": "contact points"},
)
