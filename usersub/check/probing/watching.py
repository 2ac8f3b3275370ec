# SPDX-License-Identifier: MIT
"""What the checked drivers see while a case runs."""

from __future__ import annotations

import linecache
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from usersub.check.respond import run_of
from usersub.check.rule import Finding
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.respond import Run
    from usersub.check.subject import Subject

#: Faults of memory: what is touched that is not the routine's.
MEMORY = ("outside", "left out", "red zone")

_PLACE = re.compile(r"[^\s,()]+\.py:\d+")


@dataclass(frozen=True)
class Seen:
    """A fault that a checked driver saw.

    Attributes:
        what: kind of fault, as in `usersub.driver.observed`.
        argument: the argument, newer spelling, or "" if it is not known.
        sentence: all of it in words.
        where: "file:line", or "".
        step: step of the case.
        point: contact point, or None.
    """

    what: str
    argument: str
    sentence: str
    where: str
    step: int
    point: int | None = None

    def finding(self, hint: str = "") -> Finding:
        """The fault as a finding."""
        figures = {"step": self.step}
        if self.point is not None and self.point >= 0:
            figures["point"] = self.point
        return Finding(self.sentence, where=self.where, hint=hint, figures=figures)


#: What cases have shown in this process, so that rules that ask for different faults share runs;
#: the subject is kept, since its identity is part of the key.
_SHOWN: dict[tuple, tuple[Subject, tuple[Seen, ...]]] = {}


def watch(subject: Subject, case: Case, what: Iterable[str], **options: object) -> Seen | None:
    """The first fault of the kinds `what` that a case shows; None if there is none.

    A fault that fails the call ends the case, since nothing is known of the steps after it.
    """
    wanted = frozenset(what)
    chosen = {"checked": 1, "enforced": True, **options}
    key = (id(subject), case, tuple(sorted(chosen.items())))
    if key not in _SHOWN:
        subject.under_way(case)
        _SHOWN[key] = subject, tuple(_run(subject, case, chosen))
    return next((seen for seen in _SHOWN[key][1] if seen.what in wanted), None)


def _run(subject: Subject, case: Case, options: dict[str, object]) -> Iterator[Seen]:
    """Everything that a case shows, until the routine fails."""
    run = run_of(subject, case, **options)  # type: ignore[arg-type]
    for index in range(len(case.steps)):
        failure = None
        try:
            run.step(index)
        except Error as error:
            failure = error
        seen = _seen(subject, run, index, failure)
        if seen is not None:
            yield seen
        if failure is not None:
            return


def _seen(subject: Subject, run: Run, step: int, failure: Error | None) -> Seen | None:
    """What the driver saw in the last step. Compiled Python looks at its indices itself."""
    if isinstance(failure and failure.__cause__, IndexError):
        place = _PLACE.search(str(failure))
        where = place[0] if place else ""
        argument = _indexed(subject, where, str(failure))
        return Seen("outside", argument, str(failure), where, step)
    seen = run.observed()
    if seen.what == "nothing":
        return None
    return Seen(seen.what, seen.argument, seen.sentence, seen.where, step, seen.point)


def _indexed(subject: Subject, where: str, words: str) -> str:
    """The argument whose element a line of Python names, if only one can be meant."""
    file, _, line = where.rpartition(":")
    text = linecache.getline(file, int(line)) if line.isdigit() else ""
    names = {s: a.modern for a in subject.interface.args for s in a.spellings}
    used = {n: index for n, index in re.findall(r"(\w+)\s*\[([^\]]*)\]", text) if n in names}
    if len(used) > 1 and (beyond := re.search(r"index (-?\d+) is out of bounds", words)):
        # An index that is written out tells which of several it is.
        used = {n: i for n, i in used.items() if re.search(rf"(?<!\w){beyond[1]}(?!\w)", i)}
    return names[next(iter(used))] if len(used) == 1 else ""
