# SPDX-License-Identifier: MIT
"""Strict reading of TOML tables: messages name file, table, key, value and what is expected."""

from __future__ import annotations

import difflib
import json
import math
from collections.abc import Iterable
from typing import Any

from usersub.errors import SceneError

_REQUIRED = object()
_INT_END = 2**31


def nearest(word: str, known: Iterable[str]) -> str:
    """The hint "; did you mean 'x'?", or "" where nothing is near."""
    near = difflib.get_close_matches(word.lower(), {k.lower(): k for k in known}, n=1, cutoff=0.5)
    if not near:
        return ""
    spelled = next(k for k in known if k.lower() == near[0])
    return f"; did you mean '{spelled}'?"


def show(value: object) -> str:
    """A value as it stands in a TOML file, shortened."""
    try:
        text = json.dumps(value)
    except (TypeError, ValueError):
        text = str(value)
    return text if len(text) <= 60 else text[:57] + "..."


class Table:
    """One table of a scene file; keys are taken one by one, what is left over is an error.

    Attributes:
        file: how the file is called in messages.
        name: how the table is called in messages: "[scene]", or "" for the top of the file.
        data: what TOML gave.
    """

    def __init__(self, file: str, name: str, data: dict[str, Any]) -> None:
        self.file, self.name, self.data = file, name, data
        self._taken: list[str] = []

    def error(self, text: str) -> SceneError:
        """An error that begins with file and table."""
        return SceneError(f"{self.file}: {self.name + ' ' if self.name else ''}{text}")

    def has(self, key: str) -> bool:
        """Whether the file gives `key`."""
        return key in self.data

    def take(self, key: str, kind: str, default: Any = _REQUIRED, choices: tuple = ()) -> Any:
        """The value of `key`, checked.

        Args:
            key: name of the key.
            kind: "int", "real", "text", "truth", "table", "numbers" (array of numbers),
                "plain" (no array and no table) or "any".
            default: used where the file has no such key; without one the key is required.
            choices: what a text may be.
        """
        self._taken.append(key)
        if key not in self.data:
            if default is _REQUIRED:
                raise self.error(f"needs the key '{key}' ({_WORDS[kind]})")
            return default
        value = self.data[key]
        if not _CHECKS[kind](value):
            words = _WORDS[kind]
            if kind == "int" and isinstance(value, int) and not isinstance(value, bool):
                words = f"smaller than {_INT_END}"
            raise self.error(f"{key} = {show(value)} must be {words}")
        if choices and value not in choices:
            hint = nearest(value, choices) or "."
            raise self.error(f"{key} = {show(value)} must be one of {', '.join(choices)}{hint}")
        return float(value) if kind == "real" else value

    def table(self, key: str) -> Table | None:
        """The table `key`, or None where the file has none."""
        data = self.take(key, "table", None)
        return None if data is None else Table(self.file, f"[{key}]", data)

    def finish(self, known: Iterable[str] = ()) -> None:
        """Refuses keys that nobody took; `known` adds names for the hint."""
        for key in self.data:
            if key not in self._taken:
                names = dict.fromkeys((*self._taken, *known))
                what = f"the table [{key}]" if isinstance(self.data[key], dict) else f"key '{key}'"
                place = self.name or "the scene file"
                hint = nearest(key, names) or "."
                raise SceneError(
                    f"{self.file}: {place} has no {what.removeprefix('the ')}{hint} "
                    f"Known: {', '.join(names)}"
                )


def is_number(value: object) -> bool:
    """A finite number, and no truth value."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:  # an integer that no float holds
        return False


def _is_int(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and abs(value) < _INT_END


_CHECKS = {
    "int": _is_int,
    "real": is_number,
    "text": lambda v: isinstance(v, str),
    "truth": lambda v: isinstance(v, bool),
    "table": lambda v: isinstance(v, dict),
    "numbers": lambda v: isinstance(v, list) and all(is_number(x) for x in v),
    "plain": lambda v: is_number(v) or isinstance(v, (str, bool)),
    "any": lambda v: True,
}

_WORDS = {
    "int": "an integer",
    "real": "a finite number",
    "text": "text",
    "truth": "true or false",
    "table": "a table",
    "numbers": "an array of finite numbers",
    "plain": "a finite number, text, true or false",
    "any": "any value",
}
