# SPDX-License-Identifier: MIT
"""Studies that run: the same bits from any pool, and nothing twice after a kill."""

from __future__ import annotations

import math
import signal
import subprocess
import sys
import time

import pytest

from usersub.errors import MissingTool, SceneError
from usersub.study import motions, points, running, study
from usersub.study.store import errors_text

_C_LAW = """#include <usersub/abi.h>
void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {
  for (int i = 0; i < *nBlock; ++i)
    fCoef[i] = 0.2 + 0.1 / (1.0 + slipRate[i]);
}
"""


@pytest.fixture(scope="module")
def some():
    """Cheap points of several kinds, in C."""
    chosen = {"languages": ["c"], "precisions": ["double"]}
    return [
        *points(["P3"], **chosen)[:3],
        *points(["P10"], **chosen, interfaces=["fric_coef"], steps=[16]),
        *points(
            ["P13"], laws=["dahl"], interfaces=["fric"], methods=["start"], steps=[8], **chosen
        ),
        *points(["reversal"], laws=["stribeck"], interfaces=["vfric"], steps=[24], **chosen),
    ]


@pytest.fixture(scope="module")
def serial(some):
    return study(some, repeats=1)


def test_errors_and_times_are_measured(some, serial):
    assert [r.key for r in serial.results] == [p.key for p in some]
    for result in serial.results:
        assert not result.refused and result.error < 1.0
        assert 0.0 < result.run_time_low <= result.run_time_s <= result.run_time_high
        assert result.ns_per_point > 0.0 and result.repeats == 1
    assert {r.reference for r in serial.results} == {"exact", motions.REFERENCE}
    assert serial.ran == len(some) and not serial.unfinished


def test_processes_give_the_same_bits(some, serial):
    assert errors_text(study(some, repeats=1, jobs=2).results) == errors_text(serial.results)


def test_a_cluster_gives_the_same_bits(some, serial):
    distributed = pytest.importorskip("distributed", reason="install it with usersub[cluster]")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
    ) as cluster:
        found = study(some, repeats=1, scheduler=cluster.scheduler_address)
    assert errors_text(found.results) == errors_text(serial.results)
    assert found.stamp["machine"] == serial.stamp["machine"]


def test_a_cluster_that_is_not_there_is_told(some, monkeypatch):
    pytest.importorskip("distributed", reason="install it with usersub[cluster]")
    with pytest.raises(SceneError, match="no Dask scheduler answers at 'nonsense://here'"):
        study(some, scheduler="nonsense://here")
    monkeypatch.setitem(sys.modules, "dask.distributed", None)
    with pytest.raises(MissingTool, match=r"usersub\[cluster\]"):
        study(some, scheduler="tcp://127.0.0.1:1")


def test_what_a_host_cannot_do_is_refused_not_raised(some, monkeypatch):
    for error, words in (
        (SceneError("no such step"), "no such step"),
        (ArithmeticError("neither slides nor sticks"), "ArithmeticError: neither slides"),
    ):
        monkeypatch.setattr(running, "_once", _raising(error))
        run = running.run_point(some[0])
        assert run.refused.startswith(words) and math.isnan(run.error) and not run.passing
    monkeypatch.setattr(running, "_once", _raising(MissingTool("install a compiler")))
    assert running.run_point(some[0]).passing


def _raising(error):
    def once(point):
        raise error

    return once


def test_a_routine_is_measured_against_itself(tmp_path):
    file = tmp_path / "mine.c"
    file.write_text(_C_LAW)
    settings = {"vfric_coef": {"slip": 1.0, "load": 2.0, "dt": 0.5}}
    asked = points(["slide-hold-slide"], routine=file, methods=["prescribed"], settings=settings,
                   precisions=["double"], steps=[24, 96, 384])  # fmt: skip
    found = study(asked, repeats=1).results
    errors = [r.error for r in found]
    # The slip rate is the mean of an increment: an error of first order at its end.
    assert errors[0] > 2.5 * errors[1] > 6.0 * errors[2] > 0.0
    assert {r.routine for r in found} == {str(file)} and {r.language for r in found} == {"c"}
    odd = points(["reversal"], routine=file, steps=[25], settings=settings)
    assert "expected a multiple of 24" in study(odd[:1], repeats=1).results[0].refused
    file.write_text(_C_LAW.replace("0.2", "0.3"))
    running._of_file.cache_clear()
    assert "has changed since the study began" in running.run_point(asked[-1]).refused


def test_ctrl_c_keeps_what_is_finished(tmp_path, some):
    def stop(done, whole, point):
        if done == 3:
            raise KeyboardInterrupt

    found = study(some, tmp_path, repeats=1, progress=stop)
    assert len(found.results) == 3 and found.unfinished == len(some) - 3
    again = study(some, tmp_path, repeats=1)
    assert (again.kept, again.ran, again.unfinished) == (3, len(some) - 3, 0)


_CHILD = """
import sys
from tests_of_the_kill import cases
from usersub.study import study
study(cases(), sys.argv[1], repeats=1, progress=lambda done, whole, point: print(done, flush=True))
"""

_CASES = """
from usersub.study import points

def cases():
    chosen = {"languages": ["c"], "precisions": ["double"], "blocks": [4]}
    return points(["P3", "P13", "P15", "P18"], steps=list(range(2, 14)), **chosen)[:200]
"""


def test_killed_half_way_it_repeats_nothing_and_ends_with_the_same_files(tmp_path, monkeypatch):
    (tmp_path / "tests_of_the_kill.py").write_text(_CASES)
    (tmp_path / "child.py").write_text(_CHILD)
    monkeypatch.syspath_prepend(str(tmp_path))
    from tests_of_the_kill import cases

    grid, folder = cases(), tmp_path / "study"
    assert len(grid) == 200
    with subprocess.Popen(
        [sys.executable, str(tmp_path / "child.py"), str(folder)], stdout=subprocess.PIPE, text=True
    ) as child:
        for line in child.stdout:
            if int(line) >= 100:
                child.send_signal(signal.SIGKILL)
                break
    assert child.returncode == -signal.SIGKILL
    finished = {p.name: p.read_bytes() for p in (folder / "points").glob("*.json")}
    assert 100 <= len(finished) < 200
    assert not (folder / "errors.csv").exists()

    ran = []
    resumed = study(grid, folder, repeats=1, progress=lambda *args: ran.append(args[2].key))
    assert resumed.kept == len(finished) and len(ran) == resumed.ran == 200 - len(finished)
    assert not set(ran) & {name.removesuffix(".json") for name in finished}
    for name, content in finished.items():  # measured times are those of the first session
        assert (folder / "points" / name).read_bytes() == content
    whole = study(grid, tmp_path / "whole", repeats=1)
    assert (folder / "errors.csv").read_bytes() == (tmp_path / "whole/errors.csv").read_bytes()
    assert sorted(p.name for p in folder.rglob("*")) == sorted(
        p.name for p in (tmp_path / "whole").rglob("*")
    )
    assert not any(r.refused for r in whole.results)

    before = {p: p.read_bytes() for p in folder.rglob("*.*") if p.is_file()}
    begin = time.monotonic()
    assert study(grid, folder, repeats=1).ran == 0
    assert time.monotonic() - begin < 60.0
    assert {p: p.read_bytes() for p in before} == before
