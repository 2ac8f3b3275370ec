# SPDX-License-Identifier: MIT
"""What the matrix is run over: laws behind interfaces, enforcement of drivers, a user's routine."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from usersub import abi
from usersub.study.stability import bounds

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

LANGUAGES = ("python", "c", "fortran")
PRECISIONS = ("double", "single")
STANDARD = ("fric", "fric_coef")


@dataclass(frozen=True)
class Scales:
    """Ordinary sizes: a slip that slides, the rate at which the law lives, a pressure, a
    temperature. Slip over rate is the characteristic time."""

    slip: float = 1.0
    rate: float = 1.0
    load: float = 100.0
    temperature: float = 20.0

    @property
    def time(self) -> float:
        """Characteristic time."""
        return self.slip / self.rate


@dataclass(frozen=True)
class Subject:
    """A routine with its properties in a scene.

    Attributes:
        name: law, "driver: " and enforcement, or the user's routine.
        make: gives the routine.
        scales: ordinary sizes.
        settings: settings of the scene besides those that all have.
        law: name of the shipped law, "" for a user's routine.
        parameters: properties by name, for the cases that change them.
        bound: largest stress at a pressure, None where none is known.
        follows: whether the stress follows a falling bound at once.
        closed: whether host and driver together are a mechanical system, with a balance of energy.
        checked: whether to run it in guarded memory, with a limit on its time.
    """

    name: str
    interface: str
    language: str
    precision: str
    make: Callable[[], Routine]
    scales: Scales = Scales()
    props: tuple[float, ...] = ()
    states: int = 0
    settings: Mapping[str, Any] = field(default_factory=dict)
    law: str = ""
    parameters: Mapping[str, object] = field(default_factory=dict)
    bound: Callable[[float], float] | None = None
    follows: bool = True
    closed: bool = True
    temperatures: int = 0
    checked: bool = False

    @property
    def standard(self) -> bool:
        """Whether the standard driver takes it."""
        return self.interface in STANDARD

    def but(self, **changes: Any) -> Subject:
        """A copy with changes."""
        return replace(self, **changes)


#: Ordinary sizes of the shipped laws: where the law changes, not where it is flat.
_SCALES: dict[str, Scales] = {
    "exponential_decay": Scales(slip=1.0, rate=100.0),
    "coulomb_tabulated": Scales(slip=1.0, rate=100.0),
    "anisotropic_tabulated": Scales(slip=1.0, rate=100.0),
    "temperature_pressure_decay": Scales(slip=1.0, rate=50.0, temperature=200.0),
    "temperature_softening": Scales(temperature=600.0),
    "stribeck": Scales(slip=1e-3, rate=1e-2),
    "dahl": Scales(slip=1e-3),
    "iwan": Scales(slip=1e-3),
    "softened": Scales(slip=1e-3),
    "softened_rough": Scales(slip=1e-3),
    "lugre": Scales(slip=1e-3, rate=1e-2),
    "elasto_plastic": Scales(slip=1e-3, rate=1e-2),
    "maxwell_slip": Scales(slip=1e-3, rate=1e-2),
    "norton_hoff": Scales(slip=1e-3, rate=1e-3),
    "rate_state_ageing": Scales(slip=1e-5, rate=1e-6),
    "rate_state_regularised": Scales(slip=1e-5, rate=1e-6),
    "rate_state_slip": Scales(slip=1e-5, rate=1e-6),
    "rate_state_strong_weakening": Scales(slip=0.4, rate=0.1),
    "slip_weakening": Scales(slip=0.1),
    "slip_weakening_exponential": Scales(slip=0.1),
}


def of_law(name: str, interface: str, language: str, precision: str) -> Subject:
    """A shipped law behind an interface, with the properties of its example.

    Raises:
        LoadError: the interface cannot carry it.
    """
    from usersub import laws

    law = laws.law(name)
    law.check(interface)
    made = law(**law.example)
    return Subject(
        name=name,
        interface=interface,
        language=language,
        precision=precision,
        make=lambda: laws.routine(name, interface, language, precision=precision),
        scales=_SCALES.get(name, Scales()),
        props=made.props,
        states=made.states(interface),
        settings={"anisotropic": 1} if law.anisotropic and interface == "fric_coef" else {},
        law=name,
        parameters=dict(made.values),
        bound=bounds.of(name, made.values),
        follows=name not in bounds.LAGGING,
        temperatures=1,
    )


def with_parameter(subject: Subject, name: str, value: object) -> Subject:
    """The same law with another property; its bound follows.

    Raises:
        SceneError: the law refuses it.
    """
    from usersub import laws

    made = laws.law(subject.law)(**{**subject.parameters, name: value})  # type: ignore[arg-type]
    bound = None if subject.bound is None else bounds.of(subject.law, made.values)
    limit = float(subject.settings.get("shear_limit", 0.0)) or math.inf
    return subject.but(
        props=made.props,
        states=made.states(subject.interface),
        parameters=dict(made.values),
        bound=_limited(bound, limit, 0.0),
    )


def of_laws(
    names: Sequence[str] | None, languages: Sequence[str], precisions: Sequence[str]
) -> Iterator[Subject]:
    """All shipped laws (or those named) behind all interfaces that carry them."""
    from usersub import laws

    for name in laws.LAWS if names is None else names:
        for interface in laws.law(name).interfaces:
            for language in languages:
                for precision in abi.interface(interface).precisions:
                    if precision in precisions:
                        yield of_law(name, interface, language, precision)


#: Enforcement by the drivers: name, interface, law, settings, by the slip.
_DRIVERS: tuple[tuple[str, str, str, dict[str, float | int | str]], ...] = (
    ("penalty", "fric_coef", "coulomb", {}),
    ("penalty, two coefficients", "fric_coef", "anisotropic", {"anisotropic": 1}),
    ("penalty, of the rate", "fric_coef", "exponential_decay", {}),
    ("penalty, shear limit", "fric_coef", "coulomb", {"shear_limit": 20.0}),
    ("penalty, damping", "fric_coef", "coulomb", {"damping": 0.1}),
    ("slope", "fric_coef", "coulomb", {"stick_slope": 300.0}),
    ("slope, two coefficients", "fric_coef", "anisotropic",
     {"stick_slope": 300.0, "anisotropic": 1}),
    ("slope, of the rate", "fric_coef", "exponential_decay", {"stick_slope": 300.0}),
    ("changing", "fric_coef", "coulomb", {"changing": 1}),
    ("lagrange", "fric_coef", "coulomb", {"enforcement": "lagrange"}),
    ("lagrange, two coefficients", "fric_coef", "anisotropic",
     {"enforcement": "lagrange", "anisotropic": 1}),
    ("kinematic", "vfric_coef", "coulomb", {"enforcement": "kinematic"}),
    ("kinematic, of the rate", "vfric_coef", "exponential_decay", {"enforcement": "kinematic"}),
    ("kinematic, force", "vfriction", "coulomb", {"enforcement": "kinematic"}),
    ("kinematic, force by node", "vfric", "coulomb", {"enforcement": "kinematic"}),
    ("penalty", "vfric_coef", "coulomb", {"enforcement": "penalty", "stick_slope": 300.0}),
    ("penalty, of the rate", "vfric_coef", "exponential_decay",
     {"enforcement": "penalty", "stick_slope": 300.0}),
    ("penalty, shear limit", "vfric_coef", "coulomb",
     {"enforcement": "penalty", "stick_slope": 300.0, "shear_limit": 20.0}),
    ("penalty, damping", "vfric_coef", "coulomb",
     {"enforcement": "penalty", "stick_slope": 300.0, "damping": 0.1}),
    ("penalty, force", "vfriction", "coulomb", {"enforcement": "penalty", "stick_slope": 300.0}),
    ("penalty, force by node", "vfric", "coulomb",
     {"enforcement": "penalty", "stick_slope": 300.0}),
)  # fmt: skip


def of_drivers(languages: Sequence[str], precisions: Sequence[str]) -> Iterator[Subject]:
    """Ways of enforcement, each with a law in every language."""
    for name, interface, law, settings in _DRIVERS:
        for language in languages:
            for precision in abi.interface(interface).precisions:
                if precision not in precisions:
                    continue
                subject = of_law(law, interface, language, precision)
                limit = float(settings.get("shear_limit", 0.0)) or math.inf
                yield subject.but(
                    name=f"driver: {name}",
                    settings={**subject.settings, **settings},
                    bound=_limited(subject.bound, limit, float(settings.get("damping", 0.0))),
                    closed=settings.get("enforcement") != "lagrange",
                )


def _limited(
    bound: Callable[[float], float] | None, limit: float, damping: float
) -> Callable[[float], float] | None:
    """The bound with a shear limit; with damping there is none, the viscous part grows."""
    if bound is None or damping:
        return None
    return lambda load: min(bound(load), limit)


def of_routine(
    routine: Routine,
    props: Sequence[float] = (),
    states: int = 0,
    precisions: Sequence[str] = PRECISIONS,
    scales: Scales = Scales(),  # noqa: B008 - immutable
) -> Iterator[Subject]:
    """A user's routine, guarded against faults and endless loops."""
    for precision in routine.interface.precisions:
        if precision in precisions:
            yield Subject(
                name=routine.name,
                interface=routine.interface.name,
                language=routine.language,
                precision=precision,
                make=lambda: routine,
                scales=scales,
                props=tuple(float(p) for p in props),
                states=states,
                temperatures=1,
                checked=True,
            )
