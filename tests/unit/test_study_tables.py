# SPDX-License-Identifier: MIT
"""Results as tables, and orders of convergence."""

from __future__ import annotations

import csv
import io
import json
import math

import pytest

from tests.unit.study_results import ladder, refused, result
from usersub.problems.problem import KEYS
from usersub.study import orders, pareto, tables


def _read(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_csv_has_the_keys_of_problems_first_and_every_bit() -> None:
    run = result(error=0.1 + 0.2, options=(("stiffness", 0.25), ("update", "exact")))
    text = tables.csv_text([run])
    assert text.splitlines()[0].startswith(",".join(KEYS))
    (row,) = _read(text)
    assert float(row["error"]) == 0.1 + 0.2
    assert row["options"] == "stiffness=0.25; update=exact"
    assert row["block"] == ""


def test_csv_keeps_what_a_reason_holds() -> None:
    (row,) = _read(tables.csv_text([refused('said "no", twice\nand left')]))
    assert row["refused"] == 'said "no", twice\nand left'
    assert row["error"] == ""


def test_json_is_strict_and_has_null_for_what_is_not_finite() -> None:
    runs = [result(options=(("update", "exact"),)), refused("no law"), result(error=math.inf)]
    read = json.loads(tables.json_text(runs, {"machine": "one"}), parse_constant=pytest.fail)
    assert read["stamp"] == {"machine": "one"}
    assert [row["error"] for row in read["results"]] == [2.1e-7, None, None]
    assert read["results"][0]["options"] == {"update": "exact"}
    assert list(read["results"][0]) == list(tables.COLUMNS)


def test_markdown_keeps_its_columns() -> None:
    text = tables.markdown(("why", ">count"), [["a | b\nc", 3]])
    assert text.splitlines() == ["| why | count |", "| --- | ---: |", "| a \\| b c | 3 |"]


def test_refused_points_that_differ_in_step_share_a_row() -> None:
    runs = [refused("no law"), refused("no law", increments=96), result(error=math.nan)]
    rows = tables.refused_rows(pareto.fronts([result(), *runs]))
    assert [row[-2:] for row in rows] == [
        ["no law", "2"], ["the error is not a finite number", "1"],
    ]  # fmt: skip


def test_order_is_that_of_the_errors() -> None:
    (curve,) = orders.curves(ladder(2))
    assert curve.order == pytest.approx(2.0, abs=1e-12)
    assert [run.increments for run in curve.runs] == [32, 64, 128, 256, 512]


def test_order_is_not_told_from_rounding() -> None:
    falling = [*ladder(8)[:3], *(result(step=1e-6 / k, error=1e-15) for k in (1, 2))]
    (curve,) = orders.curves(falling)
    assert curve.order == pytest.approx(8.0, abs=1e-12)
    (exact,) = orders.curves(ladder(0, 1e-15))
    assert exact.order is None and orders.order_words(exact) == "rounding"


def test_order_in_points_is_positive() -> None:
    runs = [
        result(step=0.1, increments=n, points=n, error=1.0 / n, refined="contact points")
        for n in (16, 32, 64)
    ]
    (curve,) = orders.curves(runs)
    assert curve.order == pytest.approx(1.0, abs=1e-12)
    assert curve.against == "1 / contact points [-]"


def test_curves_take_the_worst_of_the_languages() -> None:
    worse = ladder(2, 3e-3, language="fortran")
    (curve,) = orders.curves([*ladder(2), *worse])
    assert list(curve.runs) == worse
