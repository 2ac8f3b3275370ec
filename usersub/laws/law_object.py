# SPDX-License-Identifier: MIT
"""A law with its properties: `usersub.laws.coulomb(mu=0.3)`. Any driver takes it as a routine."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from usersub.errors import SceneError
from usersub.laws.values import array, hint, nested, number, unflat

if TYPE_CHECKING:
    from usersub.laws.description import Law
    from usersub.routine.routine import Routine


class LawObject:
    """A shipped law with values of its properties. Immutable; `replace` makes a changed copy.

    Attributes:
        law: what the law says of itself.
        values: properties as given, by name (defaults included).
        props: all numbers in the order of the routine's properties.
        language: language of the routines that drivers take: "python", "c" or "fortran".
    """

    __slots__ = ("language", "law", "props", "values")

    law: Law
    values: Mapping[str, object]
    props: tuple[float, ...]
    language: str

    def __init__(self, law: Law, values: Mapping[str, object], language: str = "python") -> None:
        from usersub.laws.registry import LANGUAGES

        if language not in LANGUAGES:
            raise SceneError(
                f"{law.name}: language '{language}'; expected one of {', '.join(LANGUAGES)}"
            )
        checked, props = _checked(law, values)
        for name, value in (("law", law), ("values", checked), ("props", props)):
            object.__setattr__(self, name, value)
        object.__setattr__(self, "language", language)

    @property
    def name(self) -> str:
        """Name of the law."""
        return self.law.name

    @property
    def kind(self) -> str:
        """What it gives: "coefficient", "strength", "traction" or "bristle"."""
        return self.law.kind

    @property
    def equation(self) -> str:
        """The equation in one line."""
        return self.law.equation

    @property
    def interfaces(self) -> tuple[str, ...]:
        """Interfaces that can carry it."""
        return self.law.interfaces

    @property
    def anisotropic(self) -> bool:
        """Whether it gives two coefficients."""
        return self.law.anisotropic

    def behind(
        self, interface: str, language: str | None = None, precision: str = "double"
    ) -> Routine:
        """The routine of the law behind one interface; its properties go into the scene.

        Raises:
            LoadError: the interface cannot carry the law, or does not exist in this precision.
        """
        from usersub.laws.registry import routine

        return routine(self.name, interface, language or self.language, precision=precision)

    def states(
        self,
        interface: str,
        directions: int = 2,
        dimension: int = 3,
        props: Sequence[float] | None = None,
    ) -> int:
        """State variables that `interface` needs (`Scene(states=...)`)."""
        used = self.props if props is None else props
        return self.law.state_count(interface, directions, dimension, used)

    def in_language(self, language: str) -> LawObject:
        """The same law, of which drivers take the routines in another language."""
        return LawObject(self.law, self.values, language)

    def replace(self, **changes: object) -> LawObject:
        """A copy in which properties have other values."""
        return LawObject(self.law, {**self.values, **changes}, self.language)

    def __setattr__(self, key: str, value: object) -> None:
        raise AttributeError(f"a law cannot be changed; use replace({key}=...)")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, LawObject):
            return NotImplemented
        return (self.name, self.props, self.language) == (other.name, other.props, other.language)

    def __hash__(self) -> int:
        return hash((self.name, self.props, self.language))

    def __reduce__(self) -> tuple:
        return _restore, (self.name, dict(self.values), self.language)

    def __repr__(self) -> str:
        given = ", ".join(f"{name}={_short(value)}" for name, value in self.values.items())
        text = f"usersub.laws.{self.name}({given})"
        return text if self.language == "python" else f"{text}.in_language({self.language!r})"


def _restore(name: str, values: dict[str, object], language: str) -> LawObject:
    from usersub.laws.registry import law

    return LawObject(law(name), values, language)


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 200 else f"{text[:190]} ...]"


def make(law: Law, arguments: Sequence[object], named: Mapping[str, object]) -> LawObject:
    """The law with properties by position and by name.

    Raises:
        SceneError: unknown, missing or twice given property, wrong type or shape, out of range.
    """
    names = law.positional
    if len(arguments) > len(names):
        raise SceneError(
            f"{law.name} got {len(arguments)} properties by position; expected at most "
            f"{len(names)}, the signature is {law.name}{law.__signature__}"
        )
    values = dict(zip(names, arguments, strict=False))
    for name, value in named.items():
        if name in values:
            raise SceneError(f"{law.name}: the property '{name}' is given twice")
        values[name] = value
    return LawObject(law, values)


def from_numbers(law: Law, props: Sequence[float]) -> LawObject:
    """The law with all its properties as numbers, in their order.

    Raises:
        SceneError: too few, too many, or out of range.
    """
    values: dict[str, object] = {}
    known: dict[str, object] = {}
    place = 0
    for prop in law.props:
        if (prop.size_of or prop.sizes_of) and not all(
            x == int(x) and 0 <= x <= len(props) for x in props[place : place + prop.count(known)]
        ):
            raise SceneError(
                f"{law.name}: {prop.name} = {props[place]:g}; expected a count ({prop.meaning})"
            )
        count = prop.count(known)
        part = list(props[place : place + count])
        if len(part) < count:
            raise SceneError(
                f"{law.name} got {len(props)} properties; expected at least {place + count}, "
                f"up to '{prop.name}' ({prop.meaning})"
            )
        known[prop.name] = tuple(part) if prop.shape else part[0]
        if prop.lists:
            sizes = next(p for p in law.props if p.sizes_of == prop.name)
            rest = iter(part)
            lengths = known[sizes.name]
            values[prop.name] = [[next(rest) for _ in range(int(n))] for n in lengths]  # type: ignore[attr-defined]
        elif prop.given:
            values[prop.name] = unflat(part, prop.extents(known)) if prop.shape else part[0]
        place += count
    if place != len(props):
        raise SceneError(f"{law.name} got {len(props)} properties; expected {place}")
    return LawObject(law, values)


def _checked(
    law: Law, values: Mapping[str, object]
) -> tuple[Mapping[str, object], tuple[float, ...]]:
    """Values by name in their order, and all properties."""
    from types import MappingProxyType

    _check_names(law, values)
    given: dict[str, Any] = {}
    for prop in law.props:
        if prop.given:
            value = values.get(prop.name, prop.default)
            given[prop.name] = nested(law, prop, value) if prop.shape else value
    known: dict[str, object] = {}
    props: list[float] = []
    for prop in law.props:
        if prop.size_of:
            flat = [float(len(given[prop.size_of]))]
        elif prop.sizes_of:
            flat = [float(len(part)) for part in given[prop.sizes_of]]
        elif prop.shape:
            flat = array(law, prop, given[prop.name], known)
        else:
            flat = [number(law, prop, given[prop.name])]
            given[prop.name] = flat[0]
        known[prop.name] = tuple(flat) if prop.shape else flat[0]
        props += flat
    return MappingProxyType(given), tuple(props)


def _check_names(law: Law, values: Mapping[str, object]) -> None:
    names = [p.name for p in law.props if p.given]
    for name in values:
        if name not in names:
            counted = next((p for p in law.props if p.name == name), None)
            told = hint(name, names)
            if counted is not None:
                told = f"; it is counted from '{counted.size_of or counted.sizes_of}'."
            raise SceneError(
                f"{law.name} has no property '{name}'{told} "
                f"Properties: {', '.join(names) or 'none'}"
            )
    missing = [p for p in law.props if p.given and p.default is None and p.name not in values]
    if missing:
        told = ", ".join(f"'{p.name}' ({p.meaning}, unit {p.unit})" for p in missing)
        raise SceneError(f"{law.name} needs {told}; {len(values)} of its properties are given")
