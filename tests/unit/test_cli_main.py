# SPDX-License-Identifier: MIT
"""The command line as a whole: help, start-up, mistyped words, errors, `abi` and `paths`."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from click.testing import CliRunner

from usersub import abi
from usersub.cli.main import cli

COMMANDS = ("demo", "run", "info", "new", "abi", "paths")
HEAVY = ("numpy", "numba", "scipy", "matplotlib", "rich", "elftools", "cffi", "typer")


def run(*args: str):
    return CliRunner().invoke(cli, args, prog_name="usersub")


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help_with_examples(command):
    result = run(command, "--help")
    assert result.exit_code == 0
    assert "Examples:\n  usersub " + command in result.stdout
    assert "--json" in result.stdout and "--debug" in result.stdout


def test_help_lists_all_commands():
    result = run("--help")
    assert result.exit_code == 0
    for command in COMMANDS:
        assert f"\n  {command} " in result.stdout


@pytest.mark.parametrize("args", [["--help"], ["--version"], ["run", "--help"], ["demo", "--help"]])
def test_help_imports_nothing_heavy(args):
    code = (
        "import sys\nfrom usersub.cli.main import cli\n"
        f"try:\n    cli({args!r})\nexcept SystemExit:\n    pass\n"
        f"print(sorted(set({HEAVY!r}) & set(sys.modules)), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stderr.strip() == "[]"


def test_python_dash_m():
    done = subprocess.run(
        [sys.executable, "-m", "usersub", "--version"], capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith("usersub ")


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (["dmeo"], "Did you mean 'demo'?"),
        (["xyzzy"], "No such command 'xyzzy'. Commands: demo, run"),
        (["abi", "--jsno"], "--json"),
        (["abi", "vfriktion"], "did you mean 'vfriction'?"),
        (["abi", "vfric", "fric"], "unexpected extra argument"),
        (["abi", "vfric", "--generation", "legacy"], "VFRIC has one generation only"),
        (["abi", "--generation", "2020"], "2020"),
        (["run"], "Missing argument"),
        (["new", "a"], "Missing option"),
        (["new", "a", "-i", "frik", "-l", "c"], "did you mean 'fric'?"),
        (["new", "a", "-i", "fric", "-l", "rust"], "rust"),
        (["new", "1a", "-i", "fric", "-l", "c"], "'1a' must be letters"),
        (["new", "../a", "-i", "fric", "-l", "c"], "must be letters"),
        (["new", "numpy", "-i", "fric", "-l", "python"], "would hide the Python module"),
        (["new", "json", "-i", "fric", "-l", "c"], "would hide the Python module"),
        (["paths", "--prefix", "--library"], "--prefix and --library: expected one"),
        (["new", "class", "-i", "fric", "-l", "python"], "keyword"),
        (["new", "usersub", "-i", "fric", "-l", "python"], "would hide the Python module"),
        (["--nonsense"], "--nonsense"),
    ],
)
def test_mistyped(args, words):
    result = run(*args)
    assert result.exit_code == 2
    assert words in result.stderr
    assert "Traceback" not in result.output


def test_no_command_shows_help():
    result = run()
    assert "Commands:" in result.output


def test_error_is_one_sentence(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text("speed = 3\n")
    result = run("run", str(path))
    assert result.exit_code == 1
    assert result.stdout == ""
    assert result.stderr.startswith(f"usersub run: {path}: the scene file has no key 'speed'")
    assert result.stderr.count("\n") == 1


def test_error_for_programs(tmp_path):
    result = run("run", str(tmp_path / "none.toml"), "--json")
    assert result.exit_code == 1
    found = json.loads(result.stdout)
    assert found["command"] == "run" and found["results"] == []
    assert "no such scene file" in found["error"]["message"]
    assert found["error"]["kind"] == "SceneError"


def test_debug_shows_the_traceback(tmp_path):
    result = run("run", str(tmp_path / "none.toml"), "--debug")
    assert result.exit_code == 1
    assert "Traceback" in result.stderr


@pytest.mark.parametrize("name", abi.NAMES)
def test_abi_prints_every_argument(name):
    result = run("abi", name.upper())
    assert result.exit_code == 0
    for face in abi.INTERFACES:
        if face.name == name:
            for arg in face.args:
                assert arg.modern in result.stdout
    assert abi.abi_hash() in result.stdout


def test_abi_for_programs():
    found = json.loads(run("abi", "vfriction", "--json").stdout)
    assert found["command"] == "abi"
    assert found["abi_version"] == abi.ABI_VERSION and found["abi_hash"] == abi.abi_hash()
    (face,) = found["results"]
    arguments = {a["name"]: a for a in face["arguments"]}
    assert len(arguments) == 39
    assert arguments["dircosN"]["position"] == 28
    # Dimensions are in the same spelling as the names.
    assert arguments["jConSecUid"]["shape"] == ["nNodSec", "nBlock"]
    assert arguments["jConSecUid"]["older_name"] == "jConSlvUid"


def test_abi_overview():
    found = json.loads(run("abi", "--json").stdout)
    assert [f["interface"] for f in found["results"]] == [f.name for f in abi.INTERFACES]
    assert "VFRIC_COEF" in run("abi").stdout


def test_abi_of_one_generation():
    found = json.loads(run("abi", "fric_coef", "--generation", "legacy", "--json").stdout)
    assert [f["generation"] for f in found["results"]] == ["legacy"]
    assert found["results"][0]["arguments"][12]["name"] == "slipRate"


def test_paths():
    result = run("paths", "--include")
    assert result.exit_code == 0
    folder = result.stdout.strip()
    found = json.loads(run("paths", "--json").stdout)["results"]
    assert {r["name"] for r in found} == {"prefix", "include", "library", "cmake", "pkgconfig"}
    assert folder in {r["path"] for r in found}
