# SPDX-License-Identifier: MIT
"""Every argument of FRIC and FRIC_COEF in a standard driver."""

from __future__ import annotations

import engine_standard as es
import numpy as np
import pytest
from engine_probe import compare

DIRECTIONS = [(2, 0), (2, 2), (3, 0), (3, 1)]
HAVES = {
    "bare": {},
    "temperatures": {"temperatures": 1},
    "fields": {"fields": 2},
    "states": {"states": 3},
    "all": {"temperatures": 1, "fields": 3, "states": 2},
}
COEFFICIENTS = [("legacy", "legacy"), ("2022", "2022"), ("2022", "legacy")]


@pytest.mark.parametrize("style", ["full", "block", "python"])
@pytest.mark.parametrize("haves", HAVES)
@pytest.mark.parametrize(("dimension", "directions"), DIRECTIONS)
def test_every_argument_of_fric(probe, dimension, directions, haves, style):
    host = es.Host("fric", 6, dimension, directions, **HAVES[haves])
    made = probe(style, "fric")
    host.driver(made.routine).iterate()
    compare(made.checked_calls(), [host.fric(i) for i in range(6)], 0.0)
    if style == "full":
        assert made.lengths == [[80, 80, 80]] * 6


@pytest.mark.parametrize("block", [1, 4, 6, 100])
@pytest.mark.parametrize("interface", ["fric", "fric_coef"])
def test_points_come_one_by_one_in_any_block(probe, interface, block):
    host = es.Host(interface, block=block, **HAVES["all"])
    made = probe("full", interface, generation="2022" if interface == "fric_coef" else None)
    host.driver(made.routine).iterate()
    expected = [getattr(host, interface)(i) for i in range(6)]
    compare(made.checked_calls(), expected, 1e-15)


@pytest.mark.parametrize("open_by", ["closed", "pressure"])
def test_open_points_are_not_called(probe, open_by):
    host = es.Host("fric")
    made = probe("full", "fric")
    arrays = {"pressure": host.arrays["pressure"].copy()}
    if open_by == "closed":
        arrays["closed"] = np.array([1, 0, 7, 0, -1, 0], dtype=np.int32)
    else:
        arrays["pressure"][[1, 3, 5]] = [0.0, -1.0, -0.0]
    response = host.driver(made.routine, **arrays).iterate()
    assert [call["NODE"] for call in made.checked_calls()] == [91, 93, 95]
    assert list(response.lm[1::2]) == [2, 2, 2]


def test_arrays_that_nobody_binds(probe):
    """FRIC without anything optional, in a scene that has everything."""
    host = es.Host("fric", **HAVES["all"])
    made = probe("full", "fric")
    optional = set(host.arrays) - {"slip_increment", "pressure"}
    host.driver(made.routine, **dict.fromkeys(optional)).iterate()
    for i, call in enumerate(made.checked_calls()):
        zero = ("NOEL", "NPT", "TAULM", "DDPDDH", "RCOORD", "COORDS", "TEMP", "PREDEF")
        assert not any(np.any(call[name]) for name in zero)
        assert call["NODE"] == i + 1
        assert (
            call["DPRESS"] == host.arrays["pressure"][i] - host.committed["committed_pressure"][i]
        )
        np.testing.assert_array_equal(call["DROT"], np.eye(2))


def test_contact_elements_have_no_node(probe):
    host = es.Host("fric")
    made = probe("full", "fric")
    host.driver(made.routine, node=None).iterate()
    assert [call["NODE"] for call in made.checked_calls()] == [0] * 6
    assert [call["NOEL"] for call in made.checked_calls()] == [51, 52, 53, 54, 55, 56]


@pytest.mark.parametrize("style", ["full", "block", "python"])
@pytest.mark.parametrize("haves", HAVES)
@pytest.mark.parametrize(("dimension", "directions"), DIRECTIONS)
@pytest.mark.parametrize(("scene", "routine"), COEFFICIENTS)
def test_every_argument_of_fric_coef(probe, scene, routine, dimension, directions, haves, style):
    """A legacy routine gets the legacy layout whatever the scene speaks."""
    host = es.Host("fric_coef", 6, dimension, directions, scene, **HAVES[haves])
    made = probe(style, "fric_coef", generation=routine)
    host.driver(made.routine).iterate()
    host.generation = routine
    compare(made.checked_calls(), [host.fric_coef(i) for i in range(6)], 1e-15)


def test_iterations_are_counted_and_failed_ones_are_not(probe):
    host = es.Host("fric_coef", 1)
    fail = []

    def act(me, view):
        return -9 if fail else 0

    made = probe("block", "fric_coef", act=act)
    driver = host.driver(made.routine)
    driver.iterate()
    driver.iterate()
    fail.append(1)
    with pytest.raises(Exception, match="FRIC_COEF"):
        driver.iterate()
    fail.clear()
    driver.iterate()
    driver.cut_back()
    host.begin(driver)
    driver.iterate()
    assert [call["iData"][2] for call in made.checked_calls()] == [1, 2, 3, 3, 1]
