# SPDX-License-Identifier: MIT
"""Properties of laws at the ends of their range."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from usersub.errors import Error
from usersub.study.stability.histories import History, history_of, refused
from usersub.study.stability.subjects import Subject, with_parameter

#: What a property becomes: a word and a function of its value.
_FACTORS = (
    ("zero", 0.0), ("1e-12 times", 1e-12), ("1e12 times", 1e12), ("1e-200 times", 1e-200),
    ("1e200 times", 1e200), ("infinite", np.inf),
)  # fmt: skip


def properties(subject: Subject, quick: bool) -> Iterator[History]:
    """Each number among the properties of a law in its turn; what the law refuses is not run."""
    if not subject.law:
        return
    factors = np.array([1e-9, 1e-3, 1.0, 1e3])
    words = ["tiny slip", "small slip", "ordinary slip", "large slip"]
    for name, value in subject.parameters.items():
        for what, changed in _changed(value, subject.precision, quick):
            values = [f"{name} {what}, {word}" for word in words]
            try:
                other = with_parameter(subject, name, changed)
            except Error as error:
                yield refused(subject, "property", [f"{name} {what}"], str(error))
                raw = _raw(subject, name, changed)
                if raw is not None:
                    words_raw = [f"{value}, unchecked" for value in values]
                    made = history_of(raw, "property", words_raw, slip=factors)
                    made.valid = False
                    yield made
                continue
            yield history_of(other, "property", values, slip=factors)
    if subject.law in ("anisotropic",):
        for ratio in (1e-8, 1e-4, 1e4, 1e8):
            mu = float(subject.parameters["mu1"])  # type: ignore[arg-type]
            other = with_parameter(subject, "mu2", mu * ratio)
            values = [f"ellipse {ratio:g}, {word}" for word in words]
            yield history_of(other, "property", values, slip=factors)


def _raw(subject: Subject, name: str, value: object) -> Subject | None:
    """With a property that the law refuses, as a host may give it all the same."""
    from usersub import laws

    place = 0
    law, known = laws.law(subject.law), laws.law(subject.law).values(subject.props)
    for prop in law.props:
        count = prop.count(known)
        if prop.name == name:
            break
        place += count
    if not isinstance(value, float) or count != 1:
        return None
    props = (*subject.props[:place], value, *subject.props[place + 1 :])
    return subject.but(props=props, bound=None)


def _changed(value: object, precision: str, quick: bool) -> Iterator[tuple[str, object]]:
    single = precision == "single"
    for what, factor in _FACTORS:
        if quick and what.startswith("1e-200"):
            continue
        by = factor
        if single and factor in (1e-200, 1e200):
            by, what = (1e-30, "1e-30 times") if factor < 1 else (1e30, "1e30 times")
        found = _times(value, by)
        if found is not None:
            yield what, found


def _times(value: object, factor: float) -> object | None:
    if isinstance(value, tuple | list):
        parts = [_times(v, factor) for v in value]
        return None if any(p is None for p in parts) else parts
    number = float(value)  # type: ignore[arg-type]
    if np.isinf(factor):
        return factor
    if factor == 0.0:
        return 0.0
    found = (number or 1.0) * factor
    return found if np.isfinite(found) else None
