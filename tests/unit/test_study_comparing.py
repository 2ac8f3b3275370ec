# SPDX-License-Identifier: MIT
"""Two studies of the same: noise of the clock is no difference, and what is one is told."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.unit.study_results import ladder, refused, result
from usersub.study import comparing, pareto
from usersub.study.comparing import ALIKE, DIFFERS, SAME
from usersub.study.result import Result


def _noisy(run: Result, factor: float) -> Result:
    """The run, slower by a factor."""
    times = ("run_time_s", "run_time_low", "run_time_high")
    return replace(run, **{name: factor * getattr(run, name) for name in times})


def _verdicts(here: list[Result], there: list[Result]) -> dict[str, str]:
    return {c.what: c.verdict for c in comparing.compare(here, there)}


def _study() -> list[Result]:
    """Methods of several orders, whose run times lie close together and far apart."""
    return [
        *ladder(2), *ladder(2, language="fortran"), *ladder(4, 1e-5, method="rk4"),
        *[_noisy(run, 1.3) for run in ladder(4, 1e-5, method="rk4", interface="fric_coef")],
        *[_noisy(run, 2.0) for run in ladder(1, method="euler")],
        result(method="slow", error=1e-12, run_time_s=1.0), refused("no law", interface="vfric"),
    ]  # fmt: skip


_COUNT = len(_study())
_TIMES = st.floats(1e-5, 1.0)
_ERRORS = st.sampled_from([1e-2, 5e-4, 5e-4, 3e-7, 3e-7, 1e-10])
#: Time, how far its quartiles are from it, error, and the noise as a share of that distance.
_RUNS = st.lists(
    st.tuples(_TIMES, st.floats(1.0, 1.8), _ERRORS, st.floats(-1.0, 1.0)), min_size=1, max_size=12
)


@settings(deadline=None)
@given(_RUNS)
def test_noise_within_the_measured_spread_never_makes_studies_differ(
    runs: list[tuple[float, float, float, float]],
) -> None:
    here, there = [], []
    for number, (time, apart, error, share) in enumerate(runs):
        run = result(
            method=f"m{number}", error=error, run_time_s=time, run_time_low=time / apart,
            run_time_high=time * apart,
        )  # fmt: skip
        here.append(run)
        there.append(_noisy(run, apart**share))
    assert DIFFERS not in _verdicts(here, there).values()
    assert DIFFERS not in _verdicts(there, here).values()


@settings(deadline=None)
@given(st.lists(st.floats(1 / 1.12, 1.12), min_size=_COUNT, max_size=_COUNT))
def test_noise_of_an_ordinary_machine_changes_no_recommendation(factors: list[float]) -> None:
    # Ladders of run times that double: nothing lies at the edge of what is told apart.
    here = [*ladder(2), *ladder(2, language="fortran"), *ladder(4, 1e-5, method="rk4")]
    there = [_noisy(run, factor) for run, factor in zip(here, factors, strict=False)]
    found = _verdicts(here, there)
    assert {found[f"for {target}"] for target in ("1e-3", "1e-6", "1e-9")} == {SAME}


@pytest.mark.parametrize("factor", [1.0, 3.0, 1e3])
def test_a_machine_that_is_slower_as_a_whole_changes_nothing(factor: float) -> None:
    here = _study()
    found = _verdicts(here, [_noisy(run, factor) for run in here])
    assert set(found.values()) == {SAME}


def test_a_recommended_method_that_becomes_really_slower_is_told() -> None:
    here = [
        result(method="a", error=1e-12, run_time_s=1.0),
        result(method="b", error=1e-10, run_time_s=1.0),
    ]
    slower = [_noisy(here[0], 4.0), here[1]]
    found = {c.what: c for c in comparing.compare(here, slower)}
    assert found["for 1e-6"].verdict == DIFFERS
    assert "FRIC in C, a" in found["for 1e-6"].here and "b" in found["for 1e-6"].there
    # The slower one still has the least error, so nothing beats it.
    assert found["beaten by none"].verdict == ALIKE
    assert _verdicts(here, [_noisy(here[0], 1.5), here[1]])["for 1e-6"] != DIFFERS


def test_a_run_on_the_front_that_is_really_beaten_is_told() -> None:
    here = [
        result(method="a", error=1e-2, run_time_s=1.0),
        result(method="b", error=1e-10, run_time_s=2.0),
    ]
    found = {c.what: c for c in comparing.compare(here, [_noisy(here[0], 9.0), here[1]])}
    told = found["beaten by none"]
    assert told.verdict == DIFFERS
    assert told.here.startswith("2 runs, alone here FRIC in C, a") and told.there == "1 run"


def test_errors_orders_and_refusals_have_no_noise() -> None:
    here = [*ladder(2), result(method="rk4", error=1e-9)]
    coarser = [*ladder(1), result(method="rk4", error=1e-7)]
    found = _verdicts(here, coarser)
    assert found["order of FRIC, implicit, over the time increment"] == DIFFERS
    assert found["for 1e-9"] == DIFFERS  # only one reaches it
    gone = [*here[:-1], refused("no root", method="rk4")]
    assert _verdicts(here, gone)["refused"] == DIFFERS
    assert _verdicts(gone, gone)["refused"] == SAME


def test_the_least_error_of_which_none_is_enough() -> None:
    here, there = [result(error=0.2)], [result(error=0.3)]
    assert _verdicts(here, here)["for 1e-9"] == SAME
    assert _verdicts(here, there)["for 1e-9"] == DIFFERS


def test_only_common_points_are_compared() -> None:
    here, extra = ladder(2), result(method="exact", error=0.0, run_time_s=1e-6)
    assert set(_verdicts([*here, extra], here).values()) == {SAME}
    assert comparing.unmatched([*here, extra], here) == (1, 0)
    assert comparing.compare(here, [extra]) == []


def test_a_routine_is_the_same_wherever_its_file_stands() -> None:
    here, there = result(routine="/here/my.f90"), result(routine="there/my.f90", key="changed")
    assert set(_verdicts([here], [there]).values()) == {SAME}


def test_cells_limits_and_savings() -> None:
    called = {"interface": "fric", "language": "c", "precision": "double", "subject": "coulomb"}
    here = {
        "cells": [{**called, "case": "slip", "value": "1e300", "verdict": "stable"}],
        "limits": [{**called, "name": "step", "measured": 2.0},
                   {**called, "name": "none", "measured": None}],
        "savings": [{**called, "scene": "least", "bytes_needed": 40, "bytes_full": 116,
                     "same_bits": True, "ns_needed": 8.0}],
    }  # fmt: skip
    assert {c.verdict for c in comparing.compare_extremes(here, here)} == {SAME}
    changes = {
        "cells": ("verdict", "fails"),
        "limits": ("measured", 1.5),
        "savings": ("bytes_needed", 48),
    }
    for part, (name, value) in changes.items():
        there = {**here, part: [{**here[part][0], name: value}, *here[part][1:]]}
        found = comparing.compare_extremes(here, there)
        assert [c.verdict for c in found].count(DIFFERS) == 1
    slower = {**here, "savings": [{**here["savings"][0], "ns_needed": 80.0}]}
    assert {c.verdict for c in comparing.compare_extremes(here, slower)} == {SAME}


def test_slower_needs_more_than_the_spread() -> None:
    one = result(run_time_s=1.0, run_time_low=0.9, run_time_high=1.1)
    assert not pareto.slower(_noisy(one, 1.5), one) and pareto.slower(_noisy(one, 1.6), one)
    bare = replace(one, run_time_low=math.nan, run_time_high=math.nan)
    assert not pareto.slower(_noisy(bare, 1.24), bare) and pareto.slower(_noisy(bare, 1.26), bare)
