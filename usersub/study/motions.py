# SPDX-License-Identifier: MIT
"""Motions that any routine can go, for those whose law nobody has told.

Contact points are moved along straight ways, each in its own direction: slide, hold and slide;
forth and back; steady slip under a pressure that falls and rises. The exact tractions are not
known, so errors are against the same routine with many more increments, in double precision: they
tell what an increment costs and gives, not whether the law is right.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.errors import SceneError
from usersub.problems import fixed
from usersub.problems.explicit_contact import ExplicitContact
from usersub.problems.path_host import directions
from usersub.problems.problem import Outcome, Stopwatch
from usersub.study.result import Plain

if TYPE_CHECKING:
    from usersub.driver.standard import StandardDriver
    from usersub.routine.routine import Routine

#: Times at which tractions are compared; increments of a run are a multiple of it.
TIMES = 24

#: Increments, coarse to fine; fewer of them; those of the run that the others are compared with.
LEVELS = tuple(TIMES * 2**k for k in range(6))
QUICK = (TIMES, 4 * TIMES, 16 * TIMES)
FINEST = TIMES * 256

#: Contact points a call that are tried, and those of the other runs.
BLOCKS = (1, 64, 1024)
POINTS = 8

#: What a routine needs, with what is taken where it is not said. Numbers in a row are text.
SETTINGS: Mapping[str, Plain] = {
    "props": "", "states": 0, "fields": "", "temperatures": False, "anisotropic": False,
    "temperature": 20.0, "slip": 1e-2, "load": 1.0, "dt": 0.25,
}  # fmt: skip

#: What errors are against, in words.
REFERENCE = f"the same routine with {FINEST} increments in double precision"

#: More than any friction: the points are moved, whatever holds them.
_NO_STICK = 1e30

#: Elastic slip of penalty enforcement over the slip of an increment of the coarsest run.
_PENALTIES = {"penalty": 1e-2, "stiff penalty": 1e-4}
_FREE = "prescribed slip"


@dataclass(frozen=True)
class Motion:
    """Slip by the slip of an increment of the coarsest run and pressure by the load, at a share of
    the time."""

    slip: Callable[[float], float]
    pressure: Callable[[float], float]


def _bump(share: float) -> float:
    """From 0 to 1 with a velocity that begins and ends at zero."""
    share = min(max(share, 0.0), 1.0)
    return share - math.sin(2.0 * math.pi * share) / (2.0 * math.pi)


def _held(share: float) -> float:
    return TIMES / 3.0 * (_bump(3.0 * share) + _bump(3.0 * share - 2.0))


MOTIONS = {
    "slide-hold-slide": Motion(_held, lambda share: 1.0),
    "reversal": Motion(lambda share: TIMES / 9.0 * math.sin(3.0 * math.pi * share),
                       lambda share: 1.0),
    "pressure cycle": Motion(lambda share: TIMES * share,
                             lambda share: 1.0 - 0.8 * math.sin(2.0 * math.pi * share) ** 2),
}  # fmt: skip


def methods(interface: str) -> tuple[str, ...]:
    """How the motions go through an interface; the first is the default."""
    if interface == "fric_coef":
        return tuple(_PENALTIES)
    return (_FREE, *_PENALTIES) if interface == "vfric_coef" else (_FREE,)


def law_settings(law: str, interface: str) -> dict[str, Plain]:
    """Settings of a shipped law with its example properties."""
    from usersub import laws

    own = laws.law(law)
    props = own(**own.example).props
    return {
        "props": " ".join(map(repr, map(float, props))),
        "states": own.state_count(interface, 2, 3, props),
        "temperatures": "temperature" in own.reads,
        "anisotropic": bool(own.anisotropic and interface == "fric_coef"),
    }


def numbers(text: Plain) -> tuple[float, ...]:
    """Numbers of a setting that is text."""
    return tuple(float(word) for word in str(text).split())


def run(
    routine: Routine,
    double: Callable[[], Routine],
    problem: str,
    law: str,
    precision: str,
    method: str,
    steps: int,
    points: int,
    settings: Mapping[str, Plain],
) -> Outcome:
    """One run of a motion against the finest one.

    Args:
        double: gives the routine in double precision, for the finest run.

    Raises:
        SceneError: the number of increments is no multiple of `TIMES`.
        RoutineError: the routine failed.
    """
    if steps % TIMES:
        raise SceneError(f"{problem}: steps is {steps}, expected a multiple of {TIMES}")
    given = tuple(sorted({**SETTINGS, **settings}.items()))
    exact = _finest(double(), problem, method, given)
    found, watch = _go(routine, problem, precision, method, steps, points, dict(given))
    times = watch.times(points)
    size = float(np.abs(exact).max())
    off = float(np.abs(found - exact).max())  # NaN stays NaN
    error = off / size if size > 0.0 else (0.0 if off == 0.0 else off * math.inf)
    return Outcome(
        problem=problem, law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method,
        step=TIMES * float(dict(given)["dt"]) / steps, points=points, error=error,
        error_of="traction", tolerance=math.nan, **times,
    )  # fmt: skip


@lru_cache(maxsize=64)
def _finest(
    routine: Routine, problem: str, method: str, given: tuple[tuple[str, Plain], ...]
) -> np.ndarray:
    return _go(routine, problem, "double", method, FINEST, POINTS, dict(given))[0]


def _go(
    routine: Routine, problem: str, precision: str, method: str, steps: int, points: int,
    settings: dict[str, Any],
) -> tuple[np.ndarray, Stopwatch]:  # fmt: skip
    """Tractions along and across the ways at the common times, of the worst point for each time
    in both: shape (2, TIMES). The law does not know directions, so the points agree."""
    make = _Explicit if routine.interface.name.startswith("v") else _Standard
    host = make(routine, precision, method, points, settings)
    motion, every = MOTIONS[problem], steps // TIMES
    dt = TIMES * settings["dt"] / steps
    slips = [settings["slip"] * motion.slip(i / steps) for i in range(steps + 1)]
    loads = [settings["load"] * motion.pressure(i / steps) for i in range(steps + 1)]
    along, found, watch = directions(points), [], Stopwatch()
    for i in range(1, steps + 1):
        tau = host.move((slips[i] - slips[i - 1]) * along, loads[i], i * dt, dt, watch)
        if i % every == 0:
            first = tau[:, 0]
            found.append((float(first @ along[:, 0]),
                          float(first[1] * along[0, 0] - first[0] * along[1, 0])))  # fmt: skip
    return np.array(found).T, watch


def _surroundings(driver: Any, real: type, settings: dict[str, Any]) -> dict[str, np.ndarray]:
    """Temperatures and fields of all that the driver has."""
    arrays, fields = {}, numbers(settings["fields"])
    for name, shape in driver.layout.shapes.items():
        if name.startswith("temperature"):
            arrays[name] = np.full(shape, settings["temperature"], real, order="F")
        elif name.startswith("field") and math.prod(shape):
            values = np.zeros(shape, real, order="F")
            values[...] = np.reshape(fields, (-1,) + (1,) * (len(shape) - 1))
            arrays[name] = values
    return arrays


def _scene(settings: dict[str, Any]) -> dict[str, Any]:
    return {
        "states": settings["states"],
        "fields": len(numbers(settings["fields"])),
        "temperatures": int(settings["temperatures"]),
    }


class _Standard:
    """Through FRIC and FRIC_COEF."""

    def __init__(
        self, routine: Routine, precision: str, method: str, points: int, settings: dict[str, Any]
    ) -> None:
        from usersub import Scene, StandardDriver

        soft = _PENALTIES["penalty"] * settings["slip"]
        more: dict[str, Any] = {"characteristic_length": 200.0 * soft}
        if routine.interface.name == "fric_coef":
            more = {"elastic_slip": _PENALTIES[method] * settings["slip"], "states": 0,
                    "anisotropic": int(settings["anisotropic"]),
                    "generation": routine.interface.generation}  # fmt: skip
        scene = Scene(
            points=points, dimension=3, props=numbers(settings["props"]),
            **{**_scene(settings), **more},
        )  # fmt: skip
        self.driver: StandardDriver = StandardDriver(routine, scene, reuse=True)
        self.slip, self.pressure = np.zeros((2, points), order="F"), np.ones(points)
        known, extra = self.driver.layout.shapes, {}
        for name in ("coord", "coord_main"):
            if name in known:
                extra[name] = np.zeros(known[name], order="F")
        self.driver.bind(slip_increment=self.slip, pressure=self.pressure, **extra,
                         **_surroundings(self.driver, np.float64, settings))  # fmt: skip
        self.pressure[...] = settings["load"]
        self.driver.begin_increment(0.0)  # closes the contact
        fixed.iterate(self.driver)
        self.driver.commit()

    def move(
        self, slip: np.ndarray, load: float, time: float, dt: float, watch: Stopwatch
    ) -> np.ndarray:
        """Tractions after one increment."""
        self.slip[...], self.pressure[...] = slip, load
        self.driver.begin_increment(dt)
        with watch:
            response = fixed.iterate(self.driver)
        self.driver.commit()
        return response.tau


class _Explicit:
    """Through VFRIC, VFRICTION and VFRIC_COEF."""

    def __init__(
        self, routine: Routine, precision: str, method: str, points: int, settings: dict[str, Any]
    ) -> None:
        place = np.zeros((3, points))
        place[0] = np.arange(points)
        self.area = 1.0 + 0.5 * np.arange(points) / points
        more = _scene(settings)
        if routine.interface.name == "vfric_coef":
            more["states"] = 0
        if method in _PENALTIES:
            slope = settings["load"] / (_PENALTIES[method] * settings["slip"])
            more |= {"enforcement": "penalty", "stick_slope": slope}
        self.contact = ExplicitContact(
            routine, list(numbers(settings["props"])), place, self.area, precision=precision, **more
        )
        driver = self.contact.driver
        self.stick = None if method in _PENALTIES else np.full(points, _NO_STICK)
        driver.bind(**_surroundings(driver, self.contact.real, settings))

    def move(
        self, slip: np.ndarray, load: float, time: float, dt: float, watch: Stopwatch
    ) -> np.ndarray:
        """Tractions after one increment."""
        way = np.zeros((3, self.area.size))
        way[[0, 2]] = slip
        with watch:
            force = self.contact.force(way, load * self.area, self.stick, dt, time)
        return -force[[0, 2]] / self.area
