# SPDX-License-Identifier: MIT
"""From a case to what the routine answers, through the drivers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from usersub.check.respond.answer import Answer
from usersub.check.respond.run import Run
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.subject import Subject

__all__ = ["Answer", "Run", "respond", "run_of"]


def run_of(subject: Subject, case: Case, *, enforced: bool = False, **options: Any) -> Run:
    """A case made ready to be run step by step.

    Args:
        enforced: FRIC_COEF and VFRIC_COEF with the driver's enforcement (so there is friction and
            a history) instead of the coefficient alone.
        options: settings of the scene that differ (checked=1, block=3, threads=2, ...).

    Raises:
        Error: routine and case do not fit.
    """
    name = subject.interface.name
    if name == "fric" or (enforced and name == "fric_coef"):
        from usersub.check.respond.standard import StandardRun

        return StandardRun(subject, case, options)
    if name in ("vfric", "vfriction") or (enforced and name == "vfric_coef"):
        from usersub.check.respond.explicit import ExplicitRun

        return ExplicitRun(subject, case, options)
    from usersub.check.respond.coefficient import CoefficientRun

    return CoefficientRun(subject, case, options)


def respond(subject: Subject, case: Case, **options: Any) -> list[Answer]:
    """What the routine answers, one `Answer` a step, in the order of the case's points.

    A failure of the routine ends the list with an answer that holds it.

    Args:
        options: as in `run_of`.
    """
    subject.under_way(case)
    run = run_of(subject, case, **options)
    answers: list[Answer] = []
    for index in range(len(case.steps)):
        try:
            answers.append(run.step(index))
        except Error as error:
            answers.append(Answer(failure=error))
            break
    return answers
