# SPDX-License-Identifier: MIT
"""The compiled helper for Fortran units: connecting, flushing and rewinding them."""

from __future__ import annotations

from pathlib import Path

from usersub.errors import CompileError
from usersub.routine import cache, compilers

_CONNECT = """\
subroutine usub_unit_open(unit, path, length, state) bind(c)
  use iso_c_binding
  integer(c_int), value :: unit, length
  character(kind=c_char), intent(in) :: path(*)
  integer(c_int), intent(out) :: state
  character(len=length) :: name
  integer :: i
  do i = 1, length
    name(i:i) = path(i)
  end do
  open (unit=unit, file=name, form='formatted', status='old', action='readwrite', iostat=state)
end subroutine
integer(c_int) function usub_unit_flush(unit, path, length) bind(c)
  use iso_c_binding
  integer(c_int), value :: unit, length
  character(kind=c_char), intent(in) :: path(*)
  character(len=4096) :: name
  logical :: connected
  integer :: i
  inquire (unit=unit, opened=connected)
  usub_unit_flush = 0
  if (.not. connected) return
  flush (unit)
  inquire (unit=unit, name=name)
  usub_unit_flush = 1
  if (len_trim(name) /= length) usub_unit_flush = 2
  do i = 1, min(length, len(name))
    if (name(i:i) /= path(i)) usub_unit_flush = 2
  end do
  if (index(name, 'fort.', back=.true.) == max(1, len_trim(name) - 5) .and. &
      usub_unit_flush == 2) usub_unit_flush = 3
end function
subroutine usub_unit_again(unit) bind(c)
  use iso_c_binding
  integer(c_int), value :: unit
  rewind (unit)
end subroutine
subroutine usub_unit_delete(unit) bind(c)
  use iso_c_binding
  integer(c_int), value :: unit
  close (unit, status='delete')
end subroutine
"""


def connector() -> Path:
    """The library that connects, flushes, rewinds and deletes units.

    Raises:
        MissingTool, CompileError: there is no gfortran, or it fails.
    """
    compiler = compilers.find("fortran")
    target = cache.path("units", cache.key("units", compiler.version, _CONNECT), ".so")
    if not target.is_file():
        with cache.build_folder() as folder:
            (folder / "units.f90").write_text(_CONNECT, encoding="ascii")
            command = [*compiler.command, "-O1", "-fPIC", "-shared", "units.f90", "-o", "units.so"]
            outcome = compilers.run(command, folder)
            if outcome.code:
                raise CompileError(f"units 6 and 7 cannot be connected: {outcome.text.strip()}")
            cache.put(folder / "units.so", target)
    return target
