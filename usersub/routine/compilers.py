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
    if named.strip():
        command = shlex.split(named)
        where = shutil.which(command[0], path=search)
        if where is None:
            raise MissingTool(
                f"{variable} names the {_TITLE[language]} compiler '{command[0]}', which is not "
                f"there; unset {variable} or install one with {install}"
            )
        return _describe(language, (where, *command[1:]), variable)
    for program in programs:
        where = shutil.which(program, path=search)
        if where is not None:
            return _describe(language, (where,), "PATH")
    if language != "fortran" and importlib.util.find_spec("ziglang") is not None:
        return _describe(language, (sys.executable, "-m", "ziglang", language), "ziglang")
    raise MissingTool(
        f"no {_TITLE[language]} compiler was found (looked for {', '.join(programs)}); "
        f"install it with {install}"
    )


def _describe(language: str, command: tuple[str, ...], origin: str) -> Compiler:
    if command[-2:] in (("ziglang", "c"), ("ziglang", "c++")):
        command = (*command[:-1], "cc" if command[-1] == "c" else "c++")
    text = run((*command, "--version")).text
    if language == "fortran" and "GNU Fortran" not in text:
        raise MissingTool(
            f"the Fortran compiler '{command[0]}' (from {origin}) is not gfortran, which usersub "
            f"needs; install it with {_KNOWN[language][2]} and set FC=gfortran"
        )
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return Compiler(language, command, lines[0] if lines else command[0])


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


def refusal(compiler: Compiler, source: Path, outcome: Outcome) -> CompileError:
    """The error of a failed compilation: places and the compiler's words, five at most."""
    words = list(
        dict.fromkeys(
            f"{m['where']}: {m['what'].split(':', 1)[1].strip().removesuffix('.')}"
            for m in map(_WORDS.match, outcome.text.splitlines())
            if m
        )
    )
    if not words:
        lines = [line for line in outcome.text.splitlines() if line.strip()]
        words = lines[-3:] or [f"exit code {outcome.code}"]
    more = f"\n  and {len(words) - 5} more" if len(words) > 5 else ""
    listed = "".join(f"\n  {word}" for word in words[:5])
    return CompileError(f"{compiler.name} refused {source.name}:{listed}{more}")
