# SPDX-License-Identifier: MIT
"""The problems through every interface, language and precision, and what their runs promise."""

from __future__ import annotations

import dataclasses
from itertools import pairwise

import numpy as np
import pytest

from usersub import laws, problems
from usersub.errors import SceneError
from usersub.problems import p1, p2


def test_demo_has_every_problem_interface_language_and_precision():
    seen = {(c.problem, c.interface, c.language, c.precision) for c in problems.demo_cases()}
    for problem in problems.PROBLEMS.values():
        for interface in problem.interfaces:
            # Its laws behind the other interfaces would have to be compiled for it alone.
            if problem.name == "P23" and interface not in ("fric_coef", "vfric_coef"):
                continue
            # So would their laws; the tests run them all.
            if problem.name in ("P13", "P14", "P15", "P16", "P17", "P18"):
                assert (problem.name, interface, "c", "double") in seen
                continue
            for language in laws.LANGUAGES:
                for precision in ("double", "single") if interface[0] == "v" else ("double",):
                    assert (problem.name, interface, language, precision) in seen
    more = problems.all_cases(), problems.demo_cases(), problems.demo_cases(quick=True)
    for every, fewer in pairwise(more):
        assert all(case in every for case in fewer) and len(fewer) < len(every)


@pytest.mark.parametrize("problem", problems.PROBLEMS)
def test_every_case_is_right(problem, language, outcome_of):
    for case in problems.all_cases():
        if (case.problem, case.language) == (problem, language):
            outcome = outcome_of(case)
            assert outcome.ok, outcome
            assert tuple(outcome.as_dict()) == problems.KEYS
            for name in ("problem", "law", "interface", "language", "precision", "method"):
                assert getattr(outcome, name) == getattr(case, name)
            assert outcome.ns_per_point > 0.0 and outcome.run_time_s > 0.0


def test_finite_element_block_meets_both_bounds():
    for interface in ("vfric", "vfriction", "vfric_coef"):
        for method in ("CPE3", "C3D8R"):
            outcome = problems.run("P1", interface=interface, language="c", method=method)
            assert outcome.details["time_error"] <= 2.5e-3
            assert outcome.details["distance_error"] <= 5e-4


def test_newton_needs_few_iterations():
    outcome = problems.run("P2", interface="fric", language="c", method="implicit")
    assert outcome.details["newton_iterations"] < 4.0


def test_contact_points_share_the_block():
    # One point or many make the same block: sums of shares differ by rounding only.
    for interface in ("vfric", "fric"):
        one, many = (
            problems.run("P2", interface=interface, language="c", points=n, steps=40).details
            for n in (1, 97)
        )
        assert one["time_error"] == pytest.approx(many["time_error"], abs=1e-12)


@pytest.mark.parametrize("method", ["rigid", "rigid rk4", "CPE3", "C3D8R"])
def test_history_of_the_explicit_block(method):
    outcome = problems.run("P1", interface="vfric", language="c", method=method, history=True)
    history, exact = outcome.history, p1.exact()
    assert (np.diff(history["time"]) > 0).all() and (np.diff(history["distance"]) > 0).all()
    middle = np.argmin(np.abs(history["time"] - 0.5 * exact.time))
    t = history["time"][middle]
    # The elastic block oscillates about the rigid one; 1 % of the initial velocity.
    if not method.startswith("rigid"):
        expected = p1.BLOCK.velocity * (1.0 - t / exact.time)
        assert history["velocity"][middle] == pytest.approx(expected, abs=2.0)
    assert history["friction_force"][middle] == pytest.approx(1500.0, rel=0.1)


def test_history_of_the_implicit_block():
    outcome = problems.run(
        "P2", interface="fric", language="c", method="implicit Romberg", history=True
    )
    history = outcome.history
    assert history["time"][-1] == pytest.approx(p2.exact().time, rel=1e-4)
    assert history["distance"][-1] == pytest.approx(p2.exact().distance, rel=1e-4)
    assert abs(history["velocity"][-1]) < 1e-9


def test_own_routine_runs_a_problem():
    routine = laws.routine("coulomb", "vfric_coef", "c")
    outcome = problems.run("p1", routine=routine)
    assert outcome.ok and outcome.language == "c" and outcome.interface == "vfric_coef"


def test_a_wrong_law_is_seen():
    routine = laws.routine("coulomb", "vfric", "c")
    wrong = dataclasses.replace(p1.PROBLEM, runner=_with_another_coefficient)
    assert not wrong.run(routine).ok


def _with_another_coefficient(routine, law, precision, method, **options):
    from usersub.problems.block_runs import BlockRun

    run = BlockRun(
        "P1", p1.BLOCK, p1.exact(), [0.1501], 1e-9, routine, law, precision, method, **options
    )
    return run.outcome()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"name": "P99"}, "problem list has no problem 'P99'"),
        ({"name": "P1", "interface": "vfrick"}, "no interface 'vfrick'; did you mean 'vfric'"),
        ({"name": "P1", "method": "CPE4"}, "no method 'CPE4'; did you mean 'CPE3'"),
        ({"name": "P1", "language": "cobol"}, "no language 'cobol'"),
        ({"name": "P2", "pionts": 3}, "no option 'pionts'; did you mean 'points'"),
        ({"name": "P1", "steps": 0}, "steps is 0, expected 1 or more"),
        ({"name": "P1", "method": "CPE3", "step_share": 1.5}, "step_share is 1.5, expected"),
        ({"name": "P4", "law": "coulomb"}, "no law 'coulomb'; did you mean 'coulomb_tabulated'"),
    ],
)
def test_wrong_names_are_refused(arguments, message):
    with pytest.raises(SceneError, match=message):
        problems.run(**arguments)
