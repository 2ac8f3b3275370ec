# SPDX-License-Identifier: MIT
"""Whether two studies of the same say the same, conclusion by conclusion.

Errors, orders and verdicts have no clock in them: they must agree as they are. What depends on run
times need not be the same to the letter, since no limit on noisy times is without an edge: two
studies agree if neither is contradicted by the times of the other. A run that one recommends must
reach the same error in the other, and not be really slower there than others that do.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from usersub.study import orders, pareto, words
from usersub.study.pareto import Front

if TYPE_CHECKING:
    from usersub.study.result import Result

#: How much slower a run must be, over `pareto.slower`, to contradict another study: together with
#: `pareto.SAME` twice as slow, beyond twice what each run's own times are spread.
DOUBT = 1.6

#: Verdicts, the best first.
SAME, ALIKE, DIFFERS = "same", "as fast", "differs"

#: Errors that differ by more than this share are different conclusions, and so are limits.
_SHARE = 0.05
_ORDER = 0.15  # observed orders that are called the same


@dataclass(frozen=True)
class Conclusion:
    """One conclusion of two studies.

    Attributes:
        about: problem and law with what its errors are of, or what else was looked at.
        what: the question that is answered.
        here, there: the answers.
        verdict: `SAME`; `ALIKE`, if the answers are others that the times do not tell apart; or
            `DIFFERS`.
    """

    about: str
    what: str
    here: str
    there: str
    verdict: str


def compare(here: Iterable[Result], there: Iterable[Result]) -> list[Conclusion]:
    """The conclusions of two studies, of the points that both have."""
    mine, yours = _by_point(here), _by_point(there)
    both = [point for point in mine if point in yours]
    ours = pareto.fronts([mine[point] for point in both])
    theirs = {_kind(f): f for f in pareto.fronts([yours[point] for point in both])}
    found: list[Conclusion] = []
    for front in ours:
        other = theirs.pop(_kind(front), None)
        found += [_alone(front, True)] if other is None else _fronts(front, other)
    return [*found, *(_alone(front, False) for front in theirs.values())]


def unmatched(here: Iterable[Result], there: Iterable[Result]) -> tuple[int, int]:
    """How many points only one of the studies has."""
    mine, yours = _by_point(here).keys(), _by_point(there).keys()
    return len(mine - yours), len(yours - mine)


def _by_point(results: Iterable[Result]) -> dict[tuple[object, ...], Result]:
    """By what is run, not by its key: a routine may have changed, or moved, or the release."""
    return {_point(result): result for result in results}


def _point(run: Result) -> tuple[object, ...]:
    named = replace(run, routine=Path(run.routine).name if run.routine else "")
    return (*named.series, run.increments, run.block)


def _kind(front: Front) -> tuple[str, ...]:
    return front.problem, front.law, front.error_of, front.reference


def _alone(front: Front, here: bool) -> Conclusion:
    told = ("an error", "none") if here else ("none", "an error")
    return Conclusion(pareto.heading(front), "whether it ran", *told, DIFFERS)


def _fronts(here: Front, there: Front) -> list[Conclusion]:
    about = pareto.heading(here)
    found = []
    if here.runs and there.runs:
        found = [_recommended(about, target, here, there) for target in pareto.TARGETS]
        found += [_unbeaten(about, here, there), *_orders(about, here, there)]
    if here.refused or there.refused:
        found.append(_refused(about, here.refused, there.refused))
    return found


# What depends on run times.


def _recommended(about: str, target: float, here: Front, there: Front) -> Conclusion:
    what = f"for {words.number(target)}"
    mine, yours = here.reaching(target), there.reaching(target)
    if not mine and not yours:
        return _least(about, what, here, there)
    told = [words.named(found[0]) if found else "nothing" for found in (mine, yours)]
    if not (mine and yours):
        verdict = DIFFERS
    elif _point(mine[0]) == _point(yours[0]):
        verdict = SAME
    else:
        stands = _holds(mine[0], there, target) and _holds(yours[0], here, target)
        verdict = ALIKE if stands else DIFFERS
    return Conclusion(about, what, *told, verdict)


def _least(about: str, what: str, here: Front, there: Front) -> Conclusion:
    """The least errors, of which none is enough: equal ones of other methods are as good."""
    mine, yours = (min(front.runs, key=pareto.by_error) for front in (here, there))
    told = [
        f"nothing, the least is {words.number(run.error)} by {words.named(run)}"
        for run in (mine, yours)
    ]
    close = _close(mine.error, yours.error)
    return Conclusion(about, what, *told, SAME if close else DIFFERS)


def _holds(run: Result, front: Front, target: float) -> bool:
    """Whether a study does not contradict that this run is to be used for an error."""
    found = _found(run, front)
    reached = [r for r in front.runs if r.error <= target]
    return found in reached and not any(really_slower(found, other) for other in reached)


def _found(run: Result, front: Front) -> Result:
    """The same run in another study, which has it: only common points are compared."""
    return next((r for r in front.runs if _point(r) == _point(run)), run)


def really_slower(run: Result, other: Result) -> bool:
    """Whether a run is slower than another in a way that noise between two studies is not.

    Both spreads are taken twice: times of a study may all lie off by as much as they are apart.
    """
    return pareto.slower(_wider(run), _wider(other), DOUBT)


def _wider(run: Result) -> Result:
    low, high = pareto.interval(run)
    return replace(run, run_time_low=low * low / high, run_time_high=high * high / low)


def _unbeaten(about: str, here: Front, there: Front) -> Conclusion:
    """Whether what no other beats in one study is not beaten in the other."""
    wrong = {*_beaten(here, there), *_beaten(there, here)}
    told = []
    for front, other in ((here, there), (there, here)):
        common = set(map(_point, other.front))
        only = [run for run in front.front if _point(run) not in common]
        only.sort(key=lambda run: words.named(run) not in wrong)
        told.append(_counted(front.front, only))
    same = set(map(_point, here.front)) == set(map(_point, there.front))
    return Conclusion(about, "beaten by none", *told, DIFFERS if wrong else SAME if same else ALIKE)


def _beaten(one: Front, other: Front) -> list[str]:
    return [
        words.named(run)
        for run in one.front
        if any(
            rival.error <= _found(run, other).error and really_slower(_found(run, other), rival)
            for rival in other.runs
        )
    ]


# What does not.


def _orders(about: str, here: Front, there: Front) -> list[Conclusion]:
    mine, yours = ({_curve(c): c for c in orders.curves(front.runs)} for front in (here, there))
    found = []
    for name in dict.fromkeys([*mine, *yours]):
        told = [orders.order_words(c[name]) if name in c else "-" for c in (mine, yours)]
        a, b = (c[name].order if name in c else None for c in (mine, yours))
        near = a is not None and b is not None and abs(a - b) <= _ORDER
        verdict = SAME if near or told[0] == told[1] else DIFFERS
        interface, *rest = name
        what = f"order of {interface.upper()}, {', '.join(filter(None, rest))}"
        found.append(Conclusion(about, what, *told, verdict))
    return found


def _curve(curve: orders.Curve) -> tuple[str, ...]:
    single = "single precision" if curve.precision == "single" else ""
    return curve.interface, curve.method, single, f"over the {curve.against.partition(' [')[0]}"


def _refused(about: str, here: Sequence[Result], there: Sequence[Result]) -> Conclusion:
    mine, yours = set(map(_point, here)), set(map(_point, there))
    told = [
        _counted(runs, [run for run in runs if _point(run) not in others])
        for runs, others in ((here, yours), (there, mine))
    ]
    return Conclusion(about, "refused", *told, SAME if mine == yours else DIFFERS)


def _counted(runs: Sequence[Result], only: Sequence[Result], most: int = 3) -> str:
    """How many runs, and which of them the other study has not."""
    count = f"{len(runs)} run{'' if len(runs) == 1 else 's'}"
    names = [words.named(run) for run in only[:most]]
    names += [f"{len(only) - most} more"] * (len(only) > most)
    return f"{count}, alone here {'; '.join(names)}" if only else count


def _close(a: float | None, b: float | None) -> bool:
    if a is None or b is None:
        return a is b
    return a == b or abs(a - b) <= _SHARE * max(abs(a), abs(b))


# The other parts of a study.

_Row = Mapping[str, Any]
_CALLED = ("interface", "language", "precision")


def compare_extremes(
    here: Mapping[str, Sequence[_Row]], there: Mapping[str, Sequence[_Row]]
) -> list[Conclusion]:
    """Stiff and extreme cases, limits and savings of two studies, as `extremes.read` gives them."""
    parts: tuple[tuple[str, tuple[str, ...], Callable[[_Row], str], Callable[..., bool]], ...] = (
        ("cells", ("case", "value", "subject", *_CALLED), lambda row: str(row["verdict"]),
         lambda a, b: a["verdict"] == b["verdict"]),
        ("limits", ("name", "subject", *_CALLED), lambda row: words.number(row["measured"], 4),
         lambda a, b: _close(a["measured"], b["measured"])),
        ("savings", ("scene", "interface", "language"), lambda row: f"{row['bytes_needed']} of "
         f"{row['bytes_full']} bytes", lambda a, b: all(a[n] == b[n] for n in _SAVED)),
    )  # fmt: skip
    found = []
    for part, names, answer, agree in parts:
        mine, yours = (
            {tuple(str(row[n]) for n in names): row for row in rows.get(part, ())}
            for rows in (here, there)
        )
        for name in mine:
            if name in yours:
                a, b = mine[name], yours[name]
                verdict = SAME if agree(a, b) else DIFFERS
                found.append(Conclusion(_ABOUT[part], ", ".join(name), answer(a), answer(b),
                                        verdict))  # fmt: skip
    return found


_SAVED = ("bytes_needed", "bytes_full", "same_bits")
_ABOUT = {"cells": "stiff and extreme cases", "limits": "limits", "savings": "what is left out"}
