# SPDX-License-Identifier: MIT
"""The documentation's page about the problems: prose from `page.md.in`, numbers from runs."""

from __future__ import annotations

import platform
import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from usersub.problems import p1, p2, p4
from usersub.problems.convergence import EXACT, IRREGULAR, SMOOTH, Study
from usersub.problems.measured import Measured

_TEMPLATE = Path(__file__).with_name("page.md.in")

#: Where the coefficient of P4 is told: slip rate, pressure, temperature.
_P4_POINT = (100.0, 1000.0, 150.0)


def page(measured: Iterable[Measured], studies: Iterable[Study], stamp: str) -> str:
    """The page in Markdown.

    Args:
        stamp: what the numbers were made with.
    """
    measured, studies = list(measured), list(studies)
    by_problem = {m.problem: [n for n in measured if n.problem == m.problem] for m in measured}
    irregular = [s for s in studies if s.kind == IRREGULAR]
    values = {
        "STAMP": stamp,
        **_exact(),
        **{f"{p}_MEASURED": _block_table(by_problem[p]) for p in ("P1", "P2")},
        **{f"{p}_MEASURED": _point_table(by_problem[p]) for p in ("P3", "P4")},
        "CONVERGENCE": _runs([s for s in studies if s.kind == SMOOTH]),
        "EXACT": _runs([s for s in studies if s.kind == EXACT]),
        "ELEMENTS": _runs(irregular),
        "REMAINS": _remains(irregular),
    }
    text = _TEMPLATE.read_text(encoding="utf-8")
    return re.sub(r"@(\w+)@", lambda match: values[match[1]], text)


def stamp() -> str:
    """Versions that the numbers were made with.

    Raises:
        MissingTool: a compiler is missing.
    """
    import numba

    from usersub import __version__
    from usersub.routine import compilers

    return (
        f"usersub {__version__}, Python {platform.python_version()}, numpy {np.__version__}, "
        f"numba {numba.__version__}, {compilers.find('c').version}, "
        f"{compilers.find('fortran').version}, on {platform.system()} {platform.machine()}"
    )


def _exact() -> dict[str, str]:
    first, second = p1.exact(), p2.exact()
    mu, by_rate, by_pressure, by_temperature = (
        float(x[0]) for x in p4.exact(*(np.array([x]) for x in _P4_POINT))
    )
    acceleration = p1.MU * p1.BLOCK.pressure / (p1.BLOCK.density * p1.BLOCK.height)
    numbers = {
        "P1_A": acceleration, "P1_TIME": first.time, "P1_DISTANCE": first.distance,
        "P2_TIME": second.time, "P2_DISTANCE": second.distance, "P4_MU": mu,
        "P4_BY_RATE": by_rate, "P4_BY_PRESSURE": by_pressure, "P4_BY_TEMPERATURE": by_temperature,
    }  # fmt: skip
    return {name: f"{number:.10g}" for name, number in numbers.items()}


def table(heads: str, rows: Iterable[Iterable[object]]) -> str:
    """A Markdown table; heads are separated by commas, numbers are right-aligned (`>` before)."""
    names = [name.strip() for name in heads.split(",")]
    lines = [
        "| " + " | ".join(name.lstrip(">") for name in names) + " |",
        "| " + " | ".join("---:" if name[0] == ">" else "---" for name in names) + " |",
    ]
    lines += ["| " + " | ".join(map(str, row)) + " |" for row in rows]
    return "\n".join(lines)


def error(number: float | None) -> str:
    """An error, with two digits."""
    return "-" if number is None else f"{number:.1e}"


def _block_table(measured: list[Measured]) -> str:
    heads = "interface, method, >increments, >time double, >distance double, >time single, "
    heads += ">distance single, >allowed double, >allowed single"
    rows = []
    for m in measured:
        found = [
            error(m.errors.get(precision, {}).get(quantity))
            for precision in ("double", "single")
            for quantity in ("time_error", "distance_error")
        ]
        allowed = [error(m.tolerance.get(precision)) for precision in ("double", "single")]
        rows.append([m.interface.upper(), m.method, m.steps, *found, *allowed])
    return table(heads, rows)


def _point_table(measured: list[Measured]) -> str:
    rows = [
        [m.law, m.interface.upper(), m.method, m.error_of, error(m.errors["double"]["error"]),
         error(m.tolerance["double"])]
        for m in measured
    ]  # fmt: skip
    return table("law, interface, method, error of, >double, >allowed", rows)


def _runs(studies: list[Study]) -> str:
    """One row a study: increments and errors, coarse to fine."""
    heads = "problem, interface, method, error of, >increments, >errors"
    exact = all(study.kind == EXACT for study in studies)
    rows = []
    for study in studies:
        steps = " ".join(map(str, study.steps))
        errors = " ".join(map(error, study.errors))
        row = [study.problem, study.interface.upper(), study.method, study.quantity, steps, errors]
        order = "-" if study.order is None else f"{study.order:.2f}"
        theory = "-" if study.expected is None else f"{study.expected:g}"
        rows.append(row if exact else [*row, theory, order])
    return table(heads if exact else heads + ", >theory, >order", rows)


def _remains(studies: list[Study]) -> str:
    rows = [[s.problem, s.method, s.quantity, error(s.remains)] for s in studies]
    return table("problem, elements, error of, >remains", rows)
