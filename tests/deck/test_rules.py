# SPDX-License-Identifier: MIT
"""Exclusions of the manual: each is an error with line and reason."""

import pytest

from usersub import DeckError, deck

HEAD = "*SURFACE INTERACTION, NAME=A\n"
BASE = HEAD + "*FRICTION\n0.3\n"


def refused(text, words, line, **options):
    with pytest.raises(DeckError) as caught:
        deck.read(text, **options)
    assert words in caught.value.reason and caught.value.line == line, caught.value


ONE_OF = {
    "ELASTIC SLIP": "ELASTIC SLIP=1e-3",
    "LAGRANGE": "LAGRANGE",
    "ROUGH": "ROUGH",
    "SLIP TOLERANCE": "SLIP TOLERANCE=.01",
    "USER": "USER",
}


@pytest.mark.parametrize("first", ONE_OF)
@pytest.mark.parametrize("second", ONE_OF)
def test_one_of_five(first, second):
    if first == second:
        refused(f"{HEAD}*FRICTION, {ONE_OF[first]}, {first}\n0.3\n", f"{first} is given twice", 2)
    else:
        text = f"{HEAD}*FRICTION, {ONE_OF[first]}, {ONE_OF[second]}\n0.3\n"
        refused(text, "exclude one another", 2)


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ("EXPONENTIAL DECAY, ANISOTROPIC", "isotropic"),
        ("EXPONENTIAL DECAY, TAUMAX=5.", "limit on the shear stress"),
        ("EXPONENTIAL DECAY, TAUMAX=0.", "limit on the shear stress"),
        ("EXPONENTIAL DECAY, DEPENDENCIES=1", "slip rate only"),
        ("EXPONENTIAL DECAY, ROUGH", "rough"),
        ("EXPONENTIAL DECAY, USER", "routine"),
        ("TEST DATA", "needs EXPONENTIAL DECAY"),
        ("DEPVAR=2", "needs USER"),
        ("PROPERTIES=2", "needs USER"),
        ("SHEAR TRACTION SLOPE=3., USER", "user routines"),
        ("SHEAR TRACTION SLOPE=3., LAGRANGE", "for the implicit solver"),
        ("ANISOTROPIC, ROUGH", "no coefficient"),
        ("TAUMAX=-1.", "more than 0"),
        ("ELASTIC SLIP=0.", "more than 0"),
        ("SLIP TOLERANCE=-1.", "more than 0"),
        ("SHEAR TRACTION SLOPE=0.", "more than 0"),
        ("USER=VFRIC", "expected FRIC, FRICTION or COEFFICIENT"),
        ("USER=FRI", "expected FRIC, FRICTION or COEFFICIENT"),
    ],
)
def test_parameters_that_exclude_one_another(parameters, words):
    data = "" if "USER" in parameters else "0.3, 0.2, 1.\n"
    refused(f"{HEAD}*FRICTION, {parameters}\n{data}", words, 2)


STANDARD = ("ELASTIC SLIP=1.", "LAGRANGE", "SLIP TOLERANCE=.1", "ANISOTROPIC", "TAUMAX=0.")


@pytest.mark.parametrize("parameter", STANDARD)
def test_not_in_the_explicit_solver(parameter):
    text = f"{HEAD}*FRICTION, {parameter}\n0.3, 0.2\n"
    assert deck.read(text, solver="standard")["A"].friction
    refused(text, parameter.partition("=")[0], 2, solver="explicit")
    refused(text + "*STEP\n*DYNAMIC, EXPLICIT\n", parameter.partition("=")[0], 2)


@pytest.mark.parametrize("parameter", ["SHEAR TRACTION SLOPE=1.", "USER=FRICTION"])
def test_not_in_the_implicit_solver(parameter):
    text = f"{HEAD}*FRICTION, {parameter}\n" + "0.3\n" * ("SHEAR" in parameter)
    assert deck.read(text, solver="explicit")["A"].friction
    refused(text, "explicit", 2, solver="standard")
    refused(text + "*STEP\n*VISCO\n", "explicit", 2)


def test_state_of_coefficient_routines():
    text = HEAD + "*FRICTION, USER=COEFFICIENT, DEPVAR=2\n"
    refused(text, "VFRIC_COEF has no state", 2, solver="explicit")
    assert "newer releases" in deck.read(text, solver="standard").warnings[0].text


def test_taumax_zero_where_the_solver_is_not_told():
    found = deck.read(HEAD + "*FRICTION, TAUMAX=0.\n0.3\n")
    assert "the explicit refuses" in found.warnings[0].text
    assert "shear_limit" not in found["A"].friction.scene_settings()


