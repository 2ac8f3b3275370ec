# SPDX-License-Identifier: MIT
"""Frictions of decks run behind the shipped laws, or say why they do not."""

import numpy as np
import pytest

import usersub
from usersub import DeckError, deck

HEAD = "*SURFACE INTERACTION, NAME=A\n"


def friction(text, **options):
    return deck.read(HEAD + text, **options)["A"].friction


def coefficients(found, rate, pressure, temperature=None):
    settings = found.scene_settings()
    scene = usersub.Scene(points=len(rate), **settings)
    arrays = {"slip_rate": rate, "pressure": pressure}
    if scene.temperatures:
        arrays["temperature"] = temperature
    if found.interface == "fric_coef":
        arrays["slip_data"] = np.asfortranarray(np.vstack([rate, np.zeros((5, len(rate)))]))
        del arrays["slip_rate"]
    return usersub.CoefficientDriver(found.routine(), scene).evaluate(**arrays)


RATE = np.array([0.0, 2.5, 5.0, 40.0])
ONE = np.ones(4)


@pytest.mark.parametrize("solver", ["standard", "explicit"])
def test_coulomb_and_decay(solver):
    found = friction("*FRICTION\n0.3\n", solver=solver)
    assert np.array_equal(coefficients(found, RATE, ONE), 0.3 * ONE)
    found = friction("*FRICTION, EXP\n0.3, 0.1, 0.2\n", solver=solver)
    exact = 0.1 + 0.2 * np.exp(-0.2 * RATE)
    # two rounded operations more than the formula here may have
    np.testing.assert_allclose(coefficients(found, RATE, ONE), exact, rtol=1e-15)


@pytest.mark.parametrize("solver", ["standard", "explicit"])
def test_uneven_table(solver):
    # rates 0 and 10 at the pressure 1, rates 0 and 5 at the pressure 3
    table = "*FRICTION\n0.4, 0., 1.\n0.2, 10., 1.\n0.3, 0., 3.\n0.1, 5., 3.\n"
    found = friction(table, solver=solver)
    at_one = np.interp(RATE, [0.0, 10.0], [0.4, 0.2])
    at_three = np.interp(RATE, [0.0, 5.0], [0.3, 0.1])
    for pressure in (0.5, 1.0, 1.75, 3.0, 9.0):
        share = min(max((pressure - 1.0) / 2.0, 0.0), 1.0)
        exact = at_one + (at_three - at_one) * share
        np.testing.assert_allclose(coefficients(found, RATE, pressure * ONE), exact, rtol=1e-14)


def test_table_by_temperature():
    found = friction("*FRICTION\n0.3,,,20.\n0.1,,,120.\n", solver="explicit")
    assert found.scene_settings()["temperatures"] == 1
    mu = coefficients(found, RATE, ONE, np.array([0.0, 20.0, 70.0, 500.0]))
    np.testing.assert_allclose(mu, [0.3, 0.3, 0.2, 0.1], rtol=1e-15)


def test_limit_and_elastic_slip_reach_the_driver():
    found = friction("*FRICTION, ELASTIC SLIP=1e-3, TAUMAX=2.\n0.3\n", solver="standard")
    settings = found.scene_settings()
    assert settings == {"props": (0.3,), "shear_limit": 2.0, "elastic_slip": 1e-3}
    scene = usersub.Scene(points=3, dimension=2, **settings)
    driver = usersub.driver(found.routine(), scene)
    driver.begin_increment(1.0)
    slip = np.asfortranarray([[5e-4, 1.0, 1.0]])
    tau = driver.iterate(slip_increment=slip, pressure=np.array([4.0, 4.0, 50.0])).tau[0]
    # half the elastic slip; mu p; the limit
    np.testing.assert_allclose(tau, [0.6, 1.2, 2.0], rtol=1e-14)


