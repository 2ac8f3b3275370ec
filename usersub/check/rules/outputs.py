# SPDX-License-Identifier: MIT
"""Outputs are set at every point, on every branch, and not read before."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.watching import watch
from usersub.check.respond import run_of
from usersub.check.rule import Finding, rule
from usersub.check.subject import Subject
from usersub.errors import Error
from usersub.routine.routine import UNUSED

#: Adding zero leaves the mark too, so that it is not said that nothing was written.
_LEFT = re.compile(r"did not write (\S+)")
_SET = "set it on every path through the routine, whatever it holds on entry"

_WRITTEN = "arguments that the manual page says have to be defined"


@rule(
    "outputs.written",
    "Every output is set at every point, on every branch.",
    reference=_WRITTEN,
    cases=cases.everything,
)
def written(subject: Subject, case: Case) -> Finding | None:
    """Outputs hold a mark before the call."""
    found = watch(subject, case, ("not written",), enforced=False)
    if found is not None:
        finding = found.finding(_SET)
        return replace(finding, detail=_LEFT.sub(r"left \1 as it was on entry", finding.detail))
    if subject.interface.name in ("vfric", "vfriction"):
        return _force_left(subject, case)
    return _tangent_left(subject, case) if subject.interface.name == "fric" else None


@rule(
    "outputs.read",
    "Outputs are not read before they are set.",
    reference="what they hold before the call is not defined",
    cases=cases.everything,
)
def read(subject: Subject, case: Case) -> Finding | None:
    """Outputs hold different marks before two calls."""
    found = watch(subject, case, ("output read",), enforced=False)
    return found.finding("set the output before it is used") if found else None


def _tangent_left(subject: Subject, case: Case) -> Finding | None:
    """A tangent that the routine does not even mention, where another fault is seen first."""
    assert subject.routine is not None
    uses, face = subject.routine.uses, subject.interface
    names = ("DDTDDG", "DDTDDP")
    left = [n for n in names if uses is not None and uses[face.position(n)] == UNUSED]
    if not left or subject.routine.language == "python":  # which names what it wants
        return None
    for step, answer in enumerate(subject.respond(case)):
        if answer.lm is None:
            return None
        points = np.flatnonzero(answer.lm == 0)
        if points.size:
            return Finding(
                f"{left[0]} is never written, although LM = 0 in increment {step + 1}",
                hint="set it on every path through the routine",
                figures={"step": step, "point": int(points[0])},
            )
    return None


def _force_left(subject: Subject, case: Case) -> Finding | None:
    """A force that is left at the host's zero at a point that slides under load, while points
    like it get friction: a branch that forgot it."""
    subject.under_way(case)
    run = run_of(subject, case, checked=1)
    got_friction, left = False, None
    for index, step in enumerate(case.steps):
        try:
            answer = run.step(index)
        except Error:
            return None
        seen = run.observed()
        assert answer.friction is not None
        size = np.linalg.norm(answer.friction, axis=0)
        moved = np.linalg.norm(np.array(step.motion), axis=1) > 0.5 * subject.scales.slip
        loaded = np.array(step.load) > 0.0
        got_friction = got_friction or bool((size[moved & loaded] > 0.0).any())
        bare = np.flatnonzero(moved & loaded & (size == 0.0))
        if left is None and "fTangential" in seen.unwritten and bare.size:
            left = index, int(bare[0])
    if left is None or not got_friction:
        return None
    index, point = left
    load = case.steps[index].load[point]
    return Finding(
        f"fTangential of point {point + 1} is not set in increment {index + 1}, where it slides "
        f"under the normal force {load:g}; it keeps the zero of the host, so there is no friction",
        hint="set it on every path through the routine",
        figures={"step": index, "point": point},
    )
