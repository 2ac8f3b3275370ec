# SPDX-License-Identifier: MIT
"""Inputs are the host's: they are read and not written."""

from __future__ import annotations

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.watching import watch
from usersub.check.rule import Finding, rule
from usersub.check.subject import Subject


@rule(
    "inputs.kept",
    "Inputs are not written to.",
    reference="arguments that the manual page lists as information passed in",
    cases=cases.everything,
)
def kept(subject: Subject, case: Case) -> Finding | None:
    """Inputs lie in memory that cannot be written."""
    found = watch(subject, case, ("input written",))
    if found is None:
        return None
    return found.finding("work on a copy: the host uses the same memory for other calls")
