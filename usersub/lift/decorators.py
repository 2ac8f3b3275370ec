# SPDX-License-Identifier: MIT
"""The decorators `coefficient`, `strength` and `traction`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from usersub.lift.description import COEFFICIENT, STRENGTH, TRACTION, Count, describe
from usersub.lift.law_function import LawFunction
from usersub.routine.vector_math import choice


def _law(
    kind: str,
    function: Callable | None,
    anisotropic: bool | None,
    vector_math: bool | str,
    **settings: Any,
) -> Any:
    choice(vector_math)  # refuses what is none

    def make(law: Callable) -> LawFunction:
        return LawFunction(describe(kind, law, anisotropic=anisotropic, **settings), vector_math)

    return make if function is None else make(function)


def coefficient(
    function: Callable | None = None,
    *,
    props: Count = 0,
    states: Count = 0,
    derivatives: str | None = "dual",
    anisotropic: bool | None = None,
    vector_math: bool | str = False,
) -> Any:
    """Makes a law of a point function that returns the friction coefficient, or two coefficients,
    `mu1, mu2`, for the two friction directions.

    Args:
        function: the function.
        props: least number of properties, or a function of `props` that tells it.
        states: number of state variables, `state[i]`, or a function of `props` that tells it.
        derivatives: "dual": made by dual numbers; "own": the function returns `value,
            (d slip_rate, d pressure, d temperature, d slip_increment)`; None: taken to be zero.
        anisotropic: True where the two coefficients do not show in a return statement.
        vector_math: vectorised exp, log and pow, as for `usersub.vfric_coef`.

    Returns:
        LawFunction.

    Raises:
        AbiError: the function cannot be a law; the message says where and why.
    """
    return _law(
        COEFFICIENT, function, anisotropic, vector_math, props=props, states=states, vectors=0,
        derivatives=derivatives,
    )  # fmt: skip


def strength(
    function: Callable | None = None,
    *,
    props: Count = 0,
    states: Count = 0,
    derivatives: str | None = "dual",
    vector_math: bool | str = False,
) -> Any:
    """Makes a law of a point function that returns the critical shear stress: the point sticks
    below it and slips at it. Arguments as for `coefficient`."""
    return _law(
        STRENGTH, function, None, vector_math, props=props, states=states, vectors=0,
        derivatives=derivatives,
    )  # fmt: skip


def traction(
    function: Callable | None = None,
    *,
    props: Count = 0,
    states: Count = 0,
    vectors: Count = 0,
    derivatives: str | None = "dual",
    vector_math: bool | str = False,
) -> Any:
    """Makes a law of a point function that returns a shear traction.

    Without the argument `motion` it is the stress against the slip, a number, and all motion is
    slip. With `motion`, the two components of the sliding motion of the increment, it is the pair
    of components along them (a bristle law); `vectors` counts its vector state variables
    `vectors[i, 0]`, `vectors[i, 1]`, in the directions of the motion. Other arguments as for
    `coefficient`; the derivatives of a bristle law's own are `((t1, t2), (by1, by2))`, each by
    motion 1, motion 2, pressure, temperature.
    """
    return _law(
        TRACTION, function, None, vector_math, props=props, states=states, vectors=vectors,
        derivatives=derivatives,
    )  # fmt: skip
