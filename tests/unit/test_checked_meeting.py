# SPDX-License-Identifier: MIT
"""Two threads meet behind a write of a routine to data that it keeps."""

from __future__ import annotations

import numpy as np
import pytest

import usersub
from tests.unit.checked_hosts import Host, source
from tests.unit.test_checked_where import _FORTRAN, line_of
from usersub.driver.meeting import meet
from usersub.errors import RoutineError, SceneError


def drivers(host: Host, routine, loads=(2.0, 3.0)):
    """Two fast drivers with loads of their own, and what each answers alone."""
    made = [host.driver(routine, checked=0) for _ in loads]
    alone = []
    for driver, load in zip(made, loads, strict=True):
        driver.bind(normal_force=np.full(host.points, load), area=np.ones(host.points))
        driver.step(0.5)
        alone.append(driver.array("coefficient").copy())
    return made, alone


def answers(made):
    return [driver.array("coefficient").copy() for driver in made]


def test_shared_variable(tmp_path):
    """The second call ends before the first has read back what it wrote."""
    path = tmp_path / "law.c"
    body = "static volatile double work; work = pressure[0]; // here\nfCoef[0] = work;"
    path.write_text(source("vfric_coef", body))
    made, alone = drivers(Host("vfric_coef"), usersub.load(path).only())
    assert alone[0][0] == 2.0
    met = meet(*made)
    assert (met.met, met.variable.split(".")[0], met.failures) == (True, "work", (None, None))
    assert met.where == line_of(path, "// here")
    assert [a[0] for a in answers(made)] == [3.0, 3.0]
    met = meet(*made, turn=2)
    assert (met.met, met.where, met.variable) == (False, "", "")
    assert [a[0] for a in answers(made)] == [2.0, 3.0]


def test_later_write(tmp_path):
    """Only behind the last of many writes is there something to spoil."""
    path = tmp_path / "law.c"
    path.write_text(source("vfric_coef", "static volatile double work[5];\n"
                           "for (int i = 0; i < 5; i++) work[i] = pressure[0];\n"
                           "fCoef[0] = work[4] + 0 * work[0];"))  # fmt: skip
    made, _ = drivers(Host("vfric_coef"), usersub.load(path).only())
    found = []
    for turn in range(1, 7):
        met = meet(*made, turn)
        found.append((met.met, answers(made)[0][0]))
    assert found == [(True, 2.0)] * 4 + [(True, 3.0), (False, 2.0)]


@pytest.mark.needs_fortran
def test_common(tmp_path):
    path = tmp_path / "law.for"
    statement = "w(1:nBlock) = pressure(1:nBlock)"
    text = _FORTRAN.format(statement=f"{statement}\n      fCoef(1:nBlock) = w(1:nBlock)")
    text = text.replace("      CHARACTER*80", "      COMMON /WORK/ w(4)\n      CHARACTER*80")
    path.write_text(text)
    made, _ = drivers(Host("vfric_coef"), usersub.load(path).only())
    met = meet(*made)
    assert (met.met, met.variable, met.where) == (True, "work_", line_of(path, statement))
    assert [a[0] for a in answers(made)] == [3.0, 3.0]


def test_variable_behind_a_lock(tmp_path):
    """A routine that locks is right; the second call waits for the first, and nobody for ever."""
    head = "void mutexlock_(int *); void mutexunlock_(int *); void mutexinit_(int *);"
    body = (
        "static volatile double work; static int id = 3;\n"
        "mutexlock_(&id); work = pressure[0]; fCoef[0] = work; mutexunlock_(&id);"
    )
    path = tmp_path / "law.c"
    path.write_text(source("vfric_coef", body, head=head))
    made, _ = drivers(Host("vfric_coef"), usersub.load(path).only())
    assert meet(*made).met
    assert [a[0] for a in answers(made)] == [2.0, 3.0]


def test_failures_are_told(tmp_path):
    body = "static volatile int n; if (n++ == -1) return;\nif (pressure[0] > 2.5) xit_();"
    path = tmp_path / "law.c"
    path.write_text(source("vfric_coef", body, head="void xit_(void);"))
    host = Host("vfric_coef")
    made, _ = drivers(host, usersub.load(path).only(), loads=(2.0, 2.0))
    made[1].bind(normal_force=np.full(host.points, 3.0))
    met = meet(*made)
    assert met.met
    assert met.failures[0] is None
    assert isinstance(met.failures[1], RoutineError)


def test_standard_drivers(tmp_path):
    path = tmp_path / "law.c"
    path.write_text(source("fric", "static volatile double w; w = PRESS[0]; TAU[0] = w;"))
    host = Host("fric", points=2)
    routine = usersub.load(path).only()
    made = [host.driver(routine, checked=0) for _ in range(2)]
    for driver, load in zip(made, (2.0, 3.0), strict=True):
        driver.bind(pressure=np.full(2, load))
        driver.begin_increment(0.5)
    assert meet(*made).met
    assert made[0].array("tau")[0].tolist() == [3.0, 2.0]
    assert made[1].array("tau")[0].tolist() == [3.0, 3.0]


def test_where_it_cannot_be(c_routine):
    host = Host("vfric_coef")
    made = c_routine("vfric_coef", source("vfric_coef"))
    checked = [host.driver(made) for _ in range(2)]
    with pytest.raises(SceneError, match="neither checked"):
        meet(*checked)
    python = usersub.laws.routine("coulomb", "vfric_coef", "python")
    with pytest.raises(SceneError, match="a library that keeps data"):
        meet(*[host.driver(python, checked=0) for _ in range(2)])
