# SPDX-License-Identifier: MIT
"""The laws that are shipped.

`usersub.laws.coulomb(mu=0.3)` is a law with its properties, which any driver takes as its routine;
`LAWS` tells of all laws, `routine` gives the routine of one behind an interface, `fit` finds the
properties that fit measured coefficients.

A law is a folder with a `law.toml`, in which it describes itself.
"""

from __future__ import annotations

import importlib
from typing import Any

from usersub.laws.decay_data import exponential_decay_from_test_data
from usersub.laws.description import Law
from usersub.laws.law_object import LawObject
from usersub.laws.parts import Prop
from usersub.laws.registry import LANGUAGES, LAWS, law, load, path, routine

__all__ = [
    "LANGUAGES",
    "LAWS",
    "Law",
    "LawObject",
    "Prop",
    "exponential_decay_from_test_data",
    "fit",
    "law",
    "load",
    "path",
    "routine",
]


def __getattr__(name: str) -> Any:
    if name == "fit":
        value = importlib.import_module("usersub.laws.fitting").fit
        globals()[name] = value
        return value
    if not name.startswith("_") and name in LAWS:
        return LAWS[name]
    raise AttributeError(f"module 'usersub.laws' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__, *LAWS})
