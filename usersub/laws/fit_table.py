# SPDX-License-Identifier: MIT
"""Measured coefficients: columns by name from arrays, a mapping or a CSV file."""

from __future__ import annotations

import csv
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from usersub.errors import SceneError

#: Columns and what else they may be called.
COLUMNS = {
    "rate": ("slip_rate",),
    "pressure": ("p",),
    "temperature": ("T",),
    "mu": ("coefficient",),
    "weight": (),
}
#: Order of the columns of a plain array.
PLAIN = ("rate", "pressure", "temperature", "mu")


class Table:
    """Columns of equal length, double precision.

    Attributes:
        columns: by name: rate, pressure, temperature, mu, weight, field_1, field_2, ...
        rows: their length.
    """

    def __init__(self, columns: dict[str, np.ndarray]) -> None:
        self.columns = columns
        self.rows = len(columns["mu"])

    @property
    def fields(self) -> np.ndarray:
        """Field variables, shape (count, rows)."""
        found: list[np.ndarray] = []
        while f"field_{len(found) + 1}" in self.columns:
            found.append(self.columns[f"field_{len(found) + 1}"])
        return np.array(found).reshape(len(found), self.rows)

    def get(self, name: str) -> np.ndarray:
        """A column; zeros where the table has none (ones for weights)."""
        if name in self.columns:
            return self.columns[name]
        return np.full(self.rows, 1.0 if name == "weight" else 0.0)


def read(given: Any) -> Table:
    """The table of a CSV file (path), a mapping from name to column, or an array with the columns
    rate, pressure, temperature, mu.

    Raises:
        SceneError: a column is unknown, missing, of another length or holds what is no number.
    """
    if isinstance(given, (str, os.PathLike)):
        named: Mapping[str, Any] = _from_csv(Path(given))
    elif isinstance(given, Mapping) or hasattr(given, "columns"):  # a data frame
        named = {str(name): given[name] for name in given}
    else:
        array = np.asarray(given, dtype=float)
        if array.ndim != 2 or array.shape[1] != len(PLAIN):
            raise SceneError(
                f"the table has the shape {array.shape}; expected (rows, {len(PLAIN)}) with the "
                f"columns {', '.join(PLAIN)}, or a mapping from names to columns"
            )
        named = dict(zip(PLAIN, array.T, strict=True))
    columns: dict[str, np.ndarray] = {}
    for name, values in named.items():
        columns[_name(name)] = _column(name, values)
    if "mu" not in columns:
        raise SceneError(f"the table has the columns {', '.join(columns)}; expected 'mu' too")
    for name, column in columns.items():
        if len(column) != len(columns["mu"]):
            raise SceneError(
                f"column '{name}' has {len(column)} rows, 'mu' has {len(columns['mu'])}"
            )
    _check(columns)
    return Table(columns)


def _name(given: str) -> str:
    plain = given.strip()
    for name, others in COLUMNS.items():
        if plain == name or plain in others:
            return name
    if plain.startswith("field_") and plain[6:].isdecimal():
        return plain
    raise SceneError(
        f"the table has a column '{given}'; expected {', '.join(COLUMNS)}, field_1, field_2, ..."
    )


def _column(name: str, values: Any) -> np.ndarray:
    try:
        column = np.ascontiguousarray(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise SceneError(f"column '{name}' holds what is no number: {error}") from error
    if column.ndim != 1:
        raise SceneError(f"column '{name}' has the shape {column.shape}; expected (rows,)")
    bad = np.flatnonzero(~np.isfinite(column))
    if bad.size:
        raise SceneError(f"column '{name}', row {bad[0] + 1} is {column[bad[0]]}")
    return column


def _check(columns: Mapping[str, np.ndarray]) -> None:
    for name, column in columns.items():
        if name in ("rate", "pressure", "weight") and (column < 0).any():
            row = int(np.flatnonzero(column < 0)[0])
            raise SceneError(f"column '{name}', row {row + 1} is {column[row]:g}; expected >= 0")
    if len(columns["mu"]) == 0:
        raise SceneError("the table has no rows")


def _from_csv(path: Path) -> dict[str, Sequence[str]]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise SceneError(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise SceneError(f"{path}: is not UTF-8 text") from error
    lines = [x for x in text.splitlines() if x.strip() and not x.lstrip().startswith("#")]
    rows = list(csv.reader(lines, skipinitialspace=True))
    if not rows:
        raise SceneError(f"{path}: is empty; expected a header with names of columns, then numbers")
    head, body = [h.strip() for h in rows[0]], rows[1:]
    for number, row in enumerate(body, 1):
        if len(row) != len(head):
            raise SceneError(
                f"{path}: data row {number} has {len(row)} entries; expected {len(head)}"
            )
    return {name: [row[i] for row in body] for i, name in enumerate(head)}
