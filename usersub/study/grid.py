# SPDX-License-Identifier: MIT
"""What a study runs: points over language, interface, method, step, precision and block.

An axis that is named is multiplied out. One that is not has its default: every interface, method
and step in C and double precision; the first method of each interface in the other languages, in
single precision, and, at one step, with other blocks. All of them in all would tell the same a
hundred times.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from usersub import abi
from usersub.errors import SceneError
from usersub.study import ladders
from usersub.study.files import routine_file
from usersub.study.result import Plain, Point

if TYPE_CHECKING:
    from usersub.problems import Problem

LANGUAGES = ("python", "c", "fortran")
PRECISIONS = ("double", "single")

#: In which laws are compared by all methods: it compiles fast and is as fast as any.
_BASE = "c"

#: Laws that take many seconds to compile in Python: tables, and the scaled return mapping.
_SLOW = {("coulomb_tabulated", "fric"), ("coulomb_tabulated", "fric_coef"), ("anisotropic", "fric")}


@dataclass(frozen=True)
class Selection:
    """What is asked for; empty is the default of an axis. `settings`: numbers of a user's routine
    by interface (`usersub.study.motions`)."""

    problems: tuple[str, ...] = ()
    laws: tuple[str, ...] = ()
    routine: str = ""
    interfaces: tuple[str, ...] = ()
    languages: tuple[str, ...] = ()
    methods: tuple[str, ...] = ()
    steps: tuple[int, ...] = ()
    precisions: tuple[str, ...] = ()
    blocks: tuple[int, ...] = ()
    quick: bool = False
    settings: Mapping[str, Mapping[str, Plain]] = field(default_factory=dict)


def points(
    problems: Sequence[str] = (),
    laws: Sequence[str] = (),
    routine: str | Path | None = None,
    interfaces: Sequence[str] = (),
    languages: Sequence[str] = (),
    methods: Sequence[str] = (),
    steps: Sequence[int] = (),
    precisions: Sequence[str] = (),
    blocks: Sequence[int] = (),
    *,
    quick: bool = False,
    settings: Mapping[str, Mapping[str, Plain]] | None = None,
) -> list[Point]:
    """The points of a study, each once, in the order in which they run.

    Args:
        problems, laws: names; without any, and without a routine, all problems.
        routine: file of user code, in any language; `laws` are then what it claims to be.
        methods: names of methods, or their beginnings ("penalty").
        steps: increments, instead of the problem's own ladder.
        blocks: contact points a call.
        quick: fewer steps, in C alone.
        settings: by interface, what the motions of a user's routine need (`motions.SETTINGS`).

    Raises:
        SceneError: an unknown name (the message has the nearest), a number that cannot be, or
            nothing is left.
        LoadError, CompileError, MissingTool: the routine cannot be loaded.
    """
    chosen = _checked(Selection(
        tuple(problems), tuple(laws), "" if routine is None else str(routine), tuple(interfaces),
        tuple(languages), tuple(methods), tuple(steps), tuple(precisions), tuple(blocks), quick,
        settings or {},
    ))  # fmt: skip
    found = list(_of_routine(chosen) if chosen.routine else _of_laws(chosen))
    _check_methods(chosen, found)
    found = [p for p in found if _has_method(chosen, p)]
    if not found:
        raise SceneError(f"nothing to study: no case is all of {_words(chosen)}")
    return list(dict.fromkeys(found))


# Names.


def _checked(chosen: Selection) -> Selection:
    from usersub.laws import LAWS
    from usersub.problems import PROBLEMS
    from usersub.study.motions import MOTIONS

    for number, name in [(n, "step") for n in chosen.steps] + [(n, "block") for n in chosen.blocks]:
        if isinstance(number, bool) or not isinstance(number, int) or number < 1:
            raise SceneError(f"{name} is {number!r}, expected a whole number from 1")
    known = {**{n.lower(): n for n in PROBLEMS}, **{n: n for n in MOTIONS}}
    from usersub.problems.own import OWN

    return replace(
        chosen,
        problems=_names("problem", chosen.problems, known),
        laws=_names("law", chosen.laws, {n: n for n in (*LAWS, *OWN)}),
        interfaces=_names("interface", chosen.interfaces, {n: n for n in abi.NAMES}),
        languages=chosen.languages
        if chosen.routine
        else _names("language", chosen.languages, {n: n for n in LANGUAGES}),
        precisions=_names("precision", chosen.precisions, {n: n for n in PRECISIONS}),
    )


def _names(kind: str, given: Iterable[str], known: Mapping[str, str]) -> tuple[str, ...]:
    for name in given:
        if name.lower() not in known:
            near = difflib.get_close_matches(name.lower(), known, n=1, cutoff=0.4)
            hint = f"; did you mean '{known[near[0]]}'?" if near else "."
            raise SceneError(
                f"there is no {kind} '{name}'{hint} Expected one of: {', '.join(known.values())}"
            )
    return tuple(known[name.lower()] for name in given)


def _check_methods(chosen: Selection, found: list[Point]) -> None:
    names = {p.method: p.method for p in found}
    for name in chosen.methods:
        if not any(method.startswith(name) for method in names):
            _names("method", [name], {n.lower(): n for n in names})


def _has_method(chosen: Selection, point: Point) -> bool:
    return not chosen.methods or any(point.method.startswith(m) for m in chosen.methods)


def _words(chosen: Selection) -> str:
    named = {
        "problem": chosen.problems, "law": chosen.laws, "interface": chosen.interfaces,
        "language": chosen.languages, "method": chosen.methods, "precision": chosen.precisions,
    }  # fmt: skip
    said = [f"{name} {' '.join(values)}" for name, values in named.items() if values]
    return ", ".join([*([chosen.routine] if chosen.routine else []), *said]) or "what was asked for"


# Shipped laws.


def _of_laws(chosen: Selection) -> Iterator[Point]:
    from usersub.problems import PROBLEMS

    names = [n for n in chosen.problems if n in PROBLEMS]
    alone = not chosen.problems
    for problem in [PROBLEMS[n] for n in names] if not alone else PROBLEMS.values():
        yield from _of_problem(chosen, problem)
    carried = {law for p in PROBLEMS.values() for law in p.laws}
    for law in chosen.laws:
        if (alone and law not in carried) or len(names) < len(chosen.problems):
            yield from _law_motions(chosen, law)


def _of_problem(chosen: Selection, problem: Problem) -> Iterator[Point]:
    from usersub.problems import own

    for law in problem.laws:
        if chosen.laws and law not in chosen.laws:
            continue
        for interface in problem.interfaces:
            if chosen.interfaces and interface not in chosen.interfaces:
                continue
            if own.carries(law, interface) and law in problem.laws_of(interface):
                for place, method in enumerate(problem.methods[interface]):
                    base = Point(problem.name, law, "", interface, _BASE, "double", method)
                    yield from _spread(chosen, problem, base, first=place == 0)


def _spread(chosen: Selection, problem: Problem, base: Point, first: bool) -> Iterator[Point]:
    """One method of a law through an interface, over the other axes."""
    ladder = ladders.ladder(problem, base.law, base.method)
    if ladder and chosen.quick:
        ladder = ladder.quick()
    steps: tuple[int | None, ...] = (ladder and (chosen.steps or ladder.levels)) or (None,)
    variants = ladders.variants(problem, base.law, base.method)
    for place, options in enumerate(variants):
        widely = place == 0 and bool(first or chosen.methods)
        for language in _languages(chosen, base, widely):
            alike = widely and language == base.language
            for precision in _precisions(chosen, base, alike):
                for block in chosen.blocks or (None,):
                    for step in steps:
                        yield replace(
                            base, language=language, precision=precision, step=step,
                            block=block, options=tuple(sorted(options.items())),
                        )  # fmt: skip
    if first and not (chosen.blocks or chosen.steps or chosen.quick):
        language = _languages(chosen, base, False)[0]
        precision = next(iter(_precisions(chosen, base, False)), None)
        for block in ladders.blocks(problem, base.law, base.method) if precision else ():
            middle = steps[len(steps) // 2]
            yield replace(base, language=language, precision=precision, step=middle, block=block)


def _languages(chosen: Selection, base: Point, all_of_them: bool) -> tuple[str, ...]:
    if base.routine or chosen.languages:
        return (base.language,) if base.routine else chosen.languages
    if not all_of_them or chosen.quick:
        return (_BASE,)
    slow = (base.law, base.interface) in _SLOW
    return tuple(n for n in (_BASE, *LANGUAGES) if not (slow and n == "python"))


def _precisions(chosen: Selection, base: Point, all_of_them: bool) -> tuple[str, ...]:
    known = abi.interface(base.interface).precisions
    if chosen.precisions:
        return tuple(p for p in chosen.precisions if p in known)
    return tuple(p for p in PRECISIONS if p in known) if all_of_them else ("double",)


def _law_motions(chosen: Selection, law: str) -> Iterator[Point]:
    from usersub import laws

    own = laws.law(law)
    for interface in own.interfaces:
        if chosen.interfaces and interface not in chosen.interfaces:
            continue
        for language in chosen.languages or (_BASE,):
            base = Point("", law, "", interface, language, "double", "")
            yield from _motions(chosen, base, {})


# A user's routine.


def _of_routine(chosen: Selection) -> Iterator[Point]:
    from usersub.problems import PROBLEMS
    from usersub.study.motions import MOTIONS

    language, interfaces, content = routine_file(chosen.routine)
    asked = chosen.interfaces or interfaces
    if missing := [name for name in asked if name not in interfaces]:
        names = ", ".join(name.upper() for name in interfaces)
        raise SceneError(f"{Path(chosen.routine).name} has no {missing[0].upper()}; it has {names}")
    problems = [PROBLEMS[n] for n in chosen.problems if n in PROBLEMS]
    if problems and not chosen.laws:
        raise SceneError(
            f"{problems[0].name} is a problem with a law; say with --law which one "
            f"{Path(chosen.routine).name} is, or leave the problem out"
        )
    for law in chosen.laws:
        for problem in problems or (() if chosen.problems else PROBLEMS.values()):
            for interface in asked:
                if interface in problem.methods and law in problem.laws_of(interface):
                    for place, method in enumerate(problem.methods[interface]):
                        base = Point(problem.name, law, chosen.routine, interface, language,
                                     "double", method, content=content)  # fmt: skip
                        yield from _spread(chosen, problem, base, first=place == 0)
    if not problems or any(n in MOTIONS for n in chosen.problems):
        for interface in asked:
            base = Point("", chosen.laws[0] if chosen.laws else "", chosen.routine, interface,
                         language, "double", "", content=content)  # fmt: skip
            yield from _motions(chosen, base, chosen.settings.get(interface, {}))


def _motions(chosen: Selection, base: Point, settings: Mapping[str, Plain]) -> Iterator[Point]:
    """The general motions, through one interface."""
    from usersub.study import motions

    needs = tuple(sorted(settings.items()))
    fixed = chosen.blocks or chosen.steps or chosen.quick
    for name in motions.MOTIONS:
        if chosen.problems and name not in chosen.problems:
            continue
        levels = motions.QUICK if chosen.quick else motions.LEVELS
        for place, method in enumerate(motions.methods(base.interface)):
            for precision in _precisions(chosen, base, place == 0 and not chosen.quick):
                one = replace(base, problem=name, method=method, precision=precision,
                              settings=needs)  # fmt: skip
                for block in chosen.blocks or (None,):
                    for step in chosen.steps or levels:
                        yield replace(one, step=step, block=block)
                if place == 0 and precision == "double" and not fixed:
                    for block in motions.BLOCKS:
                        yield replace(one, step=levels[len(levels) // 2], block=block)
