# SPDX-License-Identifier: MIT
"""A friction definition as the text of its *FRICTION block."""

from __future__ import annotations

from collections.abc import Sequence

from usersub.deck.friction import (
    ElasticSlip,
    ExponentialDecay,
    Friction,
    Lagrange,
    Rough,
    SlipTolerance,
    Table,
    User,
)
from usersub.deck.words import written

_PER_LINE = 8


def block(friction: Friction) -> str:
    """Keyword line and data lines, without a line end after the last."""
    return "\n".join([_keyword_line(friction), *_data_lines(friction)])


def _keyword_line(friction: Friction) -> str:
    law, words = friction.law, ["*FRICTION"]
    if isinstance(law, User):
        words.append(f"USER={law.kind}")
        words += [f"DEPVAR={law.depvar}"] * bool(law.depvar)
        words += [f"PROPERTIES={len(law.properties)}"] * bool(law.properties)
    elif isinstance(law, Rough):
        words.append("ROUGH")
    elif isinstance(law, ExponentialDecay):
        words.append("EXPONENTIAL DECAY")
        words += ["TEST DATA"] * (law.test_data is not None)
    if friction.anisotropic:
        words.append("ANISOTROPIC")
    if isinstance(law, (Table, User)) and law.dependencies:
        words.append(f"DEPENDENCIES={law.dependencies}")
    if isinstance(friction.method, Lagrange):
        words.append("LAGRANGE")
    elif isinstance(friction.method, ElasticSlip):
        words.append(f"ELASTIC SLIP={written(friction.method.value)}")
    elif isinstance(friction.method, SlipTolerance):
        words.append(f"SLIP TOLERANCE={written(friction.method.value)}")
    if friction.taumax is not None:
        words.append(f"TAUMAX={written(friction.taumax)}")
    if friction.shear_traction_slope is not None:
        words.append(f"SHEAR TRACTION SLOPE={written(friction.shear_traction_slope)}")
    return ", ".join(words)


def _data_lines(friction: Friction) -> list[str]:
    law = friction.law
    if isinstance(law, User):
        return _in_lines(law.properties, _PER_LINE)
    if isinstance(law, Rough):
        return []
    if isinstance(law, ExponentialDecay):
        data = law.test_data
        if data is None:
            return _in_lines((law.mus, law.muk, law.dc), _PER_LINE)
        lines = [written(data.mu1), f"{written(data.mu2)}, {written(data.rate2)}"]
        return lines if data.mu_inf is None else [*lines, written(data.mu_inf)]
    if friction.dialect == "calculix":
        slope = () if friction.stick_slope is None else (friction.stick_slope,)
        return _in_lines((law.rows[0].mu[0], *slope), _PER_LINE)
    lines = []
    for row in law.rows:
        lines += _in_lines((*row.mu, *row.place), _PER_LINE)
    return lines


def _in_lines(values: Sequence[float | None], width: int) -> list[str]:
    words = ["" if value is None else written(value) for value in values]
    # a line keeps a comma at its end: one whose entries are all left out is a data line still
    return [", ".join(words[i : i + width]).rstrip(" ,") + "," for i in range(0, len(words), width)]
