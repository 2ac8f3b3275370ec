# SPDX-License-Identifier: MIT
"""Newton's method converges quadratically with the tangents of the drivers, and not without."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from usersub.problems import __main__ as command
from usersub.problems import newton, newton_page
from usersub.problems.newton_host import ACCURACY, MOST_ITERATIONS, stiffness

PAGE = Path(__file__).resolve().parents[2] / "docs/explanation/newton.md"


@pytest.fixture(scope="module")
def runs() -> list[newton.Run]:
    return list(newton.runs())


def test_every_combination_is_there(runs):
    found = {(r.points, r.directions, r.method, r.law, r.anisotropic) for r in runs}
    assert len(found) == len(runs) == 3 * (1 + 9 + 9) - 9
    assert {r.method for r in runs} == {"FRIC", *newton.METHODS}


def test_quadratic(runs):
    """The order is that of one correction from near the solution: two to the digits shown, unless
    nothing near it is curved, and then the correction is exact."""
    for run in runs:
        assert run.residuals[-1] <= ACCURACY and len(run.residuals) <= 9, run
        if run.order is None:
            assert run.law == "constant" and run.directions == 1, run
        else:
            assert run.order == pytest.approx(2.0, abs=0.03), run


def test_linear_with_the_symmetric_part(runs):
    for run in runs:
        assert run.symmetric_order == pytest.approx(1.0, abs=0.2), run
        assert run.symmetric is None or run.symmetric >= 1.5 * len(run.residuals), run
        assert run.sentence.startswith("unsymmetric at "), run
    assert sum(run.symmetric is None for run in runs) > len(runs) / 3


def test_some_stick_and_some_slip(runs):
    counts = {run.slipping for run in runs if run.points == 12}
    assert any(0 < count < 12 for count in counts) and 12 in counts


def test_springs_are_stable():
    """The host without contact is symmetric and positive: what is unsymmetric is friction."""
    for points, directions in ((1, 1), (1, 2), (12, 2)):
        for matrix in stiffness(points, directions):
            np.testing.assert_array_equal(matrix, matrix.T)
            assert np.linalg.eigvalsh(matrix).min() > 0.1


def test_page_is_up_to_date(runs):
    """Rows and iterations; the last digits of residuals belong to the machine."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    cells = [[c.strip() for c in line.strip("|").split("|")] for line in lines if line[:1] == "|"]
    shown = [row for row in cells if row[0] in newton.METHODS or row[0] == "FRIC"]
    assert len(shown) == len(runs)
    for row, run in zip(shown, runs, strict=True):
        fresh = [str(cell) for cell in newton_page.row(run)]
        assert row[:3] == fresh[:3] and row[4:6] == fresh[4:6]
        assert [len(cell.split()) for cell in row] == [len(cell.split()) for cell in fresh]
        for old, new in zip(row[3].split(), run.residuals, strict=True):
            assert float(old) == pytest.approx(new, rel=0.1, abs=1e-12)


def test_command(tmp_path, monkeypatch, runs):
    monkeypatch.setattr(newton, "runs", lambda: iter(runs))
    target = tmp_path / "newton.md"
    assert command.main(["--newton", str(target)]) == 0
    text = target.read_text(encoding="utf-8")
    assert text.count("| FRIC |") == 3 and "@" not in text
    assert f"not in {MOST_ITERATIONS}" in text
