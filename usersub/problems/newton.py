# SPDX-License-Identifier: MIT
"""How fast Newton's method converges with the tangents that the drivers return.

The host of `newton_host` is pressed and dragged; of each run the increment with the most iterations
is told, once with the tangent and once with its symmetric part.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.problems.newton_host import Increment, NewtonHost, NoEquilibriumError

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Places of the base, increment by increment: along direction 1, direction 2, and the normal.
PATH = (
    (0.0, 0.0, 0.5), (0.0, 0.0, 1.0), (0.1, 0.03, 1.0), (0.2, 0.07, 1.0), (0.3, 0.1, 1.0),
    (0.4, 0.13, 0.97), (0.5, 0.17, 1.0), (0.6, 0.2, 1.0), (0.66, 0.3, 1.0),
)  # fmt: skip
TIME_INCREMENT = 0.1

#: Settings of a scene by enforcement. Multipliers take the allowable elastic slip as a reference.
METHODS: dict[str, dict[str, Any]] = {
    "penalty": {"elastic_slip": 0.01},
    "softened": {"stick_slope": 50.0},
    "lagrange": {"enforcement": "lagrange", "elastic_slip": 0.01},
}

#: Properties of the law below: two coefficients, how much more they are at rest and over which slip
#: rate that fades, and an exponent of the pressure.
LAWS = {
    "constant": (0.3, 0.5, 0.0, 1.0, 0.0),
    "of the rate": (0.3, 0.5, 0.4, 3.0, 0.0),
    "of the pressure": (0.3, 0.5, 0.0, 1.0, -0.2),
}

#: The law of FRIC: static and kinetic coefficient, decay.
FRIC_LAW, FRIC_PROPS = "exponential_decay", (0.42, 0.3, 0.3)


@dataclass(frozen=True)
class Run:
    """The increment of a run that took the most iterations.

    Attributes:
        points, directions: of the host.
        method: a key of METHODS, or "FRIC".
        law: a key of LAWS, or the name of the law behind FRIC.
        anisotropic: whether there are two coefficients.
        slipping: points that slip at the end.
        residuals: fractions of the forces, one before each correction.
        order: of one correction from near the solution, None where it is exact.
        symmetric_order: the same with the symmetric part of the tangent.
        symmetric: iterations with the symmetric part of the tangent, None without convergence.
        sentence: what `driver.symmetry()` says of the solution.
    """

    points: int
    directions: int
    method: str
    law: str
    anisotropic: bool
    slipping: int
    residuals: tuple[float, ...]
    order: float | None
    symmetric_order: float | None
    symmetric: int | None
    sentence: str


@functools.cache
def coefficient() -> Routine:
    """FRIC_COEF with every derivative, isotropic or anisotropic."""
    import usersub

    @usersub.fric_coef
    def newton(fCoef, fCoefDeriv, slipData, pressure, props):
        extra = props[2] * math.exp(-slipData[0, 0] / props[3])
        by_pressure = pressure[0] ** props[4]
        for k in range(2 if props[5] > 0.0 else 1):
            fCoef[0, k] = props[k] * (1.0 + extra) * by_pressure
            fCoefDeriv[0, 0, k] = -props[k] * extra / props[3] * by_pressure
            fCoefDeriv[0, 1, k] = fCoef[0, k] * props[4] / pressure[0]

    return newton


def runs() -> Iterator[Run]:
    """All runs, host by host."""
    for points, directions in ((1, 1), (1, 2), (12, 2)):
        for method in METHODS:
            for law in LAWS:
                for anisotropic in (False, True)[:directions]:
                    yield run(points, directions, method, law, anisotropic)
        yield run(points, directions, "FRIC", FRIC_LAW, False)


def run(points: int, directions: int, method: str, law: str, anisotropic: bool) -> Run:
    """One run; the worst increment is repeated with the symmetric part of its tangent."""
    made = functools.partial(_host, points, directions, method, law, anisotropic)
    found = list(_increments(made(), len(PATH)))
    worst = max(range(len(found)), key=lambda i: len(found[i].residuals))
    told, symmetric = _again(made(), worst, False), None
    try:
        symmetric = len(_again(made(), worst, True).residuals)
    except NoEquilibriumError:
        pass
    return Run(
        points, directions, method, law, anisotropic, told.slipping, tuple(told.residuals),
        told.order, told.symmetric_order, symmetric, told.symmetry,
    )  # fmt: skip


def _increments(host: NewtonHost, count: int) -> Iterator[Increment]:
    for place in PATH[:count]:
        yield host.increment(_place(place, host.directions), TIME_INCREMENT)


def _again(host: NewtonHost, worst: int, symmetric: bool) -> Increment:
    """Increment `worst`, with its order of convergence."""
    for _ in _increments(host, worst):
        pass
    host.symmetric = symmetric
    return host.increment(_place(PATH[worst], host.directions), TIME_INCREMENT, probe=True)


def _place(place: tuple[float, ...], directions: int) -> np.ndarray:
    return np.array([*place[:directions], place[2]])


def _host(points: int, directions: int, method: str, law: str, anisotropic: bool) -> NewtonHost:
    from usersub import Scene, StandardDriver, laws

    size: dict[str, Any] = {"points": points, "dimension": directions + 1}
    if method == "FRIC":
        routine = laws.routine(law, "fric", "c")
        scene = Scene(**size, props=FRIC_PROPS, characteristic_length=2.0, states=directions)
    else:
        routine = coefficient()
        props = (*LAWS[law], float(anisotropic))
        scene = Scene(**size, props=props, anisotropic=int(anisotropic), **METHODS[method])
    return NewtonHost(StandardDriver(routine, scene))
