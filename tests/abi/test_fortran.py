# SPDX-License-Identifier: MIT
"""The Fortran module and the include files of field code, in fixed and free form."""

import subprocess

import pytest

from usersub import abi
from usersub.emit import c_declarations, fortran_module, text
from usersub.emit.__main__ import ROOT

INCLUDE = ROOT / "csrc/include"
FIELD = INCLUDE / "usersub/field"
MODULE = INCLUDE / "usersub/usersub.f90"
WARNINGS = ["-Wall", "-Wextra", "-Werror"]


def run(command, folder):
    done = subprocess.run(
        [str(word) for word in command], cwd=folder, capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


@pytest.fixture(scope="module")
def module(fortran, tmp_path_factory):
    """Folder with the compiled module."""
    folder = tmp_path_factory.mktemp("module")
    run([fortran, "-std=f2018", *WARNINGS, "-c", MODULE, "-o", folder / "usersub.o"], folder)
    return folder


def test_module_has_every_function_of_the_header():
    declared = c_declarations.declarations()
    made = fortran_module.artefacts()[fortran_module.PATH]
    assert len(declared.functions) > 30
    for function in declared.functions:
        assert f"name='{function.name}')" in made
    assert declared.handles == ("usub_routine", "usub_scene", "usub_driver")


@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda f: f.key)
def test_a_routine_of_each_interface_fits_its_abstract_interface(fortran, module, tmp_path, face):
    """A pointer of the abstract interface is set to a routine written from the table."""
    for real, name in text.function_types(face).items():
        kinds = {"real": f"real({'8' if real == 'double' else '4'})", "int": "integer",
                 "char": f"character({abi.NAME_LENGTH})"}  # fmt: skip
        ordered = sorted(face.args, key=lambda a: (a.kind != "int", bool(a.shape)))
        declared = "\n".join(
            f"{kinds[a.kind]}, intent({'in' if a.intent == 'read' else 'inout'}) :: {a.name}"
            + (f"({','.join(a.shape)})" if a.shape else "")
            for a in ordered
        )
        listed = ", &\n".join(a.name for a in face.args)
        source = f"""
program check
  use usersub
  implicit none
  procedure({name}), pointer :: pointer
  pointer => law
  print *, associated(pointer)
contains
  subroutine law({listed})
{declared}
  end subroutine
end program
"""
        (tmp_path / "check.f90").write_text(source)
        run([fortran, f"-I{module}", "-c", "check.f90"], tmp_path)


def test_types_have_the_sizes_of_c(fortran, module, tmp_path):
    (tmp_path / "sizes.f90").write_text("""
program sizes
  use usersub
  implicit none
  type(usub_driver) :: driver
  type(usub_error) :: error
  type(usub_plan_row) :: row
  print '(3(i0,1x))', c_sizeof(driver), c_sizeof(error), c_sizeof(row)
end program
""")
    (tmp_path / "sizes.c").write_text("""
#include <stdio.h>
#include <usersub/usersub.h>
int main(void) {
  printf("%zu %zu %zu \\n", sizeof(usub_driver *), sizeof(usub_error), sizeof(usub_plan_row));
  return 0;
}
""")
    run(["cc", f"-I{INCLUDE}", "sizes.c", "-o", "c"], tmp_path)
    run([fortran, f"-I{module}", "sizes.f90", module / "usersub.o", "-o", "f"], tmp_path)
    assert run(["./c"], tmp_path).split() == run(["./f"], tmp_path).split()


def test_strings_of_c(fortran, module, tmp_path):
    (tmp_path / "strings.f90").write_text("""
program strings
  use usersub
  implicit none
  character(kind=c_char), target :: text(4) = ['a', 'b', 'c', c_null_char]
  type(usub_error) :: error
  error%message = c_null_char
  error%message(1:2) = ['n', 'o']
  print '(7a)', '[', usub_string(c_loc(text)), '][', usub_string(c_null_ptr), '][', &
    usub_error_string(error), ']'
end program
""")
    run([fortran, "-Wall", "-fcheck=all", f"-I{module}", "strings.f90", module / "usersub.o",
         "-o", "strings"], tmp_path)  # fmt: skip
    assert run(["./strings"], tmp_path) == "[abc][][no]\n"