def test_slip_tolerance_needs_the_length_of_the_host():
    settings = friction("*FRICTION, SLIP TOLERANCE=.01\n0.3\n").scene_settings()
    assert settings == {"props": (0.3,), "slip_tolerance": 0.01}


def explicit_force(found, slips, normal_force, **settings):
    """Forces of two points after increments of slip along the first axis, unit areas."""
    scene = usersub.Scene(points=2, nodes=6, **found.scene_settings(), **settings)
    driver = usersub.driver(found.routine(), scene)
    normal = np.asfortranarray([[0.0, 0.0], [0.0, 0.0], [1.0, 1.0]])
    for slip in slips:
        increment = np.asfortranarray([slip, [0.0, 0.0], [0.0, 0.0]])
        force = driver.step(
            1.0, slip_increment=increment, normal=normal, normal_force=np.array(normal_force)
        ).force
    return -force[0]


def test_softened_friction():
    found = friction("*FRICTION, SHEAR TRACTION SLOPE=100.\n0.3\n")
    assert found.interface == "vfric_coef"
    force = explicit_force(found, [[0.005, 0.1], [0.005, 0.1]], [10.0, 10.0])
    np.testing.assert_allclose(force, [1.0, 3.0], rtol=1e-14)  # on the slope, at mu p


def test_softened_rough_friction_has_no_bound():
    found = friction("*FRICTION, ROUGH, SHEAR TRACTION SLOPE=100.\n")
    assert found.interface == "vfriction"
    force = explicit_force(found, [[0.005, 0.1], [0.005, 0.1]], [10.0, 10.0])
    np.testing.assert_allclose(force, [1.0, 20.0], rtol=1e-14)


def test_the_limit_of_the_shear_stress_in_the_explicit_solver():
    found = friction("*FRICTION, TAUMAX=2., SHEAR TRACTION SLOPE=100.\n0.3\n")
    force = explicit_force(found, [[0.1, 0.1]], [5.0, 10.0])
    np.testing.assert_allclose(force, [1.5, 2.0], rtol=1e-14)


def implicit(found, slip, pressure, **settings):
    """Response of points that slide for the first time."""
    scene = usersub.Scene(
        points=len(pressure),
        dimension=len(slip) + 1,
        characteristic_length=1.0,
        **found.scene_settings(),
        **settings,
    )
    driver = usersub.driver(found.routine(), scene)
    arrays = {"slip_increment": np.asfortranarray(slip), "pressure": np.array(pressure)}
    if "multiplier" in driver.layout.ports:
        arrays["multiplier"] = np.zeros((len(slip), len(pressure)), order="F")
    driver.bind(**arrays)
    for _ in range(2):  # points close in the first increment
        driver.begin_increment(1.0)
        response = driver.iterate()
        driver.commit()
    return response


def test_rough_friction_allows_no_motion():
    found = friction("*FRICTION, ROUGH\n", solver="standard")
    assert found.interface == "fric"
    assert list(implicit(found, [[0.0, 0.0]], [4.0, 9.0]).lm) == [1, 1]


def test_lagrange_multipliers():
    found = friction("*FRICTION, LAGRANGE\n0.3\n")
    assert found.scene_settings()["enforcement"] == "lagrange"
    assert list(implicit(found, [[0.0, 0.0]], [4.0, 9.0]).lm) == [1, 1]


def test_two_coefficients():
    found = friction("*FRICTION, ANISOTROPIC\n0.3, 0.2\n")
    tau = implicit(found, [[1.0, 0.0], [0.0, 1.0]], [10.0, 10.0]).tau
    np.testing.assert_allclose(tau, [[3.0, 0.0], [0.0, 2.0]], rtol=1e-14)


def test_tables_of_two_coefficients():
    found = friction("*FRICTION, ANISOTROPIC\n.3,.2,,10.\n.1,.4,,20.\n")
    tau = implicit(found, [[1.0, 0.0], [0.0, 1.0]], [15.0, 12.5]).tau
    np.testing.assert_allclose(tau, [[0.2 * 15.0, 0.0], [0.0, 0.25 * 12.5]], rtol=1e-14)


