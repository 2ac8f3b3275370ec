# SPDX-License-Identifier: MIT
"""Files in the style of the field: the verdicts agree with what careful reading finds.

`field.toml` states for each file what its reader found: the rules that it breaks, each with the
reason. No other rule of severity "error" or "warning" may fail. "Not answered" are rules that apply
and cannot be looked at, with the reason.
"""

import tomllib
from pathlib import Path
from typing import Any

import pytest

from tests import apart
from usersub.check import check

pytestmark = pytest.mark.needs_fortran

HERE = Path(__file__).resolve().parent
FILES = HERE.parent / "field"


def read() -> list[dict[str, Any]]:
    """What readers found, one table a file and interface."""
    with (HERE / "field.toml").open("rb") as stream:
        return tomllib.load(stream)["routine"]


READ = read()


@pytest.mark.parametrize("found", READ, ids=lambda r: f"{Path(r['file']).name}-{r['interface']}")
def test_verdicts_are_those_of_a_careful_reader(found, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    (report,) = apart.run(
        check,
        FILES / found["file"],
        interface=found["interface"],
        jobs=1,
        seconds=600,
        **found.get("with", {}),
    )
    failed = {r.rule: r.detail for r in report.failures if r.severity != "note"}
    assert set(failed) == set(found.get("breaks", {})), f"{failed}\n{report}"
    unanswered = {r.rule: r.detail for r in report.results if r.verdict == "skip"}
    assert set(unanswered) == set(found.get("unanswered", {})), unanswered


def test_almost_every_author_was_read():
    """Not those whose verdicts depend on memory that is not theirs, on their calls or on a file."""
    authors = {
        f"authors/{p.name}"
        for p in (FILES / "authors").iterdir()
        if p.suffix.lower() not in (".inc", ".h", ".dat") and p.name != "helpers.for"
    }
    assert authors - {r["file"] for r in READ} == {
        "authors/heat_state.f",
        "authors/shared_arrays.for",
        "authors/solver_calls.for",
        "authors/static_state.c",
        "authors/table_file.for",
        "authors/text_functions.f",
    }


@pytest.mark.parametrize(
    ("file", "interface", "rules"),
    [
        ("heat_state.f", "fric", ["memory.two-dimensional", "outputs.read", "frame.turn"]),
        ("shared_arrays.for", "vfric_coef", ["repeat.same"]),
        ("solver_calls.for", "fric", ["memory.two-dimensional", "outputs.written", "zero.slip"]),
        ("static_state.c", "vfric", ["memory.two-dimensional", "repeat.threads"]),
        ("text_functions.f", "vfriction", ["memory.properties"]),
    ],
)
def test_what_goes_deepest_is_found(file, interface, rules, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    path = FILES / "authors" / file
    (report,) = apart.run(check, path, interface=interface, rules=rules, jobs=1, seconds=600)
    assert {r.rule for r in report.results if r.verdict == "fail"} == set(rules), str(report)
