# SPDX-License-Identifier: MIT
"""A law function of five lines behind the five interfaces, against routines written by hand.

The routines by hand do the same work with the same `exp`, derivatives worked out on paper, and are
compiled with the same options and called by the same driver.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

import usersub

PROPS = (0.15, 0.05, 0.01)
POINTS = 10_000


@usersub.coefficient(props=3)
def law(slip_rate, props):
    static, kinetic, decay = props[0], props[1], props[2]
    return kinetic + (static - kinetic) * math.exp(-decay * slip_rate)


@usersub.fric
def fric(LM, TAU, DDTDDG, DDTDDP, DSLIP, SED, SFD, STATEV, DGAM, DROT, PRESS, DTIME, CHRLNGTH,
         PROPS):  # fmt: skip
    if LM[0] == 2:
        STATEV[0] = STATEV[1] = 0.0
        return
    LM[0] = 0
    allowable = 0.005 * CHRLNGTH
    x = DROT[0, 0] * STATEV[0] + DROT[0, 1] * STATEV[1] + DGAM[0]
    y = DROT[1, 0] * STATEV[0] + DROT[1, 1] * STATEV[1] + DGAM[1]
    length = math.hypot(x, y)
    p = max(PRESS, 0.0)
    plastic = max(length - allowable, 0.0)
    rate = plastic / DTIME
    transition = (PROPS[0] - PROPS[1]) * math.exp(-PROPS[2] * rate)
    mu = PROPS[1] + transition
    strength = mu * p
    reach = max(length, allowable)
    secant = strength / reach
    along = 0.0
    if plastic > 0.0:
        along = -p * PROPS[2] * transition / DTIME - secant
    x /= reach
    y /= reach
    TAU[0] = strength * x
    TAU[1] = strength * y
    DSLIP[0] = plastic * x
    DSLIP[1] = plastic * y
    DDTDDP[0] = mu * x
    DDTDDP[1] = mu * y
    DDTDDG[0, 0] = secant + along * x * x
    DDTDDG[0, 1] = DDTDDG[1, 0] = along * x * y
    DDTDDG[1, 1] = secant + along * y * y
    STATEV[0] = allowable * x
    STATEV[1] = allowable * y
    SED[0] = 0.5 * (TAU[0] * STATEV[0] + TAU[1] * STATEV[1])
    SFD[0] = TAU[0] * DSLIP[0] + TAU[1] * DSLIP[1]


@usersub.fric_coef(block_safe=True)
def fric_coef(fCoef, fCoefDeriv, nBlock, slipData, props):
    for k in range(nBlock):
        transition = (props[0] - props[1]) * math.exp(-props[2] * slipData[k, 0])
        fCoef[k, 0] = props[1] + transition
        fCoefDeriv[k, 0, 0] = -props[2] * transition


@usersub.vfric
def vfric(fTangential, dSlipFric, dTimCur, fNormal, fStickForce, props):
    for i in range(fNormal.shape[0]):
        if fNormal[i] > 0.0:
            mu = props[1] + (props[0] - props[1]) * math.exp(-props[2] * dSlipFric[0, i] / dTimCur)
            fTangential[0, i] = -min(mu * fNormal[i], fStickForce[i])


@usersub.vfriction
def vfriction(fTangential, dSlipFric, rData, fNormal, fStickForce, props):
    for k in range(fNormal.shape[0]):
        if fNormal[k] > 0.0:
            mu = props[1] + (props[0] - props[1]) * math.exp(-props[2] * dSlipFric[0, k] / rData[2])
            fTangential[0, k] = -min(mu * fNormal[k], fStickForce[k])


@usersub.vfric_coef
def vfric_coef(fCoef, slipRate, props):
    for k in range(fCoef.shape[0]):
        fCoef[k] = props[1] + (props[0] - props[1]) * math.exp(-props[2] * slipRate[k])


BY_HAND = {
    "fric": fric, "fric_coef": fric_coef, "vfric": vfric, "vfriction": vfriction,
    "vfric_coef": vfric_coef,
}  # fmt: skip

#: What else the interface takes from the law.
WITH = dict.fromkeys(("fric", "fric_coef"), " with tangent")


def prepared(routine: usersub.Routine) -> tuple[object, Callable, Callable]:
    """A driver with everything bound, its prepared call, and what reads its results."""
    random = np.random.default_rng(7)
    slip = random.normal(size=(3, POINTS)) * 1e-2
    if routine.interface.solver == "standard":
        return _standard(routine, slip[:2], random)
    if routine.interface.name == "vfric_coef":
        scene = usersub.Scene(points=POINTS, props=PROPS)
        driver = usersub.CoefficientDriver(routine, scene)
        driver.bind(slip_rate=random.uniform(0.0, 200.0, POINTS), pressure=np.ones(POINTS))
        driver.evaluate()
        return driver, driver.prepare(), lambda: driver.array("coefficient").copy()
    scene = usersub.Scene(points=POINTS, dimension=3, props=PROPS)
    driver = usersub.ExplicitDriver(routine, scene)
    normal = random.normal(size=(3, POINTS))
    normal /= np.linalg.norm(normal, axis=0)
    arrays = {
        "slip_increment": np.asfortranarray(slip),
        "normal": np.asfortranarray(normal),
        "normal_force": random.uniform(10.0, 20.0, POINTS),
        "stick_force": random.uniform(0.5, 5.0, POINTS),
    }
    driver.step(1e-3, **{k: a for k, a in arrays.items() if k in driver.layout.ports})
    return driver, driver.prepare(), lambda: driver.array("force").copy()


def _standard(routine: usersub.Routine, slip: np.ndarray, random: np.random.Generator) -> tuple:
    """Points that stick and slip, some turned by the last increments; the tangent is wanted."""
    states = 2 if routine.interface.name == "fric" else 0
    scene = usersub.Scene(
        points=POINTS, dimension=3, props=PROPS, states=states, characteristic_length=1.0,
    )  # fmt: skip
    driver = usersub.StandardDriver(routine, scene)
    motion = np.asfortranarray(slip)
    arrays = {"slip_increment": motion, "pressure": random.uniform(10.0, 20.0, POINTS)}
    for _ in range(2):
        driver.begin_increment(1e-3)
        driver.iterate(**arrays)
        driver.commit()
    driver.begin_increment(1e-3)
    driver.iterate(**arrays)
    names = ("tau", "ddtddg", "ddtddp", "dslip")
    return (
        driver,
        driver.prepare(),
        lambda: np.concatenate([driver.array(n).ravel() for n in names]),
    )


def pairs() -> dict[str, tuple[Callable, Callable]]:
    """By interface the prepared calls of the law function and of the routine by hand.

    Both give the same results, which is checked.
    """
    found = {}
    for name, by_hand in BY_HAND.items():
        (keep, call, results), (keep_hand, call_hand, by_hand_results) = (
            prepared(routine) for routine in (law.behind(name), by_hand)
        )
        call()
        call_hand()
        expected = by_hand_results()
        scale = np.abs(expected).max()
        np.testing.assert_allclose(results(), expected, rtol=1e-11, atol=1e-12 * scale)
        found[name] = (_kept(call, keep), _kept(call_hand, keep_hand))
    return found


def _kept(call: Callable, driver: object) -> Callable[[int], None]:
    """Repeats a prepared call; the driver lives as long."""

    def repeat(times: int, driver: object = driver) -> None:
        for _ in range(times):
            call()

    return repeat
