# SPDX-License-Identifier: MIT
"""What FRIC of a law has to give, in arbitrary precision, independent of all adapters.

Coefficient and strength laws: penalty enforcement with elastic slip, isotropic on scaled
quantities where there are two coefficients. Traction laws: backward Euler.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from types import SimpleNamespace

import reference
from mpmath import hypot, matrix, mp, mpf, norm

from usersub.laws import Law

#: Digits, and step of one-sided differences relative to the size of the variable.
DIGITS, STEP = 50, mpf(2) ** -75
#: Perturbation of the motion that rounding inside a stable algorithm amounts to.
ROUNDING = mpf(2) ** -50

VARIABLES = ("motion 1", "motion 2", "pressure", "temperature")


@dataclass(frozen=True)
class Increment:
    """Motion in two directions and everything else that an increment is told."""

    motion: tuple[mpf, mpf]
    pressure: mpf
    temperature: mpf
    fields: tuple[mpf, ...]
    time_increment: mpf

    def moved(self, variable: str, step: mpf) -> Increment:
        """The increment with one variable larger by `step`."""
        if variable.startswith("motion"):
            axis = int(variable[-1]) - 1
            motion = tuple(x + step * (i == axis) for i, x in enumerate(self.motion))
            return replace(self, motion=motion)
        return replace(self, **{variable: getattr(self, variable) + step})


@dataclass(frozen=True)
class Memory:
    """What a point keeps: elastic slip and scalar state."""

    elastic: tuple[mpf, mpf] = (mpf(0), mpf(0))
    state: tuple[mpf, ...] = ()


@dataclass(frozen=True)
class End:
    """What an increment ends with; `tangent[variable]` is the derivative of tau."""

    tau: tuple[mpf, mpf]
    dslip: tuple[mpf, mpf]
    memory: Memory
    sticks: bool
    tangent: dict[str, tuple[mpf, mpf]] = field(default_factory=dict)

    @property
    def sed(self) -> mpf:
        return sum(t * e for t, e in zip(self.tau, self.memory.elastic, strict=True)) / 2

    @property
    def sfd(self) -> mpf:
        return sum(t * s for t, s in zip(self.tau, self.dslip, strict=True))


class ReturnMap:
    """FRIC of one law with its properties and its allowable elastic slip.

    With one friction direction the first of two coefficients is the only one.
    """

    def __init__(self, law: Law, props: list[mpf], allowable: mpf, directions: int):
        self.law, self.props, self.allowable = law, props, allowable
        self.coefficients = directions if law.anisotropic else 1

    def end(self, start: Memory, increment: Increment) -> End:
        """The end of an increment, without tangent."""
        if self.law.kind == "traction":
            return self._viscous(start, increment)
        predictor = tuple(a + b for a, b in zip(start.elastic, increment.motion, strict=True))
        return self._penalty(start, increment, predictor)

    def with_tangent(self, start: Memory, increment: Increment) -> End:
        """The end of an increment with its derivatives, from above."""
        here = self.end(start, increment)
        tangent = {}
        for variable in VARIABLES:
            step = STEP * self._size(start, increment, variable)
            there = self.end(start, increment.moved(variable, step)).tau
            tangent[variable] = tuple((b - a) / step for a, b in zip(here.tau, there, strict=True))
        return replace(here, tangent=tangent)

    def moved(self, start: Memory, increment: Increment) -> Iterator[Increment]:
        """Increments with a motion that is rounded: no algorithm can tell them from the given."""
        for axis in ("motion 1", "motion 2"):
            yield increment.moved(axis, ROUNDING * self._size(start, increment, axis))

    def _size(self, start: Memory, increment: Increment, variable: str) -> mpf:
        if variable.startswith("motion"):
            predictor = [a + b for a, b in zip(start.elastic, increment.motion, strict=True)]
            return max(norm(matrix(predictor)), norm(matrix(increment.motion)), self.allowable)
        return max(abs(getattr(increment, variable)), mpf(1))

    def _value(self, start: Memory, increment: Increment, slip: mpf) -> tuple[list, tuple]:
        """Coefficients (or strength, traction) and the state at a slip of the increment."""
        dt = increment.time_increment
        q = SimpleNamespace(
            slip_rate=slip / dt if dt > 0 else mpf(0),
            pressure=max(increment.pressure, mpf(0)),
            temperature=increment.temperature,
            fields=increment.fields,
            slip_increment=slip,
            time_increment=dt,
            state=start.state,
        )
        values, state = reference.point_values(self.law, q, self.props)
        return values[: self.coefficients], tuple(state)

    def _viscous(self, start: Memory, increment: Increment) -> End:
        x, y = increment.motion
        length = hypot(x, y)
        (traction,), state = self._value(start, increment, length)
        along = (x / length, y / length) if length > 0 else (mpf(0), mpf(0))
        tau = (traction * along[0], traction * along[1])
        return End(tau, (x, y), Memory(state=state), sticks=False)

    def _penalty(self, start: Memory, increment: Increment, g: tuple[mpf, mpf]) -> End:
        """g is the elastic predictor."""
        share = self._plastic_share(start, increment, g)
        strength, a, plastic, state = self._trial(start, increment, g, share)
        scaled = hypot(a[0] * g[0], a[1] * g[1])
        size = scaled if share > 0 else self.allowable
        tau = tuple(strength * a[i] ** 2 * g[i] / size for i in (0, 1))
        elastic = tuple(x - y for x, y in zip(g, plastic, strict=True))
        return End(tau, plastic, Memory(elastic, state), sticks=share == 0)

    def _trial(self, start: Memory, increment: Increment, g: tuple, share: mpf) -> tuple:
        """Strength, scaling, plastic slip and state when `share` of the predictor is plastic. A
        direction without friction beside one that has some is plastic as a whole."""
        plastic = tuple(share * x for x in g)
        values, state = self._value(start, increment, hypot(*plastic))
        free = [len(values) == 2 and v == 0 and any(values) for v in values]
        if any(free):
            plastic = tuple(x if f else share * x for x, f in zip(g, free, strict=True))
            values, state = self._value(start, increment, hypot(*plastic))
        return *self._strength(values, increment), plastic, state

    def _strength(self, values: list[mpf], increment: Increment) -> tuple[mpf, tuple[mpf, mpf]]:
        """Critical shear stress, and by how much each direction is scaled."""
        p = max(increment.pressure, mpf(0))
        if self.law.kind == "strength":
            return values[0], (mpf(1), mpf(1))
        mean = sum(values) / len(values)
        if len(values) == 1 or mean == 0:
            return mean * p, (mpf(1), mpf(1))
        return mean * p, (values[0] / mean, values[1] / mean)

    def _excess(self, start: Memory, increment: Increment, g: tuple, share: mpf) -> mpf:
        """What is wrong with a plastic share: that which it leads to, less itself."""
        _, a, _, _ = self._trial(start, increment, g, share)
        scaled = hypot(a[0] * g[0], a[1] * g[1])
        made = 1 - self.allowable / scaled if scaled > self.allowable else mpf(0)
        return made - share

    def _plastic_share(self, start: Memory, increment: Increment, g: tuple) -> mpf:
        """The share of the predictor that is plastic, bracketed where it is implicit."""
        low, high, f_low, f_high = mpf(0), mpf(1), mpf(0), mpf(0)
        f_low = self._excess(start, increment, g, low)
        if f_low <= 0:
            return low
        if self.coefficients == 1:
            return f_low
        f_high = self._excess(start, increment, g, high)
        x, kept = f_low, 0
        while high - low > mpf(10) ** (5 - mp.dps):
            f = self._excess(start, increment, g, x)
            if f == 0:
                return x
            # False position; the end that stays counts half (Illinois).
            if f > 0:
                low, f_low = x, f
                f_high = f_high / 2 if kept > 0 else f_high
                kept = 1
            else:
                high, f_high = x, f
                f_low = f_low / 2 if kept < 0 else f_low
                kept = -1
            before, x = x, low + (high - low) * f_low / (f_low - f_high)
            if abs(x - before) < mpf(10) ** (3 - mp.dps):
                return x
        return (low + high) / 2