FIXED = """\
      subroutine kinds(k, j)
      include '{include}'
      integer k(2), j
      k(1) = kind(x)
      k(2) = kind(i)
      j = {number}
      end
      subroutine threads(n)
      include '{include}'
{directive} <SMAAspUserSubroutines.hdr>
      integer n(5)
      n(1) = kind(get_thread_id())
      n(2) = kind(SMALocalIntArrayCreate(1, 20))
      n(3) = kind(SMALocalIntArrayCreate(1, 20, 7))
      n(4) = kind(SMAFloatArrayCreate(1, 20, 1.e0))
      n(5) = kind(SMALocalFloatArrayCreate(1, 20))
      n(5) = kind(SMAStructArrayCreate(1, 20, sizeof(n)))
      n(5) = kind(SMAStructArrayCreate(1, 20, 8, x))
      n(5) = kind(SMALocalFloatArrayAccess(2))
      end
"""

PROGRAM = """\
program show
  integer :: k(2), j, n(5)
  call kinds(k, j)
  call threads(n)
  print '(8(i0,1x))', k, j, n
end program
"""


@pytest.mark.parametrize(("form", "length"), [("fixed", 72), ("fixed", 132), ("free", 132)])
@pytest.mark.parametrize(
    ("include", "folder", "number", "kind", "value"),
    [
        ("ABA_PARAM.INC", "double", "nprecd", 8, 2),
        ("aba_param.inc", "single", "nprecd", 8, 2),
        ("VABA_PARAM.INC", "double", "j_sys_Dimension", 8, 2),
        ("vaba_param.inc", "double", "n_vec_Length", 8, 136),
        ("VABA_PARAM.INC", "single", "j_sys_Dimension", 4, 1),
        ("vaba_param.inc", "single", "maxblk", 4, 512),
        ("vaba_param_sp.inc", "double", "j_sys_Dimension", 4, 1),
        ("vaba_param_dp.inc", "single", "j_sys_Dimension", 8, 2),
    ],
)
def test_include_files(fortran, tmp_path, form, length, include, folder, number, kind, value):
    """Kinds of an implicit real and integer, the parameter, kinds of the utility functions."""
    source = FIXED.format(include=include, number=number, directive="#include")
    (tmp_path / "law.f").write_text(source)
    (tmp_path / "show.f90").write_text(PROGRAM)
    flags = [f"-f{form}-form", f"-f{form}-line-length-{length}"]
    common = [fortran, "-cpp", "-std=legacy", "-fcray-pointer", f"-I{FIELD}", f"-I{FIELD}/{folder}"]
    run([*common, *flags, "-c", "law.f"], tmp_path)
    # The utilities live in the library; here only their kinds matter, so they need not resolve.
    run([fortran, "-Wl,--unresolved-symbols=ignore-all", "-no-pie", "show.f90", "law.o", "-o",
         "show"], tmp_path)  # fmt: skip
    assert run(["./show"], tmp_path).split()[:3] == [str(kind), "4", str(value)]


@pytest.mark.parametrize("form", ["fixed", "free"])
def test_header_files_are_plain_declarations(fortran, tmp_path, form):
    """Read by INCLUDE as well as by #include, each on its own, with warnings as errors."""
    for name in ("SMAAspUserArrays", "SMAAspUserUtilities", "SMAAspUserSubroutines"):
        body = (
            "      subroutine law(n)\n      implicit none\n"
            f"      include '{name}.hdr'\n      integer n\n      n = 1\n      end\n"
        )
        (tmp_path / "law.f").write_text(body)
        run([fortran, f"-f{form}-form", *WARNINGS, f"-I{FIELD}", "-c", "law.f"], tmp_path)


def test_include_files_fit_the_fixed_form():
    for file in FIELD.rglob("*"):
        if file.suffix.lower() in (".inc", ".hdr"):
            for line in file.read_text().splitlines():
                assert line.startswith(("!", "      ")) and len(line) <= 72
                assert "&" not in line and "\t" not in line and line[6:7] != " "
