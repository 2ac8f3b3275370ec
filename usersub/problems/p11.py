# SPDX-License-Identifier: MIT
"""P11: a bar that is pulled over a surface which holds it by friction along its length."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from usersub.problems.choose import positive
from usersub.problems.linear_host import LinearHost, NoEquilibriumError, Springs, make_driver
from usersub.problems.problem import Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Axial stiffness EA, limit force by length, length; coefficient and width, which make the limit.
STIFFNESS, LIMIT, LENGTH = 350.0, 1.6, 2.5
MU, WIDTH = 0.4, 0.25

#: Largest pull as a fraction of what the whole bar could hold: the end of the slipping part lies a
#: third or two thirds into the share of a friction point, whatever power of two their number is.
SHARE = 2.0 / 3.0
FORCE = SHARE * LIMIT * LENGTH

#: Allowable elastic slip of the penalty method, about a hundredth of the motion of the end.
ALLOWABLE = 1e-4


class Exact(NamedTuple):
    """Motion of the pulled end under the largest force and where that is taken away again;
    dissipation of a closed loop between the largest pull and the largest push."""

    pulled: float
    released: float
    loop: float


def exact(allowable: float) -> Exact:
    """In closed form; an elastic slip (0: none) adds its half to the motion, as the part that
    sticks then carries q/beta, beta^2 = q/(EA allowable). Unloading and loop by Masing's rule."""
    flexible = STIFFNESS * LIMIT
    start = math.sqrt(flexible * allowable)  # force at which slip begins

    def backbone(force: float) -> float:
        if force < start:
            return allowable * force / start
        return force**2 / (2.0 * flexible) + 0.5 * allowable

    pulled = backbone(FORCE)
    loop = 2.0 * FORCE**3 - 6.0 * flexible * allowable * FORCE + 4.0 * start**3
    return Exact(pulled, pulled - 2.0 * backbone(0.5 * FORCE), loop / (3.0 * flexible))


def springs(points: int) -> Springs:
    """The bar: motions of the points, in the middle of their shares, then that of the pulled end.

    With the friction of a share at one of its ends the error is of first order in 1/points; in the
    middle it is of second.
    """
    share = LENGTH / points
    k = np.full(points, STIFFNESS / share)
    k[0] *= 2.0  # from the end to the first point is half a share
    order = [points, *range(points)]
    stiffness = np.zeros((points + 1, points + 1))
    for i, spring in enumerate(k):
        a, b = order[i], order[i + 1]
        stiffness[a, a] += spring
        stiffness[b, b] += spring
        stiffness[a, b] -= spring
        stiffness[b, a] -= spring
    slip = np.eye(points, points + 1)
    return Springs(slip, slip.T * (share * WIDTH), stiffness, np.full(points, LIMIT / WIDTH / MU))


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = 32,
    steps: int = 8,
    elastic_slip: float | None = None,
) -> Outcome:
    """Pull, release, push, release, pull: motions of the end and the dissipation of the loop."""
    lagrange = method == "lagrange"
    allowable = positive("P11", "elastic_slip", elastic_slip, ALLOWABLE)
    driver = make_driver(
        routine, [MU], points, directions=1, allowable=allowable, lagrange=lagrange
    )
    host = LinearHost(driver, springs(points), 1e3)
    load = np.zeros(points + 1)

    def pull(begin: float, end: float, count: int) -> tuple[float, float]:
        for i in range(count):
            load[-1] = begin + (end - begin) * (i + 1.0) / count
            host.solve(load)
        return float(host.unknowns[-1]), WIDTH * LENGTH / points * float(host.dissipated.sum())

    # An elastic slip that was asked for is an error of the enforcement; the problem's own is not.
    answer = exact(0.0 if lagrange or elastic_slip is not None else ALLOWABLE)
    try:
        pulled, _ = pull(0.0, FORCE, steps)
        released, _ = pull(FORCE, 0.0, steps)
        pull(0.0, -FORCE, steps)
        _, before = pull(-FORCE, FORCE, 2 * steps)
        pull(FORCE, -FORCE, 2 * steps)
        again, after = pull(-FORCE, FORCE, 2 * steps)
    except NoEquilibriumError:  # nothing holds the bar
        pulled = released = again = before = after = math.inf
    errors = {
        "pulled": abs(pulled / answer.pulled - 1.0),
        "released": abs(released / answer.released - 1.0),
        "loop": abs((after - before) / answer.loop - 1.0),
    }
    closed = abs(again / pulled - 1.0)
    # The share in which the slip ends: r (1 - r) h^2 q^2/F^2 with r = 1/3 or 2/3; 4 for the half
    # force of unloading, and the loop has the third power.
    tolerance = 8.0 * (2.0 / 9.0) / (SHARE * points) ** 2
    return Outcome(
        problem="P11", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=1.0, points=points,
        error=float(np.max(list(errors.values()))), error_of="motion and loop", tolerance=tolerance,
        details={**errors, "closed": closed,
                 "newton_iterations": host.iterations / max(1, host.increments)},
        **host.watch.times(points),
    )  # fmt: skip


PROBLEM = Problem(
    name="P11",
    title="Bar held by friction along its length",
    statement="A bar with axial stiffness EA lies on a surface that holds it with up to q by "
    "length. Pulled at its end with F it moves by F^2/(2 EA q), slipping over F/q; released it "
    "comes half of the way back. Loops between pull and push dissipate 2 F^3/(3 EA q).",
    laws=("coulomb",),
    methods={"fric": ("penalty",), "fric_coef": ("penalty", "lagrange")},
    runner=run,
    options={
        "points": "contact points, and springs",
        "steps": "increments from zero to the pull",
        "elastic_slip": "allowable elastic slip of penalty enforcement; the answer is then "
        "compared with that of sticking without any",
    },
)
