# SPDX-License-Identifier: MIT
"""Saved state: what it holds, what is refused, and that a resumed run gives the same bits."""

from __future__ import annotations

import struct

import engine_explicit as ee
import engine_standard as es
import numpy as np
import pytest
from engine_explicit import bindable, run
from hypothesis import given, settings
from hypothesis import strategies as st

import usersub
from usersub.errors import SceneError, StateError

#: Offsets of the header: magic, byte order, format, ABI version, kind, interface, precision, sizes,
#: force kept, step, increment, timed, enforcement, changing, times, work, dissipation, bytes, check
#: sum.
HEADER = struct.Struct("=8s2I4i12i6i5d2Q")
FIELDS = ["magic", "order", "format", "abi", "kind", "interface", "single"]
FIELDS += ["N", "D", "F", "S", "P", "A", "B", "M", "X", "Y", "Z", "T"]
FIELDS += ["force", "step", "increment", "timed", "enforcement", "changing"]
FIELDS += ["time0", "time1", "time2", "work", "dissipation", "payload", "check"]


def forged(data: bytes, body: bytes | None = None, **changes) -> bytes:
    """`data` with other header fields and a check sum that fits."""
    values = dict(zip(FIELDS, HEADER.unpack(data[: HEADER.size]), strict=True)) | changes
    body = data[HEADER.size :] if body is None else body
    if "check" not in changes:
        values["check"] = 0
        total = 14695981039346656037
        for byte in HEADER.pack(*values.values()) + body:
            total = (total ^ byte) * 1099511628211 % 2**64
        values["check"] = total
    return HEADER.pack(*values.values()) + body


def explicit(probe, interface="vfriction", **options):
    """A driver after a step that left state, a previous force and dissipation."""

    def act(me, view):
        call = me.calls[-1]
        if "fCoef" in call:
            view("fCoef")[:] = 0.25
            return
        view("fTangential")[0] = -call["fNormal"] - call["fTangPrev"][0] / 4
        name = "statev" if interface == "vfric" else "state"
        view(name)[...] = view(name) / 2 + call["frictionWork" if interface == "vfric" else "nDir"]

    settings = {"dissipation": 1}
    states = 0 if interface == "vfric_coef" else 2
    host = ee.Host(interface, 5, states=states, settings=settings, **options)
    made = probe("full", interface, precision=host.precision, act=act)
    driver = usersub.ExplicitDriver(made.routine, host.scene())
    arrays = bindable(driver, host) | {"previous_force": None}
    run(driver, arrays)
    return made, host, driver, arrays


def standard(probe, interface="fric"):
    def act(me, view):
        call = me.calls[-1]
        if "fCoef" in call:
            view("fCoef").flat[0] = 0.25 + 0.5 / (1 + call["slipData"][0, 3])
            view("rData")[7:] += call["slipData"][0, 0]
            return
        view("LM")[0] = 0
        view("TAU")[:] = 0.5 * call["TAU"] + call["DGAM"]
        view("DSLIP")[:] = call["DGAM"] / 3
        view("STATEV")[:] += call["TIME"][0]

    host = es.Host(interface, 4, states=2)
    made = probe("full", interface, act=act)
    return made, host, host.driver(made.routine)


def test_what_is_saved(probe):
    _, host, driver, _ = explicit(probe)
    data = driver.state.save()
    header = dict(zip(FIELDS, HEADER.unpack(data[: HEADER.size]), strict=True))
    assert header["magic"] == b"USUBSTAT" and header["force"] == header["timed"] == 1
    assert [header[k] for k in "NDFSPABMXYZT"] == [5, 3, 2, 2, 0, 5, 1, 4, 0, 0, ee.NODES, 1]
    assert (header["step"], header["increment"]) == (ee.STEP, ee.INCREMENT)
    assert tuple(header[f"time{i}"] for i in range(3)) == ee.TIMES and header["work"] == ee.WORK
    assert header["payload"] == len(data) - HEADER.size == 8 * (2 * 5 + 3 * 5)
    assert forged(data) == data  # the check sum is FNV-1a


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"magic": b"NUMPYARR"}, "not a state saved by usersub"),
        ({"order": 0x04030201}, "byte order"),
        ({"format": 99}, "format version"),
        ({"abi": 99}, "ABI version"),
        ({"kind": 0}, "another interface or kind"),
        ({"enforcement": 1}, "enforces sticking"),
        ({"changing": 1}, "changes friction"),
        ({"interface": 0}, "another interface or kind"),
        ({"single": 1}, "another precision"),
        ({"N": 6}, "other sizes"),
        ({"T": 4}, "other sizes"),
        ({"force": 2}, "header is damaged"),
        ({"force": 0}, "cut short or too long"),
        ({"timed": -1}, "header is damaged"),
        ({"time0": float("nan")}, "header is damaged"),
        ({"time2": -1.0}, "header is damaged"),
        ({"work": float("inf")}, "header is damaged"),
        ({"payload": 8}, "cut short or too long"),
        ({"payload": 2**64 - 1}, "cut short or too long"),
        ({"check": 0}, "check sum is wrong"),
        ({"payload": 208, "body": bytes(208)}, "cut short or too long"),
    ],
)
def test_what_is_refused_changes_nothing(probe, changes, words):
    _, _, driver, _ = explicit(probe)
    data = driver.state.save()
    with pytest.raises(StateError, match=words):
        driver.state.load(forged(data, **changes))
    assert driver.state.save() == data