@pytest.mark.parametrize(
    ("text", "words", "line"),
    [
        ("*FRICTION\n", "missing", 2),
        ("*FRICTION\n,0.\n", "coefficient is missing", 3),
        ("*FRICTION\n-0.3\n", "expected 0 or more", 3),
        ("*FRICTION\n0.3, -1.\n", "slip rate is -1", 3),
        ("*FRICTION\n0.3, 1., 2., 3., 4.\n", "at most 4", 3),
        ("*FRICTION\n0.3, 10.\n0.2, 5.\n", "slip rate falls from 10 to 5", 4),
        ("*FRICTION\n0.3, 5.\n0.2, 5.\n", "same slip rate", 4),
        ("*FRICTION\n0.3\n0.2\n", "name no slip rate", 4),
        ("*FRICTION\n.3,0.,1.\n.2,5.,1.\n.3,0.,0.5\n", "pressure falls from 1 to 0.5", 5),
        ("*FRICTION\n.3,0.,,9.\n.2,0.,,8.\n", "temperature falls", 4),
        ("*FRICTION, DEPENDENCIES=1\n.3,,,,2.\n.2,,,,1.\n", "field variable 1 falls", 4),
        ("*FRICTION, DEPENDENCIES=5\n0.3,1.,1.,1.,1.,1.,1.,1.\n", "breaks off after 8", 3),
        ("*FRICTION, ANISOTROPIC\n0.3\n", "mu2 is missing", 3),
        ("*FRICTION, EXPONENTIAL DECAY\n", "data line is missing", 2),
        ("*FRICTION, EXPONENTIAL DECAY\n0.3, 0.2\n", "decay coefficient is missing", 3),
        ("*FRICTION, EXPONENTIAL DECAY\n0.3, 0.2, -1.\n", "decay coefficient is -1", 3),
        ("*FRICTION, EXPONENTIAL DECAY\n0.3, 0.2, 1., 4.\n", "at most 3", 3),
        ("*FRICTION, EXPONENTIAL DECAY\n0.3, 0.2, 1.\n0.1\n", "one data line", 4),
        ("*FRICTION, ROUGH\n0.3\n", "ROUGH has no data", 3),
        ("*FRICTION, USER\n0.3\n", "without PROPERTIES", 3),
        ("*FRICTION, USER, PROPERTIES=2\n0.3\n", "1 properties, PROPERTIES = 2", 2),
        ("*FRICTION, USER, PROPERTIES=2\n1., 2., 3.\n", "3 properties, PROPERTIES = 2", 3),
        ("*FRICTION, USER, PROPERTIES=9\n1., 2., 3.\n1.,2.,3.,4.,5.,6.\n", "8 properties are", 3),
        ("*FRICTION\n0.3\n*FRICTION\n0.3\n", "a second *FRICTION", 4),
        ("*FRICTION\n0.3\n*SURFACE INTERACTION, NAME=a\n", "defined twice", 4),
        ("1., 2.\n", "one number", 2),
        ("-1.\n", "expected 0 or more", 2),
    ],
)
def test_data(text, words, line):
    refused(HEAD + text, words, line)


@pytest.mark.parametrize(
    ("data", "words", "line"),
    [
        ("0.3", "1 data lines", 2),
        ("0.3\n0.2, 0.", "expected more than 0", 4),
        ("0.3\n0.2", "slip rate of mu2 is missing", 4),
        ("0.3\n0.3, 10.", "nothing decays", 4),
        ("0.3\n0.01, 10.", "below 0", 4),
        ("0.3\n0.2, 10.\n0.2", "not between", 4),
        ("0.3\n0.2, 10.\n0.4", "not between", 4),
        ("0.3\n0.2, 10.\n0.1\n0.1", "two or three", 6),
        ("0.3, 1.\n0.2, 10.", "at most 1", 3),
        ("0.3\n0.2, 1e-320\n0.1", "beyond double precision", 4),
    ],
)
def test_impossible_test_data(data, words, line):
    refused(f"{HEAD}*FRICTION, EXPONENTIAL DECAY, TEST DATA\n{data}\n", words, line)


CHANGE = BASE + "*STEP\n*STATIC\n*CHANGE FRICTION"


