# SPDX-License-Identifier: MIT
"""Interactions of decks run over the steps, with the changes of the deck."""

import numpy as np
import pytest

import usersub
from usersub import DeckError, deck

DECK = """\
*AMPLITUDE, NAME=RISE, DEFINITION=SMOOTH STEP
0., 0., 1., 1.
*SURFACE INTERACTION, NAME=STEEL
*FRICTION
0.3
*SURFACE INTERACTION, NAME=OWN
*FRICTION, USER=COEFFICIENT, PROPERTIES=1
0.3
*STEP
*STATIC
*END STEP
*STEP
*STATIC
*CHANGE FRICTION, INTERACTION=Steel, AMPLITUDE=RISE
*FRICTION
0.1
*END STEP
*STEP
*DYNAMIC
*CHANGE FRICTION, INTERACTION=STEEL
*FRICTION
0.5
*END STEP
*STEP
*STATIC
*CHANGE FRICTION, INTERACTION=STEEL, RESET
*END STEP
"""
PRESSURE = np.array([10.0, 20.0])


def scene():
    return usersub.Scene(points=2, dimension=2, characteristic_length=1.0)


def coefficients(one, count=4):
    """Coefficients of points that slip in the increments of the next step."""
    one.bind(slip_increment=np.full((1, 2), 0.1, order="F"), pressure=PRESSURE)
    one.begin_step(1.0)
    found = []
    for _ in range(count):
        one.begin_increment(1.0 / count)
        found.append(one.iterate().tau[0] / PRESSURE)
        one.commit()
    found = np.array(found)
    np.testing.assert_allclose(found[:, 0], found[:, 1], rtol=1e-14)
    return found[:, 0]


def test_a_deck_over_its_steps():
    one = deck.read(DECK).interaction("steel", scene())
    np.testing.assert_allclose(coefficients(one), [0.3] * 4, rtol=1e-14)
    time = np.array([0.25, 0.5, 0.75, 1.0])
    share = time**3 * (10.0 - 15.0 * time + 6.0 * time**2)
    np.testing.assert_allclose(coefficients(one), 0.3 - 0.2 * share, rtol=1e-14)
    # a transient step makes changes at once, a static one ramps them
    np.testing.assert_allclose(coefficients(one), [0.5] * 4, rtol=1e-14)
    np.testing.assert_allclose(coefficients(one), [0.45, 0.4, 0.35, 0.3], rtol=1e-14)


def test_the_step_says_how_loads_are_made():
    text = DECK.replace("*STEP\n*DYNAMIC", "*STEP, AMPLITUDE=RAMP\n*DYNAMIC")
    one = deck.read(text).interaction("steel", scene())
    for _ in range(2):
        coefficients(one)
    np.testing.assert_allclose(coefficients(one), [0.2, 0.3, 0.4, 0.5], rtol=1e-14)


def test_a_user_routine_runs_from_its_file(tmp_path):
    file = tmp_path / "own.py"
    file.write_text(
        "import usersub\n"
        "@usersub.fric_coef(generation='2022')\n"
        "def own(fCoef, props):\n"
        "    fCoef[0, 0] = 2.0 * props[0]\n"
    )
    one = deck.read(DECK).interaction("own", scene(), routine=file)
    np.testing.assert_allclose(coefficients(one), [0.6] * 4, rtol=1e-14)


def test_what_does_not_run_is_refused():
    with pytest.raises(DeckError, match="file of the routine"):
        deck.read(DECK).interaction("own", scene())
    whole = deck.read("*SURFACE INTERACTION, NAME=A, USER\n")
    with pytest.raises(DeckError, match="replaces the whole"):
        whole.interaction("a", scene())


@pytest.mark.parametrize("solver", ["standard", "explicit"])
def test_contact_area(solver):
    read = deck.read("*SURFACE INTERACTION, NAME=A\n2.5,\n*FRICTION\n0.1\n")["A"]
    assert read.contact_area(solver) == {"standard": 2.5, "explicit": 1.0}[solver]
    assert deck.read("*SURFACE INTERACTION, NAME=A\n")["A"].contact_area(solver) == 1.0


def test_a_user_routine_with_two_coefficients_runs(tmp_path):
    file = tmp_path / "two.py"
    file.write_text(
        "import usersub\n"
        "@usersub.coefficient\n"
        "def two(props):\n"
        "    return props[0], 0.5 * props[0]\n"
    )
    text = DECK.replace("USER=COEFFICIENT", "USER=COEFFICIENT, ANISOTROPIC")
    model = scene().replace(dimension=3)
    one = deck.read(text).interaction("own", model, routine=file)
    slip = np.asfortranarray([[0.0, 9.0], [9.0, 0.0]])
    one.bind(slip_increment=slip, pressure=PRESSURE)
    one.begin_step()
    for _ in range(2):
        one.begin_increment(0.5)
        tau = one.iterate().tau
        one.commit()
    np.testing.assert_allclose(tau, [[0.0, 6.0], [1.5, 0.0]], rtol=1e-14, atol=1e-14)
