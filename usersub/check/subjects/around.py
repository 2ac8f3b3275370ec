# SPDX-License-Identifier: MIT
"""Names of surfaces and step numbers by which a routine branches: string constants of its source
are tried as names, and later steps, and what changes the answers is looked at as well."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator
from itertools import permutations
from typing import TYPE_CHECKING

from usersub.check.subject import Around
from usersub.check.subjects import values

if TYPE_CHECKING:
    from usersub.check.subject import Subject

#: A string constant: Fortran doubles a quote, C and Python escape it; such names do not occur.
_STRING = re.compile(r"'([^'\n\"]{1,80})'|\"([^\"\n']{1,80})\"")
#: Lines that hold no constant of a comparison.
_NONE = re.compile(r"^\s*(?:#|\d*\s*(?:include|use|format)\b)", re.IGNORECASE)
_FIXED = (".f", ".for", ".ftn", ".f77")
_NO_COMMENT = {"c": "//", "c++": "//", "python": "#", "fortran": "!"}
#: Constants that are tried, names for both surfaces at a time, and the time for all, seconds.
_MOST, _PAIRED, _SECONDS = 24, 8, 1.5
#: Steps that are tried.
_STEPS = 6
#: Places that are looked at besides the ordinary one: more cost too much time.
_KEPT = 3
#: Cost from which on there is no friction at all (`values.cost`).
_NO_FRICTION = 30.0
#: A comparison with the number of the step.
_STEP = re.compile(
    r"\b(?:k_?step|jflags\s*[\[(]\s*[01]\s*[\])]|idata\s*[\[(]\s*[01]\s*[\])])"
    r"\s*(?:\.\s*[a-z]{2}\s*\.|[=<>/!]=?)\s*(\d{1,3})\b",
    re.IGNORECASE,
)

#: What a routine does at a place: enough to tell two places apart.
_Deed = tuple[object, ...]


def others(subject: Subject) -> tuple[Around, ...]:
    """Names and step numbers at which the routine does something else than at the ordinary ones,
    one for each different thing that it does."""
    try:
        here = _deed(subject)
        if here != _deed(subject):
            return ()  # it does something else every time
        found = {here: subject.around}
        begin = time.monotonic()
        for around in _candidates(subject):
            if len(found) > _KEPT or time.monotonic() > begin + _SECONDS:
                break
            told = subject.but(around=around)
            deed = _deed(told)
            if deed not in found and not _refused(deed) and deed == _deed(told):
                found[deed] = around
        if here != _deed(subject):
            return ()  # what it did before counts
    except values.Endless:
        return ()
    later = _later(subject, here)
    if later is not None:
        found.setdefault(later[0], later[1])
    return tuple(around for around in found.values() if around != subject.around)


def with_friction(subject: Subject) -> Subject:
    """The subject at a place at which there is friction, if there is none at its own."""
    costs = {subject.around: values.cost(subject)}
    if costs[subject.around] < _NO_FRICTION or not subject.others:
        return subject
    costs |= {a: values.cost(subject.but(around=a)) for a in subject.others}
    best = min(costs, key=lambda a: costs[a])
    # Unknown names may be refused.
    rest = tuple(a for a in costs if a != best and not _refused(_deed(subject.but(around=a))))
    return subject.but(around=best, others=rest)


def _later(subject: Subject, here: _Deed) -> tuple[_Deed, Around] | None:
    """A later step in which the routine does something else. One that nothing was before is only
    taken for a routine that does nothing in the first step: others may begin their history there.
    """
    names = subject.around.names
    try:
        later = _later_steps(subject)
        # Steps that follow one without motion, then such in which nothing was before.
        for numbers in [*((1, n) for n in later), *((n, n) for n in later)]:
            if numbers[0] > 1 and values.cost(subject) < _NO_FRICTION:
                break
            told = subject.but(around=Around(names, numbers))
            deed = _deed(told)
            if deed != here and not _refused(deed) and deed == _deed(told):
                return deed, told.around
    except values.Endless:
        pass
    return None


def _refused(deed: _Deed) -> bool:
    """Whether the routine ended the analysis."""
    return any(isinstance(word, str) and "ended with" in word for word in deed)


def _deed(subject: Subject) -> _Deed:
    """What the routine does in a slide to and fro."""
    case = values.path_case()
    error, _ = values.watched(subject, case)
    if error is not None:
        return (str(error).partition(" (routine '")[0],)
    given = values.answers(subject, case)
    arrays = [(n, a.tobytes()) for g in given for n, a in sorted(g.arrays().items())]
    failed = [str(g.failure).partition(" (routine '")[0] for g in given if g.failure is not None]
    return (*arrays, *failed)


def _candidates(subject: Subject) -> Iterator[Around]:
    """Places with names that the source knows: one name after the other, then two surfaces."""
    usual, numbers = subject.around.names, subject.around.step_numbers
    names = constants(subject)[:_MOST]
    for name in names:
        yield Around((name, usual[1], usual[2]), numbers)
        yield Around((usual[0], name, usual[2]), numbers)
        yield Around((usual[0], usual[1], name), numbers)
    for secondary, main in permutations(names[:_PAIRED], 2):
        yield Around((usual[0], secondary, main), numbers)


def constants(subject: Subject) -> list[str]:
    """String constants of the subject's source, in its order, without those in comments."""
    found = [a or b for line in _code(subject) for a, b in _STRING.findall(line)]
    stripped = (name.rstrip() for name in found)
    return list(dict.fromkeys(n for n in stripped if n.isascii() and n.isprintable() and n))


def _later_steps(subject: Subject) -> list[int]:
    """Numbers of later steps: the second, and those around the ones that the source compares
    with."""
    named = [int(n) for line in _code(subject) for n in _STEP.findall(line)]
    around = (m for n in named for m in (n, n + 1) if m > 1)
    return list(dict.fromkeys((2, *around)))[:_STEPS]


def _code(subject: Subject) -> Iterator[str]:
    """Lines of the source that are no comments."""
    path = subject.path
    if path is None or subject.routine is None or subject.routine.language == "library":
        return
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return
    comment = _NO_COMMENT.get(subject.routine.language, "!")
    fixed = path.suffix.lower() in _FIXED
    for line in text.splitlines():
        if fixed and line[:1] in tuple("cC*!dD"):
            continue
        if line.lstrip().startswith(comment) or _NONE.match(line):
            continue
        yield line
