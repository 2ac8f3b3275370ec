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
    return Console(file=stream, width=None if stream.isatty() else _WIDE, highlight=False)


def _show(renderable: Any) -> None:
    """Prints a table or grid; into a file or pipe without blanks at the ends of lines."""
    target = console()
    if target.is_terminal:
        target.print(renderable)
        return
    with target.capture() as captured:
        target.print(renderable)
    click.echo("\n".join(line.rstrip() for line in captured.get().splitlines()))


def print_table(
    title: str,
    columns: Sequence[str],
    rows: Iterable[Sequence[Any]],
    *,
    right: Sequence[str] = (),
    wrap: Sequence[str] = (),
    optional: Sequence[str] = (),
    styles: Sequence[str] = (),
) -> None:
    """Prints a table.

    Args:
        right: columns that are right-aligned.
        wrap: columns that may be broken over lines.
        optional: columns that are left out, one after another, on a terminal that is too narrow.
        styles: one style a row.
    """
    cells = [["" if c is None else str(c) for c in row] for row in rows]
    target, kept, left_out = console(), list(columns), []
    while True:
        places = [columns.index(name) for name in kept]
        shown = [[row[i] for i in places] for row in cells]
        table = _table(title, kept, shown, right, wrap, styles)
        candidates = [name for name in optional if name in kept]
        if not (target.is_terminal and candidates and _width(target, table) > target.width):
            break
        kept.remove(candidates[0])
        left_out.append(candidates[0])
    _show(table)
    if left_out:
        click.echo(f"left out for want of width: {', '.join(left_out)}")


def _width(target: Any, table: Any) -> int:
    return target.measure(table, options=target.options.update(width=10 * _WIDE)).maximum


def _table(
    title: str,
    columns: Sequence[str],
    rows: Sequence[Sequence[str]],
    right: Sequence[str],
    wrap: Sequence[str],
    styles: Sequence[str],
) -> Any:
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(
        title=title or None,
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
        collapse_padding=True,
        pad_edge=False,
    )
    for name in columns:
        table.add_column(
            name,
            justify="right" if name in right else "left",
            overflow="fold",
            no_wrap=name not in wrap,
        )
    for count, row in enumerate(rows):
        table.add_row(*map(Text, row), style=styles[count] if styles else None)
    return table


def print_facts(facts: Iterable[tuple[str, Any]]) -> None:
    """Prints names and values in two columns."""
    from rich.table import Table
    from rich.text import Text

    grid = Table.grid(padding=(0, 2))
    grid.add_column(style="bold", no_wrap=True)
    grid.add_column(overflow="fold")
    for name, value in facts:
        grid.add_row(Text(name), Text(str(value)))
    _show(grid)


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
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        console=console(error=True),
        transient=True,
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
