# SPDX-License-Identifier: MIT
"""Orders of convergence, and the page of the documentation that shows what was measured."""

from __future__ import annotations

import json
import math
import re
import shutil
from pathlib import Path

import pytest

from usersub import problems
from usersub.problems import __main__ as command
from usersub.problems import convergence, page
from usersub.problems.convergence import EXACT, IRREGULAR, SMOOTH, Row, Study
from usersub.problems.measured import measure

PAGE = Path(__file__).resolve().parents[2] / "docs/explanation/problems.md"

#: How far an observed order may be off: the finest runs have not quite reached the asymptotic one.
ORDER_TOLERANCE = {1.0: 0.1, 2.0: 0.1, 4.0: 0.3, 8.0: 1.0}


@pytest.fixture(scope="module")
def studies() -> list[Study]:
    return list(convergence.studies())


def test_smooth_methods_have_their_order(studies):
    smooth = [s for s in studies if s.kind == SMOOTH]
    assert {s.expected for s in smooth} == set(ORDER_TOLERANCE)
    for study in smooth:
        tolerance = ORDER_TOLERANCE[study.expected]
        assert study.order == pytest.approx(study.expected, abs=tolerance), study
        assert study.rows[-1].order == study.order


def test_exact_methods_leave_rounding(studies):
    exact = [s for s in studies if s.kind == EXACT]
    assert {s.problem for s in exact} == {"P1", "P3", "P5", "P6", "P7", "P8", "P9"}
    for study in exact:
        # Rounding of some hundred additions.
        assert max(study.errors) < 3e-13, study
        assert study.order is None


def test_finite_element_block_converges(studies):
    irregular = [s for s in studies if s.kind == IRREGULAR]
    assert {(s.problem, s.method) for s in irregular} == {
        (p, m) for p in ("P1", "P2") for m in ("CPE3", "C3D8R")
    }
    for study in irregular:
        assert study.errors[-1] < study.errors[0] / 5.0, study
        # What is left is elasticity, far below the bounds of the unrefined block.
        assert study.remains < 1e-4
        if study.expected is not None:
            assert study.order == pytest.approx(study.expected, abs=0.25)
    assert sum(s.expected is not None for s in irregular) == 2


def test_every_method_that_integrates_is_studied(studies):
    seen = {(s.problem, s.interface, s.method) for s in studies}
    for name in ("P1", "P2"):
        for interface, methods in problems.PROBLEMS[name].methods.items():
            for method in methods:
                assert (name, interface, method) in seen or method.startswith("C")


def test_rows_tell_the_order_between_runs():
    study = Study("P2", "law", "vfric", "m", "time", SMOOTH, 2.0, (4, 8, 24), (9e-3, 3e-3, 1e-4))
    first, second, third = study.rows
    assert first == Row("P2", "law", "vfric", "m", "time", 4, 9e-3, None)
    assert second.order == pytest.approx(math.log2(3.0))
    assert third.order == pytest.approx(math.log(30.0) / math.log(3.0)) == study.order
    mean = Study("P2", "law", "vfric", "m", "time", IRREGULAR, 2.0, study.steps, study.errors)
    assert mean.order == pytest.approx(math.log(90.0) / math.log(6.0))


ROWS = [
    Row("P1", "coulomb", "fric", "implicit", "distance", 8, 2.5e-16, None),
    Row("P2", "decay", "vfric_coef", "rigid", "stopping time", 64, 1.25e-4, 1.9875),
]


def test_command_prints_a_table(monkeypatch, capsys):
    monkeypatch.setattr(convergence, "rows", lambda: ROWS)
    assert command.main([]) == 0
    head, first, second = capsys.readouterr().out.splitlines()
    assert head.split() == ["problem", "interface", "method", "error", "of", "steps", "error",
                            "order"]  # fmt: skip
    assert first.split() == ["P1", "FRIC", "implicit", "distance", "8", "2.500e-16"]
    assert second.endswith("64  1.250e-04   1.99")
    assert len(second) == len(head)


