# SPDX-License-Identifier: MIT
"""Reports as JUnit XML, in the form that pytest writes and that CI services read."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree

from usersub.check.reports.text import failure_lines
from usersub.check.rule import FAIL, PASS

if TYPE_CHECKING:
    from usersub.check.reports.report import Report, Result

#: Characters that XML 1.0 does not have.
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def write(reports: Iterable[Report], path: str | os.PathLike[str], strict: bool = False) -> None:
    """Writes the reports into one file, one test suite each."""
    Path(path).write_text(junit(reports, strict), encoding="utf-8")


def junit(reports: Iterable[Report], strict: bool = False) -> str:
    """The reports as XML.

    A rule that does not apply, could not be checked or failed as expected is a skipped test; a
    warning is a failed test only where `strict` is true, and else a passed one that says it.
    """
    suites = [_suite(report, strict) for report in reports]
    root = ElementTree.Element("testsuites", {"name": "usersub check", **_sums(suites)})
    root.extend(suites)
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n'


def _sums(suites: list[ElementTree.Element]) -> dict[str, str]:
    counts = {
        key: str(sum(int(s.get(key, "0")) for s in suites))
        for key in ("tests", "failures", "errors", "skipped")
    }
    return {**counts, "time": f"{sum(float(s.get('time', '0')) for s in suites):.3f}"}


def _suite(report: Report, strict: bool) -> ElementTree.Element:
    head = report.head
    suite = ElementTree.Element("testsuite", {"name": _clean(head.title)})
    properties = ElementTree.SubElement(suite, "properties")
    for name, value in head.facts():
        ElementTree.SubElement(properties, "property", {"name": name, "value": _clean(value)})
    cases = [_case(report, result, strict) for result in report.results]
    suite.extend(cases)
    suite.attrib |= {
        "tests": str(len(cases)),
        "failures": str(sum(c.find("failure") is not None for c in cases)),
        "errors": "0",
        "skipped": str(sum(c.find("skipped") is not None for c in cases)),
        "time": f"{report.seconds:.3f}",
        "timestamp": head.date,
        "hostname": "localhost",
    }
    return suite


def _case(report: Report, result: Result, strict: bool) -> ElementTree.Element:
    name = f"{report.head.routine}[{result.interface}-{result.precision}]"
    case = ElementTree.Element(
        "testcase",
        {
            "classname": _clean(name),
            "name": result.rule,
            "time": f"{result.seconds:.3f}",
        },
    )
    grave = result.severity == "error" or (strict and result.severity == "warning")
    if result.verdict == FAIL and result.expected:
        _child(case, "skipped", "usersub.expected", f"expected failure: {result.detail}")
    elif result.verdict == FAIL and grave:
        failure = _child(case, "failure", f"usersub.{result.severity}", result.detail)
        failure.text = _clean("\n".join(failure_lines(result)))
    elif result.verdict == FAIL:
        said = ElementTree.SubElement(case, "system-out")
        said.text = _clean("\n".join(failure_lines(result)))
    elif result.verdict == PASS and result.expected:
        words = "it was expected to fail, but passed: take it off the list"
        _child(case, "failure", "usersub.unexpected-pass", words).text = words
    elif result.verdict != PASS:
        _child(case, "skipped", f"usersub.{result.verdict}", result.detail)
    return case


def _child(case: ElementTree.Element, tag: str, kind: str, message: str) -> ElementTree.Element:
    return ElementTree.SubElement(case, tag, {"type": kind, "message": _clean(message)})


def _clean(text: str) -> str:
    return _NOT_XML.sub("?", text)
