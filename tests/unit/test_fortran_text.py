# SPDX-License-Identifier: MIT
"""Statements and program units of Fortran text."""

from __future__ import annotations

import pytest

from usersub.routine import fortran_text
from usersub.routine.fortran_text import declares, is_free, units, uses

_FIXED = """\
c     subroutine comment(a)
      RECURSIVE SUBROUTINE OUTER(A,
     1  B)
      INTERFACE
      SUBROUTINE NOT_A_UNIT(X)
      END SUBROUTINE
      END INTERFACE
      INTEGER FUNCTIONS(3)
      FUNCTIONX(1) = 3
      PRINT *, 'SUBROUTINE IN_TEXT(', "END"
      END DO = 1
      CALL B
      CONTAINS
      REAL * 8 FUNCTION INNER (X)
      INNER = X
      END FUNCTION INNER
      END
\tDOUBLE PRECISION FUNCTION TABBED(X,
\t1  Y)
\tTABBED = X
\tEND
      BLOCK DATA
      END BLOCK DATA
"""

_FREE = """\
module m
  use, intrinsic :: iso_c_binding
  implicit none
contains
  pure elemental function f(x) result(y); real, intent(in) :: x; real :: y
    y = x & ! the end
      & + 1
  end function f
  subroutine s(a) bind(c, name='s')
    real :: a
  end subroutine
end module
"""


def test_units_of_fixed_form():
    found = units(_FIXED, False, "a.f")
    assert [(u.kind, u.name, u.line) for u in found] == [
        ("subroutine", "outer", 2),
        ("function", "inner", 14),
        ("function", "tabbed", 18),
        ("blockdata", "", 22),
    ]
    assert len(found[2].statements) == 3  # the tab continuation belongs to the first


def test_units_of_free_form():
    found = units(_FREE, True, "a.f90")
    assert [(u.kind, u.name) for u in found] == [
        ("module", "m"),
        ("function", "f"),
        ("subroutine", "s"),
    ]
    assert "y=x+1" in [s.code for s in found[1].statements]
    assert fortran_text.place_for_declarations(found[0]) == 2


def test_line_markers_count():
    text = (
        '# 1 "x.f"\n      subroutine a\n      end\n# 40 "y.inc" 1\n      subroutine b\n      end\n'
    )
    assert [(u.name, u.file, u.line) for u in units(text, False, "z")] == [
        ("a", "x.f", 1),
        ("b", "y.inc", 40),
    ]


@pytest.mark.parametrize(
    ("suffix", "text", "free"),
    [
        (".f", "", False),
        (".FOR", "", False),
        (".F90", "", True),
        (".for", "! comment\n!DEC$ FREEFORM\n", True),
        (".f", "CDIR$ FREEFORM\n", True),
        (".f90", "!dir$ nofreeform\n", False),
        (".f90", "!DIR$ FIXEDFORM:132\n", False),
        (".f", "      print *, '!DEC$ FREEFORM'\n", False),
    ],
)
def test_form(suffix, text, free):
    assert is_free(suffix, text) is free


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("      INCLUDE 'ABA_PARAM.INC'", "ABA_PARAM.INC"),
        ('\tinclude "a b.inc"', "a b.inc"),
        ("      Include 'Vaba_Param.inc'  ! isn't it", "Vaba_Param.inc"),
        ("#include <SMAAspUserSubroutines.hdr>", "SMAAspUserSubroutines.hdr"),
        ('  #  include "x.h"  ', "x.h"),
        ("      include = 3", None),
        ("      call include('x')", None),
    ],
)
def test_include_lines(line, name):
    assert fortran_text.include_of(line) == name


@pytest.mark.parametrize(
    ("body", "used", "declared"),
    [
        ("      i = get_thread_id()\n", True, False),
        ("      integer get_thread_id\n      i = Get_Thread_ID ( ) + 1\n", True, True),
        ("      integer, external :: getnum, get_thread_id\n", False, True),
        ("      external get_thread_id\n      i = get_thread_id()\n", True, False),
        ("      call foo('get_thread_id()')\n", False, False),
        ("      i = my_get_thread_id()\n", False, False),
        ("      interface\n      integer function get_thread_id()\n      end function\n"
         "      end interface\n", True, True),
    ],
)  # fmt: skip
def test_uses_and_declares(body, used, declared):
    unit = units("      subroutine a\n" + body + "      end\n", False, "a.f")[0]
    assert declares(unit, "get_thread_id") is declared
    assert declared or uses(unit, "get_thread_id") is used


@pytest.mark.parametrize(
    ("line", "free", "comment"),
    [
        ("C text", False, True),
        ("* text", False, True),
        ("D     x = 1", False, True),
        ("d\tx = 1", False, True),
        ("data x /1/", False, False),
        ("     ! continues", False, False),
        ("   ! text", False, True),
        ("!$OMP parallel", False, False),
        ("c", True, False),
        ("     ! text", True, True),
    ],
)
def test_comment_lines(line, free, comment):
    assert fortran_text.is_comment(line, free) is comment
