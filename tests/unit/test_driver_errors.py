# SPDX-License-Identifier: MIT
"""Routines that raise, stop or crash: an exception that says what happened, and nothing changed."""

from __future__ import annotations

import numpy as np
import pytest

import usersub
from usersub import abi, ports
from usersub.driver import status
from usersub.errors import AbiError, Error, RoutineError, SceneError
from usersub.routine.routine import Routine
from usersub.statuses import STATUSES

POINTS = 6
ARRAYS = {"slip_rate": np.linspace(0.0, 5.0, POINTS), "pressure": np.ones(POINTS)}


def law_that_raises(compiled: bool) -> Routine:
    @usersub.vfric_coef(compiled=compiled)
    def law(fCoef, slipRate):
        for k in range(fCoef.shape[0]):
            if slipRate[k] > 3.5:
                raise ValueError("slip rate beyond the tests")
            fCoef[k] = 0.5

    return law


@pytest.mark.parametrize("compiled", [False, True])
def test_exception_of_a_python_routine(compiled):
    made = usersub.CoefficientDriver(law_that_raises(compiled), usersub.Scene(points=POINTS))
    with pytest.raises(RoutineError, match="VFRIC_COEF") as caught:
        made.evaluate(**ARRAYS)
    assert caught.value.status == -9
    cause = caught.value.__cause__
    assert isinstance(cause, ValueError) and str(cause) == "slip rate beyond the tests"
    sentence = str(caught.value)
    assert "ValueError: slip rate beyond the tests (routine 'law', " in sentence
    assert f"{__file__.rpartition('/')[2]}:" in sentence
    made.evaluate(slip_rate=np.zeros(POINTS))  # the driver goes on


def test_cause_belongs_to_this_failure():
    @usersub.vfric_coef(compiled=False)
    def law(fCoef, slipRate):
        if slipRate[0] == 1.0:
            raise KeyError("first")
        if slipRate[0] == 2.0:
            raise OSError("second")
        fCoef[:] = np.nan

    made = usersub.CoefficientDriver(law, usersub.Scene(points=POINTS))
    causes = []
    for rate in (1.0, 2.0, 3.0):
        with pytest.raises(RoutineError) as caught:
            made.evaluate(slip_rate=np.full(POINTS, rate), pressure=np.ones(POINTS))
        causes.append(type(caught.value.__cause__))
    assert causes == [KeyError, OSError, type(None)]


def test_keyboard_interrupt_passes_through():
    @usersub.vfric_coef(compiled=False)
    def law(fCoef):
        raise KeyboardInterrupt

    made = usersub.CoefficientDriver(law, usersub.Scene(points=POINTS))
    with pytest.raises(KeyboardInterrupt):
        made.evaluate(**ARRAYS)


@pytest.mark.parametrize(
    ("statement", "value", "words"),
    [
        ("xit_();", -10, ["XIT"]),
        ("fCoef[0] = 7 * *nProps / (*nBlock - 6);", -11, ["division"]),
        ("*(volatile double *)8 = 1.0;", -11, ["memory"]),
        ("((double *)props)[1] = 1.0;", -11, ["memory fault in props(2)"]),
    ],
)
def test_what_ends_a_program(c_routine, statement, value, words):
    source = (
        "#include <usersub/abi.h>\nvoid xit_(void);\n"
        "void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {\n"
        f"  if (slipRate[3] > 1.0) {{ {statement} }}\n"
        "  for (int k = 0; k < *nBlock; ++k) fCoef[k] = 0.25;\n}\n"
    )
    routine = c_routine("vfric_coef", source)
    made = usersub.CoefficientDriver(routine, usersub.Scene(points=POINTS, props=[1.0]))
    with pytest.raises(RoutineError) as caught:
        made.evaluate(**ARRAYS)
    assert caught.value.status == value
    for word in [*words, "VFRIC_COEF", "routine 'routine.c'"]:
        assert word in str(caught.value)
    found = made.evaluate(slip_rate=np.zeros(POINTS))
    np.testing.assert_array_equal(found, 0.25)


def test_every_failure_has_an_exception():
    for entry in STATUSES:
        if entry.value < 0:
            made = status.exception(entry.value, "why", 3)
            assert isinstance(made, Error) and made.status == entry.value and str(made) == "why"
    assert status.exception(-11, "why", 3).point == 3
    assert "-99" in str(status.exception(-99, ""))


def test_uses_must_fit_the_interface(c_routine):
    source = "#include <usersub/abi.h>\nvoid vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {}\n"
    routine = c_routine("vfric_coef", source, uses=(1, 2, 3))
    with pytest.raises(AbiError, match="of 3 arguments; expected 16"):
        usersub.CoefficientDriver(routine, usersub.Scene())


KINDS = [
    *[("standard", f) for f in abi.INTERFACES if f.solver == "standard"],
    *[("explicit", f) for f in abi.INTERFACES if f.solver == "explicit"],
    *[("coefficient", f) for f in abi.INTERFACES if f.name.endswith("_coef")],
]
DRIVERS = {
    "standard": usersub.StandardDriver,
    "explicit": usersub.ExplicitDriver,
    "coefficient": usersub.CoefficientDriver,
}


CONTACTS = [
    (kind, face, contact)
    for kind, face in KINDS
    for contact in ("node-to-facet", "edge-to-edge", "analytical-rigid")
    if (face.name, contact) != ("vfric", "edge-to-edge")
]


