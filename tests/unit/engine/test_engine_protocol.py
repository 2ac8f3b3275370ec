# SPDX-License-Identifier: MIT
"""What FRIC is told from iteration to iteration and from increment to increment."""

from __future__ import annotations

import engine_standard as es
import numpy as np
import pytest

import usersub
from usersub.errors import ContractError, RoutineError


class Law:
    """Answers of a FRIC probe by point (NODE - 1), set by the test before an iteration."""

    def __init__(self, points: int) -> None:
        self.lm = [0] * points
        self.number = 0.0  # what the next iteration returns is made of it

    def __call__(self, me, view) -> None:
        i = me.calls[-1]["NODE"] - 1
        x = self.number + 10 * i
        view("LM")[0] = self.lm[i]
        view("TAU")[:] = [x + 1, x + 2]
        view("DSLIP")[:] = [x + 3, x + 4]
        view("SED")[0], view("SFD")[0] = x + 5, x + 6
        view("STATEV")[:] = [x + 7]
        view("DDTDDG")[:] = [[x + 1, x + 2], [x + 3, x + 4]]
        view("DDTDDP")[:] = [x + 5, x + 6]
        view("DDTDDT")[:] = [[x + 1, x + 2], [x + 3, x + 4]]


@pytest.fixture
def fric(probe):
    """(probe, law, driver) of two points that were never closed, in an open increment."""
    law = Law(2)
    made = probe("full", "fric", act=law)
    scene = usersub.Scene(points=2, states=1, temperature_tangent=1)
    driver = usersub.StandardDriver(made.routine, scene)
    random = np.random.default_rng(1)
    driver.bind(
        slip_increment=np.asfortranarray(random.uniform(size=(2, 2))),
        pressure=np.array([5.0, 7.0]),
        multiplier=np.asfortranarray([[31.0, 33.0], [32.0, 34.0]]),
    )
    driver.begin_increment(0.5)
    return made, law, driver


def seen(made, name, iteration=-1):
    """Argument `name` of both points in an iteration in which both were called."""
    calls = made.checked_calls()
    pair = calls[-2:] if iteration == -1 else calls[2 * iteration : 2 * iteration + 2]
    return [np.array(call[name]).tolist() for call in pair]


def test_first_iteration_is_told_that_the_points_were_open(fric):
    made, _, driver = fric
    driver.iterate()
    assert seen(made, "LM") == [2, 2]
    for name in ("TAU", "DSLIP", "TAULM", "SLIP"):
        assert seen(made, name) == [[0, 0], [0, 0]]
    assert seen(made, "SED") == [0, 0]
    assert seen(made, "DPRESS") == [5, 7]


def test_later_iterations_are_told_their_own_answer_but_committed_stress(fric):
    made, law, driver = fric
    law.lm = [0, 1]
    driver.iterate()
    law.number = 100.0
    response = driver.iterate()
    assert seen(made, "LM") == [0, 1]
    assert seen(made, "DSLIP") == [[3, 4], [0, 0]]  # only where LM was 0
    assert seen(made, "TAULM") == [[0, 0], [33, 34]]  # only where LM was 1
    assert seen(made, "TAU") == [[0, 0], [0, 0]]  # of the start of the increment
    assert seen(made, "SED") == [0, 0]
    assert seen(made, "STATEV") == [[0], [0]]
    np.testing.assert_array_equal(response.tau, [[101, 33], [102, 34]])
    np.testing.assert_array_equal(response.dslip, [[103, 0], [104, 0]])
    np.testing.assert_array_equal(response.ddtddg[:, :, 0], [[101, 102], [103, 104]])
    np.testing.assert_array_equal(response.ddtddp[:, 0], [105, 106])
    np.testing.assert_array_equal(response.ddtddt[:, :, 0], [[101, 102], [103, 104]])
    assert not response.ddtddg[:, :, 1].any() and not response.ddtddp[:, 1].any()
    assert list(response.sed) == [105, 0] and list(response.sfd) == [106, 0]
    assert list(response.lm) == [0, 1]


def test_next_increment_starts_from_the_committed_one(fric):
    made, law, driver = fric
    law.lm = [0, 1]
    driver.iterate()
    driver.commit()
    driver.array("pressure")[:] = [6.0, 9.0]
    driver.begin_increment(0.5)
    law.lm = [0, 0]
    driver.iterate()
    assert seen(made, "LM") == [0, 1]  # slipping, sticking
    assert seen(made, "TAU") == [[1, 2], [33, 34]]
    assert seen(made, "SLIP") == [[3, 4], [0, 0]]
    assert seen(made, "DSLIP") == [[0, 0], [0, 0]]
    assert seen(made, "SED") == [5, 0]
    assert seen(made, "STATEV") == [[7], [17]]
    assert seen(made, "DPRESS") == [1, 2]
    assert seen(made, "TIME") == [[1.0, 1.0]] * 2
    assert seen(made, "KINC") == [2, 2]
    driver.commit()
    np.testing.assert_array_equal(driver.state["slip"], [[6, 13], [8, 14]])


