# SPDX-License-Identifier: MIT
"""Checked drivers: crashes, stops, time, tracing, flags; the same bits as the fast ones."""

from __future__ import annotations

import os
import threading

import numpy as np
import pytest

import usersub
from tests.unit.checked_hosts import HOSTS, Host, flags_of, name_of, source
from usersub.errors import ContractError, RoutineError, SceneError
from usersub.statuses import STATUSES

VALUES = {s.name: s.value for s in STATUSES}
PLACES = [Host("fric"), Host("fric_coef"), Host("vfric"), Host("vfriction"), Host("vfric_coef")]
_INTERFACES = pytest.mark.parametrize("host", PLACES, ids=lambda host: host.interface)


@pytest.fixture
def routine(c_routine):
    """A routine with one more statement at its end."""

    def make(host: Host, body: str = "", head: str = "", **more):
        text = flags_of(host.precision) + source(host.interface, body, host.generation, head=head)
        return c_routine(
            host.interface, text, generation=host.generation, precision=host.precision, **more
        )

    return make


def failed(driver, host, what: str, status: str, match: str | None = None):
    """What a call saw that ends so."""
    with pytest.raises(RoutineError, match=match) as raised:
        host.run(driver)
    assert raised.value.status == VALUES[status]
    seen = driver.observed()
    assert seen.what == what
    return seen


# Ends.


@_INTERFACES
def test_no_return(routine, host):
    driver = host.driver(routine(host, "for (volatile int i = 0;; i++) ;"))
    assert driver.time_limit == 2.0
    driver.time_limit = 0.05
    seen = failed(driver, host, "time", "ROUTINE_CRASHED", "did not return within 0.05 s")
    assert seen.place > 0


def test_routine_that_waits_has_five_times_as_long(routine):
    host = Host("fric", points=1)
    driver = host.driver(routine(host, "usleep(120000);", head="int usleep(unsigned);"))
    driver.time_limit = 0.1
    host.run(driver)
    assert driver.observed().what == "nothing"
    driver.time_limit = 0.01
    failed(driver, host, "time", "ROUTINE_CRASHED")


def test_no_limit(routine):
    host = Host("fric", points=1)
    busy = "double s = 0; for (int i = 0; i < 30000000; i++) s += i % 3; SED[0] = s < 0;"
    driver = host.driver(routine(host, busy))
    driver.time_limit = 0
    host.run(driver)
    assert driver.observed().what == "nothing"


@pytest.mark.parametrize("limit", [-1.0, float("nan"), float("inf"), "2"])
def test_wrong_limit(routine, limit):
    driver = Host("fric").driver(routine(Host("fric")))
    with pytest.raises(SceneError, match="time.limit"):
        driver.time_limit = limit


@_INTERFACES
def test_stop(routine, host):
    driver = host.driver(routine(host, "xit_();", head="void xit_(void);"))
    assert failed(driver, host, "stop", "ROUTINE_STOPPED", "ended with XIT").sentence


@_INTERFACES
def test_division(routine, host):
    body = "volatile int zero = 0; zero = 1 % zero; __builtin_trap();"
    driver = host.driver(routine(host, body))
    seen = failed(driver, host, "crash", "ROUTINE_CRASHED")
    assert (seen.argument, seen.element) == ("", None)


@_INTERFACES
def test_address_of_nobody(routine, host):
    driver = host.driver(routine(host, "*(volatile int *)24 = 1;"))
    failed(driver, host, "crash", "ROUTINE_CRASHED", "memory fault at address 0x18")


def test_stack_overflow(routine):
    host = Host("fric")
    head = "static int deep(volatile int n) { volatile char a[4096]; a[n % 4096] = 1; "
    head += "return deep(n + 1) + a[0]; }"
    driver = host.driver(routine(host, "LM[0] = deep(0) > 0;", head=head))
    failed(driver, host, "crash", "ROUTINE_CRASHED", "stack overflow")
    host.run(host.driver(routine(host)))  # and all is well


@pytest.mark.parametrize("host", [Host("vfric_coef", points=40)], ids=["threads"])
def test_large_local_arrays_on_threads(routine, host):
    body = "volatile char big[16 << 20]; big[0] = big[(16 << 20) - 1] = 1; fCoef[0] *= big[0];"
    made = routine(host, body.replace("fCoef[0] *= big[0]", "if (!big[0]) fCoef[0] = 2"),
                   thread_safe=True)  # fmt: skip
    driver = host.driver(made, threads=4, block=5)
    thread = threading.Thread(target=host.run, args=(driver,))  # the main thread has 8 MB or more
    before = threading.stack_size(64 << 20)
    try:
        thread.start()
    finally:
        threading.stack_size(before)
    thread.join()
    assert driver.observed().what == "nothing"


