# SPDX-License-Identifier: MIT
"""From a friction definition to a shipped law and settings of a scene."""

from __future__ import annotations

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
from usersub.deck.grid import full_grid
from usersub.deck.words import refuse

if TYPE_CHECKING:
    from usersub import interaction
    from usersub.laws import LawObject
    from usersub.routine.routine import Routine

#: Interface by solver and kind of routine.
_USER = {
    ("standard", "FRIC"): "fric",
    ("standard", "COEFFICIENT"): "fric_coef",
    ("explicit", "FRIC"): "vfric",
    ("explicit", "FRICTION"): "vfriction",
    ("explicit", "COEFFICIENT"): "vfric_coef",
}
#: Interfaces of shipped laws by solver, the first that carries a law.
_LAW = {"standard": ("fric_coef", "fric"), "explicit": ("vfric_coef", "vfriction")}


#: Slip tolerance of connectors where the deck gives none; elsewhere it is that of the scene.
CONNECTOR_TOLERANCE = 1e-4


@dataclass(frozen=True)
class Plan:
    """How a friction runs: `interface`, shipped `law` with its properties (None for a user's
    file), `settings` of the scene; or the `reason` why it does not."""

    interface: str = ""
    law: LawObject | None = None
    settings: dict[str, Any] = field(default_factory=dict)
    reason: str = ""


def plan(friction: Friction) -> Plan:
    """How the friction runs."""
    solver = friction.solver or _solver(friction)
    law = friction.law
    if isinstance(law, User):
        return _user(friction, law, solver)
    shipped, reason = _shipped(friction, solver)
    if shipped is None:
        return Plan(reason=reason)
    interface = next(name for name in _LAW[solver] if name in shipped.interfaces)
    settings: dict[str, Any] = {"props": shipped.props} if shipped.props else {}
    states = shipped.states(interface)
    if states:
        settings["states"] = states
    if shipped.anisotropic:
        settings["anisotropic"] = 1
    if isinstance(law, Table):
        settings.update(_surfaces(law))
    if not isinstance(law, Rough):
        settings.update(_enforcement(friction, solver))
    return Plan(interface, shipped, settings)


def _solver(friction: Friction) -> str:
    """The solver where the deck does not tell: what only one of them has, else the implicit."""
    law = friction.law
    explicit = isinstance(law, User) and law.kind == "FRICTION"
    slope = friction.shear_traction_slope
    return "explicit" if explicit or slope is not None else "standard"


def _user(friction: Friction, law: User, solver: str) -> Plan:
    if friction.taumax and law.kind != "COEFFICIENT":
        reason = "TAUMAX does not limit the tractions of a user routine; let the routine do it"
        return Plan(reason=reason)
    settings: dict[str, Any] = {"props": law.properties}
    if law.depvar:
        settings["states"] = law.depvar
    if law.kind == "COEFFICIENT":
        if friction.anisotropic:
            settings["anisotropic"] = 1
        settings.update(_enforcement(friction, solver))
    return Plan(_USER[solver, law.kind], None, settings)


def _shipped(friction: Friction, solver: str) -> tuple[LawObject | None, str]:
    """The shipped law, or why there is none."""
    from usersub import laws

    law = friction.law
    if isinstance(law, Rough):
        slope = friction.shear_traction_slope
        return (laws.rough() if slope is None else laws.softened_rough(kappa=slope)), ""
    if isinstance(law, ExponentialDecay):
        return laws.exponential_decay(mus=law.mus, muk=law.muk, dc=law.dc), ""
    assert isinstance(law, Table)
    if friction.anisotropic and solver == "explicit":
        return None, "the explicit interfaces do not tell the axes of anisotropic friction"
    if law.constant:
        mu = law.rows[0].mu
        if friction.anisotropic:
            return laws.anisotropic(mu1=mu[0], mu2=mu[1]), ""
        return laws.coulomb(mu=mu[0]), ""
    grid = full_grid(law)
    if isinstance(grid, str):
        return None, grid
    rates, pressures, temperatures, *fields = grid.axes
    axes = {
        "rates": rates,
        "pressures": pressures,
        "temperatures": temperatures,
        "fields": fields,
    }
    if friction.anisotropic:
        first, second = grid.tables
        return laws.anisotropic_tabulated(**axes, table1=first, table2=second), ""
    return laws.coulomb_tabulated(**axes, table=grid.tables[0]), ""


def _surfaces(table: Table) -> dict[str, Any]:
    """What the surfaces need for a table: temperatures and fields, if it depends on them."""
    found: dict[str, Any] = {}
    if table.constant:
        return found
    if len({row.temperature for row in table.rows}) > 1:
        found["temperatures"] = 1
    if table.dependencies:
        found["fields"] = table.dependencies
    return found


def _enforcement(friction: Friction, solver: str) -> dict[str, Any]:
    """Settings of the method."""
    found: dict[str, Any] = {}
    if friction.taumax:
        found["shear_limit"] = friction.taumax
    if isinstance(friction.method, ElasticSlip):
        found["elastic_slip"] = friction.method.value
    elif isinstance(friction.method, SlipTolerance):
        found["slip_tolerance"] = friction.method.value
    elif isinstance(friction.method, Lagrange):
        found["enforcement"] = "lagrange"
    elif friction.connector and solver == "standard":
        found["slip_tolerance"] = CONNECTOR_TOLERANCE
    slope = friction.shear_traction_slope if solver == "explicit" else friction.stick_slope
    if slope is not None:
        found["stick_slope"] = slope
        if solver == "explicit":
            found["enforcement"] = "penalty"
    return found


def _planned(friction: Friction) -> Plan:
    found = plan(friction)
    if found.reason:
        refuse(friction.where, f"the friction does not run: {found.reason}")
    return found


def scene_settings(friction: Friction) -> dict[str, Any]:
    """As `Friction.scene_settings`."""
    return dict(_planned(friction).settings)


def routine(friction: Friction, path: Any, *, language: str, precision: str) -> Routine:
    """As `Friction.routine`."""
    found = _planned(friction)
    if found.law is not None:
        _refuse_file(friction, path)
        return found.law.behind(found.interface, language, precision)
    if path is None:
        refuse(friction.where, f"the file of the routine {found.interface.upper()} is not given")
    import usersub

    file = usersub.load(path, precision=precision, interface=found.interface)
    return file[found.interface]


def _refuse_file(friction: Friction, path: Any) -> None:
    """Refuses a file where a shipped law acts."""
    if path is not None:
        refuse(friction.where, "the deck names no user routine, but a file is given")


def acting(friction: Friction, path: Any, *, language: str) -> interaction.Friction:
    """As `Friction.acting`."""
    from usersub.interaction import Friction as Acting

    found = _planned(friction)
    if found.law is None:
        own = routine(friction, path, language=language, precision="double")
        return Acting(own, **found.settings)
    _refuse_file(friction, path)
    of_law = ("anisotropic", "props", "states")
    settings = {k: v for k, v in found.settings.items() if k not in of_law}
    return Acting(found.law.in_language(language), **settings)


__all__ = ["Plan", "acting", "plan", "routine", "scene_settings"]
