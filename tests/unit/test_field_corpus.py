# SPDX-License-Identifier: MIT
"""Files as many different authors write them, unchanged, through the drivers, against their laws.

Every argument has values of its own at every point. Tolerance 1e-13 relative in double and 2e-6 in
single precision: a few roundings; laws with a local iteration say their own.
"""

from __future__ import annotations

import ctypes
import shutil
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import usersub
from usersub.core import lib
from usersub.routine.info import info

pytestmark = pytest.mark.needs_fortran

_FIELD = Path(__file__).resolve().parents[1] / "field"
_AUTHORS = _FIELD / "authors"
_BOTH = ("double", "single")
_TOLERANCE = {"double": 1e-13, "single": 2e-6}
_DT = 0.25
_POINTS = 4


@pytest.fixture(autouse=True)
def working(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working folder in which nothing may appear but what a test allows by a suffix."""
    folder = tmp_path / "working"
    folder.mkdir()
    monkeypatch.chdir(folder)
    yield folder
    assert [p.name for p in folder.iterdir() if p.suffix not in (".dat", ".log")] == []


@pytest.fixture
def said() -> list[tuple[int, str]]:
    """What routines say during the test."""
    found: list[tuple[int, str]] = []
    usersub.messages_to(lambda level, text: found.append((level, text)))
    yield found
    usersub.messages_to()


@dataclass(frozen=True)
class Case:
    """One interface of one file and the law in it.

    Attributes:
        law: from the arrays of the driver to stress (F, N), friction force magnitude (N,) or
            coefficient (N,).
        scene: settings; `arrays`: names of optional arrays that are bound.
        touch: FRIC returns at once in the increment in which the points come to touch.
        loose: tolerance of laws whose constants are in single precision.
    """

    file: str
    interface: str
    law: Callable[[SimpleNamespace], np.ndarray]
    props: tuple[float, ...] = ()
    scene: dict[str, Any] = field(default_factory=dict)
    arrays: tuple[str, ...] = ()
    precisions: tuple[str, ...] = _BOTH
    generation: str = "legacy"
    touch: bool = False
    loose: float = 0.0


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=0)


def _arrays(dimension: int, precision: str) -> SimpleNamespace:
    """All arrays that a case may use; the points slide in planes of their own."""
    if dimension == 3:
        normal = _unit(np.array([[0.1, -0.5, 0.3, 0.0], [0.2, 0.4, -0.9, 0.6], [1, 2, 1.5, -1.0]]))
        raw = np.array(
            [[3e-3, -1e-3, 2e-3, 5e-4], [1e-3, 2e-3, -4e-3, 1e-3], [2e-3, 1e-3, 0, 3e-3]]
        )
        slip = raw - normal * (normal * raw).sum(axis=0)
    else:
        normal = _unit(np.array([[0.1, -0.5, 0.3, 0.0], [1, 2, 1.5, -1.0]]))
        slip = np.array([normal[1], -normal[0]]) * [3e-3, -1e-3, 2e-3, 5e-4]
    values = {
        "slip_increment": slip,
        "normal": normal,
        "normal_force": np.array([1.0, 2.5, 0.75, 4.0]),
        "stick_force": np.array([100.0, 0.2, 80.0, 90.0]),
        "area": np.array([0.5, 2.0, 3.0, 1.25]),
        "temperature_secondary": np.array([20.0, 35.0, -10.0, 60.0]),
        "temperature_main": np.array([25.0, 15.0, 5.0, 50.0]),
        "field_secondary": np.array([[0.1, 0.2, 0.05, 0.15], [0.3, 0.5, 0.7, 0.9]]),
        "field_main": np.array([[0.4, 0.6, 0.8, 0.2], [0.05, 0.02, 0.03, 0.04]]),
        "secondary_node": np.array([[2, 4, 5, 1]]),
        "main_node": np.array([[6, 6, 7, 8], [7, 7, 8, 9], [8, 9, 9, 6], [9, 8, 6, 7]]),
        "velocity": np.arange(27.0).reshape(3, 9) ** 2 / 1000,
        "coord_secondary": np.arange(18.0).reshape(3, 6) / 7,
    }
    return _typed(values, precision)


def _typed(values: dict[str, np.ndarray], precision: str) -> SimpleNamespace:
    real = np.float64 if precision == "double" else np.float32
    return SimpleNamespace(
        **{
            name: np.asfortranarray(v, dtype=np.int32 if v.dtype.kind == "i" else real)
            for name, v in values.items()
        }
    )


def _explicit(case: Case, routine: usersub.Routine, precision: str) -> tuple[Any, Any]:
    dimension = case.scene.get("dimension", 3)
    scene = usersub.Scene(points=_POINTS, precision=precision, props=case.props, **case.scene)
    driver = usersub.ExplicitDriver(routine, scene)
    d = _arrays(dimension, precision)
    if case.interface == "vfric":
        d.secondary_node = d.secondary_node[0]
        d.area = np.array([7, 0.5, 9, 2, 3, 1.25], dtype=d.area.dtype)
    d.previous, d.nodes = np.zeros(_POINTS), d.secondary_node
    bound = ("slip_increment", "normal", "normal_force", "stick_force", *case.arrays)
    force = driver.step(_DT, **{name: getattr(d, name) for name in bound}).force
    d.speed = np.linalg.norm(d.slip_increment.astype(float), axis=0) / _DT
    direction = _unit(d.slip_increment.astype(float))
    return force, -direction * case.law(d)


def _fric(case: Case, routine: usersub.Routine, precision: str) -> tuple[Any, Any]:
    scene = usersub.Scene(points=_POINTS, props=case.props, **case.scene)
    driver = usersub.StandardDriver(routine, scene)
    slip = np.array([[3e-3, -1e-3, 2e-4, 1e-6], [1e-3, 2e-3, -4e-3, -3e-6]])
    d = _typed(
        {
            **{"slip_increment": slip, "pressure": np.array([3.0, 7.5, 0.5, 12.0])},
            "coord": np.array([[1.5, 2.5, 0.5, 1.0], [9, 8, 7, 6.0], [4, 3, 2, 1.0]]),
            "rotation": np.stack(
                [np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]]) for a in (0, 1, 2, 3)],
                axis=2,
            ),
            **{
                name: getattr(_arrays(3, "double"), name)
                for name in case.arrays
                if name.startswith(("temperature", "field"))
            },
        },
        "double",
    )
    bound = {name: getattr(d, name) for name in ("slip_increment", "pressure", *case.arrays)}
    if case.touch:
        driver.begin_increment(_DT)
        driver.iterate(**(bound | {"slip_increment": np.zeros((2, _POINTS), order="F")}))
        driver.commit()
    driver.begin_increment(_DT)
    return driver.iterate(**bound).tau, case.law(d)


def _coefficient(case: Case, routine: usersub.Routine, precision: str) -> tuple[Any, Any]:
    nodes = {"nodes": 1} if case.interface == "vfric_coef" else {}
    scene = usersub.Scene(
        points=_POINTS, precision=precision, props=case.props, **nodes, **case.scene
    )
    driver = usersub.CoefficientDriver(routine, scene)
    data = np.array([[0.0, 0.5, 4.0, 30.0], [0, 0.3, -4.0, 20], [0, 0.4, 0, 22.0],
                     [0.1, 0.2, 0.7, 0.9], [0.1, -0.2, 0.3, 0.4], [0, 0.1, 0.6, -0.2]])  # fmt: skip
    d = _typed(
        {
            **{"slip_rate": data[0], "slip_data": data, "pressure": np.array([3.0, 7.5, 0.5, 12])},
            "temperature": np.array([20.0, 35.0, -10.0, 60.0]),
            "field": np.array([[0.1, 0.2, 0.05, 0.15], [0.3, 0.5, 0.7, 0.9]]),
        },
        precision,
    )
    first = "slip_data" if case.generation == "2022" else "slip_rate"
    names = (first, "pressure", *case.arrays)
    found = driver.evaluate(time_increment=_DT, **{name: getattr(d, name) for name in names})
    return found, case.law(d)


def _limit(mu, d) -> np.ndarray:
    return np.minimum(mu * d.normal_force, d.stick_force)


def _elastic(d, mu: float, stiffness: float) -> np.ndarray:
    """Elastic stick up to a limit of the magnitude."""
    trial = stiffness * d.slip_increment
    size = np.linalg.norm(trial, axis=0)
    return trial * np.minimum(1, mu * d.pressure / size)


def _cards(d) -> np.ndarray:
    rate = d.slip_increment / _DT
    v = np.linalg.norm(rate, axis=0)
    return (0.4 - 0.3 * v / (v + 0.01)) * d.pressure * rate / v


def _implicit_none(d) -> np.ndarray:
    mean = (d.temperature_secondary + d.temperature_main) / 2
    mu = 0.3 * np.exp(-0.01 * mean) + d.field_secondary[0] - d.field_main[1]
    return 2 * mu * d.pressure * d.slip_increment / (np.abs(d.slip_increment) + 1e-6 * 40)


def _solver_calls(d) -> np.ndarray:
    first, second = d.slip_increment
    limit = 0.3 * d.pressure
    return np.array([limit * first / (abs(first) + 0.002 * d.coord[0]), limit * np.sign(second)])


def _heat(d) -> np.ndarray:
    mu = 0.3 * (1 + 0.01 * (d.temperature_secondary - d.temperature_main))
    mu *= 1 + d.field_secondary[1] - d.field_main[0]
    return mu * d.pressure * _unit(d.slip_increment)


def _names(d) -> np.ndarray:
    seen = d.velocity[0, d.nodes[0] - 1] - d.velocity[0, d.main_node[0] - 1]
    return _limit(0.15, d) * (1 + seen)


def _module(d) -> np.ndarray:
    mean = (d.temperature_secondary + d.temperature_main) / 2
    return _limit(0.15 * (1 + 0.01 * (mean - 20)) + d.field_secondary[0] - d.field_main[1], d)


def _entries(d) -> np.ndarray:
    fields = d.field_secondary[1] + d.field_main[1]
    return _limit((0.1 + 0.2 * np.exp(-20 * d.speed)) * (1 + 0.05 * fields), d)


def _stribeck(rate, factor):
    return factor * np.interp(rate, [0, 1, 5, 20], [0.6, 0.4, 0.25, 0.3])


_SURFACES = {"secondary_nodes": 6, "main_nodes": 9}
_NODES = {"nodes": 9}
_HOT = ("temperature_secondary", "temperature_main")
_FIELDS = ("field_secondary", "field_main")
_HOT_SCENE = {"temperatures": 1, "fields": 2}
_DOUBLE = ("double",)
_WITH_STIFFNESS = (0.3, 2e4)

_CASES = (
    Case("windows.for", "fric", lambda d: _elastic(d, *_WITH_STIFFNESS), _WITH_STIFFNESS,
         precisions=_DOUBLE),
    Case("cards.f", "fric", _cards, (0.01,), precisions=_DOUBLE),
    Case("implicit_none.f", "fric", _implicit_none, (0.3, 0.01),
         _HOT_SCENE | {"interaction": "INTPROP-1", "secondary": "SLAVE", "temperature_tangent": 1,
                       "characteristic_length": 40.0},
         (*_HOT, *_FIELDS), _DOUBLE),
    Case("solver_calls.for", "fric", _solver_calls, (0.3, 0.002), arrays=("coord",),
         precisions=_DOUBLE),
    Case("heat_state.f", "fric", _heat, (0.3, 0.01),
         _HOT_SCENE | {"states": 2, "temperature_tangent": 1}, (*_HOT, *_FIELDS, "rotation"),
         _DOUBLE, touch=True),
    Case("friction.c", "fric",
         lambda d: 0.15 * d.pressure * np.tanh(d.slip_increment / 0.02), (0.3, 20.0),
         {"characteristic_length": 2.0, "interaction": "LUBRICATED"}, precisions=_DOUBLE),
    Case("newer_names.for", "vfric",
         lambda d: np.minimum(0.3 * d.normal_force * (1 + 0.25 * d.speed)
                              + 0.1 * d.area[d.nodes - 1], d.stick_force),
         (0.3, 0.1), _SURFACES | {"states": 1}, ("secondary_node", "area")),
    Case("logger.f", "vfric", lambda d: _limit(0.15, d), (0.3, 2.0), _SURFACES,
         ("secondary_node",)),
    Case("directives.for", "vfric",
         lambda d: _limit(np.where(d.normal_force > 2, 0.225, 0.45), d), (0.3, 2.0), _SURFACES),
    Case("free_in_for.for", "vfric",
         lambda d: _limit(0.3 + 0.001 * (d.temperature_secondary - d.temperature_main)
                          + d.field_secondary[1] * d.field_main[0], d),
         (0.3, 0.001), _SURFACES | _HOT_SCENE, (*_HOT, *_FIELDS)),
    Case("plane.for", "vfric", lambda d: _limit(np.maximum(0.3 - 10 * d.speed, 0.2), d),
         (0.3, 10.0, 0.2), {"secondary_nodes": 6, "main_nodes": 9, "dimension": 2, "states": 2},
         ("secondary_node",)),
    Case("static_state.c", "vfric",
         lambda d: _limit(0.3 * (1 + 0.1 * (d.coord_secondary[:, d.nodes - 1] * d.normal).sum(0)),
                          d),
         (0.3, 0.1), _SURFACES, ("secondary_node", "coord_secondary"), _DOUBLE),
    Case("module_after.f90", "vfriction", _module, (0.3, 0.01),
         _NODES | _HOT_SCENE | {"states": 1, "interaction": "WET"}, (*_HOT, *_FIELDS)),
    Case("names_upper.for", "vfriction", _names, (0.9, 0.15),
         _NODES | {"interaction": "GREASED JOINT", "secondary": "TOOL-FACE"},
         ("velocity", "secondary_node", "main_node")),
    Case("explicit_entries.f", "vfriction", _entries, (0.3, 0.1, 20.0), _NODES | {"fields": 2},
         _FIELDS),
    Case("endings.f", "vfriction", lambda d: _limit(0.3, d), (0.3, 0.0), _NODES | {"states": 1}),
    Case("all_explicit.f90", "vfriction",
         lambda d: np.minimum(0.3 * d.normal_force + 0.1 * d.area, d.stick_force), (0.3, 0.1),
         _NODES | {"states": 1}, ("area",), _DOUBLE),
    Case("macros.F", "vfriction",
         lambda d: np.minimum(0.3 * d.normal_force + 2 * d.area, d.stick_force), (0.3,), _NODES,
         ("area",)),
    Case("text_functions.f", "vfriction", lambda d: _limit(0.3, d), (0.9, 0.8, 0.3),
         _NODES | {"interaction": "IntProp-3"}),
    Case("templates.cpp", "vfriction",
         lambda d: np.minimum(0.3 * d.normal_force / (1 + 0.1 * d.normal_force / d.area),
                              d.stick_force),
         (0.3, 0.1), _NODES, ("area",)),
    Case("table_file.for", "vfric_coef",
         lambda d: np.interp(d.slip_rate, [0, 10, 40], [0.5, 0.3, 0.15])),
    Case("explicit_entries.f", "vfric_coef",
         lambda d: (0.1 + 0.2 * np.exp(-2 * d.slip_rate)) * (1 + 0.1 * d.field[1]),
         (0.3, 0.1, 2.0), {"fields": 2}, ("field",)),
    Case("two_files.for", "vfric_coef",
         lambda d: 0.3 * (d.pressure / 10) ** -0.1 + 0.01 * d.slip_rate, (0.3, 0.2, 0.01)),
    Case("double_only.for", "vfric_coef", lambda d: 0.3 * np.exp(-2 * d.slip_rate) + 0.125,
         (0.3, 2.0, 0.125), precisions=_DOUBLE),
    Case("shared_arrays.for", "vfric_coef", lambda d: 0.3 / (1 + 0.5 * d.slip_rate), (0.3, 0.5)),
    Case("old_style.c", "vfric_coef",
         lambda d: 0.3 / np.sqrt(1 + d.pressure / 5) + 0.001 * d.slip_rate, (0.3, 5.0),
         precisions=_DOUBLE),
    Case("coef_template.for", "fric_coef", lambda d: 0.3 + 0.5 * d.slip_data[3], (0.3, 0.2, 0.5),
         {"states": 2, "anisotropic": 1}, precisions=_DOUBLE, generation="2022"),
    Case("modern_coef.f90", "fric_coef",
         lambda d: _stribeck(d.slip_data[0], 0.5) * (1 + d.field[1]), (0.5,),
         {"interaction": "OILED", "fields": 2, "derivatives": 1}, ("field",), _DOUBLE, "2022"),
    Case("references.cc", "fric_coef", lambda d: 0.1 + 0.2 * np.exp(-2 * d.slip_data[0]),
         (0.3, 0.1, 2.0), {"states": 1}, precisions=_DOUBLE, generation="2022"),
    Case("entry_function.f", "fric_coef",
         lambda d: np.where(d.slip_rate < 1e-3, 0.3, 0.1 + 0.2 * np.exp(-2 * d.slip_rate)),
         (0.3, 0.1, 2.0), precisions=_DOUBLE),
    Case("CHINESE.FOR", "fric_coef",
         lambda d: 0.3 * (1 + 0.01 * (d.temperature - 20)) / (1 + d.slip_rate * _DT), (0.3, 0.01),
         {"temperatures": 1}, ("temperature",), _DOUBLE),
)  # fmt: skip

_DRIVES = {"fric": _fric, "vfric": _explicit, "vfriction": _explicit}


def test_every_file_is_in_the_table():
    helpers = {"common_types.inc", "helpers.for", "macros.h", "mu_table.dat"}
    assert {case.file for case in _CASES} | helpers == {p.name for p in _AUTHORS.iterdir()}


@pytest.mark.parametrize(
    ("case", "precision"),
    [
        pytest.param(case, p, id=f"{case.file}-{case.interface}-{p}")
        for case in _CASES
        for p in case.precisions
    ],
)
def test_author(case: Case, precision: str, working: Path, said):
    """Loads, is what it says it is, and computes its law."""
    lib.usub_end_job()  # global arrays of routines live as long as the job
    shutil.copy(_AUTHORS / "mu_table.dat", working)
    file = usersub.load(_AUTHORS / case.file, precision=precision)
    expected = [c.interface for c in _CASES if c.file == case.file]
    assert sorted(file) == sorted(expected)
    routine = file[case.interface]
    assert routine.interface.generation == case.generation
    drive = _DRIVES.get(case.interface, _coefficient)
    found, law = drive(case, routine, precision)
    assert np.abs(law).reshape(-1, _POINTS).max(axis=0).min() > 0
    tolerance = max(case.loose, _TOLERANCE[precision])
    np.testing.assert_allclose(found, law, rtol=tolerance, atol=tolerance * np.abs(law).max())


def _driver(file: str, **scene) -> tuple[Any, dict[str, np.ndarray]]:
    """Driver and required arrays of an explicit routine in double precision."""
    routine = usersub.load(_AUTHORS / file).only()
    surfaces = _SURFACES if routine.interface.name == "vfric" else _NODES
    driver = usersub.ExplicitDriver(
        routine, usersub.Scene(points=_POINTS, dimension=3, **surfaces, **scene)
    )
    d = _arrays(3, "double")
    names = ("slip_increment", "normal", "normal_force", "stick_force")
    return driver, {name: getattr(d, name) for name in names}


@pytest.mark.parametrize(
    ("code", "reason"),
    [
        (1, "STOP"),
        (2, "STOP NO CONVERGENCE"),
        (3, "XPLB_EXIT"),
        (4, "XPLB_ABQERR: FATAL AT SLIDER: 4"),
        (5, r"exit\(3\)"),
        (17, "STOP 17"),
    ],
)
def test_endings_leave_the_state_as_it_was(code, reason, said):
    driver, arrays = _driver("endings.f", states=1, props=[0.3, code], interaction="GREASED X")
    driver.array("state")[:] = 7
    with pytest.raises(usersub.RoutineError, match=reason):
        driver.step(_DT, **arrays)
    np.testing.assert_array_equal(driver.array("state"), 7)
    if code == 3:
        assert (-2, "POINTS 4 CODE 3 FORCE 0.3 2.5 AT SLIDER ON GREASED") in said


def test_warnings_and_notes_go_on(said):
    driver, arrays = _driver("endings.f", states=1, props=[0.3, 6])
    driver.step(_DT, **arrays)
    assert [pair for pair in said if pair[0] in (-1, 1)] == [
        (-1, "ONLY A WARNING: 0.3"),
        (1, "AND A NOTE"),
    ]
    np.testing.assert_array_equal(driver.array("state"), 99)


def _end_of_analysis() -> None:
    """Lets the logger close its files."""
    number, nothing = ctypes.c_int(3), ctypes.c_int(0)
    pointers = [ctypes.byref(number), *[ctypes.byref(nothing)] * 4]
    place = usersub.load(_AUTHORS / "logger.f").symbol("vexternaldb")
    ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 5)(place)(*pointers)


def test_what_the_logger_writes(working, said):
    _end_of_analysis()
    driver, arrays = _driver("logger.f", props=[0.3, 2.0])
    arrays["secondary_node"] = _arrays(3, "double").secondary_node[0]
    driver.step(_DT, **arrays)
    lines = [text.strip() for level, text in said if level == 0]
    assert "VFRIC of thread  0            // not a comment, it's text" in lines
    assert "C:/temp/*.dat isn't opened" in lines
    assert "POINTS       4" in lines and "INC      1" in lines
    _end_of_analysis()
    written = np.loadtxt(working / "usersub_friction.log")
    np.testing.assert_array_equal(written[:, 0], [2, 4, 5, 1])
    np.testing.assert_allclose(written[:, 1], [-0.15, -0.2, -0.1125, -0.6], rtol=1e-5)


def test_own_xit_with_arguments_stops_only_the_call(said):
    driver, arrays = _driver("names_upper.for", props=[0.9, 0.1], secondary="FLOOR")
    d = _arrays(3, "double")
    more = {name: getattr(d, name) for name in ("velocity", "secondary_node", "main_node")}
    with pytest.raises(usersub.RoutineError, match="STOP unknown surface"):
        driver.step(_DT, **arrays, **more)
    assert any("my own end" in text and "2.5" in text for level, text in said)


def test_table_that_is_not_there(tmp_path, said):
    """Asked for by INQUIRE: the routine's own words. A build of its own has not read the table."""
    source = tmp_path / "another.for"
    source.write_text((_AUTHORS / "table_file.for").read_text())
    routine = usersub.load(source).only()
    assert not routine.thread_safe
    driver = usersub.CoefficientDriver(routine, usersub.Scene(points=1, nodes=1))
    with pytest.raises(usersub.RoutineError, match="XPLB_ABQERR: no table MU_TABLE in 1"):
        driver.evaluate(slip_rate=np.ones(1), pressure=np.ones(1))


def test_error_inside_of_fortran_input_is_no_end_of_the_process(tmp_path, working):
    """OPEN and READ without IOSTAT end a program within the run-time library of Fortran."""
    source = tmp_path / "law.for"
    source.write_text(
        _in_vfric_coef(
            "      CLOSE(55)\n      OPEN(55,FILE='mu.dat',STATUS='OLD')\n      READ(55,*) X\n"
            "      READ(55,*,END=10) Y\n      READ(55,*) Z\n 10   CLOSE(55)\n      FC(1) = X\n"
        )
    )
    driver = usersub.CoefficientDriver(
        usersub.load(source).only(), usersub.Scene(points=1, nodes=1)
    )
    arrays = {"slip_rate": np.ones(1), "pressure": np.ones(1)}
    with pytest.raises(usersub.RoutineError, match=r"'mu\.dat': No such file.*law\.for, line 6"):
        driver.evaluate(**arrays)
    (working / "mu.dat").write_text("0.25\n")
    assert driver.evaluate(**arrays)[0] == 0.25
    (working / "mu.dat").write_text("a quarter\n")
    with pytest.raises(usersub.RoutineError, match=r"Bad real number.*law\.for, line 7"):
        driver.evaluate(**arrays)
    (working / "mu.dat").write_text("0.5\n0.6\n")
    with pytest.raises(usersub.RoutineError, match=r"End of file \(law\.for, line 9"):
        driver.evaluate(**arrays)
    (working / "mu.dat").write_text("0.75\n")
    assert driver.evaluate(**arrays)[0] == 0.75


def test_exceptions_of_cxx():
    driver, arrays = _driver("templates.cpp", props=[0.3])
    with pytest.raises(usersub.RoutineError, match="VFRICTION"):
        driver.step(_DT, area=_arrays(3, "double").area, **arrays)
    driver, arrays = _driver("templates.cpp", props=[0.3, 0.1], interaction="FORBIDDEN")
    with pytest.raises(usersub.RoutineError, match="VFRICTION"):
        driver.step(_DT, area=_arrays(3, "double").area, **arrays)


def test_warning_of_a_c_routine(said):
    scene = usersub.Scene(points=1, props=[0.3, 1.0], characteristic_length=2.0, dimension=2)
    driver = usersub.StandardDriver(usersub.load(_AUTHORS / "friction.c").only(), scene)
    driver.begin_increment(_DT)
    arrays = {"slip_increment": np.array([[0.01]], order="F"), "pressure": np.array([5.0])}
    found = driver.iterate(node=np.array([42], dtype=np.int32), **arrays)
    assert (-1, "LARGE PRESSURE AT NODE 42") in said
    np.testing.assert_allclose(found.ddtddg[0, 0], 1.5 / 0.02 / np.cosh(0.5) ** 2, rtol=1e-13)


def test_state_and_second_coefficient_of_the_template():
    routine = usersub.load(_AUTHORS / "coef_template.for").only()
    scene = usersub.Scene(points=2, props=[0.3, 0.2, 0.5], states=2, anisotropic=1, dimension=3)
    driver = usersub.CoefficientDriver(routine, scene)
    data = np.zeros((6, 2), order="F")
    data[3] = [0.2, 0.4]
    for increment in (5, 6):
        driver.evaluate(
            time_increment=_DT, increment=increment, slip_data=data, pressure=np.ones(2)
        )
    np.testing.assert_allclose(driver.array("second_coefficient"), 0.2, rtol=1e-15)
    np.testing.assert_array_equal(driver.array("state"), [[2, 2], [6, 6]])


def test_derivatives_of_both_generations():
    arrays = {"pressure": np.array([1.0, 2.0])}
    scene = usersub.Scene(points=2, props=[0.3, 0.1, 2.0], derivatives=1)
    driver = usersub.CoefficientDriver(usersub.load(_AUTHORS / "references.cc").only(), scene)
    data = np.zeros((6, 2), order="F")
    data[0] = [0.5, 2.0]
    driver.evaluate(slip_data=data, **arrays)
    expected = -0.4 * np.exp(-2 * data[0])
    np.testing.assert_allclose(driver.array("derivative")[0], expected, rtol=1e-13)
    driver = usersub.CoefficientDriver(usersub.load(_AUTHORS / "entry_function.f").only(), scene)
    driver.evaluate(slip_rate=data[0].copy(), **arrays)
    np.testing.assert_allclose(driver.array("derivative")[0], expected, rtol=1e-13)


def test_entries_that_call_what_only_the_solver_has():
    found = info(_AUTHORS / "solver_calls.for")
    assert found.entries == (
        "DISP", "DLOAD", "UAMP", "UEL", "UEXTERNALDB", "UMAT", "UMESHMOTION", "URDFIL", "USDFLD",
    )  # fmt: skip
    assert {"GETVRM", "GETVRMAVGATNODE", "SPRINC", "ROTSIG", "POSFIL"} <= set(found.absent)
    assert found.shared_state == ("COMMON /KSHARE/",)
    found = info(_AUTHORS / "explicit_entries.f")
    assert set(found.absent) == {"VGETSENSORVALUE", "VGETVRM", "VSPRINC"}


def test_common_data_that_another_entry_fills():
    file = usersub.load(_AUTHORS / "solver_calls.for")
    numbers = (ctypes.c_double * 8)()
    ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 6)(file.symbol("UEXTERNALDB"))(*[numbers] * 6)
    try:
        driver = usersub.StandardDriver(
            file.only(), usersub.Scene(points=1, dimension=3, props=[0.3, 0.0])
        )
        driver.begin_increment(_DT)
        found = driver.iterate(
            slip_increment=np.array([[0.1], [-0.2]], order="F"),
            pressure=np.array([2.0]),
            coord=np.ones((3, 1), order="F"),
        )
        np.testing.assert_allclose(found.tau[:, 0], [0.5, -0.5], rtol=1e-13)
    finally:
        damage = ctypes.cast(file["fric"].entry().keep.kshare_, ctypes.POINTER(ctypes.c_double))
        damage[0] = 0.0


