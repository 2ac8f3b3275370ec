# SPDX-License-Identifier: MIT
"""Makes `csrc/include/usersub/usersub.f90`: the C interface as a Fortran module."""

from __future__ import annotations

from usersub import abi
from usersub.emit import c_declarations, text
from usersub.emit.c_declarations import Declarations, Function, Name
from usersub.statuses import STATUSES

PATH = "csrc/include/usersub/usersub.f90"

_SCALARS = {
    "int32_t": "integer(c_int32_t)",
    "int64_t": "integer(c_int64_t)",
    "uint64_t": "integer(c_int64_t)",
    "int": "integer(c_int)",
    "size_t": "integer(c_size_t)",
    "double": "real(c_double)",
    "float": "real(c_float)",
    "unsigned char": "integer(c_signed_char)",
    "char": "character(kind=c_char)",
    "void": "type(c_ptr)",
}

#: Parameters that may be left out (NULL in C).
_OPTIONAL = ("library", "generation", "error")

_HEAD = """\
!> The C interface of usersub for Fortran hosts; see usersub.h for what each function does.
!! Fortran 2018: arguments of C functions are optional.
!!
!! Handles are values of the types usub_routine, usub_scene and usub_driver. Text that goes in ends
!! with c_null_char: status = usub_bind(driver, "normal_force"//c_null_char, c_loc(f), n);
!! text that comes out is read by usub_string and usub_error_string. Bound arrays need
!! the target attribute. The arguments library, generation and error may be left out. Fortran has no
!! upper and lower case, so status USUB_CUT_BACK of C is usub_status_cut_back here.
module usersub
  use, intrinsic :: iso_c_binding
  implicit none
  public
"""

_STRINGS = """\
contains

  !> Text of a C string, for example of what usub_message returns.
  function usub_string(pointer) result(string)
    type(c_ptr), value :: pointer
    character(len=:), allocatable :: string
    character(kind=c_char), pointer :: characters(:)
    integer :: length
    string = ''
    if (.not. c_associated(pointer)) return
    call c_f_pointer(pointer, characters, [huge(1)])
    length = 0
    do while (characters(length + 1) /= c_null_char)
      length = length + 1
    end do
    string = joined(characters(1:length))
  end function usub_string

  !> Message of a usub_error.
  function usub_error_string(error) result(string)
    type(usub_error), intent(in) :: error
    character(len=:), allocatable :: string
    integer :: length
    do length = 0, size(error%message) - 1
      if (error%message(length + 1) == c_null_char) exit
    end do
    string = joined(error%message(1:length))
  end function usub_error_string

  pure function joined(characters) result(string)
    character(kind=c_char), intent(in) :: characters(:)
    character(len=size(characters)) :: string
    integer :: i
    do i = 1, size(characters)
      string(i:i) = characters(i)
    end do
  end function joined

end module usersub
"""


def artefacts() -> dict[str, str]:
    """The module."""
    found = c_declarations.declarations()
    parts = [
        text.banner(__name__, "fortran") + _HEAD + "  private :: joined\n",
        _constants(found),
        *(_handle(name) for name in found.handles),
        *(_struct(name, members) for name, members in found.structs.items()),
        "  interface\n",
        *(_function(function, found) for function in found.functions),
        "  end interface\n",
        "  !> The routines themselves, for `procedure(...)` declarations.\n  abstract interface\n",
        *(
            _routine(face, real, name)
            for face in abi.INTERFACES
            for real, name in text.function_types(face).items()
        ),
        "  end interface\n",
        _STRINGS,
    ]
    return {PATH: "\n".join(parts)}


def _constants(found: Declarations) -> str:
    rows = [f"usub_status_{s.name.lower()} = {s.value}" for s in STATUSES]
    rows += ["usub_style_full = 0", "usub_style_block = 1"]
    rows += [f"{name.lower()} = {value}" for name, value in found.constants.items()]
    rows += [f"usub_name_length = {abi.NAME_LENGTH}"]
    rows += [f"usub_module_abi_version = {abi.ABI_VERSION}"]
    lines = [f"  integer(c_int32_t), parameter :: {row}" for row in rows]
    lines.append(f"  character(len=*), parameter :: usub_module_abi_hash = '{abi.abi_hash()}'")
    return "\n".join(lines) + "\n"


