# SPDX-License-Identifier: MIT
"""Compilers on this machine: C, C++ and Fortran, by environment, PATH or the `zig` extra."""

from __future__ import annotations

import functools
import importlib.util
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from usersub.errors import CompileError, MissingTool

_SECONDS = 300


@dataclass(frozen=True)
class Compiler:
    """A compiler: `language` ("c", "c++", "fortran"), `command`, `version` (its own words)."""

    language: str
    command: tuple[str, ...]
    version: str

    @property
    def name(self) -> str:
        """What the user calls it."""
        return "zig cc" if "ziglang" in self.command else Path(self.command[0]).name


@dataclass(frozen=True)
class Outcome:
    """Exit code and text of one compiler run."""

    code: int
    text: str


# Language -> environment variable, programs to look for, how to install.
_KNOWN = {
    "c": ("CC", ("cc", "gcc", "clang"), "`apt install gcc` (or `pip install 'usersub[zig]'`)"),
    "c++": (
        "CXX",
        ("c++", "g++", "clang++"),
        "`apt install g++` (or `pip install 'usersub[zig]'`)",
    ),
    "fortran": (
        "FC",
        ("gfortran",),
        "`apt install gfortran`, `dnf install gcc-gfortran`, `conda install gfortran` or "
        "`brew install gcc`",
    ),
}
_TITLE = {"c": "C", "c++": "C++", "fortran": "Fortran"}


def find(language: str) -> Compiler:
    """The compiler for `language`: environment variable, then PATH, then `python -m ziglang`.

    Raises:
        MissingTool: there is none; the sentence says how to install it.
    """
    variable = _KNOWN[language][0]
    return _find(language, os.environ.get(variable, ""), os.environ.get("PATH", ""))


@functools.lru_cache(maxsize=32)
def _find(language: str, named: str, search: str) -> Compiler:
    variable, programs, install = _KNOWN[language]
    candidates: list[tuple[str, ...]] = []
    if named.strip():
        words = shlex.split(named)
        where = shutil.which(words[0], path=search)
        if where is None:
            raise MissingTool(
                f"{variable} names the {_TITLE[language]} compiler '{words[0]}', which is not "
                f"there; unset {variable} or install one with {install}"
            )
        candidates.append((where, *words[1:]))
    candidates += [(w,) for program in programs if (w := shutil.which(program, path=search))]
    if language != "fortran" and importlib.util.find_spec("ziglang") is not None:
        word = "cc" if language == "c" else "c++"
        candidates.append((sys.executable, "-m", "ziglang", word))
    for command in candidates:
        lines = [s for s in map(str.strip, run((*command, "--version")).text.splitlines()) if s]
        # Of Fortran compilers only gfortran will do, even if FC names another one.
        if language != "fortran" or any("GNU Fortran" in line for line in lines):
            return Compiler(language, tuple(command), lines[0] if lines else command[0])
    other = f"; '{named}' of {variable} is another compiler" if candidates else ""
    raise MissingTool(
        f"no {_TITLE[language]} compiler was found (looked for {', '.join(programs)}){other}; "
        f"install it with {install}"
    )


def run(command: Sequence[str], folder: Path | None = None) -> Outcome:
    """Runs a compiler with plain messages (locale C) and returns its text.

    Raises:
        CompileError: it cannot be started or runs longer than five minutes.
    """
    environment = dict(os.environ, LC_ALL="C", LANGUAGE="C")
    try:
        done = subprocess.run(
            list(command),
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=_SECONDS,
            check=False,
        )
    except OSError as error:
        raise CompileError(f"'{command[0]}' cannot be started: {error.strerror}") from error
    except subprocess.TimeoutExpired as error:
        raise CompileError(f"'{command[0]}' ran longer than {_SECONDS} s") from error
    return Outcome(done.returncode, done.stdout.decode("utf-8", "replace"))


_WORDS = re.compile(r"^(?P<where>[^\s:][^:]*:\d+(?::\d+)?): *(?P<what>(?:fatal )?error: .*)$", re.I)


def has_no_place(text: str) -> bool:
    """Whether no line of the compiler's words says where."""
    return not any(map(_WORDS.match, text.splitlines()))


def refusal(compiler: Compiler, source: Path, outcome: Outcome) -> CompileError:
    """The error of a failed compilation: places and the compiler's words, five at most."""
    words: list[str] = []
    place = ""
    for found in filter(None, map(_WORDS.match, outcome.text.splitlines())):
        what = found["what"].split(":", 1)[1].strip().removesuffix(".")
        if what == "(1)":
            # gfortran names the first of two places alone, and the second with the sentence.
            place = found["where"]
            continue
        words.append(f"{place or found['where']}: {what}")
        place = ""
    words = list(dict.fromkeys(words))
    if not words:
        lines = [line for line in outcome.text.splitlines() if line.strip()]
        words = lines[-3:] or [f"exit code {outcome.code}"]
    more = f"\n  and {len(words) - 5} more" if len(words) > 5 else ""
    listed = "".join(f"\n  {word}" for word in words[:5])
    return CompileError(f"{compiler.name} refused {source.name}:{listed}{more}")
