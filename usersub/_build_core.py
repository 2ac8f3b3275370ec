# SPDX-License-Identifier: MIT
"""Writes the C source of `usersub._core`: `python -m usersub._build_core OUT`, called by CMake."""

from __future__ import annotations

import sys


def main(output: str) -> None:
    """Writes the cffi (API mode) binding of libusersub to the file `output`."""
    import cffi

    from usersub.emit.cdef import cdef_text

    ffi = cffi.FFI()
    ffi.cdef(cdef_text())
    ffi.set_source("usersub._core", "#include <usersub/usersub.h>")
    ffi.emit_c_code(output)


if __name__ == "__main__":
    main(sys.argv[1])
