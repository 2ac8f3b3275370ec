# SPDX-License-Identifier: MIT
"""`usersub info`: what it says of files in every language, and of files that are none."""

from __future__ import annotations

import json

import pytest
from click.testing import CliRunner

from usersub import abi
from usersub.cli.main import cli
from usersub.cli.new import contents

PYTHON = """
import usersub


@usersub.fric_coef
def mine(fCoef, slipData, props):
    fCoef[:, 0] = props[0]


@usersub.vfric(compiled=False)
def theirs(fTangential, fNormal, nContact):
    fTangential[0, :] = -0.5 * fNormal
"""
FORTRAN = """\
      SUBROUTINE VFRIC_COEF(A, B, NBLOCK, NP, NT, NF, JFLAGS, RDATA,
     1 CI, CS, CM, PROPS, RATE, P, T, F)
      INCLUDE 'VABA_PARAM.INC'
      CHARACTER*80 CI, CS, CM
      DIMENSION A(NBLOCK), RATE(NBLOCK)
      COMMON /KEPT/ WORN
      DO 10 K = 1, NBLOCK
   10 A(K) = WORN*RATE(K)
      END
      SUBROUTINE UEL(X)
      END
"""


def info(*args: object):
    return CliRunner().invoke(cli, ["info", *map(str, args)], prog_name="usersub")


def test_python_file_with_two_routines(tmp_path):
    path = tmp_path / "two.py"
    path.write_text(PYTHON)
    result = info(path)
    assert result.exit_code == 0, result.stderr
    for words in (
        "FRIC_COEF, generation 2022",
        "VFRIC (explicit)",
        "mine",
        "slipData",
        "writes",
        "the routine does not use it",
        "contact points a call",
        "one only",
    ):
        assert words in result.stdout
    found = json.loads(info(path, "--json").stdout)
    first, second = found["results"]
    assert (first["interface"], second["interface"]) == ("fric_coef", "vfric")
    does = {a["name"]: a["does"] for a in second["arguments"]}
    assert does["fTangential"] == "writes" and does["fNormal"] == "reads"
    assert does["dSlipFric"] == "unused"
    assert len(second["plan"]) == 42
    assert found["file"]["language"] == "python"


def test_one_interface_of_several(tmp_path):
    path = tmp_path / "two.py"
    path.write_text(PYTHON)
    found = json.loads(info(path, "-i", "vfric", "--json").stdout)
    assert [r["name"] for r in found["results"]] == ["theirs"]
    result = info(path, "-i", "fric")
    assert result.exit_code == 1 and "VFRIC" in result.stderr


@pytest.mark.needs_fortran
def test_fortran_file(tmp_path):
    path = tmp_path / "old.f"
    path.write_text(FORTRAN)
    result = info(path)
    assert result.exit_code == 0, result.stderr
    for words in (
        "GNU Fortran",
        "-ffixed-line-length-132",
        "UEL",
        "KEPT",
        "one only",
        "RATE",
        "compared with the table",
    ):
        assert words.lower() in result.stdout.lower(), result.stdout
    single = json.loads(info(path, "--precision", "single", "--json").stdout)
    assert single["file"]["precision"] == "single"


@pytest.mark.parametrize("name", abi.NAMES)
def test_c_file_has_a_plan(tmp_path, name):
    path = tmp_path / "law.c"
    path.write_text(contents("law", name, "c")["law.c"])
    (row,) = json.loads(info(path, "--json").stdout)["results"]
    assert row["interface"] == name and row["checked"]
    assert isinstance(row["plan"], list) and len(row["plan"]) == len(abi.interface(name).args)


@pytest.mark.parametrize(
    ("file", "text", "words"),
    [
        ("a.py", "x = 1\n", "a.py"),
        ("a.py", "def f(:\n", "a.py"),
        ("a.c", "int f(void) { return 1; }\n", "none of the interfaces"),
        ("a.c", "void fric_(int *LM) { *LM = 1; }\n", "1 arguments, expected 39"),
        ("a.c", "void vfric_(int *LM) { *LM = }\n", "a.c:1"),
        ("a.txt", "", ".txt"),
    ],
)
def test_files_that_are_none(tmp_path, file, text, words):
    (tmp_path / file).write_text(text)
    result = info(tmp_path / file)
    assert result.exit_code == 1
    assert words in result.stderr and result.stderr.count("\n") == 1
    assert "Traceback" not in result.stderr


def test_no_file(tmp_path):
    result = info(tmp_path / "none.f90")
    assert result.exit_code == 1 and "none.f90" in result.stderr


def test_a_built_in_law_and_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(cli, ["info", "coulomb", "--interface", "vfric"])
    assert result.exit_code == 0 and "VFRIC (explicit)" in result.stdout
    result = CliRunner().invoke(cli, ["info", str(tmp_path)])
    assert result.exit_code == 1 and "is a folder, expected a routine file" in result.stderr