def _handle(name: str) -> str:
    return f"  type, bind(C) :: {name}\n    type(c_ptr) :: handle = c_null_ptr\n  end type {name}\n"


def _struct(name: str, members: tuple[Name, ...]) -> str:
    rows = []
    for member in members:
        kind = "type(c_ptr)" if member.pointers else _SCALARS[member.base]
        length = f"({member.length})" if member.length else ""
        rows.append(f"    {kind} :: {member.name}{length}\n")
    return f"  type, bind(C) :: {name}\n{''.join(rows)}  end type {name}\n"


def _function(function: Function, known: Declarations) -> str:
    result = function.result
    is_function = result.pointers or result.base != "void"
    word = "function" if is_function else "subroutine"
    names = ", ".join(p.name for p in function.parameters)
    head = f"{word} {function.name}({names}) bind(C, name='{function.name}')"
    lines = _statement(4, head + (" result(answer)" if is_function else ""))
    lines.append("      import")
    lines += [f"      {_parameter(p, known)} :: {_shaped(p)}" for p in function.parameters]
    if is_function:
        kind = "type(c_ptr)" if result.pointers else _SCALARS[result.base]
        lines.append(f"      {kind} :: answer")
    return "\n".join([*lines, f"    end {word} {function.name}"]) + "\n"


def _is_array(item: Name) -> bool:
    # One pointer to a plain number or text is an array, except for a size_t, which is returned.
    return item.pointers == 1 and item.base in _SCALARS and item.base not in ("void", "size_t")


def _shaped(item: Name) -> str:
    return f"{item.name}(*)" if _is_array(item) else item.name


def _parameter(item: Name, known: Declarations) -> str:
    kind = _SCALARS.get(item.base, f"type({item.base})")
    if item.base in (*known.callbacks, "usub_entry"):
        return "type(c_funptr), value"
    by_value = item.pointers == 0 or (
        item.pointers == 1 and (item.base in known.handles or item.base == "void")
    )
    if by_value:
        return f"{kind}, value"
    intent = "in" if item.const else "inout" if _is_array(item) else "out"
    return f"{kind}, intent({intent})" + (", optional" if item.name in _OPTIONAL else "")


def _routine(face: abi.Interface, real: str, name: str) -> str:
    kinds = {
        "real": f"real({'c_double' if real == 'double' else 'c_float'})",
        "int": "integer(c_int)",
        "char": f"character(len={abi.NAME_LENGTH})",
    }
    intents = {"read": "in", "write": "inout", "readwrite": "inout"}
    lines = _statement(4, f"subroutine {name}({', '.join(a.modern for a in face.args)})")
    lines.append("      import")
    # Sizes first: a dimension has to be declared before it is used.
    for arg in sorted(face.args, key=lambda a: (a.kind != "int", bool(a.shape))):
        shape = modern_shape(face, arg)
        declared = f"{kinds[arg.kind]}, intent({intents[arg.intent]})"
        lines.append(f"      {declared} :: {arg.modern}{shape}")
    return "\n".join([*lines, f"    end subroutine {name}"]) + "\n"


def modern_shape(face: abi.Interface, arg: abi.Arg) -> str:
    """Dimensions in the newer spelling with parentheses (tables have the older one); "" if none."""
    symbols = []
    for symbol in arg.shape:
        found = face.positions.get(symbol.lower())
        symbols.append(symbol if found is None else face.args[found].modern)
    return f"({','.join(symbols)})" if symbols else ""


def _statement(indent: int, statement: str) -> list[str]:
    """One statement on lines of at most 96 columns with continuation marks."""
    import textwrap

    pad = " " * indent
    lines = textwrap.wrap(
        statement, 96, initial_indent=pad, subsequent_indent=pad + "    ", break_long_words=False
    )
    return [f"{line} &" for line in lines[:-1]] + lines[-1:]
