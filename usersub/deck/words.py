# SPDX-License-Identifier: MIT
"""Words and numbers of a deck: parameters, abbreviations, data entries, messages."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, NoReturn

from usersub.errors import DeckError

_REAL = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d{1,9})?", re.ASCII)
_WHOLE = re.compile(r"\+?\d{1,9}", re.ASCII)
_ZERO = re.compile(r"[+-]?[0.]*(?:[eEdD].*)?", re.ASCII)
#: Characters of a word that a message repeats.
_SHOWN = 60


@dataclass(frozen=True)
class Where:
    """A line of a deck.

    Attributes:
        file: name of the file.
        line: number of the line, from one.
    """

    file: str
    line: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}" if self.line else self.file


@dataclass(frozen=True)
class Note:
    """A warning: `where` and `text`, one sentence."""

    where: Where
    text: str

    def __str__(self) -> str:
        return f"{self.where}: {self.text}"


def refuse(where: Where, reason: str) -> NoReturn:
    """Raises the error of line `where`."""
    raise DeckError(where.file, where.line, reason)


def show(word: str) -> str:
    """A word of the deck for a message: quoted, short, printable."""
    short = word if len(word) <= _SHOWN else word[:_SHOWN] + "..."
    return repr(short)


def squeeze(word: str) -> str:
    """Upper case without blanks, as words of keyword lines are compared."""
    return "".join(word.split()).upper()


def choose(word: str, names: Iterable[str]) -> str | list[str]:
    """The one of `names` that `word` abbreviates, or all that begin with it."""
    wanted = squeeze(word)
    begun = []
    for name in names:
        key = squeeze(name)
        if key == wanted:
            return name
        if wanted and key.startswith(wanted):
            begun.append(name)
    return begun[0] if len(begun) == 1 else begun


def alternatives(words: Iterable[str]) -> str:
    """Several words for a message."""
    return " or ".join(sorted(words))


def split(text: str, where: Where) -> list[str]:
    """Parts of a keyword line between commas that stand outside of quotation marks."""
    if '"' not in text:
        return text.split(",")
    parts, quoted, start = [], False, 0
    for i, letter in enumerate(text):
        if letter == '"':
            quoted = not quoted
        elif letter == "," and not quoted:
            parts.append(text[start:i])
            start = i + 1
    if quoted:
        refuse(where, "a quotation mark is not closed")
    return [*parts, text[start:]]


def value_of(text: str, where: Where) -> str:
    """A parameter's value: without quotation marks, or without blanks where there are none."""
    text = text.strip()
    if '"' not in text:
        return "".join(text.split())
    if len(text) < 2 or text[0] != '"' or text[-1] != '"' or '"' in text[1:-1]:
        refuse(where, f"{show(text)} is no name in quotation marks")
    return text[1:-1].strip()


class Parameters:
    """The parameters of one keyword line.

    Args:
        name: the keyword in full.
        parts: what stands between the commas after the keyword.
        kinds: known parameters and their kinds: "flag", "whole", "real", "name", "path", or
            "choice" (a word, or none).
        strict: whether an unknown parameter is refused; else it is in `unknown`.
    """

    def __init__(
        self,
        name: str,
        parts: list[str],
        kinds: Mapping[str, str],
        where: Where,
        *,
        strict: bool = True,
    ) -> None:
        self.name, self.where = name, where
        self.values: dict[str, Any] = {}
        self.unknown: list[str] = []
        for part in parts:
            word, equals, text = part.partition("=")
            if not part.strip():
                continue
            found = choose(word, kinds)
            if isinstance(found, str):
                if found in self.values:
                    refuse(where, f"*{name}: {found} is given twice")
                self.values[found] = self._value(found, kinds[found], bool(equals), text)
            elif found:
                refuse(where, f"*{name}: {show(word.strip())} may stand for {alternatives(found)}")
            elif strict:
                refuse(where, self._no_such(word.strip(), kinds))
            else:
                self.unknown.append(squeeze(word))

    def _no_such(self, word: str, kinds: Mapping[str, str]) -> str:
        import difflib

        near = difflib.get_close_matches(squeeze(word), kinds, n=1, cutoff=0.6)
        if near:
            return f"*{self.name} has no parameter {show(word)}; did you mean {near[0]}?"
        known = ", ".join(kinds) or "none"
        more = ""
        if _REAL.fullmatch(word):
            more = "; a keyword line that ends in a comma goes on in the next line"
        return f"*{self.name} has no parameter {show(word)}{more} (parameters: {known})"

    def _value(self, key: str, kind: str, given: bool, text: str) -> Any:
        what = f"*{self.name}: {key}"
        if kind == "flag":
            if given:
                refuse(self.where, f"{what} takes no value, but {show(text.strip())} is given")
            return True
        if not given and kind == "choice":
            return ""
        word = text.strip().strip('"') if kind == "path" else value_of(text, self.where)
        if not word:
            refuse(self.where, f"{what} needs a value")
        if kind == "whole":
            if not _WHOLE.fullmatch(word):
                refuse(self.where, f"{what} = {show(word)} is no whole number")
            return int(word)
        if kind == "real":
            return real(word, self.where, what)
        return word

    def __contains__(self, key: str) -> bool:
        return key in self.values

    def get(self, key: str, default: Any = None) -> Any:
        """Value of a parameter, or `default`."""
        return self.values.get(key, default)


def real(word: str, where: Where, what: str) -> float:
    """A number of the deck; `what` it is begins the message.

    Raises:
        DeckError: no number, or one that double precision does not hold.
    """
    word = word.strip()
    if not _REAL.fullmatch(word):
        hint = ""
        if word.startswith("<"):
            hint = "; values of *PARAMETER are not put in"
        refuse(where, f"{what} is {show(word)}, expected a number{hint}")
    number = float(word.upper().replace("D", "E"))
    if not math.isfinite(number) or (number == 0.0 and not _ZERO.fullmatch(word)):
        refuse(where, f"{what} is {show(word)}, which double precision does not hold")
    return number + 0.0  # no negative zero


def entries(text: str) -> list[str]:
    """Entries of a data line; blank ones at its end are left out."""
    words = [word.strip() for word in text.split(",")]
    while words and not words[-1]:
        words.pop()
    return words


def written(number: float) -> str:
    """A number so that it is read back as it is."""
    return repr(float(number))


def written_name(name: str) -> str:
    """A name, in quotation marks where it needs them."""
    return name if re.fullmatch(r"[^\s,=\"*]+", name) else f'"{name}"'
