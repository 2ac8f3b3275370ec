# SPDX-License-Identifier: MIT
"""What is not said of a subject is found out by running its routine, in a child process."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from usersub.check.running import isolate
from usersub.check.running.verdicts import death_of, error_words
from usersub.check.subject import Scales
from usersub.check.subjects import scales, tracing
from usersub.check.subjects.apart import around_from
from usersub.check.subjects.targets import GIVEN

if TYPE_CHECKING:
    from usersub.check.running.inside import Channel
    from usersub.check.subject import Subject

_NAMES = ("props", "states", "fields", "temperatures", "anisotropic", "law", "origin")


def prepared(subject: Subject, seconds: float) -> Subject:
    """The subject with all that was not given found out: sizes first, then scales.

    A routine that does not let itself be run keeps what was found before, and the subject's
    `origin` says why there is no more.
    """
    if subject.routine is None:
        return subject
    given = {name for name in subject.origin if name in GIVEN}

    def work(child: Channel) -> None:
        found = tracing.find(subject.but(tell=child.tell), given=given)
        child.say(_plain(found))
        if "scales" not in given:
            child.say(_plain(scales.find(found)))

    outcome = isolate.run(work, seconds)
    for said in outcome.said:
        if "props" in said:
            subject = _applied(subject, said)
    death = death_of(outcome)
    error: dict[str, str] = next((s["error"] for s in outcome.said if "error" in s), {})
    if death is None and not error:
        return subject
    words = f"the routine {death.words}" if death else error_words(error)
    missing = [n for n in ("props", "states", "fields", "temperatures") if n not in subject.origin]
    names = [*missing, *(("scales",) if "scales" not in subject.origin else ())]
    said = f"default, since it could not be found out: {words}"
    return subject.but(origin={**subject.origin, **dict.fromkeys(names, said)})


def _plain(subject: Subject) -> dict[str, Any]:
    return {
        **{n: getattr(subject, n) for n in _NAMES},
        "scales": asdict(subject.scales),
        "around": asdict(subject.around),
        "others": [asdict(around) for around in subject.others],
    }


def _applied(subject: Subject, said: dict[str, Any]) -> Subject:
    values = {name: said[name] for name in _NAMES}
    values["props"] = tuple(values["props"])
    values["around"] = around_from(said["around"])
    values["others"] = tuple(map(around_from, said["others"]))
    sizes = dict(said["scales"])
    sizes["fields"] = tuple(sizes["fields"])
    return subject.but(**values, scales=Scales(**sizes))
