# SPDX-License-Identifier: MIT
"""One thread at a time in a driver."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any


def alone(method: Callable) -> Callable:
    """Refuses a call of a driver's method while another thread is in one: they share memory."""

    @functools.wraps(method)
    def call(self: Any, *arguments: Any, **named: Any) -> Any:
        self._enter()
        try:
            return method(self, *arguments, **named)
        finally:
            self._lock.release()

    return call
