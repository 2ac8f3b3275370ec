# SPDX-License-Identifier: MIT
"""What a law says of itself: the content of a `law.toml`, and what follows from it."""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from usersub import abi
from usersub.errors import LoadError
from usersub.laws.counting import evaluate
from usersub.laws.parts import Accuracy, Prop, Variable

if TYPE_CHECKING:
    from usersub.laws.law_object import LawObject

#: What the point function of a kind gives, and the symbol that the READMEs use for it.
KINDS = {
    "coefficient": ("mu", "-", "friction coefficient"),
    "strength": ("tau_crit", "stress", "critical shear stress"),
    "traction": ("tau", "stress", "shear traction along the slip"),
    "bristle": ("tau", "stress", "shear traction, two components"),
    "stick": ("tau", "stress", "shear traction that keeps the point from slipping"),
}

#: Symbol, unit and meaning of what a law can read.
QUANTITIES = {
    "slip_rate": ("rate", "length/time", "magnitude of the slip rate"),
    "pressure": ("p", "stress", "contact pressure"),
    "temperature": ("T", "temperature", "mean temperature of both surfaces"),
    "fields": ("f1, f2, ...", "any", "means of the field variables of both surfaces"),
    "slip_increment": ("ds", "length", "magnitude of the plastic slip of the increment"),
    "time_increment": ("dt", "time", "time increment"),
    "motion": ("x", "length", "sliding motion of the increment, one or two components"),
}

_NO_COEFFICIENT = {
    "strength": "a strength that does not vanish with the pressure is no coefficient times "
    "pressure",
    "traction": "a viscous traction is no coefficient times pressure",
    "bristle": "a traction with a state of its own is no coefficient times pressure",
    "stick": "no coefficient keeps a point from slipping",
}
_ONE_COEFFICIENT = "the explicit interface takes one direction of slip and one coefficient"
_NO_STATES = "VFRIC_COEF has no state variables"


@dataclass(frozen=True, repr=False, eq=False)
class Law:
    """One law, as its `law.toml` describes it.

    Attributes:
        name: name of its folder, which is `folder`.
        title: one line.
        kind: one of `KINDS`.
        equations: lines of its equation.
        reads: names of `QUANTITIES` that it depends on.
        props: its properties in their order.
        example: values of the properties for a first try, by name.
        symbols: further symbols of the equation.
        states, vectors: scalar and vector state variables.
        limits: pairs of case and behaviour.
        notes: further sentences.
        source: where it comes from.
        refusals: why an interface cannot carry it, by interface.
        anisotropic: whether it gives two coefficients.
        accuracy: what its results keep.
    """

    name: str
    folder: Path
    title: str
    kind: str
    equations: tuple[str, ...]
    source: str
    reads: tuple[str, ...] = ()
    props: tuple[Prop, ...] = ()
    example: Mapping[str, object] = field(default_factory=dict)
    symbols: tuple[Variable, ...] = ()
    states: tuple[Variable, ...] = ()
    vectors: tuple[Variable, ...] = ()
    limits: tuple[tuple[str, str], ...] = ()
    notes: tuple[str, ...] = ()
    refusals: Mapping[str, str] = field(default_factory=dict)
    anisotropic: bool = False
    accuracy: Accuracy = Accuracy()

    @property
    def equation(self) -> str:
        """The equation in one line."""
        return "; ".join(self.equations)

    @property
    def interfaces(self) -> tuple[str, ...]:
        """Interfaces that can carry it."""
        return tuple(name for name in abi.NAMES if not self.refusal(name))

    def __call__(self, *arguments: object, **named: object) -> LawObject:
        """The law with values of its properties, by position or by name: what drivers take.

        Raises:
            SceneError: unknown, missing or twice given property, wrong type or shape, out of range.
        """
        from usersub.laws.law_object import make

        return make(self, arguments, named)

    def of(self, props: Sequence[float]) -> LawObject:
        """The law with all its properties as numbers, in their order.

        Raises:
            SceneError: too few, too many, or out of range.
        """
        from usersub.laws.law_object import from_numbers

        return from_numbers(self, props)

    @property
    def __signature__(self) -> inspect.Signature:
        kind, empty = inspect.Parameter, inspect.Parameter.empty
        positional = self.positional
        return inspect.Signature(
            [
                kind(
                    p.name,
                    kind.POSITIONAL_OR_KEYWORD if p.name in positional else kind.KEYWORD_ONLY,
                    default=empty if p.default is None else p.default,
                )
                for p in self.props
                if p.given
            ]
        )

    @property
    def positional(self) -> list[str]:
        """Properties that may be given by position: those before the first with a default."""
        given = [p for p in self.props if p.given]
        defaults = [i for i, p in enumerate(given) if p.default is not None]
        return [p.name for p in given[: defaults[0] if defaults else None]]

    def __repr__(self) -> str:
        return f"<law {self.name}{self.__signature__}: {self.equation}>"

    def refusal(self, interface: str) -> str:
        """Why `interface` cannot carry it; "" where it can."""
        if interface in self.refusals:
            return self.refusals[interface]
        if interface in ("fric_coef", "vfric_coef") and self.kind in _NO_COEFFICIENT:
            return _NO_COEFFICIENT[self.kind]
        if self.anisotropic and interface.startswith("v"):
            return _ONE_COEFFICIENT
        if interface == "vfric_coef" and self.states:
            return _NO_STATES
        return ""

    def check(self, interface: str) -> None:
        """Refuses an interface that cannot carry the law.

        Raises:
            LoadError: it cannot; the message says why.
        """
        reason = self.refusal(interface) if interface in abi.NAMES else "there is no such interface"
        if reason:
            raise LoadError(
                f"the law {self.name} does not stand behind {interface.upper()}: {reason}; "
                f"its interfaces are {', '.join(i.upper() for i in self.interfaces)}"
            )

    def values(self, props: Sequence[float]) -> dict[str, object]:
        """The numbers `props` by name: a float, or a tuple for an array.

        Raises:
            LoadError: they are too few.
        """
        found: dict[str, object] = {}
        place = 0
        for prop in self.props:
            count = prop.count(found)
            part = tuple(props[place : place + count])
            if len(part) < count:
                raise LoadError(
                    f"the law {self.name} has {len(props)} properties; expected at least "
                    f"{place + count}, up to '{prop.name}'"
                )
            found[prop.name] = part if prop.shape else part[0]
            place += count
        return found

    def count(self, props: Sequence[float] = ()) -> tuple[int, int]:
        """How many vector and scalar state variables it has with these properties."""
        counted = (*self.vectors, *self.states)
        known = self.values(props) if any(not v.count.isdecimal() for v in counted) else {}
        return (
            sum(evaluate(v.count, known) for v in self.vectors),
            sum(evaluate(v.count, known) for v in self.states),
        )

    def state_count(
        self, interface: str, directions: int = 2, dimension: int = 3, props: Sequence[float] = ()
    ) -> int:
        """State variables that `interface` needs for it.

        Args:
            directions: friction directions (NFDIR), for FRIC.
            dimension: dimension of the model (nDir), for VFRIC and VFRICTION.
            props: its properties.
        """
        vectors, scalars = self.count(props)
        if interface == "fric":
            own = self.kind in ("coefficient", "strength")  # the elastic slip
            return directions * (vectors + own) + scalars
        return (dimension * vectors if interface in ("vfric", "vfriction") else 0) + scalars
