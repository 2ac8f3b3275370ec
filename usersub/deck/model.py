# SPDX-License-Identifier: MIT
"""What a deck says of friction: interactions, steps, changes, amplitudes."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from usersub.deck.amplitude import Amplitude
from usersub.deck.friction import Friction
from usersub.deck.words import Note, Where, written, written_name

if TYPE_CHECKING:
    from usersub import interaction
    from usersub.driver.scene import Scene

_NOWHERE = Where("deck", 0)


@dataclass(frozen=True)
class Interaction:
    """A ``*SURFACE INTERACTION``.

    Attributes:
        name: as written; names are compared without case.
        friction: its friction, or None (frictionless).
        area: number on its data line (contact area or thickness), or None.
        user: whether a user routine replaces the whole interaction.
        where: its line.
    """

    name: str
    friction: Friction | None = None
    area: float | None = None
    user: bool = False
    where: Where = field(default=_NOWHERE, compare=False)

    def contact_area(self, solver: str = "standard") -> float:
        """Contact area of each node of a node-based secondary surface: 1 unless the deck gives
        another one, and always 1 in the explicit solver."""
        return 1.0 if self.area is None or solver == "explicit" else self.area

    def __str__(self) -> str:
        lines = [f"*SURFACE INTERACTION, NAME={written_name(self.name)}" + ", USER" * self.user]
        if self.area is not None:
            lines.append(f"{written(self.area)},")
        if self.friction is not None:
            lines.append(str(self.friction))
        return "\n".join(lines)


@dataclass(frozen=True)
class OtherFriction:
    """Friction of something else than an interaction.

    Attributes:
        owner: keyword that it follows, such as "GAP" or "CONNECTOR FRICTION".
        elset: element set of the owner, or "".
        friction: the friction.
        step: number of the step in which it stands, 0 outside of steps.
    """

    owner: str
    elset: str
    friction: Friction
    step: int = 0

    def __str__(self) -> str:
        elset = f", ELSET={written_name(self.elset)}" if self.elset else ""
        return f"*{self.owner}{elset}\n{self.friction}"


@dataclass(frozen=True)
class Step:
    """A ``*STEP``.

    Attributes:
        number: from one.
        name: its name, or "".
        amplitude: default of its loads, "RAMP" or "STEP", or None if not given.
        procedure: the procedure with what tells the solver, such as "DYNAMIC, EXPLICIT", or "".
        where: its line.
    """

    number: int
    name: str = ""
    amplitude: str | None = None
    procedure: str = ""
    where: Where = field(default=_NOWHERE, compare=False)


@dataclass(frozen=True)
class Change:
    """Friction that becomes another one at a step.

    Attributes:
        step: number of the step, or 0 where the deck's part shows none.
        interaction, elset: what changes; one of them is None.
        friction: the new friction, or None (frictionless, or reset).
        amplitude: name of the time curve, or None.
        reset: whether the original friction comes back.
        redefined: the new interaction where it is defined anew (explicit), else None.
        where: its line.
    """

    step: int
    interaction: str | None = None
    elset: str | None = None
    friction: Friction | None = None
    amplitude: str | None = None
    reset: bool = False
    redefined: Interaction | None = None
    where: Where = field(default=_NOWHERE, compare=False)

    def __str__(self) -> str:
        if self.redefined is not None:
            return str(self.redefined)
        words = ["*CHANGE FRICTION"]
        words += [f"INTERACTION={written_name(self.interaction)}"] if self.interaction else []
        words += [f"ELSET={written_name(self.elset)}"] if self.elset else []
        words += [f"AMPLITUDE={written_name(self.amplitude)}"] if self.amplitude else []
        words += ["RESET"] * self.reset
        line = ", ".join(words)
        return line if self.friction is None else f"{line}\n{self.friction}"


@dataclass(frozen=True)
class Deck:
    """What a deck says of friction.

    `deck["name"]` is an interaction, iteration goes over all of them.

    Attributes:
        path: the deck.
        dialect: "commercial" or "calculix".
        solver: "standard" or "explicit", given or told by the procedures, or None.
        interactions: the interactions in their order.
        changes: the changes in their order.
        steps: the steps.
        amplitudes: the time curves.
        others: friction of connectors, gaps and interface elements.
        warnings: what a reader should know and nobody can decide.
    """

    path: str = field(default="deck", compare=False)
    dialect: str = "commercial"
    solver: str | None = None
    interactions: tuple[Interaction, ...] = ()
    changes: tuple[Change, ...] = ()
    steps: tuple[Step, ...] = ()
    amplitudes: tuple[Amplitude, ...] = ()
    others: tuple[OtherFriction, ...] = ()
    warnings: tuple[Note, ...] = field(default=(), compare=False)

    def __iter__(self) -> Iterator[Interaction]:
        return iter(self.interactions)

    def __len__(self) -> int:
        return len(self.interactions)

    def __getitem__(self, name: str) -> Interaction:
        for interaction in self.interactions:
            if interaction.name.upper() == name.upper():
                return interaction
        names = ", ".join(i.name for i in self.interactions) or "none"
        raise KeyError(f"no interaction is called '{name}'; interactions: {names}")

    def friction(self, name: str, step: int = 0) -> Friction | None:
        """Friction of an interaction at the end of a step; 0 is the model before all steps.

        Raises:
            KeyError: no interaction is called so.
        """
        interaction = self[name]
        found = interaction.friction
        for change in self.changes:
            same = (change.interaction or "").upper() == interaction.name.upper()
            if same and 0 < change.step <= step:
                found = interaction.friction if change.reset else change.friction
        return found

    def amplitude(self, name: str) -> Amplitude:
        """The time curve called `name`.

        Raises:
            KeyError: there is none.
        """
        for amplitude in self.amplitudes:
            if amplitude.name.upper() == name.upper():
                return amplitude
        raise KeyError(f"no amplitude is called '{name}'")

    def interaction(
        self,
        name: str,
        scene: Scene,
        *,
        routine: str | os.PathLike | None = None,
        language: str = "python",
        reuse: bool = False,
    ) -> interaction.Interaction:
        """The interaction as one that runs, with its changes in the steps.

        Args:
            name: of the interaction.
            scene: the host's model, without the settings of the friction.
            routine: file of a user routine, where the deck has USER.
            language: of the shipped laws.
            reuse: as of the drivers.

        Raises:
            KeyError: no interaction is called so.
            DeckError: a friction or a change of it does not run; the message says why.
        """
        from usersub.deck.stepping import interaction

        return interaction(self, name, scene, routine=routine, language=language, reuse=reuse)

    def write(self, path: str | os.PathLike | None = None) -> str:
        """The friction part of the deck as text, also written to `path` if given.

        Read again (for the same solver), it gives the same interactions, changes and steps, and
        the amplitudes that were read.
        """
        blocks: list[str] = [str(a) for a in self.amplitudes if a.points]
        blocks += map(str, self.interactions)
        blocks += [str(o) for o in self.others if not o.step]
        blocks += [str(c) for c in self.changes if not c.step]
        for step in self.steps:
            line = "*STEP"
            line += f", NAME={written_name(step.name)}" if step.name else ""
            line += f", AMPLITUDE={step.amplitude}" if step.amplitude else ""
            blocks.append(line)
            blocks += [f"*{step.procedure}"] if step.procedure else []
            blocks += [str(c) for c in self.changes if c.step == step.number]
            blocks += [str(o) for o in self.others if o.step == step.number]
            blocks.append("*END STEP")
        text = "".join(block + "\n" for block in blocks)
        if path is not None:
            Path(path).write_text(text, encoding="utf-8")
        return text
