# SPDX-License-Identifier: MIT
"""The folder of a study: what is kept, what is refused."""

from __future__ import annotations

import dataclasses
import json
import math

import pytest

from usersub.errors import SceneError
from usersub.study import Result, points
from usersub.study.running import Run
from usersub.study.store import Store, errors_text


@pytest.fixture
def some():
    return points(["P3"], languages=["c"])[:4]


def made(point, error=0.1, time=2.0, **more):
    values = {"error": error, "error_of": "slip", "step": 0.5, "points": 8, "tolerance": 1.0}
    times = {"run_time_s": time, "ns_per_point": 10.0 * time}
    return Run(point.key, machine="mine", **{**values, **times, **more})


def fill(store, repeats, some):
    for count in range(repeats):
        for point in some:
            store.add(point, made(point, time=1.0 + count))


def test_runs_are_kept_and_read_again(tmp_path, some):
    with Store(tmp_path / "new" / "folder", some, 3) as store:
        fill(store, 2, some)
        assert store.results() == []
        store.add(some[0], made(some[0], time=9.0))
        (result,) = store.results()
    assert (result.run_time_s, result.run_time_low, result.run_time_high) == (2.0, 1.5, 5.5)
    assert (result.ns_per_point, result.repeats, result.error) == (20.0, 3, 0.1)
    assert Result.of(json.loads(json.dumps(result.as_dict()))).as_dict() == result.as_dict()
    with Store(tmp_path / "new" / "folder", some, 3) as store:
        assert store.done == {some[0].key: 3, **{p.key: 2 for p in some[1:]}}
        assert store.results() == [result]
        assert store.machines == ["mine"]


@pytest.mark.parametrize("error", [1e-17, 0.1 + 0.2, math.nan, math.inf, 5e-324])
def test_errors_keep_all_their_bits(tmp_path, some, error):
    point = some[0]
    for _ in range(2):
        with Store(tmp_path, some, 1) as store:
            if point.key not in store.done:
                store.add(point, made(point, error=error))
            (found,) = store.results()
    assert found.error == error or math.isnan(found.error) and math.isnan(error)


def test_refused_points_are_done_and_those_that_may_pass_run_again(tmp_path, some):
    first, second, third, _ = some
    with Store(tmp_path, some, 3) as store:
        store.add(first, Run(first.key, refused="no such thing"))
        store.add(second, Run(second.key, refused="no compiler", passing=True))
        store.add(third, made(third))
        store.add(third, made(third, error=0.2))
        refused = [r.refused for r in store.results()]
    assert refused[:2] == ["no such thing", "no compiler"]
    assert refused[2] == "two runs differ: errors 0.1 and 0.2"
    with Store(tmp_path, some, 3) as store:
        assert store.done == {first.key: 3, third.key: 3}


def test_files_are_written_whole(tmp_path, some, monkeypatch):
    with Store(tmp_path, some, 1) as store:
        fill(store, 1, some)
        names = {path.name for path in store.write({"machine": "mine"})}
        assert names == {"errors.csv", "results.csv", "results.json"}
        before = (tmp_path / "results.csv").read_bytes()
        monkeypatch.setattr("usersub.study.store.os.replace", _no_space)
        with pytest.raises(OSError, match="no space"):
            store.write({"machine": "other"})
    assert (tmp_path / "results.csv").read_bytes() == before
    assert not [p for p in tmp_path.iterdir() if p.name.endswith(".tmp") or "csv." in p.name]
    whole = json.loads((tmp_path / "results.json").read_text())
    assert whole["stamp"] == {"machine": "mine"} and len(whole["results"]) == 4


def _no_space(*_):
    raise OSError("no space")


def test_another_study_is_refused(tmp_path, some):
    with Store(tmp_path, some, 1) as store:
        fill(store, 1, some)
    for others, repeats, words in (
        (some[:2], 1, "holds another study, of 4 points, and this one has 2 points"),
        ([*some[:3], dataclasses.replace(some[3], block=5)], 1, "4 points that differ"),
        (some, 2, "of 1 repeats of each point, and this one has 2"),
    ):
        with pytest.raises(SceneError, match=words):
            Store(tmp_path, others, repeats)
    with Store(tmp_path, some[:2], 1, fresh=True) as store:
        assert store.done == {}
    assert not list((tmp_path / "points").iterdir())


def test_a_changed_routine_is_the_same_study_with_new_points(tmp_path, some):
    mine = [dataclasses.replace(p, routine="a.py", content="old") for p in some]
    with Store(tmp_path, mine, 1) as store:
        fill(store, 1, mine)
    mended = [dataclasses.replace(p, content="new") for p in mine]
    with Store(tmp_path, mended, 1) as store:
        assert store.done == {}


def test_a_folder_in_use_and_a_folder_of_something_else_are_refused(tmp_path, some):
    with Store(tmp_path / "a", some, 1):
        with pytest.raises(SceneError, match="in use by another study"):
            Store(tmp_path / "a", some, 1)
    Store(tmp_path / "a", some, 1).close()
    (tmp_path / "b").mkdir()
    (tmp_path / "b" / "thesis.tex").write_text("")
    with pytest.raises(SceneError, match="not a folder of a study, and not empty"):
        Store(tmp_path / "b", some, 1)
    with pytest.raises(SceneError, match="is a file, expected a folder"):
        Store(tmp_path / "b" / "thesis.tex", some, 1)


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", '{"point": 3, "times": []}', "\xff"])
def test_unreadable_results_are_told(tmp_path, some, text):
    with Store(tmp_path, some, 1) as store:
        fill(store, 1, some)
    file = tmp_path / "points" / f"{some[0].key}.json"
    file.write_text(text, encoding="latin-1")
    with pytest.raises(SceneError, match="cannot be read.*its point runs again"):
        Store(tmp_path, some, 1)
    file.unlink()
    with Store(tmp_path, some, 1) as store:
        assert len(store.done) == 3
    (tmp_path / "study.json").write_text('{"format": 99}')
    with pytest.raises(SceneError, match="format 99, expected 1"):
        Store(tmp_path, some, 1)


def test_errors_do_not_depend_on_times(some):
    with Store(None, some, 1) as one, Store(None, some, 1) as two:
        fill(one, 1, some)
        for point in reversed(some):
            two.add(point, made(point, time=77.0))
        assert errors_text(one.results()) == errors_text(two.results())
