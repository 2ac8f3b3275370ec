# SPDX-License-Identifier: MIT
"""Agreement with a built-in law that the routine claims to be."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from usersub import laws
from usersub.check import cases
from usersub.check.agreement import refusals
from usersub.check.agreement import samples as law_samples
from usersub.check.agreement import truth as law_truth
from usersub.check.agreement.compare import Comparison, Scales, Way, respond_to, tolerance, worst
from usersub.check.rule import CannotCheck, Finding, NotApplicable, rule
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.subject import Subject
    from usersub.laws.description import Law


#: Of so many properties one has extreme motions, too.
_EXTREME_EVERY = 10


def _cases(subject: Subject) -> Iterator[Case]:
    law = _law(subject)
    try:
        law.of(subject.props)
    except Error as error:
        raise CannotCheck(f"the properties are not those of {law.name}: {error}") from error
    for entry in law_truth.known(subject, law):
        yield entry.case
    yield from cases.common(subject)
    yield from refusals.too_few(subject, law)
    for seed, values in enumerate(law_samples.props(law), 1):
        yield from law_samples.histories(subject, law, values, seed)
        # Forces that are products of motions; rates that overflow nobody could pass on.
        if law.kind == "bristle" and seed % _EXTREME_EVERY == 1:
            yield from law_samples.extremes(subject, law, values, seed)
    for seed, values in enumerate(law_samples.corners(law), 1):
        yield law_samples.with_rest(subject, law, values, seed)


def _law(subject: Subject) -> Law:
    if not subject.law:
        raise NotApplicable("no built-in law was named with --law")
    try:
        law = laws.law(subject.law)
        law.check(subject.interface.name)
    except Error as error:
        raise CannotCheck(str(error)) from error
    return law


@rule(
    "law.agrees",
    "The routine answers what the built-in law that it claims to be answers.",
    reference="the README and reference values of the law",
    cases=_cases,
    seconds=30.0,
)
def agrees(subject: Subject, case: Case) -> Finding | None:
    """Compares with the law as it is shipped, and with its reference values."""
    law = _law(subject)
    if case.props is not None and not _takes(law, case.props):
        return refusals.finding(subject, law, case)
    ours = law_truth.sized(subject, law, case)
    exact = _exact_values(subject, law, case)
    if exact is not None:
        found = _compare_known(ours, law, case, exact)
        if found is not None:
            return found
    truth = law_truth.sized(law_truth.twin(subject, law), law, case)
    for options in _ways(subject, case):
        comparison = Comparison(ours, truth, law, case, options)
        comparison.layout = _same_layout(subject, law)
        found = comparison.finding()
        if found is not None:
            return found
    return None


def _takes(law: Law, props: Sequence[float]) -> bool:
    try:
        law.of(props)
    except Error:
        return False
    return True


def _ways(subject: Subject, case: Case) -> Iterator[Way]:
    name = subject.interface.name
    yield Way()
    if name == "fric" and case.directions == 2:
        yield Way(turned=True)
    if name == "fric_coef":
        yield Way(enforced=True)


#: By routine: whether its state variables are those of the law. Kept with the routine, so that an
#: address is not used twice.
_LAYOUTS: dict[int, tuple[object, bool]] = {}


def _same_layout(subject: Subject, law: Law) -> bool:
    """Whether the state variables of the routine are those of the law, in its order: they agree
    after some increment of a plain history."""
    key = id(subject.routine)
    if key not in _LAYOUTS:
        _LAYOUTS[key] = subject.routine, _states_agree(subject, law)
    return _LAYOUTS[key][1]


def _states_agree(subject: Subject, law: Law) -> bool:
    if subject.interface.name == "vfric_coef":
        return False
    for case in (cases.sticking(subject), cases.slipping(subject)):
        ours = respond_to(law_truth.sized(subject, law, case), case, Way())
        truth = law_truth.sized(law_truth.twin(subject, law), law, case)
        for one, other in zip(ours, respond_to(truth, case, Way()), strict=False):
            if one.state is None or other.state is None or not other.state.any():
                continue
            size, count = np.abs(other.state).max(), len(other.state)
            if np.allclose(one.state[:count], other.state, rtol=1e-4, atol=1e-6 * size):
                return True
    return False


# Reference values.


def _exact_values(
    subject: Subject, law: Law, case: Case
) -> tuple[dict[str, np.ndarray], ...] | None:
    return _table(law.name, subject.interface.name, subject.precision, subject).get(case)


_TABLES: dict[tuple[str, str, str], dict[Case, tuple[dict[str, np.ndarray], ...]]] = {}


def _table(
    name: str, interface: str, precision: str, subject: Subject
) -> dict[Case, tuple[dict[str, np.ndarray], ...]]:
    key = (name, interface, precision)
    if key not in _TABLES:
        entries = law_truth.known(subject, laws.law(name))
        _TABLES[key] = {e.case: e.values for e in entries}
    return _TABLES[key]


def _compare_known(
    ours: Subject, law: Law, case: Case, exact: tuple[dict[str, np.ndarray], ...]
) -> Finding | None:
    """Against values of arbitrary precision."""
    found = respond_to(ours, case, Way())
    relative = tolerance(law, ours.precision)
    scales = Scales(case, law, ours.props, ours.precision)
    comparison = Comparison(ours, ours, law, case, Way())
    for index, values in enumerate(exact):
        if index >= len(found) or found[index].failure is not None:
            return comparison.failed(found[-1].failure, index)
        given = found[index].arrays()
        for name, wanted in values.items():
            if name not in given or name == "state":
                continue
            off = worst(given[name], wanted, relative * scales.of(name, index, wanted))
            if off is not None:
                return comparison.different(name, index, off, given[name], wanted)
    return None
