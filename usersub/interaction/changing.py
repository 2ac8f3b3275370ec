# SPDX-License-Identifier: MIT
"""How friction changes in a step of an implicit analysis: the rules.

    value = start + amplitude (end - start)

holds for the coefficient and for the allowable elastic slip. `end` is the new friction's answer to
the slip rate, pressure, temperature of now; `start` is what acted at the end of the step before,
zero in the first step. Everything else is new at once, at the start of the step.
"""

from __future__ import annotations

from dataclasses import dataclass

from usersub.errors import SceneError
from usersub.interaction.amplitude import Amplitude
from usersub.interaction.friction import METHOD, Friction

#: Values of the scene setting `changing`.
AT_ONCE, GRADUAL, COEFFICIENT_ONLY = 0, 1, 2

#: Settings that stay when friction is removed.
_KEPT = ("elastic_slip", "enforcement", "slip_tolerance", "stick_slope")


@dataclass(frozen=True)
class Change:
    """A change of friction in a step: add, modify (a new friction), remove (None), reset.

    Attributes:
        friction: the new friction, or None to remove it.
        amplitude: the curve of the change, or None: as the step ramps or steps its loads.
        reset: whether the original friction comes back; then there is no new one.
    """

    friction: Friction | None = None
    amplitude: Amplitude | None = None
    reset: bool = False

    def __post_init__(self) -> None:
        if self.reset and self.friction is not None:
            raise SceneError("a change of friction resets it, but also gives a new friction")

    def target(self, original: Friction, now: Friction) -> Friction:
        """The friction at the end. Without friction, sticking is enforced as now: the host has the
        arrays of that method."""
        if self.reset:
            return original
        if self.friction is not None:
            return self.friction
        return Friction(**{key: now.settings[key] for key in _KEPT if key in now.settings})


def check(old: Friction, new: Friction) -> None:
    """Refuses what cannot be changed.

    Raises:
        SceneError: a law of the user's is involved.
    """
    for friction, when in ((old, "before"), (new, "after")):
        if friction.of_user:
            name = getattr(friction.law, "name", type(friction.law).__name__)
            raise SceneError(
                f"friction of a user routine cannot change in a step, and '{name}' acts {when} the "
                "change; expected a shipped law, such as usersub.laws.coulomb(mu=0.3)"
            )


def manner(old: Friction, new: Friction, *, first: bool, at_once: bool) -> int:
    """How the change is made: a value of the scene setting `changing`.

    Args:
        first: whether it is the first general step.
        at_once: whether the amplitude is one from the start.
    """
    if at_once or old.rough or new.rough:
        return AT_ONCE
    decays = getattr(new.law, "name", "") == "exponential_decay"
    return COEFFICIENT_ONLY if first or decays or not _same_method(old, new) else GRADUAL


def _same_method(old: Friction, new: Friction) -> bool:
    return all(old.settings.get(key) == new.settings.get(key) for key in METHOD)
