# SPDX-License-Identifier: MIT
"""The conformance suite: does a routine, or a host, keep the contract of its interface?

    import usersub.check
    for report in usersub.check.check("my_fric.f90", props=[0.3]):
        print(report)

The same suite is `usersub check FILE` on the command line and `pytest --usersub-routine FILE`.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usersub.check.case import Case as Case
    from usersub.check.case import Step as Step
    from usersub.check.reports.report import Report as Report
    from usersub.check.reports.report import Result as Result
    from usersub.check.rule import Finding as Finding
    from usersub.check.rule import Rule as Rule
    from usersub.check.rules import all_rules as all_rules
    from usersub.check.runner import check as check
    from usersub.check.running.reproduce import reproduce as reproduce
    from usersub.check.subject import Subject as Subject

_HOME = {
    "Case": "case",
    "Finding": "rule",
    "Report": "reports.report",
    "Result": "reports.report",
    "Rule": "rule",
    "Step": "case",
    "Subject": "subject",
    "check": "runner",
    "all_rules": "rules",
    "reproduce": "running.reproduce",
}

__all__ = [
    "Case",
    "Finding",
    "Report",
    "Result",
    "Rule",
    "Step",
    "Subject",
    "all_rules",
    "check",
    "reproduce",
]


def __getattr__(name: str) -> object:
    if name not in _HOME:
        raise AttributeError(f"module 'usersub.check' has no attribute '{name}'")
    return getattr(importlib.import_module(f"usersub.check.{_HOME[name]}"), name)
