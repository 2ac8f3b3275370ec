# SPDX-License-Identifier: MIT
"""Sticking by Lagrange multipliers: one point of lagrange.c, then hosts with real multipliers."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import mpmath
import pytest
from enforcement_model import (
    BASE,
    CODE,
    Law,
    check_tangent,
    close,
    mpf,
    rigid_model,
    update,
)
from hypothesis import given
from hypothesis import strategies as st

CASE = replace(BASE, elastic_slip=(0.0, 0.0))
TWO = [False, True]


def at_rest(case) -> tuple[float, tuple[float, float]]:
    """Mean and ratios of the coefficients without slip, from the law."""
    slip = (case.slip[0], case.slip[1] if case.directions == 2 else 0)
    mu, _ = case.law.mu((0, case.pressure, case.temperature, 0, 0, case.equivalent_slip, *slip))
    if not (case.anisotropic and case.directions == 2):
        return mu[0], (1, 1)
    return sum(mu) / 2, (2 * mu[0] / sum(mu), 2 * mu[1] / sum(mu))


def strength(case) -> float:
    """The critical stress without slip; of scaled stresses if anisotropic."""
    return min(at_rest(case)[0] * case.pressure, case.limit or math.inf)


def ratios(case) -> tuple[float, float]:
    return at_rest(case)[1]


def along(case, size: float, angle: float = 0.7) -> tuple[float, float]:
    """A stress whose scaled size is `size` times the strength."""
    a, whole = ratios(case), size * strength(case)
    if case.directions == 1:
        return whole, 0.0
    return a[0] * whole * math.cos(angle), a[1] * whole * math.sin(angle)


@pytest.mark.parametrize("rational", TWO, ids=["exponential", "rational"])
@pytest.mark.parametrize("limit", [0.0, 2.5], ids=["coulomb", "limit"])
@pytest.mark.parametrize("anisotropic", TWO, ids=["isotropic", "anisotropic"])
@pytest.mark.parametrize("directions", [1, 2])
def test_slip(enforcement, directions, anisotropic, limit, rational):
    """Stress, slip and every derivative; the stress of the last iteration goes with the slip."""
    case = replace(
        CASE, law=replace(CASE.law, rational=rational), limit=limit, anisotropic=anisotropic,
        directions=directions, calls=[],
    )  # fmt: skip
    status, output = update(enforcement, case, lagrange=(False, (0.3, 0.1)))
    assert status == CODE["OK"] and output.sticks == 0 and len(case.calls) == 1
    expected = rigid_model(case)
    for i in range(directions):
        close(output.tau[i], expected[i], 1e-14, 0)
        assert output.plastic[i] == case.slip_increment[i] and output.elastic_slip[i] == 0
    slip = case.slip_increment[:directions]
    assert output.sed == 0
    assert output.sfd == pytest.approx(sum(output.tau[i] * x for i, x in enumerate(slip)))
    assert output.equivalent == pytest.approx(math.hypot(*slip), rel=1e-15)
    check_tangent(case, output, model=lambda **step: rigid_model(case, **step))


@pytest.mark.parametrize("limit", [0.0, 2.5], ids=["coulomb", "limit"])
@pytest.mark.parametrize("anisotropic", TWO, ids=["isotropic", "anisotropic"])
@pytest.mark.parametrize("directions", [1, 2])
@pytest.mark.parametrize("stuck", TWO)
def test_no_slip_yet(enforcement, stuck, directions, anisotropic, limit):
    """The stress keeps its direction and gets the size of the strength, with its derivatives."""
    case = replace(
        CASE, limit=limit, anisotropic=anisotropic, directions=directions,
        slip_increment=(0.0, 0.0), calls=[],
    )  # fmt: skip
    stress = along(case, 1.3)
    bare = replace(case, critical=0.0)
    status, output = update(enforcement, bare, lagrange=(stuck, stress))
    assert status == CODE["OK"] and output.sticks == 0
    expected = rigid_model(case, stress)
    for i in range(directions):
        close(output.tau[i], expected[i], 1e-14, 0)
    assert list(output.plastic) == [0, 0] and output.sfd == 0
    a = ratios(case)
    n = [mpf(stress[i]) / a[i] ** 2 for i in range(directions)]
    length = mpmath.sqrt(sum(x * x for x in n))

    def held(gamma=(0, 0), **step):
        # The slip to come goes where the stress drives it: the derivative of its length is that of
        # a slip that has just begun.
        begun = [mpf(10) ** -12 * x / length for x in n] if any(gamma) else [0] * directions
        slip = [x + y for x, y in zip(begun, gamma, strict=False)]
        return rigid_model(case, stress, gamma=slip, **step)

    check_tangent(case, output, model=held)
    depends = any(x != 0 for row in output.by_gamma for x in row)
    assert depends == (limit == 0 or (anisotropic and directions == 2))


@pytest.mark.parametrize("anisotropic", TWO, ids=["isotropic", "anisotropic"])
@pytest.mark.parametrize("directions", [1, 2])
def test_first_slip_is_kept_to_its_direction(enforcement, directions, anisotropic):
    """With a reference size the tangent is that of a slip of this size where the stress drives it,
    which leaves the stress as it is."""
    case = replace(
        CASE, law=Law((0.31, 0.47)), anisotropic=anisotropic, directions=directions, critical=1e-4,
        slip_increment=(0.0, 0.0),
    )  # fmt: skip
    stress = along(case, 1.3)
    _, output = update(enforcement, case, lagrange=(True, stress))
    n = [stress[i] / ratios(case)[i] ** 2 for i in range(directions)]
    length = math.hypot(*n)
    slip = tuple(1e-4 * x / length for x in n) + (0.0,)
    _, begun = update(enforcement, replace(case, slip_increment=slip[:2]), lagrange=(False, stress))
    assert list(begun.tau) == pytest.approx(list(output.tau), rel=1e-14)
    size = strength(case) / 1e-4
    for row, other in zip(begun.by_gamma, output.by_gamma, strict=True):
        assert list(row) == pytest.approx(list(other), rel=1e-12, abs=1e-13 * size)
    assert (directions == 2) == any(x != 0 for row in output.by_gamma for x in row)


@pytest.mark.parametrize("anisotropic", TWO, ids=["isotropic", "anisotropic"])
@pytest.mark.parametrize("directions", [1, 2])
def test_decisions(enforcement, directions, anisotropic):
    case = replace(CASE, anisotropic=anisotropic, directions=directions)
    still = replace(case, slip_increment=(0.0, 0.0))

    def sticks(case, stuck, stress):
        status, output = update(enforcement, case, lagrange=(stuck, stress))
        assert status == CODE["OK"]
        if output.sticks:
            assert list(output.tau)[:directions] == list(stress)[:directions]
            assert [output.sed, output.sfd, output.equivalent, *output.plastic] == [0] * 5
            assert all(x == 0 for row in output.by_gamma for x in row)
        return bool(output.sticks)

    # A stuck point: by the size of its constraint stress, whatever the slip.
    for angle in (0.1, 2.0, 4.0):
        assert sticks(still, True, along(case, 1 - 1e-12, angle))
        assert sticks(case, True, along(case, 1 - 1e-12, angle))
        assert not sticks(still, True, along(case, 1 + 1e-12, angle))
        assert not sticks(case, True, along(case, 1 + 1e-12, angle))
    assert sticks(still, True, (0.0, 0.0))
    # A slipping point: by the work of its last stress on the slip.
    g = case.slip_increment
    assert not sticks(case, False, (1e-9 * g[0], 0.0))
    assert sticks(case, False, (-1e-9 * g[0], 0.0))
    assert not sticks(case, False, (0.0, 0.0))
    assert sticks(still, False, (0.0, 0.0))
    assert not sticks(still, False, (0.1, 0.2))


@pytest.mark.parametrize("pressure", [0.0, -1.0])
@pytest.mark.parametrize("stuck", TWO)
@pytest.mark.parametrize("moves", TWO)
def test_no_strength_holds_nothing(enforcement, pressure, stuck, moves):
    case = replace(CASE, pressure=pressure, **({} if moves else {"slip_increment": (0.0, 0.0)}))
    for stress in ((0.0, 0.0), (1.0, -2.0), (-1.0, 2.0)):
        status, output = update(enforcement, case, lagrange=(stuck, stress))
        assert status == CODE["OK"] and output.sticks == 0 and list(output.tau) == [0, 0]
        assert list(output.plastic) == list(case.slip_increment)


@pytest.mark.parametrize("i", [0, 1])
def test_frictionless_direction(enforcement, i):
    """What stands against it is nothing: a constraint stress there is beyond holding, but for the
    rounding of a host's solver. The other direction is as alone."""
    levels = tuple(0.0 if k == i else 0.6 for k in range(2))
    case = replace(CASE, law=Law(levels), anisotropic=True, slip_increment=(0.0, 0.0))
    most = 0.6 * case.pressure
    across = [(0.0, True), (1e-12, True), (-1e-12, True), (1e-3, False), (-5.0, False)]
    for (there, held), (part, stick) in itertools.product(across, ((0.9, True), (1.1, False))):
        stress = [there, there]
        stress[1 - i] = part * most
        stick = stick and held
        _, output = update(enforcement, case, lagrange=(True, stress))
        assert bool(output.sticks) == stick
        if not stick:
            assert output.tau[i] == 0 and output.tau[1 - i] == pytest.approx(most, rel=1e-15)
    case = replace(case, slip_increment=(1.7, -0.9))
    _, output = update(enforcement, case, lagrange=(False, (0.0, 0.0)))
    assert output.tau[i] == 0
    assert output.tau[1 - i] == pytest.approx(math.copysign(most, case.slip_increment[1 - i]))


