# SPDX-License-Identifier: MIT
"""Makes `csrc/include/usersub/abi.h`: positions, function types and parameter lists for C."""

from __future__ import annotations

from usersub import abi
from usersub.emit import text

PATH = "csrc/include/usersub/abi.h"

_HEAD = """\
/** @file abi.h
 * The argument lists of the five friction interfaces, for C and C++: usable alone.
 *
 * A routine in C, in double precision or, with USUB_SINGLE defined, in single precision:
 *
 *     #include <usersub/abi.h>
 *     void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
 *       for (int i = 0; i < *nBlock; ++i) fCoef[i] = props[0];
 *     }
 *
 * In C++ the same with `extern "C"` in front. Arguments have their newer names.
 */
#ifndef USERSUB_ABI_H
#define USERSUB_ABI_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
"""

_TAIL = """\
#ifdef __cplusplus
}
#endif

#endif
"""

_REAL = """\
/** Precision of the explicit routines of a source file; FRIC and FRIC_COEF are always double. */
#ifdef USUB_SINGLE
typedef float usub_real;
#else
typedef double usub_real;
#endif
"""

_STAMP = """\
/* What is built with this header says so, and is refused by a library of another table. */
#if defined(__ELF__) && defined(__GNUC__)
extern const char usub_routine_abi_hash[17] __attribute__((weak, visibility("default")));
const char usub_routine_abi_hash[17] = USUB_ABI_HASH;
#endif

"""

#: External name of a routine as Fortran compilers on Linux form it; also in omi_for_c.h.
FOR_NAME = """\
/** External name of a routine: lower case and one underscore. */
#ifndef FOR_NAME
#define FOR_NAME(lower, UPPER) lower##_
#endif
"""


def artefacts() -> dict[str, str]:
    """The header."""
    parts = [text.banner(__name__) + _HEAD, _versions(), _REAL, FOR_NAME, _numbers()]
    parts += [_interface(face) for face in abi.INTERFACES]
    return {PATH: "\n".join([*parts, _TAIL])}


def _versions() -> str:
    return (
        "/** Version and hash of the tables that this header was made from. */\n"
        f"#define USUB_ABI_VERSION {abi.ABI_VERSION}\n"
        f'#define USUB_ABI_HASH "{abi.abi_hash()}"\n\n'
        + _STAMP
        + "/** Length of the blank-padded names. */\n"
        f"#define USUB_NAME_LENGTH {abi.NAME_LENGTH}\n\n"
        "/** How an entry is called: with the published argument list and hidden lengths, as\n"
        " * `int f(void **argv)` with the addresses of the arguments in order, or (FRIC) for\n"
        " * several contact points at once (usub_routine_create). */\n"
        "#define USUB_STYLE_FULL 0\n#define USUB_STYLE_BLOCK 1\n#define USUB_STYLE_POINTS 2\n"
    )


def _numbers() -> str:
    rows = [f"  USUB_INTERFACE_{f.key.upper()} = {i}" for i, f in enumerate(abi.INTERFACES)]
    rows.append(f"  USUB_INTERFACE_COUNT = {len(abi.INTERFACES)}")
    joined = ",\n".join(rows)
    about = "/** Numbers of the interfaces; FRIC_COEF has two generations. */"
    return f"{about}\nenum {{\n{joined}\n}};\n"


def _interface(face: abi.Interface) -> str:
    stem = text.constant(face)
    about = f"{face.name.upper()} ({face.solver})"
    if face.generation != abi.LEGACY:
        about += f", generation {face.generation}"
    rows = [f"  {stem}_{a.modern.upper()} = {i}" for i, a in enumerate(face.args)]
    rows.append(f"  {stem}_COUNT = {len(face.args)}")
    lines = [f"/* {about}: positions of the arguments */", "enum {", ",\n".join(rows), "};", ""]
    for real, name in text.function_types(face).items():
        lines.append(f"typedef void {name}(")
        lines += text.wrapped(text.c_parameters(face, real), 4)
        lines[-1] += ");"
    lines.append("")
    real = "usub_real" if len(face.precisions) > 1 else "double"
    lines.append(f"#define {stem}_PARAMETERS \\")
    macro = text.wrapped(text.c_parameters(face, real), 4, end=" \\")
    lines += [f"{line} \\" for line in macro[:-1]] + [macro[-1]]
    return "\n".join(lines) + "\n"
