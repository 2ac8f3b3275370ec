# SPDX-License-Identifier: MIT
"""From what somebody wants to be checked to subjects: one for each interface and precision."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from usersub import abi
from usersub.check.running import isolate
from usersub.check.running.verdicts import death_of
from usersub.check.source.meant import meant
from usersub.check.subject import Around, Scales, Subject
from usersub.check.subjects.apart import around_from
from usersub.errors import AbiError, CompileError, Error, LoadError, SceneError
from usersub.routine.routine import Routine, RoutineMaker

if TYPE_CHECKING:
    from usersub.routine.loading import RoutineFile

DOUBLE, SINGLE, BOTH = "double", "single", "both"
PRECISIONS = (DOUBLE, SINGLE, BOTH)

#: Seconds that a Python file may take to run as a module.
_SECONDS = 20.0
#: Attributes of a subject that may be given; the rest is found out by running the routine.
GIVEN = ("props", "states", "fields", "temperatures", "anisotropic", "scales", "around", "others")


@dataclass(frozen=True)
class Wishes:
    """What the caller says of the routine; None is found out.

    Attributes:
        interface: only this one; generation: of FRIC_COEF.
        precision: "double", "single" or "both".
        law: built-in law that the routine claims to be.
        given: values by name, of `GIVEN`.
    """

    interface: str | None = None
    generation: str | None = None
    precision: str = DOUBLE
    law: str = ""
    given: dict[str, Any] = field(default_factory=dict)


def wishes(
    interface: str | None = None,
    precision: str | None = None,
    law: str | None = None,
    generation: str | None = None,
    **given: Any,
) -> Wishes:
    """Checked wishes.

    Raises:
        SceneError: a value that cannot be, by name.
        LoadError: no such interface or law.
    """
    if precision not in (None, *PRECISIONS):
        raise SceneError(f"precision is {precision!r}, expected {', '.join(PRECISIONS)}")
    if generation not in (None, abi.LEGACY, abi.RELEASE_2022):
        raise SceneError(
            f"generation is {generation!r}, expected '{abi.LEGACY}' or '{abi.RELEASE_2022}'"
        )
    if interface is not None and interface.lower() not in abi.NAMES:
        names = ", ".join(n.upper() for n in abi.NAMES)
        raise LoadError(f"'{interface}' is not an interface; the interfaces are {names}")
    if law:
        from usersub import laws

        laws.law(law)
    name = None if interface is None else interface.lower()
    values = {k: _given(k, v) for k, v in given.items() if v is not None}
    return Wishes(name, generation, precision or DOUBLE, law or "", values)


def _given(name: str, value: Any) -> Any:
    try:
        if name == "props":
            numbers = tuple(float(v) for v in value)
            if not all(map(math.isfinite, numbers)):
                raise ValueError
            return numbers
        if name in ("states", "fields"):
            number = int(value)
            if number < 0 or number != value:
                raise ValueError
            return number
        if name == "scales":
            return value if isinstance(value, Scales) else Scales(**value)
        if name == "around":
            return value if isinstance(value, Around) else around_from(value)
        if name == "others":
            return tuple(v if isinstance(v, Around) else around_from(v) for v in value)
        return bool(value)
    except (TypeError, ValueError) as error:
        expected = {"props": "finite numbers", "scales": "Scales or their values by name"}
        words = expected.get(name, "a number that is not negative")
        raise SceneError(f"{name} is {value!r}, expected {words}") from error


def subjects(target: Any, wish: Wishes) -> Iterator[Subject]:
    """One subject for each interface and precision of the target, in the order of the tables.

    Args:
        target: path of a file in any language, name of a built-in law, Routine, law object, law
            function or loaded file.

    Raises:
        LoadError, CompileError, MissingTool: nothing in it can be looked at. Where an interface is
            known, the error is the subject's `failure` instead.
        SceneError: the precision does not exist.
    """
    empty = True
    for subject in _subjects(target, wish):
        empty = False
        yield subject
    if empty:
        names = wish.interface.upper() if wish.interface else "all interfaces of it"
        raise SceneError(f"precision is '{wish.precision}', but {names} are double precision only")


def _subjects(target: Any, wish: Wishes) -> Iterator[Subject]:
    from usersub.laws import LAWS, LawObject
    from usersub.laws import path as law_path
    from usersub.routine.loading import RoutineFile

    if isinstance(target, LawObject):
        given = {"props": target.props, **wish.given}
        wish = replace(wish, law=target.name, given=given)
        target = law_path(target.name, target.language)
    elif isinstance(target, str) and target in LAWS and not Path(target).exists():
        wish = Wishes(
            wish.interface, wish.generation, wish.precision, wish.law or target, wish.given
        )
        target = law_path(target, "python")
    if isinstance(target, Routine):
        yield from _of_routine(target, wish)
    elif isinstance(target, RoutineMaker):
        yield from _of_maker(target, wish)
    elif isinstance(target, RoutineFile):
        yield from _of_path(target.path, wish)
    elif isinstance(target, str | os.PathLike):
        yield from _of_path(Path(os.path.normpath(Path(target).expanduser())), wish)
    else:
        raise LoadError(
            f"{target!r} cannot be checked; expected a path, the name of a law, a routine, a law "
            "or a law function"
        )


def _subject(name: str, face: abi.Interface, precision: str, wish: Wishes, **more: Any) -> Subject:
    values = {k: wish.given[k] for k in GIVEN if k in wish.given}
    origin = dict.fromkeys(values, "given")
    return Subject(name, face, precision, **values, **more, law=wish.law, origin=origin)


def _precisions(face: abi.Interface, wish: Wishes) -> tuple[str, ...]:
    asked = face.precisions if wish.precision == BOTH else (wish.precision,)
    return tuple(p for p in asked if p in face.precisions)


def _of_routine(routine: Routine, wish: Wishes) -> Iterator[Subject]:
    face = routine.interface
    if wish.interface not in (None, face.name):
        raise LoadError(
            f"{routine.name} is a {face.name.upper()} routine, not {str(wish.interface).upper()}"
        )
    for precision in _precisions(face, wish):
        ready, failure = _ready(routine, precision)
        if ready is None and wish.precision == BOTH and isinstance(failure, AbiError):
            continue  # a routine of one precision
        file = _python_file(routine)
        yield _subject(
            routine.name, face, precision, wish, routine=ready, failure=failure, path=file
        )


def _of_maker(maker: RoutineMaker, wish: Wishes) -> Iterator[Subject]:
    names = maker.interfaces if wish.interface is None else (wish.interface,)
    for name in names:
        generation = wish.generation if name == "fric_coef" else None
        yield from _of_routine(maker.behind(name, generation=generation), wish)


def _python_file(routine: Routine) -> Path | None:
    """The file of a Python routine, if it is one that can be loaded again."""
    place, _, line = routine.origin.rpartition(":")
    if routine.language != "python" or not line.isdecimal() or not Path(place).is_file():
        return None
    return Path(place)


def _ready(routine: Routine, precision: str) -> tuple[Routine | None, Error | None]:
    """The routine if it can be compiled. Python routines are compiled here, once for all children;
    the code of others is not even loaded in this process."""
    if routine.language != "python":
        return routine, None
    try:
        routine.entry(precision)
    except Error as error:
        return None, error
    return routine, None


# Files.


def _of_path(path: Path, wish: Wishes) -> Iterator[Subject]:
    from usersub.routine.loading import load

    if path.suffix.lower() == ".py" and path.is_file():
        _try(path)
    precisions = (DOUBLE, SINGLE) if wish.precision == BOTH else (wish.precision,)
    for precision in precisions:
        options: dict[str, Any] = {"precision": precision, "generation": wish.generation}
        try:
            file = load(path, interface=wish.interface, **options)
        except (AbiError, CompileError, LoadError) as error:
            yield from _broken(path, precision, wish, error)
            continue
        if file.language == "library" and wish.precision == BOTH and precision == SINGLE:
            continue  # it was built in one precision, and nobody knows which
        yield from _of_file(file, precision, wish)


def _of_file(file: RoutineFile, precision: str, wish: Wishes) -> Iterator[Subject]:
    for name in file:
        routine = file[name]
        if precision not in routine.interface.precisions:
            continue
        ready, failure = _ready(routine, precision)
        if ready is None and wish.precision == BOTH and isinstance(failure, AbiError):
            continue
        yield _subject(
            _title(file.path), routine.interface, precision, wish,
            routine=ready, failure=failure, path=file.path, file=file,
        )  # fmt: skip


def _try(path: Path) -> None:
    """Runs a Python file in a child process first: to load it is to run it.

    Raises:
        LoadError: it crashes, or does not come to its end. What it raises is told by loading it.
    """
    from usersub.routine.loading import load

    outcome = isolate.run(lambda child: load(path), _SECONDS)
    death = death_of(outcome)
    if death is not None:
        words = f"{path.name} cannot be loaded: the file, when it is run as a module, {death.words}"
        raise LoadError(words)


def _title(path: Path) -> str:
    """The name of a file; those of built-in laws have the same, and are told apart by the law."""
    from usersub.check.subjects.law_subject import recognised

    law = recognised(path)
    return f"{law}/{path.name}" if law else path.name


def _broken(path: Path, precision: str, wish: Wishes, error: Error) -> Iterator[Subject]:
    """Subjects of a file that cannot be loaded as a whole: each interface by itself.

    Raises:
        Error: not even the interfaces are known.
    """
    from usersub.routine.loading import load

    names = meant(path)
    if wish.interface is not None:
        known = wish.interface in names or not isinstance(error, LoadError)
        names = (wish.interface,) if known else ()
    if not path.is_file() or not names:
        raise error
    found = False
    for name in names:
        face = abi.interface(name, wish.generation if name == "fric_coef" else None)
        if precision not in face.precisions:
            continue
        found = True
        if isinstance(error, AbiError) and wish.interface is None:
            try:
                file = load(path, precision=precision, generation=wish.generation, interface=name)
            except Error as own:
                yield _failed(path, face, precision, wish, own)
            else:
                yield from _of_file(file, precision, wish)
        else:
            yield _failed(path, face, precision, wish, error)
    if not found and wish.precision != BOTH:
        raise error


def _failed(path: Path, face: abi.Interface, precision: str, wish: Wishes, error: Error) -> Subject:
    return _subject(path.name, face, precision, wish, failure=error, path=path.absolute())
