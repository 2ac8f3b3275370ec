# SPDX-License-Identifier: MIT
"""Every argument of VFRIC, VFRICTION and VFRIC_COEF against a numpy statement of the interfaces."""

from __future__ import annotations

import engine_explicit as ee
import numpy as np
import pytest
from engine_explicit import PLACES, bindable, run
from engine_probe import compare

import usersub

HAVES = {
    "bare": {},
    "temperatures": {"temperatures": 1},
    "fields": {"fields": 2},
    "states": {"states": 3},
    "all": {"temperatures": 1, "fields": 3, "states": 2},
}
#: Rotations and projections lose a few units in the last place of the largest component.
TOLERANCE = {"double": 1e-14, "single": 3e-6}


def initial_state(host) -> np.ndarray:
    shape = host.state_shape()
    return np.asfortranarray(np.arange(1.0, 1 + np.prod(shape)).reshape(shape).astype(host.real))


def check(probe, host, style):
    made = probe(style, host.interface, precision=host.precision)
    driver = usersub.ExplicitDriver(made.routine, host.scene())
    state = initial_state(host)
    if host.states and host.interface != "vfric_coef":
        driver.state["state"][...] = state
    run(driver, bindable(driver, host))
    expected = [
        host.expected(block, state, host.arrays["previous_force"].astype(float))
        for block in host.blocks()
    ]
    compare(made.checked_calls(), expected, TOLERANCE[host.precision])
    return made


@pytest.mark.parametrize("style", ["full", "block", "python"])
@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("haves", HAVES)
@pytest.mark.parametrize(("interface", "dimension", "contact"), PLACES)
def test_every_argument(probe, interface, dimension, contact, haves, precision, style):
    host = ee.Host(interface, 9, dimension, contact, precision, **HAVES[haves])
    made = check(probe, host, style)
    if style == "full":
        assert made.lengths == [[80, 80, 80]] * len(made.calls)


@pytest.mark.parametrize("style", ["full", "python"])
@pytest.mark.parametrize("block", [1, 7, 9, 20])
@pytest.mark.parametrize(("interface", "dimension", "contact"), PLACES)
def test_every_argument_in_blocks(probe, interface, dimension, contact, block, style):
    check(probe, ee.Host(interface, 9, dimension, contact, block=block, **HAVES["all"]), style)


@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
def test_arrays_that_nobody_binds(probe, interface):
    """Routines that do not say what they read get the documented values instead."""
    host = ee.Host(interface, **HAVES["all"])
    made = probe("full", interface)
    driver = usersub.ExplicitDriver(made.routine, host.scene())
    needed = ["slip_increment", "normal", "normal_force", "stick_force"]
    needed += ["secondary_node"] if interface == "vfric" else []
    run(driver, {name: host.arrays[name] for name in needed})
    (call,) = made.checked_calls()
    for name in ("tempSec", "tempMain", "preDefSec", "fieldSec", "coordSec", "velMain", "shape"):
        assert not np.any(call.get(name, 0)), name
    for name in ("areaSec", "areaCont", "shapeSec"):
        assert np.all(call.get(name, 1) == 1), name
    if interface == "vfric":
        np.testing.assert_array_equal(call["jSecUid"], np.arange(1, ee.SECONDARY_NODES + 1))
        np.testing.assert_array_equal(call["jMainUid"], np.arange(1, ee.MAIN_NODES + 1))
    if interface == "vfric_coef":
        np.testing.assert_array_equal(call["pressure"], host.arrays["normal_force"])
    else:
        assert not np.any(call["fTangPrev"])


@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
def test_names_longer_than_their_place_are_refused_and_short_ones_padded(probe, interface):
    host = ee.Host(interface)
    longest = "x" * 80
    scene = host.scene().replace(interaction=longest, main="")
    made = probe("full", interface)
    run(usersub.ExplicitDriver(made.routine, scene), {
        name: array for name, array in host.arrays.items() if name != "field_main"
    })  # fmt: skip
    (call,) = made.checked_calls()
    assert call["surfInt"] == b"X" * 80
    assert call["surfMain"] == b" " * 80
    with pytest.raises(usersub.Error, match="interaction"):
        usersub.ExplicitDriver(made.routine, scene.replace(interaction=longest + "x"))
