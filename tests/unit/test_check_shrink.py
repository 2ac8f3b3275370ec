# SPDX-License-Identifier: MIT
"""Smaller cases: each change is simpler, the end is reached, and only true failures are kept."""

from __future__ import annotations

import math
import time

import pytest
from bad_routines import rule, session, write
from hypothesis import given
from hypothesis import strategies as st

from usersub.check import cases
from usersub.check.case import Case, Step
from usersub.check.rule import CannotCheck, Finding
from usersub.check.running.shrink import changes, healthy_subject, kind_of, shrunk, smaller
from usersub.errors import RoutineError

BIG = Case(
    steps=tuple(
        Step(
            motion=((0.0, 0.0), (0.0, 0.0)) if k == 0 else ((0.0137, -0.0071), (0.021, 3.3e-7)),
            load=(1.37, 271.8),
            dt=0.25,
            temperature=((21.0, 33.5), (17.0, 18.0)),
            area=(2.7, 3.1),
            iterations=3,
        )
        for k in range(4)
    ),
    order=(1, 0),
    angle=0.7,
    props=(0.3,),
)


def smallest(case, fails, **options):
    """The last case that `fails`, from where shrinking begins."""
    found = Finding("it fails", case)
    *_, last = (
        found,
        *shrunk(found, lambda c: Finding("it fails", c) if fails(c) else None, **options),
    )
    assert last.case is not None
    return last.case


def test_whatever_fails_becomes_the_smallest_case():
    case = smallest(BIG, lambda c: True)
    assert case == Case((Step(((0.0,),), (1.0,), dt=0.1), Step(((0.0,),), (1.0,), dt=0.1)))


def test_what_is_needed_stays():
    def fails(case):
        return any(s.load[-1] > 200 and s.motion[-1][-1] != 0.0 for s in case.steps[1:])

    case = smallest(BIG, fails)
    assert fails(case) and case.points == 1 and len(case.steps) == 2
    assert case.steps[1].load == (300.0,)  # one digit; the power of ten below is not enough
    assert case.props is None and case.order is None and case.angle == 0.0


def test_points_that_only_fail_together_stay_together():
    case = smallest(BIG, lambda c: c.points == 2 and c.order == (1, 0))
    assert case.points == 2 and case.order == (1, 0) and case.steps[-1].iterations == 1


def test_the_increment_of_touching_stays():
    assert all(c.steps[0].motion[0][0] == 0.0 for c in changes(BIG) if c.points == 2)
    assert all(len(c.steps) >= 2 for c in changes(BIG))


def test_the_time_is_kept():
    calls = []

    def slow(case):
        calls.append(case)
        time.sleep(0.05)

    assert list(shrunk(Finding("it fails", BIG), slow, seconds=0.2)) == []
    assert 1 <= len(calls) <= 5  # no call is begun after the time is over


_numbers = st.floats(-1e3, 1e3, allow_nan=False).map(lambda v: float(f"{v:.5g}"))


@given(st.lists(st.tuples(_numbers, _numbers, _numbers), min_size=1, max_size=4), st.data())
def test_shrinking_ends_in_a_case_that_fails(values, data):
    case = Case(tuple(Step(((x, y),), (p,)) for x, y, p in values))
    key = data.draw(st.sampled_from(["x", "y", "load"]))

    def fails(c):
        return any(
            (abs(s.load[0]) if key == "load" else abs(s.motion[0][0 if key == "x" else -1])) >= 0.5
            for s in c.steps
        )

    if fails(case):
        found = smallest(case, fails)
        assert fails(found)
        assert not any(fails(c) for c in changes(found) if len(c.steps) < len(found.steps))


def test_changes_do_not_go_in_circles():
    """Every change is simpler in an order without circles, so that shrinking ends."""

    def size(case):
        flat = [
            abs(v) for s in case.steps for v in (*(c for m in s.motion for c in m), *s.load, s.dt)
        ]
        return (
            case.points * len(case.steps) * case.directions,
            sum(len(f"{v:.17g}".strip("0.")) for v in flat),
            sum(flat),
        )

    assert all(size(c)[0] <= size(BIG)[0] for c in changes(BIG))
    case, steps = BIG, 0
    while candidates := [c for c in changes(case) if c != case]:
        case, steps = candidates[0], steps + 1
        assert steps < 200


def test_numbers_do_not_make_another_sentence():
    assert kind_of("tau(1) is 0.3, expected -1e-3") == kind_of("tau(2) is nan, expected inf")
    assert kind_of("tau(1) was read") != kind_of("tau(1) was written")


@pytest.mark.parametrize("value", [math.inf, math.nan, 0.0])
def test_numbers_that_are_not_rounded(value):
    case = Case((Step(((value,),), (1.0,), dt=0.1),))
    assert [c for c in changes(case) if c != case] == []


# In a child, with the routine.


@pytest.fixture(scope="module")
def checks(tmp_path_factory):
    return session(write(tmp_path_factory.mktemp("shrink"), "healthy"))


def _judge(subject, case):
    """Fails where the coefficient is that of the routine and there is any slip under load."""
    for number, answer in enumerate(subject.respond(case), 1):
        step = case.steps[number - 1]
        if step.load[0] > 0 and step.motion[0][0] > 0 and subject.props != (0.25,):
            return f"the coefficient in increment {number} is {answer.coefficient[0]}"
    return None


def _cases(subject):
    yield cases.slipping(subject, cases.MANY)


def _broken(judge):
    def of(subject):
        for case in _cases(subject):
            subject.under_way(case)
            detail = judge(subject, case)
            if detail:
                yield Finding(detail, case)

    return rule("a.judged", of, judge)


def test_a_case_that_a_healthy_routine_fails_too_proves_nothing(checks):
    """This judge finds fault with every routine, so nothing is made smaller."""
    found = checks.report([_broken(_judge)])["a.judged"]
    assert found.verdict == "fail" and found.case == cases.slipping(checks.subject, cases.MANY)


def test_a_case_is_made_smaller_and_keeps_its_failure(checks):
    def judge(subject, case):
        # The name tells the healthy routine from the one under check.
        return None if subject.law == "coulomb" else _judge(subject, case)

    found = checks.report([_broken(judge)])["a.judged"]
    assert found.case is not None and found.case.points == 1 and len(found.case.steps) == 2
    assert found.case.steps[1].motion == ((0.01,),)
    assert judge(checks.subject, found.case) == found.detail


@pytest.mark.parametrize("error", [CannotCheck("no"), RoutineError("no"), ValueError("no")])
def test_a_judge_that_refuses_a_smaller_case_keeps_the_larger(checks, error):
    whole = cases.slipping(checks.subject, cases.MANY)

    def judge(subject, case):
        if case != whole:
            raise error
        return None if subject.law == "coulomb" else "it fails"

    assert checks.report([_broken(judge)])["a.judged"].case == whole


def test_the_healthy_routine_has_the_scenes_of_the_subject(checks):
    healthy = healthy_subject(checks.subject.but(fields=2, temperatures=True))
    assert (healthy.fields, healthy.temperatures, healthy.props) == (2, True, (0.3,))
    answers = healthy.respond(cases.slipping(healthy))
    assert [a.coefficient[0] for a in answers] == pytest.approx([0.3] * len(answers))


def test_nothing_is_made_smaller_without_a_case(checks):
    assert list(smaller(_broken(_judge), checks.subject, Finding("no case"))) == []
