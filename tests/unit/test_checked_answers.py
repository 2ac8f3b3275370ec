# SPDX-License-Identifier: MIT
"""Checked drivers: what the answers of several calls say of a routine."""

from __future__ import annotations

import numpy as np
import pytest

import usersub
from tests.unit.checked_hosts import NEEDED, Host, flags_of, source
from usersub.errors import ContractError

#: An output that a host may do without, one that it needs, and a host, for each interface.
PLACES = {
    "fric": ("SFD[0]", "TAU[0]", Host("fric")),
    "fric_coef": ("fCoefDeriv[0]", "fCoef[0]", Host("fric_coef", kind="coefficient")),
    "vfric": ("fTangential[1]", "fTangential[0]", Host("vfric")),
    "vfriction": ("fTangential[1]", "fTangential[0]", Host("vfriction", precision="single")),
    "vfric_coef": ("fCoefDeriv[0]", "fCoef[0]", Host("vfric_coef", precision="single")),
}
_INTERFACES = pytest.mark.parametrize("interface", PLACES)


@pytest.fixture
def checked(c_routine):
    """Driver of a routine with one more statement at its end, and its host."""

    def make(interface: str, body: str = "", needed: str = "", host: Host | None = None, **more):
        host = host or PLACES[interface][2]
        text = flags_of(host.precision) + source(interface, body, host.generation, needed=needed)
        made = c_routine(interface, text, generation=host.generation, precision=host.precision)
        return host.driver(made, **more), host

    return make


def seen_of(driver, host, match: str):
    """What a call saw that has to fail with these words."""
    with pytest.raises(ContractError, match=match) as raised:
        host.run(driver)
    seen = driver.observed()
    assert raised.value.argument == seen.argument
    assert seen.sentence in str(raised.value)
    return seen


@_INTERFACES
def test_right_routine(checked, interface):
    driver, host = checked(interface)
    host.run(driver)
    seen = driver.observed()
    assert (seen.what, seen.argument, seen.element, seen.index) == ("nothing", "", None, None)
    assert (seen.point, seen.access, seen.where, seen.sentence) == (None, "", "", "")


@_INTERFACES
def test_counter_inside(checked, interface):
    driver, host = checked(interface, f"static int n; {PLACES[interface][1]} = ++n;")
    seen = seen_of(driver, host, r"a second call with the same input gave \w+\(1[,1]*\) = ")
    assert (seen.what, seen.element) == ("not repeated", 0)


@_INTERFACES
def test_switch_inside(checked, interface):
    """What changes to and fro looks like an output that is read, if one asks only once."""
    driver, host = checked(interface, f"static int n; n = !n; {PLACES[interface][1]} = n;")
    assert seen_of(driver, host, "a second call with the same input").what == "not repeated"


@_INTERFACES
def test_first_call_is_special(checked, interface):
    """Data of a first call stay: the second gives other answers."""
    driver, host = checked(
        interface, f"static int n; {PLACES[interface][1]} = n ? 0.25 : 0.5; n = 1;"
    )
    assert seen_of(driver, host, "a second call with the same input").what == "not repeated"


_READS = {
    "added": "{0} += 0.125;",
    "asked": "double old = {0}; {1} {0} = old > -1 ? 1 : 2;",
}


def reads(interface: str, how: str) -> str:
    """Statements that read an output of the host before they write it."""
    text = _READS[how].format(PLACES[interface][0], NEEDED[interface])
    return text if how == "asked" else NEEDED[interface] + text


@pytest.mark.parametrize("interface", ["fric", "fric_coef", "vfric_coef"])
@pytest.mark.parametrize("how", _READS)
def test_output_is_read_before_it_is_written(checked, interface, how):
    """What stands there is what stood there by chance."""
    driver, host = checked(interface, needed=reads(interface, how))
    seen = seen_of(driver, host, "before it wrote it")
    assert seen.what == "output read"
    assert seen.argument == PLACES[interface][0].split("[")[0]
    assert seen.access == "read"


@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
@pytest.mark.parametrize("loop", ["k = 0", "k = 1"])
def test_zeros_that_the_host_hands_in_may_be_read(checked, interface, loop):
    """Forces are documented to be zero on entry: to add to them is right."""
    count = "*nContact" if interface == "vfric" else "*nBlock"
    needed = f"for (int {loop}; k < {count}; k++) fTangential[2 * k] -= 0.25;"
    driver, host = checked(interface, needed=needed)
    host.run(driver)
    assert driver.observed().what == "nothing"


@_INTERFACES
def test_variable_that_is_not_set(checked, interface):
    answer = PLACES[interface][1]
    driver, host = checked(interface, f"volatile int local[8]; {answer} = local[3] ? 0.25 : 0.5;")
    seen = seen_of(driver, host, "read a local variable that it had not set")
    assert (seen.what, seen.element) == ("uninitialised", 0)


@_INTERFACES
def test_index_that_is_not_set(checked, interface):
    """It leads nowhere where the stack is clean, and far away where it is not."""
    answer = PLACES[interface][1]
    name = answer.split("[")[0]
    driver, host = checked(interface, f"volatile long local[8]; {answer} = {name}[local[3]];")
    seen = seen_of(driver, host, "read a local variable that it had not set")
    assert seen.what == "uninitialised"


# What is not written.


