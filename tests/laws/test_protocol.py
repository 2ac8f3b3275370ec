# SPDX-License-Identifier: MIT
"""What is no number of a law: refusals, closing points, unused arguments, analytical surfaces."""

from __future__ import annotations

import law_cases
import law_host
import numpy as np
import pytest
from law_cases import floats

import usersub
from usersub import abi, laws
from usersub.errors import LoadError, RoutineError

LENGTH = 0.5
ALLOWABLE = 0.005 * LENGTH

REFUSED = [
    pytest.param(law.name, interface, id=f"{law.name}-{interface}")
    for law in laws.LAWS.values()
    for interface in abi.NAMES
    if interface not in law.interfaces
]


@pytest.mark.parametrize("law", laws.LAWS)
def test_files_hold_exactly_the_interfaces(law, language):
    assert set(laws.load(law, language)) == set(laws.law(law).interfaces)


@pytest.mark.parametrize(("law", "interface"), REFUSED)
def test_other_interfaces_are_refused_with_the_reason(law, interface, language):
    reason = laws.law(law).refusal(interface)
    with pytest.raises(LoadError) as raised:
        laws.routine(law, interface, language)
    assert f"the law {law} does not stand behind {interface.upper()}: {reason}" in str(raised.value)


def _props(law: str) -> list[float]:
    return [float(p) for p in law_cases.reference(law)[0]["props"]]


def _points(law: str) -> list[dict]:
    """Entries of the first case (points, or increments of a path) that have a pressure."""
    case = law_cases.reference(law)[0]
    found = case.get("points") or case["path"]
    return [p for p in found if float(p["pressure"]) > 0 and float(p["time_increment"]) > 0]


def _standard(law, language, directions=2, interface="fric", **changes):
    described, props = laws.law(law), changes.get("props", _props(law))
    settings = {
        "points": 1, "dimension": directions + 1, "props": props,
        "temperatures": 1, "characteristic_length": LENGTH,
        "fields": len(_points(law)[0]["fields"]), "temperature_tangent": 1,
        "states": described.state_count(interface, directions, directions + 1, _props(law)),
    }  # fmt: skip
    routine = laws.routine(law, interface, language)
    return usersub.StandardDriver(routine, usersub.Scene(**{**settings, **changes}))


def _iterate(driver, motion, pressure, closed=None):
    fields = np.zeros((driver.scene.fields, 1), order="F")
    arrays = {"field_secondary": fields, "field_main": fields} if driver.scene.fields else {}
    return driver.iterate(
        slip_increment=np.asfortranarray(np.reshape(motion, (-1, 1)).astype(float)),
        pressure=np.array([float(pressure)]),
        temperature_secondary=np.array([30.0]),
        temperature_main=np.array([30.0]),
        closed=None if closed is None else np.array([closed], np.int32),
        **arrays,
    )


def _increment(driver, motion, pressure, dt=0.25, closed=None):
    driver.begin_increment(dt)
    response = _iterate(driver, motion, pressure, closed)
    driver.commit()
    return response


FRIC = [name for name in law_cases.names() if "fric" in laws.law(name).interfaces]


@pytest.mark.parametrize("law", FRIC)
def test_closing_increment_is_frictionless(law, language):
    response = _increment(_standard(law, language), [0.2, 0.1], 500.0)
    assert response.lm.tolist() == [2]
    assert not response.tau.any() and not response.sfd.any()


@pytest.mark.parametrize("law", FRIC)
def test_reopened_point_has_forgotten_everything(law, language):
    fresh, reopened = (_standard(law, language) for _ in range(2))
    _increment(fresh, [0.0, 0.0], 900.0)
    for pressure in (900.0, 900.0, -1.0, 900.0):
        _increment(reopened, [0.3, 0.1], pressure)
    results = [_increment(d, [0.25 * ALLOWABLE, 0.0], 900.0) for d in (fresh, reopened)]
    assert np.array_equal(results[0].tau, results[1].tau)
    if fresh.scene.states:
        assert np.array_equal(fresh.state["state"], reopened.state["state"])


@pytest.mark.parametrize("law", FRIC)
def test_negative_pressure_of_a_closed_point_counts_as_zero(law, language):
    results = []
    for pressure in (0.0, -40.0):
        driver = _standard(law, language)
        _increment(driver, [0.0, 0.0], 500.0)
        results.append(_increment(driver, [0.2, 0.4], pressure, closed=1))
    zero, negative = results
    assert np.array_equal(zero.tau, negative.tau)
    assert np.array_equal(zero.ddtddg, negative.ddtddg)
    assert not negative.ddtddp.any()


@pytest.mark.parametrize("law", [n for n in law_cases.names() if laws.law(n).props])
def test_too_few_properties_are_refused(law, language):
    interface = laws.law(law).interfaces[0]
    driver = _standard(law, language, interface=interface, props=[])
    told = r"too few properties|needs \d+ properties, not 0"
    with pytest.raises(RoutineError, match=told):
        _increment(driver, [0.0, 0.0], 900.0)
        _increment(driver, [1.0, 0.5], 900.0)


@pytest.mark.parametrize("law", FRIC)
def test_too_few_states_are_refused(law, language):
    needed = laws.law(law).state_count("fric", 2, 3, _props(law))
    if not needed:
        return
    driver = _standard(law, language, states=needed - 1)
    _increment(driver, [0.0, 0.0], 900.0)
    with pytest.raises(RoutineError, match="state variable"):
        _increment(driver, [1.0, 0.5], 900.0)