def test_frictionless_points_are_slipping_points_of_the_next_increment(fric):
    made, law, driver = fric
    law.lm = [2, 0]
    response = driver.iterate()
    np.testing.assert_array_equal(response.tau, [[0, 11], [0, 12]])
    driver.iterate()
    assert seen(made, "LM") == [2, 0]
    assert seen(made, "DSLIP") == [[0, 0], [13, 14]]
    driver.commit()
    driver.begin_increment(0.5)
    driver.iterate()
    assert seen(made, "LM") == [0, 0]
    assert seen(made, "TAU") == [[0, 0], [11, 12]]


def test_opening_and_closing(fric):
    made, law, driver = fric
    law.lm = [1, 0]
    driver.iterate()
    driver.commit()
    driver.begin_increment(0.5)
    driver.bind(closed=np.array([0, 1], dtype=np.int32))
    response = driver.iterate()
    assert len(made.calls) == 3  # the open point was not called
    assert list(response.lm) == [2, 0]
    np.testing.assert_array_equal(response.tau[:, 0], [0, 0])
    driver.bind(closed=None)
    driver.iterate()
    assert seen(made, "LM") == [1, 0]  # opened in the last iteration: of the previous increment
    driver.bind(closed=np.array([0, 1], dtype=np.int32))
    driver.iterate()
    driver.commit()
    np.testing.assert_array_equal(driver.state["condition"], [2, 0])
    np.testing.assert_array_equal(driver.state["state"], [[7, 17]])  # waits for the point
    driver.bind(closed=None)
    driver.begin_increment(0.5)
    driver.iterate()
    assert seen(made, "LM") == [2, 0]
    assert seen(made, "TAU") == [[0, 0], [11, 12]]


def test_a_cut_back_never_was(fric):
    made, law, driver = fric
    law.lm = [0, 1]
    driver.iterate()
    driver.commit()
    before = driver.state.save()
    driver.begin_increment(0.5)
    law.number = 1000.0
    driver.iterate()
    driver.iterate()
    driver.cut_back()
    assert driver.state.save() == before
    driver.begin_increment(0.25)
    driver.iterate()
    assert seen(made, "LM") == [0, 1]
    assert seen(made, "DSLIP") == [[0, 0], [0, 0]]
    assert seen(made, "TIME") == [[0.75, 0.75]] * 2


def test_points_that_are_not_there_are_open(fric):
    made, law, driver = fric
    law.lm = [0, 1]
    driver.iterate()
    driver.commit()
    driver.points = 1
    driver.begin_increment(0.5)
    driver.iterate()
    assert len(made.calls) == 3
    driver.commit()
    driver.points = 2
    np.testing.assert_array_equal(driver.state["condition"], [0, 2])
    np.testing.assert_array_equal(driver.state["committed_tau"][:, 1], [0, 0])
    np.testing.assert_array_equal(driver.state["state"], [[7, 17]])


def test_what_the_host_does_to_its_arrays_after_the_iteration_changes_nothing(fric):
    """Committed are the values of the iteration, not what its arrays hold later."""
    made, _, driver = fric
    tau = np.zeros((2, 2), order="F")
    driver.bind(tau=tau)
    driver.iterate()
    tau[...] = -1.0
    driver.bind(tau=None, pressure=np.array([50.0, 70.0]))
    driver.commit()
    np.testing.assert_array_equal(driver.state["committed_tau"], [[1, 11], [2, 12]])
    np.testing.assert_array_equal(driver.state["committed_pressure"], [5, 7])


@pytest.mark.parametrize("block", [1, 2])
def test_smallest_suggested_increment(probe, block):
    def act(me, view):
        view("LM")[0] = 0
        view("PNEWDT")[0] = [0.5, 0.25, 4.0][me.calls[-1]["NODE"] - 91]

    host = es.Host("fric", 3, block=block)
    made = probe("full", "fric", act=act)
    driver = host.driver(made.routine)
    response = driver.iterate()
    assert response.cut_back and response.pnewdt == 0.25
    assert [call["PNEWDT"] for call in made.checked_calls()] == [1e36] * 3
    driver.bind(closed=np.array([0, 0, 1], dtype=np.int32))
    response = driver.iterate()
    assert not response.cut_back and response.pnewdt == 4.0


@pytest.mark.parametrize(("lm", "pnewdt"), [(3, 1), (-1, 1), (0, 0.0), (1, -2.0), (2, np.nan)])
def test_answers_that_mean_nothing(probe, lm, pnewdt):
    def act(me, view):
        view("LM")[0], view("PNEWDT")[0] = lm, pnewdt

    made = probe("full", "fric", act=act)
    driver = es.Host("fric", 3).driver(made.routine)
    with pytest.raises(ContractError, match="LM" if lm in (3, -1) else "PNEWDT") as caught:
        driver.iterate()
    assert caught.value.point == 0
    with pytest.raises(usersub.SceneError, match="usub_iterate"):
        driver.commit()


def test_sticking_points_need_a_finite_multiplier(probe):
    def act(me, view):
        view("LM")[0] = 1

    host = es.Host("fric", 3)
    host.arrays["multiplier"][1, 2] = np.nan
    host.committed["condition"][:] = 0
    driver = host.driver(probe("full", "fric", act=act).routine)
    with pytest.raises((RoutineError, usersub.SceneError), match="multiplier of point 2"):
        driver.iterate()
