# SPDX-License-Identifier: MIT
"""A contact-point history: what happens to every point, row by row, checked and complete."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from usersub.scenefile.columns import NAMES, CsvSource, Source, inline, read_npz
from usersub.scenefile.tables import Table

#: Keys of [history] that are no columns: kind, default, meaning.
KEYS: dict[str, tuple[str, object, str]] = {
    "file": ("text", None, "CSV (.csv) or NPZ (.npz) file with columns, beside the scene file"),
    "substeps": ("int", 1, "increments for each row; values between rows are interpolated"),
    "cut_backs": ("int", 10, "how often an increment may be halved (standard)"),
    "iterations": ("int", 5, "iterations of an increment, at most, until LM settles (standard)"),
    "stick_stiffness": ("real", None, "stick force by penalty: force per slip (explicit)"),
    "mass": ("real", None, "stick force that stops a mass: mass times slip / dt^2 (explicit)"),
}

_EITHER = (("slip", "slip_increment"), ("pressure", "normal_force"))
_SIDES = ("temperature", "field")


@dataclass(frozen=True)
class History:
    """Columns of a history; arrays are `[row, point]` or `[row, point, component]`, in double.

    The first row is the start: its slip is the reference and its pressure tells which points are
    closed there. Increments lead from row to row.

    Attributes:
        time: `[row]`, strictly increasing.
        slip: accumulated relative displacement, zero in the first row.
        pressure, normal_force, area: `[row, point]`; force is pressure times area.
        temperature, fields: pair (secondary, main) of arrays, or None.
        stick_force: `[row, point]`, or None.
        substeps, cut_backs, iterations, stick_stiffness, mass: see `KEYS`.
    """

    time: np.ndarray
    slip: np.ndarray
    pressure: np.ndarray
    normal_force: np.ndarray
    area: np.ndarray
    temperature: tuple[np.ndarray, np.ndarray] | None = None
    fields: tuple[np.ndarray, np.ndarray] | None = None
    stick_force: np.ndarray | None = None
    substeps: int = 1
    cut_backs: int = 10
    iterations: int = 5
    stick_stiffness: float | None = None
    mass: float | None = None
    names: tuple[str, ...] = field(default=(), compare=False)

    @property
    def points(self) -> int:
        """Contact points."""
        return self.slip.shape[1]

    @property
    def directions(self) -> int:
        """Friction directions."""
        return self.slip.shape[2]


@dataclass(frozen=True)
class Given:
    """The table [history] as it was read, before the scene is known."""

    table: Table
    sources: tuple[Source, ...]
    values: dict[str, Any]

    @property
    def names(self) -> list[str]:
        """Columns that are given."""
        return [n for s in self.sources for n in s.names()]


def take_history(table: Table, folder: Path) -> Given:
    """Reads the table [history] and the file it names.

    Raises:
        SceneError: unknown, repeated or ill-formed columns and keys.
    """
    values = {k: table.take(k, kind, default) for k, (kind, default, _) in KEYS.items()}
    for key, least in (("substeps", 1), ("cut_backs", 0), ("iterations", 1)):
        if values[key] < least:
            raise table.error(f"{key} = {values[key]} must be at least {least}")
    for key in ("stick_stiffness", "mass"):
        if values[key] is not None and values[key] <= 0.0:
            raise table.error(f"{key} = {values[key]:g} must be positive")
    given = {n: table.take(n, "any") for n in NAMES if table.has(n)}
    table.finish()
    sources: list[Source] = [inline(f"{table.file}: {table.name}", given)]
    if values["file"] is not None:
        path = folder / str(values["file"])
        readers = {".csv": CsvSource, ".npz": read_npz}
        if path.suffix.lower() not in readers:
            raise table.error(f'file = "{values["file"]}" must end in .csv or .npz')
        sources.append(readers[path.suffix.lower()](path))
    twice = sorted(set(sources[0].names()) & set(sources[-1].names())) if sources[1:] else []
    if twice:
        raise table.error(f"gives '{twice[0]}' itself and in file = \"{values['file']}\"")
    _check_names(table, [n for s in sources for n in s.names()])
    return Given(table, tuple(sources), values)


def _check_names(table: Table, names: list[str]) -> None:
    """Refuses columns that are missing or that contradict each other."""
    if "time" not in names:
        raise table.error("needs the column 'time'")
    for pair in _EITHER:
        if all(n in names for n in pair):
            raise table.error(f"gives both '{pair[0]}' and '{pair[1]}'; expected one of them")
        if not any(n in names for n in pair):
            raise table.error(f"needs one of the columns '{pair[0]}' and '{pair[1]}'")
    for name in _SIDES:
        sides = [s for s in (f"{name}_secondary", f"{name}_main") if s in names]
        if name in names and sides:
            raise table.error(f"gives both '{name}' and '{sides[0]}'; expected one or the other")
        if len(sides) == 1:
            other = {"y": "main", "n": "secondary"}[sides[0][-1]]
            raise table.error(f"gives '{sides[0]}' but no '{name}_{other}'")


def complete(given: Given, points: int, directions: int, fields: int) -> History:
    """The history for a scene with these numbers of points, friction directions and fields.

    Raises:
        SceneError: a column does not fit the scene or holds a value that is refused.
    """
    of = {n: s for s in given.sources for n in s.names()}
    table, widths = given.table, {"1": 1, "F": directions, "P": fields}
    time = of["time"].time()
    if len(time) < 2 or np.any(np.diff(time) <= 0.0):
        raise table.error("time must hold at least two strictly increasing values")

    def get(name: str) -> np.ndarray | None:
        if name not in of:
            return None
        column = NAMES[name]
        array = of[name].get(name, len(time), points, widths[column.width])
        if column.low is not None and array.min() < column.low:
            raise table.error(f"{name} = {array.min():g} must not be below {column.low:g}")
        return array if column.width != "1" else array[:, :, 0]

    area = get("area")
    area = np.ones((len(time), points)) if area is None else area
    if area.min() <= 0.0:
        raise table.error(f"area = {area.min():g} must be positive")
    pressure, force = get("pressure"), get("normal_force")
    if pressure is None:
        pressure = force / area  # type: ignore[operator] # one of the two is given
    return History(
        time=time,
        slip=_slip(table, get("slip"), get("slip_increment")),
        pressure=pressure,
        normal_force=pressure * area if force is None else force,
        area=area,
        temperature=_sides(get, "temperature"),
        fields=_sides(get, "field"),
        stick_force=get("stick_force"),
        names=tuple(of),
        **{k: v for k, v in given.values.items() if k != "file"},
    )


def _slip(table: Table, slip: np.ndarray | None, increment: np.ndarray | None) -> np.ndarray:
    if slip is not None:
        return slip - slip[0]
    assert increment is not None  # one of the two is given
    if np.any(increment[0] != 0.0):
        raise table.error(
            f"slip_increment of the first row is {increment[0].ravel().tolist()}, expected 0: the "
            "first row is the start of the history"
        )
    return np.cumsum(increment, axis=0)


def _sides(get, name: str) -> tuple[np.ndarray, np.ndarray] | None:
    both = get(name)
    if both is not None:
        return both, both
    secondary, main = get(f"{name}_secondary"), get(f"{name}_main")
    return None if secondary is None else (secondary, main)


def check_stick(history: History, table: Table, explicit: bool) -> None:
    """Refuses rules for the stick force that contradict each other or that nobody would use."""
    rules = {
        "the column 'stick_force'": history.stick_force,
        "stick_stiffness": history.stick_stiffness,
        "mass": history.mass,
    }
    given = [name for name, value in rules.items() if value is not None]
    if given and not explicit:
        raise table.error(f"gives {given[0]}, which only VFRIC, VFRICTION and VFRIC_COEF know")
    if len(given) > 1:
        raise table.error(f"gives {given[0]} and {given[1]}; expected one rule for the stick force")
