# SPDX-License-Identifier: MIT
"""Reproductions: the three lines run by themselves and show the failure again."""

from __future__ import annotations

import math
import subprocess
import sys

import pytest
from bad_routines import write

import usersub.check as check
from usersub.check.case import one
from usersub.check.running.reproduce import reproduce, reproduction
from usersub.check.subject import Scales
from usersub.check.subjects.targets import subjects, wishes
from usersub.errors import LoadError, SceneError

#: A routine that counts its calls, and so does not repeat.
COUNTS = """\
#include <usersub/abi.h>
static int calls;
void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {
  for (int k = 0; k < *nBlock; ++k)
    fCoef[k] = props[0] + 1e-3 * ++calls;
}
"""


@pytest.fixture(scope="module")
def counting(tmp_path_factory):
    file = tmp_path_factory.mktemp("counting") / "counts.c"
    file.write_text(COUNTS)
    return file


@pytest.fixture(scope="module")
def failure(counting):
    (report,) = check.check(counting, rules=["repeat.same"], props=[0.3])
    return report["repeat.same"]


def run(text):
    return subprocess.run([sys.executable, "-c", text], capture_output=True, text=True)


def test_three_lines_show_the_failure_again(failure, tmp_path):
    assert failure.verdict == "fail" and failure.case is not None
    assert len(failure.reproduction.splitlines()) == 3
    done = run(failure.reproduction)
    assert done.returncode == 0, done.stderr
    assert "FAIL  repeat.same" in done.stdout and failure.detail.split(" is ")[0] in done.stdout


def test_the_finding_comes_back(counting, failure, capsys):
    found = reproduce(
        counting, "repeat.same", failure.case, props=[0.3], temperatures=False, states=0
    )
    assert found is not None and found.case == failure.case
    assert "FAIL  repeat.same" in capsys.readouterr().out


def test_in_this_process_for_a_debugger(counting, failure, capsys):
    found = reproduce(counting, "repeat.same", failure.case, props=[0.3], apart=False)
    assert found is not None and found.detail in capsys.readouterr().out


def test_a_routine_that_was_mended(tmp_path, failure, capsys):
    mended = write(tmp_path, "healthy")
    assert reproduce(mended, "repeat.same", failure.case, props=[0.3]) is None
    assert "repeat.same: pass" in capsys.readouterr().out


def test_the_whole_rule_without_a_case(counting, capsys):
    assert reproduce(counting, "repeat.same", props=[0.3]) is not None
    assert "FAIL" in capsys.readouterr().out


def test_a_routine_that_ends_the_process(tmp_path, capsys):
    file = write(tmp_path, "exits")
    found = reproduce(file, "process.stop", one((1e-2, 0.0)), props=[0.3])
    assert found is not None and "exit" in capsys.readouterr().out


def test_all_that_differs_from_the_defaults_stands_in_the_lines(counting):
    scales = {"slip": 2.5, "fields": (1.0, 2.0)}
    wish = wishes(
        precision="single", law="coulomb", props=[0.3, 1e-4], states=0, fields=2,
        temperatures=False, scales=scales,
    )  # fmt: skip
    (subject,) = subjects(counting, wish)
    last = reproduction(subject, "a.b", one((math.nan, -math.inf))).splitlines()[2]
    for part in (
        f"check.reproduce({str(counting)!r}, 'a.b', Case(", "interface='vfric_coef'",
        "precision='single'", "law='coulomb'", "props=(0.3, 0.0001)", "fields=2",
        "temperatures=False", "scales={'slip': 2.5, 'fields': (1.0, 2.0)}",
        "float(\"nan\"), -float(\"inf\")",
    ):  # fmt: skip
        assert part in last, part
    assert "states=" not in last and Scales(**scales) == subject.scales


def test_a_path_with_odd_characters(tmp_path):
    folder = tmp_path / 'it\'s "odd" \\ ü'
    folder.mkdir()
    file = folder / "counts.c"
    file.write_text(COUNTS)
    (subject,) = subjects(file, wishes(props=[0.3]))
    done = run(reproduction(subject, "repeat.same", one((1e-2, 0.0), (1e-2, 0.0))))
    assert "FAIL" in done.stdout, done.stderr


@pytest.mark.parametrize(
    ("arguments", "options", "error", "words"),
    [
        (("repeat.sam",), {}, LoadError, "no rule is called 'repeat.sam'; did you mean"),
        (("repeat.same",), {"prop": [1]}, TypeError, "unexpected keyword argument 'prop'"),
        (("repeat.same",), {"props": ["x"]}, SceneError, "expected finite numbers"),
        (("repeat.same",), {"interface": "fric"}, LoadError, "has no FRIC"),
    ],
)
def test_mistakes(counting, arguments, options, error, words):
    with pytest.raises(error, match=words):
        reproduce(counting, *arguments, **options)


def test_several_interfaces_need_a_choice(capsys):
    from usersub import laws

    file = laws.path("coulomb", "c")
    with pytest.raises(LoadError, match="several interfaces; give interface=, one of 'fric'"):
        reproduce(file, "repeat.same", props=[0.3])
    assert reproduce(file, "repeat.same", props=[0.3], interface="vfric_coef") is None