def test_friction_routine_may_mention_what_only_the_solver_has(tmp_path):
    """The call of the routine ends where it comes to that call; an unknown name is refused."""
    source = tmp_path / "law.for"
    text = _in_vfric_coef("      IF (P(1) .GT. 5) CALL SINV(P,X,Y,3,3)\n      FC(1) = P(1)\n")
    source.write_text(text)
    driver = usersub.CoefficientDriver(
        usersub.load(source).only(), usersub.Scene(points=1, nodes=1)
    )
    assert driver.evaluate(slip_rate=np.ones(1), pressure=np.array([4.0]))[0] == 4
    with pytest.raises(usersub.RoutineError, match="SINV was called, which usersub does not"):
        driver.evaluate(slip_rate=np.ones(1), pressure=np.array([6.0]))
    source.write_text(text.replace("SINV", "KSINV"))
    with pytest.raises(usersub.LoadError, match=r"law\.for calls KSINV, which neither"):
        usersub.load(source)


def _in_vfric_coef(body: str) -> str:
    """A VFRIC_COEF in fixed form with these statements; they begin in line 5."""
    return (
        "      SUBROUTINE VFRIC_COEF(FC,FD,NB,NP,NT,NF,JF,RD,A,B,C,PROPS,RATE,P,T,F)\n"
        "      INCLUDE 'VABA_PARAM.INC'\n      CHARACTER*80 A, B, C\n"
        "      DIMENSION FC(NB), PROPS(NP), RATE(NB), P(NB)\n" + body + "      END\n"
    )


