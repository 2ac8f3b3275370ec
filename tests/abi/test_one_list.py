# SPDX-License-Identifier: MIT
"""No second hand-written argument list stands anywhere in the repository."""

import re

import pytest

from usersub import abi, emit
from usersub.emit.__main__ import ROOT

#: A run of so many consecutive arguments counts as a list. Half of the shortest list: routines in
#: Python name some arguments in their order, and sizes stand side by side.
RUN = 8
SUFFIXES = {
    ".py",
    ".c",
    ".h",
    ".in",
    ".inc",
    ".fi",
    ".cpp",
    ".hpp",
    ".f",
    ".for",
    ".f90",
    ".md",
    ".txt",
}
#: User code, which has to spell out the arguments of its interface, and the table itself.
ALLOWED = (
    "usersub/abi.py",
    "reference_impls/",
    "tests/field/",
    "docs/examples/",
    "docs/tutorials/",
    "docs/how-to/",
    "tests/benchmarks/laws.py",
    "tests/hosts/",
    "tests/meta/healthy/",
    "tests/meta/planted/",
    "tests/unit/check_routines.py",
    "tests/unit/test_check_around.py",
    "tests/unit/test_check_hints.py",
    "tests/unit/test_checked_where.py",
    "docs/_build/",
    "build/",
    ".",
)
_WORD = re.compile(r"[A-Za-z_]\w*")
_TYPES = {"const", "int", "double", "float", "char", "size_t", "usub_real", "real", "integer"}


def runs():
    """Every run of RUN consecutive arguments, in lower case, to the interface it is of."""
    found = {}
    for face in abi.INTERFACES:
        for names in ([a.name for a in face.args], [a.modern for a in face.args]):
            lower = [n.lower() for n in names]
            for i in range(len(lower) - RUN + 1):
                found[tuple(lower[i : i + RUN])] = face.key
    return found


def lists_in(text):
    """Interfaces of which `text` holds a run of arguments."""
    known = runs()
    words = [w.lower() for w in _WORD.findall(text) if w.lower() not in _TYPES]
    windows = zip(*(words[i:] for i in range(RUN)), strict=False)
    return sorted({known[w] for w in windows if w in known})


def sources():
    generated = set(emit.artefacts())
    for file in sorted(ROOT.rglob("*")):
        path = file.relative_to(ROOT).as_posix()
        if file.suffix.lower() in SUFFIXES and not path.startswith(ALLOWED):
            if path not in generated and file.is_file():
                yield path, file


def test_no_second_list():
    found = {
        path: lists
        for path, file in sources()
        if (lists := lists_in(file.read_text(encoding="utf-8", errors="replace")))
    }
    assert found == {}, "argument lists outside usersub/abi.py; generate them instead"


@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda f: f.key)
def test_a_list_would_be_found(face):
    names = [a.modern for a in face.args][3 : 3 + RUN]
    typed = ", ".join(f"const double *{n}" for n in names)
    assert lists_in(f"void law({typed})")
    assert lists_in("&\n     & ".join(f"{n.upper()}," for n in names))
    assert not lists_in(" ".join(names[: RUN - 1]))
