# SPDX-License-Identifier: MIT
"""Which interfaces a source is meant for that defines none that can be loaded."""

from __future__ import annotations

import difflib
import re
from collections.abc import Sequence
from pathlib import Path

from usersub import abi

_NAMES = "|".join(sorted(abi.NAMES, key=len, reverse=True))
#: A definition with the name of an interface, in Fortran, C, C++ or Python.
_DEFINITIONS = (
    rf"(?im)^[ \t\w()*=]*\bsubroutine\s+({_NAMES})\b",
    rf"(?i)\bFOR_NAME\s*\(\s*({_NAMES})\s*,",
    rf"\bvoid\s+({_NAMES})_?\s*\(",
    rf"(?m)^\s*@(?:\w+\.)?({_NAMES})\b",
    rf"(?m)^\s*def\s+({_NAMES})\s*\(",
)
#: The name of any function that is defined.
_ANY = r"(?im)^[ \t]*(?:subroutine|void|def)\s+(\w+)\s*\("
#: Likeness from which on two names count as alike.
_LIKE = 0.8
#: Names of arguments that have to occur before an argument list is taken for one of ours.
_ENOUGH = 3


def meant(path: Path) -> Sequence[str]:
    """Interfaces of a source that need not compile: those whose names are defined, else the one
    that its names of functions and arguments come nearest to; none if nothing is near."""
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ()
    seen = {m.lower() for pattern in _DEFINITIONS for m in re.findall(pattern, text)}
    if seen:
        return [name for name in abi.NAMES if name in seen]
    functions = [name.lower().strip("_") for name in re.findall(_ANY, text)]
    if not functions:
        return ()
    words = {word.lower() for word in re.findall(r"[A-Za-z]\w*", text)}
    best = max(abi.INTERFACES, key=lambda face: _nearness(face, words, functions, path.stem))
    near = difflib.get_close_matches(best.name, functions, n=1, cutoff=_LIKE)
    return [best.name] if near or len(_found(best, words)) >= _ENOUGH else []


def _found(face: abi.Interface, words: set[str]) -> set[int]:
    """Positions of the arguments that are named in the source."""
    return {position for spelling, position in face.positions.items() if spelling in words}


def _nearness(face: abi.Interface, words: set[str], functions: list[str], stem: str) -> tuple:
    """The more arguments that are its own the better; then what function and file are called."""
    others = {s for other in abi.INTERFACES if other.name != face.name for s in other.positions}
    own = {p for s, p in face.positions.items() if s in words and s not in others}
    called = max(difflib.SequenceMatcher(None, face.name, name).ratio() for name in functions)
    file = len(face.name) if face.name in stem.lower() else 0
    return len(own), called if called >= _LIKE else 0.0, len(_found(face, words)), file
