# SPDX-License-Identifier: MIT
"""The same law gives the same results in Python, C and Fortran, through every interface.

201 random contact points, each argument with its own values; 201 is a multiple of none of the block
sizes. In each language the bits are the same for any block size and any number of threads.
"""

from __future__ import annotations

import json

import numpy as np
import pytest

import usersub
from usersub import laws

N, SEED = 201, 20240517
CORNERS = 4
LENGTH = 0.4


def _props(law: str) -> list[float]:
    """Properties of the law's first reference case."""
    file = laws.law(law).folder / "reference.json"
    return json.loads(file.read_text(encoding="utf-8"))["cases"][0]["props"]


PROPS = {
    law: _props(law)
    for law in (
        "coulomb",
        "exponential_decay",
        "viscoplastic_creep",
        "temperature_pressure_decay",
        "coulomb_tabulated",
    )
}

#: Relative tolerance between languages: what is promised, some ten rounding errors of the type.
TOLERANCE = {"double": 1e-13, "single": 1e-6}
REAL = {"double": np.float64, "single": np.float32}

#: These laws behind every interface that can carry them, in every precision that it has. All laws
#: are compared with exact values in `tests/laws`.
CASES = [
    (law, interface, precision)
    for law in PROPS
    for interface in laws.LAWS[law].interfaces
    for precision in (("double", "single") if interface.startswith("v") else ("double",))
]
#: Block sizes and numbers of threads; more laws, but fewer points, in `tests/laws/test_blocks.py`.
BLOCKS_AND_THREADS = ((1, 3), (7, 2), (64, 1), (N, 1))

_fortran = pytest.mark.needs_fortran
PAIRS = [
    pytest.param("c", "python"),
    pytest.param("c", "fortran", marks=_fortran),
    pytest.param("python", "fortran", marks=_fortran),
]


class Surface:
    """What a host tells about its contact points in three increments, by the name of the array."""

    def __init__(self, precision: str) -> None:
        self.random = np.random.default_rng(SEED)
        self.real = REAL[precision]

    def uniform(self, low: float, high: float, *shape: int) -> np.ndarray:
        return np.asfortranarray(self.random.uniform(low, high, (*shape, N)).astype(self.real))

    def unit(self) -> np.ndarray:
        vectors = self.random.normal(size=(3, N))
        return np.asfortranarray((vectors / np.linalg.norm(vectors, axis=0)).astype(self.real))

    def temperatures(self) -> dict[str, np.ndarray]:
        """Both surfaces; their mean lies below, inside and above the table."""
        return {
            "temperature_secondary": self.uniform(20.0, 300.0),
            "temperature_main": self.uniform(10.0, 200.0),
        }

    def explicit(self, interface: str) -> list[dict[str, np.ndarray]]:
        order = self.random.permutation(N).astype(np.int32) + 1
        main = np.arange(CORNERS * N, dtype=np.int32).reshape((CORNERS, N), order="F") + 1
        weight = self.uniform(0.5, 1.5, CORNERS)
        general = interface != "vfric"
        area = self.uniform(0.5, 3.0)
        by_node = np.empty_like(area)
        by_node[order - 1] = area
        fixed = {
            "secondary_node": order.reshape(1, N, order="F") if general else order,
            "main_node": np.asfortranarray(main + np.int32(N) if general else main),
            "shape_main": np.asfortranarray(weight / weight.sum(axis=0)),
            "area": area if general else by_node,
        }
        increments = []
        for _ in range(3):
            normal_force = self.uniform(50.0, 5000.0)
            normal_force[self.random.integers(0, N, 9)] = 0.0  # open points
            increments.append({
                **fixed, **self.temperatures(), "normal": self.unit(), "normal_force": normal_force,
                "slip_increment": self.uniform(-40.0, 40.0, 3),
                "stick_force": self.uniform(10.0, 3000.0),
            })  # fmt: skip
        return increments

    def standard(self) -> list[dict[str, np.ndarray]]:
        """Points that stick, that slip, and some of both, a few open; local directions turn."""
        increments = []
        for size in (1e-3, 2.0, 3e-3):
            angle = self.random.uniform(-0.3, 0.3, N)
            rotation = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
            increments.append({
                **self.temperatures(), "rotation": np.asfortranarray(rotation),
                "slip_increment": self.uniform(-size, size, 2),
                "pressure": self.uniform(-50.0, 3000.0),
            })  # fmt: skip
        return increments


