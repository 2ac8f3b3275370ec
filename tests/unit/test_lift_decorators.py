# SPDX-License-Identifier: MIT
"""Law functions as objects: what they say of themselves, what is refused and in which words."""

from __future__ import annotations

import math
import subprocess
import sys

import numpy as np
import pytest

import usersub
from usersub.errors import AbiError, CompileError, ContractError, LoadError
from usersub.routine.routine import UNUSED


def test_a_law_of_five_lines_stands_behind_all_five_interfaces():
    @usersub.coefficient
    def decay(slip_rate, props):
        """Decay."""
        static, kinetic, rate = props[0], props[1], props[2]
        return kinetic + (static - kinetic) * math.exp(-rate * slip_rate)

    assert decay.interfaces == ("fric", "fric_coef", "vfric", "vfriction", "vfric_coef")
    assert decay.fric is decay.behind("FRIC")
    assert decay.__doc__ == "Decay."
    assert decay.fric.__doc__ == "Decay."
    assert decay(0.0, [0.3, 0.1, 2.0]) == pytest.approx(0.3)
    assert decay.value(slip_rate=1.0, props=[0.3, 0.1, 2.0]) == 0.1 + (0.3 - 0.1) * math.exp(-2.0)
    assert decay.fric_coef.block_safe
    assert decay.behind("fric_coef", generation="legacy").interface.generation == "legacy"
    assert "coefficient law 'decay' (FRIC, FRIC_COEF" in repr(decay)
    assert decay.fric.origin == decay.origin
    assert decay.origin.endswith(".py:19")
    assert [decay.states(name) for name in decay.interfaces] == [2, 0, 0, 0, 0]
    assert decay.states("fric", directions=1) == 1


def test_what_a_law_does_not_read_is_not_fetched():
    @usersub.coefficient
    def constant(props):
        return props[0]

    @usersub.coefficient
    def warm(temperature, fields):
        return temperature + fields[0]

    def unused(routine):
        return {
            a.modern
            for a, u in zip(routine.interface.args, routine.uses, strict=True)
            if u == UNUSED
        }

    assert {"slipData", "pressure", "tempAvg", "fieldAvg", "rData"} <= unused(constant.fric_coef)
    assert {"dSlipFric", "areaSec", "tempSec", "statev", "dirCosSl"} <= unused(constant.vfric)
    assert {"areaCont", "rData", "tempSec", "fieldMain", "state"} <= unused(constant.vfriction)
    assert {"TEMP", "PREDEF"} <= unused(constant.fric)
    assert not {"TEMP", "PREDEF"} & unused(warm.fric)
    assert not {"tempAvg", "fieldAvg"} & unused(warm.vfric_coef)
    assert "slipRate" in unused(warm.vfric_coef)


def test_counts_may_depend_on_the_properties():
    @usersub.traction(props=lambda props: 1 + int(props[0]), vectors=lambda props: int(props[0]))
    def chain(motion, vectors, props):
        for i in range(len(vectors)):
            vectors[i, 0] = vectors[i, 0] + motion[0]
            vectors[i, 1] = vectors[i, 1] + motion[1]
        return props[1] * vectors[0, 0], props[1] * vectors[0, 1]

    assert chain.interfaces == ("fric", "vfric", "vfriction")
    assert chain.states("fric", 2, 3, [3, 1, 1, 1]) == 6
    assert chain.states("vfric", 2, 3, [3, 1, 1, 1]) == 9
    assert chain.needed_props([3.0]) == 4
    vectors = np.zeros((2, 2))
    for compiled in (False, True):
        vectors[:] = 0.0
        found = chain.derivatives(
            motion=(0.5, 0.25), vectors=vectors, props=[2, 8, 1], compiled=compiled
        )
        assert found[0] == (4.0, 2.0)
        assert found[1][0] == {"motion_1": 8.0, "motion_2": 0.0}
        assert vectors.tolist() == [[0.5, 0.25]] * 2


