# SPDX-License-Identifier: MIT
"""Same bits for any blocks and threads; random geometry; slips of any size."""

from __future__ import annotations

import engine_explicit as ee
import numpy as np
import pytest
from engine_explicit import PLACES, bindable, run
from hypothesis import given, settings
from hypothesis import strategies as st

import usersub

_STATE = (
    "if (*{states}) {array}[*{states} * {column}] += dSlipFric[*nDir * k] + fTangPrev[*nDir * k];"
)
_FORCE = """\
    const usub_real limit = props[0] * fNormal[k] * (1 + tempSec[k]) + fTangPrev[*nDir * k];
    fTangential[*nFricDir * k] = -(limit < fStickForce[k] ? limit : fStickForce[k]);
    if (*nFricDir == 2) fTangential[2 * k + 1] = fTangPrev[3 * k + 1] / 8;
"""
SOURCES = {
    "vfric": "for (int k = 0; k < *nContact; ++k) {\n" + _FORCE
    + _STATE.format(states="nStateVar", array="statev", column="(jConSecid[k] - 1)") + "\n}",
    "vfriction": "for (int k = 0; k < *nBlock; ++k) {\n" + _FORCE
    + _STATE.format(states="nStates", array="state", column="*nNodState * k") + "\n}",
    "vfric_coef": "for (int k = 0; k < *nBlock; ++k)"
    " fCoef[k] = props[0] / (1 + slipRate[k] + pressure[k] + tempAvg[k]);",
}  # fmt: skip


def law(c_routine, interface, precision="double"):
    define = "#define USUB_SINGLE\n" if precision == "single" else ""
    body = f"void {interface}_(USUB_{interface.upper()}_PARAMETERS) {{\n{SOURCES[interface]}\n}}\n"
    source = f"{define}#include <usersub/abi.h>\n{body}"
    return c_routine(interface, source, precision=precision, thread_safe=True)


def history(c_routine, host, steps=3) -> bytes:
    """Bytes of everything that a few steps leave."""
    driver = usersub.ExplicitDriver(law(c_routine, host.interface, host.precision), host.scene())
    arrays = bindable(driver, host)
    arrays.pop("previous_force", None)
    sizes = {"secondary_force": ee.SECONDARY_NODES, "main_force": ee.MAIN_NODES}
    sizes = sizes if host.vfric else {"nodal_force": ee.NODES}
    for name, count in sizes.items():
        arrays[name] = np.zeros((host.dimension, count), host.real, order="F")
    parts = []
    for _ in range(steps):
        response = run(driver, arrays)
        parts += [response.force.tobytes(), np.float64(response.dissipation).tobytes()]
        arrays["slip_increment"] *= host.real(-0.75)
    parts += [arrays[name].tobytes() for name in sizes]
    parts += [driver.state[name].tobytes() for name in driver.state]
    return b"".join(parts)


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize(("interface", "dimension", "contact"), PLACES)
def test_blocks_and_threads_leave_the_same_bits(
    c_routine, interface, dimension, contact, precision
):
    points = 12 if interface == "vfric" else 301

    def made(block, threads):
        return ee.Host(
            interface, points, dimension, contact, precision, temperatures=1, states=2,
            block=block, threads=threads, settings={"dissipation": 1},
        )  # fmt: skip

    wanted = history(c_routine, made(points, 1))
    for block, threads in [(1, 1), (7, 1), (0, 1), (7, 2), (1, 4), (40, 3)]:
        assert history(c_routine, made(block, threads)) == wanted, (block, threads)


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("dimension", [2, 3])
def test_slips_close_to_the_normal_leave_the_same_bits(c_routine, dimension, precision):
    """Points at once against one by one: from slips in the plane to slips that are all rounding
    there, which are projected twice, some with zeros of either sign."""
    points = 96

    def forces(block: int) -> bytes:
        host = ee.Host("vfric_coef", points, dimension, precision=precision, block=block)
        normal, slip = host.arrays["normal"], host.arrays["slip_increment"]
        normal[:, ::5] = 0
        normal[-1, ::5] = -1
        slip *= np.logspace(0, -19, points, dtype=host.real) / np.linalg.norm(slip, axis=0)
        slip[0, ::10] = -0.0
        slip += normal * np.where(np.arange(points) % 3 == 0, 1, 2).astype(host.real)
        driver = usersub.ExplicitDriver(law(c_routine, "vfric_coef", precision), host.scene())
        return run(driver, bindable(driver, host)).force.tobytes()

    assert forces(0) == forces(1)


