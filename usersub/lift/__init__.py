# SPDX-License-Identifier: MIT
"""Law functions: one point function in Python behind every interface that can carry it.

    @usersub.coefficient(props=3)
    def decay(slip_rate, props):
        return props[1] + (props[0] - props[1]) * math.exp(-props[2] * slip_rate)

    driver = usersub.StandardDriver(decay.fric, scene)

Arguments by name, any subset in any order; what a law does not read is neither fetched nor passed:
slip_rate, pressure, temperature (mean of both surfaces), fields (means), slip_increment,
time_increment, state, props. Derivatives come from dual numbers. How to write one stands in
`docs/how-to/law-functions.md`, how derivatives are made in `docs/explanation/derivatives.md`.
"""

from __future__ import annotations

from usersub.lift.decorators import coefficient, strength, traction
from usersub.lift.functions import (
    aged,
    asinh_product,
    asinh_rate,
    bounded_exp,
    log_scaled,
    mean_decay,
    stribeck,
)
from usersub.lift.law_function import LawFunction
from usersub.lift.powers import decay_of_power, drop_of_power, product_of_powers
from usersub.lift.primitives import real, tiny

__all__ = [
    "LawFunction",
    "aged",
    "asinh_product",
    "asinh_rate",
    "bounded_exp",
    "coefficient",
    "decay_of_power",
    "drop_of_power",
    "log_scaled",
    "mean_decay",
    "product_of_powers",
    "real",
    "strength",
    "stribeck",
    "tiny",
    "traction",
]
