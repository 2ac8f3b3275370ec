# SPDX-License-Identifier: MIT
"""Cases: short histories of contact points as plain data, so that they can be shown and kept."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

Numbers = tuple[float, ...]


@dataclass(frozen=True)
class Step:
    """One increment of all contact points. None stands for what the subject has by default.

    Attributes:
        motion: sliding motion (length) of each point, components in fixed tangential directions.
        load: contact pressure of each point, or normal force (VFRIC, VFRICTION).
        dt: time increment.
        stick: force that would stop the slip, of each point (explicit); None: more than friction.
        temperature: secondary and main surface temperature of each point.
        fields: field variables of each point, those of the secondary, then of the main surface.
        multiplier: constraint stress of each point (FRIC), components as `motion`.
        area: area of each point (explicit).
        iterations: how often the host iterates before it commits (standard).
        cut_back: whether the host throws the increment away instead of committing it (standard).
    """

    motion: tuple[Numbers, ...]
    load: Numbers
    dt: float = 0.25
    stick: Numbers | None = None
    temperature: tuple[tuple[float, float], ...] | None = None
    fields: tuple[tuple[Numbers, Numbers], ...] | None = None
    multiplier: tuple[Numbers, ...] | None = None
    area: Numbers | None = None
    iterations: int = 1
    cut_back: bool = False


@dataclass(frozen=True)
class Case:
    """A history of contact points.

    Attributes:
        steps: the increments.
        contact: kind of contact (explicit): "node-to-facet", "edge-to-edge", "analytical-rigid".
        order: order in which the points stand in the arrays; None: as they are.
        angle: by which the tangential directions of the model are turned (radian); motions and
            results stay in the turned directions, so a law without preferred direction gives the
            same numbers.
        props: properties; None: the subject's.
        state: initial state variables of every point; None: zeros.
        names: of the interaction, the secondary and the main surface; None: the subject's.
        step_numbers: number of the analysis step of the first increment, and of the others; None:
            the subject's.
    """

    steps: tuple[Step, ...]
    contact: str = "node-to-facet"
    order: tuple[int, ...] | None = None
    angle: float = 0.0
    props: Numbers | None = None
    state: Numbers | None = None
    names: tuple[str, str, str] | None = None
    step_numbers: tuple[int, int] | None = None

    @property
    def points(self) -> int:
        """Number of contact points."""
        return len(self.steps[0].load)

    @property
    def directions(self) -> int:
        """Number of friction directions."""
        return len(self.steps[0].motion[0])

    def but(self, **changes: Any) -> Case:
        """The same case but for the attributes given."""
        return replace(self, **changes)

    def only(self, points: Sequence[int]) -> Case:
        """The case with some of its points, in the order given."""

        def chosen(values: tuple | None) -> Any:
            return None if values is None else tuple(values[p] for p in points)

        per_point = ("motion", "load", "stick", "temperature", "fields", "multiplier", "area")
        steps = tuple(
            replace(s, **{name: chosen(getattr(s, name)) for name in per_point}) for s in self.steps
        )
        return replace(self, steps=steps, order=None)

    def as_json(self) -> str:
        """The case in one line; what is not set is left out."""
        whole = {k: v for k, v in asdict(self).items() if v is not None}
        whole["steps"] = [{k: v for k, v in s.items() if v is not None} for s in whole["steps"]]
        return json.dumps(whole)

    @staticmethod
    def from_json(text: str) -> Case:
        """The case that `as_json` wrote.

        Raises:
            ValueError: no such case; the message names the unknown key.
        """
        whole = json.loads(text)
        steps = tuple(_made(Step, step) for step in whole.pop("steps"))
        return _made(Case, {**whole, "steps": steps})

    def __repr__(self) -> str:
        return _short(self)


def _frozen(value: Any) -> Any:
    return tuple(_frozen(v) for v in value) if isinstance(value, list) else value


def _made(kind: type, values: dict[str, Any]) -> Any:
    known = {f.name for f in fields(kind)}
    unknown = set(values) - known
    if unknown:
        raise ValueError(
            f"{kind.__name__} has no '{sorted(unknown)[0]}'; it has {', '.join(sorted(known))}"
        )
    return kind(**{k: _frozen(v) for k, v in values.items()})


def _short(value: Any) -> str:
    """`Case(...)` with what differs from the defaults: Python that makes it again."""
    parts = []
    for f in fields(value):
        content = getattr(value, f.name)
        if content is None or content == f.default:
            continue
        shown = (
            "(" + "".join(f"{_short(s)}, " for s in content).rstrip() + ")"
            if f.name == "steps"
            else repr(content)
        )
        parts.append(f"{f.name}={shown}")
    return f"{type(value).__name__}({', '.join(parts)})"


def _repr_step(step: Step) -> str:
    return _short(step)


Step.__repr__ = _repr_step  # type: ignore[method-assign, assignment]


def one(*motions: Sequence[float], load: float = 1.0, **more: Any) -> Case:
    """A case of one point that makes the motions one after the other under one load."""
    steps = tuple(Step((tuple(map(float, m)),), (float(load),), **more) for m in motions)
    return Case(steps)
