# SPDX-License-Identifier: MIT
"""Rules that are left out, and failures that are expected: lists, and files of them.

A file has one pattern a line: a rule's identifier ("frame.rotation"), a group ("frame") or a
pattern with `*` and `?`, with an optional interface in front ("vfric: frame.*"). What follows `#`
is the reason.
"""

from __future__ import annotations

import difflib
import fnmatch
import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from usersub import abi
from usersub.errors import SceneError


@dataclass(frozen=True)
class Expectation:
    """One line: `pattern` of rules, `interface` ("" for all), the `reason` and the `place`."""

    pattern: str
    interface: str = ""
    reason: str = ""
    place: str = ""

    def fits(self, rule: str, interface: str) -> bool:
        """Whether it is about a rule for an interface."""
        return self.interface in ("", interface) and matches(self.pattern, rule)

    @property
    def words(self) -> str:
        """Where it stands and why, in words."""
        return " ".join(filter(None, (self.place, f"({self.reason})" if self.reason else "")))


def matches(pattern: str, rule: str) -> bool:
    """Whether a rule's identifier is meant by an identifier, a group or a pattern."""
    pattern = pattern.strip().lower()
    return rule == pattern or rule.partition(".")[0] == pattern or fnmatch.fnmatch(rule, pattern)


def read(path: str | os.PathLike[str]) -> tuple[Expectation, ...]:
    """The lines of a file.

    Raises:
        SceneError: it cannot be read, or a line has an unknown interface or several words.
    """
    file = Path(path)
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is not text in UTF-8"
        raise SceneError(f"{file} cannot be read: {reason}") from error
    lines = enumerate(text.splitlines(), 1)
    return tuple(made for n, line in lines if (made := _line(line, f"{file.name}:{n}")) is not None)


def parsed(given: Iterable[str | Expectation], place: str = "") -> tuple[Expectation, ...]:
    """Expectations of texts in the form of a line.

    Raises:
        SceneError: as `read`.
    """
    made = (g if isinstance(g, Expectation) else _line(g, place) for g in given)
    return tuple(m for m in made if m is not None)


def _line(line: str, place: str) -> Expectation | None:
    text, _, reason = line.partition("#")
    interface, colon, pattern = text.strip().rpartition(":")
    interface, pattern = interface.strip().lower(), pattern.strip().lower()
    where = f"{place}: " if place else ""
    if colon and interface not in abi.NAMES:
        names = ", ".join(abi.NAMES)
        raise SceneError(f"{where}'{interface}' is not an interface, expected one of {names}")
    if len(pattern.split()) > 1:
        raise SceneError(f"{where}'{pattern}' is not one rule; write each on a line of its own")
    if not pattern:
        return None
    return Expectation(pattern, interface, reason.strip(), place)


def chosen(given: Sequence[Expectation], rule: str, interface: str) -> Expectation | None:
    """The first that fits, or None."""
    return next((e for e in given if e.fits(rule, interface)), None)


def unknown(given: Iterable[Expectation], rules: Iterable[str]) -> Iterator[str]:
    """One sentence for each pattern that fits no rule."""
    known = list(rules)
    for each in given:
        if not any(matches(each.pattern, rule) for rule in known):
            place = f"{each.place}: " if each.place else ""
            yield f"{place}{no_such_rule(each.pattern, known)}"


def no_such_rule(pattern: str, rules: Iterable[str]) -> str:
    """The sentence on a pattern that fits no rule."""
    known = list(rules)
    groups = {rule.partition(".")[0] for rule in known}
    near = difflib.get_close_matches(pattern, [*known, *groups], n=1, cutoff=0.5)
    hint = f"; did you mean '{near[0]}'?" if near else ""
    return f"no rule is called '{pattern}'{hint}"
