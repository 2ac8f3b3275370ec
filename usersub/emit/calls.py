# SPDX-License-Identifier: MIT
"""Makes `csrc/driver/call.inc`: calls with the published argument list from a list of addresses."""

from __future__ import annotations

from usersub import abi
from usersub.emit import text

PATH = "csrc/driver/call.inc"


def artefacts() -> dict[str, str]:
    """One inline function for each interface and precision."""
    functions = [
        _call(face, real, name)
        for face in abi.INTERFACES
        for real, name in text.function_types(face).items()
    ]
    head = (
        "/* usub_call_<interface>_<d|f>: calls `entry` with the published argument list and the\n"
        " * hidden lengths; argv holds the addresses of the arguments in their order. */\n"
        '#include "usersub/usersub.h"\n'
    )
    return {PATH: "\n".join([text.banner(__name__) + head, *functions])}


def _call(face: abi.Interface, real: str, name: str) -> str:
    # Assigning a `void *` needs no cast in C; the length of every name is the drivers' own.
    values = [f"argv[{i}]" for i in range(len(face.args))]
    values += ["USUB_NAME_LENGTH"] * len(text.texts(face))
    head = f"usub_call_{face.key}_{real[0]}(usub_entry entry, void *const *argv)"
    lines = [
        f"static inline void {head} {{",
        f"  (({name} *)entry)(",
        *text.wrapped(values, 6),
    ]
    return "\n".join(lines) + ");\n}\n"
