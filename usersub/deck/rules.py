# SPDX-License-Identifier: MIT
"""What may stand together in one *FRICTION block, and where: the exclusions of the manual."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from usersub.deck.friction import (
    ElasticSlip,
    ExponentialDecay,
    Friction,
    Lagrange,
    Method,
    Rough,
    SlipTolerance,
    User,
)
from usersub.deck.procedures import is_riks
from usersub.deck.words import Note, Parameters, Where, choose, refuse, show

if TYPE_CHECKING:
    from usersub.deck.model import Deck

#: Parameters of *FRICTION by dialect.
KINDS = {
    "commercial": {
        "ANISOTROPIC": "flag",
        "DEPENDENCIES": "whole",
        "DEPVAR": "whole",
        "ELASTIC SLIP": "real",
        "EXPONENTIAL DECAY": "flag",
        "LAGRANGE": "flag",
        "PROPERTIES": "whole",
        "ROUGH": "flag",
        "SHEAR TRACTION SLOPE": "real",
        "SLIP TOLERANCE": "real",
        "TAUMAX": "real",
        "TEST DATA": "flag",
        "USER": "choice",
    },
    "calculix": {},
}
_ROUTINES = ("FRIC", "FRICTION", "COEFFICIENT")

#: At most one of these stands in a block.
_ONE_OF = ("ELASTIC SLIP", "LAGRANGE", "ROUGH", "SLIP TOLERANCE", "USER")

#: Pairs that exclude one another, and why.
_PAIRS = (
    ("EXPONENTIAL DECAY", "ANISOTROPIC", "exponential decay is isotropic"),
    ("EXPONENTIAL DECAY", "TAUMAX", "a decaying coefficient has no limit on the shear stress"),
    ("EXPONENTIAL DECAY", "DEPENDENCIES", "a decaying coefficient depends on the slip rate only"),
    ("EXPONENTIAL DECAY", "ROUGH", "rough friction has no coefficient"),
    ("EXPONENTIAL DECAY", "USER", "the routine gives the coefficient"),
    ("ANISOTROPIC", "ROUGH", "rough friction has no coefficient"),
    ("DEPENDENCIES", "ROUGH", "rough friction has no table"),
    ("SHEAR TRACTION SLOPE", "USER", "softening is not used with user routines"),
)

#: Parameters that need another one.
_NEEDS = (
    ("TEST DATA", "EXPONENTIAL DECAY"),
    ("DEPVAR", "USER"),
    ("PROPERTIES", "USER"),
)

#: Parameters that only one solver knows.
_STANDARD_ONLY = ("ELASTIC SLIP", "LAGRANGE", "SLIP TOLERANCE", "ANISOTROPIC")
_EXPLICIT_ONLY = ("SHEAR TRACTION SLOPE",)
_NOT_FOR_CONNECTORS = ("LAGRANGE", "ROUGH", "USER", "ANISOTROPIC")


def check_parameters(given: Parameters) -> None:
    """Refuses parameters that exclude one another, whatever the solver.

    Raises:
        DeckError: at the keyword line, with the parameters and the reason.
    """
    where = given.where
    present = {name for name in given.values if name != "DEPENDENCIES" or given.get(name)}
    several = [name for name in _ONE_OF if name in given]
    if len(several) > 1:
        refuse(where, f"*FRICTION: {several[0]} and {several[1]} exclude one another")
    for first, second, reason in _PAIRS:
        if first in present and second in present:
            refuse(where, f"*FRICTION: {first} and {second} exclude one another: {reason}")
    for name, needed in _NEEDS:
        if name in given and needed not in given:
            refuse(where, f"*FRICTION: {name} is given, which needs {needed}")
    for first in _STANDARD_ONLY:
        for second in _EXPLICIT_ONLY:
            if first in given and second in given:
                refuse(
                    where,
                    f"*FRICTION: {first} is for the implicit solver and {second} for the "
                    "explicit one",
                )
    for name in ("ELASTIC SLIP", "SLIP TOLERANCE", "SHEAR TRACTION SLOPE"):
        value = given.get(name, 1.0)
        if value <= 0.0:
            refuse(where, f"*FRICTION: {name} = {value:g}, expected more than 0")
    limit = given.get("TAUMAX", 0.0)
    if limit < 0.0:
        refuse(where, f"*FRICTION: TAUMAX = {limit:g}, expected more than 0")


def routine_kind(given: Parameters) -> str:
    """The routine that USER names: "FRIC" where it names none."""
    word = given.get("USER")
    if not word:
        return "FRIC"
    kind = choose(word, _ROUTINES)
    if not isinstance(kind, str):
        refuse(
            given.where,
            f"*FRICTION: USER = {show(word)}, expected FRIC, FRICTION or COEFFICIENT",
        )
    return kind


def method_of(given: Parameters) -> Method | None:
    """The enforcement that the parameters ask for."""
    if "LAGRANGE" in given:
        return Lagrange()
    if "ELASTIC SLIP" in given:
        return ElasticSlip(given.get("ELASTIC SLIP"))
    if "SLIP TOLERANCE" in given:
        return SlipTolerance(given.get("SLIP TOLERANCE"))
    return None


def check_solver(friction: Friction, solver: str | None, warn: Callable[[Note], None]) -> None:
    """Refuses what the solver does not have.

    Raises:
        DeckError: at the friction's line.
    """
    where, law = friction.where, friction.law
    has = {
        "ELASTIC SLIP": isinstance(friction.method, ElasticSlip),
        "LAGRANGE": isinstance(friction.method, Lagrange),
        "SLIP TOLERANCE": isinstance(friction.method, SlipTolerance),
        "ANISOTROPIC": friction.anisotropic,
        "SHEAR TRACTION SLOPE": friction.shear_traction_slope is not None,
    }
    if solver == "explicit":
        for name in _STANDARD_ONLY:
            if has[name]:
                refuse(where, f"*FRICTION: {name} is for the implicit solver, not the explicit one")
        if friction.taumax == 0.0:
            refuse(where, "*FRICTION: TAUMAX = 0 is not allowed; leave it out for no limit")
    if solver == "standard" and has["SHEAR TRACTION SLOPE"]:
        name = "SHEAR TRACTION SLOPE"
        refuse(where, f"*FRICTION: {name} is for the explicit solver, not the implicit one")
    if solver is None and friction.taumax == 0.0:
        warn(Note(where, "TAUMAX = 0 means no limit in the implicit solver; the explicit refuses"))
    if isinstance(law, User):
        _check_user(law, solver, where, warn)
        if friction.anisotropic and law.kind != "COEFFICIENT":
            warn(Note(where, "ANISOTROPIC has no meaning with a routine that gives tractions"))
    elif isinstance(law, ExponentialDecay) and law.muk > law.mus:
        text = f"the kinetic coefficient {law.muk:g} is above the static one {law.mus:g}"
        warn(Note(where, text))
    if isinstance(law, Rough) and friction.taumax:
        warn(Note(where, "TAUMAX has no effect on rough friction"))


def _check_user(law: User, solver: str | None, where: Where, warn: Callable) -> None:
    if law.kind == "FRICTION" and solver == "standard":
        refuse(where, "*FRICTION: USER = FRICTION (VFRICTION) is for the explicit solver")
    if law.kind == "COEFFICIENT" and law.depvar:
        if solver == "explicit":
            refuse(where, f"*FRICTION: DEPVAR = {law.depvar}, but VFRIC_COEF has no state")
        warn(Note(where, f"DEPVAR = {law.depvar}: only newer releases give FRIC_COEF state"))
    if law.dependencies:
        warn(Note(where, "DEPENDENCIES has no meaning with USER"))


def check_connector(friction: Friction, given: Parameters) -> None:
    """Refuses what connector friction does not have.

    Raises:
        DeckError: at the keyword line.
    """
    for name in _NOT_FOR_CONNECTORS:
        if name in given:
            refuse(friction.where, f"*FRICTION: {name} cannot be used for connectors")


def check_riks(deck: Deck) -> None:
    """Refuses friction that depends on the slip rate in static Riks steps: they have no velocity.

    Raises:
        DeckError: at the friction's line.
    """
    for step in filter(lambda step: is_riks(step.procedure), deck.steps):
        for interaction in deck:
            friction = deck.friction(interaction.name, step.number)
            if friction is not None and friction.rate_dependent:
                refuse(
                    friction.where,
                    f"*FRICTION: {interaction.name} depends on the slip rate, which the static "
                    f"Riks step of {step.where} does not have",
                )