@pytest.mark.parametrize(
    "law", [n for n in FRIC if laws.law(n).kind in ("coefficient", "strength")]
)
def test_penalty_needs_a_characteristic_length(law, language):
    driver = _standard(law, language, characteristic_length=0.0)
    _increment(driver, [0.0, 0.0], 900.0)
    with pytest.raises(RoutineError, match="needs a characteristic length above zero"):
        _increment(driver, [1.0, 0.5], 900.0)


@pytest.mark.parametrize("law", law_cases.names(["traction"]))
def test_traction_needs_time(law, language):
    driver = _standard(law, language)
    _increment(driver, [0.0, 0.0], 900.0)
    with pytest.raises(RoutineError, match="needs a time increment"):
        _increment(driver, [1.0, 0.5], 900.0, dt=0.0)


#: Arguments that hold a quantity; a law that does not read it must not use them.
_ARGUMENTS = {
    "fric_coef": {"slip": {"slipData"}, "pressure": {"pressure"}, "temperature": {"tempAvg"},
                  "fields": {"fieldAvg"}},
    "vfric": {"slip": {"dSlipFric"}, "pressure": {"areaSec", "jConSecid"},
              "temperature": {"tempSec", "tempMain"}, "fields": {"preDefSec", "preDefMain"}},
    "vfriction": {"slip": {"dSlipFric"}, "pressure": {"areaCont"},
                  "temperature": {"tempSec", "tempMain"}, "fields": {"fieldSec", "fieldMain"}},
    "vfric_coef": {"slip": {"slipRate"}, "pressure": {"pressure"}, "temperature": {"tempAvg"},
                   "fields": {"fieldAvg"}},
}  # fmt: skip


@pytest.mark.parametrize("law", law_cases.names())
def test_only_what_is_read_is_used(law, language):
    described = laws.law(law)
    reads = set(described.reads)
    if described.kind == "bristle" or reads & {"slip_rate", "slip_increment"}:
        reads.add("slip")
    for interface in set(_ARGUMENTS) & set(described.interfaces):
        routine = laws.routine(law, interface, language)
        used = {a.modern for a, u in zip(routine.interface.args, routine.uses, strict=True) if u}
        arguments = dict(_ARGUMENTS[interface])
        if interface != "vfric_coef" and (described.kind != "coefficient" or described.states):
            arguments.pop("pressure" if interface != "fric_coef" else "", None)  # the area counts
        if interface == "vfric" and described.states:
            arguments.pop("pressure", None)
        for name, expected in arguments.items():
            present = {a.modern for a in routine.interface.args}
            assert expected <= present, (interface, expected - present)
            assert used & expected == (expected if name in reads else set()), (interface, name)


@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
def test_analytical_surface_has_one_temperature(interface, language):
    law = "temperature_pressure_decay"
    props = _props(law)
    n, warm, cold = 5, np.array([90.0, 160.0, 210.0, 40.0, 310.0]), 30.0
    surface = law_host.Surface(n, interface, analytical=True)
    scene = usersub.Scene(points=n, props=props, temperatures=1, **surface.sizes())
    driver = usersub.ExplicitDriver(laws.routine(law, interface, language), scene)
    arrays = {
        **surface.arrays(), "slip_increment": surface.along * 0.5,
        "normal_force": 900.0 * surface.area, "stick_force": np.full(n, law_host.NO_STICK),
        "temperature_secondary": warm, "temperature_main": np.array([cold]),
    }  # fmt: skip
    force = driver.step(0.25, **{k: np.asfortranarray(a) for k, a in arrays.items()}).force
    temperature = 0.5 * (warm + cold)
    static, kinetic = (props[i] * temperature + props[i + 1] * 900.0 for i in (0, 2))
    mu = kinetic + (static - kinetic) * np.exp(-props[4] * 2.0)
    found = -np.einsum("ik,ik->k", force, surface.along)
    assert found == pytest.approx(mu * 900.0 * surface.area, rel=1e-13)


@pytest.mark.parametrize(
    "props",
    [
        [2, 1, 1, 0, 0.0, 200.0, 0.0, 0.0, 0.15],
        [1, 1, 1, 1, 2, 0.0, 0.0, 0.0, 3.0, 5.0, 0.15],
        [0, 1, 1, 0, 0.0, 0.0, 0.0, 0.1],
        [1e9, 1e9, 1e9, 1e9, 0, 0, 0, 0],
        [1, 1, 1, -1, 0.0, 0.0, 0.0, 0.1],
    ],
    ids=["one short", "one short with a field", "no rates", "huge", "fields below zero"],
)
@pytest.mark.parametrize("interface", ["vfric_coef", "fric_coef"])
def test_table_has_to_fit_its_properties(props, interface, language):
    routine = laws.routine("coulomb_tabulated", interface, language)
    driver = usersub.CoefficientDriver(routine, usersub.Scene(points=1, props=props))
    rate = {"slip_rate": np.ones(1), "slip_data": np.ones((6, 1), order="F")}
    arrays = {k: a for k, a in rate.items() if k in driver.layout.ports}
    with pytest.raises(RoutineError):
        driver.evaluate(**arrays, pressure=np.ones(1), time_increment=1.0)


@pytest.mark.parametrize("law", law_cases.names())
def test_numbers_of_limits_and_extremes_are_finite(law):
    """The reference values themselves: nothing overflows, no coefficient is negative."""
    for case in law_cases.reference(law):
        for point in case.get("points", []):
            assert np.isfinite(floats(point["double"]["value"])).all()
            assert (floats(point["double"]["value"]) >= 0).all(), point
