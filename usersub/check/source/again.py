# SPDX-License-Identifier: MIT
"""The source of a routine compiled again: with more warnings, other flags, or small changes.

Everything is kept in the cache of compiled code, so that the rules, each in its own process, and
later runs share it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

from usersub import abi
from usersub.errors import CompileError, LoadError
from usersub.routine import build, c, cache, compilers, dual, library
from usersub.routine.fortran_attempts import first_that_works, flags
from usersub.routine.fortran_source import Prepared, prepare
from usersub.routine.loading import _language
from usersub.routine.routine import FULL, Entry
from usersub.routine.support import support

#: Version of what is kept; part of every key.
_RECORD = "again 1"

#: What the text of a preprocessed C file is compiled as.
_PLAIN = {"c": "plain.i", "c++": "plain.ii"}


@dataclass(frozen=True)
class Warned:
    """One warning of the compiler: `file` as the user knows it, `line`, `column`, its words, and
    the option that asks for it, such as "-Wconversion"."""

    file: str
    line: int
    column: int
    words: str
    option: str

    @property
    def where(self) -> str:
        """ "file:line"."""
        return f"{self.file}:{self.line}"


_WARNED = re.compile(
    r"^(?P<file>[^\s:][^:]*):(?P<line>\d+):(?P<column>\d+): [Ww]arning: (?P<words>.*?)"
    r"(?: \[(?P<option>-W[\w=+-]+)\])?$"
)


class Source:
    """A source in C, C++ or Fortran, in one precision. Made by `of`.

    Attributes:
        path, language, precision: of the source.
    """

    def __init__(self, path: Path, precision: str) -> None:
        self.path, self.precision = path, precision
        self.language = _language(path)
        if self.language not in ("c", "c++", "fortran"):
            raise LoadError(f"{path.name} is no source that could be compiled again")
        self._compiler = compilers.find(self.language)

    def warnings(self, *options: str) -> list[Warned]:
        """What the compiler says of the user's own files, with more `options` (-W...).

        Raises:
            CompileError: it does not compile.
        """
        found = map(_WARNED.match, self._kept(options).splitlines())
        own = [
            Warned(
                m["file"], int(m["line"]), int(m["column"]), _plain(m["words"]), m["option"] or ""
            )
            for m in found
            if m and not m["file"].startswith("/")
        ]
        return list(dict.fromkeys(own))

    def dump(self) -> str:
        """gfortran's own description of the program units, all names resolved (Fortran).

        Raises:
            CompileError: it does not compile.
        """
        return self._kept(("-fdump-fortran-original", "-fsyntax-only"))

    def text(self) -> str:
        """What the compiler reads, with `# line "file"` markers: preprocessed for C, the prepared
        file before the preprocessor for Fortran."""
        return self._whole[0].decode("latin-1")

    def entry(
        self,
        *options: str,
        text: str | None = None,
        interface: str = "",
        renamed: Mapping[str, str] | None = None,
    ) -> Entry | None:
        """The entry compiled with more `options` and another `text`.

        Args:
            interface: name of the interface; "" for the first that there is.
            renamed: functions that are called instead of others, by name.

        Returns:
            None if that does not compile or link.
        """
        try:
            made = self._library(options, text, renamed or {})
            loaded = library.open_library(made)
        except (CompileError, LoadError):
            return None
        for name in (interface,) if interface else abi.NAMES:
            if place := library.address(loaded, name + "_"):
                return Entry(place, FULL, loaded)
        return None

    def object(self, *options: str) -> Path:
        """The object file, compiled with more `options`.

        Raises:
            CompileError: it does not compile.
        """
        text = self._whole[0]
        target = cache.path(self.path.stem, self._key((*options, "object"), text), ".o")
        if not target.is_file():
            with cache.build_folder() as folder:
                outcome = self._compiled(options, text, folder)
                if outcome.code:
                    raise compilers.refusal(self._compiler, self.path, outcome)
                cache.put(folder / "main.o", target)
        return target

    @property
    def free(self) -> bool:
        """Whether it is Fortran in free form."""
        return bool(self._whole[3]) and str(self._whole[3][0]).endswith("90")

    # How it is done.

    @cached_property
    def _whole(self) -> tuple[bytes, dict[str, bytes], tuple[str, ...], tuple[str | bytes, ...]]:
        """Text, other files, command without options, more parts of the key."""
        if self.language == "fortran":
            return self._fortran()
        base = support()
        folders = (*base.include_folders(self.precision), self.path.parent)
        chosen = c.flags(self.language, self.precision)
        places = tuple(f"-I{p}" for p in folders)
        command = (*self._compiler.command, *chosen, *places)
        expand = [word for word in command if word != "-g"]
        with cache.build_folder() as folder:
            plain = folder / _PLAIN[self.language]
            outcome = compilers.run(
                [*expand, "-DUSUB_REPORT_UNUSED", "-E", self.path.name, "-o", str(plain)],
                self.path.parent,
            )
            if outcome.code:
                raise compilers.refusal(self._compiler, self.path, outcome)
            return plain.read_bytes(), {}, command, ()

    def _fortran(self) -> tuple[bytes, dict[str, bytes], tuple[str, ...], tuple[str | bytes, ...]]:
        own = support().include_folders(self.precision)
        prepared, chosen = _prepared(self.path, own, self.precision, self._compiler)
        places = tuple(f"-I{p}" for p in (*own, self.path.parent))
        others = {name: data for name, data in prepared.files.items() if name != prepared.main}
        return (
            prepared.files[prepared.main],
            others,
            (*self._compiler.command, *chosen, *places),
            (prepared.main, *(p for pair in sorted(others.items()) for p in pair)),
        )

    def _key(self, options: tuple[str, ...], text: bytes) -> str:
        _, _, command, more = self._whole
        return cache.key(_RECORD, self._compiler.version, *command, *options, text, *more)

    def _compiled(self, options: tuple[str, ...], text: bytes, folder: Path) -> compilers.Outcome:
        """Compiles to `main.o` in `folder`."""
        _, others, command, more = self._whole
        name = str(more[0]) if self.language == "fortran" else _PLAIN[self.language]
        for other, data in others.items():
            (folder / other).write_bytes(data)
        (folder / name).write_bytes(text)
        plain = ("-fno-diagnostics-show-caret", f"-J{folder}") * (self.language == "fortran")
        return compilers.run([*command, *plain, *options, "-c", name, "-o", "main.o"], folder)

    def _kept(self, options: tuple[str, ...]) -> str:
        """The compiler's words."""
        text = self._whole[0]
        target = cache.path(self.path.stem, self._key(options, text), ".txt")
        if not target.is_file():
            with cache.build_folder() as folder:
                outcome = self._compiled(options, text, folder)
                if outcome.code:
                    raise compilers.refusal(self._compiler, self.path, outcome)
                cache.put_text(outcome.text, target)
        return target.read_text(encoding="utf-8")

    def _library(
        self, options: tuple[str, ...], text: str | None, renamed: Mapping[str, str]
    ) -> Path:
        data = self._whole[0] if text is None else text.encode("latin-1")
        names = [f"--redefine-sym={old}={new}" for old, new in sorted(renamed.items())]
        key = self._key((*options, "library", *names), data)
        target = cache.path(self.path.stem, key, ".so")
        if target.is_file():
            return target
        with cache.build_folder() as folder:
            outcome = self._compiled(options, data, folder)
            if outcome.code:
                raise compilers.refusal(self._compiler, self.path, outcome)
            for name in names:  # one by one: objcopy takes a target once in a command
                if compilers.run(["objcopy", name, "main.o"], folder).code:
                    raise LoadError(f"objcopy could not rename a function of {self.path.name}")
            parts = [folder / "main.o"]
            if self.language != "fortran":
                places = [*support().include_folders(self.precision), self.path.parent]
                chosen = c.flags(self.language, self.precision)
                shared = tuple(f for f in chosen if not f.startswith("-std="))
                if second := dual.read(self.path, data, shared, places, folder):
                    parts.append(second.compile())
            build.link(self._compiler, self.path, parts, support().link_flags, target)
        return target


