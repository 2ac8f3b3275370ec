# SPDX-License-Identifier: MIT
"""What a routine reads, found by running it: properties, state and field variables, temperatures.

It starts from nothing and grows: a fault names the element that was meant, a refusal is answered
with one more. What was found, and how, stands in `Subject.origin` in words.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from usersub.check.probing import influence
from usersub.check.respond.answer import Answer
from usersub.check.subjects import around, law_subject, values, wants
from usersub.check.subjects.apart import apart

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.subject import Subject
    from usersub.errors import Error

#: Attributes of a subject that are counted.
_COUNTED = ("props", "states", "fields")
_WORDS = {"props": "properties", "states": "state variables", "fields": "field variables"}
#: Arguments that are temperatures, newer spelling; TEMP of FRIC is there in every scene.
_HEAT = frozenset({"TEMP", "tempAvg", "tempSec", "tempMain"})
_STATELESS = ("vfric_coef", "fric_coef")
#: How often a routine may ask for more, and how many it is offered where it does not say.
_GROWTHS, _OFFERED = 80, 24
#: What is said of a routine that fails with all that it asked for.
_FAILS = "it fails all the same, with"
#: So many are not read one after the other.
_ENOUGH = 40
#: How many more than it needs a routine is offered, to see whether it takes them.
_MORE = 5
#: Numbers of properties that are offered to a routine that asks for none and gives no friction.
_UNASKED = (1, 2, 3, 4, 6, 8)
#: Time limit of the search.
_SECONDS = 9.0


def find(subject: Subject, *, given: set[str]) -> Subject:
    """The subject with the properties, states, fields and temperatures that the routine reads.

    Args:
        given: names of the attributes that stay as they are ("props", "states", "fields",
            "temperatures", "anisotropic").
    """
    if subject.routine is None:
        return subject
    subject = _told(subject, **dict.fromkeys(given, "given"))
    name = subject.law or law_subject.recognised(subject.path)
    if name:
        return law_subject.with_example(subject, name, given)
    found, why = apart(_Tracer(given).find, subject, _SECONDS)
    if not why and any(_FAILS in words for words in found.origin.values()):
        # What a routine keeps of its first call may be what the search began with.
        found, why = apart(_Tracer(given).again, found, _SECONDS)
    if why:
        names = [n for n in (*_COUNTED, "temperatures") if not found.origin.get(n)]
        found = _told(found, **dict.fromkeys(names, f"not found out: {why} while it was traced"))
    return found


class _Tracer:
    """The search for one routine."""

    def __init__(self, given: set[str]) -> None:
        self.given, self.endless = set(given), set[str]()
        self.read: frozenset[str] = frozenset()

    def find(self, subject: Subject, tell: Callable[[Subject], None]) -> Subject:
        """What `find` finds; `tell` is told what is known so far."""
        if subject.interface.key in _STATELESS:
            self.given.add("states")
            subject = _told(subject.but(states=0), states="the interface has none")
        start = {
            "props": () if "props" not in self.given else subject.props,
            "states": 0 if "states" not in self.given else subject.states,
            "fields": 0 if "fields" not in self.given else subject.fields,
            "temperatures": "temperatures" not in self.given or subject.temperatures,
        }
        self.tell = tell
        try:
            return self._found(subject.but(**start))
        except values.Endless as endless:
            names = [n for n in (*_COUNTED, "temperatures") if n not in self.given]
            return _told(self.last, **dict.fromkeys(names, f"not found out: {endless}"))

    def again(self, subject: Subject, tell: Callable[[Subject], None]) -> Subject:
        """What was found, looked at in a process that did not call the routine before."""
        self.tell = tell
        try:
            if self._failure(subject) is not None:
                return subject
            needs = {name: counted(subject, name) for name in _COUNTED}
            names = [n for n in (*_COUNTED, "temperatures") if n not in self.given]
            subject = _told(subject, **dict.fromkeys(names, ""))
            if "props" not in self.given:
                subject = self._valued(subject)
            return self._words(self._heat(subject), needs, None)
        except values.Endless:
            return subject

    def _found(self, subject: Subject) -> Subject:
        self._tell(subject)
        if "around" not in self.given:
            subject = subject.but(others=around.others(subject))
        subject, failure = self._grown(subject)
        if failure is not None and subject.props and "props" not in self.given:
            subject, failure = self._with_other_values(subject, failure)
        if "around" not in self.given and failure is None:
            # Without what it needs it fails in the same way whatever the names are.
            subject, failure = self._grown(subject.but(others=around.others(subject)))
        needs = {name: counted(subject, name) for name in _COUNTED}
        self._tell(subject)
        if self._repeats(subject):
            subject = self._more(subject)
        subject = around.with_friction(subject)
        if subject.others:
            subject = _told(subject, names="they change what the routine does; tried were strings "
                            "of its source and later steps")  # fmt: skip
        if "props" not in self.given:
            subject = self._valued(subject)
            needs["props"] = max(needs["props"], len(subject.props))
        self._tell(subject)
        return self._words(self._heat(subject), needs, failure)

    def _valued(self, subject: Subject) -> Subject:
        """Values of the properties; a routine without friction is offered some that it takes."""
        if not subject.props:
            return subject if values.cost(subject) == 0.0 else self._with_friction(subject)
        found, why = values.choose(subject, grow=self._asked)
        if values.cost(found) not in (0.0, values.AGAINST):
            more = self._with_friction(found)
            if more != found:
                return more
        return _told(found, props=why)

    def _with_friction(self, subject: Subject) -> Subject:
        """A routine that takes as many properties as there are may do nothing without any."""
        for count in [n for n in _UNASKED if n > len(subject.props)]:
            sized = _sized(subject, "props", count)
            error, _ = values.watched(sized, values.path_case())
            if error is not None and re.search(r"\bprops\(", str(error), re.IGNORECASE):
                continue
            tried, why = values.choose(sized, grow=self._asked, most=4)
            if values.cost(tried) == 0.0:
                self.endless.add("props")
                return _told(tried, props=f"with fewer there is no ordinary friction; {why}")
        return subject

    def _asked(self, subject: Subject) -> Subject:
        """The subject with what the routine asks for in the first case."""
        for _ in range(_GROWTHS):
            error = _failed(values.answers(subject, values.path_case()))
            if error is None:
                return subject
            grown = self._as_wanted(subject, wants.wanted(subject, error))
            if grown is None:
                return subject
            subject = grown
        return subject

    def _tell(self, subject: Subject) -> None:
        self.last = subject
        self.tell(subject)

    # Growth.

    def _grown(self, subject: Subject) -> tuple[Subject, Error | None]:
        """The subject with all that the routine asked for; the failure that is left."""
        failure = self._failure(subject)
        for _ in range(_GROWTHS):
            if failure is None:
                return subject, None
            grown = self._as_wanted(subject, wants.wanted(subject, failure))
            if grown is not None:
                endless = self._always_one_more(subject, grown)
                if endless:
                    self.given.add(endless)
                    said = f"the routine asks for one more of the {_WORDS[endless]} than it gets"
                    subject = _told(_sized(subject, endless, 1), **{endless: said})
                    self._tell(subject)
                    failure = self._failure(subject)
                    continue
                subject, failure = grown, self._failure(grown)
                self._tell(subject)
                continue
            grown, failure = self._offered(subject, failure)
            if grown is None:
                return subject, failure
            subject = grown
        return subject, failure

    @staticmethod
    def _always_one_more(before: Subject, after: Subject) -> str:
        """What the routine has been given too often, each time one more."""
        for name in _COUNTED:
            if counted(after, name) == counted(before, name) + 1 > _ENOUGH:
                return name
        return ""

    def _with_other_values(self, subject: Subject, failure: Error) -> tuple[Subject, Error | None]:
        """With other values a routine that refused may go on, and read more."""
        for props in values.alternatives(subject.props):
            tried = subject.but(props=props)
            quick = _failed(values.answers(tried, values.path_case()))
            if quick is None or _reason(quick) != _reason(failure):
                return self._grown(tried)
        return subject, failure

    def _failure(self, subject: Subject) -> Error | None:
        """The first failure over the cases that is about sizes, else that of the first case."""
        first: Error | None = None
        for number, place in enumerate((subject.around, *subject.others)):
            at_place = self._failure_at(subject.but(around=place), first is None and not number)
            if at_place is not None and self._as_wanted(subject, wants.wanted(subject, at_place)):
                return at_place
            first = first or at_place
        return first

    def _failure_at(self, subject: Subject, ordinary: bool) -> Error | None:
        """As `_failure`, at the subject's own names and step numbers."""
        first = None
        for number, case in enumerate(_cases()):
            error, read = values.watched(subject, case)
            self.read |= read
            if error is not None and self._as_wanted(subject, wants.wanted(subject, error)):
                return error
            error = _failed(values.answers(subject, case))
            if error is not None:
                if self._as_wanted(subject, wants.wanted(subject, error)) is not None:
                    return error
                if number == 0 and ordinary:
                    first = error
        return first

    def _as_wanted(self, subject: Subject, wanted: wants.Wanted) -> Subject | None:
        """The subject with what was wanted; None if that is nothing or was given otherwise."""
        grown = subject
        for name, count in wanted.counts:
            if name not in self.given and counted(subject, name) < count:
                grown = _sized(grown, name, count)
        if wanted.temperatures and "temperatures" not in self.given:
            grown = grown.but(temperatures=True)
        if wanted.anisotropic and "anisotropic" not in self.given:
            grown = grown.but(anisotropic=True)
        return None if grown == subject else grown

    def _offered(self, subject: Subject, failure: Error) -> tuple[Subject | None, Error | None]:
        """What a routine that refused accepts, or at least refuses in other words."""
        for offer in self._offers(subject, str(failure)):
            quick = _failed(values.answers(offer, values.path_case()))
            if quick is not None and _reason(quick) == _reason(failure):
                continue
            now = self._failure(offer)
            if now is None or _reason(now) != _reason(failure):
                return offer, now
        return None, failure

    def _offers(self, subject: Subject, text: str) -> Iterator[Subject]:
        topic = wants.about(text)
        for name in dict.fromkeys([topic, *_COUNTED] if topic else _COUNTED):
            if name in self.given:
                continue
            now = counted(subject, name)
            likely = [n for n in wants.numbers_in(text) if n > now]
            steps = range(now + 1, now + 1 + (_OFFERED if name != "fields" else 4))
            for count in dict.fromkeys((*likely, *steps)):
                yield _sized(subject, name, count)

    # More than it needs.

    def _repeats(self, subject: Subject) -> bool:
        """Whether two runs give the same; else nothing can be told from differences."""
        case = values.path_case()
        return influence.same(values.answers(subject, case), values.answers(subject, case))

    def _more(self, subject: Subject) -> Subject:
        """The subject with what the routine takes although it runs without."""
        for name in ("states", "fields", "props"):
            if name in self.given:
                continue
            count = counted(subject, name)
            offered = _sized(subject, name, count + _MORE)
            # With state variables a routine may read more properties.
            offered, failure = self._grown(offered)
            if failure is not None or counted(offered, name) != count + _MORE:
                continue
            highest = self._highest(offered, name, count)
            if highest == count + _MORE:  # as many as it gets
                self.endless.add(name)
                highest = max(count, 2) if name != "props" else count
            if highest > count:
                subject = _sized(offered, name, highest)
        return subject

    def _highest(self, subject: Subject, name: str, least: int) -> int:
        """Number of the last one that makes a difference, at least `least`."""
        matter = {
            "props": values.matters,
            "states": influence.state_matters,
            "fields": influence.field_matters,
        }[name]
        count = counted(subject, name)
        return next((k for k in range(count, least, -1) if matter(subject, k - 1)), least)

    # Words.

    def _heat(self, subject: Subject) -> Subject:
        """Temperatures only where they are read."""
        if "temperatures" in self.given:
            return subject
        without = subject.but(temperatures=False)
        fails = self._failure(subject) is None and self._failure(without) is not None
        if fails or self.read & _HEAT:
            return _told(subject, temperatures="traced: the routine reads temperatures")
        if not self._repeats(subject):
            return _told(
                subject, temperatures="the scene has them: not known whether they are read"
            )
        case = values.path_case()
        # The means and the differences of both surfaces change.
        hot = [replace(s, temperature=((57.0, 31.0 + k),)) for k, s in enumerate(case.steps)]
        present = values.answers(subject, case)
        if influence.same(present, values.answers(subject, case.but(steps=tuple(hot)))):
            return _told(without, temperatures="traced: no reading of temperatures was seen")
        return _told(subject, temperatures="traced: friction changes with the temperatures")

    def _words(self, subject: Subject, needs: dict[str, int], failure: Error | None) -> Subject:
        for name in _COUNTED:
            if name not in self.given:
                said = _in_words(name, needs[name], counted(subject, name), name in self.endless)
                if failure is not None:
                    said += f"; {_FAILS} {_reason(failure)}"
                parts = (said, subject.origin.get(name, ""))
                subject = _told(subject, **{name: "; ".join(filter(None, parts))})
        if subject.anisotropic and "anisotropic" not in self.given:
            subject = _told(subject, anisotropic="traced: the routine sets both coefficients")
        return subject


