# SPDX-License-Identifier: MIT
"""What routines say: receivers, and Fortran units 6 and 7."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

import usersub

_WRITER = """\
subroutine vfric_coef(fc,fd,nb,np,nt,nf,jf,rd,a,b,c,props,rate,p,t,f)
  include 'vaba_param.inc'
  character*80 a, b, c
  dimension fc(nb), props(np), p(nb)
  if (props(1) < 0) close (7)
  do k = 1, nb
    fc(k) = abs(props(1))
    write (7, '(a,f6.2)') 'pressure', p(k)
    if (p(k) < 5) write (6, '(a)', advance='no') 'half '
  end do
  if (p(1) > 5) write (6, '(a)') 'line'
  if (props(1) > 10) then
    do k = 1, 50000
      write (7, '(a)') repeat('x', 99)
    end do
  end if
end subroutine
"""


@pytest.fixture(autouse=True)
def back_to_stderr(tmp_path):
    yield
    usersub.messages_to()
    if shutil.which("gfortran"):
        _call(_driver(tmp_path), 6.0)  # ends a line that a test left half


def _driver(tmp_path: Path, mu: float = 0.5):
    source = tmp_path / "writer.f90"
    source.write_text(_WRITER)
    scene = usersub.Scene(points=1, props=[mu], nodes=1)
    return usersub.CoefficientDriver(usersub.load(source).only(), scene)


def _call(driver, pressure: float):
    driver.evaluate(slip_rate=np.zeros(1), pressure=np.array([pressure]))


@pytest.mark.needs_fortran
def test_lines_arrive_after_each_call_and_halves_wait(tmp_path, monkeypatch):
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    said = []
    usersub.messages_to(lambda level, text: said.append((level, text)))
    driver = _driver(tmp_path)
    _call(driver, 1.25)
    assert said == [(0, "pressure  1.25")]
    _call(driver, 7.5)
    assert said[1:] == [(0, "half line"), (0, "pressure  7.50")]
    assert list((tmp_path / "here").iterdir()) == []


@pytest.mark.needs_fortran
def test_file_that_the_routine_opens_itself_is_left_to_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    said = []
    usersub.messages_to(lambda level, text: said.append(text))
    driver = _driver(tmp_path)
    text = _WRITER.replace("close (7)", "open (7, file='own.txt')").replace("'half '", "'whole'")
    source = tmp_path / "opener.f90"
    source.write_text(text)
    scene = usersub.Scene(points=1, props=[-0.5], nodes=1)
    opener = usersub.CoefficientDriver(usersub.load(source).only(), scene)
    _call(opener, 6.0)
    assert (tmp_path / "own.txt").read_text() == "pressure  6.00\n"
    closing = _driver(tmp_path, mu=-0.5)
    _call(closing, 7.0)
    _call(driver, 8.0)
    assert said == ["line", "line", "pressure  7.00", "line", "pressure  8.00"]


@pytest.mark.needs_fortran
def test_routine_that_closes_the_unit_leaves_no_litter(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    said = []
    usersub.messages_to(lambda level, text: said.append(text))
    driver = _driver(tmp_path)
    _call(driver, 1.0)
    closing = _driver(tmp_path, mu=-0.5)
    _call(closing, 2.0)
    _call(driver, 3.0)
    assert said == ["pressure  1.00", "pressure  2.00", "pressure  3.00"]
    assert {p.name for p in tmp_path.iterdir()} == {"writer.f90"}


@pytest.mark.needs_fortran
def test_much_output_starts_the_file_again(tmp_path):
    lines = []
    usersub.messages_to(lambda level, text: lines.append(text))
    driver = _driver(tmp_path, mu=11.0)
    for pressure in (1.0, 2.0, 3.0):
        _call(driver, pressure)
    assert len(lines) == 3 * 50001
    assert [line for line in lines if line.startswith("p")] == [
        "pressure  1.00", "pressure  2.00", "pressure  3.00",
    ]  # fmt: skip
    assert {line for line in lines if not line.startswith("p")} == {"x" * 99}


@pytest.mark.needs_fortran
def test_receivers(tmp_path, capsys):
    driver = _driver(tmp_path)
    _call(driver, 1.0)
    assert capsys.readouterr().err == "pressure  1.00\n"
    usersub.messages_to(tmp_path / "said.txt")
    _call(driver, 2.0)
    usersub.messages_to(None)
    _call(driver, 3.0)
    assert (tmp_path / "said.txt").read_text() == "pressure  2.00\n"
    assert capsys.readouterr().err == ""


def test_path_that_cannot_be_written_is_refused_at_once(tmp_path):
    with pytest.raises(OSError):
        usersub.messages_to(tmp_path / "no" / "folder.txt")


def test_routine_without_output_has_nothing_to_do_after_a_call():
    field = Path(__file__).resolve().parents[1] / "field"
    assert usersub.load(field / "vfric_coef_table.c").only().after_call is None


@pytest.mark.needs_fortran
def test_stop_inside_of_a_write_leaves_the_unit_usable(tmp_path):
    """The statement that is left half done is ended; nothing waits for its unit for ever."""
    source = tmp_path / "inside.f90"
    source.write_text(
        "subroutine vfric_coef(fc,fd,nb,np,nt,nf,jf,rd,a,b,c,props,rate,p,t,f)\n"
        " include 'vaba_param.inc'\n character*80 a, b, c\n dimension fc(nb), p(nb)\n"
        " write (7, '(a,f5.1)') 'p', checked(p(1))\n fc(1) = p(1)\nend\n"
        "function checked(p)\n include 'vaba_param.inc'\n character*8 text\n"
        " write (text, '(i0)') nint(p)  ! a statement inside of the other one\n"
        " if (p > 5) stop 7\n checked = p + 10 * len_trim(text)\nend\n"
    )
    said = []
    usersub.messages_to(lambda level, text: said.append(text))
    routine = usersub.load(source).only()
    assert not routine.thread_safe
    driver = usersub.CoefficientDriver(routine, usersub.Scene(points=1, props=[0.0], nodes=1))
    _call(driver, 1.0)
    for _ in range(3):
        with pytest.raises(usersub.RoutineError, match="STOP 7"):
            _call(driver, 9.0)
    _call(driver, 2.0)
    assert [text for text in said if text.strip() not in ("", "p")] == ["p 11.0", "p 12.0"]


@pytest.mark.parametrize("wrong", [3, 2.5, b"file", ["file"]])
def test_a_receiver_that_is_none(wrong):
    with pytest.raises(usersub.SceneError, match="expected a function of level and text, a path"):
        usersub.messages_to(wrong)
