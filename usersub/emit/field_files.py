# SPDX-License-Identifier: MIT
"""Makes the include files that published user subroutines name, in `csrc/include/usersub/field/`.

They are written in our own words and hold what such sources rely on: typing rules, a few
parameters, the interfaces of utility routines. Fortran ones work in fixed and in free form:
statements start in column 7, end before column 72 and are never continued; comments start with
an exclamation mark. They hold no preprocessor lines, so that INCLUDE and #include both read them.
"""

from __future__ import annotations

from usersub import abi
from usersub.emit import abi_header, text

FOLDER = "csrc/include/usersub/field/"

#: Length of the vectors of explicit user subroutines (n_vec_Length), as in older releases.
VECTOR_LENGTH = 136
#: Most points of a call (maxblk), as in newer releases. Routines have local arrays of this length,
#: so that no plan may choose longer blocks.
LONGEST_BLOCK = 512

_INT, _INT8, _REAL4, _REAL8 = "integer", "integer(8)", "real(4)", "real(8)"


def artefacts() -> dict[str, str]:
    """All include files by path."""
    standard, single, double = _standard_rule(), _explicit_rule("single"), _explicit_rule("double")
    arrays, utilities = _arrays(), _utilities()
    files = {
        "ABA_PARAM.INC": standard,
        "aba_param.inc": standard,
        "aba_param_dp.inc": standard,
        "vaba_param_sp.inc": single,
        "vaba_param_dp.inc": double,
        "SMAAspUserArrays.hdr": _fortran(arrays),
        "SMAAspUserUtilities.hdr": _fortran(utilities),
        "SMAAspUserSubroutines.hdr": _fortran(arrays + utilities),
        "SMAAspUserArrays.h": _c_arrays(),
        "SMAAspUserUtilities.h": _c_utilities(),
        "SMAAspUserSubroutines.h": _c_both(),
        "omi_for_c.h": _for_name(),
        "aba_for_c.h": _c_file("aba_for_c.h", '#include "omi_for_c.h"\n', ""),
    }
    for precision, rule in (("single", single), ("double", double)):
        files |= {f"{precision}/{name}": rule for name in ("VABA_PARAM.INC", "vaba_param.inc")}
    return {FOLDER + name: content for name, content in files.items()}


def _head(about: str) -> str:
    return text.banner(__name__, "field") + f"!     {about}\n"


def _statements(lines: list[str]) -> str:
    return "".join(f"      {line}\n" for line in lines)


def _standard_rule() -> str:
    return _head("Typing rule of the implicit routines.") + _statements(
        ["implicit double precision (a-h,o-z)", "parameter (nprecd=2)"]
    )


def _explicit_rule(precision: str) -> str:
    kind, number = {"single": ("real", 1), "double": ("double precision", 2)}[precision]
    return _head(f"Typing rule of the explicit routines, {precision} precision.") + _statements(
        [
            f"implicit {kind} (a-h,o-z)",
            f"parameter (j_sys_Dimension={number})",
            f"parameter (n_vec_Length={VECTOR_LENGTH})",
            f"parameter (maxblk={LONGEST_BLOCK})",
        ]
    )


def _procedure(name: str, result: str | None, parameters: tuple[tuple[str, str], ...]) -> list[str]:
    """An interface body; a type that ends in "?" makes the parameter optional."""
    word = "function" if result else "subroutine"
    lines = [f"{word} {name}({', '.join(n for n, _ in parameters)})"]
    lines += [f"{result} :: {name}"] if result else []
    for parameter, kind in parameters:
        extra = ", optional" if kind.endswith("?") else ""
        lines.append(f"{kind.rstrip('?')}{extra} :: {parameter}")
    return [*lines, f"end {word} {name}"]


