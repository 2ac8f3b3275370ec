# SPDX-License-Identifier: MIT
"""`usersub check-host`: does a host keep its side of the interface?"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from usersub.cli.abi import interface_name
from usersub.cli.command import Examples, common
from usersub.cli.output import print_json, print_table


def _names(ctx: click.Context, parameter: click.Parameter, values: tuple[str, ...]) -> tuple:
    return tuple(interface_name(ctx, parameter, value) for value in values)


@click.command(
    "check-host",
    cls=Examples,
    examples=(
        "usersub check-host -- ./my_host --library {probe} vfric",
        "usersub check-host -i fric -- ./solver_with_fric_linked_in input.dat",
        "usersub check-host --replace libmine.so -- ./host_that_opens_libmine",
    ),
)
@click.argument("command_line", nargs=-1, metavar="-- PROGRAM [ARGUMENT]...")
@click.option(
    "--interface", "-i", "interfaces", multiple=True, callback=_names,
    help="Interface that the host has to call (repeatable); by default those that it calls.",
)  # fmt: skip
@click.option(
    "--precision",
    type=click.Choice(["auto", "double", "single"]),
    default="auto",
    show_default=True,
    help="Precision of the explicit interfaces; auto looks at the length of the normals.",
)
@click.option(
    "--generation",
    type=click.Choice(["auto", "legacy", "2022"]),
    default="auto",
    show_default=True,
    help="Form of FRIC_COEF that the host speaks.",
)
@click.option(
    "--replace",
    default="",
    metavar="LIBRARY",
    help="The host opens this library (a path, or a file name): give it the probe instead.",
)
@click.option(
    "--preload/--no-preload",
    default=None,
    help="Load the probe in front of all libraries, for routines that are linked in. "
    "By default unless {probe} is in the command.",
)
@click.option(
    "--scenario",
    "scenarios",
    multiple=True,
    type=click.Choice(["plain", "multiplier", "cut-back"]),
    help="What the probe does (repeatable); by default all, one run of the host each.",
)
@click.option("--rule", "rules", multiple=True, metavar="ID", help="Only this rule (repeatable).")
@click.option("--list-rules", is_flag=True, help="List the rules and end.")
@click.option(
    "--time-limit",
    type=click.FloatRange(min=0.1),
    default=60.0,
    show_default=True,
    help="Seconds after which a run of the host is ended.",
)
@click.option(
    "--calls", type=click.IntRange(min=1), default=2000, show_default=True,
    help="Calls that are recorded at most.",
)  # fmt: skip
@click.option(
    "--points", type=click.IntRange(min=1), default=8, show_default=True,
    help="Contact points of FRIC and FRIC_COEF that are recorded at most.",
)  # fmt: skip
@click.option("--strict", is_flag=True, help="Failed warnings count as failures.")
@click.option(
    "--junit", type=click.Path(dir_okay=False, path_type=Path), help="Write a JUnit file as well."
)
@click.option(
    "--html", type=click.Path(dir_okay=False, path_type=Path), help="Write a page as well."
)
@common("check-host")
def command(
    command_line: tuple[str, ...],
    interfaces: tuple[str, ...],
    scenarios: tuple[str, ...],
    rules: tuple[str, ...],
    list_rules: bool,
    strict: bool,
    junit: Path | None,
    html: Path | None,
    as_json: bool,
    **settings: Any,
) -> int:
    """Check a host: run PROGRAM with a probe in place of a user's routine, and judge its calls.

    The probe is a shared library behind all five interfaces. Its path stands in place of {probe} in
    the arguments and in the environment variable USERSUB_PROBE; it is loaded in front of all other
    libraries, so that a program that is linked against a routine calls it.
    """
    from usersub.check.hosts import check
    from usersub.check.hosts.checking import SCENARIOS
    from usersub.check.hosts.running import Options

    if list_rules:
        return _list(as_json)
    if not command_line:
        raise click.UsageError("Missing the program: usersub check-host -- PROGRAM [ARGUMENT]...")
    if html is not None:
        from usersub.check import page

        page.require()

    def progress(scenario: str) -> None:
        if not as_json and sys.stderr.isatty():
            click.echo(f"running the host: {SCENARIOS[scenario]}", err=True)

    reports = check(
        command_line,
        interfaces=interfaces,
        scenarios=scenarios or tuple(SCENARIOS),
        rules=rules,
        options=Options(**settings),
        progress=progress,
    )
    ok = all(report.ok(strict) for report in reports)
    if junit is not None:
        from usersub.check.reports import junit as junit_files

        junit_files.write(reports, junit, strict)
    if html is not None:
        page.write(reports, html)
    if as_json:
        print_json("check-host", [report.as_dict() for report in reports], ok=ok)
    else:
        for report in reports:
            click.echo(str(report))
            click.echo()
    return 0 if ok else 1


def _list(as_json: bool) -> int:
    from usersub.check.hosts.judges import all_rules

    rows = [
        {
            "rule": rule.id,
            "severity": rule.severity,
            "interfaces": list(rule.interfaces),
            "requirement": rule.requirement,
            "reference": rule.reference,
            "needs": list(rule.needs),
        }
        for rule in all_rules().values()
    ]
    if as_json:
        print_json("check-host", rows)
        return 0
    cells = [(row["rule"], row["severity"], row["requirement"]) for row in rows]
    print_table("", ("rule", "severity", "what has to hold"), cells, wrap=("what has to hold",))
    return 0
