# SPDX-License-Identifier: MIT
"""From statuses of the C core to exceptions."""

from __future__ import annotations

from usersub import errors
from usersub.statuses import STATUSES

_CLASSES = {
    "LOAD_FAILED": errors.LoadError,
    "ABI_MISMATCH": errors.AbiError,
    "NO_MEMORY": errors.Error,
    "ROUTINE_RAISED": errors.RoutineError,
    "ROUTINE_STOPPED": errors.RoutineError,
    "ROUTINE_CRASHED": errors.RoutineError,
    "NOT_FINITE": errors.RoutineError,
    "CONTRACT": errors.ContractError,
    "BAD_STATE": errors.StateError,
}

#: Every other failure is the host's: a wrong setting, array or call.
_BY_VALUE = {s.value: _CLASSES.get(s.name, errors.SceneError) for s in STATUSES if s.value < 0}

VALUES = {s.name: s.value for s in STATUSES}


def exception(status: int, message: str, point: int = -1) -> errors.Error:
    """The exception of a negative `status` with the core's `message` and contact point."""
    raised = _BY_VALUE.get(status, errors.Error)(message or f"status {status}")
    raised.status = status
    if isinstance(raised, errors.RoutineError) and point >= 0:
        raised.point = point
    return raised
