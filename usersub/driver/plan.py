# SPDX-License-Identifier: MIT
"""Plans: what becomes of every argument of a routine in a scene, for people and programs."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple

from usersub.core import ffi, lib, text
from usersub.errors import SceneError

if TYPE_CHECKING:
    from usersub.driver.base import Driver


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


class PlanTime(NamedTuple):
    """Nanoseconds per contact point, measured in turns.

    Attributes:
        ns: with the plan.
        ns_full: with every argument passed, read or not.
    """

    ns: float
    ns_full: float


@dataclass(frozen=True)
class Plan:
    """The plan of a driver: its rows, contact points a call (`block`), threads, notes.

    `time` is there once it was measured.
    """

    title: str
    rows: tuple[PlanRow, ...]
    block: int
    threads: int
    notes: tuple[str, ...] = ()
    time: PlanTime | None = None
    _measure: Callable[[], tuple[float, float]] | None = field(
        default=None, repr=False, compare=False
    )

    def measure(self) -> Plan:
        """The same plan with `time`, of a driver with the arrays that are bound now.

        Twins of the driver are called in turns; its own arrays and state stay as they are.

        Raises:
            SceneError: an array that a call needs is not bound.
            RoutineError: the routine failed.
        """
        if self._measure is None:
            raise SceneError("this plan has no driver; expected one from `driver.plan`")
        return replace(self, time=PlanTime(*self._measure()))

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
                *self._time_in_words(),
            ]
        )

    def _time_in_words(self) -> tuple[str, ...]:
        if self.time is None:
            return ()
        ns, full = self.time
        return (
            f"time per contact point: {ns:.3g} ns, {full:.3g} ns if everything were passed "
            f"({full / ns:.2g} times as long)",
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


def plan_of(driver: Driver) -> Plan:
    """The plan of a driver with the arrays that are bound now."""
    rows = []
    row = ffi.new("usub_plan_row *")
    for index in range(lib.usub_plan_count(driver._handle)):
        driver._check(lib.usub_plan_get(driver._handle, index, row))
        used = None if row.read < 0 else bool(row.read)
        words = text(row.argument), text(row.what), text(row.why)
        rows.append(PlanRow(*words, used, row.bytes, row.bytes_full))
    title = (
        f"{driver._title} ({driver.routine.language}), {driver.kind} driver, "
        f"{driver.scene['precision']} precision, {driver.scene['points']} contact points"
    )

    def measured() -> tuple[float, float]:
        from usersub.driver import costs

        return costs.measure(driver)

    block, threads = lib.usub_plan_block(driver._handle), lib.usub_plan_threads(driver._handle)
    return Plan(title, tuple(rows), block, threads, driver._plan_notes(), _measure=measured)