@given(
    size=st.floats(0.0, 3.0), angle=st.floats(0.0, 6.2), anisotropic=st.booleans(),
    stuck=st.booleans(), slip=st.tuples(*[st.floats(-2, 2, allow_subnormal=False)] * 2),
    limit=st.sampled_from([0.0, 2.5]),
)  # fmt: skip
def test_never_above_strength(enforcement, size, angle, anisotropic, stuck, slip, limit):
    """In stick because the constraint stress is checked, in slip by construction. Asking again
    with the answer as last stress changes nothing."""
    case = replace(CASE, law=Law((0.31, 0.47)), anisotropic=anisotropic, limit=limit,
                   slip_increment=slip)  # fmt: skip
    status, output = update(enforcement, case, lagrange=(stuck, along(case, size, angle)))
    assert status == CODE["OK"]
    a, most = ratios(case), strength(case)
    scaled = math.hypot(*(t / x for t, x in zip(output.tau, a, strict=True)))
    if stuck or not output.sticks:
        assert scaled <= most * (1 + 1e-14)
    if not output.sticks:
        assert output.sfd >= 0
        _, again = update(enforcement, case, lagrange=(False, tuple(output.tau)))
        if not (stuck and any(slip)):  # a released point may turn out to slip elsewhere
            assert again.sticks == 0
            assert list(again.tau) == pytest.approx(list(output.tau), rel=1e-14)


