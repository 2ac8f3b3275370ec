# SPDX-License-Identifier: MIT
"""Lagrange multipliers through the standard driver: hosts with real ones, and the protocol."""

from __future__ import annotations

import math

import numpy as np
import pytest

import usersub
from usersub.errors import SceneError
from usersub.problems.newton_host import NewtonHost

SLIPPING, STICKING, OPEN = 0, 1, 2


@usersub.fric_coef
def decay(fCoef, fCoefDeriv, slipData, props):
    weight = math.exp(-props[2] * slipData[0, 0])
    fCoef[0, 0] = props[1] + (props[0] - props[1]) * weight
    fCoefDeriv[0, 0, 0] = -props[2] * (props[0] - props[1]) * weight


@usersub.fric
def sticks_itself(LM, TAU, DDTDDG, DDTDDP, DSLIP, DGAM, TAULM, PRESS, PROPS):
    """Coulomb friction in one direction; DSLIP tells of a reversal between iterations."""
    most = PROPS[0] * PRESS
    if LM[0] == 0 and DGAM[0] * DSLIP[0] < 0.0:
        LM[0] = 1
    elif LM[0] == 1 and abs(TAULM[0]) <= most:
        LM[0] = 1
    else:
        along = TAULM[0] if LM[0] == 1 else DGAM[0] if DGAM[0] != 0.0 else TAU[0]
        sign = 1.0 if along >= 0.0 else -1.0
        LM[0] = 0
        TAU[0] = sign * most
        DDTDDP[0] = sign * PROPS[0]
        DSLIP[0] = DGAM[0]


class Spring:
    """One point of one direction on a spring whose end is moved; the pressure is given."""

    def __init__(self, routine, stiffness=100.0, pressure=10.0, **settings):
        scene = usersub.Scene(dimension=2, **settings)
        self.driver = usersub.StandardDriver(routine, scene, reuse=True)
        self.stiffness, self.place, self.end = stiffness, 0.0, 0.0
        self.slip, self.multiplier = np.zeros((1, 1)), np.zeros((1, 1))
        self.pressure = np.array([pressure])
        self.driver.bind(
            slip_increment=self.slip, multiplier=self.multiplier, pressure=self.pressure
        )

    def move(self, by, time_increment=0.1, **named):
        """Moves the end; returns the conditions of the iterations."""
        self.end += by
        self.driver.begin_increment(time_increment, **named)
        motion, seen = 0.0, []
        for _ in range(30):
            self.slip[0, 0] = motion
            answer = self.driver.iterate()
            seen.append(int(answer.lm[0]))
            tau = answer.tau[0, 0]
            residual = self.stiffness * (self.end - self.place - motion) - tau
            same = len(seen) > 1 and seen[-1] == seen[-2]
            if same and abs(residual) <= 1e-13 * self.pressure[0]:
                self.driver.commit()
                self.place += motion
                return seen
            if answer.lm[0] == STICKING:
                # motion -> 0; the multiplier takes what is left
                self.multiplier[0, 0] = self.stiffness * (self.end - self.place)
                motion = 0.0
            else:
                motion += residual / (self.stiffness + answer.ddtddg[0, 0, 0])
        raise AssertionError(f"no equilibrium: {seen}")


def test_release_and_return():
    """Spring 100, strength 2: sticks to 0.02 of stretch, slips, sticks again on the way back."""
    host = Spring(decay, props=[0.2, 0.2, 0.0], enforcement="lagrange")
    state = host.driver.state
    host.move(0.015)
    assert host.place == 0 and state["condition"][0] == STICKING
    assert state["committed_tau"][0, 0] == pytest.approx(1.5, rel=1e-15)
    assert host.move(0.015)[0] == STICKING
    assert host.place == pytest.approx(0.01, rel=1e-13) and state["condition"][0] == SLIPPING
    assert state["committed_tau"][0, 0] == 2.0 and state["slip"][0, 0] == host.place
    before = host.place
    seen = host.move(-0.01)
    assert seen[0] == SLIPPING and seen[-1] == STICKING
    assert host.place == before and state["slip"][0, 0] == before
    assert state["committed_tau"][0, 0] == pytest.approx(1.0, rel=1e-13)
    host.move(-0.04)
    assert state["committed_tau"][0, 0] == -2.0
    assert host.place == pytest.approx(before - 0.01, rel=1e-12)
    assert state["equivalent_slip"][0] == pytest.approx(0.02, rel=1e-12)
    assert not state["elastic_slip"].any()


