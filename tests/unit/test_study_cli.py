# SPDX-License-Identifier: MIT
"""`usersub study`: what it prints, writes and refuses."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys

import pytest
from click.testing import CliRunner

from usersub.cli import study_targets
from usersub.cli.main import cli
from usersub.problems.problem import KEYS
from usersub.study import leaving_out, session
from usersub.study.stability import Cell, Limit

_LAW = """#include <usersub/abi.h>
void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {
  for (int i = 0; i < *nBlock; ++i)
    fCoef[i] = props[0] / (1.0 + props[1] * slipRate[i]);
}
"""


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Runs the command in an empty folder, without figures and measurements that take long."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(leaving_out, "measure", lambda **_: [])
    monkeypatch.setattr("usersub.study.canvas.require", _no_figures)
    return lambda *words: CliRunner().invoke(cli, ["study", *words], catch_exceptions=False)


def _no_figures():
    from usersub.errors import MissingTool

    raise MissingTool("matplotlib is not installed")


def test_json_has_the_keys_of_all_results(run, tmp_path):
    done = run("P3", "--language", "c", "--quick", "--json", "--out", "here")
    found = json.loads(done.stdout)
    assert done.exit_code == 0 and found["command"] == "study"
    assert len(found["results"]) == 3
    for result in found["results"]:
        assert set(KEYS) | {"run_time_low", "run_time_high", "refused"} <= set(result)
        assert result["error"] < 1e-12
    assert found["stamp"]["machine"] and found["unfinished"] == 0
    assert found["recommendations"][0]["sentences"]
    assert any("matplotlib" in sentence for sentence in found["missing"])
    for name in ("errors.csv", "results.csv", "results.json", "study.json"):
        assert (tmp_path / "here" / name).is_file()


def test_the_same_command_goes_on(run, tmp_path):
    words = ("p3", "--language", "c", "--step", "2", "--block", "8", "--repeats", "2")
    first, second = run(*words), run(*words)
    assert first.exit_code == second.exit_code == 0
    assert "1 point, 2 runs;" in first.stdout and "0 runs, 2 were there;" in second.stdout
    assert "results: study-P3" in second.stdout and (tmp_path / "study-P3").is_dir()
    other = run("P3", "--language", "c", "--step", "4")
    assert other.exit_code == 1 and "study-P3 holds another study" in other.stderr
    assert run(*words, "--fresh").stdout.count("were there") == 0


def test_a_second_study_is_compared(run, tmp_path):
    words = ("P13", "--language", "c", "--quick", "--interface", "fric", "--repeats", "1")
    assert run(*words, "--out", "a").exit_code == 0
    shutil.copytree(tmp_path / "a", tmp_path / "b")  # the same times: there is nothing to run
    done = run(*words, "--out", "b", "--compare", "a")
    assert done.exit_code == 0 and ", 0 differ; all of them: comparison.csv" in done.stdout
    lines = (tmp_path / "b" / "comparison.csv").read_text().splitlines()
    assert lines[0] == "about,what,here,there,verdict" and len(lines) > 10
    # A study whose answers are others: what is compared is read from the folder.
    table = tmp_path / "a" / "results.json"
    found = json.loads(table.read_text())
    for row in found["results"]:
        row["error"] = 0.5
    table.write_text(json.dumps(found))
    done = run(*words, "--out", "b", "--compare", "a", "--json")
    assert done.exit_code == 1
    told = [c for c in json.loads(done.stdout)["comparison"] if c["verdict"] == "differs"]
    assert any(c["what"] == "for 1e-3" and "nothing" in c["there"] for c in told)


def test_a_folder_to_compare_with_must_hold_a_study(run, tmp_path):
    done = run("P3", "--language", "c", "--compare", "nowhere")
    assert done.exit_code == 1 and "holds no finished study" in done.stderr
    (tmp_path / "results.json").write_text("[")
    done = run("P3", "--language", "c", "--compare", ".")
    assert done.exit_code == 1 and "cannot be read" in done.stderr


def test_an_interrupted_study_says_so(run, monkeypatch):
    real = session.timing.turns

    def stop(points, done, repeats):
        yield next(real(points, done, repeats))
        raise KeyboardInterrupt

    words = ("P3", "--language", "c", "--step", "2", "--block", "8", "--repeats", "2")
    with monkeypatch.context() as patch:
        patch.setattr(session.timing, "turns", stop)
        done = run(*words)
    assert done.exit_code == 130
    assert "interrupted: 1 point is not finished" in done.stdout
    assert run(*words).exit_code == 0


def test_a_routine_gets_the_diagram_the_extremes_and_the_savings(run, tmp_path, monkeypatch):
    (tmp_path / "my_law.c").write_text(_LAW)
    asked = {}

    def matrix(**given):
        asked["matrix"] = given
        return [Cell("slip", "1e300", "mine", "vfric_coef", "c", "double", "fails", "NaN")]

    monkeypatch.setattr("usersub.study.stability.matrix", matrix)
    monkeypatch.setattr(leaving_out, "measure", lambda **given: asked.update(savings=given) or [])
    done = run("my_law.c", "-i", "vfric_coef", "--props", "0.3,0.5", "--quick", "--step", "24",
               "--precision", "double")  # fmt: skip
    assert "slide-hold-slide" in done.stdout and "pressure cycle" in done.stdout
    assert asked["matrix"]["props"] == asked["savings"]["props"] == (0.3, 0.5)
    assert asked["matrix"]["routine"].interface.name == "vfric_coef"
    assert asked["matrix"]["scales"].slip > 0.0
    assert done.exit_code == 1  # since a cell fails
    assert "fails: slip, VFRIC_COEF: NaN" in done.stdout


def test_stability_alone(run, monkeypatch):
    cell = Cell("slip", "1e300", "coulomb", "fric", "c", "double", "stable")
    monkeypatch.setattr("usersub.study.stability.matrix", lambda **given: [cell])
    done = run("--stability", "coulomb", "--quick")
    assert done.exit_code == 0 and "FRIC" in done.stdout
    limit = Limit("step", "kinematic", "vfric", "c", "double", 1.99, 2.0, 0.995, "-")
    monkeypatch.setattr("usersub.study.stability.limits", lambda **given: [limit])
    assert "1.99" in run("--stability", "--quick").stdout
    assert "--stability takes laws" in run("--stability", "P3").stderr


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        (("P99",), 2, "no problem, law or file 'P99'; did you mean 'P9'?"),
        (("colomb",), 2, "did you mean 'coulomb'?"),
        (("nothing.f90",), 1, "there is no file nothing.f90"),
        (("a.f", "b.f"), 2, "expected one file"),
        (("a.f", "coulomb"), 2, "say with --law coulomb"),
        (("P3", "--law", "coulomb"), 2, "--law is for the routine of a FILE"),
        (("P3", "--interface", "vfric"), 1, "nothing to study"),
        (("P3", "--step", "0"), 2, "0 is not in the range"),
        (("P3", "--html", "no/where.html"), 1, "there is no folder no"),
        (("P3", "--html", "page.html"), 1, "matplotlib is not installed"),
        (("P3", "--scheduler", "nonsense://"), 1, ""),
    ],
)
def test_nonsense_is_refused(run, words, code, message):
    done = run(*words)
    assert done.exit_code == code and message in done.stderr, done.output


@pytest.mark.parametrize(
    ("chosen", "name"),
    [
        ({}, "study"),
        ({"problems": ("P1", "slide-hold-slide")}, "study-P1-slide-hold-slide"),
        ({"routine": "some/my_law.f90", "laws": ("coulomb",)}, "study-my_law"),
        ({"problems": tuple("abcdef")}, "study-a-b-c-d-and-more"),
    ],
)
def test_the_folder_is_named_after_what_is_studied(chosen, name):
    targets = study_targets.Targets(**chosen)
    assert study_targets.folder_name(targets, stability=False, quick=False) == name
    assert study_targets.folder_name(targets, stability=True, quick=True).startswith(name)


def test_the_command_imports_nothing_heavy():
    code = (
        "import sys, usersub.cli.study; "
        "print(sorted({'numpy', 'numba', 'matplotlib', 'dask', 'rich'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