@pytest.mark.parametrize("solver", ["standard", "explicit"])
def test_a_table_over_field_variables(solver):
    # the slip rate matters at the second field's lower value only, and only there is it given
    table = ".4,0.,,,1.,1.\n.2,10.,,,1.,1.\n.3,,,,1.,2.\n.1,,,,5.,2.\n"
    found = friction("*FRICTION, DEPENDENCIES=2\n" + table, solver=solver)
    settings = found.scene_settings()
    assert settings["fields"] == 2
    rate = np.array([5.0, 5.0, 5.0, 0.0])
    fields = np.asfortranarray([[1.0, 3.0, 3.0, 9.0], [0.0, 1.5, 2.0, 9.0]])
    scene = usersub.Scene(points=4, **settings)
    arrays = {"slip_rate": rate, "pressure": ONE, "field": fields}
    if solver == "standard":
        arrays["slip_data"] = np.asfortranarray(np.vstack([rate, np.zeros((5, 4))]))
        del arrays["slip_rate"]
    mu = usersub.CoefficientDriver(found.routine(), scene).evaluate(**arrays)
    np.testing.assert_allclose(mu, [0.3, 0.25, 0.2, 0.1], rtol=1e-14)


def test_stick_slope_of_calculix():
    found = deck.read(HEAD + "*FRICTION\n0.3, 1e3\n", dialect="calculix")["A"].friction
    tau = implicit(found, [[1e-3, 0.1]], [10.0, 10.0]).tau
    np.testing.assert_allclose(tau, [[2.0, 3.0]], rtol=1e-14)


@pytest.mark.parametrize(
    ("text", "solver", "words"),
    [
        ("*FRICTION, USER, TAUMAX=1.\n", None, "TAUMAX"),
        ("*FRICTION, USER, TAUMAX=1.\n", "explicit", "TAUMAX"),
    ],
)
def test_what_does_not_run_says_why(text, solver, words):
    found = friction(text, solver=solver)
    assert words in found.not_runnable and found.interface == ""
    for attempt in (found.scene_settings, found.routine, found.acting):
        with pytest.raises(DeckError, match="does not run") as caught:
            attempt()
        assert caught.value.line == 2


@pytest.mark.parametrize(
    ("text", "solver", "interface"),
    [
        ("USER", None, "fric"),
        ("USER", "explicit", "vfric"),
        ("USER=FRICTION", None, "vfriction"),
        ("USER=COEFFICIENT", "standard", "fric_coef"),
        ("USER=COEFFICIENT", "explicit", "vfric_coef"),
    ],
)
def test_user_routines_run_from_their_file(text, solver, interface):
    found = friction(f"*FRICTION, {text}, PROPERTIES=1\n0.3\n", solver=solver)
    assert found.interface == interface
    assert found.scene_settings() == {"props": (0.3,)}
    file = usersub.laws.path("coulomb", "python")
    assert found.routine(file).interface.name == interface
    with pytest.raises(DeckError, match="file of the routine"):
        found.routine()


def test_a_file_for_a_law_of_the_deck():
    with pytest.raises(DeckError, match="names no user routine"):
        friction("*FRICTION\n0.3\n").routine("mine.py")
    with pytest.raises(DeckError, match="names no user routine"):
        friction("*FRICTION\n0.3\n").acting("mine.py")


def test_states_of_a_user_routine():
    settings = friction("*FRICTION, USER, DEPVAR=4\n").scene_settings()
    assert settings == {"props": (), "states": 4}


def test_a_table_too_large_to_fill():
    rows = "".join(f"0.3, {i}., {i}.\n0.2, {i}.5, {i}.\n" for i in range(1100))
    assert "uneven table" in friction("*FRICTION\n" + rows).not_runnable