def test_ends_that_are_missing_or_too_many(probe):
    _, _, driver, _ = explicit(probe)
    data = driver.state.save()
    for wrong in (b"", data[:7], data[: HEADER.size], data[:-1], data + b"\0", data[1:]):
        with pytest.raises(StateError):
            driver.state.load(wrong)
    assert driver.state.save() == data


def test_conditions_become_lm_so_they_are_looked_at(probe):
    _, host, driver = standard(probe)
    driver.iterate()
    driver.commit()
    data = driver.state.save()
    at = HEADER.size + host.committed["slip"].nbytes
    body = bytearray(data[HEADER.size :])
    assert np.frombuffer(bytes(body), np.int32, 4, at - HEADER.size).tolist() == [0, 0, 0, 0]
    struct.pack_into("=i", body, at - HEADER.size + 8, 3)
    with pytest.raises(StateError, match="a condition is not 0, 1 or 2"):
        driver.state.load(forged(data, bytes(body)))
    assert driver.state.save() == data


def test_no_state_comes_in_an_open_increment(probe):
    _, host, driver = standard(probe)
    data = driver.state.save()
    with pytest.raises(SceneError, match="while an increment is open"):
        driver.state.load(data)
    driver.cut_back()
    driver.state.load(data)


@given(data=st.data())
@settings(max_examples=200)
def test_any_bytes_are_refused_or_taken(probe_session, data):
    driver, good = probe_session
    bad = bytearray(good)
    for _ in range(data.draw(st.integers(1, 4))):
        bad[data.draw(st.integers(0, len(bad) - 1))] = data.draw(st.integers(0, 255))
    bad = bytes(bad)[: data.draw(st.integers(0, len(bad)))]
    if data.draw(st.booleans()) and len(bad) >= HEADER.size:
        bad = forged(bad)  # so that the check sum does not save the rest from being looked at
    try:
        driver.state.load(bad)
    except StateError:
        assert driver.state.save() == good
    else:
        driver.state.load(good)
        assert driver.state.save() == good


@pytest.fixture(scope="module")
def probe_session():
    from engine_probe import make_probe

    def probe(style, interface, **options):
        options["act"] = None
        return make_probe("block", interface, **options)

    made, _, driver, _ = explicit(probe)
    return driver, driver.state.save()


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
def test_a_resumed_explicit_run_gives_the_same_bits(probe, interface, precision):
    made, host, driver, arrays = explicit(probe, interface, precision=precision)
    saved = driver.state.save()
    wanted = [run(driver, {}) for _ in range(3)]
    other = usersub.ExplicitDriver(made.routine, host.scene())
    other.bind(**arrays)
    other.state.load(saved)
    for response in wanted:
        again = run(other, {})
        assert again.force.tobytes() == response.force.tobytes()
        assert again.dissipation == response.dissipation
    assert other.state.save() == driver.state.save()


@pytest.mark.parametrize("interface", ["fric", "fric_coef"])
def test_a_resumed_standard_run_gives_the_same_bits(probe, interface):
    made, host, driver = standard(probe, interface)

    def increments(driver):
        for _ in range(3):
            driver.iterate()
            driver.iterate()
            driver.commit()
            driver.begin_increment(0.25)
        driver.cut_back()
        return driver.state.save()

    driver.iterate()
    driver.commit()
    saved = driver.state.save()
    driver.begin_increment(0.25)
    wanted = increments(driver)
    other = usersub.StandardDriver(made.routine, host.scene())
    other.bind(**{n: a for n, a in host.arrays.items() if n in other.layout.ports})
    other.state.load(saved)
    other.begin_increment(0.25)
    assert increments(other) == wanted


def test_the_clock_saved_is_that_of_the_state(probe):
    """Not that of an increment that is open, was cut back or failed."""
    _, host, driver = standard(probe)
    driver.iterate()
    driver.commit()
    saved = driver.state.save()
    driver.begin_increment(0.25)
    assert driver.state.save() == saved
    driver.iterate()
    assert driver.state.save() == saved
    driver.cut_back()
    assert driver.state.save() == saved


def test_a_state_without_previous_force_forgets_the_drivers_own(probe):
    made, host, driver, arrays = explicit(probe)
    other = usersub.ExplicitDriver(made.routine, host.scene())
    run(other, bindable(other, host))  # its previous force is the host's
    driver.state.load(other.state.save())
    made.calls.clear()
    run(driver, {})
    assert not made.checked_calls()[-1]["fTangPrev"].any()