def counted(subject: Subject, name: str) -> int:
    """How many properties, state or field variables the subject has."""
    return len(subject.props) if name == "props" else int(getattr(subject, name))


def _sized(subject: Subject, name: str, count: int) -> Subject:
    if name != "props":
        return subject.but(**{name: count})
    return subject.but(props=(*subject.props, *values.first(count)[len(subject.props) :])[:count])


def _told(subject: Subject, **said: str) -> Subject:
    return subject.but(origin={**subject.origin, **said})


def _cases() -> Iterator[Case]:
    """Histories that reach the branches of an ordinary law with one point."""
    yield values.path_case()
    yield values.path_case((1e-2, 0.0, -1e-2), load=10.0)
    yield values.path_case((1e-2, 1e-2), load=0.0)


def _failed(given: list[Answer]) -> Error | None:
    return next((a.failure for a in given if a.failure is not None), None)


def _reason(failure: Error) -> str:
    """The words of a failure without the place."""
    text = str(failure).partition("(routine '")[0]
    return text.partition("the routine ended with ")[2].strip() or text.strip()


def _in_words(name: str, needs: int, taken: int, endless: bool) -> str:
    """How a count was found, in words."""
    words = _WORDS[name]
    if endless:
        return f"traced: the routine takes as many {words} as there are; it was given {taken}"
    if not taken:
        return f"traced: the routine reads no {words}"
    first = "props(1)" if name == "props" else f"{taken} of the {words}"
    if name == "props":
        first += f" to props({taken})" if taken > 1 else ""
    elif taken == 1:
        first = f"one of the {words}"
    if needs == taken:
        return f"traced: the routine reads {first}"
    without = f"with {needs or 'none'}"
    return f"traced: the routine reads {first} where there are any, and goes on {without}"
