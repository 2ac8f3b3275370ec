# SPDX-License-Identifier: MIT
"""Exponential decay through two or three measured points."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

from usersub.errors import SceneError

if TYPE_CHECKING:
    from usersub.laws.law_object import LawObject

#: Share of the transition that is left at the second point where test data have no third.
REMAINDER = Fraction(1, 20)


def decay(
    mu1: float, mu2: float, rate2: float, mu_inf: float | None = None
) -> tuple[float, float, float]:
    """Static coefficient, kinetic coefficient and decay coefficient from measured points.

    Without `mu_inf`, 5 % of the transition are left at the second point. The results are rounded
    once (`dc` by the logarithm's own rounding).

    Args:
        mu1: coefficient at rest.
        mu2: coefficient at the slip rate `rate2`.
        mu_inf: coefficient at very high slip rates.

    Raises:
        SceneError: no exponential decay goes through the points; the message says why.
    """
    for name, value in (("mu1", mu1), ("mu2", mu2), ("rate2", rate2), ("mu_inf", mu_inf)):
        if value is not None and not math.isfinite(value):
            raise SceneError(f"{name} is {value}, expected a finite number")
    if min(mu1, mu2, 0.0 if mu_inf is None else mu_inf) < 0.0:
        raise SceneError("a friction coefficient is negative")
    if not rate2 > 0.0:
        raise SceneError(f"the slip rate of the second point is {rate2:g}, expected more than 0")
    if mu1 == mu2:
        raise SceneError(
            f"both coefficients are {mu1:g}, so nothing decays; give a constant coefficient"
        )
    if mu_inf is None:
        limit = (Fraction(mu2) - REMAINDER * Fraction(mu1)) / (1 - REMAINDER)
        if limit < 0:
            raise SceneError(
                f"the kinetic coefficient would be {float(limit):g}, below 0, as 5 % of the "
                f"transition from {mu1:g} are left at {mu2:g}; give it as the third point"
            )
        inverse = 1 / REMAINDER
    else:
        limit = Fraction(mu_inf)
        if not min(mu1, mu_inf) < mu2 < max(mu1, mu_inf):
            raise SceneError(
                f"the second coefficient {mu2:g} is not between the static one {mu1:g} and the "
                f"kinetic one {mu_inf:g}"
            )
        inverse = (Fraction(mu1) - limit) / (Fraction(mu2) - limit)
    # near one the logarithm needs the distance from one, which only fractions have exactly
    logarithm = math.log1p(float(inverse - 1)) if inverse < 2 else _log(inverse)
    dc = logarithm / rate2
    if not (math.isfinite(dc) and dc > 0.0):
        raise SceneError(f"the decay coefficient would be {dc:g}, beyond double precision")
    return float(mu1), float(limit), dc


def exponential_decay_from_test_data(
    mu1: float, mu2: float, rate2: float, mu_inf: float | None = None
) -> LawObject:
    """The law `exponential_decay` through two or three measured points; see `decay`.

    Raises:
        SceneError: no exponential decay goes through the points; the message says why.
    """
    from usersub.laws.registry import law

    mus, muk, dc = decay(mu1, mu2, rate2, mu_inf)
    return law("exponential_decay")(mus=mus, muk=muk, dc=dc)


def _log(value: Fraction) -> float:
    try:
        return math.log(float(value))
    except OverflowError:
        return math.log(value.numerator) - math.log(value.denominator)