_DIALECT = {
    "comparison of logicals": "      LOGICAL L,M\n      L = .TRUE.\n      M = P(1) .EQ. 3\n"
    "      IF (L .EQ. .TRUE. .AND. M .NE. .FALSE. .AND. L ==\n     1 M) FC(1) = PROPS(1)\n",
    "SIGN of a number": "      FC(1) = PROPS(1)*SIGN(1,P(1))*SIGN(1.,P(1)+(2*NB))\n",
    "SIGN of a variable": "      I = 1\n      FC(1) = PROPS(1)*SIGN(I,P(1))\n",
    "numbers of other types": "      FC(1) = MAX(0,PROPS(1),-1) + MOD(P(1),3) + MIN(P(1),0)\n",
    "integer conditions": "      N = 3\n      DO WHILE (N)\n      N = N - 2\n"
    "      FC(1) = PROPS(1)\n      IF (N .LT. -1) GO TO 10\n      END DO\n"
    " 10   IF (NB) THEN\n      FC(1) = 1*FC(1)\n"
    "      ELSE IF (IAND(NB,2)) THEN\n      FC(1) = 9\n      END IF\n",
    "& in column 73": "      FC(1) = PROPS(1) +".ljust(72) + "&\n     & 0.D0\n",
    "form feed": "\x0c      FC(1) = PROPS(1)\n\x0c\n",
    "dots of CP1252": "      FC(1) = PROPS(1) ! \x85 and so on\x85\nC \x85      FC(1) = 0\n",
    "comment marks in comments": "      FC(1) = PROPS(1) ! /* don't\n      X = 1 ! a \\\n"
    "      Y = 2\n",
    "comment marks in texts": "      CHARACTER*8 S\n      S = '/*.dat'\n"
    "      IF (S(1:3).EQ.'/*.'.AND.LEN_TRIM(S).EQ.6) FC(1) = PROPS(1)\n",
    "formats of other compilers": "      IF (NB.LT.0) WRITE(6,10), NB, FC(1)\n"
    " 10   FORMAT(1X I,F,//,' A'/)\n      FC(1) = PROPS(1)\n",
    "TYPE and initial values": "      REAL*8 X(3)/3*0.5D0/\n      IF (NB.LT.0) TYPE *, X\n"
    "      FC(1) = PROPS(1)*X(2)*2\n",
    "labels and marks": "     0FC(1) = 0\n     !  + PROPS(1)\n\n* comment\n\n     &  + 0.D0\n",
    "directives of OpenMP": "!$OMP PARALLEL DO\n      DO K = 1, NB\n      FC(K) = PROPS(1)\n"
    "      END DO\n!$    FC(1) = 7\n",
    "functions of the other precision": "      REAL*4 Y\n      Y = 4\n"
    "      FC(1) = PROPS(1)*DSQRT(Y)/2 + ALOG(P(1)/P(1)) + DABS(-DTANH(Y - 4))\n",
    "two statements": "      X = 1; Y = 2; FC(1) = PROPS(1)*X*Y/2\n",
}


