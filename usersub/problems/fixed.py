# SPDX-License-Identifier: MIT
"""Iterations of hosts with fixed increments, which cannot give a routine a shorter one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from usersub.errors import RoutineError

if TYPE_CHECKING:
    from usersub.driver.standard import StandardDriver, StandardResponse


def iterate(driver: StandardDriver) -> StandardResponse:
    """One iteration of `driver`.

    Raises:
        RoutineError: the routine failed, or asks for a shorter increment (PNEWDT below 1).
    """
    response = driver.iterate()
    if response.cut_back:
        raise RoutineError(
            f"the routine asks for a shorter increment (PNEWDT = {response.pnewdt:g}), but the "
            "increments of this problem are fixed"
        )
    return response
