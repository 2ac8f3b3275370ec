# SPDX-License-Identifier: MIT
"""Reports: for people, as JSON, as JUnit XML; cases in words."""

from __future__ import annotations

import json
import math
import pickle
from xml.etree import ElementTree

import numpy as np
import pytest

from usersub.check.case import Case, Step, one
from usersub.check.reports import junit
from usersub.check.reports.report import Head, Report, Result, Value
from usersub.check.respond.answer import Answer
from usersub.check.rules.words import told_apart
from usersub.check.words import case_in_words

CASE = one((1e-2, 0.0), (0.0, -2.5e-3), load=2.0)
FAILED = Result(
    "frame.reversal", "fail", "the force is 0.3, expected -0.3", "Reversed motion.", "a source",
    interface="vfric", case=CASE, where="law.f90:12", hint="use SIGN",
    reproduction="import usersub.check as check\nfrom usersub.check import Case, Step\n...",
    seconds=0.25, figures={"step": 1, "error": [1.0, math.nan]}, output="hello\n",
)  # fmt: skip
WARNED = FAILED.but(rule="data.shared", severity="warning", case=None)
NOTED = FAILED.but(rule="tangent.unsymmetric", severity="note", case=None)
PASSED = Result("repeat.same", "pass", interface="vfric", requirement="Repeats.")
SKIPPED = Result("memory.heap", "skip", "the routine crashed here; see process.crash")
NOT = Result("zero.area", "not-applicable", "it is about VFRIC")
HEAD = Head(
    "law.f90", "/home/me/law.f90", "vfric", "legacy", "single", "fortran", "GNU Fortran 12",
    ("-O2",),    {"usersub": "0.1", "numpy": "2.0"}, 1, "abc", "2026-01-02T03:04:05+00:00",
    (Value("properties", "0.3", "given"), Value("state variables", "0", "default")), "coulomb",
)  # fmt: skip


def report(*results, **more):
    return Report(HEAD, results, **more)


ALL = report(FAILED, WARNED, NOTED, PASSED, SKIPPED, NOT, notes=("a note",), seconds=1.5)


def test_what_counts():
    assert [r.severity for r in ALL.failures] == ["error", "warning", "note"]
    assert ALL.counts == {"fail": 3, "pass": 1, "skip": 1, "not-applicable": 1}
    assert ALL.not_checked == (SKIPPED, NOT)
    assert ALL["zero.area"] is NOT
    with pytest.raises(KeyError):
        ALL["zero.slip"]


@pytest.mark.parametrize(
    ("results", "ok", "strict"),
    [
        ((), True, True),
        ((PASSED, SKIPPED, NOT), True, True),
        ((NOTED,), True, True),
        ((WARNED,), True, False),
        ((FAILED,), False, False),
        ((FAILED.but(expected=True),), True, True),
        ((PASSED.but(expected=True),), False, False),
    ],
)
def test_when_all_is_well(results, ok, strict):
    assert report(*results).ok() is ok and report(*results).ok(strict=True) is strict


def test_text_tells_what_to_change():
    text = str(ALL)
    order = [
        "routine", "/home/me/law.f90", "VFRIC, single precision", "GNU Fortran 12", "coulomb",
        "properties", "0.3 (given)", "usersub 0.1, numpy 2.0", "version 1, hash abc",
        "FAIL  frame.reversal", "the force is 0.3, expected -0.3", "law.f90:12",
        "1 contact point, 2 friction directions", "increment 2: motion (0, -0.0025)", "use SIGN",
        "| hello", "import usersub.check as check",
        "WARNING  data.shared", "NOTE  tangent.unsymmetric",
        "law.f90: VFRIC, single precision: 1 passed, 1 failed, 1 warned, 1 noted, 2 not checked",
        "not checked:", "memory.heap: the routine crashed here; see process.crash",
        "does not apply:", "zero.area: it is about VFRIC", "note: a note",
    ]  # fmt: skip
    places = [text.find(words) for words in order]
    assert -1 not in places, order[places.index(-1)]
    assert places == sorted(places)


def test_text_of_announced_failures():
    text = str(report(FAILED.but(expected=True), PASSED.but(expected=True)))
    assert "expected failures:\n  frame.reversal: the force" in text
    assert "expected to fail, but passed:\n  repeat.same: Repeats." in text


def test_json():
    whole = json.loads(json.dumps(ALL.as_dict()))
    first = whole["results"][0]
    assert first["rule"] == "frame.reversal" and first["where"] == "law.f90:12"
    assert first["verdict"] == "fail" and first["detail"] == FAILED.detail
    smallest = first["smallest_input"]
    assert Case.from_json(json.dumps(smallest["case"])) == CASE
    assert smallest["words"].startswith("1 contact point")
    assert whole["results"][3]["smallest_input"] is None
    assert whole["head"]["values"][0] == {"name": "properties", "value": "0.3", "origin": "given"}
    assert whole["ok"] is False and whole["notes"] == ["a note"]


