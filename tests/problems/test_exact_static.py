# SPDX-License-Identifier: MIT
"""Exact answers of the problems P9 to P12 and P19 against arbitrary precision and quadrature."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import mp, mpf

from usersub import problems
from usersub.problems import linear_host, p9, p10, p11, p12, p19


def test_wedge_and_incline():
    slope, mu, steep = mpf("0.1"), mpf("0.3"), mpf("0.75")
    # Equilibrium along the plane and across it, solved for the force by weight.
    cosine, sine = 1 / mp.sqrt(1 + slope**2), slope / mp.sqrt(1 + slope**2)
    force = mp.findroot(lambda f: f * cosine - sine - mu * (cosine + f * sine), mpf(1))
    assert p9.push() == pytest.approx(float(force), rel=1e-15)
    assert p9.push() == pytest.approx(0.4123711340, rel=1e-10)  # as published
    angle = mp.atan(steep)
    fall = mpf("9.80665") * (mp.sin(angle) - mu * mp.cos(angle))
    assert p9.acceleration() == pytest.approx(float(fall), rel=1e-15)


def test_partial_slip_by_superposition():
    """The stress is that of full slip minus the same on the part that sticks; motion of its centre
    and work over the loop by quadrature."""
    a, mu, normal = mpf("0.8"), mpf("0.35"), mpf(60)
    flexible, q = 4 / mpf(900), mpf("0.875")
    c = a * (1 - q) ** (mpf(1) / 3)
    pressure = 3 * normal / (2 * mp.pi * a**2)

    def stress(r):
        inner = c / a * mp.sqrt(1 - (r / c) ** 2) if r < c else 0
        return mu * pressure * (mp.sqrt(1 - (r / a) ** 2) - inner)

    force = mp.quad(lambda r: 2 * mp.pi * r * stress(r), [0, c, a])
    assert abs(force / (q * mu * normal) - 1) < mpf(10) ** -20
    motion = flexible / (4 * mp.pi) * mp.quad(lambda r: 2 * mp.pi * stress(r), [0, c, a])
    found = p10.exact()
    assert found.stuck == pytest.approx(float(c / a), rel=1e-15)
    assert found.motion == pytest.approx(float(motion), rel=1e-14)

    def backbone(x):
        return 3 * mu * normal * flexible / (16 * a) * (1 - (1 - x) ** (mpf(2) / 3))

    # Masing: both branches of the loop are the first pull, twice as large.
    under = mp.quad(backbone, [0, q / 2, q]) * mu * normal
    loop = 4 * q * mu * normal * backbone(q) - 8 * under
    assert found.loop == pytest.approx(float(loop), rel=1e-13)


def test_motion_under_a_ring():
    """Uniform stress on a circle, by integrating the kernel over it."""
    kernel = 4 / mpf(900) / (4 * mp.pi)
    for r, b in ((0.0, 0.3), (0.1, 0.3), (0.29, 0.3), (0.5, 0.3)):

        def along(angle, r=r, b=b):
            """Length of the ray at this angle from the point inside the circle."""
            under = b**2 - (r * mp.sin(angle)) ** 2
            if under <= 0:
                return mpf(0)
            far, near = r * mp.cos(angle) + mp.sqrt(under), r * mp.cos(angle) - mp.sqrt(under)
            return max(far, 0) - max(near, 0)

        edge = mp.asin(b / mpf(r)) if r > b else mp.pi
        truth = 2 * kernel * mp.quad(along, [0, edge / 2, edge])
        found = p10._circle(np.array([r]), np.array([b]))[0]
        assert found == pytest.approx(float(truth), rel=1e-13)


@pytest.mark.parametrize("allowable", [0.0, 1e-4, 3e-3])
def test_bar_with_and_without_elastic_slip(allowable):
    """The bar as a boundary value problem: slipping part, then exponential decay of the motion."""
    stiff, limit, force = mpf(350), mpf("1.6"), mpf("1.6") * mpf("2.5") * 2 / 3
    found = p11.exact(allowable)

    def motion(f):
        if allowable == 0:
            return f**2 / (2 * stiff * limit)
        beta = mp.sqrt(limit / (stiff * mpf(allowable)))
        if f < limit / beta:
            return f / (stiff * beta)
        length = f / limit - 1 / beta  # force at its end: q/beta
        inside = mp.quad(lambda s: (limit / beta + limit * s) / stiff, [0, length])
        return mpf(allowable) + inside

    assert found.pulled == pytest.approx(float(motion(force)), rel=1e-14)
    released = motion(force) - 2 * motion(force / 2)
    assert found.released == pytest.approx(float(released), rel=1e-13)
    start = mp.sqrt(stiff * limit * mpf(allowable))
    under = mp.quad(motion, [0, start, force] if allowable else [0, force])
    loop = 4 * force * motion(force) - 8 * under
    assert found.loop == pytest.approx(float(loop), rel=1e-12)


def test_belt_and_its_polygon():
    mu, wrap = mpf("0.3"), 5 * mp.pi / 4
    assert p12.exact() == pytest.approx(float(mp.exp(mu * wrap)), rel=1e-15)
    ratio = mpf(1)
    for _ in range(7):  # force triangle of each corner
        half = wrap / 14
        ratio *= (mp.cos(half) + mu * mp.sin(half)) / (mp.cos(half) - mu * mp.sin(half))
    assert p12.of_polygon(7) == pytest.approx(float(ratio), rel=1e-14)


@pytest.mark.parametrize(
    ("law", "published"), [("orthotropic", (0.4897616939, 0.5885475623)), ("anisotropic", None)]
)
def test_oblique_slide_by_integrating_the_motion(law, published):
    """Taylor series of the equations of motion, of order 20, instead of the closed form."""
    mu = (mpf("0.1"), mpf("0.4"))

    def slowing(_, v):
        if law == "orthotropic":
            size = mp.sqrt(v[0] ** 2 + v[1] ** 2)
            return [-mpf("9.81") * m * w / size for m, w in zip(mu, v, strict=True)]
        size = mp.sqrt((mu[0] * v[0]) ** 2 + (mu[1] * v[1]) ** 2)
        return [-mpf("9.81") * m * m * w / size for m, w in zip(mu, v, strict=True)]

    start = np.array([1.0])
    angle = p19.Exact(law).angle(start)
    speed = p19.Exact(law).speed(angle, start)
    with mp.workdps(20):
        v = mp.odefun(slowing, 0, [mp.cos(1), mp.sin(1)])(mpf("0.2"))
        truth = mp.sqrt(v[0] ** 2 + v[1] ** 2), mp.atan2(v[1], v[0])
    assert speed[0] == pytest.approx(float(truth[0]), rel=1e-13)
    assert angle[0] == pytest.approx(float(truth[1]), rel=1e-13)
    if published:
        assert (speed[0], angle[0]) == pytest.approx(published, rel=2e-10)


@pytest.mark.parametrize("method", ["penalty", "lagrange"])
def test_belt_reaches_its_own_polygon(method):
    for points in (4, 17, 40):
        outcome = problems.run(
            "P12", interface="fric_coef", language="c", method=method, points=points
        )
        # Differences of the motions make the tensions: some digits are lost.
        assert outcome.details["polygon"] < 1e-11


@pytest.mark.parametrize(("interface", "method"), [("fric", "penalty"), ("fric_coef", "lagrange")])
@pytest.mark.parametrize("name", ["P10", "P11"])
def test_loops_close_and_stress_keeps_its_direction(name, interface, method):
    outcome = problems.run(name, interface=interface, language="c", method=method)
    assert outcome.details["closed"] < 1e-11
    assert outcome.details.get("across", 0.0) < 1e-14
    assert outcome.details["newton_iterations"] < 7.0


@pytest.mark.parametrize("method", ["limit", "limit lagrange"])
def test_a_body_above_the_limit_slope_is_not_held(method):
    outcome = problems.run("P9", interface="fric_coef", language="c", method=method)
    # The last bits of the slope are those of bisection, and of the stick limit within a rounding.
    assert outcome.details["slope"] <= 8e-16


def test_multipliers_of_the_bar_leave_the_error_that_is_told():
    for points in (8, 20, 64):
        outcome = problems.run(
            "P11", interface="fric_coef", language="c", method="lagrange", points=points
        )
        told = 2.0 / 9.0 / (p11.SHARE * points) ** 2
        rest = math.fmod(p11.SHARE * points, 1.0)
        assert rest == pytest.approx(1 / 3, abs=1e-9) or rest == pytest.approx(2 / 3, abs=1e-9)
        assert outcome.details["pulled"] == pytest.approx(told, rel=1e-6)


def test_nothing_holds_is_said():
    routine = problems.own.routine("coulomb", "fric", "c")
    driver = linear_host.make_driver(routine, [0.3], 1, directions=1, allowable=1e-3)
    one = np.eye(1)
    springs = linear_host.Springs(one, one, 0.0 * one, np.array([10.0]))
    host = linear_host.LinearHost(driver, springs, 1e3)
    host.solve(np.array([2.9]))
    assert host.stuck.all()
    with pytest.raises(linear_host.NoEquilibriumError):
        host.solve(np.array([3.1]))
    # As if never tried.
    host.solve(np.array([-2.9]))
    assert host.stress == pytest.approx([-2.9], rel=1e-14)
