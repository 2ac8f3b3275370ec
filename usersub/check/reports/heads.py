# SPDX-License-Identifier: MIT
"""The head of a report: what was checked, with what, at which values."""

from __future__ import annotations

import platform
from dataclasses import fields
from datetime import datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING

from usersub import abi
from usersub.check.reports.report import Head, Value
from usersub.check.words import around_in_words
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.subject import Subject
    from usersub.routine.build import Build


def head_of(subject: Subject) -> Head:
    """The head for a subject, with the date of now."""
    build = _build(subject)
    language = language_of(subject)
    return Head(
        routine=subject.name,
        file=str(subject.path or (subject.routine.origin if subject.routine else "")),
        interface=subject.interface.name,
        generation=subject.interface.generation,
        precision=subject.precision,
        language=language,
        compiler=build.compiler if build else _numba(language),
        flags=build.flags if build else (),
        versions=versions(),
        abi_version=abi.ABI_VERSION,
        abi_hash=abi.abi_hash(),
        date=datetime.now().astimezone().isoformat(timespec="seconds"),
        values=tuple(_values(subject)) if subject.routine else (),
        law=subject.law,
    )


@cache
def versions() -> dict[str, str]:
    """Versions of usersub, Python, numpy and numba; a package that is not there is left out."""
    found = {"usersub": "", "Python": platform.python_version(), "numpy": "", "numba": ""}
    for name in ("usersub", "numpy", "numba"):
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            del found[name]
    return found


def _build(subject: Subject) -> Build | None:
    code = subject.file.code if subject.file is not None else None
    if code is None:
        return None
    try:
        return code.build(subject.precision)
    except Error:
        return None


def _numba(language: str) -> str:
    return f"numba {versions().get('numba', '')}".strip() if language == "python" else ""


def language_of(subject: Subject) -> str:
    """Language of the routine, also of one that could not be loaded; "" if it is not known."""
    from usersub.routine.loading import _language as of_file

    if subject.routine is not None:
        return subject.routine.language
    if subject.path is None:
        return ""
    try:
        return of_file(subject.path)
    except Error:
        return ""


def _values(subject: Subject) -> list[Value]:
    origin = subject.origin
    shown = {
        "props": _numbers(subject.props) or "none",
        "states": str(subject.states),
        "fields": str(subject.fields),
        "temperatures": "yes" if subject.temperatures else "no",
    }
    if subject.interface.name == "fric_coef":
        shown["anisotropic"] = "yes" if subject.anisotropic else "no"
    if _places(subject):
        shown["names, steps"] = _places(subject)
    words = {"props": "properties", "states": "state variables", "fields": "field variables"}
    made = [
        Value(words.get(k, k), v, origin.get(k.partition(",")[0], "default"))
        for k, v in shown.items()
    ]
    if "files" in origin:
        made.append(Value("files", origin["files"], "named in the source; copied for each rule"))
    if "start" in origin:
        made.append(Value("before contact", origin["start"], ""))
    scales = []
    for entry in fields(subject.scales):
        value = getattr(subject.scales, entry.name)
        if entry.name == "fields" and not value:
            continue
        said = origin.get(f"scales.{entry.name}", "")
        number = _numbers(value) if isinstance(value, tuple) else f"{value:.6g}"
        scales.append(f"{entry.name} {number}" + (f" [{said}]" if said else ""))
    made.append(Value("scales", ", ".join(scales), origin.get("scales", "default")))
    return made


#: Names and step number where nothing asks for others.
_ORDINARY = "interaction 'CHECKED' in step 1"


def _places(subject: Subject) -> str:
    """Names and step numbers at which the routine was run, where there are several or others than
    the ordinary ones."""
    places = (subject.around, *subject.others)
    said = [", ".join(around_in_words(p.names, p.step_numbers)) or _ORDINARY for p in places]
    return "" if said == [_ORDINARY] else "; ".join(said)


def _numbers(values: tuple[float, ...]) -> str:
    return ", ".join(f"{v:.6g}" for v in values)
