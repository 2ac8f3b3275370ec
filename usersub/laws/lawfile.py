# SPDX-License-Identifier: MIT
"""Reads a `law.toml`, strictly: messages name file, table, key, value and what is expected."""

from __future__ import annotations

import difflib
import keyword
import math
import tomllib
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from usersub import abi
from usersub.errors import LoadError
from usersub.laws import counting
from usersub.laws.description import KINDS, QUANTITIES, Law
from usersub.laws.parts import Accuracy, Prop, Range, Variable

#: Cases of which every law has to say something, and those of a law that depends on the rate.
CASES = ("zero pressure", "negative pressure")
RATE_CASES = ("zero rate", "infinite rate")


def _number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _texts(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(v, str) and v.strip() for v in value)


_KINDS: dict[str, tuple[Callable[[Any], bool], str]] = {
    "text": (lambda v: isinstance(v, str) and bool(v.strip()), "a text"),
    "texts": (lambda v: _texts(v), "an array of texts"),
    "lines": (lambda v: (isinstance(v, str) and bool(v.strip())) or (_texts(v) and bool(v)),
              "a text or an array of texts"),
    "number": (_number, "a finite number"),
    "numbers": (lambda v: isinstance(v, list) and all(map(_number, v)), "an array of numbers"),
    "value": (lambda v: _number(v) or isinstance(v, list), "a number or an array"),
    "truth": (lambda v: isinstance(v, bool), "true or false"),
    "table": (lambda v: isinstance(v, dict), "a table"),
    "tables": (lambda v: isinstance(v, list) and all(isinstance(t, dict) for t in v),
               "an array of tables"),
    "pairs": (lambda v: isinstance(v, list) and all(_texts(p) and len(p) == 2 for p in v),
              "an array of pairs [case, what holds there]"),
}  # fmt: skip

#: Keys by table: kind of the value, and whether it is required.
_TOP = {
    "title": ("text", True), "kind": ("text", True), "equation": ("lines", True),
    "source": ("text", True), "reads": ("texts", False), "limits": ("pairs", True),
    "props": ("tables", False), "example": ("table", False), "symbols": ("tables", False),
    "states": ("tables", False), "vectors": ("tables", False), "notes": ("texts", False),
    "anisotropic": ("truth", False), "accuracy": ("table", False), "refusals": ("table", False),
}  # fmt: skip
_VARIABLE = {
    "name": ("text", True), "unit": ("text", True), "meaning": ("text", True),
    "count": ("text", False),
}  # fmt: skip
_BOUNDS = ("at_least", "above", "at_most", "below")
_PROP = {
    **_VARIABLE, **dict.fromkeys(_BOUNDS, ("number", False)), "whole": ("truth", False),
    "choices": ("numbers", False), "default": ("value", False), "size_of": ("text", False),
    "sizes_of": ("text", False), "shape": ("texts", False), "lists": ("truth", False),
    "ascending": ("truth", False), "fitted": ("truth", False),
}  # fmt: skip
_ACCURACY = {"ulp": ("number", False), "single_ulp": ("number", False), "why": ("text", True)}


class _Reader:
    """Errors and checks of one file."""

    def __init__(self, path: Path):
        self.path = path

    def error(self, place: str, text: str) -> LoadError:
        """An error that begins with file and table."""
        return LoadError(f"{self.path}: {place + ' ' if place else ''}{text}")

    def table(self, place: str, data: dict[str, Any], schema: Mapping) -> dict[str, Any]:
        """`data`, when its keys and values are those of `schema`."""
        for key, value in data.items():
            if key not in schema:
                raise self.error(place, f"has no key '{key}'{_hint(key, schema)}")
            check, words = _KINDS[schema[key][0]]
            if not check(value):
                raise self.error(place, f"{key} = {value!r}; expected {words}")
        for key, (kind, required) in schema.items():
            if required and key not in data:
                raise self.error(place, f"needs the key '{key}' ({_KINDS[kind][1]})")
        return data

    def one_of(self, place: str, key: str, value: str, known: Iterable[str]) -> str:
        """`value`, when it is one of `known`."""
        names = list(known)
        if value not in names:
            listed = ", ".join(names) or "none"
            raise self.error(
                place, f"{key} = '{value}'{_hint(value, names)} Expected one of: {listed}"
            )
        return value


def _hint(word: str, known: Iterable[str]) -> str:
    near = difflib.get_close_matches(word, list(known), n=1, cutoff=0.5)
    return f"; did you mean '{near[0]}'?" if near else "."


