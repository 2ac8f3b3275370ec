# SPDX-License-Identifier: MIT
"""Columns of a history: inline arrays, CSV and NPZ become arrays `[row, point, component]`."""

from __future__ import annotations

import csv
import re
import zlib
from dataclasses import dataclass
from pathlib import Path
from zipfile import BadZipFile, is_zipfile

import numpy as np

from usersub.errors import SceneError
from usersub.scenefile.tables import is_number, nearest, show


@dataclass(frozen=True)
class Column:
    """One quantity of a history: `width` names its number of components, `low` its lower bound."""

    name: str
    unit: str
    meaning: str
    width: str = "1"
    low: float | None = None


#: Every column of a history. Widths: "1", "F" friction directions, "P" field variables.
COLUMNS: tuple[Column, ...] = (
    Column("time", "time", "time at the end of a row; the first row is the start"),
    Column("slip", "length", "relative displacement of the surfaces since the start", "F"),
    Column("slip_increment", "length", "relative displacement since the row before", "F"),
    Column("pressure", "stress", "contact pressure; 0 where the surfaces are open", low=0.0),
    Column("normal_force", "force", "normal force of a point; 0 where open", low=0.0),
    Column("area", "area", "contact area of a point (default 1)", low=0.0),
    Column("temperature", "temperature", "temperature of both surfaces"),
    Column("temperature_secondary", "temperature", "temperature of the secondary surface"),
    Column("temperature_main", "temperature", "temperature of the main surface"),
    Column("field", "any", "field variables of both surfaces", "P"),
    Column("field_secondary", "any", "field variables of the secondary surface", "P"),
    Column("field_main", "any", "field variables of the main surface", "P"),
    Column("stick_force", "force", "force that would stop the slip (explicit)", low=0.0),
)
NAMES = {c.name: c for c in COLUMNS}

_HEADER = re.compile(r"^([A-Za-z_]+?)(?:_(\d+))?(?:\[(\d+)\])?$")


class Source:
    """Arrays under column names, with the place they came from.

    `get(name, rows, points, width)` gives an array `[row, point, component]`.
    """

    where = ""

    def names(self) -> list[str]:
        """Column names that are given."""
        raise NotImplementedError

    def get(self, name: str, rows: int, points: int, width: int) -> np.ndarray:
        """The column, broadcast to `[rows, points, width]`."""
        raise NotImplementedError

    def time(self) -> np.ndarray:
        """The column `time`."""
        raise NotImplementedError

    def components(self, name: str) -> int:
        """How many components of the column are given."""
        raise NotImplementedError


class ArraySource(Source):
    """Columns from arrays: a number, `[row]`, `[row][component]`, `[row][point]` (quantities of one
    component) or `[row][point][component]`."""

    def __init__(self, where: str, arrays: dict[str, np.ndarray]) -> None:
        self.where, self._arrays = where, arrays

    def names(self) -> list[str]:
        return list(self._arrays)

    def time(self) -> np.ndarray:
        if self._arrays["time"].ndim != 1:
            raise SceneError(f"{self.where} time must be one array of numbers, one for each row")
        return self._arrays["time"]

    def components(self, name: str) -> int:
        array = self._arrays[name]
        return array.shape[-1] if array.ndim > 1 else 1

    def get(self, name: str, rows: int, points: int, width: int) -> np.ndarray:
        array = self._arrays[name]
        wide = NAMES[name].width != "1"
        if array.ndim == 1 and (not wide or width == 1):
            array = array[:, None, None]
        elif array.ndim == 2:
            array = array[:, None, :] if wide else array[:, :, None]
        elif array.ndim == 0 and not wide:
            array = array[None, None, None]
        fits = array.ndim == 3 and all(
            n in (full, 1) if axis < 2 else n == full
            for axis, (n, full) in enumerate(zip(array.shape, (rows, points, width), strict=True))
        )
        if not fits:
            raise SceneError(
                f"{self.where} {name} is {_shape_words(self._arrays[name].shape)}, expected "
                f"{_expected(name, rows, points, width)}"
            )
        return np.broadcast_to(array, (rows, points, width)).copy()


def _shape_words(shape: tuple[int, ...]) -> str:
    if len(shape) == 1:
        return f"an array of {shape[0]} numbers"
    return "x".join(map(str, shape)) or "a single number"


def _expected(name: str, rows: int, points: int, width: int) -> str:
    column = NAMES[name]
    if column.width == "1":
        return f"{rows} rows, or {rows} rows x {points} points, or one number"
    hint = ""
    if column.width == "F":
        hint = f" ({width} friction direction{'s' * (width > 1)}: see [scene] dimension)"
    elif column.width == "P":
        hint = " (see [scene] fields)"
    return f"{rows} rows x {width} components, or {rows} rows x {points} points x {width}{hint}"


