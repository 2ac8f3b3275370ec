# SPDX-License-Identifier: MIT
"""Softened tangential behaviour: a constant slope in stick, bounded by the strength."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from enforcement_model import BASE, CODE, Case, Law, check_state, check_tangent, update
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import usersub
from usersub.errors import SceneError

SLOPE = 9.0
SOFT = replace(BASE, slope=SLOPE, critical=0.0)


@pytest.mark.parametrize("rational", [False, True], ids=["exponential", "rational"])
@pytest.mark.parametrize("limit", [0.0, 2.5], ids=["coulomb", "limit"])
@pytest.mark.parametrize("factor", [0.05, 1.0], ids=["stick", "slip"])
@pytest.mark.parametrize("anisotropic", [False, True], ids=["isotropic", "anisotropic"])
@pytest.mark.parametrize("directions", [1, 2])
def test_every_entry(enforcement, directions, anisotropic, factor, limit, rational):
    case = replace(
        SOFT, law=replace(SOFT.law, rational=rational), limit=limit, anisotropic=anisotropic,
        directions=directions, slip_increment=tuple(factor * x for x in SOFT.slip_increment),
        elastic_slip=tuple(0.5 * x for x in SOFT.elastic_slip), calls=[],
    )  # fmt: skip
    status, output = update(enforcement, case)
    assert status == CODE["OK"]
    assert bool(output.sticks) == (factor == 0.05)
    check_state(case, output)
    check_tangent(case, output)


def test_stick_has_the_slope_whatever_the_pressure(enforcement):
    for pressure in (30.0, 3e3, 3e30):
        case = replace(SOFT, law=Law((0.3,)), slip_increment=(0.1, -0.2), pressure=pressure)
        _, output = update(enforcement, case)
        assert output.sticks == 1
        assert list(output.tau) == pytest.approx([SLOPE * 0.31, SLOPE * -0.07], rel=1e-14)
        assert [list(row) for row in output.by_gamma] == [[SLOPE, 0], [0, SLOPE]]
        assert list(output.by_pressure) == [0, 0]


@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("distance", [1e-3, 1e-7, 1e-11])
@pytest.mark.parametrize("slope", [0.0, SLOPE], ids=["penalty", "softened"])
@pytest.mark.parametrize("anisotropic", [False, True], ids=["isotropic", "anisotropic"])
def test_near_the_corner(enforcement, anisotropic, slope, distance, side):
    """Just inside and just outside of the allowable elastic slip."""
    law = Law((0.31, 0.47), tuple((w[0], *[0.0] * 7) for w in BASE.law.weights))
    a = (0.31 / 0.39, 0.47 / 0.39) if anisotropic else (1.0, 1.0)
    mean = 0.39 if anisotropic else 0.31
    critical = mean * 37.0 / slope if slope else 0.67
    g = [critical * (1 + side * distance) * x for x in (0.6, -0.8)]
    case = replace(
        BASE, law=law, slope=slope, critical=0.67, anisotropic=anisotropic, elastic_slip=(0.0, 0.0),
        slip_increment=tuple(x / y for x, y in zip(g, a, strict=True)), calls=[],
    )  # fmt: skip
    status, output = update(enforcement, case)
    assert status == CODE["OK"] and bool(output.sticks) == (side < 0)
    check_state(case, output)
    check_tangent(case, output)


@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("slope", [0.0, SLOPE], ids=["penalty", "softened"])
@pytest.mark.parametrize("factor", [0.05, 1.0], ids=["stick", "slip"])
@pytest.mark.parametrize("anisotropic", [False, True], ids=["isotropic", "anisotropic"])
def test_near_the_cap(enforcement, anisotropic, factor, slope, side):
    """The strength just below and just above the shear limit."""
    plain = replace(
        BASE, slope=slope, anisotropic=anisotropic, calls=[],
        slip_increment=tuple(factor * x for x in BASE.slip_increment),
        elastic_slip=tuple(factor * x for x in BASE.elastic_slip),
    )  # fmt: skip
    _, output = update(enforcement, plain)
    mean = sum(output.mu) / 2
    case = replace(plain, limit=mean * plain.pressure * (1 + side * 1e-8), calls=[])
    status, output = update(enforcement, case)
    assert status == CODE["OK"]
    check_state(case, output)
    check_tangent(case, output)


signed = st.integers(-1000, 1000).map(lambda i: i / 1000)


@settings(max_examples=40)
@given(
    levels=st.tuples(st.floats(0.05, 1.5), st.floats(0.05, 1.5)),
    weights=st.tuples(*[st.tuples(*[st.integers(-40, 40).map(lambda i: i / 1000)] * 8)] * 2),
    vectors=st.tuples(*[st.tuples(signed, signed)] * 3),
    slope=st.floats(0.2, 9.0),
    pressure=st.floats(0.01, 9.0),
    limit=st.sampled_from([0.0, 0.2]),
    time_increment=st.floats(0.3, 5.0),
    anisotropic=st.booleans(),
    directions=st.sampled_from([1, 2]),
)
def test_any_case(enforcement, vectors, levels, weights, **settings):
    case = Case(
        law=Law(levels, weights), elastic_slip=vectors[0], slip=vectors[1],
        slip_increment=vectors[2], equivalent_slip=2.0, temperature=3.0, **settings,
    )  # fmt: skip
    g = [a + b for a, b in zip(vectors[0], vectors[2], strict=True)]
    assume(max(map(abs, g)) > 1e-3)
    status, output = update(enforcement, case)
    assert status == CODE["OK"]
    check_state(case, output, 1e-12)
    check_tangent(case, output)


@pytest.mark.parametrize("anisotropic", [False, True])
def test_no_strength(enforcement, anisotropic):
    """No stress and no stiffness; from above, and so at zero, the derivative by p is a mu n."""
    case = replace(SOFT, pressure=0.0, anisotropic=anisotropic)
    status, output = update(enforcement, case)
    assert status == CODE["OK"] and list(output.tau) == [0, 0]
    assert all(x == 0 for row in output.by_gamma for x in row)
    scale = math.hypot(*output.by_pressure)
    assert min(output.mu) * 0.9 <= scale <= max(output.mu) * 1.1
    for pressure in (0.0, -1.0):
        case = replace(case, pressure=pressure, slip_increment=(0.0, 0.0), elastic_slip=(0.0, 0.0))
        status, output = update(enforcement, case)
        assert status == CODE["OK"] and list(output.tau) == list(output.by_pressure) == [0, 0]
        assert all(x == 0 for row in output.by_gamma for x in row)


def test_steep_law_is_solved_to_rounding(enforcement):
    """The coefficient falls to nothing within a small part of the slip: to the place where it has
    fallen as far as the slip goes, |g| = plastic + mu(plastic) p / slope."""
    law = Law((0.5,), ((2e3,) + (0.0,) * 7,))
    case = replace(SOFT, law=law, slip_increment=(2.9, -0.3), calls=[])
    status, output = update(enforcement, case)
    assert status == CODE["OK"] and output.sticks == 0 and len(case.calls) < 60
    g = math.hypot(*(x + y for x, y in zip(case.elastic_slip, case.slip_increment, strict=True)))
    assert output.equivalent + output.mu[0] * case.pressure / SLOPE == pytest.approx(g, rel=1e-13)


def test_huge_and_tiny_slopes(enforcement):
    for slope, length in itertools.product((1e-90, 1.0, 1e20), (1e-20, 1.0, 1e20)):
        case = replace(
            SOFT, law=Law((0.31, 0.47)), slope=slope, anisotropic=True, elastic_slip=(0.0, 0.0),
            slip_increment=(1.7 * length, -0.9 * length), slip=(0.0, 0.0), equivalent_slip=0.0,
        )  # fmt: skip
        status, output = update(enforcement, case, tangent=False)
        assert status == CODE["OK"]
        check_state(case, output)


@settings(max_examples=25)
@given(
    motions=st.lists(
        st.tuples(st.floats(-2, 2), st.floats(-2, 2), st.floats(0.5, 90)), min_size=1, max_size=12
    )
)
def test_energy_along_a_path(enforcement, motions):
    """The stiffness is constant: change of SED + SFD = tau . dg - slope d^2 / 2 at any pressure."""
    state, sed = ((0.0, 0.0), (0.0, 0.0), 0.0), 0.0
    for *motion, pressure in motions:
        case = replace(
            SOFT, law=Law((0.31,)), elastic_slip=state[0], slip=state[1], pressure=pressure,
            equivalent_slip=state[2], slip_increment=tuple(motion),
        )  # fmt: skip
        status, output = update(enforcement, case)
        assert status == CODE["OK"] and output.sfd >= 0
        work = sum(t * m for t, m in zip(output.tau, motion, strict=True))
        change = [e - s for e, s in zip(output.elastic_slip, state[0], strict=True)]
        defect = sum(SLOPE * d * d / 2 for d in change)
        left = output.sed - sed + output.sfd
        assert left == pytest.approx(work - defect, abs=1e-12 * (1 + abs(work) + defect))
        slip = tuple(s + p for s, p in zip(case.slip, output.plastic, strict=True))
        state = (tuple(output.elastic_slip), slip, state[2] + output.equivalent)
        sed = output.sed


# Through the driver.


@usersub.fric_coef
def coulomb(fCoef, props):
    fCoef[0, 0] = props[0]


def run(slips, pressure=10.0, **settings):
    """Stresses along a path of one direction."""
    driver = usersub.StandardDriver(coulomb, usersub.Scene(dimension=2, **settings))
    stresses = []
    for slip in slips:
        driver.begin_increment(0.1)
        found = driver.iterate(
            slip_increment=np.array([[slip]], order="F"), pressure=np.array([pressure])
        )
        stresses.append(found.tau[0, 0])
        driver.commit()
    return driver, stresses


def test_out_and_back():
    """Slope 50, strength 3: sticks for 0.06, slips, and unloads with the slope."""
    driver, stresses = run([0.04, 0.04, 0.04, -0.04, -0.1], props=[0.3], stick_slope=50.0)
    assert stresses == pytest.approx([2.0, 3.0, 3.0, 1.0, -3.0], rel=1e-14)
    # 0.02 beyond the 0.06 of stick, 0.04, then 0.1 back of which 0.08 are elastic
    assert driver.state["slip"][0, 0] == pytest.approx(0.02 + 0.04 - 0.02, rel=1e-13)
    assert driver.state["elastic_slip"][0, 0] == pytest.approx(-0.06, rel=1e-14)


def test_rough_is_all_elastic():
    """With a coefficient that is never reached all motion is elastic and comes back."""
    driver, stresses = run([1.0, 2.5, -3.5], props=[1e12], stick_slope=50.0)
    assert stresses == pytest.approx([50.0, 175.0, 0.0], abs=1e-12)
    assert driver.state["slip"][0, 0] == 0


def test_no_need_of_an_elastic_slip():
    with pytest.raises(SceneError, match="'elastic_slip'.*'characteristic_length'.*'stick_slope'"):
        usersub.StandardDriver(coulomb, usersub.Scene(dimension=2, props=[0.3]))
    plan = run([0.1], props=[0.3], stick_slope=1.0)[0].plan.explain()
    assert "enforced with a stick slope" in plan


def test_refused_with_multipliers():
    scene = usersub.Scene(dimension=2, props=[0.3], stick_slope=1.0, enforcement="lagrange")
    with pytest.raises(SceneError, match="'stick_slope' = 1.*allow no elastic slip"):
        usersub.StandardDriver(coulomb, scene)
