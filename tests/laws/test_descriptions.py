# SPDX-License-Identifier: MIT
"""law.toml, what is generated from it, and the reference values."""

from __future__ import annotations

import re
import subprocess
import sys

import law_cases
import pytest
import reference

from usersub import laws, paths
from usersub.emit import law_readme
from usersub.errors import LoadError
from usersub.laws import lawfile
from usersub.laws.registry import Laws

VECTOR = '[[vectors]]\nname = "z"\nunit = "length"\nmeaning = "a vector"'
GOOD = """
title = "A law"
kind = "coefficient"
equation = "mu = a b"
source = "somebody"
limits = [["zero pressure", "none"], ["negative pressure", "none"]]
[[props]]
name = "a"
unit = "-"
meaning = "a number"
at_least = 0
[example]
a = 0.5
"""


def _read(tmp_path, text):
    (tmp_path / "made").mkdir(exist_ok=True)
    file = tmp_path / "made" / "law.toml"
    file.write_text(text)
    return lawfile.read(file)


def test_a_folder_with_a_description_is_a_law(tmp_path):
    _read(tmp_path, GOOD)
    (tmp_path / "no_law").mkdir()
    found = Laws(tmp_path)
    assert list(found) == ["made"] and found["made"].title == "A law"
    assert found["made"] is found["made"]


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('"coefficient"', '"coeficient"', "kind = 'coeficient'; did you mean 'coefficient'?"),
        ('title = "A law"', 'titel = "A law"', "has no key 'titel'; did you mean 'title'?"),
        ('title = "A law"', "title = 3", "title = 3; expected a text"),
        ('source = "somebody"', "", r"needs the key 'source' \(a text\)"),
        ("[example]", 'reads = ["rate"]\n[example]', r"\[\[props\]\] 1 has no key 'reads'"),
        ('title = "A law"', 'title = "A law"\nreads = ["rate"]', "reads = 'rate'"),
        (', ["negative pressure", "none"]', "", "nothing of the case 'negative pressure'"),
        ('title = "A law"', 'title = "A law"\nreads = ["slip_rate"]', "the case 'zero rate'"),
        ("at_least = 0", 'at_least = "0"', "at_least = '0'; expected a finite number"),
        ('name = "a"', 'name = "a b"', "name = 'a b'; expected letters"),
        ('name = "a"', 'name = "lambda"', "name = 'lambda'; expected letters"),
        ("at_least = 0", 'count = "n"', "count = 'n'. Expected one of: none"),
        ("at_least = 0", 'count = "n +"', "'n \\+' is no sum or product"),
        ("at_least = 0", "default = [1.0]", "does not fit its shape"),
        ("a = 0.5", "b = 0.5", "property = 'b'"),
        ("a = 0.5", "", r"\[example\] needs a value of 'a'"),
        ("[example]", '[refusals]\nfrik = "no"\n[example]', "did you mean 'fric'"),
        ("[example]", "anisotropic = 3\n[example]", "has no key 'anisotropic'"),
        ('kind = "coefficient"', 'kind = "strength"\nanisotropic = true', "the kind is 'strength'"),
        (
            "[example]",
            '[[vectors]]\nname="z"\nunit="m"\nmeaning="x"\n[example]',
            "for bristle laws",
        ),
        ("[example]", "[accuracy]\nulp = 8\n[example]", "needs the key 'why'"),
        ("kind =", "kind", "is not TOML"),
    ],
)
def test_wrong_descriptions_are_refused(tmp_path, old, new, told):
    assert old in GOOD
    with pytest.raises(LoadError, match=told) as raised:
        _read(tmp_path, GOOD.replace(old, new, 1))
    assert "made/law.toml: " in str(raised.value)


def test_property_twice_is_refused(tmp_path):
    second = '[[props]]\nname = "a"\nunit = "-"\nmeaning = "again"\n[example]'
    with pytest.raises(LoadError, match="stands twice"):
        _read(tmp_path, GOOD.replace("[example]", second))


def test_registry_names_what_is_wrong():
    with pytest.raises(LoadError, match="did you mean 'coulomb'"):
        laws.load("colomb")
    with pytest.raises(LoadError, match="python, c, fortran, not in 'cobol'"):
        laws.path("coulomb", "cobol")
    with pytest.raises(LoadError, match="no precision 'single'; expected double"):
        laws.routine("coulomb", "fric", precision="single")
    with pytest.raises(LoadError, match="there is no such interface"):
        laws.law("coulomb").check("frick")


def test_every_folder_is_a_complete_law():
    folders = {p.name for p in paths.reference_impls().iterdir() if p.is_dir()}
    assert folders == set(laws.LAWS)
    for name, law in laws.LAWS.items():
        expected = {*laws.LANGUAGES.values(), "law.toml", "README.md"}
        expected |= set() if law.kind == "stick" else {"reference.py", "reference.json"}
        assert {p.name for p in law.folder.iterdir() if p.is_file()} == expected, name


@pytest.mark.parametrize("law", laws.LAWS)
def test_readme_is_what_the_description_says(law):
    described = laws.law(law)
    text = (described.folder / "README.md").read_text(encoding="utf-8")
    assert text == law_readme.readme(described)
    for word in ("**Properties**", "**State variables**", "**Limits**", "**Interfaces**"):
        assert word in text
    for interface in described.refusals:
        assert f"Not behind {interface.upper()}" in text


@pytest.mark.parametrize("law", law_cases.names())
def test_reference_values_are_current(law):
    assert reference.file(law).read_text(encoding="utf-8") == reference.text(law)


@pytest.mark.parametrize("law", law_cases.names())
def test_reference_is_independent(law):
    """It knows mpmath and itself only."""
    text = (laws.law(law).folder / "reference.py").read_text(encoding="utf-8")
    imports = re.findall(r"^\s*(?:from|import)\s+(\w+)", text, flags=re.MULTILINE)
    assert set(imports) <= {"mpmath", "fractions", "math", "itertools", "functools"}


def test_import_of_laws_is_light():
    heavy = "numpy numba scipy matplotlib rich click mpmath".split()
    code = (
        "import sys, usersub.laws; usersub.laws.LAWS['coulomb']\n"
        f"print([m for m in {heavy!r} if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
