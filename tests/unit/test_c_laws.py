# SPDX-License-Identifier: MIT
"""Laws in C, lifted to the interfaces by the headers; truth from mpmath."""

from __future__ import annotations

import dataclasses
import shutil
import subprocess
import sys

import numpy as np
import pytest

import usersub
from tests.unit import fortran_laws as model
from tests.unit import law_scenes as scenes
from tests.unit.c_laws import SOURCES, Source
from usersub import paths
from usersub.errors import LoadError, RoutineError

ALLOWABLE = scenes.ALLOWABLE
OWN_OR_DUAL = pytest.mark.parametrize("dual", [False, True], ids=["own", "dual"])


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Files of the laws: (name, dual, precision) to a loaded file."""
    folder, made = tmp_path_factory.mktemp("c-laws"), {}

    def get(name: str, dual: bool = False, precision: str = "double"):
        key = (name, dual, precision)
        if key not in made:
            path = folder / f"{name}{'_dual' * dual}.c"
            path.write_text(SOURCES[name].text(dual))
            made[key] = usersub.load(path, precision=precision)
        return made[key]

    return get


def written(folder, source: Source, name: str = "law.c"):
    """A file of its own, loaded."""
    path = folder / name
    path.write_text(source.text())
    return usersub.load(path)


def motion_of(regime: str, directions: int) -> tuple[float, ...]:
    """Motion of the second increment, after (.4, -.3) allowable elastic slips."""
    if directions == 1 and "corner" in regime:
        return ((0.5995 if "before" in regime else 0.6005) * ALLOWABLE,)
    return tuple(m * ALLOWABLE for m in scenes.REGIMES[regime][:directions])


@OWN_OR_DUAL
@pytest.mark.parametrize("directions", [1, 2])
@pytest.mark.parametrize("regime", scenes.REGIMES)
@pytest.mark.parametrize("name", SOURCES)
def test_fric_and_its_tangents(files, name, regime, directions, dual):
    law = SOURCES[name].law
    driver = scenes.standard(files(name, dual)["fric"], law, directions)
    scenes.iterate(driver, [0.4 * ALLOWABLE, -0.3 * ALLOWABLE][:directions], 40.0, 0.25)
    driver.commit()
    state = tuple(driver.state["state"][:, 0])
    motion = motion_of(regime, directions)
    found = scenes.iterate(driver, motion, 70.0, 0.125)
    now = model.Increment(
        motion, 70.0, scenes.TEMPERATURES, scenes.MEAN_FIELDS, 0.125, state, ALLOWABLE
    )
    tau, slip, end = model.fric(law, now)
    np.testing.assert_allclose(found.tau[:, 0], np.array(tau, float), rtol=1e-13)
    np.testing.assert_allclose(found.dslip[:, 0], np.array(slip, float), rtol=1e-11, atol=1e-17)
    work = float(sum(t * s for t, s in zip(tau, slip, strict=True)))
    assert found.sfd[0] == pytest.approx(work, rel=1e-11, abs=1e-18)
    scenes.check_tangents(found, law, now)
    driver.commit()
    np.testing.assert_allclose(driver.state["state"][:, 0], np.array(end, float), rtol=1e-12)


def test_the_cap_is_reached_and_left(files):
    """The regimes above lie on both sides of the shear limit of the law."""
    driver = scenes.standard(files("capped")["fric"], SOURCES["capped"].law, 1)
    below = scenes.iterate(driver, (3 * ALLOWABLE,), 40.0, 0.125).tau[0, 0]
    driver.cut_back()
    above = scenes.iterate(driver, (3 * ALLOWABLE,), 70.0, 0.125).tau[0, 0]
    assert below < 16.0
    assert above == pytest.approx(16.0, rel=1e-15)


@OWN_OR_DUAL
@pytest.mark.parametrize("directions", [1, 2])
@pytest.mark.parametrize("regime", scenes.REGIMES)
@pytest.mark.parametrize("name", ["worn", "plain", "planks", "capped"])
def test_fric_coef_in_the_penalty_driver(files, name, regime, directions, dual):
    """The same truth as behind FRIC: with it the derivative by the slip of the increment."""
    law = SOURCES[name].law
    driver = scenes.standard(
        files(name, dual)["fric_coef"], law, directions, states=law.states,
        anisotropic=int(name == "planks" and directions == 2),
    )  # fmt: skip
    scenes.iterate(driver, [0.4 * ALLOWABLE, -0.3 * ALLOWABLE][:directions], 40.0, 0.25)
    driver.commit()
    motion = motion_of(regime, directions)
    found = scenes.iterate(driver, motion, 70.0, 0.125)
    state = (*driver.state["elastic_slip"][:, 0], *kept(driver, law))
    now = model.Increment(
        motion, 70.0, scenes.TEMPERATURES, scenes.MEAN_FIELDS, 0.125, state, ALLOWABLE
    )
    tau, _, end = model.fric(law, now)
    np.testing.assert_allclose(found.tau[:, 0], np.array(tau, float), rtol=1e-13)
    scenes.check_tangents(found, law, now)
    driver.commit()
    state = (*driver.state["elastic_slip"][:, 0], *kept(driver, law))
    np.testing.assert_allclose(state, np.array(end, float), rtol=1e-12)


def kept(driver, law):
    return driver.state["state"][:, 0] if law.states else ()


@OWN_OR_DUAL
@pytest.mark.parametrize("name", SOURCES)
def test_cut_back_and_repetition_leave_no_trace(files, name, dual):
    law, made = SOURCES[name].law, []
    for rounds in (1, 3):
        driver = scenes.standard(files(name, dual)["fric"], law, 2)
        for dt in (0.25, 0.125):
            if rounds > 1:
                scenes.iterate(driver, (5.0, -7.0), 900.0, 2.0)
                driver.cut_back()
            driver.begin_increment(dt)
            for last in range(rounds)[::-1]:
                motion = np.array([[0.03], [0.01 + 0.5 * last]], order="F")
                found = driver.iterate(slip_increment=motion, pressure=np.array([8.0 + last]))
            driver.commit()
        made.append([found.tau, found.ddtddg, found.sfd, driver.state["state"].copy()])
    for once, often in zip(*made, strict=True):
        np.testing.assert_array_equal(once, often)


@pytest.mark.parametrize("name", ["worn", "planks", "spring", "viscous"])
def test_no_friction_and_no_memory_in_the_increment_that_closes(files, name):
    driver = scenes.standard(files(name)["fric"], SOURCES[name].law, 2)
    scenes.iterate(driver, (0.3, 0.4), 40.0, 0.25)
    driver.commit()
    assert driver.state["state"].any()
    driver.begin_increment(0.25)
    driver.iterate(closed=np.zeros(1, np.int32))
    driver.commit()
    driver.bind(closed=None)
    found = scenes.iterate(driver, (0.3, 0.4), 40.0, 0.25)
    driver.commit()
    assert not found.tau.any()
    assert not driver.state["state"].any()


@pytest.mark.parametrize("name", SOURCES)
def test_duals_leave_every_bit_of_the_values(files, name):
    """What comes out of FRIC without derivatives is the same, the derivatives to rounding."""
    generator = np.random.default_rng(5)
    own, dual = (
        scenes.standard(files(name, d)["fric"], SOURCES[name].law, 2) for d in (False, True)
    )
    for _ in range(100):
        motion = generator.normal(size=2) * ALLOWABLE * 10.0 ** generator.uniform(-2, 3)
        pressure, dt = generator.uniform(0.0, 90.0), 2.0 ** generator.integers(-9, 3)
        one, other = (scenes.iterate(d, motion, pressure, dt) for d in (own, dual))
        for array in ("tau", "dslip", "sed", "sfd"):
            np.testing.assert_array_equal(getattr(one, array), getattr(other, array))
        for array in ("ddtddg", "ddtddp", "ddtddt"):
            size = np.abs(getattr(one, array)).max()
            np.testing.assert_allclose(
                getattr(other, array), getattr(one, array), rtol=0, atol=1e-12 * size
            )
        own.commit()
        dual.commit()
        np.testing.assert_array_equal(own.state["state"], dual.state["state"])


LEANING = model.Law("leaning", "bristle", "", ("PROPS 1", "VECTORS 2"), "", "", (3.0,), None, 0, 2)


@pytest.mark.parametrize(
    "source",
    [
        Source(
            LEANING, "  for (int a = 0; a < 2; ++a)\n    vectors[0][a] += motion[a], "
            "vectors[1][a] -= 2 * motion[a], traction[a] = props[0] * vectors[0][a];", "",
        ),
        SOURCES["plain"],
    ],
    ids=["bristle", "penalty"],
)  # fmt: skip
def test_a_turn_of_the_directions_turns_the_memory(tmp_path, source):
    driver = scenes.standard(written(tmp_path, source)["fric"], source.law, 2)
    before = scenes.iterate(driver, (0.4 * ALLOWABLE, -0.3 * ALLOWABLE), 8.0, 0.5).tau[:, 0]
    driver.commit()
    state = driver.state["state"][:, 0].copy()
    turn = np.array([[0.6, -0.8], [0.8, 0.6]])
    driver.bind(rotation=np.asfortranarray(turn.reshape(2, 2, 1)))
    after = scenes.iterate(driver, (0.0, 0.0), 8.0, 0.5).tau[:, 0]
    driver.commit()
    np.testing.assert_allclose(after, turn @ before, rtol=1e-15, atol=1e-17)
    pairs = state.reshape(-1, 2)
    np.testing.assert_allclose(
        driver.state["state"][:, 0].reshape(-1, 2), pairs @ turn.T, rtol=1e-15, atol=1e-18
    )


@pytest.mark.parametrize("defines", [(), ("ANISOTROPIC",)], ids=["isotropic", "anisotropic"])
def test_a_slope_that_is_infinite_at_rest_spoils_no_stick(tmp_path, defines):
    value = "props[0] + sqrt(rate)"
    body = f"  mu[0] = {value}, mu[1] = props[0];" if defines else f"  return {value};"
    defines = ("PROPS 1", "READS_RATE", "DUAL", *defines)
    law = model.Law("root", "coefficient", "", defines, "", "", (0.25,), None)
    driver = scenes.standard(written(tmp_path, Source(law, body, ""))["fric"], law, 2)
    found = scenes.iterate(driver, (0.5 * ALLOWABLE, 0.25 * ALLOWABLE), 8.0, 0.5)
    stiffness = 0.25 * 8.0 / ALLOWABLE
    np.testing.assert_allclose(found.ddtddg[:, :, 0], stiffness * np.eye(2), rtol=1e-14)


def test_fields_beyond_those_of_the_scene_are_zero(tmp_path):
    defines = ("PROPS 1", "READS_FIELDS")
    law = model.Law("fields", "coefficient", "", defines, "", "", (0.25,), None)
    file = written(tmp_path, Source(law, "", "", "  return props[0] + fields[0] + 8 * fields[7];"))
    scene = usersub.Scene(points=3, props=law.props, fields=1)
    for interface in ("vfric_coef", "fric_coef"):
        driver = usersub.CoefficientDriver(file[interface], scene)
        field = np.array([[0.5, 1.0, 2.0]], order="F")
        found = driver.evaluate(field=field, slip_rate=np.ones(3), pressure=np.ones(3))
        np.testing.assert_array_equal(found, [0.75, 1.25, 2.25])


@pytest.mark.parametrize("pressure", [0.0, -3.0])
@pytest.mark.parametrize("name", sorted(set(SOURCES) - {"capped"}))
def test_pressure_zero_and_below(files, name, pressure):
    """Laws see no pressure below zero; at zero the derivative is the one from above."""
    law = SOURCES[name].law
    driver = scenes.standard(files(name)["fric"], law, 2)
    driver.bind(closed=np.ones(1, np.int32))
    found = scenes.iterate(driver, (0.03, -0.05), pressure, 0.125)
    state = tuple(driver.state["state"][:, 0])
    now = model.Increment(
        (0.03, -0.05), 0.0, scenes.TEMPERATURES, scenes.MEAN_FIELDS, 0.125, state, ALLOWABLE
    )
    np.testing.assert_allclose(
        found.tau[:, 0], np.array(model.fric(law, now)[0], float), rtol=1e-13, atol=1e-300
    )
    truth = model.fric_tangents(law, now)[1] if pressure == 0 else np.zeros(2)
    np.testing.assert_allclose(found.ddtddp[:, 0], truth, rtol=1e-9, atol=1e-300)


def flat(
    coefficients, defines=("PROPS 2", "ANISOTROPIC"), value="  mu[0] = props[0], mu[1] = props[1];"
):
    return Source(
        model.Law("flat", "coefficient", "", defines, "", "", coefficients, lambda q, p: None),
        value, "    derivative[0][0] = 0;",
    )  # fmt: skip


@pytest.mark.parametrize(
    "coefficients", [(0.25, 0.0), (0.0, 0.4), (0.0, 0.0), (0.1, 0.9), (0.5, 5e-9), (1e-4, 0.6)]
)
def test_frictionless_directions_as_in_the_penalty_driver(tmp_path, coefficients):
    source = flat(coefficients)
    file = written(tmp_path, source)
    own = scenes.standard(file["fric"], source.law, 2)
    driven = scenes.standard(file["fric_coef"], source.law, 2, states=0, anisotropic=1)
    generator = np.random.default_rng(7)
    for _ in range(60):
        motion = generator.normal(size=2) * ALLOWABLE * 10.0 ** generator.uniform(-1.5, 2)
        ours, theirs = (scenes.iterate(d, motion, 30.0, 0.03125) for d in (own, driven))
        for name in ("tau", "ddtddg", "ddtddp", "dslip", "sed", "sfd"):
            one, other = getattr(ours, name), getattr(theirs, name)
            np.testing.assert_allclose(one, other, rtol=1e-11, atol=1e-13 * np.abs(other).max())
        own.commit()
        driven.commit()


def test_a_jump_of_a_coefficient_is_found(tmp_path):
    """The second coefficient falls at a slip rate: between both of its values the point stays at
    that rate, as long as there is no other solution."""
    source = flat(
        (0.2, 0.9, 1.5), ("PROPS 3", "ANISOTROPIC", "READS_RATE"),
        "  mu[0] = props[0], mu[1] = rate < props[2] ? props[1] : props[1] / 2;",
    )  # fmt: skip
    driver = scenes.standard(written(tmp_path, source)["fric"], source.law, 2)
    for angle in np.linspace(0.1, 1.4, 25):
        motion = 2 * ALLOWABLE * np.array([np.cos(angle), np.sin(angle)])
        found = scenes.iterate(driver, motion, 30.0, 1e-2)
        driver.cut_back()
        assert np.isfinite(found.tau).all()
        assert np.isfinite(found.ddtddg).all()
        assert (np.sign(found.tau[:, 0]) == 1).all()
        assert np.abs(found.dslip[:, 0]).max() < 2 * ALLOWABLE


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize(("interface", "contact", "dimension"), scenes.EXPLICIT)
@pytest.mark.parametrize("name", ["worn", "plain", "cohesive", "viscous", "spring", "capped"])
def test_explicit_forces_and_states(files, name, interface, contact, dimension, precision):
    law = SOURCES[name].law
    if interface == "vfric_coef" and name not in ("plain", "capped"):
        with pytest.raises(LoadError, match="has no VFRIC_COEF"):
            files(name)[interface]
        return
    tolerance = 1e-12 if precision == "double" else 2e-5
    seen = scenes.explicit(
        files(name, precision=precision)[interface], law, precision, contact, dimension
    )
    before = np.zeros((seen[0][2].shape[0], scenes.POINTS))
    for given, force, state in seen:
        nodes = state.reshape(state.shape[0], -1, scenes.POINTS) if state.size else state[:, None]
        assert (nodes == nodes[:, :1]).all()
        state = nodes[:, 0] if state.size else before
        for k in range(scenes.POINTS):
            if given["normal_force"][k] == 0:
                assert not force[:, k].any()
                np.testing.assert_array_equal(state[:, k], before[:, k])
                continue
            truth, end = scenes.expected(law, given, before[:, k], k, precision)
            truth = np.array(truth, float)
            scale = np.abs(truth).max()
            np.testing.assert_allclose(force[:, k], truth, rtol=0, atol=tolerance * scale)
            if interface != "vfric_coef":
                np.testing.assert_allclose(
                    state[:, k], np.array(end, float), rtol=tolerance, atol=tolerance * 0.05
                )
        before = state


def coefficient_driver(routine, law, points, states=None, **more):
    scene = usersub.Scene(
        points=points, props=law.props, states=law.states if states is None else states,
        temperatures=1, fields=2, **more,
    )  # fmt: skip
    driver = usersub.CoefficientDriver(routine, scene)
    generator = np.random.default_rng(3)
    driver.bind(
        pressure=generator.uniform(1.0, 9.0, points),
        temperature=generator.uniform(200.0, 300.0, points),
        field=np.asfortranarray(generator.uniform(0.2, 0.9, (2, points))),
    )
    return driver


#: Arguments that only exist for what the law reads, by interface.
FETCHED = {
    "TEMPERATURE": {"fric": "TEMP", "fric_coef": "tempAvg", "vfric": "tempSec tempMain",
                    "vfriction": "tempSec tempMain", "vfric_coef": "tempAvg"},
    "FIELDS": {"fric": "PREDEF NPRED", "fric_coef": "fieldAvg nFields",
               "vfric": "preDefSec preDefMain nPred", "vfriction": "fieldSec fieldMain nFields",
               "vfric_coef": "fieldAvg nFields"},
    "RATE": {"fric": "", "fric_coef": "slipData", "vfric": "dSlipFric dTimCur",
             "vfriction": "dSlipFric rData", "vfric_coef": "slipRate"},
    "STATES": {"fric": "", "fric_coef": "iData rData", "vfric": "statev nStateVar",
               "vfriction": "state nStates nNodState"},
}  # fmt: skip


@pytest.mark.parametrize("form", ["coefficient", "strength", "traction", "anisotropic", "bristle"])
@pytest.mark.parametrize("reads", [None, *FETCHED])
def test_what_a_law_does_not_read_is_not_used(tmp_path, form, reads):
    defines = ["PROPS 1"] + ([] if reads is None else [f"READS_{reads}".replace("READS_S", "S")])
    if reads == "STATES":
        defines = ["PROPS 1", "STATES 1"]
    value = {"anisotropic": "mu[0] = mu[1] = props[0];", "bristle": "traction[0] = props[0];"}
    if form == "anisotropic":
        defines.append("ANISOTROPIC")
    law = model.Law(
        "bare", "coefficient" if form == "anisotropic" else form, "", tuple(defines), "", "",
        (0.3,), lambda q, p: None,
    )  # fmt: skip
    source = Source(
        law, f"  {value.get(form, '')}", "", "" if form in value else "  return props[0];"
    )
    file = written(tmp_path, source)
    for name, routine in file.items():
        used = {routine.interface.position(a.modern) for a, u in
                zip(routine.interface.args, routine.uses, strict=True) if u}  # fmt: skip
        for quantity, arguments in FETCHED.items():
            wanted = quantity == reads and not (form == "bristle" and quantity == "RATE")
            for argument in arguments.get(name, "").split():
                # the motion of a bristle; the number of directions of an anisotropic law
                own = (form, argument) in (("bristle", "dSlipFric"), ("anisotropic", "iData"))
                assert (routine.interface.position(argument) in used) == (wanted or own), argument


def test_fric_coef_leaves_the_second_coefficient_alone(files):
    """An isotropic routine may not touch it; the drivers see it."""
    law = SOURCES["plain"].law
    driver = coefficient_driver(files("plain")["fric_coef"], law, 3)
    driver.evaluate(slip_rate=np.array([0.5, 1.5, 2.5]))


def test_coefficient_interfaces_pass_no_pressure_below_zero(tmp_path):
    law = model.Law("root", "coefficient", "", ("PROPS 1", "READS_PRESSURE"), "", "", (0.25,), None)
    file = written(tmp_path, Source(law, "  return props[0] + sqrt(pressure);", ""))
    pressure = np.array([4.0, 0.0, -1.0])
    for interface in ("fric_coef", "vfric_coef"):
        driver = usersub.CoefficientDriver(file[interface], usersub.Scene(points=3, props=[0.25]))
        found = driver.evaluate(slip_rate=np.ones(3), pressure=pressure)
        np.testing.assert_array_equal(found, [2.25, 0.25, 0.25])


@pytest.mark.parametrize("two", [(), ("ANISOTROPIC",)], ids=["isotropic", "anisotropic"])
def test_what_is_not_asked_for_is_zero(tmp_path, two):
    value = "props[0] + pressure + temperature + slip + time_increment"
    body = f"  mu[0] = mu[1] = rate < 0 ? 1 : {value};" if two else f"  return {value};"
    law = model.Law("deaf", "coefficient", "", ("PROPS 1", "READS_RATE", *two), "", "", (0.25,),
                    None)  # fmt: skip
    driver = scenes.standard(written(tmp_path, Source(law, body, ""))["fric"], law, 2)
    tau = scenes.iterate(driver, (3.0, 4.0), 8.0, 0.25).tau[:, 0]
    np.testing.assert_allclose(tau, [0.25 * 8.0 * 0.6, 0.25 * 8.0 * 0.8], rtol=1e-15)


@pytest.mark.parametrize("wrong", [-0.25, float("inf")])
@pytest.mark.parametrize("kind", ["coefficient", "strength", "anisotropic"])
def test_what_is_below_zero_or_no_number_is_refused(tmp_path, kind, wrong):
    """A difference of infinities is no number; both coefficients count."""
    two = kind == "anisotropic"
    value = "props[0] < 0 ? props[0] : props[0] - props[0]"
    body = f"  mu[0] = 0.5, mu[1] = {value};" if two else f"  return {value};"
    defines = ("PROPS 1", "ANISOTROPIC") if two else ("PROPS 1",)
    kind = "coefficient" if two else kind
    law = model.Law("wrong", kind, "", defines, "", "", (0.25,), None)
    file = written(tmp_path, Source(law, body, ""))
    law = dataclasses.replace(law, props=(wrong,))
    driver = scenes.standard(file["fric"], law, 2)
    with pytest.raises(RoutineError, match=f"wrong behind FRIC returns a {kind} below zero, or no"):
        scenes.iterate(driver, (0.1, 0.1), 1.0, 0.25)


REFUSALS = [
    ("worn", "fric", {"states": 3}, "keeps its elastic slip in the first of 4 state variables"),
    ("planks", "fric", {"states": 2}, "keeps its elastic slip in the first of 3 state variables"),
    ("spring", "fric", {"states": 4}, "spring behind FRIC needs 5 state variables, not 4"),
    ("viscous", "fric", {"states": 0}, "viscous behind FRIC needs 1 state variables, not 0"),
    ("worn", "fric_coef", {"states": 1}, "worn behind FRIC_COEF needs 2 state variables, not 1"),
    ("worn", "fric", {"characteristic_length": 0.0}, "needs a characteristic length above zero"),
    ("planks", "fric", {"characteristic_length": 0.0}, "needs a characteristic length above zero"),
]


@pytest.mark.parametrize(("name", "interface", "wrong", "sentence"), REFUSALS)
def test_scenes_that_give_too_little(files, name, interface, wrong, sentence):
    with pytest.raises(RoutineError, match=sentence):
        driver = scenes.standard(files(name)[interface], SOURCES[name].law, 2, **wrong)
        scenes.iterate(driver, (0.1, 0.1), 1.0, 0.25)


@pytest.mark.parametrize("name", ["viscous", "spring"])
def test_no_time_passes(files, name):
    driver = scenes.standard(files(name)["fric"], SOURCES[name].law, 2)
    with pytest.raises(RoutineError, match=f"{name} behind FRIC needs a time increment above zero"):
        scenes.iterate(driver, (0.1, 0.1), 1.0, 0.0)


def test_state_of_fric_coef_belongs_to_one_point_a_call(files):
    """No driver asks for more; another host gets the sentence, and the end of the analysis."""
    face = files("worn")["fric_coef"].interface
    program = f"""
