# SPDX-License-Identifier: MIT
"""`python -m usersub.problems`: how the errors of the problems fall when they are refined."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from usersub.errors import Error
from usersub.problems import convergence
from usersub.problems.convergence import Row

_HEADS = ("problem", "interface", "method", "error of", "steps", "error", "order")
_RIGHT = ("steps", "error", "order")


def text(rows: list[Row]) -> str:
    """The rows as a table for people."""
    lines = [_HEADS]
    for row in rows:
        order = "" if row.order is None else f"{row.order:.2f}"
        lines.append((row.problem, row.interface.upper(), row.method, row.quantity,
                      str(row.steps), f"{row.error:.3e}", order))  # fmt: skip
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "\n".join(
        "  ".join(
            cell.rjust(width) if head in _RIGHT else cell.ljust(width)
            for head, cell, width in zip(_HEADS, line, widths, strict=True)
        ).rstrip()
        for line in lines
    )


def write_page(path: str) -> None:
    """Measures everything, in all languages, and writes the documentation's page."""
    from usersub.problems.measured import measure
    from usersub.problems.page import page, stamp

    content = page(measure(), convergence.studies(), stamp())
    Path(path).write_text(content, encoding="utf-8")


def write_newton(path: str) -> None:
    """Runs Newton's method with all tangents and writes the documentation's page."""
    from usersub.problems import newton, newton_page
    from usersub.problems.page import stamp

    Path(path).write_text(newton_page.page(newton.runs(), stamp()), encoding="utf-8")


def main(arguments: list[str] | None = None) -> int:
    """Prints the table, or JSON, or writes the page; returns the exit status."""
    parser = argparse.ArgumentParser(
        prog="python -m usersub.problems", description="Orders of convergence of the problems."
    )
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print the rows as a JSON array")
    form.add_argument(
        "--markdown", metavar="FILE",
        help="measure all problems by every method and write the documentation's page",
    )  # fmt: skip
    form.add_argument(
        "--newton", metavar="FILE",
        help="run Newton's method with the tangents of the drivers and write the page about it",
    )  # fmt: skip
    asked = parser.parse_args(arguments)
    try:
        if asked.markdown:
            write_page(asked.markdown)
            return 0
        if asked.newton:
            write_newton(asked.newton)
            return 0
        rows = convergence.rows()
    except (Error, OSError) as error:
        print(f"python -m usersub.problems: {error}", file=sys.stderr)
        return 1
    print(json.dumps([row.as_dict() for row in rows], indent=1) if asked.json else text(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