@pytest.mark.parametrize("what", _DIALECT)
def test_what_other_compilers_take(what, tmp_path):
    source = tmp_path / "law.for"
    source.write_bytes(_in_vfric_coef(_DIALECT[what]).encode("latin-1"))
    _check_quarter(source)


def _check_quarter(source: Path) -> None:
    """The coefficient is the property."""
    driver = usersub.CoefficientDriver(
        usersub.load(source).only(), usersub.Scene(points=1, nodes=1, props=[0.25])
    )
    assert driver.evaluate(slip_rate=np.array([0.5]), pressure=np.array([3.0]))[0] == 0.25


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (
            "      INCLUDE 'VABA_PARAM.INC'\n",
            "      IMPLICIT NONE\n      INCLUDE 'VABA_PARAM.INC'\n",
        ),
        (
            "INCLUDE 'VABA_PARAM.INC'\n",
            "INCLUDE 'vaba_param.inc'\n      IMPLICIT REAL*8(A-H,O-Z)\n",
        ),
        ("      INCLUDE 'VABA_PARAM.INC'\n", '#include "Vaba_Param.Inc"\n'),
        ("      INCLUDE", "      USE IFPORT\n      INCLUDE"),
        ("      INCLUDE 'VABA", "\tINCLUDE'VABA"),
        ("      INCLUDE", "#include<smaaspusersubroutines.hdr>\n      INCLUDE"),
    ],
    ids=["none", "twice", "preprocessor", "ifport", "tab", "header"],
)
def test_heads(old, new, tmp_path):
    source = tmp_path / "law.for"
    source.write_text(_in_vfric_coef("      FC(1) = PROPS(1)\n").replace(old, new, 1))
    _check_quarter(source)


