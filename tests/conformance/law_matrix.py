# SPDX-License-Identifier: MIT
"""Every built-in law in every language, interface and precision, and those that a test run takes.

A report takes some seconds; all of them take half an hour on two cores. A test run takes each law
once, in a language, an interface and a precision that go round; USERSUB_EVERYTHING=1, and `python
-m tests.meta.table`, take all.
"""

from __future__ import annotations

import os
from dataclasses import dataclass

from usersub import abi, laws
from usersub.check.reports.report import Report, Result


@dataclass(frozen=True)
class Combination:
    """A law in a language, behind an interface in a precision."""

    law: str
    language: str
    interface: str
    precision: str

    @property
    def id(self) -> str:
        """Name for people."""
        return f"{self.law}-{self.language}-{self.interface}-{self.precision}"

    def report(self) -> Report:
        """The report of all rules."""
        from usersub.check import check

        (report,) = check(
            laws.path(self.law, self.language),
            law=self.law,
            interface=self.interface,
            precision=self.precision,
            jobs=1,
            seconds=600,
        )
        return report


def combinations() -> list[Combination]:
    """All of them."""
    return [
        Combination(name, language, interface, precision)
        for name in laws.LAWS
        for interface in laws.law(name).interfaces
        for precision in abi.interface(interface).precisions
        for language in laws.LANGUAGES
    ]


def everything() -> bool:
    """Whether a test run takes all that there is."""
    return os.environ.get("USERSUB_EVERYTHING", "") not in ("", "0")


def chosen() -> list[Combination]:
    """Those of a test run."""
    if everything():
        return combinations()
    languages = list(laws.LANGUAGES)
    found = []
    for i, name in enumerate(laws.LAWS):
        faces = laws.law(name).interfaces
        interface = faces[i // 2 % len(faces)]
        precisions = abi.interface(interface).precisions
        language = languages[i % len(languages)]
        found.append(Combination(name, language, interface, precisions[i // 3 % len(precisions)]))
    return found


def alarms(report: Report) -> list[Result]:
    """Failures of rules of severity "error" or "warning": all of them are false here."""
    return [r for r in report.results if r.verdict == "fail" and r.severity != "note"]


def unanswered(report: Report) -> list[Result]:
    """Rules that apply but gave no answer."""
    return [r for r in report.results if r.verdict == "skip"]
