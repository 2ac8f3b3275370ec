# SPDX-License-Identifier: MIT
"""A subject: a routine with the properties, sizes and scales at which it is checked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from usersub.errors import Error

if TYPE_CHECKING:
    from usersub import abi
    from usersub.check.case import Case
    from usersub.check.respond import Answer
    from usersub.check.running.begin import Beginning
    from usersub.routine.loading import RoutineFile
    from usersub.routine.routine import Routine


@dataclass(frozen=True)
class Scales:
    """Sizes at which the routine shows what it does.

    Attributes:
        slip: motion of an increment that certainly slips (length).
        stick: motion of an increment that stays within elastic stick; 0 where there is none.
        load: pressure, or normal force (VFRIC, VFRICTION).
        dt: time increment.
        temperature: of both surfaces.
        fields: values of the field variables.
    """

    slip: float = 1e-2
    stick: float = 0.0
    load: float = 1.0
    dt: float = 0.25
    temperature: float = 20.0
    fields: tuple[float, ...] = ()


@dataclass(frozen=True)
class Around:
    """What a routine is told of its place in the model, by which it may branch.

    Attributes:
        names: of the interaction, the secondary and the main surface.
        step_numbers: number of the analysis step of the first increment, and of the others.
    """

    names: tuple[str, str, str] = ("CHECKED", "", "")
    step_numbers: tuple[int, int] = (1, 1)


@dataclass(frozen=True)
class Subject:
    """What is checked.

    Attributes:
        name: file or function name, for people.
        interface: the interface in the generation of the routine.
        precision: "double" or "single".
        routine: the routine; None if it could not be made (then `failure` says why).
        failure: why there is no routine.
        path: the file, or None for a routine that was not loaded from one.
        file: the loaded file, or None.
        props: properties.
        states, fields: numbers of state and field variables.
        temperatures: whether the scenes have temperatures.
        anisotropic: whether FRIC_COEF sets both coefficients.
        scales: sizes at which cases are made.
        around: names and step numbers that the routine is told.
        others: further ones at which it does something else, to be looked at as well.
        law: name of the built-in law that it claims to be, or "".
        beginning: what is there before the first contact, once that was found out.
        origin: how each of these values was found, by name, for the head of the report.
    """

    name: str
    interface: abi.Interface
    precision: str = "double"
    routine: Routine | None = field(default=None, repr=False)
    failure: Error | None = field(default=None, repr=False)
    path: Path | None = None
    file: RoutineFile | None = field(default=None, repr=False)
    props: tuple[float, ...] = ()
    states: int = 0
    fields: int = 0
    temperatures: bool = True
    anisotropic: bool = False
    scales: Scales = Scales()
    around: Around = Around()
    others: tuple[Around, ...] = ()
    law: str = ""
    origin: dict[str, str] = field(default_factory=dict, repr=False)
    beginning: Beginning | None = field(default=None, repr=False, compare=False)
    tell: Callable[[Case], None] | None = field(default=None, repr=False, compare=False)

    def but(self, **changes: Any) -> Subject:
        """The same subject but for the attributes given."""
        return replace(self, **changes)

    def under_way(self, case: Case) -> None:
        """Notes which case is looked at, so that a crash can be told with its case."""
        if self.tell is not None:
            self.tell(self.placed(case))

    def placed(self, case: Case) -> Case:
        """The case with the names and step numbers of the subject, where they are not the ordinary
        ones and the case has none of its own."""
        around = self.around
        if around == Around() or case.names is not None:
            return case
        return case.but(names=around.names, step_numbers=around.step_numbers)

    def at(self, case: Case) -> Subject:
        """The subject with the names and step numbers of a case, where it has any."""
        if case.names is None or case.step_numbers is None:
            return self
        return self.but(around=Around(case.names, case.step_numbers))

    def respond(self, case: Case, **options: Any) -> list[Answer]:
        """What the routine answers, one `Answer` a step (`usersub.check.respond.respond`)."""
        from usersub.check.respond import respond

        return respond(self, case, **options)