def test_derivatives_of_its_own():
    @usersub.coefficient(derivatives="own")
    def own(slip_rate, pressure):
        return slip_rate * pressure, (10.0, 20.0, 30.0, 40.0)

    @usersub.coefficient(derivatives="own", anisotropic=True)
    def pairs(slip_rate):
        return (slip_rate, 2.0), ((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))

    @usersub.coefficient(derivatives=None)
    def none(slip_rate):
        return slip_rate**2

    for compiled in (False, True):
        assert own.value(slip_rate=2.0, pressure=3.0, compiled=compiled) == 6.0
        found = own.derivatives(slip_rate=2.0, pressure=3.0, compiled=compiled)
        assert found == (6.0, {"slip_rate": 10.0, "pressure": 20.0})
        assert none.derivatives(slip_rate=3.0, compiled=compiled) == (9.0, {"slip_rate": 0.0})
        assert pairs.derivatives(slip_rate=3.0, compiled=compiled)[1][0] == {"slip_rate": 1.0}
    assert pairs.interfaces == ("fric", "fric_coef")
    scene = usersub.Scene(points=1, derivatives=1)
    driver = usersub.CoefficientDriver(own.behind("fric_coef", generation="legacy"), scene)
    mu = driver.evaluate(slip_rate=np.array([2.0]), pressure=np.array([3.0]), time_increment=1.0)
    assert mu == [6.0]
    assert driver.array("derivative").ravel().tolist() == [10.0, 20.0, 30.0]


def _decorated(text: str, decorator: str = "coefficient"):
    space = {"usersub": usersub, "math": math}
    exec(f"@usersub.{decorator}\n{text}", space)
    return next(v for v in space.values() if isinstance(v, usersub.LawFunction))


@pytest.mark.parametrize(
    ("decorator", "text", "told"),
    [
        (
            "coefficient",
            "def f(sliprate): return 0.1",
            "no quantity 'sliprate'; did you mean 'slip_rate'",
        ),
        ("coefficient", "def f(motion): return 0.1", "'motion' is for @usersub.traction"),
        ("coefficient", "def f(vectors): return 0.1", "'vectors' is for @usersub.traction"),
        (
            "traction",
            "def f(motion, slip_rate): return 1, 2",
            "'slip_rate' does not go with 'motion'",
        ),
        ("coefficient", "def f(*args): return 0.1", "'\\*args' stands for no quantity"),
        ("coefficient", "def f(*, props): return 0.1", "'props' stands for no quantity"),
        ("coefficient", "def f(props=3): return 0.1", "'props' has a default value"),
        ("coefficient", "def f(props): yield 0.1", "is a generator or coroutine"),
        (
            "coefficient(states=1)",
            "def f(props): return 0.1",
            "states = 1 but has no argument 'state'",
        ),
        (
            "coefficient",
            "def f(state): return state[0]",
            "declares no state variables; say how many: states=1",
        ),
        (
            "coefficient(states=1)",
            "def f(state): return 0.1",
            "has the argument 'state' but never uses it",
        ),
        (
            "coefficient(states=1)",
            "def f(state):\n state = 2.0\n return state",
            "assigns to the name 'state'",
        ),
        (
            "coefficient(props=-1)",
            "def f(props): return 0.1",
            "props = -1, expected a number from 0 on",
        ),
        ("coefficient(states=1.5)", "def f(state): return 0.1", "states = 1.5, expected a number"),
        (
            "coefficient(derivatives='complex')",
            "def f(props): return 0.1",
            "expected 'dual', 'own' or None",
        ),
        (
            "coefficient",
            "def f(props): return 1, 2, 3",
            "returns 3 numbers, expected one coefficient",
        ),
        ("strength", "def f(props): return 1, 2", "returns 2 numbers, expected one number"),
        (
            "traction(vectors=1)",
            "def f(motion, vectors): return vectors[0, 0], 1, 2",
            "expected the tractions",
        ),
    ],
)
def test_functions_that_are_no_laws_are_refused_at_once(decorator, text, told):
    with pytest.raises(AbiError, match=told) as raised:
        _decorated(text, decorator)
    assert "<string>:" in str(raised.value)


def test_what_is_no_function_is_refused():
    with pytest.raises(AbiError, match="@coefficient decorates a plain function, not 3"):
        usersub.coefficient(3)


