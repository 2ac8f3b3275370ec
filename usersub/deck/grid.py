# SPDX-License-Identifier: MIT
"""Tables of decks as full grids.

In a deck each variable is interpolated within the points that it has there, so that a table need be
no full grid. Filled up with the values that the table has at the other points, it is one, and the
same function.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from usersub.deck.friction import Table

#: Largest table, in numbers, that an uneven grid is filled up to.
LARGEST = 1_000_000


@dataclass(frozen=True)
class Grid:
    """`axes`: points of slip rate, pressure, temperature, fields; `tables`: one for each
    coefficient, nested lists with the slip rate as the first index."""

    axes: list[list[float]]
    tables: list[Any]


def full_grid(table: Table) -> Grid | str:
    """The grid, or in one sentence why it would be too large."""
    places = [tuple(x or 0.0 for x in row.place) for row in table.rows]
    axes = [sorted(set(column)) for column in zip(*places, strict=True)]
    size = 1
    for axis in axes:
        size *= len(axis)
    count = len(table.rows[0].mu)
    if size * count > LARGEST:
        return f"the uneven table would need more than {LARGEST} numbers"
    tables = []
    for k in range(count):
        tree: dict = {}
        for place, row in zip(places, table.rows, strict=True):
            branch = tree
            for x in reversed(place[1:]):  # the last variable varies slowest
                branch = branch.setdefault(x, {})
            branch[place[0]] = row.mu[k]
        tables.append(_transposed(_filled(tree, axes[::-1])))
    return Grid(axes, tables)


def _filled(tree: Any, axes: Sequence[list[float]]) -> Any:
    """Nested lists over `axes` (the slowest first) of a tree with points of its own."""
    if not axes:
        return tree
    curve = {x: _filled(branch, axes[1:]) for x, branch in tree.items()}
    points = list(curve)  # they ascend, as the reader has seen to
    return [_at(curve, points, x) for x in axes[0]]


def _at(curve: dict[float, Any], points: list[float], x: float) -> Any:
    """Linear between the points of a curve, constant outside."""
    if x in curve:
        return curve[x]
    k = bisect_right(points, x)
    if k == 0 or k == len(points):
        return curve[points[max(k - 1, 0)]]
    low, high = points[k - 1], points[k]
    return _between(curve[low], curve[high], (x - low) / (high - low))


def _between(low: Any, high: Any, share: float) -> Any:
    if isinstance(low, list):
        return [_between(a, b, share) for a, b in zip(low, high, strict=True)]
    return low + (high - low) * share


def _transposed(nested: Any) -> Any:
    """The same numbers with the indices in the reverse order."""
    if not isinstance(nested, list) or not isinstance(nested[0], list):
        return nested
    parts = [_transposed(part) for part in nested]
    return _joined(parts)


def _joined(parts: list) -> Any:
    """Adds the list index as the last one."""
    if not isinstance(parts[0], list):
        return parts
    return [_joined([part[i] for part in parts]) for i in range(len(parts[0]))]
