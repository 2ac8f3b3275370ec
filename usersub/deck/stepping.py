# SPDX-License-Identifier: MIT
"""An interaction of a deck, with its changes, as one that runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from usersub.deck import procedures
from usersub.deck.words import refuse

if TYPE_CHECKING:
    from usersub import interaction as running
    from usersub.deck.model import Change, Deck, Interaction
    from usersub.driver.scene import Scene


def interaction(
    deck: Deck, name: str, scene: Scene, *, routine: Any, language: str, reuse: bool
) -> running.Interaction:
    """As `Deck.interaction`."""
    from usersub.interaction import Interaction as Running

    found = deck[name]
    if found.user:
        refuse(found.where, f"a user routine replaces the whole interaction '{found.name}'")
    changes = {
        change.step: _change(deck, found, change, language)
        for change in deck.changes
        if change.step and (change.interaction or "").upper() == found.name.upper()
    }
    friction = found.friction
    return Running(
        None if friction is None else friction.acting(routine, language=language),
        scene,
        solver=deck.solver or "standard",
        changes=changes,
        ramps={step.number: ramps(step) for step in deck.steps},
        reuse=reuse,
    )


def ramps(step: Any) -> bool:
    """Whether loads without an amplitude are ramped over a step."""
    if step.amplitude is not None:
        return step.amplitude == "RAMP"
    return procedures.ramps(step.procedure)


def _change(deck: Deck, found: Interaction, change: Change, language: str) -> running.Change:
    from usersub.interaction import Change as Running

    curve = None
    if change.amplitude is not None:
        try:
            curve = deck.amplitude(change.amplitude).curve()
        except KeyError as error:
            refuse(change.where, str(error.args[0]))
    if change.reset:
        return Running(reset=True, amplitude=curve)
    friction = change.friction
    return Running(
        None if friction is None else friction.acting(language=language), amplitude=curve
    )