@pytest.mark.parametrize(
    ("decorator", "text", "told"),
    [
        (
            "coefficient",
            "def f(slip_rate):\n slip_rate + 1.0",
            "the function returns nothing, expected one number",
        ),
        (
            "coefficient",
            "def f(slip_rate):\n t = (slip_rate, slip_rate)\n return t",
            "returns a tuple of 2, expected one",
        ),
        (
            "coefficient(anisotropic=True)",
            "def f(slip_rate):\n return slip_rate",
            "expected two numbers",
        ),
        ("traction", "def f(motion):\n return motion[0]", "expected two numbers"),
        (
            "coefficient(derivatives='own')",
            "def f(slip_rate):\n return slip_rate, 1.0",
            "expected value, \\(by slip_rate",
        ),
        (
            "coefficient(states=1)",
            "def f(slip_rate, state):\n return sum(state[:1])",
            "state variables are read and written one by one",
        ),
        ("coefficient", "def f(slip_rate):\n return unknown(slip_rate)", "unknown"),
    ],
)
def test_what_shows_when_it_is_compiled(decorator, text, told):
    law = _decorated(text, decorator)
    with pytest.raises(CompileError, match=told) as raised:
        law.fric.entry()
    assert " law 'f': " in str(raised.value)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("decorator", "text", "interface", "told"),
    [
        (
            "traction",
            "def f(slip_rate): return slip_rate",
            "fric_coef",
            "a stress is no coefficient times pressure",
        ),
        (
            "strength",
            "def f(pressure): return pressure",
            "vfric_coef",
            "its interfaces are FRIC, VFRIC, VFRICTION",
        ),
        ("coefficient", "def f(props): return 0.1, 0.2", "vfric", "it knows one coefficient only"),
        (
            "coefficient(states=1)",
            "def f(state): return state[0]",
            "vfric_coef",
            "it has no state variables",
        ),
        ("coefficient", "def f(props): return 0.1", "vfricton", "did you mean 'vfriction'"),
    ],
)
def test_an_interface_that_cannot_carry_the_law_is_refused(decorator, text, interface, told):
    with pytest.raises(LoadError, match=told):
        _decorated(text, decorator).behind(interface)


def test_other_refusals():
    law = _decorated("def f(props): return 0.1, 0.2")
    with pytest.raises(LoadError, match="needs FRIC_COEF of generation 2022"):
        law.behind("fric_coef", generation="legacy")
    with pytest.raises(LoadError, match="behind FRIC has no precision 'single'; expected double"):
        law.behind("fric", "single")
    with pytest.raises(AttributeError, match="no attribute 'vfrick'"):
        _ = law.vfrick
    with pytest.raises(ContractError, match="no quantity 'rate'; did you mean"):
        law.value(rate=1.0)
    stateful = _decorated("def f(state): return state[0]", "coefficient(states=2)")
    with pytest.raises(ContractError, match=r"state has the shape \(1,\), expected \(2,\)"):
        stateful.value(state=[0.0])


def test_files_with_laws(tmp_path):
    file = tmp_path / "law.py"
    file.write_text(
        "import usersub\n\n\ndef half(x):\n    return 0.5 * x\n\n\n"
        "@usersub.coefficient(props=1)\ndef mu(pressure, props):\n"
        "    return half(props[0]) / pressure\n"
    )
    found = usersub.load(file)
    assert list(found) == ["fric", "fric_coef", "vfric", "vfriction", "vfric_coef"]
    assert usersub.load(file, generation="legacy")["fric_coef"].interface.generation == "legacy"
    driver = usersub.CoefficientDriver(found["vfric_coef"], usersub.Scene(points=1, props=[3.0]))
    assert driver.evaluate(slip_rate=np.ones(1), pressure=np.array([2.0])) == [0.75]
    file.write_text(file.read_text() + "\n\n@usersub.vfric\ndef own(fTangential):\n    pass\n")
    with pytest.raises(LoadError, match="defines VFRIC twice: 'mu'"):
        usersub.load(file)


