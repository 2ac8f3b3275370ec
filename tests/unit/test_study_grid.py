# SPDX-License-Identifier: MIT
"""What a study runs: points, their names, and refusals."""

from __future__ import annotations

import dataclasses

import pytest

from usersub import abi, problems
from usersub.errors import LoadError, SceneError
from usersub.problems.problem import KEYS
from usersub.study import Point, Result, grid, ladders, motions, points

_LAW = "import usersub\n\n@usersub.coefficient\ndef mu(slip_rate, props):\n    return props[0]\n"


def test_points_are_different_and_runnable():
    found = points()
    assert len(set(found)) == len({p.key for p in found}) == len(found)
    for point in found:
        problem = problems.PROBLEMS[point.problem]
        assert point.method in problem.methods[point.interface]
        assert point.precision in abi.interface(point.interface).precisions
        assert point.law in problem.laws_of(point.interface)
        assert {name for name, _ in point.options} <= set(problem.options)
    assert {p.problem for p in found} == set(problems.PROBLEMS)
    assert {p.language for p in found} == set(grid.LANGUAGES)


@pytest.mark.parametrize("name", problems.PROBLEMS)
def test_problems_with_steps_run_at_several(name):
    problem = problems.PROBLEMS[name]
    found = points([name])
    assert len({p.step for p in found}) > 2 or "steps" not in problem.options
    for point in found:
        ladder = ladders.ladder(problem, point.law, point.method)
        assert (point.step is None) == (ladder is None)
        assert ladder is None or ladder.option in problem.options
        assert bool(point.refined) == (ladder is not None)


def test_other_axes_are_not_multiplied_unless_named():
    found = points(["P2"], interfaces=["vfric"])
    assert {p.language for p in found if p.method == "rigid rk4"} == {"c"}
    assert {p.language for p in found if p.method == "rigid"} == set(grid.LANGUAGES)
    both = points(["P2"], interfaces=["vfric"], languages=["c", "fortran"], methods=["rigid rk4"])
    assert {(p.language, p.precision) for p in both} >= {("c", "double"), ("fortran", "double")}
    single = points(["P2"], interfaces=["vfric"], precisions=["single"])
    assert {p.precision for p in single} == {"single"}
    assert points(["p2"], interfaces=["fric"], precisions=["double"])


def test_steps_and_blocks_replace_the_ladder():
    found = points(["P3"], languages=["c"], steps=[3, 5], blocks=[7])
    assert [(p.step, p.block) for p in found] == [(3, 7), (5, 7)]
    assert len(points(["P3"], quick=True)) < len(points(["P3"]))


def test_enforcement_and_updates_are_varied():
    slips = {p.options for p in points(["P10"], interfaces=["fric"], languages=["c"])}
    assert () in slips and len(slips) == 3
    updates = {
        dict(p.options).get("update")
        for p in points(["P13"], laws=["dahl"], interfaces=["fric"], methods=["start"])
    }
    assert updates == {None, "explicit Euler", "trapezoidal rule", "implicit Euler"}
    assert {dict(p.options).get("stiffness") for p in points(["P5"], methods=["penalty"])} > {0.25}


def test_key_is_of_the_content():
    point = points(["P3"])[0]
    assert Point.of(point.as_dict()) == point
    assert point.key == Point.of(point.as_dict()).key
    changed = [
        dataclasses.replace(point, **{name: value})
        for name, value in (("step", 17), ("block", 3), ("law", "dahl"), ("options", (("a", 1),)),
                            ("settings", (("b", 1),)), ("content", "0"))
    ]  # fmt: skip
    assert len({p.key for p in (point, *changed)}) == 7
    here = dataclasses.replace(point, routine="here/a.c", content="0")
    there = dataclasses.replace(point, routine="there/a.c", content="0")
    assert here.key == there.key


def test_results_have_the_keys_of_the_problems_first():
    assert tuple(f.name for f in dataclasses.fields(Result))[: len(KEYS)] == KEYS


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"problems": ["P99"]}, "no problem 'P99'; did you mean 'P9'"),
        ({"problems": ["P3"], "laws": ["coulom"]}, "did you mean 'coulomb'"),
        ({"problems": ["P3"], "interfaces": ["vfrict"]}, "no interface 'vfrict'"),
        ({"problems": ["P3"], "languages": ["C++"]}, "no language 'C++'"),
        ({"problems": ["P3"], "precisions": ["half"]}, "no precision 'half'"),
        ({"problems": ["P5"], "methods": ["penaltie"]}, "did you mean 'penalty'"),
        ({"problems": ["P3"], "interfaces": ["vfric"]}, "nothing to study: no case is all of"),
        ({"problems": ["P3"], "steps": [0]}, "step is 0, expected a whole number from 1"),
        ({"problems": ["P3"], "blocks": [1.5]}, "block is 1.5"),
    ],
)
def test_what_cannot_be_is_refused(asked, words):
    with pytest.raises(SceneError, match=words.replace("(", r"\(").replace("+", r"\+")):
        points(**asked)


def test_a_routine_goes_motions_and_the_problems_of_its_law(tmp_path):
    file = tmp_path / "mine.py"
    file.write_text(_LAW)
    alone = points(routine=file, interfaces=["vfric"], settings={"vfric": {"props": "0.3"}})
    assert {p.problem for p in alone} == set(motions.MOTIONS)
    assert {p.settings for p in alone} == {(("props", "0.3"),)}
    claimed = points(laws=["coulomb"], routine=file, interfaces=["vfric"])
    assert {p.problem for p in claimed} > {"P1", *motions.MOTIONS}
    assert {p.language for p in claimed} == {"python"}
    with pytest.raises(SceneError, match="say with --law"):
        points(["P1"], routine=file)
    before = {p.key for p in alone}
    file.write_text(_LAW + "\n")
    again = points(routine=file, interfaces=["vfric"], settings={"vfric": {"props": "0.3"}})
    assert not before & {p.key for p in again}
    with pytest.raises(LoadError, match="there is no file"):
        points(routine=tmp_path / "none.py")


def test_a_law_of_no_problem_goes_the_motions():
    assert {p.problem for p in points(laws=["stribeck"])} == set(motions.MOTIONS)
