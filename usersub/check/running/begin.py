# SPDX-License-Identifier: MIT
"""What is there before the first contact: files that the routine reads, and what UEXTERNALDB or
VEXTERNALDB of its file prepares.

A child process begins in an empty folder. Files beside the source, or in the folder where the
check was started, that the source names in a text are copied there. The entry that the solver
calls at the start of an analysis is called as soon as the code is loaded, if a child that tried it
came back.
"""

from __future__ import annotations

import contextlib
import ctypes
import re
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from usersub.check.rule import STANDARD
from usersub.errors import Error
from usersub.routine import library

if TYPE_CHECKING:
    from usersub.check.subject import Subject

#: Largest file that is copied into every process, bytes.
_LARGEST = 4 << 20
_TEXTS = re.compile(r"'([^'\n]{1,200})'|\"([^\"\n]{1,200})\"")
#: Entry and the values of its first argument before the first contact: start of the analysis, of a
#: step, of an increment (explicit: and its set-up).
_ENTRIES = {True: ("uexternaldb", (0, 5, 1)), False: ("vexternaldb", (0, 1, 2, 3))}
#: Integers and reals that VEXTERNALDB is told to have, and room beyond.
_INTEGERS, _REALS, _ROOM = 6, 3, 64
_SECONDS = 5.0


@dataclass(frozen=True)
class Beginning:
    """What children do before they look at a subject.

    Attributes:
        files: copied into their folders.
        entry: name of the entry to be called, or "".
        words: for the head of the report: what was called, or why it was not.
    """

    files: tuple[Path, ...] = ()
    entry: str = ""
    words: str = ""


#: What children of this process do; they see what was set before they were forked.
_now: tuple[Beginning, Subject | None] = (Beginning(), None)


def found(subject: Subject) -> Beginning:
    """What there is before the first contact of a subject, tried out in a child."""
    from usersub.check.running import isolate
    from usersub.check.running.verdicts import death_of

    files = tuple(_named(subject.path)) if subject.path is not None else ()
    name, lops = _ENTRIES[subject.interface.name in STANDARD]
    if not _has(subject, name):
        return Beginning(files)
    listed = ", ".join(map(str, lops))
    called = f"{name.upper()} of the file was called with LOP = {listed}"
    trial = Beginning(files, name, called)
    use(subject.but(beginning=Beginning(files)))

    def work(child: isolate.Channel) -> None:
        use(subject.but(beginning=trial))
        _load(subject)
        child.say({"called": True})

    outcome = isolate.run(work, _SECONDS)
    if any("called" in said for said in outcome.said):
        return trial
    death = death_of(outcome)
    why = death.words if death is not None else "failed"
    said = outcome.output.strip().splitlines()
    why += f", saying '{said[-1].strip()[:120]}'" if said else ""
    words = f"{name.upper()} {why} when it was called with LOP = {listed}: it is left out"
    return Beginning(files, "", words)


def use(subject: Subject) -> None:
    """Says for which subject the children of this process are from now on."""
    global _now
    _now = (subject.beginning or Beginning(), subject)


def in_child(home: Path) -> None:
    """Copies the files and calls the entry; in a child, before its work."""
    beginning, subject = _now
    copy_files(home)
    if beginning.entry and subject is not None:
        with contextlib.suppress(Error):
            _load(subject)


def copy_files(folder: Path) -> None:
    """Copies the files into a folder that becomes a working directory."""
    for file in _now[0].files:
        with contextlib.suppress(OSError):
            shutil.copyfile(file, folder / file.name)


def origin(beginning: Beginning) -> dict[str, str]:
    """What the head of the report says of it."""
    told = {}
    if beginning.files:
        told["files"] = ", ".join(f.name for f in beginning.files)
    if beginning.words:
        told["start"] = beginning.words
    return told


def _load(subject: Subject) -> None:
    """Loads the code; the entry is called by whatever loads it, also built otherwise."""
    library.after_open = _called
    if subject.file is not None and subject.file.code is not None:
        subject.file.code.loaded(subject.precision)


def _has(subject: Subject, name: str) -> bool:
    code = subject.file.code if subject.file is not None else None
    if code is None or subject.routine is None:
        return False
    try:
        functions = code.build(subject.precision).functions
    except Error:
        return False
    return name + "_" in functions


def _called(loaded: ctypes.CDLL) -> None:
    """Calls the entry of a library that was loaded, as the solver does before the first contact."""
    beginning, subject = _now
    place = library.address(loaded, beginning.entry + "_") if beginning.entry else 0
    if not place or subject is None:
        return
    standard = subject.interface.name in STANDARD
    real = ctypes.c_double if standard or subject.precision == "double" else ctypes.c_float
    whole, reals = (ctypes.c_int * _ROOM)(), (real * _ROOM)()
    rest: list[Any]
    if standard:
        no_restart, one, increment = ctypes.c_int(0), ctypes.c_int(1), real(0.25)
        rest = [no_restart, reals, increment, one, one]
    else:
        whole[2:4] = [1, 1]  # step and increment
        rest = [whole, ctypes.c_int(_INTEGERS), reals, ctypes.c_int(_REALS)]
    entry = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * (1 + len(rest)))(place)
    for lop in _ENTRIES[standard][1]:
        entry(*map(ctypes.addressof, (ctypes.c_int(lop), *rest)))


def _named(source: Path) -> list[Path]:
    """Files that a text of the source names, beside it or in the folder of this process."""
    try:
        text = source.read_bytes()[:_LARGEST].decode("latin-1")
    except OSError:
        return []
    folders = dict.fromkeys((source.absolute().parent, Path.cwd()))
    names = dict.fromkeys(
        (one or two).strip().rpartition("/")[2] for one, two in _TEXTS.findall(text)
    )
    made = []
    for name in names:
        places = [] if name in ("", ".", "..", source.name) else [f / name for f in folders]
        with contextlib.suppress(OSError, ValueError):
            file = next((p for p in places if p.is_file()), None)
            if file is not None and file.stat().st_size <= _LARGEST and not _is_source(file):
                made.append(file)
    return made


def _is_source(file: Path) -> bool:
    """What is included when the routine is compiled, and nothing that it reads."""
    return file.suffix.lower() in {".inc", ".hdr", ".h", ".fi", ".f", ".for", ".f90", ".c"}
