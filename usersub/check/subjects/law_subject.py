# SPDX-License-Identifier: MIT
"""Built-in laws as subjects: their example properties, and the state variables that these need."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usersub.check.subject import Subject


def recognised(path: Path | None) -> str:
    """Name of the built-in law whose file `path` is, or ""."""
    if path is None:
        return ""
    from usersub import laws

    path = Path(path)
    name = path.resolve().parent.name
    if name in laws.LAWS and path.name in laws.LANGUAGES.values():
        own = laws.LAWS[name].folder / path.name
        if own.is_file() and own.read_bytes() == path.read_bytes():
            return name
    return ""


def recognised_language(subject: Subject, name: str) -> str:
    """Language in which the subject is the file of the built-in law `name`, or ""."""
    if subject.path is None:
        return ""
    return _language(subject.path, name)


@cache
def _language(path: Path, name: str) -> str:
    from usersub import laws

    if recognised(path) != name:
        return ""
    return next(language for language, file in laws.LANGUAGES.items() if file == path.name)


def with_example(subject: Subject, name: str, given: set[str]) -> Subject:
    """The subject with the example properties of a law and what the law needs with them.

    Raises:
        LoadError: no law is called `name`.
    """
    from usersub import laws

    law = laws.law(name)
    origin = dict(subject.origin)
    props = subject.props
    if "props" not in given:
        props = law(**law.example).props
        shown = ", ".join(f"{k} = {v}" for k, v in law.example.items()) or "none"
        origin["props"] = f"the example of the built-in law {name}: {shown}"
    changes: dict[str, object] = {"props": props}
    if "states" not in given:
        changes["states"] = law.state_count(subject.interface.name, props=props)
        origin["states"] = f"what the built-in law {name} needs"
    if "temperatures" not in given:
        changes["temperatures"] = "temperature" in law.reads
        reads = "reads" if changes["temperatures"] else "does not read"
        origin["temperatures"] = f"the built-in law {name} {reads} them"
    if "anisotropic" not in given:
        changes["anisotropic"] = law.anisotropic and subject.interface.name == "fric_coef"
    if "fields" not in given:
        changes["fields"] = 0
        origin["fields"] = f"the example of the built-in law {name} has none"
    return subject.but(**changes, origin=origin)