@pytest.mark.parametrize(
    ("text", "words", "line"),
    [
        (CHANGE + "\n*FRICTION\n.1\n", "neither of INTERACTION and ELSET", 6),
        (CHANGE + ", INTERACTION=A, ELSET=B\n*FRICTION\n.1\n", "both of", 6),
        (CHANGE + ", INTERACTION=B\n*FRICTION\n.1\n", "no interaction is called", 6),
        (CHANGE + ", INTERACTION=A\n*END STEP\n", "followed by no *FRICTION", 6),
        (CHANGE + ", INTERACTION=A\n", "followed by no *FRICTION", 6),
        (CHANGE + ", INTERACTION=A\n*SURFACE BEHAVIOR\n*FRICTION\n.1\n", "followed by no", 6),
        (CHANGE + ", INTERACTION=A\n0.1\n", "no data lines", 7),
        (CHANGE + ", INTERACTION=A, RESET\n*FRICTION\n.1\n", "which takes none", 7),
        (CHANGE + ", INTERACTION=A\n*FRICTION, USER\n", "user routine", 7),
        (CHANGE + ", INTERACTION=A, AMPLITUDE=x\n*FRICTION\n.1\n", "no amplitude is called", 6),
        (CHANGE + ", ELSET=A, RESET\n*CHANGE FRICTION, ELSET=a, RESET\n", "changed twice", 7),
        (BASE + "*STEP\n*END STEP\n*CHANGE FRICTION, ELSET=A, RESET\n", "outside of a step", 6),
        (BASE + "*STEP\n*DYNAMIC, EXPLICIT\n*CHANGE FRICTION, ELSET=A, RESET\n", "implicit", 6),
        (BASE + "*STEP\n*STEP\n", "which is not ended", 5),
        (BASE + "*STEP, AMPLITUDE=UP\n", "expected STEP or RAMP", 4),
        (BASE + "*STEP\n*STATIC\n*END STEP\n*STEP\n*DYNAMIC, EXPL\n", "earlier steps are not", 8),
        ("*GAP\n*FRICTION\n0.3\n*FRICTION\n.2\n", "a second", 4),
        ("*CONNECTOR FRICTION\n*FRICTION, ROUGH\n", "cannot be used for connectors", 2),
        ("*SURFACE INTERACTION, NAME=A, USER\n*FRICTION\n0.3\n", "as a whole", 2),
    ],
)
def test_changes_and_steps(text, words, line):
    refused(text, words, line)


def test_user_friction_cannot_be_changed():
    text = HEAD + "*FRICTION, USER\n*STEP\n*CHANGE FRICTION, INTERACTION=A\n*FRICTION\n0.1\n"
    refused(text, "user routine", 4)


@pytest.mark.parametrize(
    ("curve", "words"),
    [
        ("*AMPLITUDE, NAME=x, DEFINITION=PERIODIC\n1, 2, 3\n", "expected TABULAR or SMOOTH STEP"),
        ("*AMPLITUDE, NAME=x, VALUE=ABSOLUTE\n0.,0.,1.,1.\n", "absolute"),
        ("*AMPLITUDE, NAME=x, TIME=TOTAL TIME\n0.,0.,1.,1.\n", "total times"),
        ("*AMPLITUDE, NAME=x\n0.,0.,1.,2.\n", "range from 0 to 1"),
        ("*AMPLITUDE, NAME=x\n0.,0.,1.,1.,2.,.5\n", "decrease"),
        ("*AMPLITUDE, NAME=x\n0.,0.,0.,1.\n", "does not follow"),
        ("*AMPLITUDE, NAME=x\n0.,0.,1.\n", "pairs"),
        ("*AMPLITUDE, NAME=x\n0.,zero\n", "expected a number"),
        ("*AMPLITUDE, NAME=x\n", "no data"),
        ("*AMPLITUDE, NAME=x, INPUT=curve.txt\n", "not read"),
        ("*AMPLITUDE, NAME=x, SCALEX=2.\n0.,0.,1.,1.\n", "not read"),
        ("*AMPLITUDE, NAME=x, DEFINITION=OTHER\n0.,0.,1.,1.\n", "not known"),
        ("*AMPLITUDE, NAME=x\n0.,0.,1.,1.\n*AMPLITUDE, NAME=X\n0.,0.,1.,1.\n", "defined twice"),
    ],
)
def test_amplitudes_matter_where_friction_refers_to_them(curve, words):
    assert deck.read(curve + BASE).amplitude("x") is not None
    text = BASE + "*STEP\n*CHANGE FRICTION, INTERACTION=A, AMPLITUDE=x\n*FRICTION\n.1\n*END STEP\n"
    refused(text + curve, words, 5)
    good = "*AMPLITUDE, NAME=x\n0.,0.,1.,0.5\n"
    assert "from 0 to 1" in deck.read(text + good).warnings[0].text


@pytest.mark.parametrize(
    ("text", "words", "line"),
    [
        ("*FRICTION, ROUGH\n", "no parameter", 2),
        ("*FRICTION\n", "missing", 2),
        ("*FRICTION\n0.3, 0.\n", "stick slope is 0", 3),
        ("*FRICTION\n0.3, 1e3, 5.\n", "at most 2", 3),
        ("*FRICTION\n0.3\n0.2\n", "one data line", 4),
        ("*STEP\n*CHANGE FRICTION, ELSET=A\n", "needs INTERACTION", 3),
        ("*STEP\n*CHANGE FRICTION, INTERACTION=A, RESET\n", "neither AMPLITUDE nor RESET", 3),
    ],
)
def test_calculix(text, words, line):
    refused(HEAD + text, words, line, dialect="calculix")
