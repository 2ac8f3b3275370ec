# SPDX-License-Identifier: MIT
"""`usersub fit`: properties of a law from measured coefficients."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from usersub.cli.command import Examples, common
from usersub.cli.output import number, print_facts, print_json, print_table

if TYPE_CHECKING:
    from usersub.laws.fitting import Fit


def _values(
    ctx: click.Context, parameter: click.Parameter, given: tuple[str, ...]
) -> dict[str, float | None]:
    """NAME=VALUE by name; a NAME alone is None."""
    found: dict[str, float | None] = {}
    for word in given:
        name, equals, value = word.partition("=")
        found[name.strip()] = _number(ctx, parameter, word, value) if equals else None
    return found


def _bounds(
    ctx: click.Context, parameter: click.Parameter, given: tuple[str, ...]
) -> dict[str, tuple[float | None, float | None]]:
    """NAME=LOW:HIGH by name; either may be left out."""
    found = {}
    for word in given:
        name, equals, rest = word.partition("=")
        low, colon, high = rest.partition(":")
        if not (equals and colon):
            raise click.BadParameter(f"'{word}'; expected NAME=LOW:HIGH", ctx, parameter)
        ends = [_number(ctx, parameter, word, x) if x.strip() else None for x in (low, high)]
        found[name.strip()] = (ends[0], ends[1])
    return found


def _number(ctx: click.Context, parameter: click.Parameter, word: str, value: str) -> float:
    try:
        return float(value)
    except ValueError:
        raise click.BadParameter(f"'{word}': '{value}' is no number", ctx, parameter) from None


@click.command(
    "fit",
    cls=Examples,
    examples=(
        "usersub fit exponential_decay measured.csv",
        "usersub fit stribeck measured.csv --fixed delta=1 --bound vs=1e-3:1",
    ),
)
@click.argument("law")
@click.argument("table", metavar="FILE", type=click.Path(path_type=Path))
@click.option(
    "--fixed",
    multiple=True,
    callback=_values,
    metavar="NAME[=VALUE]",
    help="Property that is not fitted; may be given more than once.",
)
@click.option("--start", multiple=True, callback=_values, metavar="NAME=VALUE", help="Start value.")
@click.option("--bound", multiple=True, callback=_bounds, metavar="NAME=LOW:HIGH", help="Bounds.")
@common("fit")
def command(
    law: str,
    table: Path,
    fixed: dict[str, float | None],
    start: dict[str, float | None],
    bound: dict[str, tuple[float | None, float | None]],
    as_json: bool,
) -> None:
    """Find the properties of LAW that fit the measured friction coefficients in FILE.

    FILE is a CSV file with a header: rate, pressure, temperature, mu, weight, field_1, ... (mu and
    what the law depends on). Prints the properties with their standard errors, and warns where the
    data do not determine one.
    """
    from usersub.laws import fit

    values = {name: value for name, value in fixed.items() if value is not None}
    values |= {name: value for name, value in start.items() if value is not None}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # they are printed below
        found = fit(law, table, fixed=list(fixed), start=values, bounds=bound)
    rows = list(_rows(found))
    if as_json:
        print_json(
            "fit", rows, law=found.law.name, props=found.props, rms=found.rms,
            degrees=found.degrees, covariance=found.covariance, names=found.names,
            warnings=found.warnings,
        )  # fmt: skip
        return
    cells = [
        (r["name"], number(r["value"], 10), "fixed" if r["fixed"] else number(r["error"], 3),
         r["unit"], r["meaning"])
        for r in rows
    ]  # fmt: skip
    columns = ("property", "value", "standard error", "unit", "meaning")
    print_table("", columns, cells, right=("value", "standard error"), wrap=("meaning",))
    print_facts(
        [("rms of residuals", number(found.rms)), ("degrees of freedom", found.degrees),
         ("in Python", found.law)]
    )  # fmt: skip
    for sentence in found.warnings:
        click.echo(f"warning: {sentence}")


def _rows(found: Fit) -> Any:
    props = {p.name: p for p in found.law.law.props}
    for name, value in found.parameters.items():
        prop = props[name.partition("[")[0]]
        yield {
            "name": name, "value": value, "error": found.errors[name], "unit": prop.unit,
            "fixed": name not in found.names, "meaning": prop.meaning,
        }  # fmt: skip
