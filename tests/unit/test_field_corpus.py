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
    n = _POINTS
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
