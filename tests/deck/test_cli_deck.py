# SPDX-License-Identifier: MIT
"""`usersub deck`: tables, JSON, exit codes."""

import json

from click.testing import CliRunner

from usersub.cli.main import cli

TEXT = """\
*SURFACE INTERACTION, NAME=plain
*FRICTION, TAUMAX=50.
0.3
*SURFACE INTERACTION, NAME=glued
*FRICTION, ROUGH
*SURFACE INTERACTION, NAME=own
*FRICTION, USER, TAUMAX=2.
*SURFACE INTERACTION, NAME=none
*GAP, ELSET=g
*FRICTION
0.1, 100.
*STEP
*STATIC
*CHANGE FRICTION, INTERACTION=plain
*FRICTION
0.2
*CHANGE FRICTION, INTERACTION=glued, RESET
*END STEP
"""


def run(tmp_path, *options, text=TEXT):
    (tmp_path / "a.inp").write_text(text)
    return CliRunner().invoke(cli, ["deck", str(tmp_path / "a.inp"), *options], prog_name="usersub")


def test_table(tmp_path):
    result = run(tmp_path)
    assert result.exit_code == 0, result.stderr
    for words in (
        "standard", "plain", "mu = 0.3", "shear stress up to 50", "FRIC_COEF", "frictionless",
        "GAP g", "change", "original friction", "rough", "own, line 6, does not run: TAUMAX",
        "note: ", "stick slope",
    ):  # fmt: skip
        assert words in result.stdout


def test_json(tmp_path):
    result = run(tmp_path, "--json")
    found = json.loads(result.stdout)
    assert (found["command"], found["solver"], len(found["steps"])) == ("deck", "standard", 1)
    plain, glued, own, _, _, change, reset = found["results"]
    assert plain["settings"] == {"props": [0.3], "shear_limit": 50.0}
    assert plain["friction"]["law"]["type"] == "Table"
    assert glued["interface"] == "fric" and not glued["not_runnable"]
    assert own["not_runnable"] and own["settings"] is None
    assert (change["kind"], change["step"], reset["kind"]) == ("change", 1, "reset")
    assert found["warnings"][0]["line"] == 10


def test_dialect_and_solver(tmp_path):
    text = "*SURFACE INTERACTION, NAME=A\n*FRICTION\n0.3, 1e3\n"
    assert "stick slope 1000" in run(tmp_path, "--dialect", "calculix", text=text).stdout
    assert "VFRIC_COEF" in run(tmp_path, "--solver", "explicit", text=text).stdout
    assert run(tmp_path, "--solver", "other").exit_code == 2


def test_errors_have_file_and_line(tmp_path):
    result = run(tmp_path, text="*SURFACE INTERACTION, NAME=A\n*FRICTION, ROUGH, USER\n")
    assert result.exit_code == 1
    assert "a.inp:2: *FRICTION: ROUGH and USER exclude one another" in result.stderr
    failed = json.loads(run(tmp_path, "--json", text="*FRICTION\n").stdout)
    assert failed["error"]["kind"] == "DeckError"
