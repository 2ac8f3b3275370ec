# SPDX-License-Identifier: MIT
"""Threads: what a routine keeps is shared by all that call it at the same time."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator

import numpy as np

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.respond import Run, run_of
from usersub.check.respond.answer import Answer
from usersub.check.rule import CannotCheck, Finding, NotApplicable, rule
from usersub.check.rules.repeat import HINT, told
from usersub.check.rules.words import failed, values
from usersub.check.subject import Subject
from usersub.driver.meeting import meet
from usersub.errors import SceneError

#: Seconds of two threads at random, points of each; writes behind which two calls meet.
_SECONDS, _POINTS = 0.05, 1024
_TURNS = 20


@rule(
    "repeat.threads",
    "Two threads at once get the same results as one after the other.",
    reference="hosts call for different contact points at the same time",
    seconds=20.0,
)
def threads(subject: Subject) -> Iterator[Finding]:
    """Two calls meet behind each write to data that outlives a call; then many calls at random."""
    shared: tuple[str, ...] = ()
    if subject.file is not None and subject.file.code is not None:
        build = subject.file.code.build(subject.precision)
        if build.writes_units:
            raise NotApplicable("the routine writes to units, which threads share")
        shared = build.shared
    found = _met(subject) if shared else None
    if found is None:
        found = _at_random(subject)
    if found is not None:
        yield found


def _met(subject: Subject) -> Finding | None:
    """What changes where one thread calls right after another has written to shared data."""
    first, second = _pair(subject)
    last = len(first.steps) - 1

    def ready() -> tuple[Run, Run]:
        runs = run_of(subject, first, enforced=True), run_of(subject, second, enforced=True)
        for run in runs:
            for index in range(last):
                run.step(index)
            run.ready(last)
        return runs

    alone = ready()
    for run in alone:
        run.driver.prepare()()
    expected = [run.answers() for run in alone]
    for turn in range(1, _TURNS):
        pair = ready()
        try:
            met = meet(pair[0].driver, pair[1].driver, turn)
        except SceneError:
            return None
        for run, wanted in zip(pair, expected, strict=True):
            told = _changed(run.answers(), wanted)
            if told:
                return Finding(
                    f"a call from a second thread right after {_named(met.variable)} is written "
                    f"changes {told}",
                    where=met.where,
                    hint=HINT,
                )
        if not met.met:
            return None
    return None


def _pair(subject: Subject) -> tuple[Case, Case]:
    """Two histories of the same length with different motions and loads."""
    directions = cases.dimensions(subject)[0]
    one = cases.slipping(subject, 2, directions)
    path = tuple(tuple(-0.7 * c for c in m) for m in cases.PATH)
    return one, cases.history(subject, path, points=2, directions=directions, load=3.0)


def _changed(found: dict[str, np.ndarray], wanted: dict[str, np.ndarray]) -> str:
    """The first array that differs, at its point, in words; "" if none does."""
    for name, array in found.items():
        same = (array == wanted[name]) | (np.isnan(array) & np.isnan(wanted[name]))
        if not same.all():
            point = int(np.argwhere(~same)[0][-1])
            before, after = values(wanted[name][..., point]), values(array[..., point])
            return f"{name} of point {point + 1} from {before} to {after}"
    return ""


def _named(symbol: str) -> str:
    """A variable as people know it: that of COMMON /WORK/ is called "work_"."""
    return symbol.removesuffix("_").partition(".")[0] or "data that outlive the call"


def _at_random(subject: Subject) -> Finding | None:
    """Runs two histories of many points in two threads, again and again."""
    directions = cases.dimensions(subject)[0]
    heavy = cases.slipping(subject, _POINTS, directions)
    light = cases.changing_load(subject, _POINTS, directions)
    expected = {"heavy": _quiet(subject, heavy), "light": _quiet(subject, light)}
    for answers in expected.values():
        if failed(answers):
            raise CannotCheck(f"the routine failed: {failed(answers)}")
    found: list[Finding] = []
    start = threading.Barrier(2)

    def work(name: str, case: Case) -> None:
        start.wait()
        end = time.monotonic() + _SECONDS
        while time.monotonic() < end and not found:
            unlike = told("in two threads at once", expected[name], _quiet(subject, case))
            if unlike is not None:
                found.append(unlike)

    pair = [threading.Thread(target=work, args=a) for a in (("heavy", heavy), ("light", light))]
    for thread in pair:
        thread.start()
    for thread in pair:
        thread.join()
    return found[0] if found else None


def _quiet(subject: Subject, case: Case) -> list[Answer]:
    return subject.but(tell=None).respond(case, block=case.points)