def test_command_prints_json(monkeypatch, capsys):
    monkeypatch.setattr(convergence, "rows", lambda: ROWS)
    assert command.main(["--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found == [row.as_dict() for row in ROWS]
    assert found[0]["order"] is None and found[1]["steps"] == 64


def test_command_says_why_it_cannot_write(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(command, "write_page", lambda path: Path(path).write_text(""))
    assert command.main(["--markdown", str(tmp_path / "nowhere" / "page.md")]) == 1
    assert "nowhere" in capsys.readouterr().err


_STAMP = re.compile(r"Made with .*\.$", re.M)
_NUMBER = re.compile(r"\d\.\de[-+]\d\d|-?\d+\.\d\d")


def _same(old: str, new: str, floor: float) -> bool:
    """Whether a number of the page is still true: errors within a factor of 2, orders within 0.1.

    Below the floor numbers are rounding, which compilers and processors may change.
    """
    if "e" not in old:
        return abs(float(old) - float(new)) <= 0.1
    a, b = max(float(old), floor), max(float(new), floor)
    return 0.5 <= a / b <= 2.0


def _floor(line: str, column: int, precise: bool) -> float:
    if not precise:
        return 1e-7  # nearly cancelled differences of nodes that stick and slip
    single = column in (6, 7) and line.count("|") == 10
    return 2e-7 if single else 1e-13


def differences(old: str, new: str) -> list[str]:
    """Lines of the page that are no longer true."""
    if len(old.splitlines()) != len(new.splitlines()):
        return ["the page has another number of lines"]
    found, precise = [], True
    for a, b in zip(old.splitlines(), new.splitlines(), strict=True):
        precise = precise and not a.startswith("### The finite-element block")
        if a.startswith("|"):
            same = _NUMBER.sub("#", a) == _NUMBER.sub("#", b)
            for column, (x, y) in enumerate(zip(a.split("|"), b.split("|"), strict=False)):
                numbers = zip(_NUMBER.findall(x), _NUMBER.findall(y), strict=False)
                same &= all(_same(*pair, _floor(a, column, precise)) for pair in numbers)
        else:
            same = _STAMP.sub("", a) == _STAMP.sub("", b)
        if not same:
            found.append(f"{a}\n    is now {b}")
    return found


@pytest.fixture(scope="module")
def fresh(studies, outcome_of) -> str:
    fortran = shutil.which("gfortran") is not None
    cases = [c for c in problems.all_cases() if fortran or c.language != "fortran"]
    return page.page(measure(outcome_of, cases), studies, "this run.")


def test_page_is_true(fresh):
    found = differences(PAGE.read_text(encoding="utf-8"), fresh)
    assert not found, "run `make problems`:\n" + "\n".join(found)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (r"(\| P2 \| FRIC \| implicit \| distance .*) 3\.3e-05 ", r"\1 3.3e-04 "),
        (r"(\| P2 \| VFRIC \| rigid rk4 \| distance .*) \d\.\d\d \|$", r"\1 3.50 |"),
        (r"\| VFRIC \| CPE3 \| 185 \| 3\.7e-04 ", "| VFRIC | CPE3 | 185 | 1.7e-03 "),
        (r"4\.866666667e-04|0\.0004866666667", "0.0004866666668"),
        (r"\| viscoplastic_creep \| FRIC ", "| viscoplastic_creep | VFRIC "),
        (r"Young's modulus 30e6", "Young's modulus 31e6"),
        (r"^\| P2 \| FRIC \| implicit \| distance .*\n", ""),
    ],
    ids=["error", "order", "elements", "exact", "name", "prose", "line"],
)
def test_untrue_page_is_noticed(fresh, old, new):
    changed, count = re.subn(old, new, fresh, count=1, flags=re.M)
    assert count == 1 and differences(changed, fresh)
    assert not differences(fresh, fresh)
