# SPDX-License-Identifier: MIT
"""Laws in Fortran, lifted to the interfaces by the include files; truth from mpmath."""

from __future__ import annotations

import subprocess

import numpy as np
import pytest
from mpmath import workdps

import usersub
from tests.unit import fortran_laws as model
from tests.unit.law_scenes import (
    ALLOWABLE,
    EXPLICIT,
    MEAN_FIELDS,
    REGIMES,
    TEMPERATURES,
    check_tangents,
    explicit,
    iterate,
    standard,
)
from usersub import paths
from usersub.errors import RoutineError

pytestmark = pytest.mark.needs_fortran

#: What the flags of a careful user complain about; a law need not use all of its arguments.
STRICT = ("-std=f2018", "-Wall", "-Wextra", "-Wno-unused-dummy-argument", "-Werror", "-O2")


@pytest.fixture(scope="module")
def files(tmp_path_factory, fortran):
    """Files of the laws: (name, differences, precision) to a loaded file."""
    folder, made = tmp_path_factory.mktemp("fortran-laws"), {}

    def get(name: str, differences: bool = False, precision: str = "double"):
        key = (name, differences, precision)
        if key not in made:
            path = folder / f"{name}{'_differences' * differences}.f90"
            path.write_text(model.LAWS[name].source(differences))
            made[key] = usersub.load(path, precision=precision)
        return made[key]

    return get


@pytest.fixture(autouse=True)
def _digits():
    with workdps(model.DIGITS):
        yield


KINDS = ("worn", "plain", "cohesive", "viscous", "planks", "spring")


@pytest.mark.parametrize("differences", [False, True], ids=["own", "differences"])
@pytest.mark.parametrize("directions", [1, 2])
@pytest.mark.parametrize("regime", REGIMES)
@pytest.mark.parametrize("name", KINDS)
def test_fric_and_its_tangents(files, name, regime, directions, differences):
    law = model.LAWS[name]
    driver = standard(files(name, differences)["fric"], law, directions)
    iterate(driver, [0.4 * ALLOWABLE, -0.3 * ALLOWABLE][:directions], 40.0, 0.25)
    driver.commit()
    state = tuple(driver.state["state"][:, 0])
    motion = tuple(m * ALLOWABLE for m in REGIMES[regime][:directions])
    if directions == 1 and "corner" in regime:
        motion = ((0.5995 if "before" in regime else 0.6005) * ALLOWABLE,)
    found = iterate(driver, motion, 70.0, 0.125)
    now = model.Increment(motion, 70.0, TEMPERATURES, MEAN_FIELDS, 0.125, state, ALLOWABLE)
    tau, slip, end = model.fric(law, now)
    sliding = {"stick": False, "before the corner": False}.get(regime, True)
    if law.kind in ("coefficient", "strength") and name != "planks":
        assert bool(found.dslip.any()) == sliding
    np.testing.assert_allclose(found.tau[:, 0], np.array(tau, float), rtol=1e-13)
    np.testing.assert_allclose(found.dslip[:, 0], np.array(slip, float), rtol=1e-11, atol=1e-17)
    work = float(sum(t * s for t, s in zip(tau, slip, strict=True)))
    assert found.sfd[0] == pytest.approx(work, rel=1e-11, abs=1e-18)
    check_tangents(found, law, now)
    driver.commit()
    np.testing.assert_allclose(driver.state["state"][:, 0], np.array(end, float), rtol=1e-12)


