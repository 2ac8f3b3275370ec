# SPDX-License-Identifier: MIT
"""A call that fails says which thing was wrong and leaves everything as it was: explicit."""

from __future__ import annotations

import engine_explicit as ee
import numpy as np
import pytest
from engine_explicit import PLACES, bindable, run

import usersub
from usersub.errors import ContractError, Error, RoutineError, SceneError

RICH = {"temperatures": 1, "fields": 2, "states": 2}
BAD = [np.nan, np.inf, -np.inf]


class Explicit:
    """A driver after one good step, and everything that a failing one must not change."""

    def __init__(self, probe, interface, dimension=3, contact="node-to-facet", **options) -> None:
        self.broken = None  # what the routine does wrong, set by the test

        def act(me, view):
            call = me.calls[-1]
            if "fCoef" in call:
                view("fCoef")[:] = 0.25
            else:
                view("fTangential")[:] = -1.0
                view("statev" if interface == "vfric" else "state")[...] += 1
            return self.broken(view) if self.broken else 0

        settings = {"dissipation": 1}
        self.host = ee.Host(interface, 9, dimension, contact, settings=settings, **RICH, **options)
        self.probe = probe("block", interface, act=act)
        self.driver = usersub.ExplicitDriver(self.probe.routine, self.host.scene())
        self.arrays = bindable(self.driver, self.host)
        vfric = interface == "vfric"
        nodes = {"secondary_force": ee.SECONDARY_NODES, "main_force": ee.MAIN_NODES}
        nodes = nodes if vfric else {"nodal_force": ee.NODES}
        self.nodal = {n: np.ones((dimension, c), order="F") for n, c in nodes.items()}
        self.driver.bind(**self.arrays, **self.nodal)
        run(self.driver, {})
        self.before = self.everything()

    def everything(self) -> list[bytes]:
        return [self.driver.state.save(), *(a.tobytes() for a in self.nodal.values())]

    def fails(self, kind, match: str) -> Error:
        with pytest.raises(kind, match=match) as caught:
            run(self.driver, {})
        assert not self.probe.errors
        assert self.everything() == self.before
        self.broken = None
        return caught.value


@pytest.mark.parametrize(("interface", "dimension", "contact"), PLACES)
def test_nan_and_infinity_in_every_array_of_an_explicit_host(probe, interface, dimension, contact):
    made = Explicit(probe, interface, dimension, contact)
    for name, array in made.arrays.items():
        if array.dtype.kind != "f" or name in ("velocity", "shape_secondary"):
            continue
        if interface == "vfric_coef" and name == "previous_force":
            continue  # VFRIC_COEF has no argument for it
        for bad in BAD:
            if name == "stick_force" and bad == np.inf:
                continue  # no bound
            if name == "shape_main" and contact == "analytical-rigid":
                continue  # a single node needs no shape function
            spot = tuple(size - 1 for size in array.shape)
            if name == "coord":
                spot = (1, made.arrays["secondary_node"][0, 4] - 1)
            kept, array[spot] = array[spot], bad
            raised = made.fails(SceneError, rf"\b{name}\b")
            array[spot] = kept
            assert interface.upper() in str(raised)
    run(made.driver, {})


@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
@pytest.mark.parametrize("block", [0, 4])
def test_explicit_routines_that_return_nan(probe, interface, block):
    made = Explicit(probe, interface, block=block)

    def breaking(name, spot, bad):
        def broken(view):
            view(name)[spot] = bad

        return broken

    outputs = {"fCoef": ["fCoef"], "fTangential": ["fTangential", "state"]}
    outputs = outputs["fCoef" if interface == "vfric_coef" else "fTangential"]
    for name in outputs:
        real = "statev" if name == "state" and interface == "vfric" else name
        spot = {"fCoef": -1, "fTangential": (1, -1), "state": (1, -1)}[name]
        if name == "state":
            node = made.arrays["secondary_node"][-1] - 1
            spot = (1, node) if interface == "vfric" else (1, 0, -1)
        for bad in BAD:
            made.broken = breaking(real, spot, bad)
            raised = made.fails(RoutineError, "state variable 2" if name == "state" else name)
            first_block = block or 9
            last = first_block - 1
            if real == "statev" and block:
                last = 8 if raised.point == 8 else raised.point
            assert raised.point == last
    run(made.driver, {})


def test_negative_coefficients(probe):
    made = Explicit(probe, "vfric_coef")

    def negative(view):
        view("fCoef")[3] = -0.5

    made.broken = negative
    assert made.fails(ContractError, "fCoef = -0.5 at point 3").point == 3


def test_forces_that_overflow(probe):
    made = Explicit(probe, "vfric")

    def huge(view):
        view("fTangential")[:] = -1.7e308

    made.broken = huge
    made.fails(RoutineError, "overflows")
    made = Explicit(probe, "vfric_coef")
    made.arrays["stick_force"][:] = np.inf
    made.arrays["normal_force"][2] = 1e308

    def big(view):
        view("fCoef")[:] = 1e10

    made.broken = big
    made.fails(RoutineError, "overflows")


@pytest.mark.parametrize("area", [0.0, -1.0, np.nan, np.inf])
def test_areas_that_give_no_pressure(probe, area):
    made = Explicit(probe, "vfric_coef")
    made.arrays["area"][5] = area
    made.fails(SceneError, "area of point 5")


@pytest.mark.parametrize("factor", [0.0, 0.9, 1.1, np.nan])
def test_normals_that_are_no_unit_vectors(probe, factor):
    made = Explicit(probe, "vfriction")
    made.arrays["normal"][:, 6] *= factor
    made.fails(SceneError, "normal of point 6")


@pytest.mark.parametrize("value", [-1.0, -1e-300, np.nan])
@pytest.mark.parametrize("name", ["normal_force", "stick_force"])
def test_forces_have_no_sign(probe, name, value):
    made = Explicit(probe, "vfriction")
    made.arrays[name][1] = value
    made.fails(SceneError, name)
