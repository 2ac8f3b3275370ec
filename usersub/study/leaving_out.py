# SPDX-License-Identifier: MIT
"""What is saved by leaving out what routine and scene do not need: time, bytes and memory.

Three drivers of one routine are called in turns, for every interface and every kind of scene:

- *needed*: the scene with its plan;
- *full*: the same scene with every argument passed, read or not (scene setting
  `pass_everything`): what the plan saves by knowing the routine;
- *general*: a scene that has everything, with every argument passed: what a host pays that treats
  each of its models as the largest.

Every row is also run with the left-out arguments in pages that can neither be read nor written.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from usersub.driver import costs
from usersub.errors import Error
from usersub.study.allocated import growth
from usersub.study.host_arrays import host_arrays

if TYPE_CHECKING:
    from usersub.driver.base import Driver
    from usersub.driver.law import LawLike
    from usersub.driver.scene import Scene
    from usersub.routine.routine import Routine

POINTS = 10_000
#: Contact points of the run with inaccessible pages, which is slow.
_CHECKED_POINTS = 48

INTERFACES = ("fric", "fric_coef", "vfric", "vfriction", "vfric_coef")
_STANDARD = ("fric", "fric_coef")

#: Kinds of scenes: what they have not, and the interfaces that can tell the difference.
_KINDS: dict[str, tuple[dict[str, object], tuple[str, ...]]] = {
    "general": ({}, INTERFACES),
    "two-dimensional": ({"dimension": 2}, ("fric", "fric_coef", "vfric", "vfric_coef")),
    "isothermal": ({"temperatures": 0, "fields": 0}, INTERFACES),
    "stateless": ({"states": 0}, ("fric", "fric_coef", "vfric", "vfriction")),
    "derivative-free": ({"tangent": 0, "temperature_tangent": 0}, _STANDARD),
    "node-to-facet": ({"contact": "node-to-facet"}, ("vfriction", "vfric_coef")),
}
#: Nothing of all this.
LEAST = "least"
#: Patches of the general scene are open, half of its points, and left out of the calls.
HALF_OPEN = "half open"
KINDS = (*_KINDS, LEAST, HALF_OPEN)
_PATCH = 32


@dataclass(frozen=True)
class Saving:
    """What one routine costs in one kind of scene, per contact point.

    Attributes:
        interface, language, routine: what was run.
        scene: kind of scene, one of `KINDS`.
        points: contact points of the drivers.
        ns_needed, ns_full, ns_general: nanoseconds with the plan, with everything passed, and with
            everything passed in the general scene.
        bytes_needed, bytes_full, bytes_general: bytes of arguments, likewise.
        memory_needed, memory_full, memory_general: bytes that the driver has allocated, likewise;
            nan where the C library does not tell.
        left_out: arguments that the plan leaves out.
        same_bits: whether plan and everything gave the same answers.
        untouched: whether a run with inaccessible pages touched no left-out argument.
    """

    interface: str
    language: str
    routine: str
    scene: str
    points: int
    ns_needed: float
    ns_full: float
    ns_general: float
    bytes_needed: int
    bytes_full: int
    bytes_general: int
    memory_needed: float
    memory_full: float
    memory_general: float
    left_out: tuple[str, ...]
    same_bits: bool
    untouched: bool

    @property
    def time_ratio(self) -> float:
        """How many times as long a call takes if everything is passed."""
        return self.ns_full / self.ns_needed

    @property
    def bytes_ratio(self) -> float:
        """How many times as many bytes are then passed."""
        return self.bytes_full / self.bytes_needed


def measure(
    routine: Routine | LawLike | None = None,
    *,
    interfaces: Iterable[str] = (),
    language: str = "c",
    props: Iterable[float] = (),
    states: int = 0,
    points: int = POINTS,
    quick: bool = False,
    progress: Callable[[str], None] | None = None,
) -> list[Saving]:
    """Time, bytes and memory per contact point, by interface and kind of scene.

    Args:
        routine: a routine, or a law or law function, which is taken behind all its interfaces;
            None: exponential decay of the coefficient.
        interfaces: only these.
        language: language of a shipped law.
        props: properties of a routine; of a law without values of its own.
        states: state variables that a routine needs.
        points: contact points of the drivers.
        quick: fewer rounds.
        progress: is told each kind of scene in words, and why one is missing.

    Scenes in which the routine fails, or without the temperatures that it reads, are left away.
    """
    tell = progress or (lambda words: None)
    rounds = 5 if quick else costs.ROUNDS
    found = []
    for made in _routines(routine, tuple(interfaces), language):
        subject = made if isinstance(made, _Subject) else _Subject(made, tuple(props), states)
        for kind, special, general in _scenes(subject, points):
            tell(f"{subject.routine.interface.name.upper()}, {kind} scene")
            try:
                found.append(_saving(subject, kind, special, general, rounds))
            except Error as error:
                tell(f"{subject.routine.interface.name.upper()}, {kind} scene: {error}")
    return found


@dataclass(frozen=True)
class _Subject:
    """A routine with its properties and the state variables that it needs, by scene."""

    routine: Routine
    props: tuple[float, ...]
    states: int
    law: LawLike | None = None

    def fitted(self, scene: Scene) -> Scene:
        """The scene with properties, and at least as many state variables as are needed."""
        needed = self.states
        if self.law is not None:
            directions = scene["friction_directions"] or scene["dimension"] - 1
            needed = self.law.states(
                self.routine.interface.name, directions, scene["dimension"], self.props
            )
        return scene.replace(props=self.props, states=max(scene["states"], needed))


def _routines(
    routine: Routine | LawLike | None, interfaces: tuple[str, ...], language: str
) -> Iterator[Routine | _Subject]:
    from usersub.driver.law import LawLike

    if routine is None:
        from usersub import laws

        routine = laws.exponential_decay(mus=0.3, muk=0.2, dc=0.5)
    wanted = interfaces or INTERFACES
    if not isinstance(routine, LawLike):
        if routine.interface.name in wanted:
            yield routine
        return
    own = getattr(routine, "props", None)
    for name in (n for n in wanted if n in routine.interfaces):
        made = _behind(routine, name, language)
        yield _Subject(made, own if isinstance(own, tuple) else (), 0, routine)


def _behind(law: LawLike, interface: str, language: str) -> Routine:
    """The law's routine; only shipped laws exist in several languages."""
    from usersub.laws.law_object import LawObject

    if isinstance(law, LawObject):
        return law.behind(interface, language)
    return law.behind(interface)