def test_huge_and_tiny_values(enforcement):
    for length, pressure in itertools.product((1e-306, 1e-160, 1e160, 1e300), (1e-300, 1.0, 1e300)):
        slip = tuple(x * length for x in CASE.slip_increment)
        case = replace(CASE, law=Law((0.31, 0.47)), slip_increment=slip, pressure=pressure,
                       slip=(0.0, 0.0), equivalent_slip=0.0, anisotropic=True)  # fmt: skip
        status, output = update(enforcement, case, tangent=False, lagrange=(False, (0.0, 0.0)))
        assert status == CODE["OK"]
        for got, expected in zip(output.tau, rigid_model(case), strict=True):
            close(got, expected, 1e-14, 0)


@pytest.mark.parametrize(
    ("change", "stress", "status"),
    [
        ({"directions": 3}, (0.0, 0.0), "BAD_ARGUMENT"),
        ({"time_increment": math.nan}, (0.0, 0.0), "BAD_ARGUMENT"),
        ({"limit": -1.0}, (0.0, 0.0), "BAD_ARGUMENT"),
        ({"pressure": math.inf}, (0.0, 0.0), "BAD_INPUT"),
        ({"slip_increment": (math.nan, 0.0)}, (0.0, 0.0), "BAD_INPUT"),
        ({}, (0.0, math.nan), "BAD_INPUT"),
        ({"law": Law((math.nan, 0.3))}, (0.0, 0.0), "NOT_FINITE"),
        ({"law": Law((-0.1, 0.3))}, (0.0, 0.0), "CONTRACT"),
        ({"law": Law((1e200, 1e200)), "pressure": 1e200}, (0.0, 0.0), "NOT_FINITE"),
    ],
)
@pytest.mark.parametrize("stuck", TWO)
def test_refused(enforcement, change, stress, status, stuck):
    case = replace(CASE, **{"law": Law((0.3, 0.4)), **change})
    assert update(enforcement, case, lagrange=(stuck, stress))[0] == CODE[status]
