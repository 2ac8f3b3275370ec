# SPDX-License-Identifier: MIT
"""`usersub check`: what it prints, writes and returns."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from bad_routines import write
from click.testing import CliRunner
from test_check_reproduce import COUNTS

from usersub.check.case import Case
from usersub.cli.main import cli

#: Rules that need little time and that the routines here keep.
QUICK = ("--rule", "repeat.same", "--rule", "zero.area")


def check(*args: object):
    return CliRunner().invoke(cli, ["check", *map(str, args)], prog_name="usersub")


@pytest.fixture(scope="module")
def healthy(tmp_path_factory):
    return write(tmp_path_factory.mktemp("cli"), "healthy")


@pytest.fixture(scope="module")
def counting(tmp_path_factory):
    file = tmp_path_factory.mktemp("cli") / "counts.c"
    file.write_text(COUNTS)
    return file


def test_a_healthy_routine(healthy):
    result = check(healthy, "--props", "0.3", *QUICK)
    assert result.exit_code == 0, result.stdout + result.stderr
    for words in (
        "healthy.c: VFRIC_COEF, double precision: 1 passed, 1 not checked",
        "0.3 (given)", "does not apply:", "zero.area: it is about VFRIC, VFRICTION",
    ):  # fmt: skip
        assert words in result.stdout
    assert result.stderr == ""


def test_a_failure_is_told_first_and_can_be_seen_again(counting):
    result = check(counting, "--props", "0.3", *QUICK)
    assert result.exit_code == 1
    places = [
        result.stdout.index(words)
        for words in (
            "FAIL  repeat.same",
            "case       1 contact point",
            "check.reproduce(",
            "not checked in",
            "does not apply:",
        )  # fmt: skip
    ]
    assert places == sorted(places)


def test_json(counting):
    result = check(counting, "--props", "0.3", "--json", *QUICK)
    whole = json.loads(result.stdout)
    assert result.exit_code == 1 and whole["command"] == "check" and "version" in whole
    first, second = whole["results"]
    assert (first["rule"], first["verdict"]) == ("repeat.same", "fail")
    assert (second["rule"], second["verdict"]) == ("zero.area", "not-applicable")
    for key in ("detail", "where", "interface", "precision", "severity", "reproduction", "file"):
        assert key in first
    assert Case.from_json(json.dumps(first["smallest_input"]["case"])).points == 1
    (report,) = whole["reports"]
    assert report["head"]["interface"] == "vfric_coef" and report["ok"] is False


def test_what_the_scene_has_can_be_given(healthy):
    options = ("--temperatures", "--fields", "2", "--states", "0", "--props", "0.3")
    result = check(healthy, *options, *QUICK)
    for words in ("yes (given)", "field variables  2 (given)"):
        assert words in result.stdout
    found = json.loads(
        check("coulomb", "-i", "fric_coef", "--anisotropic", "--json", *QUICK).stdout
    )
    values = {v["name"]: v for v in found["reports"][0]["head"]["values"]}
    assert (values["anisotropic"]["value"], values["anisotropic"]["origin"]) == ("yes", "given")


def test_what_a_file_prints_when_it_is_loaded_is_no_json(tmp_path):
    file = tmp_path / "talks.py"
    file.write_text(
        "import usersub\nprint('hello')\n"
        "@usersub.vfric_coef(compiled=False)\ndef mine(fCoef, props):\n    fCoef[:] = props[0]\n"
    )
    result = check(file, "--props", "0.3", "--json", *QUICK)
    assert json.loads(result.stdout)["results"] and "hello" in result.stderr


def test_junit_and_html(healthy, tmp_path):
    pytest.importorskip("matplotlib")
    junit, html = tmp_path / "report.xml", tmp_path / "report.html"
    result = check(healthy, "--props", "0.3", "--junit", junit, "--html", html, *QUICK)
    assert result.exit_code == 0, result.output
    assert ElementTree.parse(junit).getroot().get("tests") == "2"
    assert html.read_text(encoding="utf-8").lstrip().lower().startswith("<!doctype html")


def test_an_expected_failure(counting, healthy, tmp_path):
    known = tmp_path / "known.txt"
    known.write_text("repeat.same  # it counts its calls\nrepeat.sam\n")
    result = check(counting, "--props", "0.3", "--expect-file", known, *QUICK)
    assert result.exit_code == 0 and "expected failures:" in result.stdout
    assert "note: known.txt:2: no rule is called 'repeat.sam'; did you mean" in result.stdout
    passed = check(healthy, "--props", "0.3", "--expect-file", known, *QUICK)
    assert passed.exit_code == 1 and "expected to fail, but passed:" in passed.stdout


def test_a_rule_that_is_left_out(counting, tmp_path):
    skip = tmp_path / "skip.txt"
    skip.write_text("vfric_coef: repeat  # later\n")
    result = check(counting, "--props", "0.3", "--skip-file", skip, *QUICK)
    assert result.exit_code == 0
    assert "repeat.same: left out as asked skip.txt:1 (later)" in result.stdout


def test_warnings_count_when_strict(tmp_path):
    file = tmp_path / "counts.c"
    file.write_text(COUNTS)
    options = (file, "--props", "0.3", "--rule", "data.shared")
    relaxed, strict = check(*options), check(*options, "--strict")
    assert "WARNING  data.shared" in relaxed.stdout
    assert (relaxed.exit_code, strict.exit_code) == (0, 1)


def test_several_routines(healthy, counting):
    result = check(healthy, counting, "gone.c", "--props", "0.3", *QUICK)
    assert result.exit_code == 1
    assert "usersub check: gone.c: there is no file" in result.stderr
    table = result.stdout[result.stdout.index("verdict") :]
    assert "healthy.c" in table and "ok" in table
    assert "counts.c" in table and "FAILED" in table and "repeat.same" in table


def test_several_routines_at_a_time_give_the_same(healthy, counting):
    options = ("--props", "0.3", "--json", *QUICK)

    def told(*more):
        whole = json.loads(check(healthy, counting, *options, *more).stdout)
        return [(r["file"], r["rule"], r["verdict"]) for r in whole["results"]]

    assert told("--jobs", "2") == told()


def test_one_file_that_cannot_be_loaded(tmp_path):
    result = check(tmp_path / "gone.c")
    assert result.exit_code == 1 and result.stderr.startswith("usersub check: there is no file")
    found = json.loads(check(tmp_path / "gone.c", "--json").stdout)
    assert found["error"]["kind"] == "LoadError"


def test_both_precisions(healthy):
    found = json.loads(check(healthy, "--precision", "both", "--json", *QUICK).stdout)
    assert [r["head"]["precision"] for r in found["reports"]] == ["double", "single"]


def test_the_rules_are_listed():
    result = check("--list-rules")
    assert result.exit_code == 0
    for words in ("repeat.same", "error", "VFRIC VFRICTION"):
        assert words in result.stdout
    rows = json.loads(check("--list-rules", "--rule", "repeat", "--json").stdout)["results"]
    assert {r["rule"].partition(".")[0] for r in rows} == {"repeat"}
    assert all(r["requirement"] and r["reference"] and r["severity"] for r in rows)


@pytest.mark.parametrize(
    ("args", "code", "words"),
    [
        ((), 2, "Missing argument 'ROUTINE...'"),
        (("a.c", "--precision", "quad"), 2, "quad"),
        (("a.c", "--interface", "frik"), 2, "fric"),
        (("a.c", "--states", "-1"), 2, "-1"),
        (("a.c", "--junit", "gone/a.xml"), 1, "--junit is gone/a.xml, but there is no folder gone"),
        (("a.c", "--props", "x"), 1, "--props has 'x', expected numbers"),
        (("a.c", "--rule", "repeat.sam"), 1, "did you mean 'repeat.same'"),
        (("a.c", "--law", "coulom"), 1, "did you mean 'coulomb'"),
        (("a.c", "--skip-file", "gone.txt"), 1, "gone.txt cannot be read"),
    ],
)
def test_mistakes(args, code, words):
    result = check(*args)
    assert result.exit_code == code and words in result.stderr


def test_help_imports_nothing_heavy():
    code = (
        "import sys\nfrom usersub.cli.main import cli\n"
        "try:\n    cli(['check', '--help'])\nexcept SystemExit:\n    pass\n"
        "heavy = {'numpy', 'numba', 'cffi', 'rich', 'matplotlib', 'multiprocessing'}\n"
        "print(sorted(heavy & set(sys.modules)), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stderr.strip() == "[]"
    assert "Examples:\n  usersub check my_friction.f90" in done.stdout


def test_interrupted(tmp_path):
    """Ctrl-C in the middle of an endless loop: the command ends, and nothing keeps running."""
    import signal
    import time

    file = write(tmp_path, "loops")
    command = subprocess.Popen(
        [sys.executable, "-m", "usersub", "check", str(file), "--props", "0.3"],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True,
        env={**os.environ, "TMPDIR": str(tmp_path)},
    )  # fmt: skip
    for _ in range(1000):
        if list(tmp_path.glob("usersub-check-*/*")):
            break
        time.sleep(0.02)
    command.send_signal(signal.SIGINT)
    command.communicate(timeout=30)
    assert command.returncode != 0
    for _ in range(200):
        if not _works_below(tmp_path):
            return
        time.sleep(0.05)
    pytest.fail("a child outlives the command")


def _works_below(folder) -> bool:
    """Whether the working directory of any process is in a folder."""
    for place in Path("/proc").glob("[0-9]*/cwd"):
        try:
            if place.readlink().is_relative_to(folder):
                return True
        except OSError:  # it has ended, or is not ours
            continue
    return False
