# SPDX-License-Identifier: MIT
"""Blocks without their open points: what the closed ones get is what they get with them."""

from __future__ import annotations

import engine_explicit as ee
import numpy as np
import pytest
from engine_explicit import bindable, run

import usersub
from usersub.errors import RoutineError, SceneError

#: Every argument with a point index counts, with a weight of its own.
_VFRICTION = """\
  for (int k = 0; k < *nBlock; ++k) {
    usub_real sum = 1 / fNormal[k] + areaCont[k] + fStickForce[k] + tempSec[k];
    const int main = *nBlockAnal == 1 ? 0 : k;
    sum += tempMain[main] / 2;
    for (int d = 0; d < 3; ++d)
      sum += (d + 2) * (dSlipFric[3 * k + d] + fTangPrev[3 * k + d] + dircosN[3 * k + d] +
                        dircosSl[3 * k + d] / 3);
    for (int j = 0; j < *nFields; ++j)
      sum += (j + 7) * fieldSec[*nFields * k + j] + (j + 9) * fieldMain[*nFields * main + j];
    for (int b = 0; b < *nNodSec; ++b) {
      sum += shapeSec[*nBlockEdge == 1 ? b : *nNodSec * k + b] + jConSecUid[*nNodSec * k + b];
      for (int d = 0; d < 3; ++d)
        sum += coordSec[3 * (*nNodSec * k + b) + d] + velSec[3 * (*nNodSec * k + b) + d] / (d + 2);
    }
    for (int m = 0; m < *nNodMain; ++m) {
      sum += shapeMain[*nNodMain * main + m] + jConMainUid[*nNodMain * main + m];
      for (int d = 0; d < 3; ++d)
        sum += coordMain[3 * (*nNodMain * main + m) + d] +
               velMain[3 * (*nNodMain * main + m) + d] / (d + 2);
    }
    fTangential[2 * k] = sum;
    fTangential[2 * k + 1] = sum / 3;
    for (int s = 0; s < *nStates * *nNodState; ++s)
      state[*nStates * *nNodState * k + s] += (s + 1) * sum;
  }
"""
_VFRIC_COEF = """\
  for (int k = 0; k < *nBlock; ++k) {
    fCoef[k] = 1 / pressure[k] + slipRate[k] + tempAvg[k];
    for (int j = 0; j < *nFields; ++j) fCoef[k] += (j + 2) * fieldAvg[k + *nBlock * j];
  }
"""
_BODIES = {"vfriction": _VFRICTION, "vfric_coef": _VFRIC_COEF}
PLACES = [p for p in ee.PLACES if p[0] in _BODIES]


def law(c_routine, interface, precision="double", body=None):
    define = "#define USUB_SINGLE\n" if precision == "single" else ""
    head = f"void {interface}_(USUB_{interface.upper()}_PARAMETERS)"
    text = f"{define}#include <usersub/abi.h>\n{head} {{\n{body or _BODIES[interface]}}}\n"
    return c_routine(interface, text, precision=precision, thread_safe=True)


def made(interface, dimension, contact, precision="double", points=45, **settings):
    """A host, and which of its points are closed."""
    threads, block = settings.pop("threads", 1), settings.pop("block", 0)
    states = 2 if interface == "vfriction" else 0
    host = ee.Host(
        interface, points, dimension, contact, precision, temperatures=1, fields=2,
        states=states, threads=threads, block=block, settings=settings,
    )  # fmt: skip
    closed = np.random.default_rng(points).random(points) < 0.6
    closed[:4] = False, True, True, False
    return host, closed


def answers(routine, host, closed=None):
    """Force, coefficient and state after two increments."""
    driver = usersub.ExplicitDriver(routine, host.scene())
    arrays = bindable(driver, host)
    if closed is not None:
        arrays["normal_force"] = np.where(closed, arrays["normal_force"], 0).astype(host.real)
    run(driver, arrays)
    found = run(driver, arrays)
    state = driver.state["state"] if "state" in driver.state else np.zeros((1, host.points))
    return found.force, found.coefficient, state


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize(("interface", "dimension", "contact"), PLACES)
@pytest.mark.parametrize(("block", "threads"), [(0, 1), (7, 2), (1, 1)])
def test_closed_points_get_the_same_bits(
    c_routine, interface, dimension, contact, precision, block, threads
):
    routine = law(c_routine, interface, precision)
    host, closed = made(interface, dimension, contact, precision)
    expected = answers(routine, host)  # of points that are all closed
    host, _ = made(
        interface, dimension, contact, precision, block=block, threads=threads, skip_open=1
    )
    force, coefficient, state = answers(routine, host, closed)
    assert force[:, closed].tobytes() == expected[0][:, closed].tobytes()
    assert state[..., closed].tobytes() == expected[2][..., closed].tobytes()
    assert not force[:, ~closed].any() and not state[..., ~closed].any()
    if coefficient is not None:
        assert coefficient[closed].tobytes() == expected[1][closed].tobytes()
        assert not coefficient[~closed].any()


@pytest.mark.parametrize("interface", _BODIES)
def test_the_routine_is_not_called_for_open_points(c_routine, interface):
    """It divides by the normal force, which no call without them shows."""
    routine = law(c_routine, interface)
    host, closed = made(interface, 3, "node-to-facet")
    with pytest.raises(RoutineError, match="at point 0"):
        answers(routine, host, closed)
    host, _ = made(interface, 3, "node-to-facet", skip_open=1)
    force, _, _ = answers(routine, host, np.zeros_like(closed))
    assert not force.any()


def test_conditions_of_enforcement_are_those_of_all_points(c_routine):
    def conditions(skip_open):
        host, closed = made(
            "vfric_coef", 3, "node-to-facet", enforcement="penalty", stick_slope=2.0,
            skip_open=skip_open,
        )  # fmt: skip
        host.arrays.pop("stick_force")
        routine = law(
            c_routine, "vfric_coef", body="for (int k = 0; k < *nBlock; ++k) fCoef[k] = 1;"
        )
        driver = usersub.ExplicitDriver(routine, host.scene())
        arrays = bindable(driver, host)
        arrays["normal_force"] = np.where(closed, arrays["normal_force"], 0)
        force = run(driver, arrays).force
        return force.tobytes(), driver.state["condition"].tolist()

    assert conditions(1) == conditions(0)


@pytest.mark.parametrize("checked", [0, 1])
def test_a_failure_is_that_of_the_point(c_routine, checked):
    body = "for (int k = 0; k < *nBlock; ++k) if (fNormal[k] == 7) fTangential[2 * *nBlock] = 1;\n"
    if not checked:
        body = "if (fNormal[0] == 7) *(volatile int *)8 = 1;\n"
    routine = law(c_routine, "vfriction", body=body)
    host, _ = made("vfriction", 3, "node-to-facet", block=9, checked=checked, skip_open=1)
    closed = np.zeros(host.points, bool)
    closed[[21, 25, 26]] = True
    host.arrays["normal_force"][21] = 7
    with pytest.raises(RoutineError) as caught:
        answers(routine, host, closed)
    assert "points 21 to 26" in str(caught.value)


@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
def test_who_cannot_leave_points_out(c_routine, interface):
    routine = law(c_routine, interface, body="fTangential[0] = 0;\n")
    scene = ee.Host(interface, settings={"skip_open": 1}).scene()
    if interface == "vfriction":
        usersub.ExplicitDriver(routine, scene)
        return
    with pytest.raises(SceneError, match="'skip_open' = 1 is for VFRICTION and VFRIC_COEF"):
        usersub.ExplicitDriver(routine, scene)
