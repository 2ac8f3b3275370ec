# SPDX-License-Identifier: MIT
"""A routine: user code behind one interface, ready to be called."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field

from usersub import abi

#: How an entry is called; the numbers are those of the C core (USUB_STYLE_...).
FULL, BLOCK, POINTS = 0, 1, 2

#: What a routine does with an argument; the numbers are those of `usub_routine_set_uses`.
UNUSED, READS, WRITES, READS_AND_WRITES = 0, 1, 2, 3


@dataclass(frozen=True)
class Entry:
    """An address that can be called: `style` FULL (published argument list with hidden character
    lengths), BLOCK (`int f(void **argv)`) or, for FRIC, POINTS (`int f(void **argv, const int64_t
    *stride, const int *points, int count, int *done)`, which is BLOCK for one contact point of the
    list after the other); `keep` keeps the code alive."""

    address: int
    style: int
    keep: object = field(default=None, compare=False, repr=False)


class RoutineMaker(ABC):
    """User code that stands behind several interfaces.

    Attributes:
        interfaces: their names.
        origin: where it comes from, "file:line".
    """

    interfaces: tuple[str, ...]
    origin: str

    @abstractmethod
    def behind(self, interface: str, *, generation: str | None = None) -> Routine:
        """The routine behind one of the interfaces."""


@dataclass(frozen=True)
class Routine:
    """User code behind one interface.

    Attributes:
        interface: interface and generation.
        language: "python", "c", "c++", "fortran", "library" or "pointer".
        name: for people: function name or file name.
        origin: where it comes from: "file:line", library path or "".
        make_entry: makes the entry for a precision ("double", "single").
        uses: per argument UNUSED, READS, WRITES or READS_AND_WRITES; None if not known.
        block_safe: FRIC_COEF may be called with more than one point a call.
        thread_safe: blocks may run in different threads.
        replay: makes the entry of a slower twin that records why it fails; None if there is none.
        after_call: to be called after each driver call; None where there is nothing to do. It hands
            lines on Fortran units 6 and 7 to the receiver of messages.
    """

    interface: abi.Interface
    language: str
    name: str
    origin: str
    make_entry: Callable[[str], Entry] = field(repr=False)
    uses: tuple[int, ...] | None = None
    block_safe: bool = False
    thread_safe: bool = False
    replay: Callable[[str], Entry] | None = field(default=None, repr=False)
    after_call: Callable[[], None] | None = field(default=None, compare=False, repr=False)

    def __repr__(self) -> str:
        name, place = self.interface.name.upper(), f" at {self.origin}" if self.origin else ""
        return (
            f"<{name} routine '{self.name}' ({self.interface.generation}, {self.language}){place}>"
        )

    def entry(self, precision: str = "double") -> Entry:
        """The entry for `precision`, compiled at the first request."""
        return self.make_entry(precision)
