# SPDX-License-Identifier: MIT
"""From a friction definition to a shipped law and a scene, where a driver carries it."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from usersub.deck.friction import (
    ElasticSlip,
    ExponentialDecay,
    Friction,
    Lagrange,
    Rough,
    SlipTolerance,
    Table,
    User,
)
from usersub.deck.words import refuse

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Interface by solver and kind of routine.
_USER = {
    ("standard", "FRIC"): "fric",
    ("standard", "COEFFICIENT"): "fric_coef",
    ("explicit", "FRIC"): "vfric",
    ("explicit", "FRICTION"): "vfriction",
    ("explicit", "COEFFICIENT"): "vfric_coef",
}
#: Largest table, in numbers, that an uneven grid is filled up to.
_LARGEST = 1_000_000


@dataclass(frozen=True)
class Plan:
    """How a friction runs: `interface`, shipped `law` ("" for a user's file), `settings`; or the
    `reason` why it does not."""

    interface: str = ""
    law: str = ""
    settings: dict[str, Any] = field(default_factory=dict)
    reason: str = ""


def plan(friction: Friction) -> Plan:
    """How the friction runs today."""
    solver = friction.solver or _solver(friction)
    law = friction.law
    reason = _obstacle(friction, solver)
    if reason:
        return Plan(reason=reason)
    if isinstance(law, User):
        settings: dict[str, Any] = {"props": law.properties}
        if law.depvar:
            settings["states"] = law.depvar
        return Plan(_USER[solver, law.kind], "", {**settings, **_limit(friction, law.kind)})
    interface = "fric_coef" if solver == "standard" else "vfric_coef"
    settings = _limit(friction, "COEFFICIENT")
    if isinstance(law, ExponentialDecay):
        props = (law.mus, law.muk, law.dc)
        return Plan(interface, "exponential_decay", {"props": props, **settings})
    assert isinstance(law, Table)  # _obstacle has seen to it
    if law.constant:
        return Plan(interface, "coulomb", {"props": law.rows[0].mu, **settings})
    filled = _props(law)
    if filled is None:
        return Plan(reason=f"the uneven table would need more than {_LARGEST} numbers")
    if len({row.temperature for row in law.rows}) > 1:
        settings["temperatures"] = 1
    return Plan(interface, "coulomb_tabulated", {"props": filled, **settings})


def _solver(friction: Friction) -> str:
    """The solver where the deck does not tell: what only one of them has, else the implicit."""
    law = friction.law
    explicit = isinstance(law, User) and law.kind == "FRICTION"
    slope = friction.shear_traction_slope
    return "explicit" if explicit or slope is not None else "standard"


def _obstacle(friction: Friction, solver: str) -> str:
    """Why no driver carries the friction; "" where one does."""
    law = friction.law
    if isinstance(law, Rough):
        return "rough friction needs a driver that allows no slip, and the drivers have none"
    if isinstance(friction.method, Lagrange):
        return "Lagrange multipliers are not what the driver of FRIC_COEF enforces sticking by"
    if friction.taumax and isinstance(law, User) and law.kind != "COEFFICIENT":
        return "TAUMAX does not limit the tractions of a user routine; let the routine do it"
    if friction.taumax and solver == "explicit":
        return "the explicit driver has no limit on the shear stress (TAUMAX)"
    if friction.stick_slope is not None and solver == "standard":
        return (
            "a constant stick slope is not what the implicit driver has: its elastic slip at the "
            "limit is a constant length"
        )
    if isinstance(law, User):
        return ""
    if friction.anisotropic:
        return "no shipped law sets two coefficients"
    if isinstance(law, Table) and not law.constant:
        for k in range(law.dependencies):
            if len({row.fields[k] for row in law.rows}) > 1:
                return f"no shipped law depends on a field variable (here number {k + 1})"
    return ""


def _limit(friction: Friction, kind: str) -> dict[str, Any]:
    """Settings of the penalty method."""
    found: dict[str, Any] = {}
    if friction.taumax and kind == "COEFFICIENT":
        found["shear_limit"] = friction.taumax
    if isinstance(friction.method, ElasticSlip):
        found["elastic_slip"] = friction.method.value
    elif isinstance(friction.method, SlipTolerance):
        found["slip_tolerance"] = friction.method.value
    return found


def scene_settings(friction: Friction) -> dict[str, Any]:
    """As `Friction.scene_settings`."""
    found = plan(friction)
    if found.reason:
        refuse(friction.where, f"the friction does not run: {found.reason}")
    return dict(found.settings)


def routine(friction: Friction, path: Any, *, language: str, precision: str) -> Routine:
    """As `Friction.routine`."""
    found = plan(friction)
    if found.reason:
        refuse(friction.where, f"the friction does not run: {found.reason}")
    if found.law:
        if path is not None:
            refuse(friction.where, "the deck names no user routine, but a file is given")
        from usersub import laws

        return laws.routine(found.law, found.interface, language, precision=precision)
    if path is None:
        refuse(friction.where, f"the file of the routine {found.interface.upper()} is not given")
    import usersub

    file = usersub.load(path, precision=precision, interface=found.interface)
    return file[found.interface]


# Tables.


def _props(table: Table) -> tuple[float, ...] | None:
    """Properties of `coulomb_tabulated`; None where they would be too many.

    A grid that is not full is filled up: each variable is interpolated within its own points, as
    the table would be, so that the full grid is the same function.
    """
    grids = [_points(row.slip_rate for row in table.rows)]
    grids.append(_points(row.pressure for row in table.rows))
    grids.append(_points(row.temperature for row in table.rows))
    if len(grids[0]) * len(grids[1]) * len(grids[2]) > _LARGEST:
        return None
    tree: dict[float, dict[float, dict[float, float]]] = {}
    for row in table.rows:
        by_pressure = tree.setdefault(row.temperature or 0.0, {})
        by_pressure.setdefault(row.pressure or 0.0, {})[row.slip_rate or 0.0] = row.mu[0]
    rates, pressures, temperatures = grids
    planes = {t: _plane(by, rates, pressures) for t, by in tree.items()}
    values = [mu for t in temperatures for mu in planes[t]]
    sizes = (len(rates), len(pressures), len(temperatures))
    return (*map(float, sizes), *rates, *pressures, *temperatures, *values)


def _points(values: Any) -> list[float]:
    return sorted({value or 0.0 for value in values})


def _plane(
    by_pressure: dict[float, dict[float, float]], rates: list[float], pressures: list[float]
) -> list[float]:
    """Coefficients at one temperature, the slip rate running fastest."""
    lines = {p: [_between(curve, rate) for rate in rates] for p, curve in by_pressure.items()}
    columns = [{p: line[i] for p, line in lines.items()} for i in range(len(rates))]
    return [_between(column, p) for p in pressures for column in columns]


def _between(curve: dict[float, float], at: float) -> float:
    """Linear between the points of a curve, which ascend, constant outside."""
    if at in curve:
        return curve[at]
    points: Sequence[float] = list(curve)
    k = bisect_right(points, at)
    if k == 0 or k == len(points):
        return curve[points[max(k - 1, 0)]]
    low, high = points[k - 1], points[k]
    share = (at - low) / (high - low)
    return curve[low] + (curve[high] - curve[low]) * share


__all__ = ["Plan", "plan", "routine", "scene_settings"]