class CsvSource(Source):
    """Columns from a CSV file whose header names them: `slip_2` is component 2 (from 1) of all
    points, `slip_2[0]` that of point 0 (from 0)."""

    def __init__(self, path: Path) -> None:
        self.where = str(path)
        header, self._values = _read_csv(path)
        self._cells: dict[str, dict[tuple[int, int | None], int]] = {}
        for place, text in enumerate(header):
            name, component, point = _parse_header(self.where, text)
            cells = self._cells.setdefault(name, {})
            if (component, point) in cells:
                raise SceneError(f"{self.where}: column '{text}' is given twice")
            cells[component, point] = place

    def names(self) -> list[str]:
        return list(self._cells)

    def time(self) -> np.ndarray:
        place = self._cells["time"].get((1, None))
        if place is None or len(self._cells["time"]) > 1:
            raise SceneError(f"{self.where}: time must be one column for all points")
        return self._values[:, place]

    def components(self, name: str) -> int:
        return max(component for component, _ in self._cells[name])

    def get(self, name: str, rows: int, points: int, width: int) -> np.ndarray:
        cells = self._cells[name]
        for component, point in cells:
            if component > width:
                raise SceneError(
                    f"{self.where}: column '{name}_{component}' is one too many, the scene has "
                    f"{width} component{'s' * (width != 1)} of {name}"
                )
            if point is not None and point >= points:
                raise SceneError(
                    f"{self.where}: column '{name}[{point}]' is of point {point}, but [scene] "
                    f"points = {points} (points count from 0)"
                )
        out = np.empty((rows, points, width))
        for component in range(1, width + 1):
            for point in range(points):
                place = cells.get((component, point), cells.get((component, None)))
                if place is None:
                    full = f"{name}_{component}" if width > 1 else name
                    raise SceneError(
                        f"{self.where}: column '{full}' or '{full}[{point}]' is missing"
                    )
                out[:, point, component - 1] = self._values[:, place]
        return out


def _parse_header(where: str, text: str) -> tuple[str, int, int | None]:
    """Name, component (from 1) and point (from 0, or None) of a CSV column."""
    if ";" in text or "\t" in text:
        raise SceneError(f"{where}: the header is '{text}'; columns are separated by commas")
    if _is_real(text):
        raise SceneError(
            f"{where}: the first line begins with the number {text}; expected a header that names "
            f"the columns, such as time, slip_1, pressure"
        )
    found = _HEADER.match(text)
    name = found.group(1).lower() if found else text.lower()
    if not found or name not in NAMES:
        hint = nearest(name, NAMES) or "."
        raise SceneError(
            f"{where}: unknown column '{text}'{hint} Columns: {', '.join(NAMES)}, with _1, _2 for "
            "components and [0], [1] for points"
        )
    component = int(found.group(2) or 1)
    if component < 1 or (component > 1 and NAMES[name].width == "1"):
        raise SceneError(f"{where}: column '{text}': {name} has no component {component}")
    return name, component, None if found.group(3) is None else int(found.group(3))


def _read_csv(path: Path) -> tuple[list[str], np.ndarray]:
    """Header and values of a CSV file; blank lines and lines that begin with # are left out."""
    header: list[str] = []
    values: list[list[float]] = []
    try:
        with path.open(newline="", encoding="utf-8-sig") as stream:
            reader = csv.reader(stream, skipinitialspace=True, strict=True)
            for cells in reader:
                if not any(c.strip() for c in cells) or cells[0].lstrip().startswith("#"):
                    continue
                if not header:
                    header = [c.strip() for c in cells]
                    for text in header:
                        _parse_header(str(path), text)
                    continue
                place = f"{path}:{reader.line_num}"
                if len(cells) != len(header):
                    raise SceneError(
                        f"{place}: {len(cells)} values, expected {len(header)} as in the header"
                    )
                values.append([_cell(place, h, c) for h, c in zip(header, cells, strict=True)])
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise SceneError(f"{path}: cannot be read as CSV: {_reason(error)}") from error
    if not values:
        raise SceneError(f"{path}: has no rows, expected a header line and at least two rows")
    return header, np.array(values)


def _cell(place: str, name: str, text: str) -> float:
    if not _is_real(text):
        raise SceneError(f"{place}: {name} = '{text.strip()}' must be a finite number")
    return float(text)


def _is_real(text: str) -> bool:
    """Whether `text` is a finite number as other programs write it: 1_0 is none."""
    try:
        return "_" not in text and is_number(float(text))
    except ValueError:
        return False


def read_npz(path: Path) -> ArraySource:
    """Columns from the arrays of an NPZ file; nothing in the file is executed."""
    arrays = {}
    refused = (OSError, ValueError, EOFError, KeyError, AttributeError, BadZipFile, zlib.error)
    try:
        if not is_zipfile(path) and path.is_file():
            raise BadZipFile("it is no archive of arrays as numpy.savez writes it")
        with np.load(path, allow_pickle=False) as stored:
            for name in stored.files:
                arrays[name] = stored[name]
    except refused as error:
        raise SceneError(f"{path}: cannot be read as NPZ: {_reason(error)}") from error
    for name, array in arrays.items():
        check_name(f"{path}:", name)
        if array.dtype.kind not in "fiu" or not np.all(np.isfinite(array)):
            raise SceneError(
                f"{path}: {name} is of type {array.dtype}, expected finite real numbers only"
            )
    return ArraySource(f"{path}:", {n: np.asarray(a, float) for n, a in arrays.items()})


def inline(where: str, given: dict[str, object]) -> ArraySource:
    """Columns that stand in the scene file itself."""
    arrays = {}
    for name, value in given.items():
        wrong = SceneError(
            f"{where} {name} = {show(value)} must be a finite number or an array of finite "
            "numbers in which all rows are equally long"
        )
        if not _all_numbers(value):
            raise wrong
        try:
            arrays[name] = np.array(value, dtype=float)
        except ValueError:
            raise wrong from None
    return ArraySource(where, arrays)


def _all_numbers(value: object) -> bool:
    if isinstance(value, list):
        return bool(value) and all(_all_numbers(v) for v in value)
    return is_number(value)


def check_name(where: str, name: str) -> None:
    """Refuses a name that is no column, with the nearest one."""
    if name not in NAMES:
        hint = nearest(name, NAMES) or "."
        raise SceneError(f"{where} unknown column '{name}'{hint} Columns: {', '.join(NAMES)}")


def _reason(error: BaseException) -> str:
    if isinstance(error, FileNotFoundError):
        return "there is no such file"
    text = getattr(error, "strerror", None) or str(error) or type(error).__name__
    return str(text).splitlines()[0]