def test_rate_dependent_slip():
    """k (end - x) = p mu(x / dt), solved apart; the tangent lets it converge in a few steps."""
    host = Spring(decay, props=[0.3, 0.1, 2.0], enforcement="lagrange")
    host.move(0.0)
    seen = host.move(0.08)
    low, high = 0.0, 0.08
    for _ in range(200):
        x = 0.5 * (low + high)
        mu = 0.1 + 0.2 * math.exp(-2.0 * x / 0.1)
        low, high = (x, high) if 100.0 * (0.08 - x) > 10.0 * mu else (low, x)
    assert host.place == pytest.approx(low, rel=1e-13) and len(seen) < 9


def test_the_same_as_a_fric_that_does_it_itself():
    """The driver's rules, and those of a FRIC that returns LM = 1 itself. The latter would start by
    slipping, so both begin as points that have stuck."""
    own = Spring(sticks_itself, props=[0.2])
    driver = Spring(decay, props=[0.2, 0.2, 0.0], enforcement="lagrange")
    for host in (own, driver):
        host.driver.state["condition"][:] = STICKING
    for by in (0.005, 0.01, 0.02, -0.001, -0.03, -0.02, 0.004, 0.05):
        own.move(by)
        driver.move(by)
        assert own.place == pytest.approx(driver.place, rel=1e-13)
        for name in ("committed_tau", "slip", "condition"):
            mine, other = own.driver.state[name], driver.driver.state[name]
            np.testing.assert_allclose(mine, other, rtol=1e-13)


@pytest.mark.parametrize(
    ("method", "most"), [({"enforcement": "lagrange"}, 0.0), ({"elastic_slip": 1e-4}, 1e-4)]
)
def test_static_hold(method, most):
    """A load below the strength, held for many increments: nothing creeps with multipliers, and no
    more than the allowable elastic slip is ever lost with elastic slip."""
    host = Spring(decay, props=[0.2, 0.2, 0.0], **method)
    host.move(0.0)
    host.move(0.0199)
    after, tau = host.place, float(host.driver.state["committed_tau"][0, 0])
    bits = host.driver.state["elastic_slip"].tobytes()
    for _ in range(2000):
        host.move(0.0)
    assert host.place == after and abs(after) <= most
    assert host.driver.state["slip"][0, 0] == 0.0 == host.driver.state["equivalent_slip"][0]
    assert host.driver.state["committed_tau"][0, 0] == tau
    assert host.driver.state["elastic_slip"].tobytes() == bits


def test_many_points_agree_with_a_small_elastic_slip():
    """The limit of penalty enforcement for a vanishing elastic slip, partial slip included."""
    found = {}
    settings = {"dimension": 3, "points": 6, "props": [0.3, 0.25, 0.5]}
    for name, method in {
        "lagrange": {"enforcement": "lagrange", "characteristic_length": 1.0},
        "coarse": {"elastic_slip": 2e-4},
        "fine": {"elastic_slip": 1e-4},
    }.items():
        driver = usersub.StandardDriver(decay, usersub.Scene(**settings, **method))
        host = NewtonHost(driver)
        for place in ((0.0, 0.0, 1.0), (0.15, 0.05, 1.0), (0.26, 0.1, 1.0), (0.45, 0.1, 1.0)):
            host.increment(np.array(place), 0.1)
        found[name] = driver.state["committed_tau"].copy(), host.motion.copy()
        sticks = driver.state["condition"] if name == "lagrange" else None
        assert sticks is None or not sticks.all()
    for k in range(2):
        coarse = np.abs(found["coarse"][k] - found["lagrange"][k]).max()
        fine = np.abs(found["fine"][k] - found["lagrange"][k]).max()
        assert fine < 3e-4 and fine == pytest.approx(0.5 * coarse, rel=0.05)


def lagrange(points=3, **settings):
    given = {"props": [0.2, 0.2, 0.0], **settings}
    scene = usersub.Scene(points=points, dimension=3, enforcement="lagrange", **given)
    made = usersub.StandardDriver(decay, scene)
    made.bind(
        slip_increment=np.zeros((2, points), order="F"),
        multiplier=np.zeros((2, points), order="F"),
        pressure=np.full(points, 10.0),
    )
    return made


