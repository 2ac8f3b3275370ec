# SPDX-License-Identifier: MIT
"""Status codes: what a call of the C core says, what its outputs are worth, how to go on.

The numbers are fixed for ever. Zero is success, a positive number asks the host to do something
and leaves valid outputs, a negative number means that the driver's state is as before the call.
Generated from here: `csrc/include/usersub/status.h`, the Fortran module, the documentation.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Status:
    """One status code: `name`, fixed `value`, `text`, worth of the `outputs`, what to do `next`."""

    name: str
    value: int
    text: str
    outputs: str
    next: str


_NONE = "not defined"
_MEND = "mend the call; nothing has changed"
_ROUTINE = "mend the routine, or cut back; nothing has changed"

STATUSES: tuple[Status, ...] = (
    Status("OK", 0, "success", "valid", "go on"),
    Status(
        "CUT_BACK",
        1,
        "a routine asks for a smaller time increment",
        "valid",
        "cut back and try PNEWDT times the increment",
    ),
    Status("BAD_ARGUMENT", -1, "an argument of the call is wrong", _NONE, _MEND),
    Status("MISSING_ARRAY", -2, "an array that is needed is not bound", _NONE, _MEND),
    Status("BAD_INPUT", -3, "an input array holds a value that is refused", _NONE, _MEND),
    Status("WRONG_ORDER", -4, "the call does not fit here in the order of calls", _NONE, _MEND),
    Status("NO_MEMORY", -5, "memory is exhausted", _NONE, "free memory or give up"),
    Status("LOAD_FAILED", -6, "a library or symbol cannot be loaded", _NONE, _MEND),
    Status("ABI_MISMATCH", -7, "two parts were built from different tables", _NONE, "rebuild"),
    Status("NOT_SUPPORTED", -8, "the scene asks for what the interface cannot do", _NONE, _MEND),
    Status("ROUTINE_RAISED", -9, "the routine raised an exception", _NONE, _ROUTINE),
    Status("ROUTINE_STOPPED", -10, "the routine asked to end the analysis", _NONE, _ROUTINE),
    Status("ROUTINE_CRASHED", -11, "the routine was stopped by a signal", _NONE, _ROUTINE),
    Status("NOT_FINITE", -12, "the routine returned NaN or infinity", _NONE, _ROUTINE),
    Status("CONTRACT", -13, "the routine broke the rules of its interface", _NONE, _ROUTINE),
    Status("BAD_STATE", -14, "saved state does not fit", _NONE, _MEND),
)
