# SPDX-License-Identifier: MIT
"""The shipped laws, behind every interface and in every language, against arbitrary precision."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mp, mpf, workdps

import usersub
from usersub import laws
from usersub.errors import LoadError, RoutineError

#: Every argument has its own value; the first temperature is that of the secondary surface.
N = 5
RATE = np.array([0.0, 3.5, 17.0, 120.0, 4000.0])
PRESSURE = np.array([110.0, 900.0, 1500.0, 2400.0, 3900.0])
WARM = np.array([90.0, 160.0, 210.0, 40.0, 310.0])
COLD = np.array([30.0, 70.0, 110.0, 20.0, 250.0])
AREA = np.array([0.5, 1.25, 2.0, 0.75, 3.0])

TABLE = [3, 2, 2, 1.0, 50.0, 200.0, 500.0, 2000.0, 60.0, 180.0]
TABLE_VALUES = [0.31, 0.27, 0.11, 0.36, 0.24, 0.19, 0.41, 0.33, 0.13, 0.28, 0.22, 0.17]

PROPS = {
    "coulomb": [0.15],
    "exponential_decay": [0.15, 0.05, 0.01],
    "temperature_pressure_decay": [8e-4, 2.5e-5, 3e-4, 1e-5, 0.02],
    "coulomb_tabulated": TABLE + TABLE_VALUES,
}

#: Relative tolerance by precision: a few rounding errors, and 1e-6 as the laws promise.
TOLERANCE = {"double": 1e-13, "single": 1e-6}


def _coulomb(rate, pressure, temperature):
    return mpf("0.15")


def _exponential(rate, pressure, temperature):
    return mpf("0.05") + mpf("0.1") * mp.exp(-mpf("0.01") * rate)


def _decay(rate, pressure, temperature):
    static = mpf("8e-4") * temperature + mpf("2.5e-5") * pressure
    kinetic = mpf("3e-4") * temperature + mpf("1e-5") * pressure
    return kinetic + (static - kinetic) * mp.exp(-mpf("0.02") * rate)


def _tabulated(rate, pressure, temperature):
    """By one-dimensional interpolation, variable after variable."""
    axes = [TABLE[3:6], TABLE[6:8], TABLE[8:10]]
    values = np.array(TABLE_VALUES).reshape(2, 2, 3)
    over_rate = [[_line(rate, axes[0], row) for row in plane] for plane in values]
    over_pressure = [_line(pressure, axes[1], row) for row in over_rate]
    return _line(temperature, axes[2], over_pressure)


def _line(x, points, values):
    x = min(max(x, mpf(points[0])), mpf(points[-1]))
    for i in range(len(points) - 1):
        if x <= points[i + 1]:
            share = (x - points[i]) / (mpf(points[i + 1]) - points[i])
            return values[i] + share * (mpf(values[i + 1]) - values[i])
    raise AssertionError("unreachable")


@pytest.fixture(autouse=True)
def _digits():
    """Digits of the truth here, whatever other modules have set."""
    with workdps(90):
        yield


TRUTH = {
    "coulomb": _coulomb,
    "exponential_decay": _exponential,
    "temperature_pressure_decay": _decay,
    "coulomb_tabulated": _tabulated,
}


def truth(law: str, temperature) -> np.ndarray:
    """Coefficients at the points above."""
    rows = zip(RATE, PRESSURE, temperature, strict=True)
    return np.array([float(TRUTH[law](*map(mpf, row))) for row in rows])


def truth_derivatives(law: str, temperature) -> np.ndarray:
    """Derivatives by slip rate, pressure and temperature; from above, as a table has kinks."""
    rows = zip(RATE, PRESSURE, temperature, strict=True)
    result = np.zeros((3, N))
    for k, row in enumerate(rows):
        at = tuple(map(mpf, row))
        for i in range(3):
            h = mpf(10) ** -40
            moved = tuple(x + h * (j == i) for j, x in enumerate(at))
            result[i, k] = float((TRUTH[law](*moved) - TRUTH[law](*at)) / h)
    return result


#: Single precision differs by the kind of the numbers alone: one law shows it.
SINGLE = ("temperature_pressure_decay", "single")


@pytest.mark.parametrize(("law", "precision"), [*((law, "double") for law in PROPS), SINGLE])
def test_vfric_coef(law, language, precision):
    routine = laws.routine(law, "vfric_coef", language, precision=precision)
    real = {"double": float, "single": np.float32}[precision]
    scene = usersub.Scene(points=N, props=PROPS[law], temperatures=1, precision=precision)
    driver = usersub.CoefficientDriver(routine, scene)
    temperature = 0.5 * (WARM + COLD)
    arrays = {"slip_rate": RATE, "pressure": PRESSURE, "temperature": temperature}
    mu = driver.evaluate(**{k: a.astype(real) for k, a in arrays.items()}, time_increment=0.01)
    assert mu == pytest.approx(truth(law, temperature), rel=TOLERANCE[precision])


@pytest.mark.parametrize("law", PROPS)
def test_fric_coef_with_derivatives(law, language):
    routine = laws.routine(law, "fric_coef", language)
    scene = usersub.Scene(points=N, props=PROPS[law], temperatures=1, derivatives=1)
    driver = usersub.CoefficientDriver(routine, scene)
    temperature = 0.5 * (WARM + COLD)
    slip_data = np.asfortranarray(np.arange(6.0 * N).reshape(6, N) + 1000.0)
    slip_data[0] = RATE
    mu = driver.evaluate(
        slip_data=slip_data, pressure=PRESSURE, temperature=temperature, time_increment=0.01
    )
    assert mu == pytest.approx(truth(law, temperature), rel=1e-13)
    # Far in the decay the derivative is a difference of nearly equal numbers: hence the floor.
    expected = truth_derivatives(law, temperature)
    assert driver.array("derivative") == pytest.approx(expected, rel=1e-12, abs=1e-25)


def _explicit(routine, precision, props, analytical=False, stick=1e30, dt=0.25):
    """Forces of the five points, that slide in different directions on differing planes."""
    general = routine.interface.name != "vfric"
    real = {"double": float, "single": np.float32}[precision]
    corners = 1 if analytical else 4
    sizes = {"nodes": N + corners} if general else {"secondary_nodes": N, "main_nodes": corners}
    scene = usersub.Scene(
        points=N, props=props, temperatures=1, precision=precision, **sizes,
        contact="analytical-rigid" if analytical else "node-to-facet",
    )  # fmt: skip
    driver = usersub.ExplicitDriver(routine, scene)
    normal = np.zeros((3, N))
    normal[[2, 1, 0, 2, 1], range(N)] = 1.0
    along = np.zeros((3, N))
    along[[0, 2, 1, 1, 0], range(N)] = [1.0, -1.0, 1.0, -1.0, 1.0]
    order = np.array([2, 0, 4, 1, 3])  # contact points are not in the order of the surface
    area = np.empty(N)
    area[order] = AREA
    arrays = {
        "slip_increment": along * (RATE * dt),
        "normal": normal,
        "normal_force": PRESSURE * AREA,
        "stick_force": np.full(N, stick),
        "temperature_secondary": WARM,
        "temperature_main": COLD[:1] if analytical else COLD,
        "area": AREA if general else area,
    }
    arrays = {k: np.asfortranarray(a.astype(real)) for k, a in arrays.items()}
    node = (order + 1).astype(np.int32)
    arrays["secondary_node"] = node.reshape(1, N, order="F") if general else node
    if general:
        arrays["main_node"] = np.full((corners, 1 if analytical else N), N + 1, np.int32, order="F")
    return -np.einsum("ik,ik->k", driver.step(dt, **arrays).force, along)


@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
@pytest.mark.parametrize(
    ("law", "precision"), [("coulomb", "double"), ("temperature_pressure_decay", "double"), SINGLE]
)
def test_explicit_forces(law, interface, language, precision):
    routine = laws.routine(law, interface, language, precision=precision)
    force = _explicit(routine, precision, PROPS[law])
    expected = truth(law, 0.5 * (WARM + COLD)) * PRESSURE * AREA
    # Points 1 ... N-1 slide; at rest the force has the direction of an arbitrary axis.
    assert force[1:] == pytest.approx(expected[1:], rel=TOLERANCE[precision])


@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
def test_analytical_surface_has_one_temperature(interface, language):
    law = "temperature_pressure_decay"
    routine = laws.routine(law, interface, language)
    force = _explicit(routine, "double", PROPS[law], analytical=True)
    expected = truth(law, 0.5 * (WARM + COLD[0])) * PRESSURE * AREA
    assert force[1:] == pytest.approx(expected[1:], rel=1e-13)


@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
def test_stick_force_bounds_the_force(interface, language):
    routine = laws.routine("coulomb", interface, language)
    force = _explicit(routine, "double", [0.15], stick=60.0)
    expected = np.minimum(0.15 * PRESSURE * AREA, 60.0)
    assert (expected < 60.0).any() and (expected == 60.0).any()
    assert force[1:] == pytest.approx(expected[1:], rel=1e-14)


@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
def test_creep_in_explicit_analyses(interface, language):
    routine = laws.routine("viscoplastic_creep", interface, language)
    force = _explicit(routine, "double", [0.04], stick=2000.0)
    expected = np.minimum(RATE / 0.04 * AREA, 2000.0)
    assert (expected < 2000.0).any() and (expected == 2000.0).any()
    assert force[1:] == pytest.approx(expected[1:], rel=1e-14)


def test_legacy_fric_coef_of_the_same_function():
    from usersub.laws.lift import bounded_exp, coefficient_law

    def halved(slip_rate, pressure, _temperature, props):
        share = props[0] * bounded_exp(-slip_rate)
        return share * pressure, -share * pressure, share, 0.0

    routine = coefficient_law(halved, props=1, generation="legacy")[1]
    scene = usersub.Scene(points=2, props=[0.5], derivatives=1)
    driver = usersub.CoefficientDriver(routine, scene)
    mu = driver.evaluate(
        slip_rate=np.array([0.0, 1.0]), pressure=np.array([3.0, 5.0]), time_increment=0.1
    )
    e = np.exp(-1.0)
    assert mu == pytest.approx([1.5, 2.5 * e], rel=1e-15)
    derivative = driver.array("derivative")
    assert derivative == pytest.approx(np.array([[-1.5, -2.5 * e], [0.5, 0.5 * e], [0, 0]]))


def test_too_few_properties_are_refused(language):
    routine = laws.routine("exponential_decay", "vfric_coef", language)
    scene = usersub.Scene(points=1, props=[0.2, 0.1])
    driver = usersub.CoefficientDriver(routine, scene)
    told = "too few properties" if language == "python" else "needs 3 properties, not 2"
    with pytest.raises(RoutineError, match=told):
        driver.evaluate(slip_rate=np.ones(1), pressure=np.ones(1), time_increment=1.0)


@pytest.mark.parametrize(
    "props",
    [
        [2, 1, 1, 0.0, 200.0, 0.0, 0.0, 0.15],
        [0, 1, 1, 0.0, 0.0, 0.0, 0.1],
        [1e9, 1e9, 1e9, 0, 0, 0, 0],
    ],
    ids=["one short", "no rates", "huge"],
)
@pytest.mark.parametrize("interface", ["vfric_coef", "fric_coef"])
def test_table_has_to_fit_its_properties(props, interface, language):
    routine = laws.routine("coulomb_tabulated", interface, language)
    driver = usersub.CoefficientDriver(routine, usersub.Scene(points=1, props=props))
    rate = {"slip_rate": np.ones(1), "slip_data": np.ones((6, 1), order="F")}
    arrays = {k: a for k, a in rate.items() if k in driver.layout.ports}
    with pytest.raises(RoutineError):
        driver.evaluate(**arrays, pressure=np.ones(1), time_increment=1.0)


def test_table_of_one_value_is_coulomb(language):
    routine = laws.routine("coulomb_tabulated", "vfric_coef", language)
    scene = usersub.Scene(points=3, props=[1, 1, 1, 7.0, 8.0, 9.0, 0.15])
    driver = usersub.CoefficientDriver(routine, scene)
    mu = driver.evaluate(
        slip_rate=np.array([0.0, 7.0, 80.0]), pressure=np.ones(3), time_increment=1.0
    )
    assert mu.tolist() == [0.15, 0.15, 0.15]


#: Arguments behind what a law reads; a law that does not read it must not use them.
_READS = {
    "vfric": ({"dSlipFric"}, {"areaSec", "jConSecid"}, {"tempSec", "tempMain"}),
    "vfriction": ({"dSlipFric"}, {"areaCont"}, {"tempSec", "tempMain"}),
    "vfric_coef": ({"slipRate"}, {"pressure"}, {"tempAvg"}),
    "fric_coef": ({"slipData"}, {"pressure"}, {"tempAvg"}),
}


@pytest.mark.parametrize(
    ("law", "read"),
    [("coulomb", ()), ("exponential_decay", (0,)), ("temperature_pressure_decay", (0, 1, 2))],
)
def test_only_what_is_read_is_used(law, read, language):
    for interface, arguments in _READS.items():
        routine = laws.routine(law, interface, language)
        used = {a.modern for a, u in zip(routine.interface.args, routine.uses, strict=True) if u}
        everything = set().union(*arguments)
        expected = set().union(*(arguments[i] for i in read)) if read else set()
        assert used & everything == expected, interface


def test_registry_names_what_is_wrong():
    with pytest.raises(LoadError, match="did you mean 'coulomb'"):
        laws.load("colomb")
    with pytest.raises(LoadError, match="python, c, fortran, not in 'cobol'"):
        laws.path("coulomb", "cobol")
    with pytest.raises(LoadError, match="does not stand behind VFRIC_COEF: a viscous traction"):
        laws.routine("viscoplastic_creep", "vfric_coef")


def test_registry_is_complete():
    for name, law in laws.LAWS.items():
        for language in laws.LANGUAGES:
            assert laws.path(name, language).is_file()
        readme = (law.folder / "README.md").read_text()
        assert readme.startswith(f"# {name}\n")
        for word in ("**Properties**", "**State variables**", "**Limits**", "**Source**"):
            assert word in readme, (name, word)
        assert set(laws.load(name)) == set(law.interfaces)
    folders = {p.name for p in laws.paths.reference_impls().iterdir() if p.is_dir()}
    assert folders == set(laws.LAWS)