def _arrays() -> list[str]:
    """Allocatable arrays by number; the address they return is meant for a Cray pointer."""
    one, size = ("id", _INT), ("length", _INT)
    lines = []
    for stem in ("SMA", "SMALocal"):
        name = f"{stem}IntArray"
        value = ("value", _INT + "?")
        lines += ["interface", *_procedure(f"{name}Create", _INT8, (one, size, value))]
        for kind in ("Int", "Float", "Struct"):
            name = f"{stem}{kind}Array"
            lines += _procedure(f"{name}Access", _INT8, (one,))
            lines += _procedure(f"{name}Size", _INT8, (one,))
            lines += _procedure(f"{name}Delete", None, (one,))
        # The size of an item is a default integer or, from SIZEOF, an 8-byte one.
        item = (("items", _INT), ("bytes", "type(*)"), ("value", "type(*)?"))
        lines += _procedure(f"{stem}StructArrayCreate", _INT8, (one, *item))
        lines += ["end interface", f"interface {stem}FloatArrayCreate"]
        # The type of the initial value tells the precision; without one it is double.
        for suffix, kind in (("SP", _REAL4), ("DP", _REAL8 + "?")):
            parameters = (one, size, ("value", kind))
            lines += _procedure(f"{stem}FloatArrayCreate{suffix}", _INT8, parameters)
        lines.append("end interface")
    return lines


def _utilities() -> list[str]:
    """Threads and mutexes; without these lines the two functions would count as real."""
    lines = ["interface"]
    for name in ("get_thread_id", "getNumThreads"):
        lines += _procedure(name, _INT, ())
    for verb in ("Init", "Lock", "Unlock"):
        lines += _procedure(f"Mutex{verb}", None, (("id", _INT),))
    return [*lines, "end interface"]


def _fortran(lines: list[str]) -> str:
    return _head("Declarations only; stands after the typing rule.") + _statements(lines)


def _c_file(name: str, declarations: str, includes: str = "<stddef.h>") -> str:
    guard = name.replace(".", "_").upper()
    lines = "".join(f"#include {i}\n" for i in includes.split())
    return (
        f"{text.banner(__name__)}#ifndef {guard}\n#define {guard}\n\n{lines}"
        f"{declarations}\n#endif\n"
    )


def _extern(lines: list[str]) -> str:
    body = "\n".join(lines)
    return (
        f'\n#ifdef __cplusplus\nextern "C" {{\n#endif\n\n{body}\n\n#ifdef __cplusplus\n}}\n#endif\n'
    )


def _c_arrays() -> str:
    lines = []
    for stem in ("SMA", "SMALocal"):
        lines.append(f"int *{stem}IntArrayCreate(int id, int length, int value);")
        for suffix, real in (("", "double"), ("SP", "float"), ("DP", "double")):
            lines.append(
                f"{real} *{stem}FloatArrayCreate{suffix}(int id, int length, {real} value);"
            )
        lines.append(
            f"void *{stem}StructArrayCreate(int id, int items, size_t bytes, const void *value);"
        )
        for kind, of in (("Int", "int"), ("Float", "double"), ("Struct", "void")):
            lines.append(f"{of} *{stem}{kind}ArrayAccess(int id);")
            lines.append(f"size_t {stem}{kind}ArraySize(int id);")
            lines.append(f"void {stem}{kind}ArrayDelete(int id);")
    return _c_file("SMAAspUserArrays.h", _extern(lines))


def _c_utilities() -> str:
    lines = ["int get_thread_id(void);", "int getNumThreads(void);"]
    lines += [f"void Mutex{verb}(int id);" for verb in ("Init", "Lock", "Unlock")]
    return _c_file("SMAAspUserUtilities.h", _extern(lines))


def _c_both() -> str:
    return _c_file("SMAAspUserSubroutines.h", "", '"SMAAspUserArrays.h" "SMAAspUserUtilities.h"')


def _for_name() -> str:
    names = "".join(f" *   FOR_NAME({name}, {name.upper()})\n" for name in abi.NAMES)
    about = f"/* Names of the five routines:\n{names} */\n"
    return _c_file("omi_for_c.h", f"{about}{abi_header.FOR_NAME}", "")
