# SPDX-License-Identifier: MIT
"""Forces of coefficient, strength and traction laws behind the explicit interfaces."""

from __future__ import annotations

import law_cases
import law_host
import numpy as np
import pytest
from law_cases import column, floats

from usersub import laws

KINDS = ("coefficient", "strength", "traction")
INTERFACES = ("vfric", "vfriction", "vfric_coef")


def _expected(law: str, precision: str, points: list[dict], area: np.ndarray) -> np.ndarray:
    """Friction forces without the bound by the stick force; none where there is no pressure."""
    value = floats(law_cases.result(points, precision, "value"))[:, 0]
    pressure = column(points, "pressure")
    real = law_cases.REAL[precision]
    by = pressure.astype(real).astype(float) if laws.law(law).kind == "coefficient" else 1.0
    return np.where(pressure > 0, value * by * area, 0.0)


@pytest.mark.parametrize(
    ("law", "interface", "precision"), law_cases.combinations(INTERFACES, KINDS)
)
def test_forces(law, interface, precision, language):
    tolerance = law_cases.relative(law, precision)
    for case in law_cases.reference(law):
        for dt, points in law_cases.by_time_increment(case["points"]):
            if dt == 0:
                continue  # no increment of an explicit analysis
            driver, surface = law_host.driver_of(law, interface, precision, language, case, points)
            rate = column(points, "slip_rate")
            expected = _expected(law, precision, points, surface.area)
            start = column(points, "state") if driver.scene.states else None
            for share in (None, 0.5):  # without a bound; with half the force as the stick force
                if start is not None:
                    surface.set_states(driver, start)
                stick = law_host.NO_STICK if share is None else share * np.abs(expected)
                wanted = expected if share is None else np.minimum(expected, stick)
                slip = surface.along * (rate * dt)
                force = law_host.step(driver, surface, dt, points, slip, stick)
                # At rest the force has the direction of an arbitrary axis.
                moves = rate > 0
                along = -np.einsum("ik,ik->k", force, surface.along)
                found = np.where(moves, along, np.linalg.norm(force.astype(float), axis=0))
                wanted = np.where(moves, wanted, np.abs(wanted))
                assert found == pytest.approx(wanted, rel=tolerance), (case["props"], share)
                across = np.einsum("ik,ik->k", force, surface.across)
                assert np.abs(across[moves]) == pytest.approx(0.0, abs=1e-30)
                if start is not None:
                    _check_states(law, precision, points, surface.states(driver), start)


def _check_states(law, precision, points, found, start):
    end = floats(law_cases.result(points, precision, "state")).T
    closed = column(points, "pressure") > 0  # the others are not asked
    expected = np.where(closed, end, start)
    assert found == pytest.approx(expected, rel=law_cases.relative(law, precision))
