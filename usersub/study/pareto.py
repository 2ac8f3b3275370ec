# SPDX-License-Identifier: MIT
"""Which runs are worth choosing: those that no other beats in both error and run time."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from usersub.study.words import joined, language, law, named, number, seconds, short

if TYPE_CHECKING:
    from usersub.study.result import Result

#: Errors that are asked for, coarse to fine.
TARGETS = (1e-3, 1e-6, 1e-9)

#: Run times that overlap, or are within this factor of it, are called equal in words.
SAME = 1.25

_ALIKE = 4  # others that are told with a recommendation
_UNLIKE = 8  # contact points over those of other runs, from which run times are of other work


@dataclass(frozen=True)
class Front:
    """What can be compared with each other: runs of one problem and law with errors of one kind.

    Attributes:
        problem, law, error_of, reference: of all of them, as in `Result`.
        runs: those with an error and a run time, fastest first.
        front: of these, those that no other beats; equals are all on it. Fastest first.
        refused: did not run, or gave no finite error, in their order.
        blocks: runs with other contact points a call, that change nothing but the time; they are
            compared with each other alone.
    """

    problem: str
    law: str
    error_of: str
    reference: str
    runs: tuple[Result, ...]
    front: tuple[Result, ...]
    refused: tuple[Result, ...]
    blocks: tuple[Result, ...] = ()

    @property
    def title(self) -> str:
        """Problem and law, after the file of a routine."""
        files = {Path(run.routine).name for run in (*self.runs, *self.refused) if run.routine}
        named = f"{self.problem}, {law(self.law)}" if self.law else self.problem
        return ", ".join([*sorted(files), named])

    def reaching(self, target: float) -> list[Result]:
        """Runs with at most this error that cannot be told to be slower than the fastest of them.

        The one to recommend is first: with the least error of two digits, then by its name, so that
        noise of the clock does not choose.
        """
        reached = [run for run in self.runs if run.error <= target]
        fast = [run for run in reached if not any(slower(run, other) for other in reached)]
        return sorted(fast, key=by_error)


def by_error(run: Result) -> tuple[float, str, str]:
    """Order of runs without a clock: error of two digits, name."""
    return float(f"{run.error:.1e}"), named(run), run.key


def slower(run: Result, other: Result, doubt: float = 1.0) -> bool:
    """Whether a run is slower than another, by more than what is measured without a reason.

    The quarter of its run times that are least must be above the quarter of the other's that are
    largest, by more than the factor `SAME`.

    Args:
        doubt: by how much more, of what is told of two studies (`comparing`).
    """
    return interval(run)[0] > SAME * doubt * interval(other)[1]


def interval(run: Result) -> tuple[float, float]:
    """First and third quartile of the run time; its median where there are none."""
    low, high = run.run_time_low, run.run_time_high
    median = run.run_time_s
    return (low if low <= median else median), (high if high >= median else median)


def fronts(results: Iterable[Result]) -> list[Front]:
    """The fronts of all problems, in the order of the results.

    Points that were refused have no error that says what it is of; they are told with the first
    front of their problem and law.
    """
    results = list(results)
    ran = [result for result in results if usable(result)]
    refused: dict[tuple[str, str], list[Result]] = {}
    for result in results:
        if not usable(result):
            refused.setdefault((result.problem, result.law), []).append(result)
    kinds = list(dict.fromkeys((r.problem, r.law, r.error_of, r.reference) for r in ran))
    alone = [(*pair, "", "") for pair in refused if pair not in {kind[:2] for kind in kinds}]
    found = []
    for kind in [*kinds, *alone]:
        here = [r for r in ran if (r.problem, r.law, r.error_of, r.reference) == kind]
        # Where blocks alone were asked for, they are all that there is to compare.
        runs = sorted([r for r in here if r.block is None] or here, key=_order)
        told = refused.pop(kind[:2], ())
        blocks = [r for r in here if r.block is not None]
        found.append(Front(*kind, tuple(runs), tuple(best(runs)), tuple(told), tuple(blocks)))
    return found


def _order(run: Result) -> tuple[float, float, str]:
    return run.run_time_s, run.error, run.key


def usable(result: Result) -> bool:
    """Whether a result has an error and a run time that can be compared."""
    finite = 0.0 <= result.error < math.inf and 0.0 < result.run_time_s < math.inf
    return not result.refused and finite


def best(runs: Sequence[Result]) -> list[Result]:
    """Runs that no other beats, fastest first: none is as fast with less error, or the reverse.

    Two runs with the same error and run time do not beat each other.
    """
    front: list[Result] = []
    for run in sorted(runs, key=_order):
        last = front[-1] if front else None
        tied = last and (run.run_time_s, run.error) == (last.run_time_s, last.error)
        if last is None or run.error < last.error or tied:
            front.append(run)
    return front


def recommendation(front: Front, targets: Sequence[float] = TARGETS) -> list[str]:
    """What to use for each error, in sentences; targets with the same answer share one."""
    if not front.runs:
        return [f"Nothing ran: all {len(front.refused)} runs were refused."]
    answers: dict[str, list[float]] = {}
    alike: dict[str, str] = {}
    missed = []
    for target in sorted(targets, reverse=True):
        found = front.reaching(target)
        if found:
            answer = f"{named(found[0])}: {_measured(found[0])}"
            answers.setdefault(answer, []).append(target)
            alike[answer] = _alike(found)  # of the finest: it reaches the others too
        else:
            missed.append(target)
    sentences = [
        f"For {'an error' if len(wanted) == 1 else 'errors'} of "
        f"{joined([number(t) for t in wanted])} use {answer}.{alike[answer]}"
        for answer, wanted in answers.items()
    ]
    if missed:
        least = min(front.runs, key=by_error)
        sentences.append(
            f"Nothing reached {joined([number(t) for t in missed], 'or')}; the least error is "
            f"{_measured(least)} by {named(least)}."
        )
    sizes = sorted({run.points for run in front.runs if run.refined != "contact points"})
    if sizes and sizes[-1] >= _UNLIKE * sizes[0]:
        sentences.append(
            f"Runs have from {sizes[0]} to {sizes[-1]} contact points a call: their run times are "
            "not for the same work."
        )
    if front.refused:
        total = len({run.key for run in (*front.runs, *front.blocks, *front.refused)})
        were = "was" if len(front.refused) == 1 else "were"
        sentences.append(f"{len(front.refused)} of {total} runs {were} refused.")
    return sentences


def _alike(found: list[Result]) -> str:
    """What is as fast as the first run and reaches the same, without steps."""
    first, *others = found
    languages: dict[tuple[str, str], list[str]] = {}
    for run in others:
        if run.series != first.series:
            series = languages.setdefault((run.interface.upper(), short(run)), [])
            series += [language(run.language)] * (language(run.language) not in series)
    alike = [f"{i} in {joined(sorted(ls))}, {m}" for (i, m), ls in sorted(languages.items())]
    more = len(alike) - _ALIKE
    alike[_ALIKE:] = [f"{more} more"] * (more > 0)
    return f" As fast: {'; '.join(alike)}." if alike else ""


def _measured(run: Result) -> str:
    return f"{number(run.error)} in {seconds(run.run_time_s)}"


def recommendations(
    results: Iterable[Result], targets: Sequence[float] = TARGETS
) -> list[tuple[str, list[str]]]:
    """Of every problem: its title with what its errors are of, and sentences."""
    return [(heading(front), recommendation(front, targets)) for front in fronts(results)]


def heading(front: Front) -> str:
    """Problem, law and what the errors are of."""
    if not front.error_of:
        return front.title
    against = "" if front.reference in ("", "exact") else f" against {front.reference}"
    return f"{front.title} (error of {front.error_of}{against})"