def explicit(driver_of, law, interface, precision) -> list[dict[str, np.ndarray]]:
    sizes = {"nodes": N + CORNERS * N}
    if interface == "vfric":
        sizes = {"secondary_nodes": N, "main_nodes": CORNERS * N}
    driver = driver_of(usersub.ExplicitDriver, precision=precision, dissipation=1, **sizes)
    found = []
    for i, arrays in enumerate(Surface(precision).explicit(interface)):
        known = {k: a for k, a in arrays.items() if k in driver.layout.ports}
        response = driver.step(0.25 + 0.5 * i, **known)
        found.append({"force": response.force, "dissipation": np.full(N, response.dissipation)})
        if response.coefficient is not None:
            found[-1]["coefficient"] = response.coefficient
    return found


def standard(driver_of, law, interface, precision) -> list[dict[str, np.ndarray]]:
    driver = driver_of(
        usersub.StandardDriver, temperature_tangent=1, characteristic_length=LENGTH,
        states=laws.LAWS[law].state_count(interface, props=PROPS[law]),
    )  # fmt: skip
    names = ("tau", "ddtddg", "ddtddp", "ddtddt", "dslip", "sed", "sfd", "lm")
    found = []
    for i, arrays in enumerate(Surface("double").standard()):
        if i == 0:
            at_rest = {"slip_increment": np.zeros((2, N), order="F"), "pressure": np.full(N, 400.0)}
            driver.begin_increment(1.0)
            driver.iterate(**{**arrays, **at_rest})
            driver.commit()
        driver.begin_increment(0.01 + 0.02 * i)
        response = driver.iterate(**arrays)
        found.append({name: getattr(response, name) for name in names})
        driver.commit()
        for name in ("state", "elastic_slip", "slip"):
            if name in driver.layout.ports and driver.array(name).size:
                found[-1][name] = np.array(driver.array(name))
    return found


def coefficient(driver_of, law, interface, precision) -> list[dict[str, np.ndarray]]:
    """The coefficient alone, with its derivatives where the interface has any."""
    standard = interface == "fric_coef"
    driver = driver_of(
        usersub.CoefficientDriver, precision=precision, **({"derivatives": 1} if standard else {})
    )
    surface = Surface(precision)
    slip_data = surface.uniform(0.0, 400.0, 6)
    arrays = {
        "slip_data": slip_data, "slip_rate": surface.uniform(0.0, 400.0),
        "pressure": surface.uniform(100.0, 3000.0), "temperature": surface.uniform(10.0, 300.0),
    }  # fmt: skip
    known = {k: a for k, a in arrays.items() if k in driver.layout.ports}
    found = {"coefficient": driver.evaluate(**known, time_increment=0.01)}
    if standard:
        found["derivative"] = np.array(driver.array("derivative"))
    return [found]


def results(law, interface, precision, language, **choice) -> list[dict[str, np.ndarray]]:
    """Results of every increment, and of the coefficient driver, by name."""
    routine = laws.routine(law, interface, language, precision=precision)

    def driver_of(kind, **settings):
        scene = usersub.Scene(points=N, props=PROPS[law], temperatures=1, **settings, **choice)
        driver = kind(routine, scene)
        if choice:
            # FRIC_COEF routines that say nothing about blocks are asked point by point.
            one = kind is usersub.CoefficientDriver and interface == "fric_coef"
            assert driver.plan.block in (choice["block"], 1 if one else choice["block"])
            assert driver.plan.threads == choice["threads"]
        return driver

    run = explicit if interface.startswith("v") else standard
    found = run(driver_of, law, interface, precision)
    if interface.endswith("coef"):
        found += coefficient(driver_of, law, interface, precision)
    return found