def read(path: Path) -> Law:
    """The law that the file `path` describes.

    Raises:
        LoadError: the file is missing or says what cannot be.
    """
    reader = _Reader(path)
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise LoadError(f"there is no file {path}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise LoadError(f"{path}: is not TOML: {error}") from error
    reader.table("", data, _TOP)
    kind = reader.one_of("", "kind", data["kind"], KINDS)
    reads = tuple(reader.one_of("", "reads", r, QUANTITIES) for r in data.get("reads", ()))
    props = _props(reader, data.get("props", []))
    known = [p.name for p in props]
    equation = data["equation"]
    law = Law(
        name=path.parent.name,
        folder=path.parent,
        title=data["title"],
        kind=kind,
        equations=(equation,) if isinstance(equation, str) else tuple(equation),
        source=data["source"],
        reads=reads,
        props=props,
        example=data.get("example", {}),
        symbols=_variables(reader, "symbols", data, ()),
        states=_variables(reader, "states", data, known),
        vectors=_variables(reader, "vectors", data, known),
        limits=tuple((case, what) for case, what in data["limits"]),
        notes=tuple(data.get("notes", ())),
        refusals=data.get("refusals", {}),
        anisotropic=data.get("anisotropic", False),
        accuracy=Accuracy(**reader.table("[accuracy]", data["accuracy"], _ACCURACY))
        if "accuracy" in data
        else Accuracy(),
    )
    _check(reader, law)
    return law


def _check(reader: _Reader, law: Law) -> None:
    """Refuses what single keys do not show."""
    for name, reason in law.refusals.items():
        reader.one_of("[refusals]", "interface", name, abi.NAMES)
        if not _KINDS["text"][0](reason):
            raise reader.error("[refusals]", f"{name} = {reason!r}; expected a text")
    rate = "slip_rate" in law.reads or law.kind == "bristle"
    for case in (*(RATE_CASES if rate else ()), *CASES):
        if case not in [c for c, _ in law.limits]:
            raise reader.error("", f"limits say nothing of the case '{case}'")
    if law.anisotropic and law.kind != "coefficient":
        raise reader.error("", f"anisotropic = true, but the kind is '{law.kind}'")
    if law.vectors and law.kind != "bristle":
        raise reader.error("", f"vectors are for bristle laws; this one is a {law.kind} law")
    if not law.interfaces:
        raise reader.error("", "no interface is left that could carry the law")
    given = [p for p in law.props if p.given]
    for name in law.example:
        reader.one_of("[example]", "property", name, [p.name for p in given])
    for prop in given:
        if prop.default is None and prop.name not in law.example:
            raise reader.error("[example]", f"needs a value of '{prop.name}'")


def _props(reader: _Reader, tables: list[dict[str, Any]]) -> tuple[Prop, ...]:
    found: list[Prop] = []
    names = [str(t.get("name")) for t in tables]
    for number, table in enumerate(tables, 1):
        place = f"[[props]] {number}"
        data = dict(reader.table(place, table, _PROP))
        place = f"[[props]] '{data['name']}'"
        _check_name(reader, place, data["name"], [p.name for p in found])
        shape = tuple(data.pop("shape", ()))
        if "count" in data:
            if shape:
                raise reader.error(place, "has both 'count' and 'shape'; expected one of them")
            shape = (data.pop("count"),)
        for part in shape:
            _check_count(reader, place, part.removeprefix("*"), [p.name for p in found])
        for key in ("size_of", "sizes_of"):
            if key in data:
                reader.one_of(place, key, data[key], names)
        default = data.pop("default", None)
        if isinstance(default, list):
            default = tuple(default)
        if default is not None and bool(shape) != isinstance(default, tuple):
            raise reader.error(place, f"default = {default!r} does not fit its shape {shape}")
        limits = {key: data.pop(key) for key in (*_BOUNDS, "whole") if key in data}
        within = Range(**limits, choices=tuple(data.pop("choices", ())))
        found.append(Prop(**data, range=within, shape=shape, default=default))
    return tuple(found)


def _variables(reader: _Reader, key: str, data: dict[str, Any], known: Iterable[str]) -> tuple:
    found = []
    for number, table in enumerate(data.get(key, []), 1):
        place = f"[[{key}]] {number}"
        reader.table(place, table, _VARIABLE)
        _check_count(reader, place, table.get("count", "1"), known)
        found.append(Variable(**table))
    return tuple(found)


def _check_name(reader: _Reader, place: str, name: str, earlier: list[str]) -> None:
    """Names of properties are arguments of law objects."""
    if not name.isidentifier() or keyword.iskeyword(name):
        raise reader.error(place, f"name = '{name}'; expected letters, digits and underscores")
    if name in earlier:
        raise reader.error(place, "stands twice")


def _check_count(reader: _Reader, place: str, expression: str, known: Iterable[str]) -> None:
    try:
        used = counting.names(expression)
    except SyntaxError:
        raise reader.error(place, f"'{expression}' is no sum or product of properties") from None
    for name in used:
        reader.one_of(place, "count", name, known)
