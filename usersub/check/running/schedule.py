# SPDX-License-Identifier: MIT
"""Which rules are looked at in which child processes.

A process costs more than most rules, so rules share one, where that cannot change what they see:
a routine that keeps nothing between calls, and rules that neither need a routine that was never
called before nor are likely to die. If one dies all the same, those behind it get a new process.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

from usersub.check.rule import Rule
from usersub.check.running import isolate
from usersub.check.running.look import look_at_all

if TYPE_CHECKING:
    from usersub.check.subject import Subject

#: Rules, by identifier or group, with a process of their own.
_ALONE = ("repeat", "history", "process", "data.uninitialised", "memory.heap", "memory.stack")
#: Processes that rules are spread over for each worker, so that all workers end together.
_SPREAD = 2

Job = tuple[tuple[Rule, ...], isolate.Work, float]


class Schedule(Iterator[Job]):
    """Jobs for `isolate.run_all`; it may give more after it gave none.

    Args:
        subject: what is checked.
        rules: those to look at, in their order.
        workers: processes at a time.
        limit: time limit of a rule as things stand.
        open: called with a rule before it is looked at; False leaves it out.
        until: when no further rule is begun, by `time.monotonic`.
    """

    def __init__(
        self,
        subject: Subject,
        rules: Sequence[Rule],
        workers: int,
        limit: Callable[[Rule], float],
        open: Callable[[Rule], bool],
        until: float,
    ) -> None:
        self._subject, self._limit, self._open, self._until = subject, limit, open, until
        shares = subject.routine is None or subject.routine.thread_safe
        self._queue = deque(_batches(rules, workers if shares else 0))

    def __next__(self) -> Job:
        while self._queue:
            rules = tuple(rule for rule in self._queue.popleft() if self._open(rule))
            if rules:
                limits = [self._limit(rule) for rule in rules]
                work = partial(look_at_all, rules, limits, self._until, self._subject)
                return rules, work, limits[0]
        raise StopIteration

    def again(self, rules: Sequence[Rule], alone: bool) -> None:
        """Puts rules in front: one process each, or one for all."""
        batches = [(rule,) for rule in rules] if alone else [tuple(rules)]
        self._queue.extendleft(reversed(batches))

    def separate(self) -> None:
        """From now on every rule has its own process: the routine damages what is around it."""
        self._queue = deque((rule,) for batch in self._queue for rule in batch)


def _batches(rules: Sequence[Rule], workers: int) -> Iterator[tuple[Rule, ...]]:
    """Rules that share a process, in their order; each its own where there are no workers."""
    sharing = [r for r in rules if workers and r.id not in _ALONE and r.group not in _ALONE]
    size = max(1, -(-len(sharing) // (_SPREAD * workers))) if sharing else 1
    batch: list[Rule] = []
    for rule in rules:
        if rule not in sharing:
            yield (rule,)
            continue
        batch.append(rule)
        if len(batch) == size:
            yield tuple(batch)
            batch = []
    if batch:
        yield tuple(batch)
