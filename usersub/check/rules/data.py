# SPDX-License-Identifier: MIT
"""Data of the routine that outlive a call, and data that were never set."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from usersub.check import cases
from usersub.check.probing.watching import MEMORY, watch
from usersub.check.rule import CannotCheck, Finding, NotApplicable, rule
from usersub.check.rules.words import first_unlike, told_apart
from usersub.check.source import arguments, constants, statics, unset
from usersub.check.subject import Subject

_COMPILED = ("c", "c++", "fortran", "library")

#: Static memory that is worth a word, bytes.
LARGE = 16 << 20


@rule(
    "data.shared",
    "The routine keeps nothing in COMMON, SAVE, module or static variables.",
    reference="the solver calls the routine from several threads, repeats increments after a "
    "cut-back and starts anew at a restart; only state variables are kept for it",
    severity="warning",
    languages=_COMPILED,
)
def shared(subject: Subject) -> Iterator[Finding]:
    """Writable data that the routine can come to touch; constant tables are none, and a COMMON
    block that BLOCK DATA fills and nothing changes neither."""
    found = [s for s in statics.of_routine(subject) if not constants.constant(subject, s)]
    if not found:
        return
    upper = subject.interface.name.upper()
    one = len(found) == 1
    yield Finding(
        f"{upper} refers to {statics.in_words(found)}, which outlive{'s' if one else ''} a call "
        "and which all threads share: it could keep state there",
        where=next((s.where for s in found if s.where), ""),
        hint="Keep history in the state variables, constants in PARAMETER or const, and the rest "
        "in local variables.",
    )


@rule(
    "data.size",
    "The file has less than 16 MiB of static memory.",
    reference="COMMON blocks of hundreds of megabytes are in circulation; each process of a "
    "parallel analysis has its own",
    severity="warning",
    languages=_COMPILED,
)
def size(subject: Subject) -> Iterator[Finding]:
    """Static memory of the whole file."""
    found = statics.of_file(subject)
    total = sum(s.size for s in found)
    if total <= LARGE:
        return
    largest = max(found, key=lambda s: s.size)
    yield Finding(
        f"the file has {statics.bytes_in_words(total)} of static memory, most of it in "
        f"{largest.people} ({statics.bytes_in_words(largest.size)}); expected at most "
        f"{statics.bytes_in_words(LARGE)}",
        where=largest.where,
        hint="Dimension it by what the model needs, or allocate it when it is used.",
    )


@rule(
    "data.uninitialised",
    "Every local variable is set before it is used.",
    reference="fault of published code: what lies on the stack by chance becomes friction",
    seconds=20.0,
)
def uninitialised(subject: Subject) -> Iterator[Finding]:
    """Runs on stacks with different patterns, then builds in which variables begin with different
    values. A warning alone is no fault: the compiler does not know which branches can be taken."""
    warned = unset.warned(subject)
    names = unset.named(warned)
    named = f"; the compiler names {names}" if names else ""
    sound = True
    for case in cases.common(subject):
        seen = watch(subject, case, ("uninitialised", *_OTHERS))
        if seen is not None and seen.what == "uninitialised":
            finding = seen.finding(_HINT)
            place = warned[0].where if warned else seen.where
            yield replace(finding, detail=finding.detail + named, case=case, where=place)
            return
        sound = sound and seen is None
    if not sound:
        raise CannotCheck("other faults come before it; see memory and process")
    if found := _by_first_values(subject, named, warned[0].where if warned else ""):
        yield found


#: Faults after which what another build does is a matter of luck.
_OTHERS = (*MEMORY, "crash", "stop", "time")
_HINT = "Set the variable on every path that leads to its use."
#: What a build sets local variables to before the routine does. Without optimisation it is quick.
_FIRST_VALUES = ("-ftrivial-auto-var-init=zero", "-ftrivial-auto-var-init=pattern")
_QUICK = "-O0"


def _by_first_values(subject: Subject, named: str, where: str) -> Finding | None:
    """Compares answers of two builds of the same source; both are right if it sets everything."""
    try:
        if statics.of_routine(subject):
            return None  # what earlier calls left counts as well
        zero, pattern = (arguments.variant(subject, _QUICK, option) for option in _FIRST_VALUES)
    except (CannotCheck, NotApplicable):
        return None
    if zero is None or pattern is None:
        return None
    for case in cases.common(subject):
        # What is read beyond an argument differs too, and has rules of its own.
        if watch(pattern, case, MEMORY) is not None:
            return None
        ones, others = (v.respond(case, enforced=True) for v in (zero, pattern))
        if first_unlike(ones, zero.respond(case, enforced=True)) is not None:
            return None  # something lasts, in a file or in an array of the solver's
        failures = ones[-1].failure, others[-1].failure
        if (failures[0] is None) != (failures[1] is None):
            return Finding(
                "the routine fails or not by what a local variable holds before it is set: "
                f"{failures[0] or failures[1]}{named}",
                case,
                where,
                _HINT,
                {"step": min(len(ones), len(others)) - 1},
            )
        unlike = first_unlike(ones, others)
        if unlike is None:
            continue
        step, name, point = unlike
        one, other = told_apart(ones[step], others[step], name, point)
        return Finding(
            f"the result depends on what a local variable holds before it is set: {name} is {one} "
            f"if variables begin with zeros, {other} if not{named}",
            case,
            where,
            _HINT,
            {"step": step, "point": point},
        )
    return None
