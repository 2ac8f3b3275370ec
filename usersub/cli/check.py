# SPDX-License-Identifier: MIT
"""`usersub check`: whether a routine keeps the contract of its interface."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from usersub.cli.abi import interface_name
from usersub.cli.command import FAILED, OK, Examples, common
from usersub.cli.output import print_json, print_table, relative
from usersub.errors import Error, SceneError

if TYPE_CHECKING:
    from usersub.check.reports.report import Report

#: Target -> its reports, or why there are none.
Found = dict[str, "list[Report] | Error"]


@click.command(
    "check",
    cls=Examples,
    examples=(
        "usersub check my_friction.f90",
        "usersub check my_friction.f90 --props 0.3,1e-4 --html report.html",
        "usersub check law.c --rule memory --rule frame.rotation",
        "usersub check a.f b.f c.f --jobs 4 --junit report.xml",
        "usersub check --list-rules",
    ),
)
@click.argument("routines", metavar="ROUTINE...", nargs=-1)
@click.option("--interface", "-i", callback=interface_name, help="Only this interface.")
@click.option(
    "--precision",
    type=click.Choice(["double", "single", "both"]),
    default="double",
    show_default=True,
    help="Precision in which the routine is run (FRIC and FRIC_COEF are always double).",
)
@click.option("--generation", help="Of FRIC_COEF, 'legacy' or '2022'; found out if not given.")
@click.option("--props", help="Properties, as in 0.3,1e-4; found out if not given.")
@click.option("--states", type=click.IntRange(0), help="Number of state variables.")
@click.option("--fields", type=click.IntRange(0), help="Number of field variables.")
@click.option(
    "--temperatures/--no-temperatures",
    default=None,
    help="Whether the scene has temperatures; found out if not given.",
)
@click.option(
    "--anisotropic/--isotropic",
    default=None,
    help="Whether FRIC_COEF sets both coefficients; found out if not given.",
)
@click.option("--law", help="Built-in law that the routine claims to be.")
@click.option("--rule", "rules", multiple=True, help="Only this rule, group or pattern.")
@click.option("--skip-file", multiple=True, type=click.Path(), help="Rules to leave out.")
@click.option("--expect-file", multiple=True, type=click.Path(), help="Rules known to fail.")
@click.option("--seconds", type=click.FloatRange(1.0), default=30.0, show_default=True,
              help="Time for each interface.")  # fmt: skip
@click.option("--jobs", type=click.IntRange(1), help="Processes at a time.")
@click.option("--junit", type=click.Path(dir_okay=False), help="Write JUnit XML into this file.")
@click.option("--html", type=click.Path(dir_okay=False), help="Write a page with figures.")
@click.option("--strict", is_flag=True, help="A warning makes the exit code 1 too.")
@click.option("--list-rules", is_flag=True, help="List the rules and end.")
@common("check")
def command(
    routines: tuple[str, ...],
    rules: tuple[str, ...],
    junit: str | None,
    html: str | None,
    strict: bool,
    list_rules: bool,
    jobs: int | None,
    as_json: bool,
    **options: Any,
) -> int | None:
    """Tell whether each ROUTINE keeps the contract of its interface.

    ROUTINE is a file of routines in Python, C, C++ or Fortran, a library, or the name of a
    built-in law. Each rule runs in a process of its own, so that a routine that crashes or does not
    return does no harm. What is not given is found out by running the routine.

    A file of rules (--skip-file, --expect-file) has one rule, group or pattern a line, with an
    interface in front where it is for that alone (vfric: frame.*), and a reason after #.

    Exit code: 0 if no error was found; with --strict no warning either. An expected failure that
    passes makes it 1.
    """
    if list_rules:
        return _list(rules, as_json)
    if not routines:
        raise click.UsageError("Missing argument 'ROUTINE...'.")
    settings = _settings(rules, **options)
    _require(junit, html)
    found = _found(routines, settings, jobs, with_figures=html is not None, quiet=as_json)
    reports = [r for each in found.values() if isinstance(each, list) for r in each]
    _write(reports, junit, html, strict)
    errors = {t: e for t, e in found.items() if isinstance(e, Error)}
    if len(routines) == 1 and errors:
        raise next(iter(errors.values()))
    if as_json:
        _print_json(found, strict)
    else:
        _print(reports, errors, strict)
    return OK if not errors and all(r.ok(strict) for r in reports) else FAILED


def _require(junit: str | None, html: str | None) -> None:
    """Tells what is missing for the files before half a minute of work."""
    for option, file in (("--junit", junit), ("--html", html)):
        if file is not None and not Path(file).absolute().parent.is_dir():
            raise SceneError(f"{option} is {file}, but there is no folder {Path(file).parent}")
    if html is not None:
        from usersub.check.page import require

        require()


def _settings(
    rules: tuple[str, ...],
    skip_file: tuple[str, ...],
    expect_file: tuple[str, ...],
    props: str | None,
    **more: Any,
) -> dict[str, Any]:
    """Keyword arguments of `usersub.check.check`; warns of unknown rules in the files."""
    from usersub.check.numbers import numbers
    from usersub.check.runner import selected
    from usersub.check.running import expectations

    selected(rules or None)  # a mistyped rule is refused before anything is compiled
    lists = {
        "skip": [line for file in skip_file for line in expectations.read(file)],
        "expect": [line for file in expect_file for line in expectations.read(file)],
    }
    return {"props": numbers("--props", props), "rules": rules or None, **lists, **more}


# Running.


def _found(
    routines: Sequence[str],
    settings: dict[str, Any],
    jobs: int | None,
    with_figures: bool,
    quiet: bool,
) -> Found:
    """Reports of every routine. Several are checked at a time where that was asked for; with
    figures, which need the routine in this process, one after the other."""
    several = jobs is not None and jobs > 1 and len(routines) > 1 and not with_figures
    with _progress(quiet) as tell:
        if several:
            return _at_a_time(routines, settings, min(jobs or 1, len(routines)), tell)
        found: Found = {}
        for target in routines:
            told = partial(tell, Path(target).name)
            found[target] = _reports(target, {**settings, "jobs": jobs, "progress": told})
        return found


def _reports(target: str, settings: dict[str, Any]) -> list[Report] | Error:
    from usersub.check import check

    try:
        with redirect_stdout(sys.stderr):  # what a Python file prints when it is loaded
            return check(target, **settings)
    except Error as error:
        return error


def _at_a_time(
    routines: Sequence[str], settings: dict[str, Any], jobs: int, tell: Callable[..., None]
) -> Found:
    """Every routine in one of several processes, which share the cores."""
    from concurrent.futures import ProcessPoolExecutor, as_completed
    from multiprocessing import get_context

    settings = {**settings, "jobs": max(1, (os.cpu_count() or 1) // jobs)}
    found: Found = dict.fromkeys(routines, [])
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        waiting = {pool.submit(_reports, target, settings): target for target in found}
        for done, future in enumerate(as_completed(waiting), 1):
            target = waiting[future]
            found[target] = future.result()
            tell("", done, len(found), Path(target).name)
    return found


@contextmanager
def _progress(quiet: bool) -> Iterator[Callable[..., None]]:
    """One line on a terminal's standard error that is written again and again. No thread draws it:
    children are forked meanwhile."""
    if quiet or not sys.stderr.isatty():
        yield lambda *_: None
        return

    def tell(name: str, done: int, total: int, now: str) -> None:
        line = " ".join(filter(None, (f"{done}/{total}", name, now)))
        sys.stderr.write(f"\r\x1b[K{line[:78]}")
        sys.stderr.flush()

    try:
        yield tell
    finally:
        sys.stderr.write("\r\x1b[K")
        sys.stderr.flush()


# Printing.


def _write(reports: list[Report], junit: str | None, html: str | None, strict: bool) -> None:
    if junit is not None:
        from usersub.check.reports.junit import write as write_junit

        write_junit(reports, junit, strict)
    if html is not None:
        from usersub.check.page import write as write_page

        write_page(reports, html)


def _print(reports: list[Report], errors: dict[str, Error], strict: bool) -> None:
    for report in reports:
        click.echo(str(report))
        click.echo()
    for target, error in errors.items():
        click.echo(f"usersub check: {target}: {error}", err=True)
    if len(reports) + len(errors) < 2:
        return
    rows: list[tuple[str, ...]] = []
    for report in reports:
        counts = report.counts
        rows.append((
            relative(Path(report.head.file)) if report.head.file else report.head.routine,
            report.head.interface.upper(),
            report.head.precision,
            "ok" if report.ok(strict) else "FAILED",
            str(counts["pass"]),
            str(counts["fail"]),
            str(len(report.not_checked)),
            ", ".join(r.rule for r in report.failures if r.severity != "note"),
        ))  # fmt: skip
    rows += [(target, "", "", "FAILED", "", "", "", "cannot be loaded") for target in errors]
    columns = ("routine", "interface", "precision", "verdict", "passed", "failed", "not checked",
               "failures")  # fmt: skip
    print_table("", columns, rows, right=columns[4:7], wrap=("routine", "failures"))


def _print_json(found: Found, strict: bool) -> None:
    results, heads, errors = [], [], []
    for target, each in found.items():
        if isinstance(each, Error):
            errors.append({"target": target, "kind": type(each).__name__, "message": str(each)})
            continue
        for report in each:
            whole = report.as_dict()
            own = {"routine": report.head.routine, "file": report.head.file}
            results += [{**result, **own} for result in whole.pop("results")]
            heads.append({**whole, "ok": report.ok(strict)})
    print_json("check", results, reports=heads, errors=errors)


def _list(patterns: tuple[str, ...], as_json: bool) -> int:
    from usersub.check.runner import selected

    rules = selected(patterns or None)
    if as_json:
        rows = [
            {
                "rule": rule.id,
                "requirement": rule.requirement,
                "reference": rule.reference,
                "severity": rule.severity,
                "interfaces": list(rule.interfaces),
                "languages": list(rule.languages),
            }
            for rule in rules
        ]
        print_json("check", rows)
        return OK
    cells = [(r.id, r.severity, r.requirement, _about(r)) for r in rules]
    columns = ("rule", "severity", "requirement", "about")
    print_table("", columns, cells, wrap=columns[2:])
    return OK


def _about(rule: Any) -> str:
    from usersub import abi

    every = set(rule.interfaces) == set(abi.NAMES)
    names = "" if every else " ".join(name.upper() for name in rule.interfaces)
    return "; ".join(filter(None, (names, " ".join(rule.languages)))) or "all"
