# SPDX-License-Identifier: MIT
"""*AMPLITUDE: time curves that *CHANGE FRICTION refers to."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from usersub.deck.words import (
    Parameters,
    Where,
    choose,
    entries,
    real,
    refuse,
    show,
    written,
    written_name,
)
from usersub.interaction.amplitude import Amplitude as Curve
from usersub.interaction.amplitude import value_at

#: Parameters of *AMPLITUDE.
KINDS = {
    "NAME": "name",
    "DEFINITION": "name",
    "TIME": "name",
    "VALUE": "name",
    "INPUT": "path",
    "SMOOTH": "real",
    "SHIFTX": "real",
    "SHIFTY": "real",
    "SCALEX": "real",
    "SCALEY": "real",
    "BEGIN": "real",
    "FIXED INTERVAL": "real",
    "VARIABLES": "whole",
    "PROPERTIES": "whole",
}
_DEFINITIONS = (
    "TABULAR",
    "SMOOTH STEP",
    "ACTUATOR",
    "BUBBLE",
    "DECAY",
    "EQUALLY SPACED",
    "MODULATED",
    "PERIODIC",
    "PSD DEFINITION",
    "SOLUTION DEPENDENT",
    "SPECTRUM",
    "USER",
)
_READ = ("TABULAR", "SMOOTH STEP")


@dataclass(frozen=True)
class Amplitude:
    """A time curve.

    Attributes:
        name: its name.
        definition: "TABULAR", "SMOOTH STEP" or another one, of which nothing is kept.
        points: pairs of time and value, times ascending.
        total_time: whether the times are total times.
        absolute: whether the values are absolute.
        problem: why the curve cannot be used; "" where it can.
        where: its line.
    """

    name: str
    definition: str = "TABULAR"
    points: tuple[tuple[float, float], ...] = ()
    total_time: bool = False
    absolute: bool = False
    problem: str = field(default="", compare=False)
    where: Where = field(default=Where("deck", 0), compare=False)

    def __str__(self) -> str:
        line = f"*AMPLITUDE, NAME={written_name(self.name)}, DEFINITION={self.definition}"
        line += ", TIME=TOTAL TIME" * self.total_time + ", VALUE=ABSOLUTE" * self.absolute
        data = [f"{written(t)}, {written(v)}" for t, v in self.points]
        return "\n".join([line, *data])

    def value(self, time: float) -> float:
        """The curve at a time: constant outside its points; smooth steps have no slope or
        curvature at theirs."""
        return value_at(self.points, time, smooth=self.definition == "SMOOTH STEP")

    def curve(self) -> Curve:
        """The curve by which friction changes.

        Raises:
            DeckError: friction cannot change by it; the message says why.
        """
        if self.unfit:
            refuse(self.where, f"the amplitude '{self.name}': {self.unfit}")
        return Curve(self.points, smooth=self.definition == "SMOOTH STEP")

    @property
    def unfit(self) -> str:
        """Why ``*CHANGE FRICTION`` cannot use the curve; "" where it can."""
        if self.problem:
            return self.problem
        if self.definition not in _READ:
            return f"it is of DEFINITION={self.definition}, expected TABULAR or SMOOTH STEP"
        if self.absolute:
            return "its values are absolute, expected relative ones"
        if self.total_time:
            return "its times are total times, expected times of the step"
        values = [v for _, v in self.points]
        if min(values) < 0.0 or max(values) > 1.0:
            return "its values leave the range from 0 to 1"
        if any(b < a for a, b in zip(values, values[1:], strict=False)):
            return "its values decrease, expected ascending ones"
        return ""


def amplitude(parameters: Parameters, data: Iterable[tuple[str, Where]], where: Where) -> Amplitude:
    """An amplitude from its block.

    A curve that is not understood is kept with its `problem`: most curves are those of loads, and
    only one that friction refers to matters.

    Raises:
        DeckError: it has no name.
    """
    name = parameters.get("NAME")
    if name is None:
        refuse(where, "*AMPLITUDE needs the parameter NAME")
    words = {
        "DEFINITION": (_DEFINITIONS, "TABULAR"),
        "TIME": (("STEP TIME", "TOTAL TIME"), "STEP TIME"),
        "VALUE": (("RELATIVE", "ABSOLUTE"), "RELATIVE"),
    }
    found = {}
    problem = ""
    for key, (choices, default) in words.items():
        given = parameters.get(key, default)
        word = choose(given, choices)
        if not isinstance(word, str):
            problem = problem or f"{where}: {key} = {show(given)} is not known"
            word = default
        found[key] = word
    for key in ("INPUT", "SHIFTX", "SHIFTY", "SCALEX", "SCALEY"):
        if key in parameters:
            problem = problem or f"{where}: {key} is given, which is not read"
    if parameters.unknown:
        problem = problem or f"{where}: the parameter {parameters.unknown[0]} is not known"
    points: list[tuple[float, float]] = []
    if not problem and found["DEFINITION"] in _READ:
        problem = _read_points(data, where, points)
    return Amplitude(
        name=name,
        definition=found["DEFINITION"],
        points=() if problem else tuple(points),
        total_time=found["TIME"] == "TOTAL TIME",
        absolute=found["VALUE"] == "ABSOLUTE",
        problem=problem,
        where=where,
    )


def _read_points(
    data: Iterable[tuple[str, Where]], where: Where, points: list[tuple[float, float]]
) -> str:
    """Reads the pairs of time and value; says what is wrong with them, or ""."""
    from usersub.errors import DeckError

    problem = ""
    for text, line in data:
        if problem:
            continue  # the block is read to its end all the same
        try:
            words = entries(text)
            if len(words) % 2:
                refuse(line, f"{len(words)} numbers, expected pairs of time and value")
            numbers = [real(word, line, "a time or value") for word in words]
            for time, value in zip(numbers[::2], numbers[1::2], strict=True):
                if points and time <= points[-1][0]:
                    refuse(line, f"the time {time:g} does not follow {points[-1][0]:g}")
                points.append((time, value))
        except DeckError as error:
            problem = str(error)
    return problem or ("" if points else f"{where}: it has no data")