@pytest.mark.parametrize("differences", [False, True], ids=["own", "differences"])
@pytest.mark.parametrize("directions", [1, 2])
@pytest.mark.parametrize("regime", REGIMES)
@pytest.mark.parametrize("name", ["worn", "plain", "planks"])
def test_fric_coef_in_the_penalty_driver(files, name, regime, directions, differences):
    """The same truth as behind FRIC: with it the derivative by the slip of the increment."""
    law = model.LAWS[name]
    anisotropic = int(name == "planks" and directions == 2)
    driver = standard(
        files(name, differences)["fric_coef"], law, directions, states=law.states,
        anisotropic=anisotropic,
    )  # fmt: skip
    iterate(driver, [0.4 * ALLOWABLE, -0.3 * ALLOWABLE][:directions], 40.0, 0.25)
    driver.commit()
    motion = tuple(m * ALLOWABLE for m in REGIMES[regime][:directions])
    found = iterate(driver, motion, 70.0, 0.125)
    state = (*driver.state["elastic_slip"][:, 0], *driver.state["state"][:, 0])
    now = model.Increment(motion, 70.0, TEMPERATURES, MEAN_FIELDS, 0.125, state, ALLOWABLE)
    tau, _, end = model.fric(law, now)
    np.testing.assert_allclose(found.tau[:, 0], np.array(tau, float), rtol=1e-13)
    check_tangents(found, law, now)
    driver.commit()
    state = (*driver.state["elastic_slip"][:, 0], *driver.state["state"][:, 0])
    np.testing.assert_allclose(state, np.array(end, float), rtol=1e-12)


@pytest.mark.parametrize("name", KINDS)
def test_vectors_turn_with_the_local_directions(files, name):
    law = model.LAWS[name]
    driver = standard(files(name)["fric"], law, 2)
    iterate(driver, (0.9 * ALLOWABLE, -0.7 * ALLOWABLE), 40.0, 0.25)
    driver.commit()
    state = driver.state["state"][:, 0].copy()
    turn = np.array([[np.cos(0.4), -np.sin(0.4)], [np.sin(0.4), np.cos(0.4)]])
    driver.bind(rotation=np.asfortranarray(turn[:, :, None]))
    motion = (0.3 * ALLOWABLE, 0.2 * ALLOWABLE)
    found = iterate(driver, motion, 70.0, 0.125)
    turning = {"bristle": law.vectors, "traction": 0}.get(law.kind, 1)
    for v in range(turning):
        state[2 * v : 2 * v + 2] = turn @ state[2 * v : 2 * v + 2]
    now = model.Increment(motion, 70.0, TEMPERATURES, MEAN_FIELDS, 0.125, tuple(state), ALLOWABLE)
    tau, _, end = model.fric(law, now)
    np.testing.assert_allclose(found.tau[:, 0], np.array(tau, float), rtol=1e-12)
    driver.commit()
    np.testing.assert_allclose(driver.state["state"][:, 0], np.array(end, float), rtol=1e-12)


@pytest.mark.parametrize("differences", [False, True], ids=["own", "differences"])
@pytest.mark.parametrize("name", KINDS)
def test_cut_back_and_repetition_leave_no_trace(files, name, differences):
    law, made = model.LAWS[name], []
    for rounds in (1, 3):
        driver = standard(files(name, differences)["fric"], law, 2)
        for dt in (0.25, 0.125):
            if rounds > 1:
                iterate(driver, (5.0, -7.0), 900.0, 2.0)
                driver.cut_back()
            driver.begin_increment(dt)
            for last in range(rounds)[::-1]:
                motion = np.array([[0.03], [0.01 + 0.5 * last]], order="F")
                found = driver.iterate(slip_increment=motion, pressure=np.array([8.0 + last]))
            driver.commit()
        made.append([found.tau, found.ddtddg, found.sfd, driver.state["state"].copy()])
    for once, often in zip(*made, strict=True):
        np.testing.assert_array_equal(once, often)


def test_no_friction_and_no_memory_in_the_increment_that_closes(files):
    driver = standard(files("worn")["fric"], model.COEFFICIENT, 2)
    iterate(driver, (0.3, 0.4), 40.0, 0.25)
    driver.commit()
    assert driver.state["state"].all()
    driver.begin_increment(0.25)
    driver.iterate(closed=np.zeros(1, np.int32))
    driver.commit()
    driver.bind(closed=None)
    found = iterate(driver, (0.3, 0.4), 40.0, 0.25)
    driver.commit()
    assert not found.tau.any() and not driver.state["state"].any()


