# SPDX-License-Identifier: MIT
"""Rules for hosts: one requirement each, judged from the recorded calls."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from usersub import abi
from usersub.check.rule import SEVERITIES, Finding

if TYPE_CHECKING:
    from usersub.check.hosts.evidence import Evidence

#: Interfaces whose routine gives a force in local axes.
FORCE = ("vfric", "vfriction")
COEFFICIENT = ("fric_coef", "vfric_coef")

#: What a rule about sizes, and one about the history of points, stands on.
SIZES = ("host.counts",)
HISTORY = ("host.counts", "host.nodes", "host.increments", "host.times")

Look = Callable[["Evidence"], Iterable[str | Finding]]


@dataclass(frozen=True)
class HostRule:
    """One requirement.

    Attributes:
        id: "host.name".
        requirement: what has to hold, one sentence.
        reference: where that stands, in words; says so if it is an assumption.
        severity: "error", "warning" or "note".
        interfaces: names of the interfaces that it is about.
        hint: what to change in the host, one sentence.
        needs: rules that have to hold before this one can tell anything that is true.
        look: gives findings or sentences, none if the rule holds; raises `NotApplicable` or
            `CannotCheck` of `usersub.check.rule`.
    """

    id: str
    requirement: str
    reference: str
    severity: str
    interfaces: tuple[str, ...]
    hint: str
    needs: tuple[str, ...]
    look: Look = field(repr=False)


#: Every rule for hosts by identifier.
RULES: dict[str, HostRule] = {}


def host_rule(
    id: str,
    requirement: str,
    *,
    reference: str,
    hint: str,
    severity: str = "error",
    interfaces: tuple[str, ...] = abi.NAMES,
    needs: tuple[str, ...] = (),
) -> Callable[[Look], Look]:
    """Makes a rule of a function that takes the evidence and yields what breaks the rule."""
    if severity not in SEVERITIES:
        raise ValueError(f"severity is '{severity}', expected one of {', '.join(SEVERITIES)}")

    def register(function: Look) -> Look:
        if id in RULES and RULES[id].look.__module__ != function.__module__:
            raise ValueError(f"rule '{id}' exists already")
        RULES[id] = HostRule(
            id, requirement, reference, severity, interfaces, hint, needs, function
        )
        return function

    return register
