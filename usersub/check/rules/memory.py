# SPDX-License-Identifier: MIT
"""A routine stays within its arguments, whatever the scene, and within its stack and heap."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import chain

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.watching import MEMORY, watch
from usersub.check.respond import run_of
from usersub.check.rule import CannotCheck, Finding, NotApplicable, rule
from usersub.check.rules import indices
from usersub.check.subject import Subject
from usersub.errors import Error

_SIZES = "sizes of all arguments as the manual page of the interface gives them"

#: Arguments with rules of their own.
_PROPERTIES = ("props", "PROPS")
_STATE = ("STATEV", "statev", "state", "rData")


def _in_three_dimensions(subject: Subject) -> Iterator[Case]:
    for points in (1, cases.MANY):
        yield cases.slipping(subject, points)
        yield cases.sticking(subject, points)
        yield cases.changing_load(subject, points)
        yield cases.held(subject, points)


def _in_two_dimensions(subject: Subject) -> Iterator[Case]:
    for points in (1, cases.MANY):
        yield cases.slipping(subject, points, 1)
        yield cases.sticking(subject, points, 1)
        yield cases.changing_load(subject, points, 1)
        yield cases.held(subject, points, 1)


def _with_contact(contact: str) -> Callable[[Subject], Iterator[Case]]:
    def made(subject: Subject) -> Iterator[Case]:
        for directions in cases.dimensions(subject):
            for points in (1, cases.MANY):
                yield cases.slipping(subject, points, directions).but(contact=contact)
                yield cases.changing_load(subject, points, directions).but(contact=contact)

    return made


def _of_argument(subject: Subject, case: Case, names: tuple[str, ...] | None) -> Finding | None:
    """A fault of memory in one of `names`; None: in any argument without a rule of its own."""
    found = watch(subject, case, MEMORY)
    if found is None:
        return None
    own = found.argument in (*_PROPERTIES, *_STATE)
    if own if names is None else found.argument not in names:
        return None
    return found.finding(indices.beyond(subject, found.argument, found.sentence))


def _if_known(subject: Subject, what: str, found: Finding | None) -> Finding | None:
    """The finding, unless it is about a number that was only guessed."""
    origin = subject.origin.get(what, "")
    if found is not None and origin.startswith("not found out"):
        raise CannotCheck(f"{found.detail}, but how many there have to be was {origin}; give them")
    return found


@rule(
    "memory.outside",
    "Nothing beyond the ends of the arguments is read or written.",
    reference=_SIZES,
    cases=_in_three_dimensions,
)
def outside(subject: Subject, case: Case) -> Finding | None:
    """Three dimensions, node-to-facet contact, one point and many."""
    return _of_argument(subject, case, None)


@rule(
    "memory.two-dimensional",
    "In two dimensions there is no second friction and no third coordinate direction.",
    reference=_SIZES,
    interfaces=("fric", "fric_coef", "vfric", "vfric_coef"),
    cases=_in_two_dimensions,
)
def two_dimensional(subject: Subject, case: Case) -> Finding | None:
    """Faults that three dimensions do not show."""
    found = _of_argument(subject, case, None)
    if found is not None and _shown(subject, _in_three_dimensions, None):
        raise NotApplicable("the fault is not of two dimensions alone, see memory.outside")
    return found


@rule(
    "memory.analytical-rigid",
    "On an analytical rigid surface what belongs to the main surface is there once, not by point.",
    reference="numDefTfv = 1 and nFacNod = 0 (VFRIC), nBlockAnal = 1 and nNodMain = 1 (VFRICTION)",
    interfaces=("vfric", "vfriction"),
    cases=_with_contact("analytical-rigid"),
)
def analytical_rigid(subject: Subject, case: Case) -> Finding | None:
    """Faults that facets do not show."""
    found = _of_argument(subject, case, None)
    if found is not None and _shown(subject, _by_facet, None):
        raise NotApplicable("the fault is not of rigid surfaces alone, see memory.outside")
    return found


@rule(
    "memory.edges",
    "In contact of edges a point has two nodes on either side and four sets of state variables.",
    reference="nNodSec = nNodMain = 2, nNodState = 4, nBlockEdge = nBlock (VFRICTION)",
    interfaces=("vfriction",),
    cases=_with_contact("edge-to-edge"),
)
def edges(subject: Subject, case: Case) -> Finding | None:
    """Faults that facets do not show."""
    found = _of_argument(subject, case, None)
    if found is not None and _shown(subject, _by_facet, None):
        raise NotApplicable("the fault is not of edges alone, see memory.outside")
    return found


@rule(
    "memory.properties",
    "No more properties are read than there are, and none is written.",
    reference="NPROPS is the number of properties that the deck gives",
    cases=cases.everything,
)
def properties(subject: Subject, case: Case) -> Finding | None:
    """Faults in PROPS."""
    return _if_known(subject, "props", _of_argument(subject, case, _PROPERTIES))


@rule(
    "memory.state",
    "No state variable is touched that the scene does not have.",
    reference="the number of state variables is what the deck gives under *DEPVAR",
    interfaces=("fric", "fric_coef", "vfric", "vfriction"),
    cases=cases.everything,
)
def state(subject: Subject, case: Case) -> Finding | None:
    """Faults in the state variables."""
    return _if_known(subject, "states", _of_argument(subject, case, _STATE))


@rule(
    "memory.empty-block",
    "A call without contact points touches nothing.",
    reference="nBlock, or nContact, may be zero: a pair without a point in contact",
    interfaces=("vfric", "vfriction", "vfric_coef"),
)
def empty_block(subject: Subject) -> Iterator[Finding]:
    """One call with zero points."""
    case = cases.slipping(subject, 1)
    subject.under_way(case)
    run = run_of(subject, case, checked=1, enforced=True)
    run.step(0)  # binds the arrays and makes the plan
    try:
        run.driver.call_empty_block()
    except Error as error:
        counts = "nContact" if subject.interface.name == "vfric" else "nBlock"
        seen = run.observed()
        told = seen.sentence or str(error)
        yield Finding(
            f"called with {counts} = 0: {told}",
            where=seen.where,
            hint="loop from 1 to the number of points and do nothing before that needs a point",
        )


def _by_facet(subject: Subject) -> Iterator[Case]:
    both = (_in_three_dimensions(subject), _in_two_dimensions(subject))
    return chain(*both) if 1 in cases.dimensions(subject) else both[0]


def _shown(
    subject: Subject,
    others: Callable[[Subject], Iterator[Case]],
    names: tuple[str, ...] | None,
) -> bool:
    """Whether one of other cases shows a fault too."""
    return any(_of_argument(subject, case, names) is not None for case in others(subject))