@pytest.mark.parametrize("pressure", [0.0, -3.0])
@pytest.mark.parametrize("name", KINDS)
def test_pressure_zero_and_below(files, name, pressure):
    """Laws see no pressure below zero; at zero the derivative is the one from above."""
    law = model.LAWS[name]
    driver = standard(files(name)["fric"], law, 2)
    driver.bind(closed=np.ones(1, np.int32))
    found = iterate(driver, (0.03, -0.05), pressure, 0.125)
    state = tuple(driver.state["state"][:, 0])
    now = model.Increment((0.03, -0.05), 0.0, TEMPERATURES, MEAN_FIELDS, 0.125, state, ALLOWABLE)
    np.testing.assert_allclose(
        found.tau[:, 0], np.array(model.fric(law, now)[0], float), rtol=1e-13, atol=1e-300
    )
    truth = model.fric_tangents(law, now)[1] if pressure == 0 else np.zeros(2)
    np.testing.assert_allclose(found.ddtddp[:, 0], truth, rtol=1e-9, atol=1e-300)


def test_coefficient_interfaces_pass_no_pressure_below_zero(tmp_path):
    path = tmp_path / "root.f90"
    law = model.Law("root", "coefficient", model.SCALAR, ("PROPS 1", "READS_PRESSURE"),
                    "    answer = props(1) + sqrt(pressure)", "", (0.25,), None)  # fmt: skip
    path.write_text(law.source())
    file, pressure = usersub.load(path), np.array([4.0, 0.0, -1.0])
    for interface in ("fric_coef", "vfric_coef"):
        driver = usersub.CoefficientDriver(file[interface], usersub.Scene(points=3, props=[0.25]))
        found = driver.evaluate(slip_rate=np.ones(3), pressure=pressure)
        np.testing.assert_array_equal(found, [2.25, 0.25, 0.25])


@pytest.mark.parametrize("wrong", [-0.25, np.inf])
@pytest.mark.parametrize("kind", ["coefficient", "strength", "anisotropic"])
def test_what_is_below_zero_or_no_number_is_refused(tmp_path, kind, wrong):
    """A difference of infinities is no number; both coefficients count."""
    two = kind == "anisotropic"
    value = "merge(props(1), props(1) - props(1), props(1) < 0)"
    kind = "coefficient" if two else kind
    law = model.Law(
        "wrong", kind, model.PAIR if two else model.SCALAR, ("PROPS 1", *["ANISOTROPIC"] * two),
        f"    mu = [0.5_wp, {value}]" if two else f"    answer = {value}",
        "", (wrong,), None,
    )  # fmt: skip
    path = tmp_path / "wrong.f90"
    path.write_text(law.source())
    driver = standard(usersub.load(path)["fric"], law, 2)
    with pytest.raises(RoutineError, match=f"wrong behind FRIC returns a {kind} below zero, or no"):
        iterate(driver, (0.1, 0.1), 1.0, 0.25)


@pytest.mark.parametrize(
    "coefficients", [(0.25, 0.0), (0.0, 0.4), (0.0, 0.0), (0.1, 0.9), (0.5, 5e-9), (1e-4, 0.6)]
)
def test_frictionless_directions_as_in_the_penalty_driver(tmp_path, coefficients):
    law = model.Law(
        "flat", "coefficient", model.PAIR, ("PROPS 2", "ANISOTROPIC"), "    mu = props(1:2)",
        "      derivative = 0", coefficients, lambda q, p: None,
    )  # fmt: skip
    path = tmp_path / "flat.f90"
    path.write_text(law.source())
    file = usersub.load(path)
    own = standard(file["fric"], law, 2)
    driven = standard(file["fric_coef"], law, 2, states=0, anisotropic=1)
    generator = np.random.default_rng(7)
    for _ in range(60):
        motion = generator.normal(size=2) * ALLOWABLE * 10.0 ** generator.uniform(-1.5, 2)
        ours, theirs = (iterate(d, motion, 30.0, 0.03125) for d in (own, driven))
        for name in ("tau", "ddtddg", "ddtddp", "dslip", "sed", "sfd"):
            one, other = getattr(ours, name), getattr(theirs, name)
            np.testing.assert_allclose(one, other, rtol=1e-11, atol=1e-13 * np.abs(other).max())
        own.commit()
        driven.commit()


