# SPDX-License-Identifier: MIT
"""Checking a routine behind all its interfaces: the reports of its sessions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from usersub.check.reports.report import Report
from usersub.check.rule import Rule
from usersub.check.running import expectations
from usersub.check.running.expectations import Expectation
from usersub.check.running.session import Progress, Session
from usersub.check.subjects.targets import subjects, wishes
from usersub.errors import LoadError


def check(
    target: Any,
    *,
    interface: str | None = None,
    precision: str | None = None,
    generation: str | None = None,
    props: Sequence[float] | None = None,
    states: int | None = None,
    fields: int | None = None,
    temperatures: bool | None = None,
    anisotropic: bool | None = None,
    scales: Any = None,
    law: str | None = None,
    rules: Iterable[str] | None = None,
    skip: Iterable[str | Expectation] = (),
    expect: Iterable[str | Expectation] = (),
    seconds: float = 30.0,
    progress: Progress | None = None,
    jobs: int | None = None,
) -> list[Report]:
    """Checks a routine behind all its interfaces.

    Args:
        target: path of a file in any language, name of a built-in law, Routine, law object or law
            function.
        interface: only this one.
        precision: "double", "single" or "both"; None is double.
        generation: of FRIC_COEF; None reads it from the code.
        props, states, fields, temperatures, anisotropic, scales: what the routine is run with; None
            is found out by running it.
        law: name of the built-in law that it claims to be.
        rules: identifiers, groups or patterns of the rules to look at; None for all.
        skip, expect: rules to leave out, and rules that are known to fail, as in the files that
            `usersub.check.running.expectations` describes.
        seconds: time for each interface and precision.
        progress: is told how far it is.
        jobs: processes at a time; None is two, or one on a machine with one core.

    Returns:
        one report for each interface and precision. Whether all is well says `report.ok()`.

    Raises:
        LoadError, CompileError, MissingTool: the target cannot be looked at at all.
        SceneError: a value that cannot be.
    """
    wish = wishes(
        interface, precision, law, generation,
        props=props, states=states, fields=fields, temperatures=temperatures,
        anisotropic=anisotropic, scales=scales,
    )  # fmt: skip
    wanted = selected(rules)
    left_out, announced = expectations.parsed(skip), expectations.parsed(expect)
    reports = []
    for subject in subjects(target, wish):
        session = Session(subject, skip=left_out, expect=announced, seconds=seconds, workers=jobs)
        reports.append(session.report(wanted, progress))
    return reports


def selected(patterns: Iterable[str] | None) -> list[Rule]:
    """The rules that identifiers, groups or patterns mean, in the order in which they run.

    Raises:
        LoadError: one of them means no rule.
    """
    from usersub.check.rules import all_rules

    known = all_rules()
    if patterns is None:
        return list(known.values())
    given = [patterns] if isinstance(patterns, str) else list(patterns)
    for pattern in given:
        if not any(expectations.matches(pattern, rule) for rule in known):
            raise LoadError(expectations.no_such_rule(pattern, known))
    return [r for r in known.values() if any(expectations.matches(p, r.id) for p in given)]
