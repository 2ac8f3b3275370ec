# SPDX-License-Identifier: MIT
"""Keywords: those that are read, those that look like them, and how they are abbreviated."""

from __future__ import annotations

from functools import lru_cache

from usersub.deck.procedures import PROCEDURES
from usersub.deck.words import Where, alternatives, refuse, show, squeeze

#: Keywords that are read, in full.
OURS = (
    "SURFACE INTERACTION",
    "FRICTION",
    "CHANGE FRICTION",
    "AMPLITUDE",
    "STEP",
    "END STEP",
    "INCLUDE",
)

#: Options of an interaction beside *FRICTION; after any other keyword the interaction is complete.
SUBOPTIONS = (
    "SURFACE BEHAVIOR",
    "CONTACT DAMPING",
    "COHESIVE BEHAVIOR",
    "DAMAGE INITIATION",
    "DAMAGE EVOLUTION",
    "DAMAGE STABILIZATION",
    "FRACTURE CRITERION",
    "FLUID LEAKOFF",
    "GAP CONDUCTANCE",
    "GAP CONVECTION",
    "GAP ELECTRICAL CONDUCTANCE",
    "GAP FLOW",
    "GAP HEAT GENERATION",
    "GAP RADIATION",
)

#: Other keywords that *FRICTION may follow.
OTHER_OWNERS = ("CONNECTOR FRICTION", "GAP", "INTERFACE", "ITS")

#: Keywords that begin like those above or look like them, so that none of them is mistaken.
_RIVALS = (
    "SURFACE",
    "SURFACE FLAW",
    "SURFACE PROPERTY ASSIGNMENT",
    "SURFACE SECTION",
    "SURFACE SMOOTHING",
    "FRACTURE",
    "FRAME SECTION",
    "FREQUENCY",
    "CFLUX",
    "CHARACTERISTIC LENGTH",
    "AMBIENT",
    "ANISOTROPIC",
    "ANNEAL",
    "STATIC",
    "STEADY STATE CRITERIA",
    "STEADY STATE DETECTION",
    "STEADY STATE DYNAMICS",
    "STEADY STATE TRANSPORT",
    "SUBSTRUCTURE GENERATE",
    "END",
    "END ASSEMBLY",
    "END INSTANCE",
    "END LOAD CASE",
    "END PART",
    "ENERGY FILE",
    "ENRICHMENT",
    "INCIDENT WAVE",
    "INCREMENTATION OUTPUT",
    "INERTIA RELIEF",
    "INITIAL CONDITIONS",
    "INSTANCE",
    "INTEGRATED OUTPUT",
    "COHESIVE SECTION",
    "COLUMN",
    "CONTACT",
    "CONNECTOR BEHAVIOR",
    "CONNECTOR SECTION",
    "DAMPING",
    "DAMAGE",
    "FLUID",
    "GAP",
    "GASKET BEHAVIOR",
    "INTEGRATION",
)

_EXACT = {squeeze(k): k for k in (*_RIVALS, *PROCEDURES, *SUBOPTIONS, *OTHER_OWNERS, *OURS)}


def keyword(word: str, where: Where) -> str:
    """Full name of the keyword `word`; one that is not known here comes back in upper case.

    Raises:
        DeckError: an abbreviation of several keywords, or a near miss of one that is read.
    """
    name, problem = _keyword(squeeze(word))
    if problem:
        refuse(where, problem)
    return name


@lru_cache(maxsize=1024)
def _keyword(wanted: str) -> tuple[str, str]:
    """Name of a keyword, and what is wrong with it or ""."""
    if not wanted:
        return wanted, "a star without a keyword"
    if wanted in _EXACT:
        return _EXACT[wanted], ""
    begun = [name for key, name in _EXACT.items() if key.startswith(wanted)]
    if len(begun) == 1:
        return begun[0], ""
    short = show(wanted)
    if any(name in OURS for name in begun):
        words = alternatives("*" + name for name in begun)
        return wanted, f"the keyword {short} may stand for {words}; write more of it"
    if not begun:
        for name in (*OURS, "SURFACE BEHAVIOR"):
            if _near(wanted, squeeze(name)):
                return wanted, f"there is no keyword {short}; did you mean *{name}?"
    return wanted, ""


def _near(word: str, name: str) -> bool:
    """Whether `word` is `name` but for a slip of the pen."""
    allowed = 1 if len(name) < 7 else 2
    if abs(len(word) - len(name)) > allowed:
        return False
    before: list[int] = []
    row = list(range(len(name) + 1))
    for i, letter in enumerate(word):
        last, row, older = row, [i + 1], before
        for j, other in enumerate(name):
            cost = min(last[j] + (letter != other), last[j + 1] + 1, row[j] + 1)
            if i and j and letter == name[j - 1] and word[i - 1] == other:
                cost = min(cost, older[j - 1] + 1)
            row.append(cost)
        before = last
    return row[-1] <= allowed
