# SPDX-License-Identifier: MIT
"""`usersub laws` and `usersub fit`."""

from __future__ import annotations

import json

import pytest
from click.testing import CliRunner

from usersub import abi, laws
from usersub.cli.main import cli


def _run(*words: str):
    return CliRunner().invoke(cli, list(words))


def test_list_of_laws():
    done = _run("laws")
    assert done.exit_code == 0
    for law in laws.LAWS.values():
        assert law.name in done.output


@pytest.mark.parametrize("name", laws.LAWS)
def test_one_law(name):
    done = _run("laws", name)
    assert done.exit_code == 0, done.output
    law = laws.law(name)
    for text in (law.title, law.equations[0], f"usersub.laws.{name}("):
        assert text in done.output
    for prop in law.props:
        assert prop.name in done.output
    for interface in abi.NAMES:
        assert interface.upper() in done.output


def test_json():
    done = _run("laws", "--json")
    found = json.loads(done.stdout)
    assert [row["name"] for row in found["results"]] == list(laws.LAWS)
    (row,) = json.loads(_run("laws", "viscoplastic_creep", "--json").stdout)["results"]
    assert row["interfaces"] == ["fric", "vfric", "vfriction"]
    assert "viscous traction" in row["refused"]["vfric_coef"]
    assert row["props"][0]["name"] == "k"


def test_unknown_law():
    done = _run("laws", "colomb")
    assert done.exit_code == 1
    assert "did you mean 'coulomb'" in done.output


def _measured(tmp_path):
    file = tmp_path / "measured.csv"
    file.write_text("rate,mu\n0,0.3\n0.01,0.234064\n0.02,0.189866\n0.1,0.103663\n1,0.1\n")
    return str(file)


def test_fit(tmp_path):
    done = _run("fit", "exponential_decay", _measured(tmp_path))
    assert done.exit_code == 0, done.output
    assert "usersub.laws.exponential_decay(mus=0.29999" in done.output
    assert "standard error" in done.output


def test_fit_with_choices_as_json(tmp_path):
    file = _measured(tmp_path)
    words = ["--fixed", "mus=0.3", "--start", "dc=10", "--bound", "muk=:0.5", "--json"]
    found = json.loads(_run("fit", "exponential_decay", file, *words).stdout)
    rows = {row["name"]: row for row in found["results"]}
    assert rows["mus"]["fixed"] and rows["mus"]["value"] == 0.3
    assert rows["dc"]["value"] == pytest.approx(40.0, rel=1e-4)
    assert found["names"] == ["muk", "dc"] and found["degrees"] == 3


def test_fit_warns(tmp_path):
    file = tmp_path / "flat.csv"
    file.write_text("rate,mu\n0,0.3\n1,0.3\n2,0.3\n3,0.3\n")
    done = _run("fit", "exponential_decay", str(file))
    assert done.exit_code == 0
    assert "warning: dc is not identified" in done.output


@pytest.mark.parametrize(
    ("words", "code", "told"),
    [
        (["coulomb", "none.csv"], 1, "none.csv: cannot be read"),
        (["coulomb", "none.csv", "--fixed", "mu=x"], 2, "'x' is no number"),
        (["coulomb", "none.csv", "--bound", "mu=1"], 2, "expected NAME=LOW:HIGH"),
    ],
)
def test_fit_refuses(words, code, told):
    done = _run("fit", *words)
    assert done.exit_code == code
    assert told in done.output
