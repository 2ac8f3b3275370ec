# SPDX-License-Identifier: MIT
"""Lines of a deck and of the files that it includes, one after another in constant memory."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import BinaryIO

from usersub.deck.keywords import OURS
from usersub.deck.words import Parameters, Where, choose, refuse, show, split, squeeze
from usersub.errors import DeckError

#: Longest line that is read, in characters; of a longer one only skipped data may consist.
LONGEST = 65536
#: Files that may be open within one another.
DEEPEST = 16
_INCLUDE = {"INPUT": "path", "PASSWORD": "name"}


class _File:
    """One open file or stream: its raw lines, and how many of them have been read."""

    def __init__(self, name: str, raw: Iterator[bytes], folder: Path, key: object) -> None:
        self.name, self.raw, self.folder, self.key = name, raw, folder, key
        self.line = 0
        self.close: Callable[[], None] = lambda: None


class Lines:
    """The lines of a deck; *INCLUDE is followed, comments and blank lines are left out.

    A context manager: leaving it closes all files.

    Args:
        source: path of a deck, or its lines (texts or bytes, also an open file); a text with line
            ends is the deck itself.

    Raises:
        DeckError: a file cannot be read, or a line is none.
    """

    def __init__(self, source: str | os.PathLike | Iterable[str] | Iterable[bytes]) -> None:
        self._stack: list[_File] = []
        self._waiting: tuple[str, Where] | None = None
        self.where = Where("deck", 0)
        if isinstance(source, str) and "\n" in source:
            source = source.split("\n")
        if isinstance(source, (str, os.PathLike)):
            path = Path(source)
            self.name = str(path)
            self._open(path, self.name, None)
        else:
            self.name = _name_of(source)
            self._stack.append(_File(self.name, _checked(source, self), Path(), object()))

    def __enter__(self) -> Lines:
        return self

    def __exit__(self, *_: object) -> None:
        for file in self._stack:
            file.close()

    def _open(self, path: Path, name: str, by: Where | None) -> None:
        """Puts a file on top of the stack; `by` is the line that includes it."""
        place = by or Where(name, 0)
        words = "the deck" if by is None else f"the included file {show(name)}"
        try:
            mode = os.stat(path).st_mode
            if stat.S_ISDIR(mode):
                refuse(place, f"{words} is a folder")
            if not stat.S_ISREG(mode) and (by is not None or not stat.S_ISFIFO(mode)):
                refuse(place, f"{words} is no regular file")
            key = os.path.realpath(path)
            if any(file.key == key for file in self._stack):
                chain = " -> ".join([*(file.name for file in self._stack), name])
                refuse(place, f"the files include one another in a circle: {chain}")
            handle = open(path, "rb", buffering=1 << 18)  # noqa: SIM115 - closed by __exit__
        except (OSError, ValueError) as error:
            if isinstance(error, DeckError):
                raise
            reason = getattr(error, "strerror", None) or error
            refuse(place, f"{words} cannot be read: {reason}")
        file = _File(name, _raw_lines(handle), Path(os.path.dirname(path)), key)
        file.close = handle.close
        self._stack.append(file)

    def _next_raw(self) -> bytes | None:
        """The next raw line; `where` is its place."""
        while self._stack:
            file = self._stack[-1]
            try:
                raw = next(file.raw, None)
            except (OSError, UnicodeDecodeError) as error:
                refuse(Where(file.name, file.line + 1), f"cannot be read: {error}")
            if raw is not None:
                file.line += 1
                if file.line == 1:
                    raw = self._first(raw, file)
                return raw
            file.close()
            self._stack.pop()
        return None

    @staticmethod
    def _first(raw: bytes, file: _File) -> bytes:
        if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
            refuse(Where(file.name, 1), "the file is UTF-16 text, expected one byte a character")
        return raw.removeprefix(b"\xef\xbb\xbf")

    def next(self) -> tuple[str, Where] | None:
        """The next line that is no comment, blank or *INCLUDE, without its end; None at the end."""
        if self._waiting is not None:
            waiting, self._waiting = self._waiting, None
            self.where = waiting[1]
            return waiting
        while (raw := self._next_raw()) is not None:
            text = raw.strip()
            if not text or text.startswith(b"**"):
                continue
            file = self._stack[-1]
            where = Where(file.name, file.line)
            if len(raw) >= LONGEST:
                refuse(where, f"the line is longer than {LONGEST} characters")
            line = _decode(text)
            self.where = where
            if text[:1] == b"*" and _is_include(line):
                self._include(line, where)
                continue
            return line, where
        return None

    def push_back(self, line: tuple[str, Where]) -> None:
        """Makes `next` give this line once more."""
        self._waiting = line

    def skip(self) -> None:
        """Goes on to the next line that begins with a star, without looking at others."""
        if self._waiting is not None and self._waiting[0].startswith("*"):
            return
        self._waiting = None
        while self._stack:
            file = self._stack[-1]
            count = file.line
            try:
                for raw in file.raw:
                    count += 1
                    if b"*" in raw:
                        if count == 1:
                            raw = self._first(raw, file)
                        text = raw.lstrip()
                        if text[:1] == b"*" and text[:2] != b"**":
                            break
                else:
                    file.close()
                    self._stack.pop()
                    continue
            except (OSError, UnicodeDecodeError) as error:
                refuse(Where(file.name, count + 1), f"cannot be read: {error}")
            finally:
                file.line = count
            where = Where(file.name, count)
            if len(raw) >= LONGEST:
                refuse(where, f"the line is longer than {LONGEST} characters")
            line = _decode(raw.strip())
            self.where = where
            if _is_include(line):
                self._include(line, where)
                continue
            self._waiting = line, where
            return

    def continued(self, text: str) -> str:
        """A keyword line with the lines that continue it, each after a comma at the end."""
        parts = [text]
        while parts[-1].endswith(","):
            line = self.next()
            if line is None:
                break
            if line[0].startswith("*"):
                self.push_back(line)
                break
            if sum(map(len, parts)) > LONGEST:
                refuse(line[1], f"the keyword line is longer than {LONGEST} characters")
            parts.append(line[0])
        return "".join(parts)

    def data(self) -> Iterator[tuple[str, Where]]:
        """Data lines up to the next keyword line."""
        while (line := self.next()) is not None:
            if line[0].startswith("*"):
                self.push_back(line)
                return
            yield line

    def _include(self, text: str, where: Where) -> None:
        file = self._stack[-1]
        while text.endswith(",") and len(text) < LONGEST:
            raw = next(file.raw, None)
            if raw is None:
                break
            file.line += 1
            text += _decode(raw.strip())
        parameters = Parameters("INCLUDE", split(text, where)[1:], _INCLUDE, where)
        if "PASSWORD" in parameters:
            refuse(where, "*INCLUDE: encrypted files are not read")
        if "INPUT" not in parameters:
            refuse(where, "*INCLUDE needs the parameter INPUT")
        given = parameters.get("INPUT")
        if len(self._stack) >= DEEPEST:
            refuse(where, f"*INCLUDE of {show(given)}: more than {DEEPEST} files in one another")
        self._open(self._find(given), given, where)

    def _find(self, given: str) -> Path:
        """The included file: beside the file that includes it, else beside the deck."""
        own = self._stack[-1].folder / given
        first = self._stack[0].folder / given
        try:
            return own if own.exists() or not first.exists() else first
        except (OSError, ValueError):
            return own


def _is_include(text: str) -> bool:
    word = text[1:].partition(",")[0]
    if word[:2].strip()[:1] not in ("I", "i"):
        return False
    wanted = squeeze(word)
    # INC is the beginning of other keywords too
    return len(wanted) >= 4 and choose(wanted, OURS) == "INCLUDE"


def _raw_lines(handle: BinaryIO) -> Iterator[bytes]:
    read = handle.readline
    while raw := read(LONGEST):
        yield raw
        while len(raw) == LONGEST and not raw.endswith(b"\n"):
            raw = read(LONGEST) or b"\n"


def _name_of(source: object) -> str:
    name = getattr(source, "name", None)
    return name if isinstance(name, str) else "deck"


def _checked(source: object, lines: Lines) -> Iterator[bytes]:
    """Lines of the caller as bytes; a text of several lines is several lines."""
    if isinstance(source, (bytes, bytearray)):
        source = bytes(source).split(b"\n")
    if not isinstance(source, Iterable):
        raise DeckError(
            "deck", 0, f"a {type(source).__name__} is given, expected a path or lines of text"
        )
    for count, item in enumerate(source, 1):
        if isinstance(item, str):
            raw = item.encode("utf-8", "surrogatepass")
        elif isinstance(item, (bytes, bytearray)):
            raw = bytes(item)
        else:
            raise DeckError(lines.name, count, f"{type(item).__name__} is no line of text")
        if b"\n" in raw[:-1]:
            yield from raw.removesuffix(b"\n").split(b"\n")
        else:
            yield raw


def _decode(raw: bytes) -> str:
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError:
        return raw.decode("latin-1")
