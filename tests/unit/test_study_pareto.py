# SPDX-License-Identifier: MIT
"""The Pareto front and what is recommended."""

from __future__ import annotations

import math
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.unit.study_results import ladder, refused, result
from usersub.study import pareto, words

#: Few different values, so that ties are frequent.
_FEW = st.lists(st.tuples(st.sampled_from([1.0, 2.0, 3.0, 4.0]), st.sampled_from([0.0, 0.1, 0.5])))


@given(_FEW)
def test_front_is_what_no_other_beats(pairs: list[tuple[float, float]]) -> None:
    runs = [result(run_time_s=time, error=error) for time, error in pairs]
    # The definition, tried for every pair of runs.
    expected = {
        a.key for a in runs
        if not any(
            b.run_time_s <= a.run_time_s and b.error <= a.error
            and (b.run_time_s, b.error) != (a.run_time_s, a.error)
            for b in runs
        )
    }  # fmt: skip
    assert {run.key for run in pareto.best(runs)} == expected


def test_equal_runs_are_both_on_the_front() -> None:
    first, second = result(run_time_s=1.0, error=0.5), result(run_time_s=1.0, error=0.5)
    slower = result(run_time_s=2.0, error=0.5)
    (front,) = pareto.fronts([slower, second, first])
    assert {run.key for run in front.front} == {first.key, second.key}


@pytest.mark.parametrize("error", [math.nan, math.inf])
def test_points_without_an_error_are_never_on_a_front(error: float) -> None:
    good = result(run_time_s=1.0)
    odd, none = result(error=error, run_time_s=0.1), refused("no compiler", run_time_s=0.1)
    untimed = result(run_time_s=math.nan)
    (front,) = pareto.fronts([odd, none, good, untimed])
    assert front.front == front.runs == (good,)
    assert front.refused == (odd, none, untimed)


def test_an_error_of_zero_is_an_error() -> None:
    exact = result(error=0.0)
    assert pareto.fronts([exact])[0].front == (exact,)


def test_errors_of_different_quantities_are_not_compared() -> None:
    time, loop = result(error_of="time"), result(error_of="loop", error=1e-9)
    other = result(reference="the same at a finer step", error_of="time")
    assert [front.front for front in pareto.fronts([time, loop, other])] == [
        (time,), (loop,), (other,),
    ]  # fmt: skip


def test_blocks_are_compared_with_each_other_alone() -> None:
    plain, small, large = result(), result(block=1, run_time_s=1e-3), result(block=256)
    (front,) = pareto.fronts([plain, small, large])
    assert front.runs == (plain,) and front.blocks == (small, large)
    (alone,) = pareto.fronts([small, large])
    assert set(alone.runs) == {small, large}


def test_recommendation_names_method_step_error_and_time() -> None:
    runs = [*ladder(2), *ladder(4, 1e-5, interface="vfric", language="python", method="rk4")]
    (front,) = pareto.fronts(runs)
    told = pareto.recommendation(front, (1e-3, 1e-6))
    # The fastest of either are as fast; the finer one is better.
    assert told == [
        "For an error of 1e-3 use VFRIC in Python, rk4, step 1e-4 s: 1e-5 in 1 ms. "
        "As fast: FRIC in C, implicit.",
        "For an error of 1e-6 use VFRIC in Python, rk4, step 5e-5 s: 6.3e-7 in 2 ms.",
    ]


def test_recommendation_says_when_nothing_reaches_a_target() -> None:
    (front,) = pareto.fronts(ladder(1))
    told = pareto.recommendation(front, (1e-6, 1e-3, 1e-9))
    assert told[-1] == (
        "Nothing reached 1e-6 or 1e-9; the least error is 6.3e-5 in 16 ms by FRIC in C, implicit, "
        "step 6.3e-6 s."
    )


def test_one_answer_for_several_targets() -> None:
    (front,) = pareto.fronts([result(error=1e-15)])
    assert pareto.recommendation(front)[0].startswith("For errors of 1e-3, 1e-6 and 1e-9 use FRIC")


def test_recommendation_when_all_was_refused() -> None:
    ((title, told),) = pareto.recommendations([refused("no law"), refused("no law")])
    assert title == "P2, exponential decay"
    assert told == ["Nothing ran: all 2 runs were refused."]


def test_refused_runs_are_counted() -> None:
    ((_, told),) = pareto.recommendations([result(), refused("no law")])
    assert told[-1] == "1 of 2 runs was refused."


def test_noise_of_the_clock_changes_no_conclusion() -> None:
    runs = [
        *ladder(2), *ladder(2, language="fortran"), *ladder(4, 1e-5, method="rk4"),
        *ladder(4, 1e-5, method="rk4", interface="fric_coef"),
    ]  # fmt: skip
    chance = random.Random(5)
    answers = set()
    for _ in range(20):
        noisy = [
            result(**{**vars(run), "run_time_s": run.run_time_s * chance.uniform(0.92, 1.08)})
            for run in runs
        ]
        chance.shuffle(noisy)
        (front,) = pareto.fronts(noisy)
        answers.add(tuple(words.named(front.reaching(t)[0]) for t in pareto.TARGETS))
    assert len(answers) == 1


def test_different_numbers_of_points_are_told() -> None:
    (front,) = pareto.fronts([result(points=64), result(points=1024, interface="vfric")])
    assert any("from 64 to 1024 contact points" in told for told in pareto.recommendation(front))
    refining = [result(points=n, increments=n, refined="contact points") for n in (16, 1024)]
    (front,) = pareto.fronts(refining)
    assert not any("same work" in told for told in pareto.recommendation(front))


@pytest.mark.parametrize(
    ("value", "text"),
    [(2.14e-7, "2.1e-7"), (0.13, "0.13"), (1e-3, "1e-3"), (0.0, "0"), (math.nan, "-"),
     (1200.0, "1200"), (math.inf, "inf"), (9.99e-7, "1e-6"), (-3e8, "-3e8")],
)  # fmt: skip
def test_numbers_in_words(value: float, text: str) -> None:
    assert words.number(value) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.13, "130 ms"), (1.0, "1 s"), (0.99999, "1 s"), (3.14e-5, "31 µs"), (5e-9, "5 ns"),
     (240.0, "240 s"), (math.nan, "-")],
)  # fmt: skip
def test_times_in_words(value: float, text: str) -> None:
    assert words.seconds(value) == text


def test_a_run_in_words() -> None:
    run = result(
        interface="vfric_coef", language="fortran", precision="single", method="penalty", block=8,
        options=(("damped", True), ("stiffness", 0.0625)), routine="/a/my.f90",
    )  # fmt: skip
    assert words.named(run) == (
        "VFRIC_COEF in Fortran (my.f90), penalty, damped, stiffness 0.0625, single precision, "
        "step 1.3e-5 s, block 8"
    )
    points = result(increments=128, refined="contact points")
    assert words.named(points) == "FRIC in C, implicit, 128 contact points"
