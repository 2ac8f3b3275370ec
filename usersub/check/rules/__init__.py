# SPDX-License-Identifier: MIT
"""The rules for routines, one module a group; the order here is the order in which they run."""

from __future__ import annotations

import importlib

from usersub.check.rule import RULES, Rule

_MODULES = (
    "signature",
    "symbols",
    "memory",
    "own_memory",
    "inputs",
    "outputs",
    "process",
    "data",
    "repeat",
    "threads",
    "blocks",
    "history",
    "present",
    "zero",
    "pressure",
    "bound",
    "frame",
    "slip",
    "multiplier",
    "energy",
    "tangent",
    "limits",
    "precision",
    "extremes",
    "law",
)


def all_rules() -> dict[str, Rule]:
    """Every rule by identifier, in the order in which they run."""
    for name in _MODULES:
        importlib.import_module(f"usersub.check.rules.{name}")
    order = {f"usersub.check.rules.{name}": place for place, name in enumerate(_MODULES)}
    made = sorted(RULES.values(), key=lambda rule: order.get(rule.look.__module__, len(order)))
    return {rule.id: rule for rule in made}