def test_a_jump_of_a_coefficient_is_found(tmp_path):
    """The second coefficient falls at a slip rate: between both of its values the point stays at
    that rate, as long as there is no other solution."""
    law = model.Law(
        "jump", "coefficient", model.PAIR, ("PROPS 3", "ANISOTROPIC", "READS_RATE"),
        "    mu = [props(1), merge(props(2), props(2)/2, rate < props(3))]", "      derivative = 0",
        (0.2, 0.9, 1.5), lambda q, p: None,
    )  # fmt: skip
    path = tmp_path / "jump.f90"
    path.write_text(law.source())
    driver = standard(usersub.load(path)["fric"], law, 2)
    for angle in np.linspace(0.1, 1.4, 25):
        motion = 2 * ALLOWABLE * np.array([np.cos(angle), np.sin(angle)])
        found = iterate(driver, motion, 30.0, 1e-2)
        driver.cut_back()
        assert np.isfinite(found.tau).all() and np.isfinite(found.ddtddg).all()
        assert (np.sign(found.tau[:, 0]) == 1).all()
        assert np.abs(found.dslip[:, 0]).max() < 2 * ALLOWABLE


#: Arguments behind what a law reads.
BEHIND = {
    "fric": ({"DTIME"}, {"TEMP"}, {"PREDEF"}),
    "fric_coef": ({"slipData"}, {"pressure"}, {"tempAvg"}, {"fieldAvg"}),
    "vfric": ({"dSlipFric"}, {"areaSec", "jConSecid"}, {"tempSec", "tempMain"},
              {"preDefSec", "preDefMain"}, {"statev"}),
    "vfriction": ({"dSlipFric"}, {"areaCont"}, {"tempSec", "tempMain"},
                  {"fieldSec", "fieldMain"}, {"state"}),
    "vfric_coef": ({"slipRate"}, {"pressure"}, {"tempAvg"}, {"fieldAvg"}),
}  # fmt: skip


def test_what_is_not_read_is_not_used(tmp_path, files):
    constant = model.Law(
        "constant", "coefficient", model.SCALAR, ("PROPS 1",), "    answer = props(1)",
        "      derivative = 0", (0.3,), lambda q, p: None,
    )  # fmt: skip
    path = tmp_path / "constant.f90"
    path.write_text(constant.source())
    for interface, groups in BEHIND.items():
        everything = set().union(*groups)
        assert not used(usersub.load(path)[interface]) & everything
        if interface != "vfric_coef":
            assert used(files("worn")[interface]) >= everything
    assert used(files("plain")["vfric_coef"]) & {"pressure", "tempAvg", "fieldAvg"} == {"fieldAvg"}
    assert "STATEV" not in used(usersub.load(_viscous(tmp_path))["fric"])


def used(routine) -> set[str]:
    return {a.modern for a, u in zip(routine.interface.args, routine.uses, strict=True) if u}


def _viscous(folder):
    law = model.Law(
        "linear", "traction", model.SCALAR, ("PROPS 1", "READS_RATE"), "    answer = props(1)*rate",
        "      derivative(1) = props(1)", (0.3,), lambda q, p: None,
    )  # fmt: skip
    path = folder / "linear.f90"
    path.write_text(law.source())
    return path