def test_helper_with_the_name_of_an_interface(tmp_path):
    source = tmp_path / "law.for"
    source.write_text(
        _in_vfric_coef("      FC(1) = PROPS(1)\n")
        + "      SUBROUTINE FRIC(X)\n      X = 1\n      END\n"
    )
    with pytest.raises(usersub.AbiError, match=r"FRIC has 1 arg.*\(interface='vfric_coef' loads"):
        usersub.load(source)
    assert list(usersub.load(source, interface="vfric_coef")) == ["vfric_coef"]


def test_c_without_declarations_of_utilities(tmp_path):
    source = tmp_path / "law.c"
    source.write_text(
        '#include "aba_for_c.h"\n'
        "void FOR_NAME(vfric_coef, VFRIC_COEF)(double *f, double *d, int *n, int *np, int *nt,\n"
        "  int *nf, int *j, double *r, char *a, char *b, char *c, double *props, double *v,\n"
        "  double *p, double *t, double *g) {\n"
        "  if (*p > 5) FOR_NAME(xit, XIT)();\n  f[0] = props[0];\n}\n"
    )
    _check_quarter(source)
    source.write_text(source.read_text().replace("props[0];", "mu(props);"))
    with pytest.raises(usersub.CompileError, match=r"law\.c:6:.*'mu'"):
        usersub.load(source)


