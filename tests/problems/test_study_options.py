# SPDX-License-Identifier: MIT
"""Options of problems that studies vary: softer enforcement, and other updates of the state."""

from __future__ import annotations

import numpy as np
import pytest

import usersub
from usersub import problems
from usersub.errors import SceneError
from usersub.problems import own, p13, p15


def _error(name, method=None, interface="fric", **options):
    outcome = problems.run(name, interface=interface, language="c", method=method, **options)
    return outcome.error


@pytest.mark.parametrize("name", ["P10", "P11", "P19", "P6"])
def test_a_smaller_elastic_slip_is_nearer_to_sticking(name):
    soft, stiff = (_error(name, elastic_slip=slip) for slip in (1e-3, 1e-7))
    assert stiff < 0.5 * soft


def test_a_stiffer_penalty_is_nearer_to_sticking():
    errors = [_error("P5", "penalty", "vfric_coef", stiffness=s) for s in (0.0625, 0.25, 1.0)]
    assert errors[0] > 1.5 * errors[1] > 2.5 * errors[2]


@pytest.mark.parametrize(
    ("update", "order"), [("explicit Euler", 1), ("implicit Euler", 1), ("trapezoidal rule", 2)]
)
@pytest.mark.parametrize("written_in", ["c", "fortran"])
@pytest.mark.parametrize(
    ("problem", "law", "interface"),
    [
        (p13.PROBLEM, "dahl", "fric"),
        (p13.PROBLEM, "dahl", "vfriction"),
        (p15.PROBLEM, "rate_state_ageing", "fric_coef"),
        (p15.PROBLEM, "rate_state_ageing", "vfriction"),
    ],
)
def test_updates_of_the_state_have_their_order(
    update, order, written_in, problem, law, interface, request
):
    if written_in == "fortran":
        request.getfixturevalue("fortran")
    routine = own.routine(own.updated(law, update), interface, written_in)
    outcomes = [problem.run(routine, steps=n, update=update) for n in (128, 256)]
    assert all(outcome.ok for outcome in outcomes)
    assert 2 ** (order - 0.1) < outcomes[0].error / outcomes[1].error < 2 ** (order + 0.1)


@pytest.mark.parametrize(
    ("problem", "law"), [(p13.PROBLEM, "dahl_theta"), (p15.PROBLEM, "ageing_theta")]
)
def test_the_update_is_the_same_in_python(problem, law):
    outcomes = [
        problem.run(own.routine(law, "vfric", language), steps=16, update="trapezoidal rule")
        for language in ("python", "c")
    ]
    assert outcomes[0].error == pytest.approx(outcomes[1].error, rel=1e-12)


@pytest.mark.parametrize("weight", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("written_in", ["c", "fortran", "python"])
def test_slopes_of_the_updated_state(weight, written_in, request):
    """Derivative by the rate against central differences, whose error is some 1e-9 here."""
    if written_in == "fortran":
        request.getfixturevalue("fortran")
    props = [0.6, 0.005, 0.01, 1.0, 2.0, 1.5, 1e-9, weight]
    scene = usersub.Scene(points=3, props=props, states=1, derivatives=1)

    routine = own.routine("ageing_theta", "fric_coef", written_in)

    def coefficients(factor):
        driver = usersub.CoefficientDriver(routine, scene)
        rates = factor * np.array([0.3, 1.0, 2.5])
        found = driver.evaluate(slip_rate=rates, time_increment=0.25)
        return found.copy(), driver.array("derivative")[0].copy()

    step = 1e-5
    slope = (coefficients(1 + step)[0] - coefficients(1 - step)[0]) / (2 * step)
    found = coefficients(1.0)[1] * np.array([0.3, 1.0, 2.5])
    np.testing.assert_allclose(found, slope, rtol=1e-7, atol=1e-10)


def test_the_law_itself_is_exact_for_any_steps():
    for steps in (1, 7, 64):
        assert _error("P13", "start", steps=steps) < 1e-13
        for law in ("rate_state_ageing", "rate_state_slip", "rate_state_regularised"):
            assert _error("P15", steps=steps, law=law) < 1e-13


@pytest.mark.parametrize(
    ("name", "options", "words"),
    [
        ("P10", {"elastic_slip": 0.0}, "elastic_slip is 0.0, expected a number above 0"),
        ("P11", {"elastic_slip": float("nan")}, "expected a number above 0"),
        ("P5", {"stiffness": -1.0}, "stiffness is -1.0"),
        ("P13", {"steps": 0}, "steps is 0, expected 1 or more"),
        ("P13", {"steps": 4, "update": "Heun"}, "has no update 'Heun'"),
        ("P13", {"update": "explicit Euler"}, "needs steps"),
        ("P15", {"steps": 0}, "steps is 0, expected 1 or more"),
        ("P15", {"update": "explicit Euler"}, "needs steps"),
        ("P15", {"steps": 4, "update": "Heun"}, "has no update 'Heun'"),
    ],
)
def test_what_cannot_be_is_refused(name, options, words):
    with pytest.raises(SceneError, match=words):
        problems.run(name, interface="fric", language="c", **options)
