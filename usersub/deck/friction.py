# SPDX-License-Identifier: MIT
"""Friction definitions: what one *FRICTION block says, as typed values."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from usersub.deck.words import Where

if TYPE_CHECKING:
    from usersub import interaction
    from usersub.routine.routine import Routine

#: Solvers and dialects that a deck may be written for.
SOLVERS = ("standard", "explicit")
DIALECTS = ("commercial", "calculix")


@dataclass(frozen=True)
class Row:
    """One row of a table; None where the deck leaves a variable out.

    Attributes:
        mu: coefficient, or two in an anisotropic table.
        slip_rate, pressure, temperature: where the row stands.
        fields: field variables, as many as DEPENDENCIES.
    """

    mu: tuple[float, ...]
    slip_rate: float | None = None
    pressure: float | None = None
    temperature: float | None = None
    fields: tuple[float | None, ...] = ()

    @property
    def place(self) -> tuple[float | None, ...]:
        """The independent variables, the slip rate first."""
        return (self.slip_rate, self.pressure, self.temperature, *self.fields)


@dataclass(frozen=True)
class Table:
    """Coefficients in `rows`, linear in between, constant outside; `dependencies` fields."""

    rows: tuple[Row, ...]
    dependencies: int = 0

    @property
    def constant(self) -> bool:
        """Whether the table is one coefficient (or one pair)."""
        return all(row.mu == self.rows[0].mu for row in self.rows)


@dataclass(frozen=True)
class TestData:
    """Measured points of an exponential decay.

    Attributes:
        mu1: coefficient at rest.
        mu2, rate2: coefficient at a slip rate.
        mu_inf: coefficient at very high rates, or None.
    """

    __test__ = False  # this is no test of pytest

    mu1: float
    mu2: float
    rate2: float
    mu_inf: float | None = None


@dataclass(frozen=True)
class ExponentialDecay:
    """``mu = muk + (mus - muk) exp(-dc rate)``; `test_data` from which it was derived, or None."""

    mus: float
    muk: float
    dc: float
    test_data: TestData | None = None


@dataclass(frozen=True)
class Rough:
    """No slip while the surfaces touch."""


@dataclass(frozen=True)
class User:
    """A user routine.

    Attributes:
        kind: "FRIC", "FRICTION" or "COEFFICIENT".
        properties: PROPS of the routine.
        depvar: number of state variables.
        dependencies: DEPENDENCIES, without meaning here.
    """

    kind: str = "FRIC"
    properties: tuple[float, ...] = ()
    depvar: int = 0
    dependencies: int = 0


@dataclass(frozen=True)
class Lagrange:
    """Sticking is enforced by Lagrange multipliers."""


@dataclass(frozen=True)
class ElasticSlip:
    """Allowable elastic slip: `value`, a length (in steady-state transport a velocity)."""

    value: float


@dataclass(frozen=True)
class SlipTolerance:
    """Allowable elastic slip over the characteristic contact face dimension: `value`."""

    value: float


Law = Table | ExponentialDecay | Rough | User
Method = Lagrange | ElasticSlip | SlipTolerance


@dataclass(frozen=True)
class Friction:
    """One ``*FRICTION`` block.

    `str(friction)` is the block as text, from which the same friction is read.

    Attributes:
        law: the coefficient, or what stands for it.
        method: enforcement of sticking that the deck asks for, or None.
        taumax: limit on the equivalent shear stress, or None; 0 means none.
        anisotropic: whether the table has two coefficients.
        shear_traction_slope: slope of shear traction against elastic slip (explicit), or None.
        stick_slope: the same in the CalculiX dialect, or None.
        dialect: "commercial" or "calculix".
        solver: solver of the deck, or None if nothing tells.
        connector: whether it acts in a connector.
        where: its line.
    """

    law: Law
    method: Method | None = None
    taumax: float | None = None
    anisotropic: bool = False
    shear_traction_slope: float | None = None
    stick_slope: float | None = None
    dialect: str = "commercial"
    solver: str | None = field(default=None, compare=False)
    connector: bool = field(default=False, compare=False)
    where: Where = field(default=Where("deck", 0), compare=False)

    def __str__(self) -> str:
        from usersub.deck.text import block

        return block(self)

    @property
    def rate_dependent(self) -> bool:
        """Whether the coefficient that the deck gives depends on the slip rate."""
        if isinstance(self.law, ExponentialDecay):
            return self.law.dc != 0.0 and self.law.mus != self.law.muk
        if isinstance(self.law, Table):
            return not self.law.constant and len({row.slip_rate for row in self.law.rows}) > 1
        return False

    def describe(self) -> str:
        """The law in one line, for people."""
        law = self.law
        if isinstance(law, Rough):
            return "rough"
        if isinstance(law, User):
            return f"user routine {law.kind}, {len(law.properties)} properties, {law.depvar} states"
        if isinstance(law, ExponentialDecay):
            source = " (from test data)" if law.test_data else ""
            return f"exponential decay: mus {law.mus:g}, muk {law.muk:g}, dc {law.dc:g}{source}"
        first = law.rows[0]
        names = ("mu1", "mu2") if self.anisotropic else ("mu",)
        if law.constant:
            return ", ".join(f"{n} = {v:g}" for n, v in zip(names, first.mu, strict=True))
        variables = ["rate", "pressure", "temperature"]
        variables += [f"field {i + 1}" for i in range(law.dependencies)]
        used = [
            name for k, name in enumerate(variables) if len({row.place[k] for row in law.rows}) > 1
        ]
        return f"{', '.join(names)} by {', '.join(used)}: {len(law.rows)} points"

    def describe_more(self) -> str:
        """Enforcement and limits in one line, for people."""
        words = []
        if isinstance(self.method, Lagrange):
            words.append("Lagrange multipliers")
        elif isinstance(self.method, ElasticSlip):
            words.append(f"elastic slip {self.method.value:g}")
        elif isinstance(self.method, SlipTolerance):
            words.append(f"slip tolerance {self.method.value:g}")
        if self.taumax is not None:
            words.append(f"shear stress up to {self.taumax:g}" if self.taumax else "no limit")
        if self.shear_traction_slope is not None:
            words.append(f"shear traction slope {self.shear_traction_slope:g}")
        if self.stick_slope is not None:
            words.append(f"stick slope {self.stick_slope:g}")
        return ", ".join(words)

    # What runs today; the rules stand in `usersub/deck/running.py`.

    @property
    def not_runnable(self) -> str:
        """Why no driver carries this friction; "" where one does."""
        from usersub.deck.running import plan

        return plan(self).reason

    @property
    def interface(self) -> str:
        """Interface behind which it runs; "" where it does not run."""
        from usersub.deck.running import plan

        return plan(self).interface

    def scene_settings(self) -> dict[str, Any]:
        """Settings for `usersub.Scene`, with `props`.

        Raises:
            DeckError: it does not run; the message says why.
        """
        from usersub.deck.running import scene_settings

        return scene_settings(self)

    def routine(
        self, path: Any = None, *, language: str = "python", precision: str = "double"
    ) -> Routine:
        """The routine that carries it: that of a shipped law, or of the file `path` for USER.

        Raises:
            DeckError: it does not run, or `path` is missing or without use.
            LoadError, CompileError, MissingTool: as `usersub.load`.
        """
        from usersub.deck.running import routine

        return routine(self, path, language=language, precision=precision)

    def acting(self, path: Any = None, *, language: str = "python") -> interaction.Friction:
        """The friction as `usersub.Interaction` takes it; arguments and errors as `routine`."""
        from usersub.deck.running import acting

        return acting(self, path, language=language)


def decay_from_test_data(
    mu1: float, mu2: float, rate2: float, mu_inf: float | None = None
) -> ExponentialDecay:
    """Exponential decay from two or three measured points, as `usersub.laws.decay_data.decay`.

    Raises:
        SceneError (a ValueError): no exponential decay goes through the points, and why.
    """
    from usersub.laws.decay_data import decay

    mus, muk, dc = decay(mu1, mu2, rate2, mu_inf)
    return ExponentialDecay(mus, muk, dc, TestData(mu1, mu2, rate2, mu_inf))
