# SPDX-License-Identifier: MIT
"""Finding things out about a subject in a child process: the routine may do there what it likes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from usersub.check.running import isolate
from usersub.check.subject import Around

if TYPE_CHECKING:
    from usersub.check.running.isolate import Outcome
    from usersub.check.subject import Subject

#: What is found out: everything of a subject that is plain data.
_FOUND = ("props", "states", "fields", "temperatures", "anisotropic", "origin")

#: Seconds in which a routine has to show that it damages memory.
_PROOF = 3.0

#: Looks at a subject, tells what is known so far, and returns what it found.
Search = Callable[["Subject", Callable[["Subject"], None]], "Subject"]


def apart(search: Search, subject: Subject, seconds: float) -> tuple[Subject, str]:
    """What `search` makes of the subject, and why it did not come to its end ("" if it did).

    Of a search that dies, what it told last is kept.

    Raises:
        RuntimeError: the search itself is wrong; the message has its traceback.
    """
    if subject.routine is not None:
        subject.routine.entry(subject.precision)  # compiled once, here, for all children

    def work(child: Any) -> None:
        found = search(subject, lambda so_far: child.say(_plain(so_far)))
        child.say(_plain(found))

    outcome = isolate.run(work, seconds)
    for said in outcome.said:
        if "error" in said:
            so_far = _restored(subject, outcome)
            if _damages(so_far):
                return so_far, "the routine touched memory outside of its arguments"
            raise RuntimeError(said["error"]["trace"])
    return _restored(subject, outcome), _why(outcome, seconds)


def _plain(subject: Subject) -> dict[str, Any]:
    return {
        "scales": asdict(subject.scales),
        "around": asdict(subject.around),
        "others": [asdict(around) for around in subject.others],
        **{name: getattr(subject, name) for name in _FOUND},
    }


def _damages(subject: Subject) -> bool:
    """Whether the routine touches memory that is not its own: a search in the same process may
    fail at anything then."""

    def work(child: Any) -> None:
        from usersub.check.subjects.values import path_case, watched

        error, _ = watched(subject, path_case())
        child.say({"outside": ", of which there " in str(error)})

    return any(said.get("outside") for said in isolate.run(work, _PROOF).said)


def _restored(subject: Subject, outcome: Outcome) -> Subject:
    known = [said for said in outcome.said if "props" in said]
    if not known:
        return subject
    said = dict(known[-1])
    scales = said.pop("scales")
    scales["fields"] = tuple(scales["fields"])
    said["props"] = tuple(said["props"])
    said["around"] = around_from(said["around"])
    said["others"] = tuple(map(around_from, said["others"]))
    return subject.but(scales=type(subject.scales)(**scales), **said)


def around_from(plain: dict[str, Any]) -> Around:
    """Names and step numbers from plain data."""
    return Around(**{name: tuple(value) for name, value in plain.items()})


def _why(outcome: Outcome, seconds: float) -> str:
    if outcome.how == "time":
        return f"the routine did not return within {seconds:g} s"
    if outcome.how == "signalled":
        return f"the routine crashed with {outcome.signal_name}"
    if outcome.how == "exited":
        return "the routine ended the process"
    return ""
