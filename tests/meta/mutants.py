# SPDX-License-Identifier: MIT
"""Mutants: the text of a law in C or Fortran with one small fault in it.

Six operators, in the order of OPERATORS: a sign is changed, an assignment is dropped, an index is
swapped, a loop or an index is off by one, a limit (comparison, minimum, maximum, choice) is wrong,
a number is kept in single precision. Comments, texts and preprocessor lines are left alone. The
difference between `<` and `<=` of reals is not among them: it changes one point of a line.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

OPERATORS = ("sign", "drop", "index", "off by one", "limit", "float")

#: A place in the text and what stands there instead.
Change = tuple[int, int, str]


@dataclass(frozen=True)
class Mutant:
    """One fault.

    Attributes:
        file: name of the law or header.
        language: "c" or "fortran".
        operator: one of OPERATORS.
        line: from 1.
        before, after: the line without and with the fault.
        text: the whole text with the fault.
    """

    file: str
    language: str
    operator: str
    line: int
    before: str
    after: str
    text: str

    @property
    def id(self) -> str:
        """Name for people."""
        return f"{self.file}:{self.line} {self.operator}: {self.before} -> {self.after}"


def mutants(file: str, language: str, text: str) -> list[Mutant]:
    """Every mutant of a text, in the order of the places."""
    masked = mask(text, language)
    made = []
    for operator, find in _FINDERS[language].items():
        for start, end, new in find(masked):
            if masked[start:end].strip() or new:
                made.append(_mutant(file, language, operator, text, (start, end, new)))
    unique = {m.text: m for m in made if m.text != text}
    return sorted(unique.values(), key=lambda m: (m.line, OPERATORS.index(m.operator), m.after))


def _mutant(file: str, language: str, operator: str, text: str, change: Change) -> Mutant:
    start, end, new = change
    whole = text[:start] + new + text[end:]
    first, last = text.rfind("\n", 0, start) + 1, text.find("\n", end)
    before = " ".join(text[first:last].split())
    after = " ".join(whole[first : last + len(whole) - len(text)].split())
    return Mutant(file, language, operator, text.count("\n", 0, start) + 1, before, after, whole)


_C_SILENT = re.compile(r"/\*.*?\*/|//[^\n]*|\"[^\"\n]*\"|^#(?:[^\n\\]|\\.|\\\n)*", re.S | re.M)
_FORTRAN_SILENT = re.compile(r"![^\n]*|'[^'\n]*'|^#[^\n]*", re.M)


def mask(text: str, language: str) -> str:
    """The text with blanks for what is no code; places stay."""
    silent = _C_SILENT if language == "c" else _FORTRAN_SILENT
    return silent.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)


def _swaps(pattern: str, pairs: dict[str, str], group: int = 1) -> Callable[[str], Iterator]:
    """Finds what a group of the pattern holds, where `pairs` has something else for it."""

    def find(text: str) -> Iterator[Change]:
        for match in re.finditer(pattern, text, re.M):
            if (new := pairs.get(match[group].strip())) is not None:
                held = match[group]
                yield match.start(group), match.end(group), held.replace(held.strip(), new)

    return find


def _rewrites(pattern: str, *made: str) -> Callable[[str], Iterator]:
    """Replaces each match by each of the templates."""

    def find(text: str) -> Iterator[Change]:
        for match in re.finditer(pattern, text, re.M):
            for template in made:
                yield match.start(), match.end(), match.expand(template)

    return find


def _all(*finders: Callable[[str], Iterator]) -> Callable[[str], Iterator]:
    def find(text: str) -> Iterator[Change]:
        for finder in finders:
            yield from finder(text)

    return find


def _indices(opening: str, closing: str, lowest: int) -> Callable[[str], Iterator]:
    """Constant indices, each replaced by a neighbour."""

    def find(text: str) -> Iterator[Change]:
        for match in re.finditer(rf"(?<=\w)[{opening}](\d)[{closing}]", text):
            number = int(match[1])
            other = number - 1 if number > lowest else number + 1
            yield match.start(1), match.end(1), str(other)

    return find


_PLUS = {"+": "-", "-": "+", "+=": "-=", "-=": "+="}
_COMPARED = {"<": ">=", ">": "<=", "<=": ">", ">=": "<"}
_LOGICAL_C = {"&&": "||", "||": "&&"}
_LOGICAL_F = {".and.": ".or.", ".or.": ".and."}
_EXTREMES = {"min": "max", "max": "min", "fmin": "fmax", "fmax": "fmin",
             "usub_smaller": "usub_larger", "usub_larger": "usub_smaller"}  # fmt: skip
#: Declarations whose value can be dropped: what is left has to compile.
_C_DROP = r"^(?P<in> *)(?=\S)(?!return|const|static|int |double |typedef|else|usub_)(?P<s>[\w*>.\[\]()\- ]+? [+\-*/]?= [^;{}]*;)"  # noqa: E501
_F_DROP = (
    r"^(?P<in> *)(?=\S)(?!(?:real|integer|logical|type|do|if)\b[^=]*::)"
    r"(?P<s>(?:if \((?:[^()]|\([^()]*\))*\) )?(?:where \((?:[^()]|\([^()]*\))*\) )?"
    r"[\w%]+(?:\((?:[^()]|\([^()]*\))*\))?(?:%\w+)? = (?:[^&\n]*&\n)*[^&\n]*)$"
)

_FINDERS: dict[str, dict[str, Callable[[str], Iterator[Change]]]] = {
    "c": {
        "sign": _all(
            _swaps(r"[\w)\]] ([+-]=?) [\w(*&!-]", _PLUS),
            _rewrites(r"(?<=[=?:(,{] )-(?=[\w(])|(?<=[({])-(?=[\w(])|(?<=return )-(?=[\w(])", ""),
        ),
        "drop": _rewrites(_C_DROP, r"\g<in>;"),
        "index": _indices(r"\[", r"\]", 0),
        "off by one": _all(
            _rewrites(r"(for \([^;]*; \w+ )<( [^;&]*;)", r"\1<=\2"),
            _rewrites(r"(for \((?:int )?\w+ = )0;", r"\g<1>1;"),
            _rewrites(r"(?<=\[)(\w+)(?=\])(?<!\d)", r"\1 + 1"),
            _rewrites(r"(\w) - 1(?=\])", r"\1"),
        ),
        "limit": _all(
            _swaps(r"[\w)\]] ([<>]=?) [\w(*-]", _COMPARED),
            _swaps(r" (&&|\|\|) ", _LOGICAL_C),
            _swaps(r"\b(\w+)\(", _EXTREMES),
            _rewrites(r"\? ([\w.\[\]*/ >-]+) : ([\w.\[\]*/ >-]+)(?=[;,)])", r"? \2 : \1"),
        ),
        "float": _all(
            _rewrites(
                r"\b(?:double|usub_real|usub_value)(?= [a-z]\w*(?:,| =|;|\[\d\] ?=))", "float"
            ),
            _rewrites(r"= ([^;=]*[*+/][^;=]*)(?=;)", r"= (float)(\1)"),
        ),
    },
    "fortran": {
        "sign": _all(
            _swaps(r"(?<![\d.][eEdD])(?<=[\w)\]])( ?[+-] ?)(?=[\w(])", _PLUS),
            _rewrites(r"(?<== )-(?=[\w(])|(?<=\()-(?=[\w(])", ""),
        ),
        "drop": _rewrites(_F_DROP, r"\g<in>continue"),
        "index": _all(_indices(r"\(", r"\)", 1), _rewrites(r"\(([:\w]+), ([1-9])\)", r"(\2, \1)")),
        "off by one": _all(
            _rewrites(r"\bdo (\w+) = 1, ", r"do \1 = 2, "),
            _rewrites(r"(\bdo \w+ = [^,\n]+, [^,\n]+)$", r"\1 - 1"),
            _rewrites(r"(\w) - 1(?=\))", r"\1"),
            _rewrites(r"\((\d):(\d)\)", r"(\1 + 1:\2 + 1)"),
        ),
        "limit": _all(
            _swaps(r"[\w)] ?([<>]=?) ?[\w(-]", _COMPARED),
            _swaps(r" (\.and\.|\.or\.) ", _LOGICAL_F),
            _swaps(r"\b(min|max)\(", _EXTREMES),
            _rewrites(r"\bmerge\(([^,()]+), ([^,()]+), ", r"merge(\2, \1, "),
        ),
        "float": _all(
            _rewrites(r"^( *)real\([wd]p\)(?= ::)", r"\1real(4)"),
            _rewrites(r"(?<=\d)_[wd]p\b", "_4"),
            _rewrites(r"^( *\w+(?:\(\w+\))? = )([^&\n]*[*+/][^&\n]*)$", r"\1real(\2, 4)"),
        ),
    },
}
