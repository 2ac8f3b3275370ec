# SPDX-License-Identifier: MIT
"""Writes the C source of `usersub._core`: `python build_core.py OUTPUT`, called by CMake."""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def main(output: str) -> None:
    """Writes the cffi (API mode) binding of libusersub to the file `output`."""
    # The tables of this source tree: the hook of an editable installation that is in the
    # environment would answer with those of another one.
    sys.meta_path[:] = [finder for finder in sys.meta_path if isinstance(finder, type)]
    sys.path.insert(0, str(ROOT))
    import cffi

    from usersub.emit.cdef import cdef_text

    ffi = cffi.FFI()
    ffi.cdef(cdef_text())
    ffi.set_source("usersub._core", "#include <usersub/usersub.h>")
    ffi.emit_c_code(output)


if __name__ == "__main__":
    main(sys.argv[1])
