# SPDX-License-Identifier: MIT
"""`usersub demo` over made-up cases: the table, the verdict, what is left out."""

from __future__ import annotations

import json
from dataclasses import dataclass

import pytest
from click.testing import CliRunner

from usersub import problems
from usersub.cli.main import cli
from usersub.errors import MissingTool, RoutineError
from usersub.routine import compilers


@dataclass
class Made:
    """A case and its outcome in one."""

    problem: str = "P1"
    law: str = "coulomb"
    interface: str = "vfric"
    language: str = "python"
    precision: str = "double"
    method: str = "rigid"
    error: float = 1e-12
    tolerance: float = 1e-9
    error_of: str = "stopping time"
    step: float = 1e-6
    points: int = 64
    run_time_s: float = 0.5
    ns_per_point: float = 12.25
    failure: str = ""

    def run(self) -> Made:
        """The outcome, or the failure."""
        if self.failure:
            raise RoutineError(self.failure)
        return self


@pytest.fixture
def demo(monkeypatch):
    """Runs the command over given cases."""

    def run(cases, *args):
        monkeypatch.setattr(problems, "demo_cases", lambda quick=False: cases, raising=False)
        return CliRunner().invoke(cli, ["demo", *args], prog_name="usersub")

    return run


def test_all_well(demo):
    result = demo([Made(), Made(problem="P2", interface="fric", precision="single")])
    assert result.exit_code == 0
    for words in (
        "P1",
        "P2",
        "VFRIC",
        "single",
        "1e-12",
        "12.2",
        "stopping time",
        "2 of 2 cases within their tolerance",
    ):
        assert words in result.stdout


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        (Made(error=2e-9), "too large"),
        (Made(error=float("nan")), "too large"),
        (Made(failure="it broke"), "FAILED: P1 coulomb vfric python double rigid: RoutineError"),
    ],
)
def test_one_bad_row_fails(demo, bad, words):
    result = demo([Made(), bad])
    assert result.exit_code == 1
    assert words in result.stdout and "1 of 2 cases" in result.stdout
    found = demo([Made(), bad], "--json")
    assert found.exit_code == 1
    rows = json.loads(found.stdout)
    assert rows["ok"] is False and [r["ok"] for r in rows["results"]] == [True, False]


def test_for_programs(demo):
    found = json.loads(demo([Made()], "--json").stdout)
    assert found["command"] == "demo" and found["missing"] == {}
    (row,) = found["results"]
    # The keys that the design promises.
    promised = (
        "problem law interface language precision method step points error error_of "
        "run_time_s ns_per_point"
    )
    assert set(promised.split()) <= set(row)
    assert row["ns_per_point"] == 12.25


def test_missing_compiler_is_one_line(demo, monkeypatch):
    def find(language):
        if language == "fortran":
            raise MissingTool("no Fortran compiler was found; install it with `apt install it`")

    monkeypatch.setattr(compilers, "find", find)
    result = demo([Made(), Made(language="fortran"), Made(language="c")])
    assert result.exit_code == 0
    assert "left out: fortran: no Fortran compiler was found; install it with" in result.stdout
    assert "2 of 2 cases" in result.stdout


def test_choosing(demo):
    cases = [Made(language=k, precision=p) for k in ("python", "c") for p in ("double", "single")]
    found = json.loads(demo(cases, "--language", "c", "--precision", "single", "--json").stdout)
    assert [(r["language"], r["precision"]) for r in found["results"]] == [("c", "single")]
    assert demo(cases, "--problem", "p1").exit_code == 0
    nothing = demo(cases, "--interface", "fric")
    assert (
        nothing.exit_code == 2
        and "no case of the demo is all of --interface fric" in nothing.stderr
    )


def test_unknown_problem(demo):
    result = demo([Made()], "--problem", "P9")
    assert result.exit_code == 2 and "no problem 'P9'" in result.stderr
