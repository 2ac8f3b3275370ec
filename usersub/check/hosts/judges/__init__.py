# SPDX-License-Identifier: MIT
"""The rules for hosts, one module a group; the order here is that of the report."""

from __future__ import annotations

import importlib

from usersub.check.hosts.rule import RULES, HostRule

_MODULES = (
    "calling",
    "counts",
    "arrays",
    "names",
    "nodes",
    "times",
    "multiplier",
    "start",
    "cut_back",
    "state",
    "axes",
    "force",
    "coefficient",
)


def all_rules() -> dict[str, HostRule]:
    """Every rule for hosts by identifier."""
    for name in _MODULES:
        importlib.import_module(f"{__name__}.{name}")
    return RULES
