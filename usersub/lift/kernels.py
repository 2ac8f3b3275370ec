# SPDX-License-Identifier: MIT
"""What the routines of all interfaces share: small functions, and the parts of a law they call."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from numpy import empty

from usersub.lift.call import calls
from usersub.lift.description import BRISTLE, STRENGTH, TRACTION, Count, Description


def ratio(numerator, denominator):
    """Quotient, or zero where there is nothing to divide by."""
    return numerator / denominator if denominator > 0 else 0.0


def mean_at(first, second, i):
    """Mean of two surfaces at point i; an analytical main surface has one value for all."""
    return 0.5 * (first[i] + second[min(i, second.shape[0] - 1)])


def mean_fields(predef):
    """Means of the field variables of both surfaces."""
    field = empty(predef.shape[1])
    for j in range(field.shape[0]):
        field[j] = 0.5 * (predef[0, j] + predef[1, j])
    return field


def clear(statev):
    """State of a point that has been open: none."""
    for j in range(statev.shape[0]):
        statev[j] = 0.0


@dataclass(frozen=True)
class Parts:
    """A law as the routines use it.

    Attributes:
        law: the law.
        value, evaluate: its calls, see `call`.
        needed, scalars, vectors: functions of the properties: least number of them, numbers of
            scalar and vector state variables.
    """

    law: Description
    value: Callable
    evaluate: Callable
    needed: Callable
    scalars: Callable
    vectors: Callable

    @property
    def by_area(self) -> bool:
        """Whether the law gives a stress, which an area makes a force."""
        return self.law.kind in (STRENGTH, TRACTION, BRISTLE)

    def too_few(self, interface: str) -> str:
        """Message for a scene with too few properties."""
        return f"{self.law.name} behind {interface} has too few properties"

    def too_few_states(self, interface: str) -> str:
        """Message for a scene with too few state variables."""
        return f"{self.law.name} behind {interface} has too few state variables"


def parts(law: Description) -> Parts:
    """Makes the parts of a law."""
    value, evaluate = calls(law)
    counts = [_function(count) for count in (law.props, law.states, law.vectors)]
    return Parts(law, value, evaluate, *counts)


def _function(count: Count) -> Callable:
    """A number of properties or state variables as a function of the properties."""
    if callable(count):
        return count
    return lambda props: count
