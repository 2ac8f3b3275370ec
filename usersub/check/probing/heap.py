# SPDX-License-Identifier: MIT
"""The guarded heap of the C core, for routines that are compiled again to use it."""

from __future__ import annotations

import ctypes
import re
from functools import cache

from usersub import paths

#: Functions that code under check calls, and what it calls instead.
RENAMED = {
    "malloc": "usub_guarded_malloc",
    "calloc": "usub_guarded_calloc",
    "realloc": "usub_guarded_realloc",
    "free": "usub_guarded_free",
    "_Znwm": "usub_guarded_malloc",
    "_Znam": "usub_guarded_malloc",
    "_ZdlPv": "usub_guarded_free",
    "_ZdaPv": "usub_guarded_free",
    "_ZdlPvm": "usub_guarded_free",
    "_ZdaPvm": "usub_guarded_free",
}

_ADDRESS = re.compile(r"memory fault at address 0x([0-9a-f]+)")
_SAID = re.compile(
    r"(memory that is freed twice|a block of \d+ bytes of its own memory that .*?end)"
)
_LENGTH = 200


@cache
def _core() -> ctypes.CDLL:
    core = ctypes.CDLL(str(paths.library_path()))
    core.usub_guarded_live.restype = ctypes.c_int64
    core.usub_guarded_explain.argtypes = (ctypes.c_uint64, ctypes.c_char_p, ctypes.c_size_t)
    return core


def live() -> int:
    """Blocks that are allocated and not freed."""
    return int(_core().usub_guarded_live())


def explain(failure: str) -> str:
    """What a failure of a routine has to do with its heap, one sentence; "" if nothing."""
    if said := _SAID.search(failure):
        return f"the routine ended with {said[1]}"
    fault = _ADDRESS.search(failure)
    address = int(fault[1], 16) if fault else 0
    text = ctypes.create_string_buffer(_LENGTH)
    if failure and not address:
        return ""
    if not _core().usub_guarded_explain(address, text, _LENGTH):
        return ""
    place = text.value.decode()
    verb = "touches memory" if address else "writes"
    return f"the routine {verb} {place} that it allocated"
