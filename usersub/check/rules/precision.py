# SPDX-License-Identifier: MIT
"""Digits that a routine loses: single precision and integers where there should be doubles."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from usersub.check.case import Case
from usersub.check.probing import digits
from usersub.check.rule import CannotCheck, Finding, NotApplicable, rule
from usersub.check.rules.words import number
from usersub.check.source import arguments, single
from usersub.check.source.again import Source, Warned
from usersub.check.subject import Subject
from usersub.errors import Error

#: Roughness above which an answer has gone through single precision (confirmed by another build,
#: and by itself), and difference above which two builds mean something else.
_ROUGH, _ROUGH_ALONE, _OTHER = 1e-11, 1e-9, 1e-2
#: Change of the answer by which an integer counts as one that should be real.
_CUT = 1e-9


def _double(subject: Subject) -> None:
    if subject.precision == "single":
        raise NotApplicable("in single precision there are 7 digits")


@rule(
    "precision.digits",
    "The result has the digits of double precision.",
    reference="fault of published code: single-precision locals in double-precision code, and "
    "names that begin with I to N",
    seconds=20.0,
)
def lost(subject: Subject) -> Iterator[Finding]:
    """Answers to very small steps of the input, of the routine and of a build in which all reals
    are double."""
    _double(subject)
    if subject.routine is None:
        raise CannotCheck(f"the routine could not be loaded: {subject.failure}")
    try:
        source = arguments.source_of(subject)
    except NotApplicable:
        yield from _by_itself(subject)
        return
    warned = single.of_routine(source, subject.interface.name, _warnings(source))
    yield from _against_doubles(subject, source, warned)
    yield from _against_reals(subject, source, warned)


def _warnings(source: Source) -> list[Warned]:
    try:
        return source.warnings(*(single.FORTRAN if source.language == "fortran" else single.C))
    except Error as error:
        raise CannotCheck(str(error)) from error


def _by_itself(subject: Subject) -> Iterator[Finding]:
    """Without a source: the answer is rough at several places, the same each time."""
    worst, shown, rough = 0.0, None, 0
    for case in digits.places(subject):
        found = digits.response(subject, case)
        if found is None:
            raise CannotCheck("the routine fails where digits are looked at")
        again = digits.response(subject, case)
        if found.roughness() < _ROUGH_ALONE or again is None:
            continue
        if not np.array_equal(found.rows, again.rows):
            raise CannotCheck("the routine does not repeat itself; see repeat.same")
        rough += 1
        if found.roughness() > worst:
            worst, shown = found.roughness(), case
    # A single place may lie on a step of the law itself.
    if shown is not None and rough > 1:
        yield Finding(
            f"the result has {digits.digits(worst):.0f} digits, expected 15: it jumps by "
            f"{worst:.1g} of its size while all inputs grow in even steps of {digits.STEP:.1g}",
            shown,
            hint="Keep everything in double precision: no float32, no single-precision locals.",
        )


def _against_doubles(subject: Subject, source: Source, warned: list[Warned]) -> Iterator[Finding]:
    other = _promoted(subject, source)
    if other is None:
        return
    worst, shown, pair = 0.0, None, None
    for case in digits.places(subject):
        one, two = digits.answer(subject, case), digits.answer(other, case)
        if one is None or two is None or np.array_equal(one, two):
            continue
        ours, theirs = digits.response(subject, case), digits.response(other, case)
        if ours is None or theirs is None:
            continue
        # Constants in single precision move both by the same; what is rounded jumps.
        jumps = digits.jumps(ours, theirs)
        error = np.abs(ours.rows - theirs.rows).max(axis=0) / theirs.size
        element = int(error.argmax())
        if jumps > max(_ROUGH, 100 * theirs.roughness()) and worst < error.max() < _OTHER:
            worst, shown = float(error.max()), case
            at = int(np.abs(ours.rows - theirs.rows)[:, element].argmax())
            pair = ours.rows[at, element], theirs.rows[at, element]
    if shown is None or pair is None:
        return
    places = list(dict.fromkeys(w.where for w in single.narrowed(warned)))
    places = places or single.mentions(source)
    named = f" ({', '.join(places[:_SHOWN])})" if places else ""
    yield Finding(
        f"the result has {digits.digits(worst):.0f} digits, expected 15: {number(pair[0])}, where "
        f"the same source with double precision throughout gives {number(pair[1])}; values pass "
        f"through single precision{named}",
        shown,
        places[0] if places else "",
        "Declare these variables double (REAL*8), or include ABA_PARAM.INC or VABA_PARAM.INC, "
        "and use no REAL(), SNGL() or float on the way.",
    )


def _promoted(subject: Subject, source: Source) -> Subject | None:
    """The subject with double for all single precision; None if that changes nothing."""
    if source.language == "fortran":
        promoted = single.has_single(source)
        return arguments.variant(subject, *single.PROMOTED) if promoted else None
    text = source.text()
    made = single.promoted_c(text)
    return None if made == text else arguments.variant(subject, text=made)


def _against_reals(subject: Subject, source: Source, warned: list[Warned]) -> Iterator[Finding]:
    """Integers that should be real: by implicit typing in Fortran, by abs in C."""
    if source.language != "fortran":
        wrong = [w for w in warned if w.option == "-Wabsolute-value"]
        text = source.text()
        made = single.real_abs(text, warned, source.path.name) if wrong else text
        if made != text and (changed := _changed(subject, made)):
            yield _integer(
                changed, "abs takes an integer, so fractions are cut off", wrong[0].where, "fabs"
            )
        return
    for one in single.cut(source, warned):
        text_of = single.with_real(source, one) if one.real_name else None
        changed = None if text_of is None else _changed(subject, text_of)
        if text_of is not None and changed is None and subject.origin.get("props") != "given":
            changed = _changed_between(subject, text_of)
        if changed:
            name = one.name.upper()
            yield _integer(
                changed,
                f"{name} is an integer, as its name begins with {name[0]} and nothing declares it: "
                "fractions are cut off",
                one.where,
                f"REAL*8 {name}",
            )
            return


def _integer(changed: tuple[Case, float, float], reason: str, where: str, wanted: str) -> Finding:
    case, ours, theirs = changed
    return Finding(
        f"{reason}; the result is {number(ours)} instead of {number(theirs)}{_with(case)}",
        case,
        where,
        f"Write {wanted}.",
    )


def _with(case: Case) -> str:
    listed = ", ".join(f"{p:g}" for p in case.props or ())
    return f" with the properties {listed}" if listed else ""


def _changed(subject: Subject, text: str) -> tuple[Case, float, float] | None:
    """Case and values of the first answer that another text changes."""
    other = arguments.variant(subject, text=text)
    if other is None:
        return None
    for case in digits.places(subject):
        one, two = digits.answer(subject, case), digits.answer(other, case)
        if one is None or two is None:
            continue
        size = max(float(np.abs(two).max()), float(np.abs(one).max()))
        difference = np.abs(one - two)
        if size > 0 and difference.max() > _CUT * size:
            at = int(difference.argmax())
            return case, float(one[at]), float(two[at])
    return None


#: What is added to whole properties that were found out, and how much more.
_BETWEEN, _BEYOND = 0.37, 1e-3


def _changed_between(subject: Subject, text: str) -> tuple[Case, float, float] | None:
    """As `_changed`, with properties between whole numbers, which the search for values may have
    found since nothing else gave friction. A switch has no values in between: with these a real
    one does the same throughout."""
    for index, value in enumerate(subject.props):
        if value != round(value) or value == 0.0:
            continue
        moved, beyond = (
            subject.but(props=(*subject.props[:index], value + d, *subject.props[index + 1 :]))
            for d in (_BETWEEN, _BETWEEN + _BEYOND)
        )
        real = arguments.variant(moved, text=text)
        more = arguments.variant(beyond, text=text)
        if real is None or more is None:
            return None
        for case in digits.places(subject):
            answers = [digits.answer(s, case) for s in (moved, beyond, real, more)]
            if any(a is None for a in answers):
                continue
            one, two, three, four = (np.asarray(a) for a in answers)
            size = float(np.abs(three).max())
            at = int(np.abs(one - three).argmax())
            cut = np.array_equal(one, two) and abs(one[at] - three[at]) > _CUT * size
            if cut and abs(four[at] - three[at]) > _CUT * size:
                return case.but(props=moved.props), float(one[at]), float(three[at])
    return None


# The compiler's warnings.


@rule(
    "precision.source",
    "The source has no single precision and no integer division where doubles are meant.",
    reference="the compiler's warnings on conversions; 0.1 is 0.100000001 in double precision, "
    "and 1/2 is 0",
    severity="warning",
    languages=("c", "c++", "fortran"),
)
def source(subject: Subject) -> Iterator[Finding]:
    """What the compiler says of conversions, one finding a kind; what costs digits is told by
    precision.digits."""
    _double(subject)
    found = arguments.source_of(subject)
    warned = single.of_routine(found, subject.interface.name, _warnings(found))
    yield from _constants(found, warned)
    told = subject.routine is not None and any(_against_doubles(subject, found, warned))
    yield from _listed(
        [] if told else single.narrowed(warned),
        lambda places: f"values of double precision are stored in single precision in {places}",
        "Declare the variables double.",
    )
    yield from _listed(
        single.whole(warned),
        lambda places: (
            f"real values are assigned to integers, which cuts off what is behind the "
            f"point, in {places}"
        ),
        "Declare the variables real, or write INT (C: a cast) where a whole number is meant.",
    )
    yield from _listed(
        single.divisions(warned),
        lambda places: f"a division of whole constants is cut to a whole number in {places}",
        "Write 1.D0/2.D0 for 1/2.",
    )


def _constants(found: Source, warned: list[Warned]) -> Iterator[Finding]:
    fortran = found.language == "fortran"
    constants = single.constants(found, warned) if fortran else single.constants_of_c(found)
    if not constants:
        return
    worst = max(constants, key=lambda c: c.error)
    listed = [f"{c.text} ({c.where})" for c in constants[:_SHOWN]]
    more = len(constants) - _SHOWN
    words = ", ".join(listed) + (f" and {more} more" if more > 0 else "")
    one = len(constants) == 1
    yield Finding(
        f"{words} {'is a constant' if one else 'are constants'} of single precision in double "
        f"precision, wrong by up to {worst.error:.1g} of {'its' if one else 'their'} value",
        where=constants[0].where,
        hint=f"Write {_as_double(constants[0].text, fortran)} for {constants[0].text}.",
    )


_SHOWN = 6


def _as_double(text: str, fortran: bool) -> str:
    lower = text.lower()
    if not fortran:
        return lower.removesuffix("f")
    return lower.replace("e", "D") if "e" in lower else f"{text}D0"


def _listed(warned: list[Warned], say: Callable[[str], str], hint: str) -> Iterator[Finding]:
    places = list(dict.fromkeys(w.where for w in warned))
    if places:
        more = len(places) - _SHOWN
        words = ", ".join(places[:_SHOWN]) + (f" and {more} more lines" if more > 0 else "")
        yield Finding(say(words), where=places[0], hint=hint)
