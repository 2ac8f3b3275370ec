# SPDX-License-Identifier: MIT
"""Cases in words, for people who have to look at them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usersub.check.case import Case, Step

#: Points that are written out; of more only the first is.
_SHOWN = 3
#: What the load of a step is called.
_LOAD = {"vfric": "normal force", "vfriction": "normal force"}
_PER_POINT = (
    ("stick", "stick force"),
    ("temperature", "temperatures (secondary, main)"),
    ("fields", "fields (secondary, main)"),
    ("multiplier", "multiplier"),
    ("area", "area"),
)


def case_in_words(case: Case, interface: str = "") -> str:
    """What happens in the case, one sentence an increment.

    Args:
        interface: name of the interface; it decides what the load is called.
    """
    n, steps = case.points, len(case.steps)
    points = "1 contact point" if n == 1 else f"{n} contact points"
    lines = [f"{points}, {_plural(case.directions, 'friction direction')}{_around(case)}:"]
    load = _LOAD.get(interface, "pressure")
    for index, step in enumerate(case.steps):
        mark = f"increment {index + 1}: " if steps > 1 else ""
        lines.append(mark + _step(step, load))
    return "\n".join(lines)


def _around(case: Case) -> str:
    parts = []
    if case.contact != "node-to-facet":
        parts.append(f"contact {case.contact}")
    if case.order is not None:
        parts.append(f"points in the order {_numbers([k + 1 for k in case.order])}")
    if case.angle:
        parts.append(f"directions turned by {case.angle:.6g} rad")
    if case.props is not None:
        parts.append(f"properties {_numbers(case.props)}")
    if case.state is not None:
        parts.append(f"initial state {_numbers(case.state)}")
    if case.names is not None and case.step_numbers is not None:
        parts += around_in_words(case.names, case.step_numbers)
    return "".join(f", {part}" for part in parts)


_NAMED = ("interaction", "secondary surface", "main surface")


def around_in_words(names: tuple[str, str, str], step_numbers: tuple[int, int]) -> list[str]:
    """Names and step numbers that are not the ordinary ones, one part each."""
    ordinary = ("CHECKED", "", "")
    parts = [
        f"{what} '{name}'"
        for what, name, usual in zip(_NAMED, names, ordinary, strict=True)
        if name != usual
    ]
    first, later = step_numbers
    if first != later:
        parts.append(f"step {later} from the second increment on")
    elif first != 1:
        parts.append(f"step {first}")
    return parts


def _step(step: Step, load: str) -> str:
    if all(c == 0.0 for motion in step.motion for c in motion):
        parts = ["no motion"]
    else:
        parts = [f"motion {_per_point([_numbers(m) for m in step.motion])}"]
    parts.append(f"{load} {_per_point([_number(p) for p in step.load])}")
    for name, words in _PER_POINT:
        values = getattr(step, name)
        if values is not None:
            parts.append(f"{words} {_per_point([_any(v) for v in values])}")
    parts.append(f"time increment {_number(step.dt)}")
    if step.iterations != 1:
        parts.append(f"{step.iterations} iterations")
    if step.cut_back:
        parts.append("thrown away (cut back)")
    return ", ".join(parts)


def _per_point(values: Sequence[str]) -> str:
    if len(values) == 1 or len(set(values)) == 1:
        return values[0]
    shown = "; ".join(values[:_SHOWN])
    return f"[{shown}{'; ...' if len(values) > _SHOWN else ''}]"


def _any(value: object) -> str:
    return _numbers(value) if isinstance(value, tuple) else _number(value)


def _numbers(values: Sequence) -> str:
    if len(values) == 1 and not isinstance(values[0], tuple):
        return _number(values[0])
    return "(" + ", ".join(_any(v) for v in values) + ")"


def _number(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _plural(count: int, word: str) -> str:
    return f"{count} {word}" if count == 1 else f"{count} {word}s"
