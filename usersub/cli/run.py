# SPDX-License-Identifier: MIT
"""`usersub run`: a scene file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from usersub.cli.command import Examples, common
from usersub.cli.demo import print_rows, row_of
from usersub.cli.output import number, print_json, print_table, progress, relative

#: Lines that are printed of a history: all up to so many, or a selection of so few.
_ALL, _LINES = 40, 24
_HIDDEN = ("sed", "sfd", "dslip", "stick_force", "force")


@click.command(
    "run",
    cls=Examples,
    examples=(
        "usersub run my_friction.toml",
        "usersub run my_friction.toml --plan",
        "usersub run my_friction.toml --json",
    ),
)
@click.argument("scene", type=click.Path(path_type=Path))
@click.option("--plan", "show_plan", is_flag=True, help="Print what is passed to the routine.")
@click.option("--all", "everything", is_flag=True, help="Print every increment and every column.")
@common("run")
def command(scene: Path, show_plan: bool, everything: bool, as_json: bool) -> int:
    """Run the scene file SCENE (TOML): a routine through a history or a problem.

    Prints the friction stress by increment and writes the files that the table [output] names.
    """
    from usersub.scenefile import run_scene

    with progress(scene.name, quiet=as_json) as tell:
        run = run_scene(scene, progress=tell)
    written = [relative(path) for path in run.written]
    if run.history is None:
        rows = [row_of(outcome) for outcome in run.problem]
        if as_json:
            print_json("run", rows, ok=run.ok, written=written)
        else:
            print_rows(rows)
    elif as_json:
        history = run.history
        print_json(
            "run",
            history.rows(),
            ok=run.ok,
            written=written,
            notes=history.notes,
            cut_backs=history.cut_backs,
            routine=history.routine,
            interface=history.interface,
            language=history.language,
            precision=history.precision,
        )
    else:
        _print_history(run.history, everything)
    if not as_json:
        if show_plan and run.plan:
            click.echo(f"\n{run.plan}")
        for path in written:
            click.echo(f"wrote {path}")
    return 0 if run.ok else 1


def _print_history(history: Any, everything: bool) -> None:
    rows = list(history.rows())
    shown = rows
    if not everything and len(rows) > _ALL:
        step = (len(rows) - 1) / (_LINES - 1)
        shown = [rows[round(i * step)] for i in range(_LINES)]
    names = [n for n in rows[0] if everything or not _hidden(n)]
    if history.points == 1:
        names.remove("point")
    title = f"{history.routine}: {history.interface.upper()}, {history.language}, "
    title += f"{history.precision} precision"
    cells = [
        [number(row[n]) if isinstance(row[n], float) else row[n] for n in names] for row in shown
    ]
    optional = ("dissipation", "normal_force", "increment", "pressure")
    print_table(title, names, cells, right=names, optional=optional)
    if len(shown) < len(rows):
        click.echo(f"{len(shown)} of {len(rows)} lines; --all prints every line and column")
    if history.cut_backs:
        click.echo(f"{history.cut_backs} increments were cut back and halved")
    for note in history.notes:
        click.echo(f"note: {note}")


def _hidden(name: str) -> bool:
    return name.rstrip("0123456789").rstrip("_") in _HIDDEN
