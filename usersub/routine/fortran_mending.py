# SPDX-License-Identifier: MIT
"""Mending by gfortran's own words: what it refuses, others take, and has only one meaning.

Only files that gfortran has refused come here. Line numbers stay those of the file.
"""

from __future__ import annotations

import re
from collections.abc import Callable

_FAULT = r"^(?P<file>[^\s:][^:]*):(?P<line>\d+):(?P<column>\d+): Error: "
_MARKER = re.compile(r'^# (\d+) "([^"]*)"$')
_NUMBER = re.compile(r"^\s*[+-]?\s*(?:\d+\.?\d*|\.\d+)(?:[ed][+-]?\d+)?\s*$", re.I)
_CALL = re.compile(r"\b(sign|max|min|mod|dim|atan2)\s*\(", re.I)
_GENERIC = {
    **{
        f"d{name}": name
        for name in "abs sqrt exp log log10 sin cos tan asin acos atan atan2".split()
    },
    **{f"d{name}": name for name in "sinh cosh tanh sign mod dim prod".split()},
    **{"dint": "aint", "dnint": "anint", "idint": "int", "idnint": "nint"},
    **{"alog": "log", "alog10": "log10", "amod": "mod"},
}
_CONDITION = re.compile(r"\b(?:if|while)\s*\(", re.I)
#: What stands behind column 72 of punched cards: their number, or an `&` for free form.
_TAIL = re.compile(r"^\s*(?:&|[A-Za-z]{0,5}\s*\d{2,8})\s*$")


def mended(files: dict[str, bytes], words: str, free: bool) -> dict[str, bytes] | None:
    """The files with what `words` (of a failed compilation) complain of written as gfortran has it.

    - `.EQ.` and `.NE.` between logicals,
    - arguments of different types in SIGN, MAX, MIN, MOD, DIM and ATAN2, one of them a number,
    - an integer as a condition (odd is true),
    - DSQRT, ALOG and their like with arguments of the other precision (generic names: SQRT, LOG),
    - numbers of punched cards behind column 72, if nothing else stands there.

    Returns:
        None if there is nothing of that kind.
    """
    changed = False
    texts = {name: data.decode("latin-1").split("\n") for name, data in files.items()}
    for lines in texts.values():
        places = _places(lines)
        for pattern, mend in _MENDS:
            for fault in pattern.finditer(words):
                start = places.get((fault["file"], int(fault["line"])))
                if start is not None:
                    changed |= mend(lines, start, int(fault["column"]) - 1, fault)
    if not changed and not free:
        changed = _cut_cards(list(texts.values()))
    return (
        {n: "\n".join(lines).encode("latin-1") for n, lines in texts.items()} if changed else None
    )


def _places(lines: list[str]) -> dict[tuple[str, int], int]:
    """Index of each line by the file and number that its markers give it."""
    places: dict[tuple[str, int], int] = {}
    file, number = "", 0
    for index, line in enumerate(lines):
        marker = _MARKER.match(line)
        if marker:
            file, number = marker[2], int(marker[1]) - 1
        else:
            number += 1
            places[file, number] = index
    return places


def _operator(lines: list[str], start: int, column: int, fault: re.Match) -> bool:
    """The first such operator at or behind the place, in its line or the next ones."""
    word = fault["wrong"].strip(".")
    wrong = rf"\.\s*{word}\s*\." if word.isalpha() else re.escape(word)
    for index in range(start, min(start + 20, len(lines))):
        found = re.compile(wrong, re.I).search(lines[index], column if index == start else 0)
        if found:
            line = lines[index]
            lines[index] = line[: found.start()] + fault["right"] + line[found.end() :]
            return True
    return False


def _closing(line: str, opening: int) -> int:
    """Position of the parenthesis that closes the one at `opening`; -1 if not in this line."""
    depth = 0
    for at in range(opening, len(line)):
        depth += (line[at] == "(") - (line[at] == ")")
        if depth == 0:
            return at
    return -1