@pytest.fixture(scope="module")
def known():
    """Results with the plan's own choices, by case and language."""
    memory: dict[tuple, list[dict[str, np.ndarray]]] = {}

    def recall(*key):
        if key not in memory:
            memory[key] = results(*key)
        return memory[key]

    return recall


def _limit(name: str, array: np.ndarray, tolerance: float) -> np.ndarray:
    """Difference that is allowed: relative to each number, of tangents to the point's largest.

    A tangent's components may cancel: along the slip Coulomb friction has none.
    """
    size = np.abs(array)
    return tolerance * (size.max(axis=(0, 1)) if name == "ddtddg" else size)


def _assert_close(one, other, names, tolerance):
    for increment, (a, b) in enumerate(zip(one, other, strict=True)):
        for name in names(a, b):
            error = np.abs(a[name] - b[name])
            limit = _limit(name, a[name], tolerance)
            assert (error <= limit).all(), (increment, name, error.max())


@pytest.mark.parametrize(("law", "interface", "precision"), CASES)
@pytest.mark.parametrize(("one", "other"), PAIRS)
def test_languages_agree(known, one, other, law, interface, precision):
    results = [known(law, interface, precision, x) for x in (one, other)]
    _assert_close(*results, lambda a, b: a.keys() | b.keys(), TOLERANCE[precision])
    for a, b in zip(*results, strict=True):
        for name in a:
            kind = {"lm": np.int32, "dissipation": np.float64}.get(name, REAL[precision])
            assert a[name].dtype == b[name].dtype == kind
        # Nothing that is zero throughout is compared with itself.
        for name in ("force", "tau", "coefficient"):
            assert name not in a or np.count_nonzero(a[name]) > 0.9 * a[name].size, name


@pytest.mark.parametrize(("law", "interface", "precision"), CASES)
def test_blocks_and_threads_give_the_same_bits(known, law, interface, precision, language):
    expected = known(law, interface, precision, language)
    for block, threads in BLOCKS_AND_THREADS:
        found = results(law, interface, precision, language, block=block, threads=threads)
        for a, b in zip(expected, found, strict=True):
            assert a.keys() == b.keys()
            for name in a:
                assert a[name].tobytes() == b[name].tobytes(), (block, threads, name)


@pytest.mark.parametrize("precision", TOLERANCE)
@pytest.mark.parametrize("law", PROPS)
def test_explicit_interfaces_agree(known, law, precision, language):
    first, *others = (i for i in laws.LAWS[law].interfaces if i.startswith("v"))
    for other in others:
        pair = [known(law, i, precision, language)[:3] for i in (first, other)]
        _assert_close(*pair, lambda a, b: ("force", "dissipation"), TOLERANCE[precision])


@pytest.mark.parametrize(
    "law", [name for name in PROPS if "fric_coef" in laws.LAWS[name].interfaces]
)
def test_standard_interfaces_agree(known, law, language):
    pair = [known(law, i, "double", language)[:3] for i in ("fric", "fric_coef")]
    # A point that closes has no friction behind FRIC, which is told that it was open.
    closed = np.all([increment["lm"] != 2 for increment in pair[0]], axis=0)
    assert closed.sum() > 0.9 * N
    pair = [[{k: a[..., closed] for k, a in found.items()} for found in run] for run in pair]
    _assert_close(*pair, lambda a, b: a.keys() & b.keys(), TOLERANCE["double"])


def test_every_interface_is_compared():
    assert len(CASES) == 4 * (5 + 3) + 3 + 2