# What goes in and out.


@pytest.mark.parametrize("host", HOSTS, ids=name_of)
def test_same_bits_as_the_fast_driver(routine, host):
    """Answers that depend on what goes in, to all that comes out."""
    body = {
        "fric": "for (int a = 0; a < *NFDIR; a++) { TAU[a] = PROPS[0] * PRESS[0] + DGAM[a];"
        "DDTDDP[a] = PROPS[0]; DDTDDG[a] = PREDEF[1]; STATEV[a % *NSTATV] += DGAM[a] + a; }"
        "SED[0] = TEMP[0]; SFD[0] += 0; PNEWDT[0] = 2;".replace("SFD[0] += 0;", "SFD[0] = 1;"),
        "fric_coef": "fCoef[0] = props[0] + 0.125 * tempAvg[0];",
        "vfric": "for (int k = 0; k < *nContact; k++) { fTangential[k * *nFricDir] = "
        "-props[0] * fNormal[k]; statev[(jConSecid[k] - 1) * *nStateVar] = k + tempSec[k]; }",
        "vfriction": "for (int k = 0; k < *nBlock; k++) { fTangential[2 * k] = -props[0] * "
        "fNormal[k]; state[k * *nStates * *nNodState] += areaCont[k] + k; }",
        "vfric_coef": "for (int k = 0; k < *nBlock; k++) fCoef[k] = props[0] + 0.25 * tempAvg[k];",
    }[host.interface]
    made = routine(host, body)
    found = []
    for checked in (0, 1):
        driver = host.driver(made, checked=checked)
        for _ in range(2):
            if isinstance(driver, usersub.StandardDriver):
                driver.begin_increment(0.5)
                driver.iterate()
                driver.commit()
            else:
                host.run(driver)
        names = [n for n, p in driver.layout.ports.items() if p.role in ("out", "state")]
        found.append([driver.array(n).tobytes() for n in names if driver.keeps(n)])
    assert found[0] == found[1]


def test_messages_are_handed_on_once(routine):
    host = Host("fric", points=2)
    head = "void stdb_abqerr_(int *, char *, int *, double *, char *, long, long);"
    body = 'int n = 1; double r = 0; stdb_abqerr_(&n, "hello", &n, &r, "        ", 5, 8);'
    said = []
    usersub.messages_to(lambda level, text: said.append(text))
    try:
        host.run(host.driver(routine(host, body, head=head)))
    finally:
        usersub.messages_to(None)
    assert said == ["hello", "hello"]


def test_exception_of_a_python_routine():
    @usersub.vfric_coef
    def raises(fCoef, props):
        fCoef[:] = 0.5
        if props[0] > 0.0:
            raise ValueError("no such friction")

    host = Host("vfric_coef")
    driver = host.driver(raises)
    with pytest.raises(RoutineError, match="no such friction") as raised:
        host.run(driver)
    assert raised.value.status == VALUES["ROUTINE_RAISED"]
    assert driver.observed().what == "nothing"


def test_blocks_and_threads(routine):
    """The failure of the lowest block is seen, with its point; others' flags too."""
    host = Host("vfric_coef", points=64)
    body = "for (int k = 0; k < *nBlock; k++) if (slipRate[k] > 1) fCoef[k + 1000000 % 7] = 0;"
    body = "for (int k = 0; k < *nBlock; k++) if (pressure[k] > 5) ((double *)pressure)[k] = 0;"
    driver = host.driver(routine(host, body, thread_safe=True), threads=4, block=4)
    load = np.full(64, 0.75)
    load[[22, 50]] = 9.0
    driver.bind(normal_force=load)
    seen = failed(driver, host, "input written", "CONTRACT", r"pressure\(3\).* at point 22")
    assert (seen.point, seen.element, seen.index) == (22, 2, (3,))


def test_state_is_as_before_after_a_failure(routine):
    host = Host("vfric")
    driver = host.driver(routine(host, "statev[0] = 7; ((double *)fNormal)[0] = 1;"))
    with pytest.raises(ContractError):
        host.run(driver)
    assert (driver.state["state"] == 0).all()