@pytest.mark.parametrize(("kind", "face", "contact"), CONTACTS, ids=lambda v: getattr(v, "key", v))
def test_shapes_agree_with_the_core(c_routine, kind, face, contact):
    """Every array, in the size that the Python drivers expect, is accepted by the C core."""
    parameters = f"USUB_{face.key.upper()}_PARAMETERS"
    source = f"#include <usersub/abi.h>\nvoid {face.symbol}({parameters}) {{}}\n"
    routine = c_routine(face.name, source, generation=face.generation)
    scene = usersub.Scene(
        points=7, dimension=3, contact=contact, secondary_nodes=11, main_nodes=13, nodes=17,
        states=2, fields=3, temperatures=1, elastic_slip=0.1, derivatives=1, temperature_tangent=1,
    )  # fmt: skip
    made = DRIVERS[kind](routine, scene)
    # What the explicit drivers keep to enforce sticking is there in such scenes only.
    enforced = {"enforcement": "penalty", "stick_slope": 1.0} if kind == "explicit" else {}
    keeper = DRIVERS[kind](routine, scene.replace(**enforced))
    for name, port in made.layout.ports.items():
        if port.role == "state":
            assert keeper.array(name).size == np.prod(made.layout.shapes[name])
            continue
        shape, dtype = made.layout.shapes[name], made.layout.dtypes[name]
        made.bind(**{name: np.zeros(shape, dtype, order="F")})
        made.bind(**{name: None})
    with pytest.raises(SceneError, match="has no array 'slip_increments'"):
        made.bind(slip_increments=np.zeros(1))
    assert set(ports_of_driver(kind, face)) == set(made.layout.ports)


def ports_of_driver(kind: str, face: abi.Interface) -> list[str]:
    wanted = "coefficient" if kind == "coefficient" else face.name
    return [port.name for port in ports.PORTS if wanted in port.drivers]


def test_driver_is_a_package_and_a_function(c_routine):
    source = "#include <usersub/abi.h>\nvoid vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {}\n"
    made = usersub.driver(c_routine("vfric_coef", source), usersub.Scene())
    assert isinstance(made, usersub.ExplicitDriver)
    with pytest.raises(SceneError, match="str as its routine"):
        usersub.driver("friction.f", usersub.Scene())


def test_quitting_a_debugger_inside_a_routine_is_no_failure_of_the_routine():
    import bdb

    @usersub.vfric_coef(compiled=False)
    def law(fCoef):
        raise bdb.BdbQuit

    with pytest.raises(bdb.BdbQuit):
        usersub.CoefficientDriver(law, usersub.Scene(points=2)).evaluate()


def test_an_exception_without_words_leaves_no_gap():
    @usersub.vfric_coef(compiled=False)
    def law(fCoef):
        raise KeyError

    with pytest.raises(RoutineError, match=r": KeyError \(routine 'law'"):
        usersub.CoefficientDriver(law, usersub.Scene(points=2)).evaluate()


def test_both_coefficients_are_named():
    @usersub.fric_coef(compiled=False)
    def law(fCoef):
        fCoef[0] = 0.5, -0.25

    scene = usersub.Scene(points=1, dimension=3, anisotropic=1, elastic_slip=0.01)
    made = usersub.StandardDriver(law, scene)
    made.begin_increment(0.5)
    with pytest.raises(RoutineError, match=r"\(fCoef 0.5 and -0.25, pressure 2\) at point 0"):
        made.iterate(slip_increment=np.ones((2, 1), order="F"), pressure=np.full(1, 2.0))


@pytest.mark.parametrize("wrong", ["0.1", None, True, np.array([0.1, 0.2]), 1j])
def test_a_time_that_is_no_number(wrong):
    made = usersub.ExplicitDriver(law_that_raises(False), usersub.Scene(points=POINTS))
    with pytest.raises(SceneError, match="time_increment = .*; expected a real number"):
        made.step(wrong)


def test_repr_tells_what_a_driver_is():
    made = usersub.CoefficientDriver(law_that_raises(False), usersub.Scene(points=POINTS))
    assert repr(made) == "<CoefficientDriver of VFRIC_COEF 'law', 6 contact points>"


def test_a_state_that_cannot_be_saved_leaves_nothing(tmp_path):
    made = usersub.CoefficientDriver(law_that_raises(False), usersub.Scene(points=POINTS))
    (tmp_path / "folder").mkdir()
    with pytest.raises(OSError):
        made.state.save(tmp_path / "folder")
    assert [p.name for p in tmp_path.iterdir()] == ["folder"]


@usersub.fric_coef(generation="2022")
def warm(fCoef, tempAvg):
    fCoef[0, 0] = tempAvg[0]


@usersub.fric_coef(generation="2022")
def cold(fCoef):
    fCoef[0, 0] = 0.3


@pytest.mark.parametrize(
    ("maker", "name"),
    [(usersub.CoefficientDriver, "temperature"), (usersub.StandardDriver, "temperature_main")],
)
def test_temperatures_that_the_scene_does_not_have(maker, name):
    """They would be zero in the routine without a word."""
    scene = usersub.Scene(points=2, dimension=2, elastic_slip=1.0)
    with pytest.raises(SceneError, match=f"'{name}' is given, but the scene has no temperatures"):
        maker(warm, scene).bind(**{name: np.ones(2)})
    maker(cold, scene).bind(**{name: np.ones(2)})
    maker(warm, scene.replace(temperatures=1)).bind(**{name: np.ones(2)})