def test_numbers_of_cards_behind_column_72(tmp_path):
    text = _in_vfric_coef("      FC(1) = PROPS(1)\n").replace("RD,A,B,C,", "RD,A,B,C,\n     1 ")
    lines = [line.ljust(72) + f"FRI{n:05d}" for n, line in enumerate(text.splitlines())]
    source = tmp_path / "law.f"
    source.write_text("\n".join(lines) + "\n")
    _check_quarter(source)
    # With anything else there, nothing is cut.
    source.write_text("\n".join([*lines[:-1], "      FC(1) = FC(1) +".ljust(72) + "1", lines[-1]]))
    with pytest.raises(usersub.CompileError, match=r"law\.f:"):
        usersub.load(source)


def test_modules_in_the_wrong_order(tmp_path):
    """Behind their use, and each other's; line numbers stay."""
    modules = (
        "      MODULE UPPER\n      USE LOWER\n      REAL*8 :: TWICE = 2*HALF\n      END MODULE\n"
        "      MODULE LOWER\n      REAL*8, PARAMETER :: HALF = 0.5D0\n      END MODULE LOWER\n"
    )
    text = _in_vfric_coef("      FC(1) = PROPS(1)*TWICE\n").replace(
        "      INCLUDE", "      USE UPPER, ONLY : TWICE\n      INCLUDE"
    )
    source = tmp_path / "law.f"
    source.write_text(text + modules)
    _check_quarter(source)
    source.write_text((text + modules).replace("= 0.5D0", "= 0.5D0X"))
    with pytest.raises(usersub.CompileError, match=r"law\.f:13:"):
        usersub.load(source)


