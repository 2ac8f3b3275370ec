# SPDX-License-Identifier: MIT
"""What a routine that failed would have needed: read from the words in which it failed."""

from __future__ import annotations

import linecache
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usersub import abi
    from usersub.check.subject import Subject
    from usersub.errors import Error

#: Which attribute of a subject a dimension of an argument counts.
_COUNTS = {
    "nprops": "props",
    "nstates": "states",
    "nstatv": "states",
    "nstatevar": "states",
    "nfields": "fields",
    "npred": "fields",
}
#: Arguments of FRIC_COEF behind whose last documented number the state variables stand.
_STATE_BEHIND = ("rdata", 7)
_TEMPERATURES = ("temp", "tempavg", "tempslv", "tempsec", "tempmst", "tempmain")

_ELEMENT = re.compile(r"\b([A-Za-z]\w*)\(([-\d, ]+)\), of which")
_ABSENT = re.compile(r"\b([A-Za-z]\w*)(?:\([-\d, ]*\))?, which is not there")
_INDEX = re.compile(r"index (-?\d+) is out of bounds for axis (\d+) with size (\d+)")
_PLACE = re.compile(r"([^\s,'\"]+\.py):(\d+)\)")
_SPELLINGS = {"props": ("prop",), "states": ("stat", "rdata"), "fields": ("field", "predef")}
_SECOND = re.compile(r"\(\d+,2\) = .* but the scene is isotropic|'anisotropic' to 1")

#: Words of messages in which routines refuse, and what they are about.
_ABOUT = (
    ("states", re.compile(r"stat(e|ev|v)|solution.dependent|depvar", re.IGNORECASE)),
    ("fields", re.compile(r"field|predef", re.IGNORECASE)),
    ("props", re.compile(r"prop|constant|parameter|input|data", re.IGNORECASE)),
)
_NUMBERS = {
    "one": 1, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7, "eight": 8,
    "nine": 9, "ten": 10, "eleven": 11, "twelve": 12,
}  # fmt: skip
#: No count that a message names is larger than this.
LARGEST = 400


@dataclass(frozen=True)
class Wanted:
    """What would have helped.

    Attributes:
        counts: attribute of the subject and how many it should be at least.
        temperatures: the scene should have temperatures.
        anisotropic: the routine sets both coefficients.
        refused: it ended by itself, with these words; counts are not known then.
    """

    counts: tuple[tuple[str, int], ...] = ()
    temperatures: bool = False
    anisotropic: bool = False
    refused: str = ""

    def __bool__(self) -> bool:
        return bool(self.counts) or self.temperatures or self.anisotropic


def wanted(subject: Subject, failure: Error) -> Wanted:
    """What the routine of `subject` wants, by the words of its failure."""
    text = str(failure)
    if _SECOND.search(text):
        return Wanted(anisotropic=True)
    for found in _ELEMENT.finditer(text):
        index = [int(i) for i in found.group(2).split(",") if i.strip()]
        counts = _behind(subject.interface, found.group(1), index, subject)
        if counts:
            return Wanted(counts)
    absent = _ABSENT.search(text)
    if absent is not None:
        name = absent.group(1).lower()
        if name in _TEMPERATURES:
            return Wanted(temperatures=True)
        argument = subject.interface.positions.get(name)
        shape = subject.interface.args[argument].shape if argument is not None else ()
        counted = [_COUNTS[s.lower()] for s in shape if s.lower() in _COUNTS]
        return Wanted(tuple((c, _count(subject, c) + 1) for c in counted))
    index_error = _INDEX.search(text)
    if index_error is not None:
        return _of_index(subject, text, *(int(g) for g in index_error.groups()))
    return Wanted(refused=text)


def _count(subject: Subject, name: str) -> int:
    return len(subject.props) if name == "props" else getattr(subject, name)


def _behind(
    face: abi.Interface, name: str, index: list[int], subject: Subject
) -> tuple[tuple[str, int], ...]:
    """Counts for which the element `name(index)` exists, where they are larger than now."""
    position = face.positions.get(name.lower())
    if position is None:
        return ()
    if face.key == "fric_coef_2022" and name.lower() == _STATE_BEHIND[0]:
        need = index[0] - _STATE_BEHIND[1]
        return (("states", need),) if need > subject.states else ()
    shape = [_COUNTS.get(size.lower()) for size in face.args[position].shape]
    found = []
    for counted, at in zip(shape, index, strict=False):
        if counted and _count(subject, counted) < at <= LARGEST:
            found.append((counted, at))
    if not found and len(shape) == len(index) > 1:
        # Beyond the last column: a routine whose columns are longer than those that it gets.
        found = [(counted, _count(subject, counted) + 1) for counted in shape if counted]
    return tuple(found)


def _of_index(subject: Subject, text: str, index: int, axis: int, size: int) -> Wanted:
    """An IndexError of a Python routine: it tells the size of the array, not its name."""
    names = [n for n in ("props", "states", "fields") if _count(subject, n) == size]
    line = _line(text).lower()
    named = [n for n in names if any(word in line for word in _SPELLINGS[n])]
    if index < 0 or axis > 1 or not names:
        return Wanted(refused="an index out of bounds")
    return Wanted(tuple((n, index + 1) for n in (named or names)[:1]))


def _line(text: str) -> str:
    """The line of source that a message points to, or ""."""
    place = _PLACE.search(text)
    if place is None:
        return ""
    return linecache.getline(place.group(1), int(place.group(2)))


def numbers_in(text: str) -> list[int]:
    """Counts that a message may name, in digits or words, each once, smallest first."""
    said = text.partition("(routine '")[0]
    digits = {int(n) for n in re.findall(r"(?<![\w.])\d{1,3}(?![\w.])", said)}
    words = {_NUMBERS[w] for w in re.findall(r"[a-z]+", said.lower()) if w in _NUMBERS}
    return sorted(n for n in digits | words if 0 < n <= LARGEST)


def about(text: str) -> str:
    """What the words of a refusal are about: "states", "fields", "props", or "" """
    said = text.partition("the routine ended with")[2].partition("(routine '")[0]
    return next((name for name, words in _ABOUT if words.search(said)), "")
