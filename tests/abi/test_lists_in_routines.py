# SPDX-License-Identifier: MIT
"""Routines that take their argument list from generated text are complete and analysed."""

import pytest

import usersub
from usersub import abi
from usersub.emit import text
from usersub.routine.routine import UNUSED

C = """
#include <usersub/abi.h>
void FOR_NAME({name}, {NAME})({stem}_PARAMETERS) {{
  {first}[0] = {second}[0];
}}
"""

FORTRAN = """
subroutine {name}( &
#include "usersub/arguments/{key}_names.fi"
  implicit none
#include "usersub/arguments/{key}_types.fi"
  call usub_store({first}, {second})
contains
  subroutine usub_store(to, from)
    {real} :: to(*), from(*)
    to(1) = from(1)
  end subroutine
end subroutine
"""


def used_names(routine):
    return {
        a.modern
        for a, use in zip(routine.interface.args, routine.uses, strict=True)
        if use != UNUSED
    }


def pair(face):
    """The first output and the properties: what the routines below use."""
    first = next(a for a in face.args if a.kind == "real" and a.intent != "read" and a.shape)
    second = next(a for a in face.args if a.modern.lower() == "props")
    return first.modern, second.modern


@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda f: f.key)
def test_c_routine(face, tmp_path):
    first, second = pair(face)
    file = tmp_path / "law.c"
    file.write_text(
        C.format(name=face.name, NAME=face.name.upper(), stem=text.constant(face), first=first,
                 second=second)
    )  # fmt: skip
    routine = usersub.load(file, generation=face.generation)[face.name]
    assert used_names(routine) == {first, second}


@pytest.mark.needs_fortran
@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda f: f.key)
def test_fortran_routine(face, tmp_path):
    first, second = pair(face)
    file = tmp_path / "law.f90"
    real = "double precision"
    file.write_text(
        FORTRAN.format(name=face.name, key=face.key, first=first, second=second, real=real)
    )
    routine = usersub.load(file, generation=face.generation)[face.name]
    used = used_names(routine)
    # An argument that is the dimension of another one counts as used.
    sizes = {a.modern for a in face.args if a.kind == "int"}
    assert {first, second} <= used <= {first, second} | sizes
