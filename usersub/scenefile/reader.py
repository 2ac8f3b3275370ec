# SPDX-License-Identifier: MIT
"""Reads a scene file: which routine, in which scene, through which history or problem."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from usersub import abi
from usersub.errors import SceneError
from usersub.ports import SETTINGS
from usersub.scenefile.history import Given, take_history
from usersub.scenefile.tables import Table, nearest, show

#: Suffixes of files that hold routines.
SUFFIXES = (
    ".py",
    ".c",
    ".cc",
    ".cpp",
    ".cxx",
    ".f",
    ".for",
    ".f90",
    ".F",
    ".FOR",
    ".F90",
    ".so",
)
LANGUAGES = ("python", "c", "fortran")
_TOP = ("routine", "interface", "generation", "language", "props")
_TABLES = ("scene", "history", "problem", "output")


@dataclass(frozen=True)
class Output:
    """Files that a run writes; None for those that it does not."""

    csv: Path | None = None
    npz: Path | None = None
    figure: Path | None = None

    @property
    def files(self) -> list[Path]:
        """The files that are asked for."""
        return [p for p in (self.csv, self.npz, self.figure) if p is not None]


@dataclass(frozen=True)
class SceneFile:
    """What a scene file says.

    Attributes:
        path: the file.
        routine: path of a routine file, or None.
        law: name of a built-in law, or None.
        interface, generation, language: as given, or None.
        props: properties of the routine; None if the file gives none.
        named: properties of a built-in law by name, or None.
        settings: keys of [scene] that are given.
        history: the table [history] as read, or None.
        problem: name and options of [problem], or None.
        output: files to write.
    """

    path: Path
    routine: Path | None
    law: str | None
    interface: str | None
    generation: str | None
    language: str | None
    props: tuple[float, ...] | None
    named: dict[str, Any] | None = None
    settings: dict[str, Any] = field(default_factory=dict)
    history: Given | None = None
    problem: tuple[str, dict[str, Any]] | None = None
    output: Output = Output()


def read(path: str | Path) -> SceneFile:
    """Reads and checks a scene file without compiling or running anything.

    Raises:
        SceneError: the file is missing or says what cannot be; the message names file, table, key
            and value.
    """
    path = Path(path)
    top = Table(str(path), "", _parse(path))
    routine, law = _routine(top, path.parent)
    interface = top.take("interface", "text", None)
    if interface is not None and interface.lower() not in abi.NAMES:
        hint = nearest(interface, abi.NAMES) or "."
        raise top.error(
            f"interface = {show(interface)} must be one of {', '.join(abi.NAMES)}{hint}"
        )
    generation = top.take("generation", "text", None, (abi.LEGACY, abi.RELEASE_2022))
    language = top.take("language", "text", None, LANGUAGES)
    by_name = isinstance(top.data.get("props"), dict)
    props = top.take("props", "table" if by_name else "numbers", None)
    if by_name and law is None:
        raise top.error("props by name are for built-in laws; a routine file takes an array")
    scene, history, problem, output = (top.table(name) for name in _TABLES)
    top.finish()
    if (history is None) == (problem is None):
        given = "neither" if history is None else "both"
        raise top.error(f"has {given} of the tables [history] and [problem], expected one of them")
    settings = {} if scene is None else _settings(scene)
    if problem is not None:
        _only_problem(top, props, settings)
    elif routine is None and law is None:
        raise top.error("needs the key 'routine': path of a routine file or name of a built-in law")
    return SceneFile(
        path=path,
        routine=routine,
        law=law,
        interface=None if interface is None else interface.lower(),
        generation=generation,
        language=language,
        props=None if props is None or by_name else tuple(map(float, props)),
        named=props if by_name else None,
        settings=settings,
        history=None if history is None else take_history(history, path.parent),
        problem=None if problem is None else _problem(problem),
        output=Output() if output is None else _output(output, path.parent),
    )


def _parse(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except tomllib.TOMLDecodeError as error:
        raise SceneError(f"{path}: is not TOML: {error}") from error
    except UnicodeDecodeError as error:
        raise SceneError(f"{path}: is not UTF-8 text, as TOML has to be") from error
    except FileNotFoundError as error:
        raise SceneError(f"{path}: there is no such scene file") from error
    except OSError as error:
        raise SceneError(f"{path}: cannot be read: {error.strerror}") from error


def _routine(top: Table, folder: Path) -> tuple[Path | None, str | None]:
    """The routine's path, or the name of a built-in law."""
    given = top.take("routine", "text", None)
    if given is None:
        return None, None
    path = folder / given
    if "/" in given or Path(given).suffix in SUFFIXES or (given.strip() and path.exists()):
        if path.is_dir():
            raise top.error(f"routine = {show(given)}: {path} is a folder, expected a file")
        if not path.is_file():
            raise top.error(f"routine = {show(given)}: there is no file {path}")
        return path, None
    if not given.strip():
        raise top.error(
            f"routine = {show(given)} must be the path of a routine file or a built-in law"
        )
    return None, given


