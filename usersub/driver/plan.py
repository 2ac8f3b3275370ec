# SPDX-License-Identifier: MIT
"""Plans: what becomes of every argument of a routine in a scene, for people and programs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class PlanRow:
    """What becomes of one argument.

    Attributes:
        argument: newer spelling.
        what: "zero-copy", "gathered", "computed", "constant", "left out" or "output".
        why: one clause.
        used: whether the routine uses it; None if nobody knows (it is then passed).
        bytes: bytes per contact point that are passed.
        bytes_full: the same if everything were passed.
    """

    argument: str
    what: str
    why: str
    used: bool | None
    bytes: int
    bytes_full: int


@dataclass(frozen=True)
class Plan:
    """The plan of a driver: its rows, contact points a call (`block`), threads, notes."""

    title: str
    rows: tuple[PlanRow, ...]
    block: int
    threads: int
    notes: tuple[str, ...] = ()

    @property
    def bytes(self) -> int:
        """Bytes per contact point that are passed."""
        return sum(row.bytes for row in self.rows)

    @property
    def bytes_full(self) -> int:
        """Bytes per contact point if everything were passed."""
        return sum(row.bytes_full for row in self.rows)

    def explain(self) -> str:
        """The plan as a table: what is passed, what is left out and why, the bytes saved."""
        head = ("argument", "used", "what", "bytes", "of", "why")
        lines = [head, *(_cells(row) for row in self.rows)]
        widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
        table = [_line(line, widths) for line in lines]
        return "\n".join(
            [
                self.title,
                f"contact points a call: {self.block}, threads: {self.threads}",
                *self.notes,
                "",
                table[0],
                "-" * max(map(len, table)),
                *table[1:],
                "",
                f"bytes per contact point: {self.bytes} passed, "
                f"{self.bytes_full} if everything were passed",
            ]
        )

    def __str__(self) -> str:
        return self.explain()


def _cells(row: PlanRow) -> tuple[str, ...]:
    used = {True: "yes", False: "no", None: "?"}[row.used]
    return row.argument, used, row.what, str(row.bytes), str(row.bytes_full), row.why


def _line(cells: Iterable[str], widths: list[int]) -> str:
    numeric = (3, 4)
    padded = [
        cell.rjust(width) if i in numeric else cell.ljust(width)
        for i, (cell, width) in enumerate(zip(cells, widths, strict=True))
    ]
    return "  ".join(padded).rstrip()
