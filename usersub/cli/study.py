# SPDX-License-Identifier: MIT
"""`usersub study`: error against run time, stability on extreme cases, and what is left out."""

from __future__ import annotations

import sys
from contextlib import redirect_stdout
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from usersub import abi
from usersub.cli.command import FAILED, OK, Examples, common
from usersub.cli.interrupt import INTERRUPTED
from usersub.cli.output import progress
from usersub.cli.study_output import Found, print_found, print_found_json
from usersub.errors import MissingTool, SceneError

if TYPE_CHECKING:
    from usersub.cli.study_targets import Targets
    from usersub.study import Study

#: Of a run with its share of preparation and figures, the mean over all problems on a machine that
#: does nothing else; and minutes from which it is said how to take less.
_SECONDS, _LONG = 0.047, 3.0

_FIGURES, _PAGE = "figures", "study.html"


def _choice(names: tuple[str, ...]) -> click.Choice:
    return click.Choice(names, case_sensitive=False)


@click.command(
    "study",
    cls=Examples,
    examples=(
        "usersub study P2",
        "usersub study P5 P6 --interface vfric_coef --method penalty",
        "usersub study my_law.py",
        "usersub study my_law.f90 --law coulomb --props 0.3",
        "usersub study P13 --out again --compare study-P13",
        "usersub study --stability --language c",
        "usersub study --scheduler tcp://127.0.0.1:8786 --out everything",
    ),
)
@click.argument("targets", metavar="[PROBLEM|LAW|FILE]...", nargs=-1)
@click.option("--stability", is_flag=True, help="Only the stiff and extreme cases.")
@click.option("--interface", "-i", "interfaces", multiple=True, type=_choice(abi.NAMES),
              help="Only this interface (may be repeated, like all that follow up to "
              "--block).")  # fmt: skip
@click.option("--language", "languages", multiple=True, type=_choice(("python", "c", "fortran")),
              help="Shipped laws in this language.")  # fmt: skip
@click.option("--method", "methods", multiple=True,
              help="Methods whose name begins so, as in penalty.")  # fmt: skip
@click.option("--step", "steps", multiple=True, type=click.IntRange(1),
              help="Increments, instead of the problem's own.")  # fmt: skip
@click.option("--precision", "precisions", multiple=True, type=_choice(("double", "single")),
              help="Only this precision.")  # fmt: skip
@click.option("--block", "blocks", multiple=True, type=click.IntRange(1),
              help="Contact points a call.")  # fmt: skip
@click.option("--law", help="Shipped law that the routine of FILE claims to be.")
@click.option("--props", help="Properties of FILE, as in 0.3,1e-4; found out if not given.")
@click.option("--states", type=click.IntRange(0), help="State variables of FILE.")
@click.option("--fields", type=click.IntRange(0), help="Field variables of FILE.")
@click.option("--temperatures/--no-temperatures", default=None,
              help="Whether the scene of FILE has temperatures.")  # fmt: skip
@click.option("--repeats", type=click.IntRange(1), help="Runs of each point.  [default: 5]")
@click.option("--quick", is_flag=True, help="Fewer steps, in C alone, three runs.")
@click.option("--out", type=click.Path(file_okay=False, path_type=Path),
              help="Folder of the results; what it has is not run again.")  # fmt: skip
@click.option("--fresh", is_flag=True, help="Run again what the folder has.")
@click.option("--html", type=click.Path(dir_okay=False, path_type=Path),
              help="Write the page here, not into the folder.")  # fmt: skip
@click.option("--compare", type=click.Path(file_okay=False, path_type=Path),
              help="Say for every conclusion whether the study in this folder agrees.")  # fmt: skip
@click.option("--jobs", type=click.IntRange(1), default=1, show_default=True,
              help="Processes at a time; more than one disturb each other's times.")  # fmt: skip
@click.option("--scheduler", metavar="ADDRESS", help="Run on the workers of a Dask scheduler.")
@common("study")
def command(
    targets: tuple[str, ...],
    stability: bool,
    out: Path | None,
    html: Path | None,
    compare: Path | None,
    as_json: bool,
    **options: Any,
) -> int:
    """Measure error against run time of problems, laws, or a routine of your own.

    Each PROBLEM (P1, ...), each problem of a LAW, or the routine in FILE (Python, C, C++, Fortran)
    runs over interfaces, languages, methods, steps, precisions and blocks. Errors are against the
    exact answer; for a routine that claims no law, against itself with many more increments. Run
    times are medians of runs in turns. A FILE is also tried on stiff and extreme cases.

    The folder (study-PROBLEM by default) gets CSV, JSON, figures and one HTML page. A study that is
    interrupted goes on where it was when the command is given again.

    Two runs of one study have other run times. --compare tells which of their conclusions agree,
    with a folder of an earlier study of the same, and asks for no more runs than are missing.

    Exit code: 0 if all points ran and nothing failed, and nothing differs from --compare.
    """
    from usersub.cli import study_comparison, study_targets
    from usersub.study.threads import one_thread

    one_thread()  # before numpy is imported
    chosen = study_targets.read(targets, stability=stability, **options)
    _require(html)
    there = study_comparison.other(compare)
    folder = out or Path(study_targets.folder_name(chosen, stability, options["quick"]))
    found = Found()
    with redirect_stdout(sys.stderr):  # what a Python file prints when it is loaded
        _run(chosen, folder, stability, options, found, quiet=as_json)
    interrupted = found.study is not None and found.study.unfinished > 0
    if not interrupted:
        _write(found, folder, html)
        if there is not None:
            found.comparison = study_comparison.compared(found, there, folder)
    if as_json:
        print_found_json(found)
    else:
        print_found(found, folder)
    if interrupted:
        return INTERRUPTED
    agrees = found.comparison is None or found.comparison.agrees
    return OK if _well(found) and agrees else FAILED


