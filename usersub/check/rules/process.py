# SPDX-License-Identifier: MIT
"""A routine comes back to its host, and leaves the process as it is."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import chain

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.raw import RawCall
from usersub.check.probing.watching import Seen, watch
from usersub.check.rule import COEFFICIENT, CannotCheck, Finding, rule
from usersub.check.rules.extremes import unusual
from usersub.check.source import arguments, single, traffic
from usersub.check.subject import Subject
from usersub.driver.status import VALUES
from usersub.errors import Error

#: Faults that rules of memory tell.
_OF_MEMORY = ("stack overflow", "bus error")


def _all_cases(subject: Subject) -> Iterator[Case]:
    yield from cases.common(subject)
    yield from unusual(subject)


@rule(
    "process.returns",
    "Every call returns.",
    reference="a loop that waits for convergence needs a largest number of rounds",
    cases=_all_cases,
    seconds=20.0,
)
def returns(subject: Subject, case: Case) -> Finding | None:
    """The time limit of the checked drivers, in ordinary and in extreme cases."""
    seen = _watched(subject, case, "time")
    hint = "Give every loop a largest number of rounds, and leave it where numbers are not finite."
    return None if seen is None else seen.finding(hint)


@rule(
    "process.crash",
    "No call ends in an arithmetic fault or another crash.",
    reference="integer division by zero, calls of nothing, wild addresses",
    cases=_all_cases,
    seconds=20.0,
)
def crash(subject: Subject, case: Case) -> Finding | None:
    """Signals; faults of arguments and of the stack have rules of their own."""
    seen = _watched(subject, case, "crash")
    if seen is None or any(words in seen.sentence for words in _OF_MEMORY):
        return None
    return seen.finding("Look at the line for a division of integers, and at what it calls.")


def _watched(subject: Subject, case: Case, what: str) -> Seen | None:
    """A coefficient is asked for as it is too: with enforcement there is no call without load."""
    seen = watch(subject, case, (what,))
    if seen is None and subject.interface.name in COEFFICIENT:
        seen = watch(subject, case, (what,), enforced=False)
    return seen


# STOP.


@rule(
    "process.stop",
    "In ordinary contact the routine does not end the analysis.",
    reference="XIT, XPLB_EXIT, STOP, exit and exceptions end hours of work; PNEWDT asks for a "
    "smaller increment instead",
    seconds=20.0,
)
def stop(subject: Subject) -> Iterator[Finding]:
    """A kind of contact that is refused as a whole counts as a restriction of the routine."""
    groups: dict[tuple[int, str], list[tuple[Case, Error | None, int]]] = {}
    for case in chain(cases.common(subject), _time_increments(subject)):
        # Checked: a fault of memory ends the case, and damages nothing.
        failure, step = _ended(subject, case)
        ended = failure if failure is not None and _ends(failure) else None
        group = groups.setdefault((case.directions, case.contact), [])
        group.append((case, ended, step))
    every = [one for group in groups.values() for one in group]
    if all(ended is not None and step == 0 for _, ended, step in every):
        refusal = str(every[0][1])
        if _SAYS_WHY.search(refusal):
            raise CannotCheck(f"it refuses every call: {refusal}")
    good = any(all(ended is None for _, ended, _ in group) for group in groups.values())
    for group in groups.values():
        refused = all(ended is not None and step == 0 for _, ended, step in group)
        if refused and good:
            continue
        for case, ended, step in group:
            if ended is not None:
                yield _stopped(subject, case, ended, step)
                return


def _time_increments(subject: Subject) -> Iterator[Case]:
    """Slip in small and large increments."""
    for dt in (1e-6, 1e-3, 1e-2, 0.1, 1.0, 10.0):
        made = cases.slipping(subject)
        yield made.but(steps=tuple(replace(s, dt=dt * 4 * subject.scales.dt) for s in made.steps))


#: A refusal with words of its own: it misses a file, properties or state variables, say.
_SAYS_WHY = re.compile(r"ended with (?:\w+_ABQERR: |(?:ERROR )?STOP \D)")


def _ended(subject: Subject, case: Case) -> tuple[Error | None, int]:
    """Why a case ended before its end, and at which step."""
    enforced = (True, False) if subject.interface.name in COEFFICIENT else (True,)
    for on in enforced:
        answers = subject.respond(case, enforced=on, checked=1)
        failure = answers[-1].failure
        if failure is not None:
            break
    return failure, len(answers) - 1


def _ends(failure: Error) -> bool:
    """Indices beyond an array, which Python notices itself, are a fault of memory."""
    if isinstance(failure.__cause__, IndexError):
        return False
    return failure.status in (VALUES["ROUTINE_STOPPED"], VALUES["ROUTINE_RAISED"])


def _stopped(subject: Subject, case: Case, ended: Error, step: int) -> Finding:
    point = getattr(ended, "point", None)
    figures = {"step": step} | ({"point": point} if point is not None else {})
    place = re.search(r"([^\s/()]+\.py:\d+)\)?$", str(ended))
    return Finding(
        str(ended),
        case,
        place[1] if place else _only_line(subject, _STOPS),
        "Return a friction for everything that a host can pass, or ask for a smaller increment.",
        figures,
    )


# Output.


@rule(
    "process.output",
    "The routine does not read or write files, units or streams in every call.",
    reference="millions of calls make files without end, and calls of several threads wait for "
    "each other",
    severity="warning",
)
def output(subject: Subject) -> Iterator[Finding]:
    """Bytes that the process reads and writes, over calls with the same input."""
    if subject.routine is None:
        raise CannotCheck(f"the routine could not be loaded: {subject.failure}")
    found: list[traffic.Traffic] = []
    for load, slip in _INPUTS:
        scales = subject.scales
        other = replace(scales, load=load * scales.load, slip=slip * scales.slip)
        call = RawCall(
            subject.but(scales=other), 1 if subject.interface.solver == "standard" else 3
        )
        _later(call, 1 + len(found))
        one = traffic.of_calls(call)
        if one is None:
            raise CannotCheck("a call does not come back; see process.stop and memory.outside")
        found.append(one)
    # What is said of one input only may be a warning.
    written, read = min(one.written for one in found), min(one.read for one in found)
    parts = [
        f"{verb} {round(count)} bytes"
        for verb, count in (("writes", written), ("reads", read))
        if count >= 1
    ]
    if parts:
        yield Finding(
            f"{subject.interface.name.upper()} {' and '.join(parts)} in every call",
            where=_only_line(subject, _SPEAKS),
            hint="Write only at the first call or where something is wrong, and read tables once.",
        )


def _later(call: RawCall, increment: int) -> None:
    """Sets the number of the increment: what is written in the first one only is no fault."""
    names = {argument.name for argument in call.face.args}
    for name in names & {"KINC", "kInc"}:
        call[name][...] = increment
    for name in names & {"jFlags", "iData"}:
        call[name][1] = increment
    call.start = call.copies()


#: Loads and motions in units of the scales.
_INPUTS = ((1.0, 1.0), (0.01, 1.0), (0.1, 0.001))
_STOPS = re.compile(
    r"\b(?:call\s+(?:xit|xplb_exit|exit|abort)\b|(?:error\s+)?stop\b|(?:xit_|xplb_exit_|exit|abort)\s*"
    r"\()",
    re.IGNORECASE,
)
_SPEAKS = re.compile(
    r"\b(?:write\s*\(|print\s*[*'\"(]|read\s*\(|open\s*\(|f?printf\s*\(|puts\s*\(|fopen\s*\("
    r"|std::c(?:out|err)|(?:call\s+)?(?:stdb|xplb)_abqerr)",
    re.IGNORECASE,
)


def _only_line(subject: Subject, words: re.Pattern) -> str:
    """The line of the source with such words, if there is one alone."""
    path = subject.path
    if path is None:
        return ""
    try:
        text = path.read_text(encoding="latin-1")
    except OSError:
        return ""
    code = _code_of(arguments.language(subject))
    if arguments.language(subject) in ("c", "c++"):
        text = single.without_comments(text)
    found = [n for n, line in enumerate(text.split("\n"), 1) if words.search(code(line))]
    return f"{path.name}:{found[0]}" if len(found) == 1 else ""


def _code_of(language: str) -> Callable[[str], str]:
    """Function that takes the comment from a line."""
    if language == "fortran":
        return lambda line: "" if line[:1] in ("c", "C", "*", "!") else line.partition("!")[0]
    mark = "#" if language == "python" else "//"
    return lambda line: line.partition(mark)[0]
