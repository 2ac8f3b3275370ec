# SPDX-License-Identifier: MIT
"""What a built-in law answers, by a path that does not go through the routine under check: the
shipped law, in another language if it is itself under check, and the reference values of arbitrary
precision."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.check.case import Case, Step
from usersub.check.rule import CannotCheck
from usersub.check.subjects.law_subject import recognised_language
from usersub.errors import Error, MissingTool

if TYPE_CHECKING:
    from usersub.check.subject import Subject
    from usersub.laws.description import Law
    from usersub.routine.routine import Routine

#: Name of the file with the reference values of a law.
_REFERENCE = "reference.json"
#: Languages of the law that answers, in the order of what they cost: Python has to be compiled
#: function by function.
_LANGUAGES = ("c", "fortran", "python")


def twin(subject: Subject, law: Law) -> Subject:
    """The law itself as a subject: in C, or in another language if it is the law in C that is
    checked or if there is no C compiler.

    Raises:
        CannotCheck: the law does not stand behind the interface.
    """
    own = recognised_language(subject, law.name)
    try:
        routine = _shipped(law.name, subject.interface.name, subject.precision, own)
    except Error as error:
        raise CannotCheck(f"the built-in law {law.name}: {error}") from error
    return subject.but(
        name=law.name, routine=routine, interface=routine.interface, path=None, file=None
    )


@cache
def _shipped(name: str, interface: str, precision: str, but_in: str) -> Routine:
    """The routine of a law in the first language that there is a compiler for, but for one."""
    from usersub import laws

    languages = [language for language in _LANGUAGES if language != but_in]
    for language in languages[:-1]:
        with contextlib.suppress(MissingTool):
            return laws.routine(name, interface, language, precision=precision)
    return laws.routine(name, interface, languages[-1], precision=precision)


def sized(subject: Subject, law: Law, case: Case) -> Subject:
    """The subject with the sizes that the law has with the properties and values of a case."""
    props = subject.props if case.props is None else case.props
    first = case.steps[0]
    dimension = case.directions + 1
    states = law.state_count(subject.interface.name, case.directions, dimension, props)
    own = props == subject.props
    return subject.but(
        props=props,
        states=max(states, subject.states) if own else states,
        fields=len(first.fields[0][0]) if first.fields else 0,
        temperatures=first.temperature is not None,
    )


@dataclass(frozen=True)
class Known:
    """A case with values that are known: per step a dict from array of `Answer` to values."""

    case: Case
    values: tuple[dict[str, np.ndarray], ...]


@cache
def _file(folder: Path) -> list[dict[str, Any]]:
    path = folder / _REFERENCE
    if not path.is_file():
        return []
    return json.loads(path.read_text(encoding="utf-8"))["cases"]


def known(subject: Subject, law: Law) -> Iterator[Known]:
    """The reference values that the interface shows as they are."""
    for entry in _file(law.folder):
        props = tuple(float(p) for p in entry["props"])
        if "points" in entry:
            for point in entry["points"]:
                found = _of_point(subject, law, props, point)
                if found is not None:
                    yield found
        elif subject.interface.name != "vfriction" or entry["directions"] == 2:
            found = _of_path(subject, props, entry)
            if found is not None:
                yield found


def _array(values: Any) -> np.ndarray:
    """Numbers of the file; null, where a derivative does not exist, is NaN."""
    return np.array(values, dtype=float)


def _of_point(
    subject: Subject, law: Law, props: tuple[float, ...], point: dict[str, Any]
) -> Known | None:
    """A point at a rate, behind an interface without elastic slip."""
    name, precision = subject.interface.name, point.get(subject.precision)
    if name == "fric" or precision is None or not _fits(point):
        return None
    dt, rate, load = (float(point[n]) for n in ("time_increment", "slip_rate", "pressure"))
    if dt == 0.0 or not np.isfinite(rate * dt):
        return None
    value = _array(precision["value"])
    state = tuple(float(s) for s in point["state"])
    step = Step(
        ((rate * dt, 0.0),), (load,), dt, stick=(1e30,), temperature=_both(point), fields=_fs(point)
    )
    case = Case((step,), props=props, state=state or None)
    if name in ("fric_coef", "vfric_coef"):
        found: dict[str, np.ndarray] = {"coefficient": value[:1]}
        if name == "fric_coef" and len(value) > 1:
            found["second"] = value[1:]
        if name == "fric_coef" and "derivative" in precision:
            found["derivative"] = _array(precision["derivative"])[0, :3, np.newaxis]
    elif rate == 0.0:
        return None
    else:
        force = value[0] * (load if law.kind == "coefficient" else 1.0)
        found = {"friction": np.array([[force], [0.0]])}
    if precision.get("state") and name != "vfric_coef":
        found["state"] = _array(precision["state"])[:, np.newaxis]
    return Known(case, (found,))


def _fits(point: dict[str, Any]) -> bool:
    return float(point["pressure"]) > 0.0


def _both(point: dict[str, Any]) -> tuple[tuple[float, float], ...]:
    temperature = float(point["temperature"])
    return ((temperature, temperature),)


def _fs(point: dict[str, Any]) -> tuple | None:
    fields = tuple(float(f) for f in point["fields"])
    return ((fields, fields),) if fields else None


def _of_path(subject: Subject, props: tuple[float, ...], entry: dict[str, Any]) -> Known | None:
    """A path of a law that gives a traction; behind FRIC the point comes to touch before.

    An explicit host does not ask at a point without normal force, which the path does not know.
    """
    path, directions = entry["path"], int(entry["directions"])
    fric = subject.interface.name == "fric"
    steps = [_step(path[0], directions, still=True)] if fric else []
    values: list[dict[str, np.ndarray]] = [{}] if fric else []
    for increment in path:
        exact = increment.get(subject.precision)
        open_now = float(increment["pressure"]) <= 0.0 or float(increment["time_increment"]) == 0.0
        if exact is None or (open_now and not fric):
            break
        steps.append(_step(increment, directions))
        found = {"friction": _array(exact["traction"])[:directions, np.newaxis]}
        if fric and exact.get("tangent"):
            tangent = _array(exact["tangent"])
            found["tangent"] = tangent[:directions, :directions, np.newaxis]
            found["by_pressure"] = tangent[:directions, 2][:, np.newaxis]
        values.append(found)
    return Known(Case(tuple(steps), props=props), tuple(values)) if steps else None


def _step(increment: dict[str, Any], directions: int, still: bool = False) -> Step:
    motion = tuple(0.0 if still else float(m) for m in increment["motion"])[:directions]
    return Step(
        (motion,),
        (float(increment["pressure"]),),
        float(increment["time_increment"]),
        stick=(1e30,),
        temperature=_both(increment),
        fields=_fs(increment),
    )
