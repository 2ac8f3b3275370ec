# SPDX-License-Identifier: MIT
"""What the rules judge: the runs of a host, seen as the calls of one interface."""

from __future__ import annotations

from collections.abc import Hashable
from functools import cached_property

import numpy as np

from usersub.check.hosts.clock import clock
from usersub.check.hosts.history import Analysis, analyses, point_of
from usersub.check.hosts.log import ASSUMED, SEEN, Call
from usersub.check.hosts.running import Run
from usersub.check.rule import CannotCheck

#: Smallest relative differences that count as one, by precision: rounding of a host's own
#: arithmetic over a few operations, far below every mistake.
TOLERANCE = {False: 1e-9, True: 1e-4}


class Evidence:
    """The runs of a host for one interface.

    Attributes:
        interface: name of the interface.
        runs: every run, the plain one first.
        unseen: what the host did not do, so that a part of a rule could not be seen.
        remarks: what else the reader should know.
    """

    def __init__(self, interface: str, runs: list[Run]) -> None:
        self.interface = interface
        self.runs = runs
        self.unseen: list[str] = []
        self.remarks: list[str] = []

    @cached_property
    def calls(self) -> list[Call]:
        """All recorded calls of the interface, but for those before its precision was seen."""
        calls = [call for run in self.runs for call in run.log.of(self.interface)]
        seen = {call.single for call in calls if call.precision_basis == SEEN}
        if not seen:
            return calls
        return [c for c in calls if c.precision_basis != ASSUMED or c.single in seen]

    @property
    def precision_is_known(self) -> bool:
        """Whether the precision was told or seen, or is always the same."""
        return not self.calls or any(c.precision_basis != ASSUMED for c in self.calls)

    @cached_property
    def analyses(self) -> list[Analysis]:
        """The same, as analyses."""
        return analyses(self.calls)

    def of(self, scenario: str) -> Run | None:
        """The run of a scenario."""
        return next((run for run in self.runs if run.scenario == scenario), None)

    def say(self, sentence: str) -> None:
        """Notes something that could not be seen, once."""
        if sentence not in self.unseen:
            self.unseen.append(sentence)

    def need_calls(self) -> list[Call]:
        """The calls.

        Raises:
            CannotCheck: there are none.
        """
        if not self.calls:
            raise CannotCheck("the routine was not called")
        return self.calls


#: Contact points that are followed one by one; spread over the first call.
_FOLLOWED = 48


class Followed:
    """Which contact points of many are followed: their keys, chosen when they are first seen."""

    def __init__(self) -> None:
        self._keys: set[Hashable] = set()

    def among(self, keys: list[Hashable]) -> list[int]:
        """Positions of the followed ones."""
        free = _FOLLOWED - len(self._keys)
        if free > 0:
            fresh = [k for k in keys if k not in self._keys]
            if len(fresh) > free:
                fresh = [fresh[round(i * (len(fresh) - 1) / max(free - 1, 1))] for i in range(free)]
            self._keys.update(fresh)
        return [i for i, key in enumerate(keys) if key in self._keys]


def place(call: Call) -> str:
    """Where in the run a call is, for sentences."""
    when = clock(call)
    words = [f"call {call.sequence}"]
    inside = []
    if when is not None:
        inside.append(f"step {when.step}, increment {when.increment}")
    if call.face.key == "fric":
        inside.append(point_words(point_of(call)))
    elif call.face.key == "fric_coef_2022":
        inside.append(f"node {point_of(call)}")
    if call.scenario != "plain":
        inside.append(f"scenario {call.scenario}")
    if inside:
        words.append(f"({', '.join(inside)})")
    return " ".join(words)


def point_words(key: Hashable) -> str:
    """A point of FRIC in words."""
    if isinstance(key, tuple) and len(key) == 3:
        element, integration, node = key
        if element:
            return f"element {element}, integration point {integration}"
        return f"node {node}"
    return f"node {key}"


def number(value: float) -> str:
    """A number for a sentence."""
    return f"{value:.9g}"


def vector(values: np.ndarray) -> str:
    """A few numbers for a sentence."""
    return "(" + ", ".join(number(float(v)) for v in np.ravel(values)[:6]) + ")"


def same_bits(one: np.ndarray, two: np.ndarray) -> bool:
    """Whether two arrays hold the same values, bit for bit but for the sign of zero."""
    return one.shape == two.shape and bool(np.all((one == two) | (np.isnan(one) & np.isnan(two))))


def tolerance(call: Call) -> float:
    """Relative tolerance for what the host computed, in the precision of the call."""
    return TOLERANCE[call.single]
