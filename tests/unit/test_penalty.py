# SPDX-License-Identifier: MIT
"""Penalty enforcement against an independent return mapping in sixty digits."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import pytest
from enforcement_model import (
    BASE,
    CODE,
    WEIGHTS,
    Case,
    Law,
    check_state,
    check_tangent,
    close,
    mpf,
    return_mapping,
    update,
)
from hypothesis import assume, given, settings
from hypothesis import strategies as st


@pytest.mark.parametrize("rational", [False, True], ids=["exponential", "rational"])
@pytest.mark.parametrize("limit", [0.0, 2.5], ids=["coulomb", "limit"])
@pytest.mark.parametrize("factor", [0.2, 1.0], ids=["stick", "slip"])
@pytest.mark.parametrize("anisotropic", [False, True], ids=["isotropic", "anisotropic"])
@pytest.mark.parametrize("directions", [1, 2])
def test_every_entry(enforcement, directions, anisotropic, factor, limit, rational):
    case = replace(
        BASE,
        law=replace(BASE.law, rational=rational),
        slip_increment=tuple(factor * x for x in BASE.slip_increment),
        limit=limit,
        anisotropic=anisotropic,
        directions=directions,
        calls=[],
    )
    status, output = update(enforcement, case)
    assert status == CODE["OK"]
    assert bool(output.sticks) == (factor == 0.2)
    check_state(case, output)
    check_tangent(case, output)
    if directions == 1:
        assert output.tau[1] == output.plastic[1] == output.by_gamma[0][1] == 0
    if not (anisotropic and directions == 2):
        assert len(case.calls) == 1


def test_unsymmetric_where_the_law_is(enforcement):
    _, output = update(enforcement, replace(BASE, anisotropic=True))
    assert abs(output.by_gamma[0][1] - output.by_gamma[1][0]) > 1e-2


signed = st.integers(-1000, 1000).map(lambda i: i / 1000)


@settings(max_examples=40)
@given(
    levels=st.tuples(st.floats(0.05, 1.5), st.floats(0.05, 1.5)),
    weights=st.tuples(*[st.tuples(*[st.integers(-40, 40).map(lambda i: i / 1000)] * 8)] * 2),
    vectors=st.tuples(*[st.tuples(signed, signed)] * 3),
    critical=st.floats(0.05, 1.9),
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


def test_sticks_on_the_limit(enforcement):
    """|g| = c sticks to rounding, with the tangent of sticking; what is clearly beyond slips."""
    case = replace(BASE, elastic_slip=(0.0, 0.0), slip_increment=(3.0, 4.0), critical=5.0, calls=[])
    status, output = update(enforcement, case)
    assert status == CODE["OK"] and output.sticks == 1
    check_state(case, output)
    check_tangent(case, output)
    _, output = update(enforcement, replace(case, critical=math.nextafter(5.0, 0), calls=[]))
    assert output.sticks == 1
    case = replace(case, critical=5.0 * (1 - 1e-14), calls=[])
    _, output = update(enforcement, case)
    assert output.sticks == 0
    assert output.equivalent == pytest.approx(5.0 - case.critical, rel=1e-9)


@pytest.mark.parametrize("anisotropic", [False, True])
def test_pressure_of_zero_or_less(enforcement, anisotropic):
    """No stress. From above, and so at zero, the derivative by the pressure is a mu n."""
    for pressure in (0.0, -0.0, -3.0):
        case = replace(BASE, pressure=pressure, anisotropic=anisotropic, calls=[])
        status, output = update(enforcement, case)
        assert status == CODE["OK"]
        assert [*output.tau, output.sed, output.sfd] == [0, 0, 0, 0]
        assert all(x == 0 for row in output.by_gamma for x in row)
        assert list(output.by_temperature) == [0, 0]
        check_state(case, output)
        small = return_mapping(case, pressure=mpf(10) ** -30 - mpf(pressure))[0]
        for i in range(2):
            expected = small[i] * mpf(10) ** 30 if pressure == 0 else 0
            close(output.by_pressure[i], expected, 1e-12, 0)


@pytest.mark.parametrize("anisotropic", [False, True])
def test_no_time_no_rate(enforcement, anisotropic):
    case = replace(BASE, time_increment=0.0, anisotropic=anisotropic, calls=[])
    status, output = update(enforcement, case)
    assert status == CODE["OK"]
    assert all(data[:3] == [0, 0, 0] for data in case.calls)
    check_state(case, output)
    check_tangent(case, output)


def test_tiny_time_increment_gives_a_finite_rate(enforcement):
    case = replace(BASE, time_increment=5e-324, law=Law((0.3, 0.4)), calls=[])
    status, output = update(enforcement, case)
    assert status == CODE["OK"] and case.calls[-1][0] == 1.7976931348623157e308
    assert case.calls[-1][2] == -1.7976931348623157e308
    check_state(case, output)
    check_tangent(case, output)


@pytest.mark.parametrize("anisotropic", [False, True])
@pytest.mark.parametrize("factor", [0.2, 1.0], ids=["stick", "slip"])
def test_huge_and_tiny_values(enforcement, anisotropic, factor):
    """Lengths and stresses may have any size as long as the answer is a number."""
    law = Law((0.31, 0.47))
    for length, pressure in itertools.product((1e-306, 1e-160, 1e160, 1e300), (1e-300, 1.0, 1e300)):
        case = replace(
            BASE,
            law=law,
            critical=BASE.critical * length,
            elastic_slip=tuple(x * length for x in BASE.elastic_slip),
            slip_increment=tuple(factor * x * length for x in BASE.slip_increment),
            slip=(0.0, 0.0),
            equivalent_slip=0.0,
            pressure=pressure,
            anisotropic=anisotropic,
            calls=[],
        )
        status, output = update(enforcement, case, tangent=False)
        assert status == CODE["OK"]
        tau, elastic, plastic, stick = return_mapping(case)
        assert bool(output.sticks) == stick
        for i in range(2):
            close(output.tau[i], tau[i], 1e-14, 0)
            close(output.elastic_slip[i], elastic[i], 1e-14, 0)
            close(output.plastic[i], plastic[i], 1e-13, 0)
        stiffness = pressure / length
        if 1e-290 < stiffness < 1e290:
            _, output = update(enforcement, case)
            check_tangent(case, output)


def test_elastic_slip_far_below_the_allowable_one(enforcement):
    """A stress of 1e-30: slip 1e-320, allowable slip 1e10, strength 1e300."""
    case = Case(Law((0.5,)), (1e-320,), (0.0,), (0.0,), critical=1e10, pressure=2e300, directions=1)
    status, output = update(enforcement, case)
    assert status == CODE["OK"]
    assert output.tau[0] == pytest.approx(1e300 / 1e10 * 1e-320, rel=1e-12)


@pytest.mark.parametrize("ratio", [1e8, 1e-8])
@pytest.mark.parametrize("factor", [0.2, 1.0], ids=["stick", "slip"])
def test_slender_ellipse(enforcement, ratio, factor):
    law = Law((0.4, 0.4 * ratio) if ratio < 1 else (0.4 / ratio, 0.4), WEIGHTS)
    case = replace(
        BASE,
        law=law,
        slip_increment=tuple(factor * x for x in BASE.slip_increment),
        critical=0.9,
        anisotropic=True,
        calls=[],
    )
    status, output = update(enforcement, case)
    assert status == CODE["OK"]
    check_state(case, output, 1e-12)
    check_tangent(case, output)


def test_slip_is_normal_to_the_ellipse(enforcement):
    case = replace(BASE, law=Law((0.2, 0.7)), anisotropic=True)
    _, output = update(enforcement, case)
    limits = [mu * case.pressure for mu in output.mu]
    assert sum((t / x) ** 2 for t, x in zip(output.tau, limits, strict=True)) == pytest.approx(
        1, rel=1e-14
    )
    normal = [t / x**2 for t, x in zip(output.tau, limits, strict=True)]
    turn = normal[0] * output.plastic[1] - normal[1] * output.plastic[0]
    assert abs(turn) <= 1e-15 * math.hypot(*normal) * math.hypot(*output.plastic)


def test_constant_ratio_asks_twice(enforcement):
    """Coefficients in a constant ratio leave nothing to solve: no third question."""
    case = replace(BASE, law=Law((0.2, 0.7)), anisotropic=True, calls=[])
    update(enforcement, case)
    assert len(case.calls) == 2


def test_answer_belongs_to_the_last_question(enforcement):
    case = replace(BASE, anisotropic=True, calls=[])
    _, output = update(enforcement, case)
    last = case.calls[-1]
    assert last[3] == case.equivalent_slip + output.equivalent
    assert last[4:] == [s + p for s, p in zip(case.slip, output.plastic, strict=True)]


@pytest.mark.parametrize("i", [0, 1])
@pytest.mark.parametrize("limit", [0.0, 2.5])
def test_frictionless_direction(enforcement, i, limit):
    """Its whole motion is slip; the other direction is as alone, with a factor of two."""
    level = 0.6
    levels = tuple(0.0 if k == i else level for k in range(2))
    for factor in (0.2, 1.0):
        increment = tuple(factor * x for x in BASE.slip_increment)
        case = replace(
            BASE, law=Law(levels), anisotropic=True, slip_increment=increment, limit=limit, calls=[]
        )
        status, output = update(enforcement, case)
        j = 1 - i
        g = [a + b for a, b in zip(case.elastic_slip, increment, strict=True)]
        assert status == CODE["OK"] and output.sticks == 0
        assert output.tau[i] == 0 and output.elastic_slip[i] == 0
        assert output.plastic[i] == g[i]
        strength = level / 2 * case.pressure
        strength = min(strength, limit) if limit else strength
        scaled = 2 * g[j]
        tau = 2 * strength * max(-1, min(1, scaled / case.critical))
        assert output.tau[j] == pytest.approx(tau, rel=1e-14)
        slip = 0 if abs(scaled) < case.critical else g[j] * (1 - case.critical / abs(scaled))
        assert output.plastic[j] == pytest.approx(slip, rel=1e-13)
        stiffness = 4 * strength / case.critical if slip == 0 else 0
        assert output.by_gamma[j][j] == pytest.approx(stiffness, rel=1e-13)
        assert output.by_gamma[i][i] == output.by_gamma[i][j] == output.by_gamma[j][i] == 0


def test_no_friction_at_all(enforcement):
    case = replace(BASE, law=Law((0.0, 0.0)), anisotropic=True)
    status, output = update(enforcement, case)
    assert status == CODE["OK"] and list(output.tau) == [0, 0]
    assert all(x == 0 for row in output.by_gamma for x in row)
    assert output.sticks == 0 and output.equivalent > 0


def test_derivatives_are_not_needed_for_the_answer(enforcement):
    case = replace(BASE, anisotropic=True)
    _, output = update(enforcement, case)

    def bare(_context, data, value):
        variables = (data[0], case.pressure, case.temperature, data[1], data[2], *data[3:6])
        value[0].mu[:] = case.law.mu(variables)[0]
        for k in range(2):
            value[0].d_mu[k][:] = [math.nan] * 8
        return 0

    status, other = update(enforcement, case, tangent=False, friction=bare)
    assert status == CODE["OK"]
    assert list(other.tau) == list(output.tau) and list(other.plastic) == list(output.plastic)
    assert all(x == 0 for row in other.by_gamma for x in row)
    assert update(enforcement, case, friction=bare)[0] == CODE["NOT_FINITE"]


def adversary(kind: str, seed: int):
    """Coefficients that no iteration can like; at most 0.9, never negative."""
    count = itertools.count()

    def mu(data):
        if kind == "noise":
            k = next(count) * 7919 + seed
            return (k * 2654435761 % 1000) / 1111, (k * 40503 % 1000) / 1111
        if kind == "jump":
            return (0.6, 0.1) if data[0] < 0.3 + seed / 20 else (0.1, 0.6)
        if kind == "zero and not":
            return (0.0, 0.5) if data[0] < 0.3 + seed / 20 else (0.5, 0.0)
        if kind == "zones":
            return (0.0, 0.5) if 0.2 + seed / 20 < data[0] < 1.0 else (0.5, 0.0)
        if kind == "steep":
            return 0.5 * math.exp(-min(1e9 * data[0], 700.0)), 0.3
        return 0.4 + 0.4 * math.sin(1e6 * data[0] * (1 + seed)), 0.3

    return mu


@pytest.mark.parametrize("kind", ["noise", "jump", "zero and not", "zones", "steep", "chaos"])
@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e12, 1e290])
def test_always_ends_inside_the_ellipse(enforcement, kind, seed, size):
    mu, calls = adversary(kind, seed), []

    def friction(_context, data, value):
        calls.append(data[0])
        value[0].mu[:] = mu(data)
        for k in range(2):
            value[0].d_mu[k][:] = [0.1 * (k + 1)] * 8
        return 0

    case = replace(
        BASE, anisotropic=True, slip_increment=(1.7 * size, -0.9 * size), time_increment=1.0
    )
    status, output = update(enforcement, case, friction=friction)
    assert status == CODE["OK"]
    assert len(calls) <= 3 * 240
    numbers = [*output.tau, *output.plastic, *output.elastic_slip, output.sed, output.sfd]
    numbers += [x for row in output.by_gamma for x in row]
    assert all(map(math.isfinite, numbers))
    radius = math.hypot(
        *(t / (m * case.pressure) if m else t for t, m in zip(output.tau, output.mu, strict=True))
    )
    assert radius <= 1 + 1e-14
    assert output.sfd >= 0


@pytest.mark.parametrize("size", [1e1, 1e100, 1e290])
def test_jump_in_a_wide_bracket(enforcement, size):
    """The coefficient drops so far at a slip that there is neither stick nor slip: to the place."""
    place, calls = 0.3 * size, []

    def friction(_context, data, value):
        calls.append(data[0])
        value[0].mu[:] = (0.6, 0.1) if data[0] < place else (0.1 / size, 0.5)
        for k in range(2):
            value[0].d_mu[k][:] = [0.0] * 8
        return 0

    case = replace(
        BASE, anisotropic=True, elastic_slip=(0.0, 0.0), slip_increment=(size, 0.0),
        time_increment=1.0,
    )  # fmt: skip
    status, output = update(enforcement, case, friction=friction)
    assert status == CODE["OK"] and len(calls) < 240
    assert output.equivalent == pytest.approx(place, rel=1e-13)
    assert calls[-1] == output.equivalent


def test_window_without_friction(enforcement):
    """Frictionless between two slip rates only, so that at the jump |g~| can be zero in slip."""
    seen = set()
    for i in range(40):
        low = 0.2 + i / 100

        def friction(_context, data, value, low=low):
            value[0].mu[:] = (0.0, 0.5) if low < data[0] < 1.8 else (0.5, 0.0)
            for k in range(2):
                value[0].d_mu[k][:] = [0.1 * (k + 1)] * 8
            return 0

        case = replace(
            BASE, anisotropic=True, elastic_slip=(0.0, 0.0), slip_increment=(2.0, 0.0),
            time_increment=1.0,
        )  # fmt: skip
        status, output = update(enforcement, case, friction=friction)
        assert status == CODE["OK"] and output.equivalent == pytest.approx(low, rel=1e-13)
        numbers = [*output.tau, *(x for row in output.by_gamma for x in row)]
        assert all(map(math.isfinite, numbers))
        assert output.tau[0] == pytest.approx(output.mu[0] * case.pressure, rel=1e-14)
        seen.add(output.mu[0])
    assert seen == {0.0, 0.5}


def test_zero_only_while_it_sticks(enforcement):
    """A direction that is frictionless at rest but not in motion keeps its elastic slip."""
    calls = []

    def friction(_context, data, value):
        calls.append(list(data[:6]))
        value[0].mu[:] = (0.0 if data[1] == 0 else 0.4, 0.3)
        for k in range(2):
            value[0].d_mu[k][:] = [0.0] * 8
        return 0

    case = replace(BASE, anisotropic=True, elastic_slip=(0.0, 0.0), slip_increment=(0.5, 0.1))
    status, output = update(enforcement, case, friction=friction)
    assert status == CODE["OK"] and output.sticks == 1
    assert list(output.elastic_slip) == [0.5, 0.1] and output.tau[0] == 0
    assert calls[-1][0] == 0 and list(output.mu) == [0.0, 0.3]


def test_steep_law_is_solved_to_rounding(enforcement):
    """mu1 falls to nothing within a small part of the slip: fixed-point steps never converge."""
    law = Law((0.5, 0.3), ((2e3,) + (0.0,) * 7, (0.0,) * 8))
    case = replace(BASE, law=law, anisotropic=True, slip_increment=(0.9, -0.3), calls=[])
    status, output = update(enforcement, case)
    assert status == CODE["OK"] and output.sticks == 0 and len(case.calls) < 60
    a = [m / (sum(output.mu) / 2) for m in output.mu]
    g = [x + y for x, y in zip(case.elastic_slip, case.slip_increment, strict=True)]
    scaled = math.hypot(a[0] * g[0], a[1] * g[1])
    assert scaled == pytest.approx(case.critical / (1 - output.plastic[0] / g[0]), rel=1e-11)


@settings(max_examples=25)
@given(
    motions=st.lists(st.tuples(st.floats(-2, 2), st.floats(-2, 2)), min_size=1, max_size=12),
    anisotropic=st.booleans(),
)
def test_energy_along_a_path(enforcement, motions, anisotropic):
    """With constant strength: change of SED + SFD = tau . dg - d . K d / 2, term by term."""
    state, sed = ((0.0, 0.0), (0.0, 0.0), 0.0), 0.0
    mean = 0.39 if anisotropic else 0.31
    factors = [0.31 / mean, 0.47 / mean] if anisotropic else [1.0, 1.0]
    for motion in motions:
        case = replace(
            BASE, law=Law((0.31, 0.47)), elastic_slip=state[0], slip=state[1],
            equivalent_slip=state[2], slip_increment=motion, anisotropic=anisotropic,
        )  # fmt: skip
        status, output = update(enforcement, case)
        assert status == CODE["OK"] and output.sfd >= 0
        stiffness = [mean * case.pressure / case.critical * a**2 for a in factors]
        work = sum(t * m for t, m in zip(output.tau, motion, strict=True))
        change = [e - s for e, s in zip(output.elastic_slip, state[0], strict=True)]
        defect = sum(k * d * d / 2 for k, d in zip(stiffness, change, strict=True))
        left = output.sed - sed + output.sfd
        assert left == pytest.approx(work - defect, abs=1e-12 * (1 + abs(work) + defect))
        slip = tuple(s + p for s, p in zip(case.slip, output.plastic, strict=True))
        state = (tuple(output.elastic_slip), slip, state[2] + output.equivalent)
        sed = output.sed


@pytest.mark.parametrize(
    ("change", "status"),
    [
        ({"directions": 3}, "BAD_ARGUMENT"),
        ({"directions": 0}, "BAD_ARGUMENT"),
        ({"time_increment": -1.0}, "BAD_ARGUMENT"),
        ({"time_increment": math.nan}, "BAD_ARGUMENT"),
        ({"critical": 0.0}, "BAD_ARGUMENT"),
        ({"critical": math.inf}, "BAD_ARGUMENT"),
        ({"limit": -1.0}, "BAD_ARGUMENT"),
        ({"limit": math.nan}, "BAD_ARGUMENT"),
        ({"pressure": math.nan}, "BAD_INPUT"),
        ({"pressure": math.inf}, "BAD_INPUT"),
        ({"slip_increment": (math.nan, 0.0)}, "BAD_INPUT"),
        ({"elastic_slip": (0.0, math.inf)}, "BAD_INPUT"),
        ({"slip": (0.0, math.nan)}, "BAD_INPUT"),
        ({"equivalent_slip": math.nan}, "BAD_INPUT"),
        ({"elastic_slip": (1.7e308, 0.0), "slip_increment": (1.7e308, 0.0)}, "BAD_INPUT"),
        ({"slip_increment": (1.7e308, 1.7e308)}, "BAD_INPUT"),
        ({"law": Law((math.nan, 0.3))}, "NOT_FINITE"),
        ({"law": Law((-0.1, 0.3))}, "CONTRACT"),
        ({"law": Law((1e200, 1e200)), "pressure": 1e200}, "NOT_FINITE"),
    ],
)
@pytest.mark.parametrize("anisotropic", [False, True])
def test_refused(enforcement, change, status, anisotropic):
    case = replace(BASE, anisotropic=anisotropic, law=Law((0.3, 0.4)), **change) if (
        "law" not in change
    ) else replace(BASE, anisotropic=anisotropic, **change)  # fmt: skip
    assert update(enforcement, case)[0] == CODE[status]


def test_overflow_above_a_limit_is_the_limit(enforcement):
    case = replace(BASE, law=Law((1e200,)), pressure=1e200, limit=2.0)
    status, output = update(enforcement, case, tangent=False)
    assert status == CODE["OK"]
    assert math.hypot(*output.tau) == pytest.approx(2.0, rel=1e-15)


def test_status_of_the_routine_comes_through(enforcement):
    status, _ = update(enforcement, BASE, friction=lambda *_: CODE["ROUTINE_RAISED"])
    assert status == CODE["ROUTINE_RAISED"]
