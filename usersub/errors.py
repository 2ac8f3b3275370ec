# SPDX-License-Identifier: MIT
"""Exceptions of usersub. Every message names the thing, its value and what was expected."""

from __future__ import annotations


class Error(Exception):
    """Base of all exceptions of usersub.

    Attributes:
        status: the C core's status code (`usersub.statuses`), or None.
    """

    status: int | None = None


class SceneError(Error, ValueError):
    """A setting, array or call of the host is wrong; nothing has changed."""


class AbiError(Error):
    """Two parts do not fit: argument counts, generations, table versions, precisions."""


class CompileError(Error):
    """A compiler or translator refused user code; the message has file, line and its words."""


class MissingTool(Error):  # noqa: N818 - reads as a sentence
    """A compiler or an optional package is missing; the message says how to get it."""


class LoadError(Error):
    """A file or library cannot be loaded or holds no interface."""


class RoutineError(Error):
    """User code raised, stopped, crashed or returned NaN; the driver's state is as before.

    Attributes:
        point: contact point (from 0), or None if it is not known.
        argument: argument that it is about, newer spelling, or "" (checked drivers; so are the
            others).
        element: its element, from 0 in the order of memory, or None.
        index: the same in Fortran's indices, from 1, or None.
        access: "read", "written" or "".
        where: "file:line" of the source, or "".
    """

    point: int | None = None
    argument: str = ""
    element: int | None = None
    index: tuple[int, ...] | None = None
    access: str = ""
    where: str = ""


class ContractError(RoutineError):
    """User code broke a rule of its interface."""


class DeckError(Error, ValueError):
    """An input deck says what cannot be.

    Attributes:
        file: name of the deck or of a file that it includes.
        line: number of the line, from one; 0 where the file as a whole is meant.
        reason: the sentence without the place.
    """

    def __init__(self, file: str, line: int, reason: str) -> None:
        super().__init__(file, line, reason)
        self.file, self.line, self.reason = file, line, reason

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}" if self.line else self.file
        return f"{place}: {self.reason}"


class StateError(Error, ValueError):
    """Saved state does not fit: version, byte order, sizes or check sum."""
