# SPDX-License-Identifier: MIT
"""Faults that were planted are found by their own rule, in the right words, and by no other.

A test run looks at one fault of each rule, in a language that goes round: at every second one by
all rules, at the others by their own. USERSUB_EVERYTHING=1 takes every file by its own rule, and
`python -m tests.meta.table` all rules for all files.
"""

from itertools import groupby

import pytest

from tests import apart
from tests.conformance import law_matrix
from tests.meta import planting, table
from tests.meta.planting import Planted
from usersub.check import all_rules as rules

PLANTED = planting.files("planted")
HEALTHY = planting.files("healthy")


def of_each_rule() -> list[Planted]:
    """One file of every rule, in languages that go round."""
    groups = [list(files) for _, files in groupby(PLANTED, key=lambda p: p.rule)]
    return [files[i % len(files)] for i, files in enumerate(groups)]


def needs(planted: Planted, request: pytest.FixtureRequest) -> None:
    """Skips where the compiler of the file is missing."""
    if planted.language == "fortran":
        request.getfixturevalue("fortran")


def test_every_rule_has_its_fault_in_every_language():
    made = {(p.rule, p.language) for p in PLANTED}
    excused = {(rule, language) for rule, why in table.excuses().items() for language in why}
    wanted = {(rule, language) for rule in rules() for language in ("c", "fortran", "python")}
    assert wanted - made - excused == set()
    assert made & excused == set(), "excused, but made"
    assert {rule for rule, _ in made | excused} <= set(rules())


def test_faults_are_spread_over_interfaces_and_precisions():
    names = {p.path.name.split(".")[0] for p in PLANTED}
    for interface in ("fric", "fric_coef", "vfric", "vfriction", "vfric_coef"):
        assert sum(name.startswith(interface) for name in names) >= 10
    assert {p.precision for p in PLANTED} == {"double", "single"}


BY_OWN_RULE = PLANTED if law_matrix.everything() else of_each_rule()[1::2]


@pytest.mark.parametrize("planted", BY_OWN_RULE, ids=lambda p: p.id)
def test_is_found_by_its_own_rule(planted: Planted, request: pytest.FixtureRequest):
    needs(planted, request)
    planted.caught(apart.run(planted.check, [planted.rule], jobs=1, seconds=600))


@pytest.mark.parametrize("planted", of_each_rule()[::2], ids=lambda p: p.id)
def test_is_found_by_no_other_rule(planted: Planted, request: pytest.FixtureRequest):
    needs(planted, request)
    reports = apart.run(planted.check, jobs=1, seconds=600)
    planted.caught(reports)
    assert planted.others(reports) == []


@pytest.mark.parametrize("healthy", HEALTHY, ids=lambda p: p.path.name)
def test_healthy_routines_break_nothing(healthy: Planted, request: pytest.FixtureRequest):
    needs(healthy, request)
    for report in apart.run(healthy.check, jobs=1, seconds=600):
        found = [f"{r.rule}: {r.detail}" for r in report.failures if r.severity != "note"]
        assert found == [], str(report)
        assert [f"{r.rule}: {r.detail}" for r in report.results if r.verdict == "skip"] == []
