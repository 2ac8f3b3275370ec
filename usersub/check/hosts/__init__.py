# SPDX-License-Identifier: MIT
"""Rules for hosts: a probe in place of a user's routine records every call, and these judge.

    from usersub.check import hosts
    for report in hosts.check(["./my_host", "{probe}"]):
        print(report)

The same is `usersub check-host -- ./my_host args` on the command line.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usersub.check.hosts.checking import check as check
    from usersub.check.hosts.checking import judge as judge
    from usersub.check.hosts.rule import HostRule

_HOME = {"check": "checking", "judge": "checking"}

__all__ = ["check", "judge", "rules"]


def rules() -> dict[str, HostRule]:
    """Every rule for hosts by identifier."""
    from usersub.check.hosts.judges import all_rules

    return all_rules()


def __getattr__(name: str) -> object:
    if name not in _HOME:
        raise AttributeError(f"module 'usersub.check.hosts' has no attribute '{name}'")
    return getattr(importlib.import_module(f"usersub.check.hosts.{_HOME[name]}"), name)
