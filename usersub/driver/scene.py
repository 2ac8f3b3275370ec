# SPDX-License-Identifier: MIT
"""Scenes: what a host's model has, checked when it is written down."""

from __future__ import annotations

import difflib
import inspect
import math
import numbers
import operator
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from usersub import ports
from usersub.errors import SceneError

_SETTINGS = {setting.key: setting for setting in ports.SETTINGS}
_INT_MAX = 2**31 - 1
_TEXT_LENGTH = 80


class Scene(Mapping[str, Any]):
    """What a host's model has. Immutable; `replace` makes a changed copy.

    The settings and their meaning stand in `usersub.ports.SETTINGS` and in the manual ("Settings of
    a scene"); every setting is also an attribute and a key.

    Args:
        props: properties of the routine (PROPS), any sequence of real numbers.
        settings: settings by name.

    Raises:
        SceneError: unknown setting, wrong type, value out of range.
    """

    __slots__ = ("_values", "props")

    _values: dict[str, Any]
    props: tuple[float, ...]

    def __init__(self, *, props: Iterable[float] = (), **settings: object) -> None:
        values: dict[str, Any] = {s.key: s.default for s in ports.SETTINGS}
        values.update({key: _checked(key, value) for key, value in settings.items()})
        object.__setattr__(self, "_values", values)
        object.__setattr__(self, "props", _checked_props(props))

    def replace(self, **changes: object) -> Scene:
        """A copy in which `changes` (settings or `props`) are different."""
        settings: dict[str, Any] = {**self._values, "props": self.props, **changes}
        return Scene(**settings)

    def __getattr__(self, key: str) -> Any:
        if key in _SETTINGS:
            return self._values[key]
        raise AttributeError(f"a scene has no setting '{key}'{_hint(key)}")

    def __setattr__(self, key: str, value: object) -> None:
        raise AttributeError(f"a scene cannot be changed; use scene.replace({key}=...)")

    def __getitem__(self, key: str) -> Any:
        return self._values[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scene):
            return NotImplemented
        return self._values == other._values and self.props == other.props

    def __hash__(self) -> int:
        return hash((tuple(self._values.items()), self.props))

    def __reduce__(self) -> tuple:
        return _restore, (dict(self._values), self.props)

    def __repr__(self) -> str:
        changed = [f"{k}={v!r}" for k, v in self._values.items() if v != _SETTINGS[k].default]
        if self.props:
            changed.append(f"props={list(self.props)!r}")
        return f"Scene({', '.join(changed)})"


def _restore(values: dict, props: tuple[float, ...]) -> Scene:
    return Scene(props=props, **values)


def _hint(key: str) -> str:
    near = difflib.get_close_matches(key, [*_SETTINGS, "props"], n=1, cutoff=0.5)
    return f"; did you mean '{near[0]}'?" if near else ""


def _checked(key: str, value: object) -> int | float | str:
    """`value` as a setting called `key`, or SceneError."""
    setting = _SETTINGS.get(key)
    if setting is None:
        raise SceneError(
            f"no scene setting is called '{key}'{_hint(key) or '.'} "
            f"Settings: props, {', '.join(_SETTINGS)}"
        )
    if setting.kind == "text":
        return _checked_text(setting, value)
    if setting.kind == "int":
        return _checked_int(setting, value)
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise SceneError(f"scene setting '{key}' = {value!r}; expected a real number")
    number = float(value)
    if not (math.isfinite(number) and number >= 0.0):
        raise SceneError(f"scene setting '{key}' = {number}; expected a finite value of 0 or more")
    return number


def _checked_int(setting: ports.Setting, value: object) -> int:
    try:
        if isinstance(value, bool):
            raise TypeError
        number = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise SceneError(
            f"scene setting '{setting.key}' = {value!r}; expected an integer"
        ) from None
    if not 0 <= number <= _INT_MAX:
        raise SceneError(f"scene setting '{setting.key}' = {number}; expected 0 to {_INT_MAX}")
    return number


def _checked_text(setting: ports.Setting, value: object) -> str:
    if not isinstance(value, str):
        raise SceneError(f"scene setting '{setting.key}' = {value!r}; expected a text")
    if setting.choices and value not in setting.choices:
        near = difflib.get_close_matches(value, setting.choices, n=1, cutoff=0.5)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        raise SceneError(
            f"scene setting '{setting.key}' = '{value}'; "
            f"expected one of {', '.join(setting.choices)}{hint}"
        )
    if not value.isascii() or "\0" in value:
        raise SceneError(f"scene setting '{setting.key}' = {value!r}; expected ASCII characters")
    if len(value) > _TEXT_LENGTH:
        raise SceneError(
            f"scene setting '{setting.key}' has {len(value)} characters; "
            f"expected at most {_TEXT_LENGTH}"
        )
    return value


def _checked_props(props: Iterable[float]) -> tuple[float, ...]:
    if isinstance(props, str | bytes) or not isinstance(props, Iterable):
        raise SceneError(f"props = {props!r}; expected a sequence of real numbers")
    checked: list[float] = []
    for index, value in enumerate(props):
        if isinstance(value, bool) or not isinstance(value, numbers.Real):
            raise SceneError(f"props[{index}] = {value!r}; expected a real number")
        if math.isnan(value):
            raise SceneError(f"props[{index}] is NaN; expected a number")
        checked.append(float(value))
    return tuple(checked)


def _signature() -> inspect.Signature:
    keyword = inspect.Parameter.KEYWORD_ONLY
    settings = [inspect.Parameter(s.key, keyword, default=s.default) for s in ports.SETTINGS]
    return inspect.Signature([*settings, inspect.Parameter("props", keyword, default=())])


Scene.__signature__ = _signature()  # type: ignore[attr-defined]
