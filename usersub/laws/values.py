# SPDX-License-Identifier: MIT
"""Checks of the values that a user gives for the properties of a law."""

from __future__ import annotations

import difflib
import math
import numbers
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from usersub.errors import SceneError

if TYPE_CHECKING:
    from usersub.laws.description import Law
    from usersub.laws.parts import Prop


def hint(word: str, known: Sequence[str]) -> str:
    """ "; did you mean 'x'?", or the end of the sentence."""
    near = difflib.get_close_matches(word, known, n=1, cutoff=0.4)
    return f"; did you mean '{near[0]}'?" if near else "."


def number(law: Law, prop: Prop, value: object, place: str = "") -> float:
    """A number in its range; `place` is the index of an entry."""
    name = f"{law.name}: {prop.name}{place}"
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise SceneError(f"{name} = {value!r}; expected a real number")
    found = float(value)
    if not math.isfinite(found):
        raise SceneError(f"{name} = {found}; expected a finite number")
    if not prop.range.allows(found):
        raise SceneError(f"{name} = {found:g}; expected {prop.range} ({prop.meaning})")
    return found


def nested(law: Law, prop: Prop, value: Any) -> list:
    """Arrays, tuples and lists as (nested) lists."""
    if hasattr(value, "tolist"):  # numpy, which need not be imported for this
        value = value.tolist()
    if isinstance(value, str) or not isinstance(value, Sequence):
        raise SceneError(f"{law.name}: {prop.name} = {value!r}; expected an array ({prop.meaning})")

    def plain(part: Any) -> Any:
        part = part.tolist() if hasattr(part, "tolist") else part
        nested = isinstance(part, Sequence) and not isinstance(part, str)
        return [plain(p) for p in part] if nested else part

    return plain(value)


def _shape(value: Any) -> list[int] | None:
    """Shape of nested lists; None where they are ragged."""
    if not isinstance(value, list):
        return []
    shapes = [_shape(v) for v in value]
    if any(s is None or s != shapes[0] for s in shapes):
        return None
    return [len(value), *(shapes[0] or [])] if value else [0]


def _flat(value: Any) -> list:
    """The numbers of regular nested lists, first index fastest."""
    if not value or not isinstance(value[0], list):
        return value
    parts = [_flat(v) for v in value]
    return [part[j] for j in range(len(parts[0])) for part in parts]


def array(law: Law, prop: Prop, value: list, known: Mapping[str, object]) -> list[float]:
    """The numbers of an array, checked; the first index is the fastest."""
    name = f"{law.name}: {prop.name}"
    if prop.lists:
        for part in value:
            if _shape(part) is None or len(_shape(part) or []) != 1:
                raise SceneError(f"{name} has the entry {part!r}; expected a list of numbers")
            _check_order(law, prop, part)
        flat = [x for part in value for x in part]
    else:
        expected, shape = prop.extents(known), _shape(value)
        if shape is None:
            raise SceneError(f"{name} has rows of different lengths; expected shape {expected}")
        # A variable with a single point needs no axis of its own.
        if [n for n in shape if n != 1] != [n for n in expected if n != 1]:
            axes = " x ".join(prop.shape)
            raise SceneError(f"{name} has the shape {shape}; expected {expected} ({axes})")
        flat = _flat(value)
        while flat and isinstance(flat[0], list):
            flat = [x for part in flat for x in part]
        _check_order(law, prop, flat)
    return [number(law, prop, x, f"[{i}]") for i, x in enumerate(flat)]


def _check_order(law: Law, prop: Prop, values: list) -> None:
    if not prop.ascending:
        return
    for i, (a, b) in enumerate(zip(values, values[1:], strict=False), 1):
        if not b > a:
            raise SceneError(
                f"{law.name}: {prop.name}[{i}] = {b!r} follows {a!r}; expected ascending numbers"
            )


def unflat(flat: list, extents: Sequence[int]) -> list:
    """Nested lists of numbers that stand with the first index fastest."""
    if len(extents) < 2:
        return flat
    return [unflat(flat[i :: extents[0]], extents[1:]) for i in range(extents[0])]
