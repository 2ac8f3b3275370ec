# SPDX-License-Identifier: MIT
"""Problems with known answers, for tests, studies, documentation and `usersub demo` alike."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from usersub import laws
from usersub.problems import (
    own,
    p1,
    p2,
    p3,
    p4,
    p5,
    p6,
    p7,
    p8,
    p9,
    p10,
    p11,
    p12,
    p13,
    p14,
    p15,
    p16,
    p17,
    p18,
    p19,
    p20,
    p21,
    p22,
    p23,
    p24,
)
from usersub.problems.choose import one_of
from usersub.problems.problem import KEYS, Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

__all__ = ["KEYS", "PROBLEMS", "Case", "Outcome", "Problem", "all_cases", "demo_cases", "run"]

#: The problems by name.
PROBLEMS: dict[str, Problem] = {
    p.PROBLEM.name: p.PROBLEM
    for p in (
        p1,
        p2,
        p3,
        p4,
        p5,
        p6,
        p7,
        p8,
        p9,
        p10,
        p11,
        p12,
        p13,
        p14,
        p15,
        p16,
        p17,
        p18,
        p19,
        p20,
        p21,
        p22,
        p23,
        p24,
    )
}


@dataclass(frozen=True)
class Case:
    """One run of a problem through one of the shipped laws; making it costs nothing."""

    problem: str
    law: str
    interface: str
    language: str
    precision: str
    method: str
    options: dict[str, object] = field(default_factory=dict)

    def run(self) -> Outcome:
        """Runs it; compilation is not part of its times.

        Raises:
            MissingTool: the compiler of the language is missing.
        """
        routine = own.routine(self.law, self.interface, self.language, self.precision)
        return PROBLEMS[self.problem].run(
            routine, law=self.law, precision=self.precision, method=self.method, **self.options
        )


def run(
    name: str,
    *,
    interface: str | None = None,
    language: str = "python",
    law: str | None = None,
    routine: Routine | None = None,
    **options: object,
) -> Outcome:
    """Runs a problem by its name (any case), through a routine or through a shipped law.

    Args:
        routine: user code; `interface` and `language` are then its own.
        options: `precision`, `method` and the options of the problem (`PROBLEMS[name].options`).

    Raises:
        SceneError: unknown problem, interface, method or option; the message names the nearest.
    """
    problem = PROBLEMS[one_of("problem", [name.upper()], PROBLEMS, "list")]
    if routine is None:
        interface = one_of(
            "interface", [interface or problem.interfaces[0]], problem.interfaces, problem.name
        )
        language = one_of("language", [language], laws.LANGUAGES, problem.name)
        known = problem.laws_of(interface)
        law = one_of("law", [law or known[0]], known, problem.name)
        precision = str(options.get("precision", "double"))
        routine = own.routine(law, interface, language, precision)
    return problem.run(routine, law=law, **options)  # type: ignore[arg-type]


def _is_for_the_demo(problem: Problem, interface: str, method: str) -> bool:
    """Whether it is quick, and needs no law compiled that nothing else of the demo does."""
    if problem.name in ("P5", "P6", "P7", "P8"):
        return method.endswith("events")
    if problem.name == "P17":
        return method != "critical"
    return problem.name != "P23" or interface in ("fric_coef", "vfric_coef")


def _demo_methods(problem: Problem, interface: str, quick: bool) -> Iterator[str]:
    """Methods of the demo: where a refined one reaches rounding, the plain one is left out."""
    for method in problem.methods[interface]:
        refined = {"P1": (), "P2": ("rigid", "implicit")}.get(problem.name, ())
        plain = {"P1": ("rigid rk4", "implicit Romberg")}.get(problem.name, ())
        elements = method.startswith("C")
        if not _is_for_the_demo(problem, interface, method):
            continue
        if method not in refined + plain and not (quick and elements and method != "C3D8R"):
            yield method


#: Problems with laws of their own; to compile these in all languages takes minutes at first.
_FEW = ("P13", "P14", "P15", "P16", "P17", "P18")


def _in_the_demo(case: Case) -> bool:
    """Of problems with many laws of their own: the first law, in C."""
    # These take many seconds to compile in Python: tables, and the scaled return mapping.
    if (case.law, case.language) == ("coulomb_tabulated", "python"):
        return False
    if (case.problem, case.law, case.interface) == ("P19", "anisotropic", "fric"):
        return False
    return case.problem not in _FEW or (
        case.law == PROBLEMS[case.problem].laws[0]
        and case.language == "c"
        and case.precision == "double"
    )


def _cases(methods: Callable[[Problem, str], Iterable[str]]) -> list[Case]:
    return [
        Case(problem.name, law, interface, language, precision, method)
        for problem in PROBLEMS.values()
        for law in problem.laws
        for interface in problem.interfaces
        if own.carries(law, interface) and law in problem.laws_of(interface)
        for method in methods(problem, interface)
        for language in laws.LANGUAGES
        for precision in (("double", "single") if interface.startswith("v") else ("double",))
    ]


def demo_cases(quick: bool = False) -> list[Case]:
    """Every problem through every interface, language and precision, in the order of printing.

    Args:
        quick: fewer finite-element runs.
    """
    cases = _cases(lambda problem, interface: _demo_methods(problem, interface, quick))
    return [case for case in cases if _in_the_demo(case)]


def all_cases() -> list[Case]:
    """The demo's cases and those that it leaves out: by every method."""
    return _cases(lambda problem, interface: problem.methods[interface])