def test_a_debugger_gets_the_law_itself(monkeypatch):
    monkeypatch.setenv("USERSUB_DEBUG", "1")
    seen = []

    @usersub.coefficient
    def law(slip_rate, props):
        seen.append(slip_rate)
        return props[0] * math.exp(-slip_rate)

    scene = usersub.Scene(points=1, dimension=2, props=[0.4], states=1, characteristic_length=1.0)
    driver = usersub.StandardDriver(law.fric, scene)
    for _ in range(2):
        driver.begin_increment(0.1)
        found = driver.iterate(slip_increment=np.array([[0.2]]), pressure=np.array([5.0]))
        driver.commit()
    # The first increment closed the point; in the second .195 of .2 is slip.
    assert found.tau[0, 0] == pytest.approx(2.0 * math.exp(-1.95), rel=1e-14)
    assert repr(seen[-1]).startswith("Dual(")


def test_importing_and_decorating_loads_no_compiler():
    code = (
        "import sys, usersub\n"
        "@usersub.coefficient\ndef mu(slip_rate, props):\n    return props[0]\n"
        "r = mu.fric\n"
        "sys.exit(any(m in sys.modules for m in ('numba', 'scipy', 'llvmlite')))\n"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


_HELPERS = (
    "import math\n\nFACTOR = {factor}\n\n\ndef scaled(x):\n    return FACTOR * math.tanh(x)\n"
)

_USER = (
    "import numba\nimport usersub\nimport lift_helpers\nfrom lift_helpers import scaled\n\n\n"
    "@numba.njit\ndef twice(x):\n    return 2.0 * x\n\n\n"
    "@usersub.coefficient\ndef law(slip_rate):\n"
    "    return scaled(slip_rate) + {call}\n"
)


@pytest.mark.parametrize("compiled", [True, False], ids=["machine", "interpreter"])
@pytest.mark.parametrize(
    ("call", "slopes"),
    [
        ("lift_helpers.scaled(slip_rate)", (2.0, 6.0)),
        ("twice(slip_rate)", (3.0, 5.0)),
        ("max(slip_rate, 1.0) * slip_rate", (2.0, 4.0)),
    ],
)
def test_helpers_are_plain_functions_of_any_module(tmp_path, call, slopes, compiled):
    file = tmp_path / "law.py"
    file.write_text(_USER.format(call=call))
    for factor, slope in zip((1.0, 3.0), slopes, strict=True):
        # A changed helper counts: it is not taken from the cache.
        (tmp_path / "lift_helpers.py").write_text(_HELPERS.format(factor=factor))
        with pytest.MonkeyPatch.context() as patch:
            if not compiled:
                patch.setenv("USERSUB_DEBUG", "1")
            routine = usersub.load(file)["fric_coef"]
        scene = usersub.Scene(points=1, derivatives=1)
        driver = usersub.CoefficientDriver(routine, scene)
        mu = driver.evaluate(slip_rate=np.full(1, 1e-9), pressure=np.ones(1))
        assert driver.array("derivative").ravel()[0] == pytest.approx(slope, rel=1e-8)
        assert mu[0] == pytest.approx(1e-9 * slope, rel=1e-8)


def test_a_law_may_return_a_whole_number(capfd):
    @usersub.coefficient
    def whole(slip_rate):
        print(slip_rate)
        return 1 if slip_rate < 2.0 else 0

    scene = usersub.Scene(points=2)
    for name in ("fric_coef", "vfric_coef"):
        driver = usersub.CoefficientDriver(whole.behind(name), scene)
        mu = driver.evaluate(slip_rate=np.array([1.5, 2.5]), pressure=np.ones(2))
        assert mu.tolist() == [1.0, 0.0]
    said = capfd.readouterr()
    assert said.out.split() == ["1.5", "2.5", "1.5", "2.5"]
    assert not said.err


@pytest.mark.parametrize("kind", ["coefficient", "strength"])
def test_a_negative_answer_is_refused_behind_fric(kind):
    law = _decorated("def f(pressure): return 0.2 - pressure", kind)
    scene = usersub.Scene(points=1, dimension=2, states=1, characteristic_length=1.0)
    driver = usersub.StandardDriver(law.fric, scene)
    arrays = {"slip_increment": np.array([[0.2]]), "pressure": np.array([5.0])}
    driver.begin_increment(0.1)
    driver.iterate(**arrays)
    driver.commit()
    driver.begin_increment(0.1)
    with pytest.raises(usersub.RoutineError, match=f"behind FRIC returns a {kind} below zero"):
        driver.iterate(**arrays)
