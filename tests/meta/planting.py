# SPDX-License-Identifier: MIT
"""Routines that are broken on purpose, and healthy ones: what their files say of themselves.

The first comment of a file says what is wrong, and in lines of their own

    planted: RULE: REGEX      the rule that has to find it, and words of the finding
    props: 0.3, 1e-3          properties
    states: 1                 number of state variables; fields: 1 of field variables
    interface: NAME           where the file does not tell
    precision: single         precision in which it is checked (double)
    law: NAME                 the built-in law that it claims to be
    also: RULE                a rule that cannot but see it too; `energy.*` for a group. What is
                              done to foreign memory shows in whatever lies there

A healthy file has the same without `planted`.
"""

from __future__ import annotations

import fnmatch
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from usersub.check.reports.report import Report

HERE = Path(__file__).resolve().parent
LANGUAGES = {".c": "c", ".f90": "fortran", ".for": "fortran", ".f": "fortran", ".py": "python"}
_LINE = re.compile(
    r"^(?:/\* | \* |[!#] |C {5})(planted|props|states|fields|interface|precision|law|also): (.*)$",
    re.MULTILINE,
)
#: Verdicts that let a rule that is not meant stand: it may be unable to look at a broken routine.
_FAILS = "fail"


@dataclass(frozen=True)
class Planted:
    """A file and what it says of itself; `rule` is "" for a healthy one."""

    path: Path
    rule: str
    words: str
    options: dict[str, Any]
    precision: str
    also: tuple[str, ...]

    @property
    def language(self) -> str:
        """Language of the file."""
        return LANGUAGES[self.path.suffix]

    @property
    def id(self) -> str:
        """Name for people: folder and file."""
        return f"{self.path.parent.name}/{self.path.name}"

    def check(self, rules: list[str] | None = None, **options: Any) -> list[Report]:
        """The reports of the file with its properties, in its precision."""
        from usersub.check import check

        asked = {"precision": self.precision, "rules": rules, **self.options, **options}
        return check(self.path, **asked)

    def caught(self, reports: list[Report]) -> str:
        """The words in which its own rule found the fault.

        Raises:
            AssertionError: it did not, or in other words.
        """
        results = [r for report in reports for r in report.results if r.rule == self.rule]
        found = [r for r in results if r.verdict == _FAILS]
        said = "; ".join(f"{r.verdict}: {r.detail}" for r in results)
        assert found, f"{self.id}: {self.rule} did not fail: {said or 'it was not looked at'}"
        for result in found:
            if re.search(self.words, result.detail):
                return result.detail
        raise AssertionError(f"{self.id}: no '{self.words}' in '{found[0].detail}'")

    def others(self, reports: list[Report]) -> list[str]:
        """What other rules of severity "error" found that have nothing to find here."""
        return [
            f"{r.rule}: {r.detail}"
            for report in reports
            for r in report.results
            if r.verdict == _FAILS and r.severity == "error" and not self._may_fail(r.rule)
        ]

    def _may_fail(self, rule: str) -> bool:
        return rule == self.rule or any(fnmatch.fnmatch(rule, pattern) for pattern in self.also)


def read(path: Path) -> Planted:
    """What a file says of itself.

    Raises:
        ValueError: it does not say which rule has to find it, and lies among those that do.
    """
    said: dict[str, str] = {}
    also: list[str] = []
    for key, value in _LINE.findall(path.read_text(encoding="utf-8")):
        if key == "also":
            also.append(value.split()[0])
        else:
            said[key] = value
    rule, _, words = said.get("planted", "").partition(": ")
    if path.parent.parent.name == "planted" and rule != path.parent.name:
        raise ValueError(f"{path} names the rule '{rule}', expected that of its folder")
    options: dict[str, Any] = {}
    if "props" in said:
        options["props"] = [float(p) for p in said["props"].split(",")]
    options |= {key: int(said[key]) for key in ("states", "fields") if key in said}
    options |= {key: said[key] for key in ("law", "interface") if key in said}
    return Planted(path, rule, words, options, said.get("precision", "double"), tuple(also))


def files(folder: str) -> list[Planted]:
    """Every file in `planted` or `healthy`, in the order of their names."""
    found = (p for p in (HERE / folder).rglob("*") if p.suffix in LANGUAGES)
    return [read(path) for path in sorted(found)]
