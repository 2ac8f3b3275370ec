# SPDX-License-Identifier: MIT
"""The laws that are shipped: what each takes, behind which interfaces it stands, where it lies.

Equation, symbols, limits and source of a law stand in the README of its folder.
"""

from __future__ import annotations

import difflib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from usersub import abi, paths
from usersub.errors import LoadError

if TYPE_CHECKING:
    from usersub.routine.loading import RoutineFile
    from usersub.routine.routine import Routine

__all__ = ["LANGUAGES", "LAWS", "Law", "law", "load", "path", "routine"]

#: File of a law by language.
LANGUAGES = {"python": "law.py", "c": "law.c", "fortran": "law.f90"}

#: Interfaces that can carry a shear traction that is no coefficient times pressure.
_TRACTION = ("fric", "vfric", "vfriction")


@dataclass(frozen=True)
class Prop:
    """One property: `symbol`, `unit` in words, `meaning`."""

    symbol: str
    unit: str
    meaning: str


@dataclass(frozen=True)
class Law:
    """One law.

    Attributes:
        name: name of its folder.
        equation: in one line, for people.
        props: the properties in their order.
        interfaces: the interfaces that can carry it.
        refusal: why the others cannot; "" where all can.
        states: state variables that each interface needs, in words; "" where none does.
        temperatures: whether it reads temperatures.
    """

    name: str
    equation: str
    props: tuple[Prop, ...]
    interfaces: tuple[str, ...] = abi.NAMES
    refusal: str = ""
    states: str = "FRIC: elastic slip, one variable a friction direction"
    temperatures: bool = False

    @property
    def folder(self) -> Path:
        """Folder of the law's files."""
        return paths.reference_impls() / self.name

    def check(self, interface: str) -> None:
        """Refuses an interface that cannot carry the law.

        Raises:
            LoadError: it cannot; the message says why.
        """
        if interface not in self.interfaces:
            raise LoadError(
                f"the law {self.name} does not stand behind {interface.upper()}: "
                f"{self.refusal or 'there is no such interface'}; "
                f"its interfaces are {', '.join(i.upper() for i in self.interfaces)}"
            )


_COEFFICIENT = Prop("mu", "-", "friction coefficient")
_DECAY = Prop("dc", "time/length", "decay coefficient")

_ALL = (
    Law("coulomb", "tau_crit = mu p", (_COEFFICIENT,)),
    Law(
        "exponential_decay",
        "mu = muk + (mus - muk) exp(-dc rate)",
        (
            Prop("mus", "-", "static coefficient"),
            Prop("muk", "-", "kinetic coefficient"),
            _DECAY,
        ),
    ),
    Law(
        "viscoplastic_creep",
        "rate = k tau",
        (Prop("k", "length/(time stress)", "slip rate by traction"),),
        interfaces=_TRACTION,
        refusal="a viscous traction is no coefficient times pressure",
        states="",
    ),
    Law(
        "temperature_pressure_decay",
        "mu = muk + (mus - muk) exp(-dc rate), mus = Cs T + Ds p, muk = Ck T + Dk p",
        (
            Prop("Cs", "1/temperature", "static coefficient by temperature"),
            Prop("Ds", "1/stress", "static coefficient by pressure"),
            Prop("Ck", "1/temperature", "kinetic coefficient by temperature"),
            Prop("Dk", "1/stress", "kinetic coefficient by pressure"),
            _DECAY,
        ),
        temperatures=True,
    ),
    Law(
        "coulomb_tabulated",
        "mu = table(rate, p, T), linear between points, constant outside",
        (
            Prop("nr, np, nt", "-", "numbers of slip rates, pressures, temperatures"),
            Prop("rates", "length/time", "nr ascending slip rates"),
            Prop("pressures", "stress", "np ascending pressures"),
            Prop("temperatures", "temperature", "nt ascending temperatures"),
            Prop("table", "-", "nr np nt coefficients, the slip rate running fastest"),
        ),
        temperatures=True,
    ),
)

#: The laws by name.
LAWS: dict[str, Law] = {entry.name: entry for entry in _ALL}


def law(name: str) -> Law:
    """The law called `name`.

    Raises:
        LoadError: there is none; the message names the nearest.
    """
    if name not in LAWS:
        near = difflib.get_close_matches(name, LAWS, n=1, cutoff=0.4)
        hint = f"; did you mean '{near[0]}'?" if near else "."
        raise LoadError(f"no law is called '{name}'{hint} Laws: {', '.join(LAWS)}")
    return LAWS[name]


def path(name: str, language: str) -> Path:
    """File of a law in "python", "c" or "fortran".

    Raises:
        LoadError: unknown law or language, or the file is missing.
    """
    if language not in LANGUAGES:
        raise LoadError(f"laws are shipped in {', '.join(LANGUAGES)}, not in '{language}'")
    file = law(name).folder / LANGUAGES[language]
    if not file.is_file():
        raise LoadError(f"{file} is missing: the law {name} is not installed in {language}")
    return file


@cache
def load(name: str, language: str = "python", *, precision: str = "double") -> RoutineFile:
    """The routines of a law in one language, by interface; compiled once in a process.

    Raises:
        LoadError: unknown law or language.
        MissingTool: the compiler is missing.
    """
    from usersub.routine.loading import load as load_file

    return load_file(path(name, language), precision=precision)


def routine(
    name: str, interface: str, language: str = "python", *, precision: str = "double"
) -> Routine:
    """The routine of a law behind one interface.

    Raises:
        LoadError: unknown law or language, or the interface cannot carry the law or does not exist
            in this precision.
    """
    law(name).check(interface.lower())
    precisions = abi.interface(interface).precisions
    if precision not in precisions:
        raise LoadError(
            f"law '{name}' behind {interface.upper()} has no precision '{precision}'; "
            f"expected {' or '.join(precisions)}"
        )
    return load(name, language, precision=precision)[interface.lower()]
