# SPDX-License-Identifier: MIT
"""Reads a deck: which blocks stand where, and what belongs together."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import replace

from usersub.deck import amplitude, blocks, procedures, rules
from usersub.deck.friction import DIALECTS, SOLVERS, User
from usersub.deck.keywords import OTHER_OWNERS, SUBOPTIONS, keyword
from usersub.deck.lines import Lines
from usersub.deck.model import Change, Deck, Interaction, OtherFriction, Step
from usersub.deck.words import (
    Note,
    Parameters,
    Where,
    choose,
    entries,
    real,
    refuse,
    show,
    split,
)

_SURFACE = {
    "NAME": "name",
    "PAD THICKNESS": "real",
    "USER": "choice",
    "UNSYMM": "flag",
    "DEPVAR": "whole",
    "PROPERTIES": "whole",
    "TRACKING THICKNESS": "real",
}
_CHANGE = {"INTERACTION": "name", "ELSET": "name", "AMPLITUDE": "name", "RESET": "flag"}
_STEP = {
    "NAME": "name",
    "AMPLITUDE": "name",
    "CONVERT SDI": "name",
    "EXTRAPOLATION": "name",
    "INC": "name",
    "NLGEOM": "choice",
    "PERTURBATION": "choice",
    "SOLVER": "name",
    "UNSYMM": "name",
}
_OWNER = {"ELSET": "name"}
#: Warnings that are kept; a deck of a gigabyte may have one on every line.
_MOST = 1000


def read(
    path_or_lines: str | os.PathLike | Iterable[str] | Iterable[bytes],
    *,
    solver: str | None = None,
    dialect: str = "commercial",
) -> Deck:
    """Reads what a deck says of friction; other keywords are skipped.

    Args:
        path_or_lines: path of the deck, or its lines (a text with line ends, an open file, any
            iterable of texts or bytes); a deck of any size is read in the memory
            that its friction takes.
        solver: "standard", "explicit", or None to take it from the procedures of the steps.
        dialect: "commercial", or "calculix", where ``*FRICTION`` has a stick slope as second entry.

    Raises:
        DeckError: the deck says what the manual excludes, or is no deck; with file, line, reason.
        ValueError: `solver` or `dialect` is none of the above.
    """
    if solver is not None and solver not in SOLVERS:
        raise ValueError(f"solver = {solver!r}, expected one of {', '.join(SOLVERS)} or None")
    if dialect not in DIALECTS:
        raise ValueError(f"dialect = {dialect!r}, expected one of {', '.join(DIALECTS)}")
    with Lines(path_or_lines) as lines:
        return _Reader(lines, solver, dialect).read()


class _Reader:
    """Goes over the keywords of a deck once and collects what concerns friction."""

    def __init__(self, lines: Lines, solver: str | None, dialect: str) -> None:
        self.lines, self.given_solver, self.dialect = lines, solver, dialect
        self.solver = solver
        self.notes: list[Note] = []
        self.interactions: dict[str, Interaction] = {}
        self.changes: list[Change] = []
        self.steps: list[Step] = []
        self.others: list[OtherFriction] = []
        self.amplitudes: dict[str, amplitude.Amplitude] = {}
        self.in_step = False
        #: the interaction, change or other owner that a *FRICTION belongs to
        self.owner: Interaction | Change | tuple[str, str] | None = None
        self.owner_done = False
        self.redefined: Where | None = None

    def warn(self, note: Note) -> None:
        if len(self.notes) < _MOST:
            self.notes.append(note)

    def read(self) -> Deck:
        lines, last = self.lines, Where(self.lines.name, 0)
        before = lines.next()
        if before is not None:
            lines.push_back(before)
            if not before[0].startswith("*"):
                self.warn(Note(before[1], "the deck does not begin with a keyword"))
                lines.skip()
        while (line := lines.next()) is not None:
            text, last = line
            if not text.startswith("*"):
                lines.skip()
                continue
            self._keyword(text, last)
        self._close_owner()
        if self.in_step:
            self.warn(Note(self.steps[-1].where, "the step is not ended by *END STEP"))
        return self._finish()

    # Keywords.

    def _keyword(self, text: str, where: Where) -> None:
        name = keyword(text[1:].partition(",")[0], where)
        if name == "FRICTION":
            self._friction(self._parameters(name, text, where, rules.KINDS[self.dialect]))
            return
        if name in SUBOPTIONS:
            if isinstance(self.owner, Change):
                self._close_owner()
            self._suboption(name)
            return
        self._close_owner()
        if name == "SURFACE INTERACTION":
            self._surface(self._parameters(name, text, where, _SURFACE, strict=False))
        elif name == "CHANGE FRICTION":
            self._change(self._parameters(name, text, where, _CHANGE))
        elif name == "AMPLITUDE":
            self._amplitude(text, where)
        elif name == "STEP":
            self._step(self._parameters(name, text, where, _STEP, strict=False))
        elif name == "END STEP":
            if not self.in_step:
                self.warn(Note(where, "*END STEP without a *STEP"))
            self.in_step = False
            self.lines.skip()
        elif name in OTHER_OWNERS:
            given = self._parameters(name, text, where, _OWNER, strict=False)
            self.owner = name, given.get("ELSET", "")
            self.lines.skip()
        else:
            if self.in_step and not self.steps[-1].procedure and name in procedures.PROCEDURES:
                self._procedure(name, text, where)
            self.lines.skip()

    def _parameters(self, name, text, where, kinds, strict=True) -> Parameters:
        parts = split(self.lines.continued(text), where)[1:]
        return Parameters(name, parts, kinds, where, strict=strict)

    def _suboption(self, name: str) -> None:
        """Skips the data of an option of an interaction, in which a keyword may lack its star."""
        if not isinstance(self.owner, Interaction):
            self.lines.skip()
            return
        for text, where in self.lines.data():
            if text[0].isalpha() and "=" not in text:
                word = choose(text.partition(",")[0], ("FRICTION", "SURFACE INTERACTION"))
                if isinstance(word, str):
                    refuse(where, f"a data line of *{name} says {show(text)}; is a star missing?")

    def _surface(self, given: Parameters) -> None:
        where, name = given.where, given.get("NAME")
        if name is None:
            refuse(where, "*SURFACE INTERACTION needs the parameter NAME")
        known = self.interactions.get(name.upper())
        if known is not None and not self.in_step:
            refuse(where, f"the interaction {show(name)} is defined twice, first at {known.where}")
        if known is not None and self.solver == "standard":
            refuse(where, f"the interaction {show(name)} is defined anew in a step, which only "
                   "the explicit solver allows; use *CHANGE FRICTION")  # fmt: skip
        for word in given.unknown:
            self.warn(Note(where, f"*SURFACE INTERACTION: the parameter {word} is not read"))
        area, user = None, "USER" in given
        for count, (text, line) in enumerate(self.lines.data()):
            words = entries(text)
            if user or not words:
                continue
            if count or len(words) > 1:
                refuse(line, f"*SURFACE INTERACTION has one number, but {show(text)} is given")
            area = real(words[0], line, "the number of *SURFACE INTERACTION")
            if area < 0.0:
                refuse(line, f"the number of *SURFACE INTERACTION is {area:g}, expected 0 or more")
        if user:
            self.warn(Note(where, f"the interaction {show(name)} is a user routine as a whole"))
        self.owner = Interaction(name, None, area, user, where)
        self.redefined = where if known is not None else None

    def _change(self, given: Parameters) -> None:
        where = given.where
        if self.solver == "explicit":
            refuse(where, "*CHANGE FRICTION is for the implicit solver; the explicit one takes a "
                   "new *SURFACE INTERACTION of the same name in the step")  # fmt: skip
        if ("INTERACTION" in given) == ("ELSET" in given):
            which = "both" if "ELSET" in given else "neither"
            refuse(where, f"*CHANGE FRICTION has {which} of INTERACTION and ELSET, expected one")
        if self.dialect == "calculix" and "INTERACTION" not in given:
            refuse(where, "*CHANGE FRICTION needs INTERACTION in this dialect")
        if self.dialect == "calculix" and ("AMPLITUDE" in given or "RESET" in given):
            refuse(where, "*CHANGE FRICTION has neither AMPLITUDE nor RESET in this dialect")
        if not self.in_step:
            if self.steps:
                refuse(where, "*CHANGE FRICTION stands outside of a step")
            self.warn(Note(where, "*CHANGE FRICTION stands outside of a step; its step is unknown"))
        name = given.get("INTERACTION")
        if name is not None:
            known = self.interactions.get(name.upper())
            if known is None:
                refuse(where, f"*CHANGE FRICTION: no interaction is called {show(name)}")
            name = known.name
            if known.user or (known.friction and isinstance(known.friction.law, User)):
                refuse(where, f"*CHANGE FRICTION: the friction of {name} is a user routine, which "
                       "cannot be changed")  # fmt: skip
        step = self.steps[-1].number if self.in_step else 0
        elset = given.get("ELSET")
        for change in reversed(self.changes):
            same = (change.interaction or "", (change.elset or "").upper())
            if step and change.step == step and same == (name or "", (elset or "").upper()):
                refuse(where, f"*CHANGE FRICTION: {name or elset} is changed twice in step {step}")
            if change.step != step:
                break
        for text, line in self.lines.data():
            refuse(line, f"*CHANGE FRICTION has no data lines, but {show(text)} is given")
        reset = "RESET" in given
        self.owner = Change(step, name, elset, None, given.get("AMPLITUDE"), reset, where=where)

    def _friction(self, given: Parameters) -> None:
        where, owner = given.where, self.owner
        if owner is None:
            refuse(where, "*FRICTION follows no *SURFACE INTERACTION or *CHANGE FRICTION")
        if self.owner_done:
            refuse(where, "a second *FRICTION for the same interaction")
        if isinstance(owner, Change) and owner.reset:
            refuse(where, "*FRICTION after *CHANGE FRICTION, RESET, which takes none")
        if isinstance(owner, Interaction) and owner.user:
            refuse(where, f"*FRICTION for {show(owner.name)}, which is a user routine as a whole")
        found = blocks.friction(given, self.lines, self.dialect, self.warn)
        self.owner_done = True
        if isinstance(owner, Change):
            if isinstance(found.law, User):
                refuse(where, "*CHANGE FRICTION cannot change to a user routine")
            self.owner = replace(owner, friction=found)
        elif isinstance(owner, Interaction):
            self.owner = replace(owner, friction=found)
        else:
            if owner[0] == "CONNECTOR FRICTION":
                rules.check_connector(found, given)
                found = replace(found, connector=True)
            step = self.steps[-1].number if self.in_step else 0
            self.others.append(OtherFriction(*owner, found, step))

    def _close_owner(self) -> None:
        """Takes an interaction or change as complete."""
        owner, self.owner = self.owner, None
        if isinstance(owner, Change):
            if owner.friction is None and not owner.reset:
                refuse(owner.where, "*CHANGE FRICTION is followed by no *FRICTION")
            self.changes.append(owner)
        elif isinstance(owner, Interaction) and self.redefined is not None:
            step = self.steps[-1].number
            change = Change(step, self.interactions[owner.name.upper()].name, None, owner.friction)
            self.changes.append(replace(change, redefined=owner, where=owner.where))
        elif isinstance(owner, Interaction):
            self.interactions[owner.name.upper()] = owner
        self.owner_done, self.redefined = False, None

    def _amplitude(self, text: str, where: Where) -> None:
        given = self._parameters("AMPLITUDE", text, where, amplitude.KINDS, strict=False)
        found = amplitude.amplitude(given, self.lines.data(), where)
        self.lines.skip()
        known = self.amplitudes.get(found.name.upper())
        if known is not None:
            problem = f"{where}: it is defined twice, first at {known.where}"
            found = replace(found, problem=found.problem or problem)
        self.amplitudes[found.name.upper()] = found

    def _step(self, given: Parameters) -> None:
        where = given.where
        if self.in_step:
            refuse(where, f"*STEP in the step of {self.steps[-1].where}, which is not ended")
        default = given.get("AMPLITUDE")
        if default is not None:
            default = choose(default, ("STEP", "RAMP"))
            if not isinstance(default, str):
                word = given.get("AMPLITUDE")
                refuse(where, f"*STEP: AMPLITUDE = {show(word)}, expected STEP or RAMP")
        step = Step(len(self.steps) + 1, given.get("NAME", ""), default, "", where)
        self.steps.append(step)
        self.in_step = True
        self.lines.skip()

    def _procedure(self, name: str, text: str, where: Where) -> None:
        words = procedures.procedure(name, split(self.lines.continued(text), where)[1:])
        self.steps[-1] = replace(self.steps[-1], procedure=words)
        if self.given_solver is None:
            solver = procedures.solver(words)
            if self.solver not in (None, solver):
                refuse(where, f"*{name} is of the {solver} solver, earlier steps are not")
            self.solver = solver

    # The end.

    def _finish(self) -> Deck:
        self._check_changes()
        deck = Deck(
            path=self.lines.name,
            dialect=self.dialect,
            solver=self.solver,
            interactions=tuple(map(self._checked, self.interactions.values())),
            changes=tuple(map(self._checked, self.changes)),
            steps=tuple(self.steps),
            amplitudes=tuple(self.amplitudes.values()),
            others=tuple(map(self._checked, self.others)),
        )
        rules.check_riks(deck)
        if not deck.interactions and not deck.others:
            self.warn(Note(Where(self.lines.name, 0), "the deck defines no interaction"))
        return replace(deck, warnings=tuple(self.notes))

    def _checked(self, owner):
        """The owner with its friction, which has been checked for the solver and knows it."""
        if isinstance(owner, Change) and owner.redefined is not None:
            owner = replace(owner, redefined=self._checked(owner.redefined))
            return replace(owner, friction=owner.redefined.friction)
        if owner.friction is None:
            return owner
        rules.check_solver(owner.friction, self.solver, self.warn)
        return replace(owner, friction=replace(owner.friction, solver=self.solver))

    def _check_changes(self) -> None:
        for change in self.changes:
            if change.redefined is not None and self.solver == "standard":
                refuse(change.where, f"the interaction {show(change.redefined.name)} is defined "
                       "anew in a step, which only the explicit solver allows")  # fmt: skip
            if change.redefined is None and self.solver == "explicit":
                refuse(change.where, "*CHANGE FRICTION is for the implicit solver")
            if change.amplitude is None:
                continue
            curve = self.amplitudes.get(change.amplitude.upper())
            if curve is None:
                refuse(change.where, f"no amplitude is called {show(change.amplitude)}")
            if curve.unfit:
                refuse(change.where, f"the amplitude {curve.name} does not fit: {curve.unfit}")
            values = [value for _, value in curve.points]
            if (values[0], values[-1]) != (0.0, 1.0):
                self.warn(Note(change.where, f"the amplitude {curve.name} does not go from 0 to 1"))
