# SPDX-License-Identifier: MIT
"""`pytest --usersub-routine`: in an empty folder, beside other tests, in several processes."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.metadata import entry_points

import pytest
from bad_routines import write
from test_check_reproduce import COUNTS

#: Rules that need little time.
QUICK = ("--usersub-rule", "repeat.same", "--usersub-rule", "zero.area")
PLUGIN = "usersub.check.pytest_plugin"


@pytest.fixture
def run(tmp_path):
    """Runs pytest in a folder of its own; gives exit code and what it printed."""
    known = any(entry.value == PLUGIN for entry in entry_points(group="pytest11"))
    load = () if known else ("-p", PLUGIN)
    folder = tmp_path / "folder"
    folder.mkdir()

    def run(*args, code=""):
        options = ["-p", "no:cacheprovider", "-W", "ignore::pytest.PytestAssertRewriteWarning"]
        command = [sys.executable, *(("-c", code) if code else ("-m", "pytest"))]
        done = subprocess.run(
            [*command, *load, *options, *map(str, args)],
            cwd=folder, capture_output=True, text=True,
        )  # fmt: skip
        return done.returncode, done.stdout + done.stderr

    run.folder = folder
    return run


@pytest.fixture(scope="module")
def healthy(tmp_path_factory):
    return write(tmp_path_factory.mktemp("plugin"), "healthy")


@pytest.fixture(scope="module")
def counting(tmp_path_factory):
    file = tmp_path_factory.mktemp("plugin") / "counts.c"
    file.write_text(COUNTS)
    return file


def test_in_an_empty_folder(run, healthy):
    code, text = run("--usersub-routine", healthy, "--usersub-props", "0.3", *QUICK, "-v", "-rs")
    assert code == 0, text
    assert "healthy.c[vfric_coef-double]::repeat.same PASSED" in text
    assert "not-applicable: it is about VFRIC, VFRICTION" in text
    assert "1 passed, 1 skipped" in text and "usersub checks " in text
    assert not [f for f in run.folder.rglob("*") if "__pycache__" not in f.parts]


def test_a_failure_in_the_words_of_the_report(run, counting):
    path = os.path.relpath(counting, run.folder)
    code, text = run("--usersub-routine", path, "--usersub-props=0.3", *QUICK)
    assert code == 1
    for words in ("FAIL  repeat.same", "case       1 contact point", "check.reproduce("):
        assert words in text
    assert "Traceback" not in text


def test_beside_other_tests_and_chosen_among(run, healthy):
    (run.folder / "test_own.py").write_text("def test_own():\n    pass\n")
    options = ("--usersub-routine", healthy, "--usersub-props", "0.3", *QUICK)
    assert "2 passed, 1 skipped" in run(*options)[1]
    assert "1 passed, 2 deselected" in run(*options, "-k", "repeat")[1]
    assert "1 passed, 2 deselected" in run(*options, "-k", "test_own")[1]


def test_several_routines_in_several_processes(run, healthy, counting):
    pytest.importorskip("xdist")
    code, text = run(
        "--usersub-routine", healthy, "--usersub-routine", counting, "--usersub-props", "0.3",
        "--usersub-precision", "both", *QUICK, "-n", "2",
    )  # fmt: skip
    assert code == 1 and "2 failed, 2 passed, 4 skipped" in text


def test_expected_failures(run, healthy, counting, tmp_path):
    (tmp_path / "known.txt").write_text("repeat.same # counts\nrepeat.sam\n")
    options = ("--usersub-props", "0.3", "--usersub-expect-file", "../known.txt", *QUICK)
    code, text = run("--usersub-routine", counting, *options, "-rx")
    assert code == 0 and "1 skipped, 1 xfailed" in text
    assert "known.txt:2: no rule is called 'repeat.sam'" in text
    code, text = run("--usersub-routine", healthy, *options)
    assert code == 1 and "repeat.same was expected to fail, but passed" in text


def test_rules_that_are_left_out(run, counting, tmp_path):
    (tmp_path / "skip.txt").write_text("repeat # later\n")
    options = ("--usersub-props", "0.3", "--usersub-skip-file", "../skip.txt", *QUICK)
    code, text = run("--usersub-routine", counting, *options, "-rs")
    assert code == 0 and "left out as asked skip.txt:1 (later)" in text


def test_warnings(run, counting):
    options = ("--usersub-routine", counting, "--usersub-props", "0.3")
    options += ("--usersub-rule", "data.shared")
    code, text = run(*options)
    assert code == 0 and "1 passed, 1 warning" in text and "data.shared: " in text
    code, text = run(*options, "--usersub-strict")
    assert code == 1 and "WARNING  data.shared" in text


def test_a_routine_that_ends_the_process(run, tmp_path):
    file = write(tmp_path, "exits")
    code, text = run(
        "--usersub-routine", file, "--usersub-props", "0.3", "--usersub-states=0",
        "--usersub-rule", "process.stop", "--usersub-rule", "zero.area",
    )  # fmt: skip
    assert code == 1 and "FAIL  process.stop" in text and "1 failed, 1 skipped" in text


def test_a_built_in_law_by_name(run):
    code, text = run(
        "--usersub-routine", "coulomb", "--usersub-interface", "vfric_coef", *QUICK, "-v"
    )
    assert code == 0 and "coulomb[vfric_coef-double]::repeat.same PASSED" in text


def test_junit_of_pytest(run, healthy):
    options = ("--usersub-routine", healthy, "--usersub-props", "0.3", *QUICK)
    assert run(*options, "--junitxml=report.xml")[0] == 0
    assert 'name="repeat.same"' in (run.folder / "report.xml").read_text()


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (("--usersub-routine", "gone.c"), "there is no file"),
        (("--usersub-routine", "coulomb", "--usersub-rule", "repeat.sam"), "did you mean"),
        (("--usersub-routine", "coulomb", "--usersub-props", "x"), "--usersub-props has 'x'"),
        (("--usersub-routine", "coulomb", "--usersub-precision", "quad"), "precision is 'quad'"),
        (("--usersub-routine", "coulomb", "--usersub-skip-file", "gone"), "cannot be read"),
    ],
)
def test_mistakes(run, args, words):
    code, text = run(*args)
    assert code == 4 and words in text and "Traceback" not in text


def test_without_the_option_nothing_is_imported(run):
    (run.folder / "test_own.py").write_text("def test_own():\n    pass\n")
    code, text = run(
        code="import sys, pytest\n"
        "code = pytest.main(sys.argv[1:])\n"
        "print('modules', sorted(m for m in sys.modules if m.split('.')[0] in\n"
        "      ('usersub', 'numpy', 'numba', 'cffi', 'click', 'rich')))\n"
        "sys.exit(code)"
    )
    assert code == 0, text
    modules = text[text.index("modules") :].splitlines()[0]
    assert modules == "modules ['usersub', 'usersub.check', 'usersub.check.pytest_plugin']"