@given(seed=st.integers(0, 2**32 - 1), points=st.integers(1, 12), data=st.data())
@settings(max_examples=25)
def test_random_geometry(c_routine, seed, points, data):
    interface, dimension, contact = data.draw(st.sampled_from(PLACES))
    block = data.draw(st.integers(0, points + 1))
    host = ee.Host(interface, points, dimension, contact, block=block, seed=seed)
    driver = usersub.ExplicitDriver(law(c_routine, interface), host.scene())
    force = run(driver, bindable(driver, host)).force
    _, t1, _, n = host.axes()
    size = np.linalg.norm(force, axis=0)
    # The sum of three products in this line rounds like the projection itself: a few units.
    assert np.all(np.abs((force * n).sum(axis=0)) <= 4e-15 * size)
    if interface == "vfric_coef":  # against the slip, bounded by the stick force
        assert np.all((force * host.arrays["slip_increment"]).sum(axis=0) <= 0)
        assert np.all(size <= host.arrays["stick_force"] * (1 + 1e-15))


SIZES = {
    "double": [5e-324, 1e-320, 1e-308, 1e-200, 1e-30, 1.0, 1e30, 1e153, 1e155, 1e300],
    "single": [1e-45, 1e-40, 1e-38, 1e-30, 1e-10, 1.0, 1e10, 1e18, 1e20, 1e37],
}


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("interface", ["vfric", "vfric_coef"])
def test_slips_of_any_size(probe, interface, dimension, precision):
    """Lengths and directions are right from denormal slips to the largest; a denormal slip in the
    plane of its normal has a few digits only, so it lies along an axis."""
    sizes = SIZES[precision]
    host = ee.Host(interface, len(sizes), dimension, precision=precision)
    real, epsilon = host.real, np.finfo(host.real).eps
    slip = np.zeros((dimension, len(sizes)), real, order="F")
    slip[0] = sizes
    slip[-1] = np.array(sizes) * 2  # along the normal: no slip
    normal = np.zeros_like(slip)
    normal[-1] = 1
    host.arrays |= {"slip_increment": slip, "normal": normal}
    seen = probe("full", interface, precision=precision)
    scene = host.scene()
    driver = usersub.ExplicitDriver(seen.routine, scene)
    # So that the slip rate of the largest slip is a number.
    driver.step(1.0, **bindable(driver, host))
    (call,) = seen.checked_calls()
    if interface == "vfric":
        np.testing.assert_allclose(call["dSlipFric"][0], slip[0], rtol=4 * epsilon)
        assert not call["dSlipFric"][1:].any()
        np.testing.assert_allclose(call["dirCosSl"][0], 1, rtol=4 * epsilon)
    else:
        np.testing.assert_allclose(call["slipRate"], slip[0], rtol=4 * epsilon)


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("dimension", [2, 3])
def test_no_slip(probe, dimension, precision):
    """Without slip, or along the normal only, t1 is orthogonal to n and depends on n alone."""
    host = ee.Host("vfric", 9, dimension, precision=precision)
    normal = host.arrays["normal"]
    made = probe("full", "vfric", precision=precision)
    driver = usersub.ExplicitDriver(made.routine, host.scene())
    arrays = bindable(driver, host)
    directions = []
    for factor in (0.0, -0.0, 3.0, 1e-30):
        arrays["slip_increment"][...] = normal * host.real(factor)
        run(driver, arrays)
        call = made.checked_calls()[-1]
        assert not call["dSlipFric"].any()
        directions.append(call["dirCosSl"])
    epsilon = np.finfo(host.real).eps
    assert np.abs((directions[0] * normal).sum(axis=0)).max() < 4 * epsilon
    np.testing.assert_allclose(np.linalg.norm(directions[0], axis=0), 1, rtol=4 * epsilon)
    for other in directions[1:]:
        np.testing.assert_array_equal(other, directions[0])
    if dimension == 2:
        np.testing.assert_array_equal(directions[0], [normal[1], -normal[0]])
