# SPDX-License-Identifier: MIT
"""Properties that are too few, which a law function refuses: whether it does so where the built-in
law does.

A routine that was written as a subroutine may do without what is missing; nothing is asked of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from usersub.check import cases
from usersub.check.agreement import truth
from usersub.check.agreement.compare import Way, respond_to
from usersub.check.rule import Finding

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.subject import Subject
    from usersub.laws.description import Law

#: What a law function says of too few properties, as it stands in its library (`law/checks.h` and
#: the Fortran twins of it) and as it is told.
_TEXT = b"needs %I properties, not %I"
_REFUSAL = re.compile(r"needs \d+ properties, not \d+")


def too_few(subject: Subject, law: Law) -> Iterator[Case]:
    """A slide with fewer properties than the law takes: one less, the half, one, none; and with
    numbers of elements that make no sense."""
    slide, props = cases.slipping(subject), subject.props
    count = len(props)
    for fewer in sorted({count - 1, count // 2, 1, 0} & set(range(count)), reverse=True):
        yield slide.but(props=props[:fewer])
    for index, prop in enumerate(law.props[:count]):
        if prop.size_of:
            yield slide.but(props=(*props[:index], 0.0, *props[index + 1 :]))


def finding(subject: Subject, law: Law, case: Case) -> Finding | None:
    """What a law function does where the built-in law refuses the properties."""
    if not _is_law_function(subject) or not _refuses(truth.twin(subject, law), case):
        return None
    if _refuses(subject, case):
        return None
    return Finding(
        f"the routine takes the {len(case.props or ())} properties {list(case.props or ())}, which "
        f"the built-in law {law.name} refuses as too few"
    )


def _is_law_function(subject: Subject) -> bool:
    """Whether a compiled file is one: then the words of the refusal stand in its library."""
    code = None if subject.file is None else subject.file.code
    return code is not None and _TEXT in Path(code.build(subject.precision).library).read_bytes()


def _refuses(subject: Subject, case: Case) -> bool:
    answers = respond_to(subject.but(props=case.props), case, Way())
    said = [str(answer.failure) for answer in answers if answer.failure is not None]
    return any(_REFUSAL.search(words) for words in said)
