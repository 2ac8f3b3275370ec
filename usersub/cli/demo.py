# SPDX-License-Identifier: MIT
"""`usersub demo`: problems with known answers through every interface, language and precision."""

from __future__ import annotations

import time
from typing import Any

import click

from usersub import abi
from usersub.cli.command import Examples, common
from usersub.cli.output import number, print_json, print_table, progress
from usersub.errors import Error, MissingTool

_LANGUAGES = ("python", "c", "fortran")
_PRECISIONS = ("double", "single")
_COLUMNS = (
    "problem",
    "law",
    "interface",
    "language",
    "precision",
    "method",
    "error of",
    "error",
    "tolerance",
    "ns/point",
    "",
)
_RIGHT = ("error", "tolerance", "ns/point")
FIELDS = (
    "problem",
    "law",
    "interface",
    "language",
    "precision",
    "method",
    "step",
    "points",
    "error",
    "error_of",
    "tolerance",
    "run_time_s",
    "ns_per_point",
)


@click.command(
    "demo",
    cls=Examples,
    examples=(
        "usersub demo",
        "usersub demo --language fortran --problem P1",
        "usersub demo --json",
    ),
)
@click.option("--problem", "problems", multiple=True, help="Only this problem (may be repeated).")
@click.option(
    "--interface",
    "interfaces",
    multiple=True,
    type=click.Choice(abi.NAMES, case_sensitive=False),
    help="Only this interface (may be repeated).",
)
@click.option(
    "--language",
    "languages",
    multiple=True,
    type=click.Choice(_LANGUAGES),
    help="Only this language (may be repeated).",
)
@click.option(
    "--precision",
    "precisions",
    multiple=True,
    type=click.Choice(_PRECISIONS),
    help="Only this precision (may be repeated).",
)
@click.option("--quick", is_flag=True, help="Fewer and shorter cases.")
@common("demo")
def command(
    problems: tuple[str, ...],
    interfaces: tuple[str, ...],
    languages: tuple[str, ...],
    precisions: tuple[str, ...],
    quick: bool,
    as_json: bool,
) -> int:
    """Run problems with known answers through every interface, language and precision.

    Prints one table: the error against the exact answer, the tolerance it has to keep and why a
    language is left out; exit code 0 if every line keeps its tolerance.
    """
    from usersub.problems import demo_cases

    begin = time.perf_counter()
    cases = demo_cases(quick=quick)
    _check_problems(problems, [case.problem for case in cases])
    wanted = {
        "problem": problems,
        "interface": interfaces,
        "language": languages,
        "precision": precisions,
    }
    cases = [c for c in cases if all(_chosen(getattr(c, k), v) for k, v in wanted.items())]
    if not cases:
        asked = ", ".join(f"--{k} {' '.join(v)}" for k, v in wanted.items() if v)
        raise click.UsageError(f"no case of the demo is all of {asked}")
    missing = _missing(sorted({case.language for case in cases}))
    rows = []
    with progress("demo", quiet=as_json) as tell:
        cases = [case for case in cases if case.language not in missing]
        for done, case in enumerate(cases):
            tell(done, len(cases), f"{case.problem} {case.interface} {case.language}")
            rows.append(_run(case))
    seconds = time.perf_counter() - begin
    ok = bool(rows) and all(row["ok"] for row in rows)
    if as_json:
        print_json("demo", rows, ok=ok, missing=missing, seconds=seconds)
    else:
        print_rows(rows)
        for language, sentence in missing.items():
            click.echo(f"left out: {language}: {sentence}")
        good = sum(row["ok"] for row in rows)
        click.echo(f"{good} of {len(rows)} cases within their tolerance, {seconds:.1f} s")
    return 0 if ok else 1


def _chosen(value: str, wanted: tuple[str, ...]) -> bool:
    return not wanted or value.lower() in [w.lower() for w in wanted]


def _check_problems(wanted: tuple[str, ...], known: list[str]) -> None:
    for name in wanted:
        if name.lower() not in [k.lower() for k in known]:
            names = ", ".join(dict.fromkeys(known))
            raise click.BadParameter(
                f"there is no problem '{name}'; problems: {names}", param_hint="--problem"
            )


def _missing(languages: list[str]) -> dict[str, str]:
    """Languages whose compiler is missing, with a sentence that says how to get it."""
    from usersub.routine import compilers

    found = {}
    for language in languages:
        if language == "python":
            continue
        try:
            compilers.find(language)
        except MissingTool as error:
            found[language] = str(error)
    return found


def _run(case: Any) -> dict[str, Any]:
    """One line of the table; a case that fails is a line that says why."""
    row: dict[str, Any] = {name: getattr(case, name, None) for name in FIELDS}
    try:
        outcome = case.run()
    except Error as error:
        return row | {"ok": False, "failure": f"{type(error).__name__}: {error}"}
    return row_of(outcome)


def row_of(outcome: Any) -> dict[str, Any]:
    """The line of one outcome; a NaN is within no tolerance."""
    row: dict[str, Any] = {name: getattr(outcome, name, None) for name in FIELDS}
    ok = bool(row["error"] <= row["tolerance"])
    return row | {"ok": ok, "failure": None, "says": getattr(outcome, "says", "")}


def print_rows(rows: list[dict[str, Any]]) -> None:
    """Prints one table, a line for each result, answers in words, and why cases failed."""
    cells = []
    for row in rows:
        numbers = ("", "", "")
        if row["failure"] is None:
            numbers = (
                number(row["error"], 2),
                number(row["tolerance"], 2),
                _nanoseconds(row["ns_per_point"]),
            )
        names = [row[k] or "" for k in FIELDS[:6]]
        verdict = "ok" if row["ok"] else "too large" if row["failure"] is None else "FAILED"
        names[2] = names[2].upper()
        cells.append((*names, row["error_of"], *numbers, verdict))
    styles = ["" if row["ok"] else "red" for row in rows]
    optional = ("error of", "tolerance", "law", "method")
    print_table("", _COLUMNS, cells, right=_RIGHT, optional=optional, styles=styles)
    for row in rows:
        if row["failure"] is not None:
            names = [str(row[k]) for k in FIELDS[:6]]
            click.echo(f"FAILED: {' '.join(names)}: {row['failure']}")
    for line in _answers(rows):
        click.echo(line)


def _answers(rows: list[dict[str, Any]]) -> list[str]:
    """What problems say whose answer is no number, each sentence once."""
    said: dict[tuple[str, str, str], int] = {}
    for row in rows:
        if row.get("says"):
            key = row["problem"], row["method"], row["says"]
            said[key] = said.get(key, 0) + 1
    return [
        f"{problem} {method}: {says} ({count} case{'s' if count > 1 else ''})"
        for (problem, method, says), count in said.items()
    ]


def _nanoseconds(value: float) -> str:
    return f"{value:.0f}" if value >= 100.0 else number(value, 3)