def test_a_report_goes_to_another_process_without_its_subject():
    import dataclasses

    from usersub import abi
    from usersub.check.subject import Subject

    subject = Subject("law", abi.interface("vfric"), tell=lambda case: None)
    twin = pickle.loads(pickle.dumps(dataclasses.replace(ALL, subject=subject)))
    assert twin.subject is None and str(twin) == str(ALL)


# JUnit.


def suites(*reports, **options):
    return ElementTree.fromstring(junit.junit(reports, **options).encode())


def test_junit_counts_and_kinds():
    root = suites(ALL, report(PASSED))
    assert root.tag == "testsuites"
    assert {k: root.get(k) for k in ("tests", "failures", "errors", "skipped")} == {
        "tests": "7", "failures": "1", "errors": "0", "skipped": "2",
    }  # fmt: skip
    suite = root[0]
    assert suite.get("name") == HEAD.title and suite.get("timestamp") == HEAD.date
    properties = {p.get("name"): p.get("value") for p in suite.iter("property")}
    assert properties["properties"] == "0.3 (given)"
    cases = {c.get("name"): c for c in suite.iter("testcase")}
    failure = cases["frame.reversal"].find("failure")
    assert failure.get("message") == FAILED.detail and "use SIGN" in failure.text
    assert cases["frame.reversal"].get("classname") == "law.f90[vfric-double]"
    assert cases["data.shared"].find("failure") is None
    assert "WARNING" in cases["data.shared"].find("system-out").text
    assert cases["zero.area"].find("skipped").get("message") == "it is about VFRIC"
    assert len(cases["repeat.same"]) == 0


def test_junit_is_strict_when_asked():
    assert suites(report(WARNED), strict=True).get("failures") == "1"


def test_junit_of_announced_failures():
    root = suites(report(FAILED.but(expected=True), PASSED.but(expected=True)))
    assert (root.get("skipped"), root.get("failures")) == ("1", "1")
    assert "take it off the list" in root.find(".//failure").get("message")


def test_junit_has_no_characters_that_xml_does_not_have():
    odd = FAILED.but(detail='a \x1b[31m "red" <word> & \x00 \ufffe')
    root = suites(report(odd))
    assert root.find(".//failure").get("message") == 'a ?[31m "red" <word> & ? ?'


def test_junit_has_the_order_that_the_schema_wants():
    """Of a suite first the properties, then the cases; of a case at most one verdict."""
    for suite in suites(ALL):
        assert [child.tag for child in suite] == ["properties"] + ["testcase"] * len(ALL.results)
        for case in suite.iter("testcase"):
            assert len(case.findall("failure") + case.findall("skipped")) <= 1
            assert {"classname", "name", "time"} == set(case.attrib)


# Words.


def test_a_case_of_several_points_in_words():
    step = Step(
        ((1e-2,), (2e-2,)), (1.0, 1.0), dt=1e-3, stick=(0.1, 0.2), area=(3.0, 4.0), iterations=2,
        temperature=((20.0, 21.0), (22.0, 23.0)), cut_back=True,
    )  # fmt: skip
    case = Case((step,), contact="edge-to-edge", order=(1, 0), angle=0.5, props=(0.3,))
    words = case_in_words(case, "vfriction")
    for part in (
        "2 contact points, 1 friction direction, contact edge-to-edge, points in the order (2, 1)",
        "directions turned by 0.5 rad", "properties 0.3", "motion [0.01; 0.02]", "normal force 1,",
        "stick force [0.1; 0.2]", "temperatures (secondary, main) [(20, 21); (22, 23)]",
        "area [3; 4]", "time increment 0.001", "2 iterations", "cut back",
    ):  # fmt: skip
        assert part in words, part


def test_many_points_are_not_all_written_out():
    case = Case((Step(tuple((float(k), 0.0) for k in range(9)), (1.0,) * 9),))
    assert "motion [(0, 0); (1, 0); (2, 0); ...]" in case_in_words(case)


def test_no_motion():
    assert "no motion, pressure 2" in case_in_words(one((0.0, 0.0), load=2.0), "fric")


def test_numbers_are_told_with_the_digits_that_tell_them_apart():
    pair = (0.25, 0.25 + 3e-8)
    one, other = (Answer(friction=np.array([[x], [1e-17], [2.0]])) for x in pair)
    assert told_apart(one, other, "friction", 0) == ("(0.25, 0, 2)", "(0.25000003, 0, 2)")


def test_numbers_whose_difference_is_next_to_nothing_are_told_in_full():
    one, other = (Answer(friction=np.array([[1.0], [x]])) for x in (1e-17, 2e-17))
    assert told_apart(one, other, "friction", 0) == ("(1, 1e-17)", "(1, 2e-17)")