def _settings(table: Table) -> dict[str, Any]:
    """The settings of [scene] that the file gives."""
    found = {}
    for setting in SETTINGS:
        value = table.take(setting.key, setting.kind, None, setting.choices)
        if value is not None:
            found[setting.key] = value
    table.finish()
    if found.get("points", 1) < 1:
        raise table.error(f"points = {found['points']} must be at least 1")
    if found.get("dimension", 3) not in (2, 3):
        raise table.error(f"dimension = {found['dimension']} must be 2 or 3")
    for key in ("states", "fields", "temperatures", "friction_directions"):
        if found.get(key, 0) < 0:
            raise table.error(f"{key} = {found[key]} must not be negative")
    return found


#: Keys that a problem knows but that stand elsewhere in a scene file.
_ELSEWHERE = {
    "routine": "at the top of the file",
    "law": "at the top of the file, as 'routine',",
    "interface": "at the top of the file",
    "language": "at the top of the file",
    "precision": "in [scene]",
}


#: Kinds of the options that several problems have.
_OPTIONS = {
    "method": "text",
    "points": "int",
    "steps": "int",
    "table_points": "int",
    "step_share": "real",
    "history": "truth",
}


def _only_problem(top: Table, props: list | dict | None, settings: dict[str, Any]) -> None:
    """Refuses what a problem itself decides."""
    if props is not None:
        raise top.error(f"props = {show(props)} has no place beside [problem], which sets its own")
    others = sorted(set(settings) - {"precision"})
    if others:
        raise top.error(
            f"[scene] {others[0]} = {show(settings[others[0]])} has no place beside [problem], "
            "which makes its own scene; only 'precision' has"
        )


def _problem(table: Table) -> tuple[str, dict[str, Any]]:
    """Name and options of [problem]; the problem itself checks its options."""
    name = table.take("name", "text")
    for key, place in _ELSEWHERE.items():
        if table.has(key):
            raise table.error(f"{key} = {show(table.data[key])} belongs {place}")
    options = {k: table.take(k, _OPTIONS.get(k, "plain")) for k in table.data if k != "name"}
    for key in ("points", "steps", "table_points"):
        if options.get(key, 1) < 1:
            raise table.error(f"{key} = {options[key]} must be at least 1")
    return name, options


def _output(table: Table, folder: Path) -> Output:
    suffixes = {"csv": (".csv",), "npz": (".npz",), "figure": (".png", ".svg")}
    paths = {}
    for key, allowed in suffixes.items():
        given = table.take(key, "text", None)
        if given is None:
            continue
        if Path(given).suffix.lower() not in allowed:
            raise table.error(f"{key} = {show(given)} must end in {' or '.join(allowed)}")
        paths[key] = folder / given
        if not paths[key].parent.is_dir():
            raise table.error(f"{key} = {show(given)}: there is no folder {paths[key].parent}")
    table.finish()
    return Output(**paths)
