# SPDX-License-Identifier: MIT
"""A call that fails says which thing was wrong and leaves everything as it was: standard."""

from __future__ import annotations

import engine_standard as es
import numpy as np
import pytest

from usersub.errors import ContractError, Error, RoutineError, SceneError

RICH = {"temperatures": 1, "fields": 2, "states": 2}
BAD = [np.nan, np.inf, -np.inf]


class Standard:
    """A driver in its second increment, and everything that a failing iteration must not change."""

    def __init__(self, probe, interface, generation=None, **settings) -> None:
        self.broken = None

        def act(me, view):
            if interface == "fric":
                view("LM")[0] = 0
                view("STATEV")[:] += 1
            else:
                view("fCoef").flat[0] = 0.25
                if self.host.settings.get("anisotropic"):
                    view("fCoef")[0, 1] = 0.5
                if "iData" in me.calls[-1]:
                    view("rData")[7:] += 1
            return self.broken(me, view) if self.broken else 0

        settings["temperature_tangent"] = 1
        self.host = es.Host(interface, settings=settings, **RICH)
        self.probe = probe("block", interface, act=act, generation=generation)
        self.driver = self.host.driver(self.probe.routine)
        self.driver.iterate()
        self.driver.commit()
        self.host.begin(self.driver)
        self.good = self.driver.iterate()
        self.before = self.driver.state.save()

    def fails(self, kind, match: str) -> Error:
        with pytest.raises(kind, match=match) as caught:
            self.driver.iterate()
        assert not self.probe.errors
        assert self.driver.state.save() == self.before
        with pytest.raises(SceneError, match="usub_commit needs a usub_iterate"):
            self.driver.commit()
        self.broken = None
        return caught.value

    def is_unharmed(self) -> None:
        """The next iteration gives the bits of the one before the failures."""
        again = self.driver.iterate()
        for one, two in zip(again, self.good, strict=True):
            np.testing.assert_array_equal(one, two)


@pytest.mark.parametrize("interface", ["fric", "fric_coef"])
def test_nan_and_infinity_in_every_array_of_a_standard_host(probe, interface):
    made = Standard(probe, interface)
    unread = {"multiplier"}  # read where a point sticks by multipliers: test_engine_protocol
    for name, array in made.host.arrays.items():
        if array.dtype.kind != "f" or name in unread or name not in made.driver.layout.ports:
            continue
        for bad in BAD:
            spot = (*(0 for _ in array.shape[:-1]), 3)
            kept, array[spot] = array[spot], bad
            made.fails(SceneError, name)
            array[spot] = kept
    made.is_unharmed()


FRIC_OUTPUTS = ["TAU", "DDTDDG", "DDTDDP", "DDTDDT", "DSLIP", "SED", "SFD", "STATEV"]


@pytest.mark.parametrize("name", FRIC_OUTPUTS)
def test_fric_that_returns_nan(probe, name):
    made = Standard(probe, "fric")
    for bad in BAD:

        def broken(me, view, bad=bad):
            if me.calls[-1]["NODE"] == 91 + 4:
                view(name).T.flat[-1] = bad

        made.broken = broken
        raised = made.fails(RoutineError, "state variable 2" if name == "STATEV" else name)
        assert raised.point == 4
    made.is_unharmed()


@pytest.mark.parametrize("generation", ["legacy", "2022"])
@pytest.mark.parametrize("name", ["fCoef", "fCoefDeriv", "rData"])
def test_fric_coef_that_returns_nan(probe, name, generation):
    made = Standard(probe, "fric_coef", generation)
    if name == "rData" and generation == "legacy":
        return  # legacy routines have no state variables
    for bad in BAD:

        def broken(me, view, bad=bad):
            if me.calls[-1]["pressure"] == made.host.arrays["pressure"][4]:
                spot = {"fCoef": 0, "fCoefDeriv": (0, 1), "rData": -1}[name]
                (view(name).flat if name == "fCoef" else view(name))[spot] = bad

        made.broken = broken
        words = {"fCoef": "fCoef nan|fCoef inf|fCoef -inf", "fCoefDeriv": "NaN or infinity",
                 "rData": "state variable 2"}  # fmt: skip
        assert made.fails((RoutineError, ContractError), words[name]).point == 4
    made.is_unharmed()


def test_coefficients_that_are_too_many_or_too_few(probe):
    made = Standard(probe, "fric_coef")

    def second(me, view):
        view("fCoef")[0, 1] = 0.75

    made.broken = second
    made.fails(ContractError, r"fCoef\(1,2\) = 0.75 at point 0, but the scene is isotropic")
    made = Standard(probe, "fric_coef", anisotropic=1)

    def one(me, view):
        view("fCoef")[0, 1] = np.nan

    made.broken = one
    made.fails(ContractError, "scene is anisotropic")

    def infinite(me, view):
        view("fCoef")[0, 1] = np.inf

    made.broken = infinite
    made.fails(RoutineError, r"fCoef\(1,2\) = inf")

    def negative(me, view):
        view("fCoef")[0, 0] = -0.5

    made.broken = negative
    made.fails(ContractError, "fCoef -0.5")
