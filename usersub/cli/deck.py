# SPDX-License-Identifier: MIT
"""`usersub deck`: what an input deck says of friction."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from usersub.cli.command import Examples, common
from usersub.cli.output import print_facts, print_json, print_table

if TYPE_CHECKING:
    from usersub.deck import Deck, Friction


@click.command(
    "deck",
    cls=Examples,
    examples=("usersub deck model.inp", "usersub deck model.inp --dialect calculix --json"),
)
@click.argument("deck", metavar="FILE", type=click.Path(path_type=Path))
@click.option(
    "--dialect",
    type=click.Choice(["commercial", "calculix"]),
    default="commercial",
    show_default=True,
    help="Meaning of the second entry: slip rate, or stick slope (calculix).",
)
@click.option(
    "--solver",
    type=click.Choice(["standard", "explicit"]),
    help="Solver of the deck; by default that of its procedures.",
)
@common("deck")
def command(deck: Path, dialect: str, solver: str | None, as_json: bool) -> None:
    """Tell what the input deck FILE says of friction: interactions, laws, changes in steps.

    For each friction it says behind which interface it runs here, with which settings, or why not.
    What the manual excludes is an error with file, line and reason.
    """
    from usersub.deck import read

    found = read(deck, solver=solver, dialect=dialect)
    if as_json:
        print_json(
            "deck",
            _rows(found),
            path=found.path,
            dialect=found.dialect,
            solver=found.solver,
            steps=[asdict(step) for step in found.steps],
            amplitudes=[{**asdict(a), "unfit": a.unfit} for a in found.amplitudes],
            warnings=[{**asdict(note.where), "text": note.text} for note in found.warnings],
        )
        return
    _print(found)


def _rows(deck: Deck) -> list[dict[str, Any]]:
    """One row a friction: those of the model, of other owners, and the changes."""
    rows = []
    for one in deck.interactions:
        area = {"area": one.area, "user": one.user}
        rows.append(_row("interaction", one.name, 0, one.where, one.friction, **area))
    for other in deck.others:
        name = f"{other.owner} {other.elset}".strip()
        rows.append(_row("other", name, other.step, other.friction.where, other.friction))
    for change in deck.changes:
        kind = "redefinition" if change.redefined else "reset" if change.reset else "change"
        name = change.interaction or change.elset or ""
        more = {"amplitude": change.amplitude}
        rows.append(_row(kind, name, change.step, change.where, change.friction, **more))
    return rows


def _row(
    kind: str, name: str, step: int, where: Any, friction: Friction | None, **more: Any
) -> dict[str, Any]:
    row: dict[str, Any] = {"kind": kind, "name": name, "step": step, **asdict(where), **more}
    if friction is None:
        law = "a user routine as a whole" if more.get("user") else "frictionless"
        return {**row, "law": "original friction" if kind == "reset" else law}
    definition = asdict(friction)
    definition["law"] = {"type": type(friction.law).__name__, **definition["law"]}
    if friction.method is not None:
        definition["method"] = {"type": type(friction.method).__name__, **definition["method"]}
    reason = friction.not_runnable
    return {
        **row,
        "law": friction.describe(),
        "method": friction.describe_more(),
        "interface": friction.interface,
        "settings": None if reason else friction.scene_settings(),
        "not_runnable": reason,
        "friction": definition,
    }


def _print(deck: Deck) -> None:
    facts: list[tuple[str, Any]] = [("deck", deck.path), ("dialect", deck.dialect)]
    facts.append(("solver", deck.solver or "not told"))
    facts.append(("steps", len(deck.steps)))
    print_facts(facts)
    rows = _rows(deck)
    cells = []
    for row in rows:
        runs = row.get("interface", "").upper() or ("no" if row.get("not_runnable") else "")
        what = "" if row["kind"] == "interaction" else row["kind"]
        step = row["step"] or ""
        cells.append((row["name"], what, step, row["law"], row.get("method"), runs, row["line"]))
    if cells:
        columns = ("name", "what", "step", "law", "limits and enforcement", "runs", "line")
        wrap, optional = ("law", "limits and enforcement"), ("line", "step")
        print_table("", columns, cells, right=("line",), wrap=wrap, optional=optional)
    for row in rows:
        if row.get("not_runnable"):
            click.echo(f"{row['name']}, line {row['line']}, does not run: {row['not_runnable']}")
    for note in deck.warnings:
        click.echo(f"note: {note}")