import ctypes, usersub
address = usersub.load({str(files("worn").path)!r}).symbol("fric_coef")
room = [(ctypes.c_double * 400)() for _ in range({len(face.args)})]
for position, value in (({face.position("nBlock")}, 3), ({face.position("nProps")}, 6)):
    room[position] = ctypes.byref(ctypes.c_int(value))
flags = (ctypes.c_int * 6)(1, 1, 1, 1, 2, 2)
room[{face.position("iData")}] = flags
ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * {len(face.args)})(address)(
    *[ctypes.cast(r, ctypes.c_void_p) for r in room])
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 1
    assert "worn behind FRIC_COEF keeps 2 state variables, which belong to one point" in done.stderr


def test_more_state_than_there_is_room(tmp_path):
    law = dataclasses.replace(SOURCES["worn"].law, defines=("PROPS 1", "STATES 3", "MOST 2"))
    file = written(tmp_path, Source(law, "", "", "  return state[0];"))
    driver = scenes.standard(file["fric"], law, 1, states=9)
    with pytest.raises(RoutineError, match="worn has 3 state variables, more than USUB_LAW_MOST"):
        scenes.iterate(driver, (0.1,), 1.0, 0.25)


def test_a_table_has_no_more_fields_than_there_is_room():
    source = paths.reference_impls() / "coulomb_tabulated" / "law.c"
    routine = usersub.load(source)["vfric_coef"]
    for fields in (256, 257):
        props = [1, 1, 1, fields, *[1] * fields, 0.0, 0.0, 0.0, *[0.0] * fields, 0.25]
        driver = usersub.CoefficientDriver(routine, usersub.Scene(points=1, props=props))
        arrays = {"slip_rate": np.ones(1), "pressure": np.ones(1)}
        if fields == 256:
            assert driver.evaluate(**arrays)[0] == 0.25
            continue
        with pytest.raises(RoutineError, match="coulomb_tabulated behind VFRIC_COEF needs 523"):
            driver.evaluate(**arrays)


COMPILERS = [
    ("gcc", "c11"), ("clang", "c11"), ("g++", "c++17"), ("clang++", "c++17"),
]  # fmt: skip


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize(("compiler", "standard"), COMPILERS)
def test_headers_are_clean(tmp_path, compiler, standard, precision):
    """Not a warning, in C and in C++; a law need not use all of its arguments."""
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is missing")
    single = ["-DUSUB_SINGLE"] if precision == "single" else []
    for name, source in SOURCES.items():
        path = tmp_path / f"{name}.c"
        path.write_text(source.text(dual=True))
        command = [compiler, f"-std={standard}", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O2",
                   f"-I{paths.include_folder()}", *single, "-c"]  # fmt: skip
        language = ["-x", "c++"] if "++" in compiler else []
        second = [[]] if single or not language else [[], ["-DUSUB_DUAL_PASS"]]
        for more in second:
            subprocess.run([*command, *more, *language, path, "-o", tmp_path / "law.o"], check=True)
