# SPDX-License-Identifier: MIT
"""The largest stress of the shipped laws, from their equations and not from their code."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

Bound = Callable[[float], float]

#: Laws whose stress falls below a bound that has fallen only as the point moves on, by their own
#: equations: what bounds them is the largest bound so far.
LAGGING = ("dahl", "lugre")


def of(law: str, values: Mapping[str, object]) -> Bound | None:
    """Largest stress of a law by pressure; None where the law has none.

    Rate and state laws have none, since their coefficient follows the logarithm of the rate; nor
    have viscous ones.
    """
    make = _BOUNDS.get(law)
    return None if make is None else make(dict(values))


def _coefficient(largest: Callable[[dict[str, Any]], float]) -> Callable[[dict[str, Any]], Bound]:
    def make(values: dict[str, Any]) -> Bound:
        mu = float(largest(values))
        return lambda load: mu * load if load > 0 else 0.0

    return make


def _decaying(values: dict[str, Any]) -> float:
    return max(values["mus"], values["muk"])


def _stribeck(values: dict[str, Any]) -> float:
    return max(values["mus"], values["muk"]) if values["cv"] == 0 else np.inf


def _bristle(values: dict[str, Any]) -> float:
    """Without damping a bristle carries the largest strength."""
    if values.get("sigma1", 0.0) or values.get("sigma2", 0.0):
        return np.inf
    return max(values["mus"], values["muk"])


def _shear_limit(values: dict[str, Any]) -> Bound:
    return lambda load: min(values["mu"] * load, values["tau_max"]) if load > 0 else 0.0


def _cohesion(values: dict[str, Any]) -> Bound:
    return lambda load: values["c"] + values["mu"] * load if load > 0 else values["c"]


def _tresca(values: dict[str, Any]) -> Bound:
    return lambda load: values["m"] * values["k"]


def _softening(values: dict[str, Any]) -> float:
    return max(values["mu_cold"], values["mu_hot"])


def _wanheim_bay(values: dict[str, Any]) -> Bound:
    """No more than the friction factor times the strength, nor than the slope at no pressure."""
    return lambda load: values["f"] * values["k"] if load > 0 else 0.0


_BOUNDS: dict[str, Callable[[dict[str, Any]], Bound]] = {
    "frictionless": _coefficient(lambda v: 0.0),
    "coulomb": _coefficient(lambda v: v["mu"]),
    "anisotropic": _coefficient(lambda v: max(v["mu1"], v["mu2"])),
    "coulomb_tabulated": _coefficient(lambda v: np.max(v["table"])),
    "anisotropic_tabulated": _coefficient(lambda v: max(np.max(v["table1"]), np.max(v["table2"]))),
    "exponential_decay": _coefficient(_decaying),
    "stribeck": _coefficient(_stribeck),
    "slip_weakening": _coefficient(lambda v: max(v["mus"], v["mud"])),
    "slip_weakening_exponential": _coefficient(lambda v: max(v["mus"], v["mud"])),
    "temperature_softening": _coefficient(_softening),
    "dahl": _coefficient(lambda v: v["mu"]),
    "softened": _coefficient(lambda v: v["mu"]),
    "iwan": _coefficient(lambda v: v["mu"] * float(np.sum(v["share"]))),
    "lugre": _coefficient(_bristle),
    "elasto_plastic": _coefficient(_bristle),
    "shear_limit": _shear_limit,
    "cohesion": _cohesion,
    "tresca": _tresca,
    "wanheim_bay": _wanheim_bay,
}
