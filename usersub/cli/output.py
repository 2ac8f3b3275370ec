# SPDX-License-Identifier: MIT
"""What commands print: tables and progress for people, one JSON object for programs."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

#: Columns of a table that is not printed on a terminal, wide enough that nothing is broken.
_WIDE = 250


def version() -> str:
    """Release of usersub, from the installed package."""
    from importlib.metadata import PackageNotFoundError
    from importlib.metadata import version as installed

    try:
        return installed("usersub")
    except PackageNotFoundError:
        return "not installed"


def plain(value: Any) -> Any:
    """`value` in types of JSON; NaN and infinity, which JSON does not have, become null."""
    if isinstance(value, dict):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    if isinstance(value, (str, bool, int)) or value is None:
        return value
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    if hasattr(value, "tolist"):  # numpy, which need not be imported for this
        return plain(value.tolist())
    return str(value)


def print_json(command: str, results: Iterable[dict[str, Any]], **more: Any) -> None:
    """Prints the one object `{"command", "version", "results": [...]}`, with `more` keys."""
    whole = {"command": command, "version": version(), "results": list(results), **more}
    click.echo(json.dumps(plain(whole), indent=1, allow_nan=False))


def console(error: bool = False) -> Any:
    """A rich console; without a terminal it is wide and without colours."""
    from rich.console import Console

    stream = sys.stderr if error else sys.stdout
    width = None if stream.isatty() else _WIDE
    return Console(file=stream, width=width, highlight=False, soft_wrap=False)


def print_table(
    title: str,
    columns: Sequence[str],
    rows: Iterable[Sequence[Any]],
    right: Sequence[str] = (),
    styles: Sequence[str] | None = None,
) -> None:
    """Prints a table; columns in `right` are right-aligned, `styles` has one style a row."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    look = {"title_justify": "left", "title_style": "bold", "box": box.SIMPLE_HEAD}
    table = Table(title=title or None, **look)
    for column in columns:
        table.add_column(column, justify="right" if column in right else "left", overflow="fold")
    for count, row in enumerate(rows):
        cells = [Text("" if c is None else str(c)) for c in row]
        table.add_row(*cells, style=styles[count] if styles else None)
    console().print(table)


def print_facts(facts: Iterable[tuple[str, Any]]) -> None:
    """Prints names and values in two columns."""
    from rich.table import Table
    from rich.text import Text

    grid = Table.grid(padding=(0, 2))
    grid.add_column(style="bold", no_wrap=True)
    grid.add_column(overflow="fold")
    for name, value in facts:
        grid.add_row(Text(name), Text(str(value)))
    console().print(grid)


def number(value: float, digits: int = 6) -> str:
    """A number for people."""
    return f"{value + 0.0:.{digits}g}"  # adding zero makes -0 a plain 0


@contextmanager
def progress(label: str, quiet: bool) -> Iterator[Callable[..., None]]:
    """Shows progress on stderr if that is a terminal and `quiet` is false.

    Gives a function `tell(done, total, text="")`.
    """
    if quiet or not sys.stderr.isatty():
        yield lambda done, total, text="": None
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    with Progress(
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
        console=console(error=True), transient=True,
    ) as bar:
        task = bar.add_task(label, total=None)

        def tell(done: int, total: int, text: str = "") -> None:
            bar.update(task, completed=done, total=total, description=f"{label} {text}".strip())

        yield tell


def relative(path: Path) -> str:
    """A path as short as it can be named from here."""
    try:
        return str(path.resolve().relative_to(Path.cwd()))
    except (ValueError, OSError):
        return str(path)