# Tracing.


@_INTERFACES
def test_tracing(routine, host):
    read, written = {
        "fric": ("PRESS", "SED"), "fric_coef": ("pressure", "fCoefDeriv"),
        "vfric": ("fNormal", "statev"), "vfriction": ("fNormal", "state"),
        "vfric_coef": ("pressure", "fCoefDeriv"),
    }[host.interface]  # fmt: skip
    driver = host.driver(routine(host, f"volatile double x = {read}[0]; {written}[0] = 1;"))
    host.run(driver)
    assert driver.observed().read == driver.observed().written == frozenset()
    driver.tracing = True
    assert driver.tracing
    host.run(driver)
    seen = driver.observed()
    assert read in seen.read and read not in seen.written
    assert written in seen.written and written not in seen.read
    counts = {"fric": {"NFDIR"}, "vfric": {"nContact", "nFricDir"},
              "vfriction": {"nBlock", "nFricDir"}}  # fmt: skip
    assert seen.read == {read} | counts.get(host.interface, {"nBlock"})
    driver.tracing = False
    host.run(driver)
    assert driver.observed().read == frozenset()


def test_tracing_of_what_is_read_and_then_written(routine):
    host = Host("vfric")
    driver = host.driver(routine(host, "statev[0] += 1;"))
    driver.tracing = True
    host.run(driver)
    assert "statev" in driver.observed().read & driver.observed().written


def test_tracing_needs_a_checked_driver(routine):
    driver = Host("fric").driver(routine(Host("fric")), checked=0)
    for use in (
        lambda: setattr(driver, "tracing", True),
        lambda: setattr(driver, "time_limit", 1.0),
        driver.observed,
    ):
        with pytest.raises(SceneError, match="checked"):
            use()
    assert not driver.tracing


# Floating-point flags.


@pytest.mark.parametrize(
    ("body", "flag"),
    [
        ("volatile double z = 0; z = z / z; ", "invalid"),
        ("volatile double z = 0; z = 1 / z; ", "division by zero"),
        ("volatile double z = 1e300; z = z * z; ", "overflow"),
        ("volatile double z = 1e-300; z = z * z; ", "underflow"),
        ("volatile double z = 3; z = 1 / z; ", None),
    ],
)
@_INTERFACES
def test_flags(routine, host, body, flag):
    driver = host.driver(routine(host, body))
    host.run(driver)
    assert driver.observed().flags == ((flag,) if flag else ())


# Other calls.


@pytest.mark.parametrize("interface", ["fric", "fric_coef"])
def test_standard_hosts_have_no_empty_block(routine, interface):
    host = Host(interface)
    with pytest.raises(SceneError, match="points that are there"):
        host.driver(routine(host)).call_empty_block()


def test_empty_block_of_a_fast_driver(routine):
    host = Host("vfriction")
    body = "if (*nBlock == 0) *(volatile int *)0 = 1;"
    driver = host.driver(routine(host, body), checked=0)
    with pytest.raises(RoutineError, match="in a call without points"):
        driver.call_empty_block()


def test_forked_child_has_memory_of_its_own(routine):
    """Parent and child call the same driver; neither sees the other's arguments."""
    host = Host("fric", points=200)
    driver = host.driver(routine(host, "TAU[0] = PRESS[0];"))
    pressure = np.full(200, 2.0)
    driver.bind(pressure=pressure)
    host.run(driver)
    child = os.fork()
    if child == 0:
        try:
            pressure[:] = 3.0
            for _ in range(20):
                host.run(driver)
            right = (driver.array("tau")[0] == 3.0).all() and driver.observed().what == "nothing"
            driver.time_limit = 0.02  # a timer is not inherited either
            loop = host.driver(routine(host, "for (volatile int i = 0;; i++) ;"))
            loop.time_limit = 0.02
            try:
                host.run(loop)
                right = False
            except RoutineError:
                right = right and loop.observed().what == "time"
            os._exit(0 if right else 1)
        finally:
            os._exit(2)
    for _ in range(20):
        host.run(driver)
        assert (driver.array("tau")[0] == 2.0).all()
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_setting_is_checked():
    with pytest.raises(SceneError, match="'checked' = 2; expected 0 or 1"):
        Host("vfric_coef").driver(usersub.laws.routine("coulomb", "vfric_coef", "c"), checked=2)
