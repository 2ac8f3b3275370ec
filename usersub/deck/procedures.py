# SPDX-License-Identifier: MIT
"""Procedures of steps: the solver that they tell, and whether they ramp changes."""

from __future__ import annotations

from usersub.deck.words import choose, squeeze

#: Procedures in which contact may stand, and those of their parameters that are kept.
PROCEDURES = {
    "STATIC": ("RIKS",),
    "DYNAMIC": ("EXPLICIT", "APPLICATION=QUASI-STATIC"),
    "DYNAMIC TEMPERATURE-DISPLACEMENT": ("EXPLICIT",),
    "VISCO": (),
    "COUPLED TEMPERATURE-DISPLACEMENT": ("STEADY STATE",),
    "COUPLED THERMAL-ELECTRICAL": ("STEADY STATE", "STRUCTURAL"),
    "STEADY STATE TRANSPORT": (),
    "SOILS": ("CONSOLIDATION",),
    "GEOSTATIC": (),
    "DIRECT CYCLIC": (),
}

#: Transient ones: without an amplitude they make changes at once.
_AT_ONCE = (
    "DYNAMIC",
    "DYNAMIC TEMPERATURE-DISPLACEMENT",
    "VISCO",
    "COUPLED TEMPERATURE-DISPLACEMENT",
    "COUPLED THERMAL-ELECTRICAL",
    "SOILS, CONSOLIDATION",
    "DIRECT CYCLIC",
)
#: Parameters that make a transient procedure one that ramps.
_RAMP = ("STEADY STATE", "APPLICATION=QUASI-STATIC")


def procedure(name: str, parts: list[str]) -> str:
    """A procedure with the parameters that are kept; `parts` stand on its line."""
    kept = []
    for part in parts:
        for known in PROCEDURES[name]:
            key, _, value = known.partition("=")
            word, _, given = part.partition("=")
            if choose(word, (key,)) == key and (not value or squeeze(given) == squeeze(value)):
                kept.append(known)
    return ", ".join([name, *kept])


def solver(words: str) -> str:
    """The solver of a procedure as `procedure` gives it."""
    return "explicit" if "EXPLICIT" in _parameters(words) else "standard"


def is_riks(words: str) -> bool:
    """Whether it is a static Riks procedure, which has no velocity."""
    return "RIKS" in _parameters(words)


def ramps(words: str) -> bool:
    """Whether changes without an amplitude are ramped over a step of the procedure."""
    if any(word in _RAMP for word in _parameters(words)):
        return True
    name = words.partition(",")[0]
    return name not in _AT_ONCE and words not in _AT_ONCE


def _parameters(words: str) -> list[str]:
    return [word.strip() for word in words.split(",")[1:]]
