# SPDX-License-Identifier: MIT
"""What a study runs and what it finds: plain data, the same on every machine."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any

#: Values that an option of a point may have.
Plain = bool | int | float | str


@dataclass(frozen=True, order=False)
class Point:
    """One run of a study: data alone, to be sent to any process.

    Attributes:
        problem: name of a problem ("P1") or of a motion ("slide-hold-slide").
        law: shipped law, or law that the routine claims to be; "" if it claims none.
        routine: file of the user's routine, or "" for a shipped law.
        interface: one of the five, in small letters.
        language: "python", "c" or "fortran".
        precision: "double" or "single".
        method: host and enforcement, as the problem names them.
        step: how fine: the value of what `refined` names, or None where nothing refines.
        block: contact points of a call, or None for the problem's own.
        options: further options of the problem, (name, value), sorted by name: stiffnesses,
            elastic slips, state updates.
        settings: what the motions of a user's routine need (`motions.SETTINGS`), sorted.
        content: hash of the routine's file, so that a changed file is a new point; "" for a
            shipped law.
    """

    problem: str
    law: str
    routine: str
    interface: str
    language: str
    precision: str
    method: str
    step: int | None = None
    block: int | None = None
    options: tuple[tuple[str, Plain], ...] = ()
    settings: tuple[tuple[str, Plain], ...] = ()
    content: str = ""

    @property
    def key(self) -> str:
        """Name of the point in files: a hash of its content and of the release of usersub."""
        from usersub.study.stamp import version

        data = asdict(self)
        if self.content:
            data.pop("routine")  # where a file stands does not change what it computes
        text = json.dumps([version(), data], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:20]

    @property
    def refined(self) -> str:
        """What `step` counts: "increments", "contact points", ...; "" where nothing refines."""
        from usersub.study.ladders import refined

        return refined(self.problem, self.law, self.method)

    @property
    def series(self) -> tuple[object, ...]:
        """What is the same for all points of one curve: everything but step and block."""
        return (self.problem, self.law, self.routine, self.interface, self.language,
                self.precision, self.method, self.options)  # fmt: skip

    def as_dict(self) -> dict[str, Any]:
        """In types of JSON; `Point.of` reads it."""
        pairs = {"options": dict(self.options), "settings": dict(self.settings)}
        return {**asdict(self), **pairs}

    @classmethod
    def of(cls, data: Mapping[str, Any]) -> Point:
        """The point of `as_dict`."""
        names = {f.name for f in fields(cls)}
        given = {k: v for k, v in data.items() if k in names}
        pairs = {k: tuple(sorted(data[k].items())) for k in ("options", "settings")}
        return cls(**{**given, **pairs})


@dataclass(frozen=True)
class Result:
    """What one point gave. The keys of `usersub.problems.KEYS` come first, as in `Outcome`.

    Attributes:
        step: largest time increment, in seconds; nan if the point did not run.
        points: contact points a call.
        error: largest relative error of what `error_of` names; the same bits on every machine
            of one kind; nan if the point did not run.
        run_time_s: median of the repeats' wall times, without compilation and warm-up.
        ns_per_point: median of the repeats' times of a driver call over its contact points.
        run_time_low, run_time_high: quartiles of the wall times.
        repeats: wall times that were taken.
        increments: `Point.step`; of what `refined` names.
        block: `Point.block`.
        routine: file of the user's routine, or "".
        options: `Point.options`.
        key: `Point.key`.
        refused: why the point did not run; "" if it ran.
        reference: what the error is measured against: "exact", or a sentence.
        tolerance: error that the method allows at the problem's own step; nan if unknown.
        refined: `Point.refined`.
        says: the answer in words, of problems whose answer is no number.
    """

    problem: str
    law: str
    interface: str
    language: str
    precision: str
    method: str
    step: float
    points: int
    error: float
    error_of: str
    run_time_s: float
    ns_per_point: float
    run_time_low: float
    run_time_high: float
    repeats: int
    increments: int | None
    block: int | None
    routine: str
    options: tuple[tuple[str, Plain], ...]
    key: str
    refused: str = ""
    reference: str = "exact"
    tolerance: float = float("nan")
    refined: str = "increments"
    says: str = ""

    @property
    def ran(self) -> bool:
        """Whether there is an error and a run time."""
        return not self.refused

    @property
    def series(self) -> tuple[object, ...]:
        """What is the same for all results of one curve; `Point.series` of the point."""
        return (self.problem, self.law, self.routine, self.interface, self.language,
                self.precision, self.method, self.options)  # fmt: skip

    @property
    def label(self) -> str:
        """Method and options in words: "penalty, elastic slip 1e-06"."""
        return ", ".join([self.method, *(option_words(n, v) for n, v in self.options)])

    def as_dict(self) -> dict[str, Any]:
        """In types of JSON, the keys of all results first; `Result.of` reads it."""
        return {**asdict(self), "options": dict(self.options)}

    @classmethod
    def of(cls, data: Mapping[str, Any]) -> Result:
        """The result of `as_dict`; null is nan where a number is expected."""
        given = {f.name: data[f.name] for f in fields(cls) if f.name in data}
        for name in _NUMBERS:
            if given.get(name, 0.0) is None:
                given[name] = float("nan")
        return cls(**{**given, "options": tuple(sorted(data["options"].items()))})


_NUMBERS = (
    "step", "error", "run_time_s", "ns_per_point", "run_time_low", "run_time_high", "tolerance",
)  # fmt: skip


def option_words(name: str, value: Plain) -> str:
    """An option for people: `elastic slip 1e-06`."""
    words = name.replace("_", " ")
    if isinstance(value, bool):
        return words if value else f"no {words}"
    return f"{words} {value:g}" if isinstance(value, float | int) else f"{words} {value}"
