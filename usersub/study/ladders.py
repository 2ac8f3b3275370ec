# SPDX-License-Identifier: MIT
"""What refines each problem, and what else is varied in it: data of `grid`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usersub.problems import Problem
    from usersub.study.result import Plain

#: Time increment of the coarsest finite-element run over the largest stable one.
SHARE = 0.9


@dataclass(frozen=True)
class Ladder:
    """What makes a run finer.

    Attributes:
        option: option of the problem.
        levels: values of `Point.step`, coarse to fine.
    """

    option: str
    levels: tuple[int, ...]

    def value(self, level: int) -> Plain:
        """The option's value: the level itself, but for finite elements a share of the step."""
        return SHARE / level if self.option == "step_share" else level

    def quick(self) -> Ladder:
        """The coarsest and two from the middle."""
        middle = len(self.levels) // 2
        return Ladder(
            self.option, tuple(sorted({*self.levels[:1], *self.levels[middle - 1 :][:2]}))
        )


_HALVED = Ladder("step_share", (1, 2, 4))
_EVENTS = Ladder("steps", (128, 512))
_SMOOTH = Ladder("steps", (8, 16, 32, 64, 128, 256))

#: By problem and by the beginning of the method; the first that fits counts.
_STEPS: dict[str, tuple[tuple[str, Ladder | None], ...]] = {
    **dict.fromkeys(
        ("P1", "P2"),
        (("C", _HALVED), ("implicit Romberg", Ladder("steps", (8, 16, 32, 64))),
         ("implicit", Ladder("steps", (8, 16, 32, 64, 128))),
         ("", _SMOOTH)),
    ),
    "P3": (("", Ladder("steps", (1, 4, 16, 64))),),
    # From event to event the steps change nothing but rounding.
    "P5": (("kinematic events", _EVENTS), ("penalty events", _EVENTS), ("lagrange", _EVENTS),
           ("kinematic", Ladder("steps", (375, 750, 1500, 3000, 6000))),
           ("penalty", Ladder("steps", (2250, 4500, 9000, 18000)))),
    "P6": (("kinematic events", _EVENTS), ("penalty events", _EVENTS), ("lagrange", _EVENTS),
           ("kinematic", Ladder("steps", (500, 1000, 2000, 4000, 8000))),
           ("penalty", Ladder("steps", (2000, 4000, 8000, 16000)))),
    "P7": (("kinematic events", _EVENTS), ("penalty events", _EVENTS), ("lagrange", _EVENTS),
           ("kinematic", Ladder("steps", (750, 1500, 3000, 6000, 12000))),
           ("penalty", Ladder("steps", (1500, 3000, 6000, 12000)))),
    "P8": (("kinematic events", _EVENTS), ("penalty events", _EVENTS), ("lagrange", _EVENTS),
           ("kinematic", Ladder("steps", (3500, 7000, 14000, 28000))),
           ("penalty", Ladder("steps", (3500, 7000, 14000, 28000)))),
    "P9": (("limit", None), ("", Ladder("steps", (5, 10, 20, 40)))),
    # The counts of P10 leave the same rest divided by three.
    "P10": (("", Ladder("points", (16, 31, 61, 121))),),
    "P11": (("", Ladder("points", (16, 32, 64, 128))),),
    "P12": (("", Ladder("points", (16, 32, 64, 128))),),
    "P13": (("start", Ladder("steps", (4, 8, 16, 32, 64, 128, 256))), ("", None)),
    "P15": (("", _SMOOTH),),
    "P17": (("", Ladder("steps", (8, 16, 32, 64))),),
    "P19": (("", _SMOOTH),),
    "P20": (("rigid", None), ("", Ladder("steps", (50, 100, 200, 400, 800)))),
    "P22": (("modes", None), ("", Ladder("steps", (200, 400, 800, 1600, 3200)))),
    "P23": (("", Ladder("steps", (250, 500, 1000, 2000, 4000))),),
    "P24": (("", Ladder("steps", (60, 240, 960))),),
}  # fmt: skip

_TABLE = Ladder("table_points", (21, 41, 81, 161, 321))
_OTHERS = Ladder("steps", (50, 100, 200, 400))

#: Contact points a call, where their number changes nothing but the time.
_BLOCKS: dict[str, tuple[int, ...]] = {
    **dict.fromkeys(("P1", "P2", "P3", "P4"), (1, 16, 256, 4096)),
    **dict.fromkeys(("P9",), (1, 16, 64)),
}
_OTHER_BLOCKS = (1, 16, 256)

#: Contact points where a problem's own number is not the same for all of its hosts: run times are
#: compared for the same work.
POINTS = {"P1": 64, "P2": 64}

#: Enforcement besides the problem's own: elastic slips of implicit penalty, by problem; stiffnesses
#: of explicit penalty. Where sticking matters, but the events do not change.
_SLIPS = {
    "P5": (1e-5, 1e-7),
    "P6": (1e-3, 1e-6),
    "P8": (1e-5, 1e-7),
    "P10": (1e-4, 1e-6),
    "P11": (1e-4, 1e-6),
    "P19": (1e-3, 1e-6),
}
_STIFFNESSES = {"P5": (0.0625, 0.25, 4.0), "P6": (0.0625, 0.25, 4.0), "P7": (0.25, 4.0)}


def ladder(problem: Problem, law: str, method: str) -> Ladder | None:
    """What refines a problem by a method; None if nothing does."""
    if law == "coulomb_tabulated" and "table_points" in problem.options:
        return _TABLE
    if (problem.name, law) == ("P13", "elasto_plastic"):
        return None
    for begin, found in _STEPS.get(problem.name, ()):
        if method.startswith(begin):
            return found if found is None or found.option in problem.options else None
    return _OTHERS if "steps" in problem.options else None


#: What `Point.step` counts, by the option that it is.
_COUNTS = {
    "steps": "increments",
    "points": "contact points",
    "table_points": "slip rates of the table",
    "step_share": "times finer than the largest stable increment",
}


def refined(problem: str, law: str, method: str) -> str:
    """What `Point.step` counts, in words; "" where nothing refines."""
    from usersub.problems import PROBLEMS

    if problem not in PROBLEMS:
        return _COUNTS["steps"]
    found = ladder(PROBLEMS[problem], law, method)
    return _COUNTS[found.option] if found else ""


def blocks(problem: Problem, law: str, method: str) -> tuple[int, ...]:
    """Contact points a call that are tried; none where their number refines the answer."""
    refined = ladder(problem, law, method)
    if "points" not in problem.options or (refined and refined.option in ("points", "step_share")):
        return ()
    return _BLOCKS.get(problem.name, _OTHER_BLOCKS)


def variants(problem: Problem, law: str, method: str) -> list[dict[str, Plain]]:
    """Options of enforcement and state update that are tried, the problem's own first."""
    found: list[dict[str, Plain]] = [{}]
    explicit = method == "penalty" and "stiffness" in problem.options
    if explicit:
        found += [{"stiffness": share} for share in _STIFFNESSES.get(problem.name, ())]
    elif "elastic_slip" in problem.options and "lagrange" not in method and _is_penalty(method):
        found += [{"elastic_slip": slip} for slip in _SLIPS.get(problem.name, ())]
    if law in problem.updates and method in problem.updates[law]:
        found += [{"update": name} for name in problem.updates[law][method]]
    return found


def _is_penalty(method: str) -> bool:
    return method.startswith(("penalty", "midpoint", "wedge"))
