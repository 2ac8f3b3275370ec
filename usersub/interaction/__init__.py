# SPDX-License-Identifier: MIT
"""Interactions over the steps of an analysis: friction that is added, modified, removed, reset."""

from usersub.interaction.amplitude import Amplitude
from usersub.interaction.changing import Change
from usersub.interaction.friction import Friction
from usersub.interaction.interaction import Interaction

__all__ = ["Amplitude", "Change", "Friction", "Interaction"]
