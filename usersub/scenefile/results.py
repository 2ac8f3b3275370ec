# SPDX-License-Identifier: MIT
"""What a history gave: one table of numbers by increment and contact point, and its files."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from usersub.errors import SceneError


@dataclass
class HistoryResult:
    """Results by increment.

    Attributes:
        routine, interface, language, precision: what was run.
        columns: name -> array `[increment]` (time), `[increment, point]` or
            `[increment, point, component]`.
        cut_backs: increments that were halved.
        notes: sentences that the reader has to know.
    """

    routine: str
    interface: str
    language: str
    precision: str
    columns: dict[str, np.ndarray]
    cut_backs: int = 0
    notes: list[str] = field(default_factory=list)

    def note_overflow(self) -> None:
        """Notes the columns that hold numbers beyond the range of double precision."""
        for name, array in self.columns.items():
            bad = ~np.isfinite(array.reshape(len(array), -1)).all(axis=1)
            if bad.any():
                self.notes.append(
                    f"{name} is not finite from increment {int(np.argmax(bad)) + 1} on: the "
                    "history's numbers are too large"
                )

    @property
    def increments(self) -> int:
        """Number of increments."""
        return len(self.columns["time"])

    @property
    def points(self) -> int:
        """Number of contact points."""
        return self.columns["tau"].shape[1]

    def flat(self) -> dict[str, np.ndarray]:
        """One column a component, each `[increment, point]`, under names such as `tau_1`."""
        shape = (self.increments, self.points)
        index = np.arange(1, self.increments + 1)[:, None]
        out = {"increment": np.broadcast_to(index, shape)}
        for name, array in self.columns.items():
            if array.ndim == 1:
                out[name] = np.broadcast_to(array[:, None], shape)
            elif array.ndim == 2:
                out[name] = array
            elif array.shape[2] == 1 and name != "state":
                out[name] = array[:, :, 0]
            else:
                out |= {f"{name}_{i + 1}": array[:, :, i] for i in range(array.shape[2])}
        return out

    def rows(self) -> Iterator[dict[str, Any]]:
        """One dictionary for each increment and point (from 0)."""
        flat = self.flat()
        for i in range(self.increments):
            for point in range(self.points):
                yield {"point": point} | {k: v[i, point].item() for k, v in flat.items()}

    def write_csv(self, path: Path) -> None:
        """Writes one line for each increment and point; reals with all their digits."""
        with _open(path, "w") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            for count, row in enumerate(self.rows()):
                if count == 0:
                    writer.writerow(row)
                writer.writerow(row.values())

    def write_npz(self, path: Path) -> None:
        """Writes the columns as they are."""
        with _open(path, "wb") as stream:
            np.savez(stream, **self.columns)  # type: ignore[arg-type]


@dataclass
class Columns:
    """Equally long one-dimensional columns, the first of which is the time: a problem's history."""

    title: str
    columns: dict[str, np.ndarray]

    def write_csv(self, path: Path) -> None:
        """Writes one line for each time."""
        with _open(path, "w") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(self.columns)
            columns = (np.asarray(c).tolist() for c in self.columns.values())
            writer.writerows(zip(*columns, strict=True))

    def write_npz(self, path: Path) -> None:
        """Writes the columns as they are."""
        with _open(path, "wb") as stream:
            np.savez(stream, **self.columns)  # type: ignore[arg-type]


def _open(path: Path, mode: str):
    try:
        if "b" in mode:
            return path.open(mode)
        return path.open(mode, encoding="utf-8", newline="")
    except OSError as error:
        raise SceneError(f"{path}: cannot be written: {error.strerror}") from error