_GOOD = _in_vfric_coef("      FC(1) = PROPS(1)\n")
_FRIC = (_AUTHORS / "implicit_none.f").read_text()


@pytest.mark.parametrize(
    ("name", "text", "error", "words"),
    [
        ("count.f", _FRIC.replace("PNEWDT,STATEV,", "STATEV,").replace("PNEWDT,STATEV(", "STATEV("),
         usersub.AbiError, r"count\.f:3: FRIC has 38 arguments, expected 39"),
        ("kinds.f", _FRIC.replace("TIME(2),DTIME", "TIME(2)").replace("KSTEP,KINC,N", "DTIME,N")
         .replace("COORDS(MCRD)", "COORDS(MCRD),KSTEP,KINC"),
         usersub.AbiError, r"'kstep'.*is real\*8, expected integer\*4"),
        ("array.f", _GOOD.replace(", RATE(NB)", "").replace(" C\n", " C\n      INTEGER RATE(NB)\n"),
         usersub.AbiError, r"'rate', in the place of slipRate\) is integer\*4, expected real\*8"),
        ("shape.f90", "subroutine vfric_coef(a,b,c,d,e,f,g,h,i,j,k,l,m,n,o,p)\n"
         "include 'vaba_param.inc'\nreal(8) a(:)\na(1) = l\nend\n",
         usersub.AbiError, r"'a', in the place of fCoef\) has assumed shape"),
        ("no_end.f", _GOOD.replace("      END\n", ""),
         usersub.CompileError, r"no_end\.f: the file ends before the END of its last unit"),
        ("no_end_between.f", _GOOD.replace("      END\n", "      SUBROUTINE K\n      END\n"),
         usersub.CompileError, r"no_end_between\.f:6:\d+: Unclassifiable statement"),
        ("other.f", "      SUBROUTINE UMAT(A)\n      A = 1\n      END\n",
         usersub.LoadError, r"other\.f has none of the interfaces .*that it defines: UMAT"),
        ("module.f90", "module law\ncontains\nsubroutine fric()\nend subroutine\nend module\n",
         usersub.LoadError, r"module\.f90 has none of the interfaces .*FRIC"),
        ("program.f90", "program law\nend program\n", usersub.LoadError, r"program\.f90 has none"),
        ("empty.for", "", usersub.LoadError, r"empty\.for has none of .*it defines: nothing"),
        ("empty.c", "", usersub.LoadError, r"empty\.c has none of .*it defines: nothing"),
        ("empty.py", "", usersub.LoadError, r"empty\.py"),
        ("blank.f90", "\n\n! nothing\n", usersub.LoadError, r"blank\.f90 has none of"),
    ],
    ids=lambda value: value if isinstance(value, str) and "." in value[:18] and len(value) < 20
    else "",
)  # fmt: skip
def test_wrong_files_give_a_sentence(name, text, error, words, tmp_path):
    (tmp_path / name).write_text(text)
    with pytest.raises(error, match=words):
        usersub.load(tmp_path / name)