def _scenes(subject: _Subject, points: int) -> Iterator[tuple[str, Scene, Scene]]:
    """Kind, scene of that kind, and the general scene that it is compared with."""
    from usersub.driver.scene import Scene

    name = subject.routine.interface.name
    general: dict[str, object] = {
        "points": points, "temperatures": 1, "fields": 2, "states": 2, "characteristic_length": 1.0,
    }  # fmt: skip
    if name in _STANDARD:
        general |= {"temperature_tangent": 1}
    elif name == "vfric":
        general |= {"secondary_nodes": points, "main_nodes": points}
    else:
        general |= {"nodes": points, "contact": "edge-to-edge"}
    general |= {"states": 0} if name == "vfric_coef" else {}
    least: dict[str, object] = {}
    for kind, (changes, told_by) in _KINDS.items():
        if name not in told_by or (_needs_heat(subject) and "temperatures" in changes):
            continue
        least |= changes
        yield (
            kind,
            subject.fitted(Scene(**{**general, **changes})),
            subject.fitted(Scene(**general)),
        )
    yield LEAST, subject.fitted(Scene(**{**general, **least})), subject.fitted(Scene(**general))
    if name in ("vfriction", "vfric_coef"):
        scene = subject.fitted(Scene(**general))
        yield HALF_OPEN, scene.replace(skip_open=1), scene


def _needs_heat(subject: _Subject) -> bool:
    """Whether the routine is known to read temperatures or fields."""
    uses = subject.routine.uses or ()
    args = subject.routine.interface.args
    heat = ("temp", "predef", "field")
    return any(
        does and a.kind == "real" and a.modern.lower().startswith(heat)
        for does, a in zip(uses, args, strict=False)
    )


def _saving(subject: _Subject, kind: str, special: Scene, general: Scene, rounds: int) -> Saving:
    """One row."""
    half = kind == HALF_OPEN
    made = {
        "needed": _made(subject, special, half),
        "full": _made(subject, special.replace(pass_everything=1, skip_open=0), half),
        "general": _made(subject, general.replace(pass_everything=1), half),
    }
    same = _answers(made["needed"][0], half) == _answers(made["full"][0], half)
    calls = {name: driver.prepare() for name, (driver, _) in made.items()}
    times = costs.in_turns(calls, rounds)
    points = special["points"]
    face = subject.routine.interface
    plan = made["needed"][0].plan
    numbers: dict[str, float] = {}
    for name, (driver, memory) in made.items():
        numbers[f"ns_{name}"] = times[name] / points * 1e9
        numbers[f"bytes_{name}"] = driver.plan.bytes
        numbers[f"memory_{name}"] = memory / points
    return Saving(
        interface=face.name,
        language=subject.routine.language,
        routine=subject.routine.name,
        scene=kind,
        points=points,
        left_out=tuple(row.argument for row in plan.rows if row.what == "left out"),
        same_bits=same,
        untouched=_untouched(subject, special, half),
        **numbers,  # type: ignore[arg-type]
    )


def _made(subject: _Subject, scene: Scene, half: bool) -> tuple[Driver, float]:
    """A driver that was called once, and the bytes that it has allocated.

    Args:
        half: whether half of the points are open.
    """
    from usersub.driver.coefficient import CoefficientDriver
    from usersub.driver.explicit import ExplicitDriver
    from usersub.driver.standard import StandardDriver

    kinds = {
        "standard": StandardDriver,
        "explicit": ExplicitDriver,
        "coefficient": CoefficientDriver,
    }
    kind = kinds[subject.routine.interface.solver]
    arrays = host_arrays(kind(subject.routine, scene))
    if half:
        arrays["normal_force"][~_closed(scene["points"])] = 0.0

    def called() -> Driver:
        driver: Driver = kind(subject.routine, scene)
        driver.bind(**arrays)
        costs.prepared(driver)
        return driver

    return growth(called)


def _answers(driver: Driver, half: bool) -> dict[str, bytes]:
    """All results and the state that the driver has now, as bytes; of the closed points."""
    ports = driver.layout.ports.items()
    names = [n for n, p in ports if p.role in ("out", "state") and driver.keeps(n)]
    closed = _closed(driver.scene["points"]) if half else slice(None)
    return {n: driver.array(n)[..., closed].tobytes() for n in names}


def _closed(points: int) -> np.ndarray:
    """Which points are closed where half of them are: patch by patch."""
    return np.arange(points) // _PATCH % 2 == 0


def _untouched(subject: _Subject, scene: Scene, half: bool) -> bool:
    """Whether the routine runs although nobody can touch what it is said not to use."""
    few = {"points": _CHECKED_POINTS, "checked": 1}
    few |= {n: _CHECKED_POINTS for n in ("nodes", "secondary_nodes", "main_nodes") if scene[n]}
    try:
        driver, _ = _made(subject, scene.replace(**few), half)
    except Error:
        return False
    return driver.observed().what == "nothing"  # type: ignore[attr-defined]
