# SPDX-License-Identifier: MIT
"""Cases are plain data: what is written is read back, and what is printed makes them again."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from usersub.check.case import Case, Step, one

_NUMBER = st.floats(-1e300, 1e300)


@st.composite
def _cases(draw: st.DrawFn) -> Case:
    points, directions = draw(st.integers(1, 3)), draw(st.integers(1, 2))

    def numbers(count: int) -> st.SearchStrategy[tuple[float, ...]]:
        return st.tuples(*[_NUMBER] * count)

    def vectors(count: int) -> st.SearchStrategy[tuple]:
        return st.tuples(*[numbers(count)] * points)

    step = st.builds(
        Step,
        motion=vectors(directions),
        load=numbers(points),
        dt=_NUMBER,
        stick=st.none() | numbers(points),
        temperature=st.none() | vectors(2),
        fields=st.none() | st.tuples(*[st.tuples(numbers(2), numbers(2))] * points),
        multiplier=st.none() | vectors(directions),
        area=st.none() | numbers(points),
        iterations=st.integers(1, 4),
        cut_back=st.booleans(),
    )
    return draw(
        st.builds(
            Case,
            steps=st.lists(step, min_size=1, max_size=3).map(tuple),
            contact=st.sampled_from(["node-to-facet", "edge-to-edge"]),
            order=st.none() | st.permutations(range(points)).map(tuple),
            angle=_NUMBER,
            props=st.none() | numbers(2),
            state=st.none() | numbers(1),
        )
    )


@given(_cases())
def test_json_keeps_every_number(case: Case) -> None:
    assert Case.from_json(case.as_json()) == case


@given(_cases())
def test_the_printed_form_makes_the_case_again(case: Case) -> None:
    assert eval(repr(case), {"Case": Case, "Step": Step}) == case


def test_json_with_an_unknown_key_is_refused() -> None:
    text = one((1.0,)).as_json().replace("angle", "corner")
    with pytest.raises(ValueError, match="Case has no 'corner'; it has angle, contact"):
        Case.from_json(text)


def test_points_can_be_chosen() -> None:
    step = Step(((1.0,), (2.0,), (3.0,)), (4.0, 5.0, 6.0), stick=(7.0, 8.0, 9.0))
    chosen = Case((step,), order=(2, 1, 0)).only([2, 0])
    assert chosen.order is None
    assert chosen.steps[0].motion == ((3.0,), (1.0,))
    assert chosen.steps[0].load == (6.0, 4.0)
    assert chosen.steps[0].stick == (9.0, 7.0)
    assert (chosen.points, chosen.directions) == (2, 1)
