# SPDX-License-Identifier: MIT
"""Makes `csrc/include/usersub/arguments/`: argument lists as Fortran text for the preprocessor.

For a routine in free form that does not want to write out (or get wrong) its dummy arguments:

    subroutine vfric_coef( &
    #include "usersub/arguments/vfric_coef_names.fi"
      implicit none
    #include "usersub/arguments/vfric_coef_types.fi"

Reals of the explicit routines are double precision, or single with USUB_SINGLE defined.
"""

from __future__ import annotations

from usersub import abi
from usersub.emit import text
from usersub.emit.fortran_module import modern_shape

FOLDER = "csrc/include/usersub/arguments/"


def artefacts() -> dict[str, str]:
    """Two files an interface: names up to the closing parenthesis, and declarations."""
    made = {}
    for face in abi.INTERFACES:
        made[f"{FOLDER}{face.key}_names.fi"] = _names(face)
        made[f"{FOLDER}{face.key}_types.fi"] = _types(face)
    return made


def _names(face: abi.Interface) -> str:
    lines = text.wrapped([a.modern for a in face.args], 4, end=" &")
    return text.banner(__name__, "fortran") + " &\n".join(lines) + ")\n"


def _types(face: abi.Interface) -> str:
    kinds = {"real": "double precision", "int": "integer", "char": f"character({abi.NAME_LENGTH})"}
    rule = ""
    if len(face.precisions) > 1:
        kinds["real"] = "USUB_REAL"
        rule = (
            "#ifdef USUB_SINGLE\n#define USUB_REAL real\n#else\n"
            "#define USUB_REAL double precision\n#endif\n"
        )
    # Sizes first: a dimension has to be declared before it is used.
    ordered = sorted(face.args, key=lambda a: (a.kind != "int", bool(a.shape)))
    lines = [f"  {kinds[a.kind]} :: {a.modern}{modern_shape(face, a)}\n" for a in ordered]
    end = "#undef USUB_REAL\n" if rule else ""
    return text.banner(__name__, "fortran") + rule + "".join(lines) + end