def _arguments(inside: str) -> list[str]:
    """What stands between the commas of an argument list."""
    parts, depth, begin = [], 0, 0
    for at, c in enumerate(inside):
        depth += (c == "(") - (c == ")")
        if c == "," and depth == 0:
            parts.append(inside[begin:at])
            begin = at + 1
    return [*parts, inside[begin:]]


def _mixed_types(lines: list[str], start: int, column: int, fault: re.Match) -> bool:
    """Numbers among the arguments get the kind of the first argument that is none."""
    line = lines[start]
    calls = [
        (found.end() - 1, end)
        for found in _CALL.finditer(line)
        if found[1].lower() == fault["name"]
        and found.end() <= column + 1 <= (end := _closing(line, found.end() - 1))
    ]
    if not calls:
        return False
    begin, end = calls[-1]
    parts = _arguments(line[begin + 1 : end])
    others = [part.strip() for part in parts if not _NUMBER.match(part)]
    if fault["name"] == "sign" and len(parts) == 2 and len(others) != 1:
        # Both get the type of their sum.
        typed = [f"({a.strip()})+0*({b.strip()})" for a, b in (parts, reversed(parts))]
    elif not others or len(others) == len(parts):
        return False
    else:
        typed = [f"real({p.strip()},kind({others[0]}))" if _NUMBER.match(p) else p for p in parts]
    lines[start] = line[: begin + 1] + ",".join(typed) + line[end:]
    return True


def _generic_name(lines: list[str], start: int, column: int, fault: re.Match) -> bool:
    """The generic name of the function instead of that for one precision."""
    name, line = fault["name"], lines[start]
    calls = [c for c in re.finditer(rf"\b{name}(?=\s*\()", line, re.I) if c.end() <= column]
    if name not in _GENERIC or not calls:
        return False
    lines[start] = line[: calls[-1].start()] + _GENERIC[name] + line[calls[-1].end() :]
    return True


def _condition(lines: list[str], start: int, column: int, fault: re.Match) -> bool:
    line = lines[start]
    for found in _CONDITION.finditer(line):
        end = _closing(line, found.end() - 1)
        if end > column >= found.start():
            inside = line[found.end() : end]
            lines[start] = f"{line[: found.end()]}mod({inside},2).ne.0{line[end:]}"
            return True
    return False


def _cut_cards(texts: list[list[str]]) -> bool:
    """Cuts at column 72 if only numbers of cards stand behind it, in several lines."""
    cards = 0
    for lines in texts:
        for line in lines:
            if line[72:].strip() and not line.startswith("#") and "!" not in line[:72]:
                if not _TAIL.match(line[72:]):
                    return False
                cards += 1
    if cards:
        for lines in texts:
            lines[:] = [line if line.startswith("#") else line[:72].rstrip() for line in lines]
    return cards > 0


_Mend = Callable[[list[str], int, int, re.Match], bool]
_MENDS: tuple[tuple[re.Pattern[str], _Mend], ...] = tuple(
    (re.compile(_FAULT + words, re.M), mend)
    for words, mend in (
        (
            r"Logicals at \(1\) must be compared with (?P<right>\.\w+\.) instead of "
            r"(?P<wrong>\S+)$",
            _operator,
        ),
        (
            r"'\w+'(?: and '\w+')? arguments? of '(?P<name>\w+)' intrinsic at \(1\) must "
            r"(?:be the same type and kind as '\w+'|be \w+\(\d\)|have the same type)$",
            _mixed_types,
        ),
        (
            r"'\w+' argument of '(?P<name>\w+)' intrinsic at \(1\) must be double precision$",
            _generic_name,
        ),
        (r"In call to '(?P<name>\w+)' at \(1\), type mismatch in argument", _generic_name),
        (r"IF clause at \(1\) requires a scalar LOGICAL expression$", _condition),
        (
            r"Exit condition of DO WHILE loop at \(1\) must be a scalar LOGICAL expression$",
            _condition,
        ),
    )
)