def _require(html: Path | None) -> None:
    """Tells what is missing for the page before minutes of work."""
    if html is not None:
        if not html.absolute().parent.is_dir():
            raise SceneError(f"--html is {html}, but there is no folder {html.parent}")
        from usersub.study.canvas import require

        require()


# Running.


def _run(
    chosen: Targets, folder: Path, stability: bool, options: dict[str, Any], found: Found,
    quiet: bool,
) -> None:  # fmt: skip
    if not stability:
        found.study = _measure(chosen, folder, options, quiet)
        if found.study.unfinished:
            return
        found.savings = _savings(chosen, options, found, quiet)
    if stability or chosen.routine:
        _extremes(chosen, options, found, quiet)


def _measure(chosen: Targets, folder: Path, options: dict[str, Any], quiet: bool) -> Study:
    from usersub.study import points, study, timing

    axes = ("interfaces", "languages", "methods", "steps", "precisions", "blocks", "quick")
    grid = points(
        chosen.problems, chosen.laws, chosen.routine or None,
        **{name: options[name] for name in axes}, settings=chosen.settings,
    )  # fmt: skip
    repeats = options["repeats"] or (timing.QUICK if options["quick"] else timing.REPEATS)
    if not quiet:
        click.echo(_plan(len(grid), repeats, options), err=True)
    with progress("study", quiet) as tell:
        return study(
            grid, folder, repeats=repeats, jobs=options["jobs"],
            scheduler=options["scheduler"], fresh=options["fresh"],
            progress=lambda done, whole, p: tell(done, whole, f"{p.problem} {p.interface}"),
        )  # fmt: skip


def _plan(count: int, repeats: int, options: dict[str, Any]) -> str:
    """What is going to be done, about how long it takes, and how to take less."""
    minutes = count * repeats * _SECONDS / 60.0
    roughly = f"{minutes:.0f} minutes" if minutes >= 1.5 else "a minute or less"
    points = f"{count} point{'' if count == 1 else 's'}"
    words = f"study: {points}, {repeats} runs of each in turns: roughly {roughly}"
    if minutes < _LONG:
        return words
    less = ["names of problems or laws", "--interface, --language and --method"]
    less = ["--quick", *less] if not options["quick"] else less
    return f"{words}. Less with {', '.join(less)}; after Ctrl-C the same command goes on"


def _extremes(chosen: Targets, options: dict[str, Any], found: Found, quiet: bool) -> None:
    """The stiff and extreme cases: of the user's routines, or of laws and drivers."""
    from usersub.study import stability

    how = {"quick": options["quick"], "jobs": options["jobs"]}
    with progress("stability", quiet) as tell:
        for asked in chosen.for_stability(options):
            found.cells += stability.matrix(**asked, **how, progress=tell)
        if not (chosen.routine or chosen.laws):
            found.limits = stability.limits(**how, progress=tell)


def _savings(chosen: Targets, options: dict[str, Any], found: Found, quiet: bool) -> list[Any]:
    """Time and bytes a contact point with the plan and with everything passed."""
    from usersub.study import leaving_out

    rows: list[Any] = []
    with progress("left out", quiet) as tell:
        try:
            for asked in chosen.for_savings(found.results):
                rows += leaving_out.measure(
                    **asked, quick=options["quick"], progress=lambda words: tell(0, 0, words)
                )
        except MissingTool as error:
            found.missing.append(f"what is left out: {error}")
    return rows


def _well(found: Found) -> bool:
    """Whether all ran; a compiler that is missing is no fault."""
    broken = [r for r in found.results if r.refused and "install" not in r.refused]
    return (
        not broken
        and bool(found.cells or any(r.ran for r in found.results))
        and all(cell.verdict != "fails" for cell in found.cells)
    )


# Writing and printing.


def _write(found: Found, folder: Path, html: Path | None) -> None:
    """Figures and page; without matplotlib a sentence instead."""
    from usersub.study import charts, extremes, figures, page, pareto

    found.files = list(found.study.files) if found.study else []
    folder.mkdir(parents=True, exist_ok=True)
    parts = {"savings": found.savings, "cells": found.cells, "limits": found.limits}
    found.files.append(extremes.write(folder, parts))
    target = html or folder / _PAGE
    try:
        (folder / _FIGURES).mkdir(exist_ok=True)
        made = [
            *figures.pictures(pareto.fronts(found.results)), *charts.savings(found.savings),
            *charts.matrix(found.cells), *charts.limits(found.limits),
        ]  # fmt: skip
        found.files += figures.write(folder / _FIGURES, made)
        stamp = {**found.stamp, "date": date.today().isoformat()}
        page.write(target, found.results, stamp, **parts, missing=found.missing)
        found.files.append(target)
    except MissingTool as error:
        found.missing.append(f"figures and page: {error}")