@pytest.mark.parametrize("interface", ["fric_coef", "vfric_coef"])
def test_coefficient_of_one_point_is_left(checked, interface):
    host = PLACES[interface][2]
    needed = "for (int k = 0; k < *nBlock; k++) if (rData[2] < 0) fCoef[k] = 0.5;"
    if interface == "vfric_coef":
        needed = "for (int k = 0; k < *nBlock; k++) if (k != 1) fCoef[k] = 0.5;"
    driver, host = checked(interface, needed=needed)
    seen = seen_of(driver, host, "did not write fCoef")
    assert (seen.what, seen.argument) == ("not written", "fCoef")
    assert (seen.element, seen.point) == ((1, 1) if interface == "vfric_coef" else (0, 0))
    assert "fCoef" in seen.unwritten


def test_second_coefficient_is_for_anisotropic_friction(checked):
    host = Host("fric_coef", generation="2022")
    driver, _ = checked("fric_coef", host=host)
    host.run(driver)
    assert "fCoef" not in driver.observed().unwritten
    driver, _ = checked("fric_coef", host=host, anisotropic=1)
    seen = seen_of(driver, host, r"did not write fCoef\(1,2\)")
    assert seen.index == (1, 2)


@pytest.mark.parametrize("name", ["DDTDDG", "DDTDDP"])
def test_tangent_that_is_left(checked, name):
    needed = NEEDED["fric"].replace(f"{name}[", f"if (a != 1) {name}[", 1)
    driver, host = checked("fric", needed=needed)
    seen = seen_of(driver, host, f"did not write {name}.* although LM = 0")
    assert (seen.what, seen.argument, seen.point) == ("not written", name, 0)
    assert seen.index == {"DDTDDG": (2, 1), "DDTDDP": (2,)}[name]


@pytest.mark.parametrize("lm", [1, 2])
def test_constrained_points_need_no_tangent(checked, lm):
    driver, host = checked("fric", needed=f"*LM = {lm};", host=Host("fric"))
    driver.bind(multiplier=np.zeros((2, 3), order="F"))
    host.run(driver)
    assert {"DDTDDG", "DDTDDP", "TAU"} <= driver.observed().unwritten
    assert "LM" not in driver.observed().unwritten


def test_relative_motion_is_never_set(checked):
    driver, host = checked("fric", needed=NEEDED["fric"].replace("*LM = 0;", ""))
    seen = seen_of(driver, host, "did not set LM, whatever it was on entry")
    assert (seen.what, seen.argument) == ("not written", "LM")


def test_return_at_once_where_the_point_was_open(checked):
    """The first line that the manual recommends leaves LM as it is."""
    driver, host = checked("fric", needed="if (*LM == 2) return; " + NEEDED["fric"])
    host.run(driver)
    assert driver.array("lm").tolist() == [2, 2, 2]
    assert "LM" in driver.observed().unwritten


@pytest.mark.parametrize("name", ["DDTDDG", "DDTDDP", "LM"])
def test_compiled_routine_that_knows_nothing_of_an_output(c_routine, name):
    """Where the compiler says that an argument is not used at all, nothing is written to it."""
    uses = [3] * len(usersub.abi.interface("fric").args)
    uses[usersub.abi.interface("fric").position(name)] = 0
    needed = {
        "DDTDDG": "*LM = 0; DDTDDP[0] = DDTDDP[1] = 0;",
        "DDTDDP": "*LM = 0; for (int k = 0; k < 4; k++) DDTDDG[k] = 0;",
        "LM": "for (int k = 0; k < 4; k++) DDTDDG[k] = DDTDDP[k / 2] = 0;",
    }[name]
    host = Host("fric")
    driver = host.driver(c_routine("fric", source("fric", needed=needed), uses=tuple(uses)))
    assert seen_of(driver, host, f"did not (write|set) {name}").argument == name


@pytest.mark.parametrize("compiled", [False, True])
def test_python_function_need_not_name_every_output(compiled):
    @usersub.fric(compiled=compiled)
    def frictionless(TAU):
        TAU[:] = 0.0

    host = Host("fric")
    driver = host.driver(frictionless)
    host.run(driver)
    seen = driver.observed()
    assert seen.what == "nothing"
    assert {"DDTDDG", "DDTDDP", "SFD", "DDTDDT"} <= seen.unwritten


@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
def test_force_that_is_left_is_told(checked, interface):
    """The contract presets zero, so that it is no fault."""
    driver, host = checked(interface, needed="if (fNormal[0] < 0) fTangential[0] = 0;")
    host.run(driver)
    seen = driver.observed()
    assert seen.what == "nothing"
    assert seen.unwritten == {"fTangential"}
    driver, host = checked(interface)
    host.run(driver)
    assert driver.observed().unwritten == frozenset()


def test_argument_that_is_said_not_to_be_used(c_routine):
    """A wrong declaration is found out, with the access."""
    position = usersub.abi.interface("fric").position("PRESS")
    uses = [3] * len(usersub.abi.interface("fric").args)
    uses[position] = 0
    host = Host("fric")
    driver = host.driver(c_routine("fric", source("fric", "TAU[0] = PRESS[0];"), uses=tuple(uses)))
    seen = seen_of(driver, host, "read PRESS, which it is said not to use, at point 0")
    assert (seen.what, seen.access, seen.element) == ("left out", "read", 0)