@pytest.mark.parametrize("suffix", [".f", ".f90", ".c", ".cpp", ".so", ".o", ".py"])
def test_binary_garbage(suffix, tmp_path):
    source = tmp_path / f"garbage{suffix}"
    source.write_bytes(bytes(np.random.default_rng(5).integers(0, 256, 4000, dtype=np.uint8)))
    with pytest.raises(usersub.Error, match=rf"garbage\{suffix}") as caught:
        usersub.load(source)
    assert len(str(caught.value)) < 200 and "\n" not in str(caught.value)


def test_text_of_two_bytes_a_letter(tmp_path):
    source = tmp_path / "law.for"
    source.write_bytes(_GOOD.encode("utf-16"))
    with pytest.raises(usersub.LoadError, match=r"law\.for is in UTF-16.*save it as UTF-8"):
        usersub.load(source)


def test_new_routine_in_an_old_scene():
    routine = usersub.load(_AUTHORS / "references.cc").only()
    scene = usersub.Scene(points=1, props=[0.3, 0.1, 2.0], generation="legacy")
    with pytest.raises(usersub.AbiError, match="FRIC_COEF.*of generation 2022.*host of .*legacy"):
        usersub.CoefficientDriver(routine, scene)
    with pytest.raises(usersub.AbiError, match="written for generation 2022"):
        usersub.load(_AUTHORS / "coef_template.for", generation="legacy")