def test_refusals_name_what_is_missing(files, tmp_path):
    def fails(routine, match, **settings):
        scene = {"props": model.COEFFICIENT.props, "states": 4, "characteristic_length": 1.0}
        scene |= {"temperatures": 1, "fields": 2}
        driver = usersub.StandardDriver(routine, usersub.Scene(points=1, **(scene | settings)))
        driver.bind(
            temperature_secondary=np.ones(1), temperature_main=np.ones(1),
            field_secondary=np.ones((2, 1), order="F"), field_main=np.ones((2, 1), order="F"),
        )  # fmt: skip
        with pytest.raises(RoutineError, match=match):
            for _ in range(2):
                driver.begin_increment(0.0)
                motion = np.full((2, 1), 0.1, order="F")
                driver.iterate(slip_increment=motion, pressure=np.ones(1))
                driver.commit()

    worn = files("worn")
    fails(worn["fric"], "worn behind FRIC needs 6 properties, not 1", props=[0.1])
    fails(worn["fric"], r"in 4 state variables, but the scene has 3", states=3)
    fails(worn["fric"], "needs a characteristic length above zero", characteristic_length=0.0)
    fails(worn["fric_coef"], "behind FRIC_COEF keeps 2 state variables, but the scene has 1",
          states=1)  # fmt: skip
    spring = files("spring")
    fails(spring["fric"], "keeps 5 state variables, but the scene has 4", props=model.SPRING.props)
    fails(spring["fric"], "needs a time increment", props=model.SPRING.props, states=5)
    for name, interface, needed in (("worn", "vfric", 2), ("spring", "vfriction", 7)):
        law = model.LAWS[name]
        routine = files(name)[interface]
        scene = usersub.Scene(
            points=1, props=law.props, states=needed - 1, temperatures=1, fields=2,
            secondary_nodes=1, main_nodes=4, nodes=5,
        )  # fmt: skip
        driver = usersub.ExplicitDriver(routine, scene)
        one = ("area", "normal_force", "stick_force", "temperature_secondary", "temperature_main")
        arrays = {k: np.ones(1) for k in one}
        arrays |= {k: np.ones((2, 1), order="F") for k in ("field_secondary", "field_main")}
        arrays["normal"] = np.array([[1.0], [0.0], [0.0]], order="F")
        arrays["slip_increment"] = arrays["normal"][::-1].copy(order="F")
        number = np.ones(1, np.int32)
        arrays["secondary_node"] = number if interface == "vfric" else number.reshape(1, 1)
        arrays["main_node"] = np.ones((4, 1), np.int32, order="F")
        with pytest.raises(RoutineError, match=f"keeps {needed} state variables, but the scene"):
            driver.step(0.1, **arrays)


def gfortran(folder, source, flags, precision="double"):
    """Compiles outside of usersub; words of the compiler."""
    (folder / "law.f90").write_text(source)
    command = ["gfortran", "-cpp", "-ffree-form", "-fPIC", "-shared", *flags]
    if precision == "single":
        command.append("-DUSUB_SINGLE")
    library = paths.library_path()
    places = [f"-I{paths.include_folder()}", f"-J{folder}", f"-L{library.parent}", "-lusersub"]
    done = subprocess.run(
        [*command, "law.f90", "-o", "law.so", *places], cwd=folder, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stderr


@pytest.mark.parametrize("differences", [False, True], ids=["own", "differences"])
@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("name", KINDS)
def test_no_warnings(tmp_path, name, precision, differences):
    source = model.LAWS[name].source(differences)
    assert gfortran(tmp_path, source, STRICT, precision) == ""


@pytest.mark.parametrize("name", KINDS)
def test_with_all_checks_of_the_compiler(tmp_path, name):
    """Bounds, shapes, uninitialised numbers (as NaN); the answers are those without checks."""
    law = model.LAWS[name]
    flags = ("-O0", "-g", "-fcheck=all", "-finit-real=snan", "-finit-integer=-99999")
    for differences in (False, True):
        folder = tmp_path / str(differences)
        folder.mkdir()
        gfortran(folder, law.source(differences), flags)
        file = usersub.load(folder / "law.so")
        for directions in (1, 2):
            driver = standard(file["fric"], law, directions)
            for motion in REGIMES.values():
                state = tuple(driver.state["state"][:, 0])
                motion = tuple(m * ALLOWABLE for m in motion[:directions])
                found = iterate(driver, motion, 70.0, 0.125)
                now = model.Increment(
                    motion, 70.0, TEMPERATURES, MEAN_FIELDS, 0.125, state, ALLOWABLE
                )
                tau = np.array(model.fric(law, now)[0], float)
                np.testing.assert_allclose(found.tau[:, 0], tau, rtol=1e-12)
                driver.commit()
        if name == "planks":
            continue
        for interface, contact, dimension in EXPLICIT:
            if interface in file:
                checked = explicit(file[interface], law, "double", contact, dimension)
                assert all(np.isfinite(force).all() for _, force, _ in checked)
