# SPDX-License-Identifier: MIT
"""`usersub new`: what it makes runs, passes its own tests and is never overwritten."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from click.testing import CliRunner

from usersub import abi
from usersub.cli.main import cli
from usersub.cli.new import KINDS, contents, fortran_header, law_contents

LANGUAGES = ("python", "c", "fortran")


def run(*args: object):
    return CliRunner().invoke(cli, [str(a) for a in args], prog_name="usersub")


@pytest.mark.parametrize("name", abi.NAMES)
@pytest.mark.parametrize("language", LANGUAGES)
def test_contents_are_filled(name, language):
    for text in contents("my_law", name, language).values():
        assert "@my" not in text and "SPDX" not in text
        for word in ("NAME", "FILE", "HEADER", "PARAMETERS", "IMPORTS", "SKIP"):
            assert f"@{word}@" not in text
        assert max(map(len, text.splitlines())) <= 100
        assert "my_law" in text


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("language", LANGUAGES)
def test_contents_of_a_law_are_filled(kind, language):
    for text in law_contents("my_law", kind, language).values():
        assert "@my" not in text and "SPDX" not in text
        for word in ("NAME", "FILE", "EXACT", "IMPORTS", "SKIP"):
            assert f"@{word}@" not in text
        assert max(map(len, text.splitlines())) <= 100
        assert "my_law" in text


@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda f: f.key)
def test_fortran_header_has_every_argument_once(face):
    header = fortran_header(face).replace("&\n", " ")
    names = header.split("(", 1)[1].split(")", 1)[0].replace(" ", "").split(",")
    assert names == [a.modern for a in face.args]
    assert max(map(len, fortran_header(face).splitlines())) <= 80


@pytest.mark.parametrize("name", abi.NAMES)
@pytest.mark.parametrize("language", LANGUAGES)
def test_new_runs_at_once(name, language, tmp_path, request):
    if language == "fortran":
        request.getfixturevalue("fortran")
    made = run("new", "my_law", "-i", name, "-l", language, "--dir", tmp_path / "deep" / "er")
    assert made.exit_code == 0, made.stderr
    folder = tmp_path / "deep" / "er"
    result = run("run", folder / "my_law.toml", "--json")
    assert result.exit_code == 0, result.stderr
    rows = json.loads(result.stdout)["results"]
    assert len(rows) == 30 and rows[-1]["time"] == 3.0
    # A friction routine whose coefficient is 0 would not be one.
    assert max(abs(row["mobilised"]) for row in rows) > 0.19
    assert (folder / "my_law.csv").read_text().count("\n") == 31


@pytest.mark.parametrize("language", LANGUAGES)
def test_new_passes_its_own_tests(language, tmp_path, request):
    if language == "fortran":
        request.getfixturevalue("fortran")
    for name in abi.NAMES:
        assert run("new", f"my_{name}", "-i", name, "-l", language, "-d", tmp_path).exit_code == 0
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tmp_path)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        check=False,
    )
    assert done.returncode == 0, done.stdout
    assert "skipped" not in done.stdout


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("language", LANGUAGES)
def test_new_law_runs_at_once_behind_its_interfaces(kind, language, tmp_path, request):
    if language == "fortran":
        request.getfixturevalue("fortran")
    made = run("new", "my_law", "--law", kind, "-l", language, "-d", tmp_path)
    assert made.exit_code == 0, made.stderr
    scene = tmp_path / "my_law.toml"
    text = scene.read_text()
    first = text.split('interface = "')[1].split('"')[0]
    interfaces = abi.NAMES if kind == "coefficient" else ("fric", "vfric", "vfriction")
    for interface in interfaces:
        changed = text.replace(f'interface = "{first}"', f'interface = "{interface}"')
        if interface == "fric":
            changed = changed.replace("# states = 2", "states = 2")
        scene.write_text(changed)
        result = run("run", scene, "--json")
        assert result.exit_code == 0, (interface, result.stderr)
        rows = json.loads(result.stdout)["results"]
        assert len(rows) == 30 and rows[-1]["time"] == 3.0
        assert max(abs(row["mobilised"]) for row in rows) > 0.19


def test_new_laws_pass_their_own_tests(tmp_path, request):
    request.getfixturevalue("fortran")
    for kind, language in zip(KINDS, ("python", "c", "fortran", "c"), strict=True):
        assert (
            run("new", f"my_{kind}", "--law", kind, "-l", language, "-d", tmp_path).exit_code == 0
        )
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tmp_path)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        check=False,
    )
    assert done.returncode == 0, done.stdout
    assert "skipped" not in done.stdout


@pytest.mark.parametrize("given", [(), ("-i", "vfric", "--law", "bristle")])
def test_a_routine_or_a_law(given, tmp_path):
    result = run("new", "a", *given, "-l", "c", "-d", tmp_path)
    assert result.exit_code == 2
    assert "give one of --interface (a routine) and --law (a law)" in result.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_law_for_programs(tmp_path):
    found = json.loads(
        run("new", "a", "--law", "strength", "-l", "c", "-d", tmp_path, "--json").stdout
    )
    assert [r["kind"] for r in found["results"]] == ["law", "test", "scene"]


def test_nothing_is_overwritten(tmp_path):
    (tmp_path / "a.toml").write_text("mine")
    result = run("new", "a", "-i", "vfric", "-l", "c", "-d", tmp_path)
    assert result.exit_code == 1
    assert "a.toml exists already" in result.stderr
    assert [p.name for p in tmp_path.iterdir()] == ["a.toml"]
    assert (tmp_path / "a.toml").read_text() == "mine"


def test_for_programs(tmp_path):
    found = json.loads(run("new", "a", "-i", "VFRIC", "-l", "c", "-d", tmp_path, "--json").stdout)
    assert [r["kind"] for r in found["results"]] == ["routine", "test", "scene"]
    assert found["results"][0]["path"].endswith("a.c")


def test_folder_that_cannot_be(tmp_path):
    (tmp_path / "file").write_text("")
    result = run("new", "a", "-i", "vfric", "-l", "c", "-d", tmp_path / "file" / "below")
    assert result.exit_code in (1, 2)
    assert "Traceback" not in result.stderr and "file" in result.stderr


def test_a_folder_that_cannot_be_made(tmp_path):
    (tmp_path / "file").write_text("")
    result = CliRunner().invoke(
        cli, ["new", "law", "-i", "vfric", "-l", "c", "-d", str(tmp_path / "file" / "below")]
    )
    assert result.exit_code == 1 and "cannot be made" in result.stderr
