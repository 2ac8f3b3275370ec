# SPDX-License-Identifier: MIT
"""A cell of the stability matrix, and a limit beside its theory."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

#: Verdicts, the best first. "fails" is what must never be; only a user's routine may have it.
VERDICTS = ("stable", "bounded", "refused", "fails")


@dataclass(frozen=True)
class Cell:
    """One stiff or extreme case, run through a real driver.

    Attributes:
        case: what is unusual: "pressure", "slip", "reversal" and so on (`cases.CASES`).
        value: how much, in words: "1e300 times the ordinary".
        subject: a law, "driver: " and an enforcement, or the name of a routine.
        interface, language, precision: how it was called.
        verdict: one of `VERDICTS`.
        reason: of "bounded" the growth, of "refused" the message, of "fails" what happened.
        increments: of how many increments all points together were asked.
    """

    case: str
    value: str
    subject: str
    interface: str
    language: str
    precision: str
    verdict: str
    reason: str = ""
    increments: int = 0

    def as_dict(self) -> dict[str, Any]:
        """All of it as plain data."""
        return asdict(self)


@dataclass(frozen=True)
class Limit:
    """A limit that was measured.

    Attributes:
        name: what is limited: "largest stable step".
        subject: driver or law.
        interface, language, precision: how it was called.
        measured: the number.
        theory: what it should be, None where there is no theory.
        unit: of both; "-" for a ratio or a count.
        words: what was done, and where the theory comes from.
    """

    name: str
    subject: str
    interface: str
    language: str
    precision: str
    measured: float
    theory: float | None
    unit: str
    words: str = ""

    @property
    def ratio(self) -> float | None:
        """Measured over theory; None without one, or where it is zero."""
        return self.measured / self.theory if self.theory else None

    def as_dict(self) -> dict[str, Any]:
        """All of it as plain data."""
        return {**asdict(self), "ratio": self.ratio}
