# SPDX-License-Identifier: MIT
"""Parts of a law's description: properties, their ranges, state variables, accuracy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from usersub.laws.counting import evaluate


@dataclass(frozen=True)
class Range:
    """Which values a property may have; None where there is no bound."""

    at_least: float | None = None
    above: float | None = None
    at_most: float | None = None
    below: float | None = None
    whole: bool = False
    choices: tuple[float, ...] = ()

    def allows(self, value: float) -> bool:
        """Whether `value` is inside (NaN is not)."""
        return (
            (self.at_least is None or value >= self.at_least)
            and (self.above is None or value > self.above)
            and (self.at_most is None or value <= self.at_most)
            and (self.below is None or value < self.below)
            and (not self.whole or value == int(value))
            and (not self.choices or value in self.choices)
        )

    def __str__(self) -> str:
        if self.choices:
            return "one of " + ", ".join(f"{v:g}" for v in self.choices)
        words = []
        if self.at_least is not None:
            words.append(f"at least {self.at_least:g}")
        if self.above is not None:
            words.append(f"above {self.above:g}")
        if self.at_most is not None:
            words.append(f"at most {self.at_most:g}")
        if self.below is not None:
            words.append(f"below {self.below:g}")
        text = " and ".join(words)
        return f"a whole number{', ' if text else ''}{text}" if self.whole else text


@dataclass(frozen=True)
class Prop:
    """One property or array of properties, in the order of `props`.

    Attributes:
        name: how it is called, also as an argument of a law object.
        unit, meaning: in words.
        range: values that it (or each entry of the array) may have.
        default: value where a user gives none; None: he has to give one.
        size_of: array whose length this is; a user does not give it.
        sizes_of: array of arrays whose lengths these are; a user does not give them.
        shape: expressions of earlier properties, first index fastest; () for one number.
        lists: whether a user gives it as a list of lists, which stand one after the other.
        ascending: whether the numbers of an array ascend.
        fitted: whether a fit may change it; a floor that keeps numbers finite is none.
    """

    name: str
    unit: str
    meaning: str
    range: Range = Range()
    default: float | tuple | None = None
    size_of: str = ""
    sizes_of: str = ""
    shape: tuple[str, ...] = ()
    lists: bool = False
    ascending: bool = False
    fitted: bool = True

    @property
    def given(self) -> bool:
        """Whether a user gives it (else it is counted)."""
        return not (self.size_of or self.sizes_of)

    def count(self, known: Mapping[str, object]) -> int:
        """How many numbers it takes, by the values of the properties before it."""
        return evaluate("*".join(f"({part})" for part in self.extents(known)), known)

    def extents(self, known: Mapping[str, object]) -> list[int]:
        """Its extents; [] for one number. "*sizes" stands for all numbers of `sizes`."""
        found: list[int] = []
        for part in self.shape:
            if part.startswith("*"):
                found += [int(v) for v in known[part[1:]]]  # type: ignore[attr-defined]
            else:
                found.append(evaluate(part, known))
        return found


@dataclass(frozen=True)
class Variable:
    """A symbol, or a state variable of which there are `count` (expression of properties)."""

    name: str
    unit: str
    meaning: str
    count: str = "1"


@dataclass(frozen=True)
class Accuracy:
    """What its results keep: units in the last place of a coefficient, strength or traction in
    double and in single precision, and `why` where these are more than the rule (2 and 4)."""

    ulp: float = 2.0
    single_ulp: float = 4.0
    why: str = ""