@lru_cache(maxsize=8)
def _made(path: Path, precision: str, stamp: tuple[int, int]) -> Source:
    return Source(path, precision)


def of(path: Path, precision: str) -> Source:
    """The source at `path`.

    Raises:
        LoadError: it is no source. MissingTool: no compiler for it.
    """
    found = path.stat()
    return _made(path, precision, (found.st_mtime_ns, found.st_size))


def _prepared(
    path: Path, own: tuple[Path, ...], precision: str, compiler: compilers.Compiler
) -> tuple[Prepared, tuple[str, ...]]:
    """The files as they compile, and the flags for it."""
    prepared = prepare(path, own)
    usual = flags(prepared.free, precision)
    with cache.build_folder() as folder:
        places = (f"-J{folder}", *(f"-I{p}" for p in (*own, path.parent)))
        for name, data in prepared.files.items():
            (folder / name).write_bytes(data)
        command = [*compiler.command, *usual, *places, "-w", "-fsyntax-only", prepared.main]
        if not compilers.run(command, folder).code:
            return prepared, usual

        def other_form() -> Prepared:
            return prepare(path, own, free=not prepared.free)

        found, chosen, outcome = first_that_works(
            compiler, prepared, other_form, precision, places, folder
        )
        if outcome.code:
            raise compilers.refusal(compiler, path, outcome)
        return found, chosen


def _plain(words: str) -> str:
    """The compiler's words without its marks for places."""
    return words.replace(" at (1)", "").replace("(1)", "here").strip()
