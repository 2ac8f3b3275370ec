# SPDX-License-Identifier: MIT
"""Where the routines of the problems come from: the shipped laws, and files in `routines/` with
laws that serve one problem only."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from usersub import laws
from usersub.errors import SceneError
from usersub.problems.choose import one_of

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

_SUFFIXES = {"python": ".py", "c": ".c", "fortran": ".f90"}

#: Laws of single problems, and where they stand.
OWN = {
    "orthotropic": ("fric",),
    "dahl_theta": ("fric", "vfric", "vfriction"),
    "ageing_theta": ("fric", "fric_coef", "vfric", "vfriction"),
}

_THETA_RULE = {"explicit Euler": 0.0, "trapezoidal rule": 0.5, "implicit Euler": 1.0}

#: Other updates of a law's state than its own, which is exact: by law, the routine that has them,
#: and the property that it takes besides for each.
UPDATES = {
    "dahl": ("dahl_theta", _THETA_RULE),
    "rate_state_ageing": ("ageing_theta", _THETA_RULE),
}


def carries(law: str, interface: str) -> bool:
    """Whether `law` has a routine behind `interface`."""
    return interface in (OWN[law] if law in OWN else laws.LAWS[law].interfaces)


def updated(law: str, update: str) -> str:
    """Name of the law whose routine has another update of the state; "" is the law's own.

    Raises:
        SceneError: the law has no such update.
    """
    if not update:
        return law
    name, updates = UPDATES.get(law, ("", {}))
    one_of("update", [update], updates, f"law {law}")
    return name


def check_steps(problem: str, law: str, steps: int | None, update: str) -> None:
    """Whether a problem can run so many increments, with this update of the state ("" for none).

    Raises:
        SceneError: less than one increment, or the law has no such update.
    """
    if steps is not None and steps < 1:
        raise SceneError(f"problem {problem}: steps is {steps}, expected 1 or more")
    updated(law, update)


def path(law: str, language: str) -> Path:
    """File of a law of one problem."""
    return Path(__file__).with_name("routines") / f"{law}{_SUFFIXES[language]}"


def routine(law: str, interface: str, language: str, precision: str = "double") -> Routine:
    """The routine of a law.

    Raises:
        SceneError, LoadError: the law does not stand behind the interface.
        MissingTool: the compiler of the language is missing.
    """
    if law not in OWN:
        return laws.routine(law, interface, language, precision=precision)
    from usersub.routine.loading import load

    one_of("interface", [interface], OWN[law], f"law {law}")
    return load(path(law, language), precision=precision)[interface]
