# SPDX-License-Identifier: MIT
"""One rule on one case again, and the three lines that do it."""

from __future__ import annotations

import re
from dataclasses import asdict, fields
from typing import TYPE_CHECKING, Any

from usersub.check.subject import Around, Scales
from usersub.errors import LoadError

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.rule import Finding
    from usersub.check.subject import Subject

_IMPORTS = "import usersub.check as check\nfrom usersub.check import Case, Step"
_DEFAULTS = {
    "props": (),
    "states": 0,
    "fields": 0,
    "temperatures": True,
    "anisotropic": False,
    "law": "",
}
#: Numbers that Python writes in a way that it does not read.
_NOT_FINITE = re.compile(r"\b(nan|inf)\b")


def reproduction(subject: Subject, rule: str, case: Case | None) -> str:
    """Three lines of Python that look at one rule, at one case of it if there is one.

    The values of the subject stand in it, so that nothing has to be found out again.
    """
    target = repr(str(subject.path)) if subject.path else _name_of(subject)
    words = [target, repr(rule)]
    if case is not None:
        words.append(_NOT_FINITE.sub(r'float("\1")', repr(case)))
    words.append(f"interface={subject.interface.name!r}")
    if subject.precision != "double":
        words.append(f"precision={subject.precision!r}")
    if subject.interface.name == "fric_coef":
        words.append(f"generation={subject.interface.generation!r}")
    if subject.routine is not None:
        words += [
            f"{name}={getattr(subject, name)!r}"
            for name, default in _DEFAULTS.items()
            if getattr(subject, name) != default or name == "props"
        ]
        words.append(f"scales={_scales(subject.scales)!r}")
        if case is None and subject.others:
            words.append(f"others={[asdict(a) for a in subject.others]!r}")
        if subject.around != Around():
            words.append(f"around={asdict(subject.around)!r}")
    return f"{_IMPORTS}\ncheck.reproduce({', '.join(words)})"


def _name_of(subject: Subject) -> str:
    """What the caller may call a routine that is in no file."""
    name = subject.routine.name if subject.routine is not None else subject.name
    return name if name.isidentifier() else "routine"


def _scales(scales: Scales) -> dict[str, Any]:
    default = Scales()
    return {
        f.name: getattr(scales, f.name)
        for f in fields(scales)
        if getattr(scales, f.name) != getattr(default, f.name)
    }


def reproduce(
    target: Any,
    rule: str,
    case: Case | None = None,
    *,
    interface: str | None = None,
    precision: str = "double",
    generation: str | None = None,
    law: str | None = None,
    apart: bool = True,
    **given: Any,
) -> Finding | None:
    """Looks at one rule again, at one case if it is given, and prints what it finds.

    Args:
        target: as in `check`.
        rule: identifier of the rule.
        case: the case; a rule that is not about single cases is run as a whole.
        interface, precision, generation, law: as in `check`.
        given: props, states, fields, temperatures, anisotropic, scales (values by name), around,
            others (names and step numbers). If props are given, whatever else is not has
            its default and is not found out.
        apart: False looks in this process, where a debugger can follow, and a crash is a crash.

    Returns:
        what was found, or None.

    Raises:
        LoadError: no such rule, or several interfaces of which none was chosen.
        whatever loading the routine raises.
    """
    from usersub.check.rules import all_rules
    from usersub.check.running.session import Session
    from usersub.check.subjects.targets import GIVEN, subjects, wishes

    known = all_rules()
    if rule not in known:
        from usersub.check.running.expectations import no_such_rule

        raise LoadError(no_such_rule(rule, known))
    if "props" in given:
        given = {**_DEFAULTS, "scales": asdict(Scales()), "around": Around(), **given}
        given.pop("law")
    unknown = set(given) - set(GIVEN)
    if unknown:
        raise TypeError(f"reproduce() got an unexpected keyword argument '{sorted(unknown)[0]}'")
    wish = wishes(interface, precision, law, generation, **given)
    found = list(subjects(target, wish))
    if len(found) > 1:
        names = ", ".join(repr(s.interface.name) for s in found)
        raise LoadError(f"{found[0].name} has several interfaces; give interface=, one of {names}")
    session = Session(found[0])
    return session.again(known[rule], case, apart=apart)
