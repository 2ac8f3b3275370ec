# SPDX-License-Identifier: MIT
"""Exact answers of the problems against arbitrary precision, and against published numbers."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mp, mpf

from usersub.problems import p1, p2, p4

#: Data of the block as decimal numbers, not as binary ones.
_DENSITY, _PRESSURE, _V0 = mpf("7.3e-4"), mpf(2000), mpf(200)
_MASS, _AREA = _DENSITY * 5, mpf(5)


def _stop(mu):
    """Time and distance by adaptive quadrature over the velocity."""
    a = _PRESSURE * _AREA / _MASS
    time = mp.quad(lambda v: 1 / (a * mu(v)), [0, _V0 / 2, _V0])
    return time, mp.quad(lambda v: v / (a * mu(v)), [0, _V0 / 2, _V0])


def _decay(v):
    return mpf("0.05") + mpf("0.1") * mp.exp(-v / 100)


@pytest.mark.parametrize(
    ("exact", "mu"), [(p1.exact, lambda v: mpf("0.15")), (p2.exact, _decay)], ids=["P1", "P2"]
)
def test_block_stops_as_in_arbitrary_precision(exact, mu):
    # A handful of rounding errors of double precision.
    time, distance = _stop(mu)
    found = exact()
    assert abs(found.time / time - 1) < 1e-14
    assert abs(found.distance / distance - 1) < 1e-14


def test_block_has_the_published_numbers():
    # Quoted with 8 and 10 digits.
    assert p1.MU * 2000 / 7.3e-4 == pytest.approx(4.1095890e5, rel=5e-8)
    assert p1.exact().time == pytest.approx(4.8666667e-4, rel=1e-8)
    assert p1.exact().distance == pytest.approx(4.8666667e-2, rel=1e-8)
    assert p2.exact().time == pytest.approx(8.328807086e-4, rel=1e-10)
    assert p2.exact().distance == pytest.approx(9.465289176e-2, rel=1e-10)


def test_coefficient_of_the_rod_and_its_derivatives():
    cs, ds, ck, dk, dc = (mpf(str(p)) for p in p4.PROPS)

    def mu(rate, pressure, temperature):
        kinetic = ck * temperature + dk * pressure
        return kinetic + (cs * temperature + ds * pressure - kinetic) * mp.exp(-dc * rate)

    for point in ((0.0, 100.0, 50.0), (37.5, 1700.0, 211.0), (290.0, 2900.0, 77.0)):
        found = p4.exact(*(np.array(x) for x in point))
        at = tuple(mpf(x) for x in point)
        expected = [mu(*at)]
        for variable in range(3):
            order = tuple(int(i == variable) for i in range(3))
            expected.append(mp.diff(mu, at, order))
        # 1e-13: mpmath differentiates numerically with far more digits than that.
        assert [float(f) for f in found] == pytest.approx([float(e) for e in expected], rel=1e-13)
