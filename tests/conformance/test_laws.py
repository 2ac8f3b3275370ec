# SPDX-License-Identifier: MIT
"""The built-in laws keep every rule: no false alarm in any language, precision and interface.

`law_matrix` says which combinations a test run takes, and how to take all.
"""

import pytest

from tests import apart
from tests.conformance import law_matrix
from tests.conformance.law_matrix import Combination

CHOSEN = law_matrix.chosen()


def test_what_is_taken_is_spread():
    every = law_matrix.combinations()
    assert set(CHOSEN) <= set(every)
    for one in ("law", "language", "interface", "precision"):
        assert {getattr(c, one) for c in CHOSEN} == {getattr(c, one) for c in every}


@pytest.mark.parametrize("combination", CHOSEN, ids=lambda c: c.id)
def test_no_alarm(combination: Combination, request: pytest.FixtureRequest):
    if combination.language == "fortran":
        request.getfixturevalue("fortran")
    report = apart.run(combination.report)
    said = [f"{r.rule}: {r.detail}" for r in law_matrix.alarms(report)]
    assert said == [], f"{combination.id}: {report}"
    assert [f"{r.rule}: {r.detail}" for r in law_matrix.unanswered(report)] == []
    agrees = report["law.agrees"]
    assert agrees.verdict == "pass", agrees.detail
