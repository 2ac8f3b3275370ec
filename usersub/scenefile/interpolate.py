# SPDX-License-Identifier: MIT
"""A history between its rows: linear in time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from usersub.scenefile.history import History

Pair = tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Row:
    """What a history says at one time: `[point]` or `[point, component]`."""

    time: float
    slip: np.ndarray
    pressure: np.ndarray
    normal_force: np.ndarray
    area: np.ndarray
    temperature: Pair | None
    fields: Pair | None
    stick_force: np.ndarray | None


def at(history: History, row: int, fraction: float) -> Row:
    """The history at `fraction` (0 to 1) between `row` and the next one; exact at both ends."""

    def between(array: np.ndarray) -> np.ndarray:
        if fraction == 0.0:
            return array[row]
        if fraction == 1.0:
            return array[row + 1]
        return array[row] + fraction * (array[row + 1] - array[row])

    def pair(arrays: Pair | None) -> Pair | None:
        return None if arrays is None else (between(arrays[0]), between(arrays[1]))

    return Row(
        time=float(between(history.time)),
        slip=between(history.slip),
        pressure=between(history.pressure),
        normal_force=between(history.normal_force),
        area=between(history.area),
        temperature=pair(history.temperature),
        fields=pair(history.fields),
        stick_force=None if history.stick_force is None else between(history.stick_force),
    )