def test_protocol_of_one_increment():
    """Point 0 sticks, 1 is released, 2 is open."""
    made = lagrange()
    made.array("pressure")[2] = 0.0
    made.begin_increment(0.1)
    first = made.iterate()
    assert first.lm.tolist() == [STICKING, STICKING, OPEN] and not first.tau.any()
    made.array("multiplier")[...] = [[1.2, 3.0, 9.0], [1.6, 4.0, 9.0]]
    second = made.iterate()
    assert second.lm.tolist() == [STICKING, SLIPPING, OPEN]
    np.testing.assert_allclose(second.tau, [[1.2, 1.2, 0.0], [1.6, 1.6, 0.0]], rtol=1e-15)
    assert not second.dslip.any() and not second.ddtddg[:, :, 0].any()
    np.testing.assert_allclose(second.ddtddp[:, 1], [0.12, 0.16], rtol=1e-15)
    made.array("slip_increment")[:, 1] = [0.03, 0.0]
    third = made.iterate()
    np.testing.assert_allclose(third.tau[:, 1], [2.0, 0.0], rtol=1e-15)
    np.testing.assert_allclose(third.ddtddg[:, :, 1], [[0, 0], [0, 2.0 / 0.03]], rtol=1e-15)
    assert third.sfd[1] == pytest.approx(0.06, rel=1e-15)
    made.commit()
    assert made.state["condition"].tolist() == [STICKING, SLIPPING, OPEN]
    # The next increment starts with the conditions of this one; a point that has not moved yet
    # keeps the direction of its stress.
    made.array("slip_increment")[...] = 0.0
    made.begin_increment(0.1)
    answer = made.iterate()
    assert answer.lm.tolist() == [STICKING, SLIPPING, OPEN]
    np.testing.assert_allclose(answer.tau[:, 1], [2.0, 0.0], rtol=1e-15)
    # Slip against that stress: the point sticks, and its stress is a start for the multiplier.
    made.array("slip_increment")[:, 1] = [-0.01, 0.002]
    answer = made.iterate()
    assert answer.lm.tolist() == [STICKING, STICKING, OPEN]
    np.testing.assert_allclose(answer.tau[:, 1], [2.0, 0.0], rtol=1e-15)
    assert not answer.dslip.any()


def test_a_point_that_opened_forgets():
    made = lagrange(points=1)
    made.begin_increment(0.1)
    made.array("slip_increment")[...] = [[0.1], [0.0]]
    made.iterate()
    made.array("multiplier")[...] = [[5.0], [0.0]]
    assert made.iterate().lm[0] == SLIPPING
    made.array("pressure")[...] = 0.0
    assert made.iterate().lm[0] == OPEN
    made.commit()
    assert made.state["committed_pressure"][0] == 0.0
    made.array("pressure")[...] = 10.0
    made.begin_increment(0.1)
    assert made.iterate().lm[0] == STICKING


def test_stress_turns_with_the_directions():
    made = lagrange(points=1, characteristic_length=1.0)
    made.begin_increment(0.1)
    made.array("slip_increment")[...] = [[0.1], [0.0]]
    made.iterate()
    made.array("multiplier")[...] = [[5.0], [0.0]]
    made.iterate()
    np.testing.assert_allclose(made.iterate().tau, [[2.0], [0.0]], rtol=1e-15)
    made.commit()
    made.array("slip_increment")[...] = 0.0
    made.begin_increment(0.1)
    turn = np.array([[0.6, -0.8], [0.8, 0.6]]).reshape(2, 2, 1, order="F")
    answer = made.iterate(rotation=np.asfortranarray(turn))
    np.testing.assert_allclose(answer.tau, [[1.2], [1.6]], rtol=1e-15)


def test_refusals():
    made = lagrange(points=1)
    made.bind(multiplier=None)
    made.begin_increment(0.1)
    with pytest.raises(SceneError, match="'multiplier' is not bound; scene setting 'enforcement'"):
        made.iterate()
    made.bind(multiplier=np.array([[np.nan], [0.0]], order="F"))
    made.iterate()  # the point was open before: nothing is constrained yet
    with pytest.raises(SceneError, match="multiplier of point 0 is not finite"):
        made.iterate()
    assert "Lagrange multipliers" in made.plan.explain()
    for enforcement in ("kinematic", "lagrange", "penalty"):
        scene = usersub.Scene(dimension=2, props=[0.2], enforcement=enforcement)
        with pytest.raises(SceneError, match=f"'enforcement' = '{enforcement}'.*LM"):
            usersub.StandardDriver(sticks_itself, scene)
    scene = usersub.Scene(dimension=2, props=[0.2], enforcement="kinematic")
    with pytest.raises(SceneError, match="expected penalty or lagrange"):
        usersub.StandardDriver(decay, scene)
