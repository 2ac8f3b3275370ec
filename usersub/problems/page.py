# SPDX-License-Identifier: MIT
"""The documentation's page about the problems: prose from `page.md.in`, numbers from runs."""

from __future__ import annotations

import platform
import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from usersub.problems import (
    p1,
    p2,
    p4,
    p5,
    p6,
    p7,
    p8,
    p9,
    p10,
    p11,
    p12,
    p13,
    p15,
    p16,
    p17,
    p19,
    p20,
    p21,
    p22,
    p23,
)
from usersub.problems.convergence import EXACT, IRREGULAR, SMOOTH, Study
from usersub.problems.measured import Measured

#: Problems of the block, whose table tells more.
_BLOCKS = ("P1", "P2")

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
        **{
            f"{p}_MEASURED": (_block_table if p in _BLOCKS else _point_table)(found)
            for p, found in by_problem.items()
        },
        **{f"{p}_SAYS": _sentences(found) for p, found in by_problem.items()},
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
    tip, work = p13.loop(p13.STRENGTH)
    sphere, bar = p10.exact(), p11.exact(0.0)
    start = np.array([p19.ANGLE])
    turned = {law: float(p19.Exact(law).angle(start)[0]) for law in p19.PROBLEM.laws}
    speeds = {law: float(p19.Exact(law).speed(a, start[0])) for law, a in turned.items()}
    acceleration = p1.MU * p1.BLOCK.pressure / (p1.BLOCK.density * p1.BLOCK.height)
    numbers = {
        "P1_A": acceleration, "P1_TIME": first.time, "P1_DISTANCE": first.distance,
        "P2_TIME": second.time, "P2_DISTANCE": second.distance, "P4_MU": mu,
        "P4_BY_RATE": by_rate, "P4_BY_PRESSURE": by_pressure, "P4_BY_TEMPERATURE": by_temperature,
        "P9_FORCE": p9.push(), "P9_ACCELERATION": p9.acceleration(), "P10_STUCK": sphere.stuck,
        "P10_MOTION": sphere.motion, "P10_LOOP": sphere.loop, "P11_PULLED": bar.pulled,
        "P11_LOOP": bar.loop, "P12_RATIO": p12.exact(), "P13_TIP": tip,
        "P13_WORK": work, "P15_STEADY": p15.coefficient("rate_state_ageing", 1e3),
        "P16_GROWTH": p16.growth(p16.HOLDS[0][0]),
        "P17_PERIOD": p17.period(float(p17.excess(np.log(p17.VELOCITY), 0.0))),
        "P17_SMALL": 2.0 * np.pi / p17.linear(1.0)[1], "P19_SPEED": speeds["orthotropic"],
        "P19_ANGLE": turned["orthotropic"], "P19_ELLIPSE_SPEED": speeds["anisotropic"],
        "P19_ELLIPSE_ANGLE": turned["anisotropic"],
        **_exact_contacts(),
        **_exact_sliders(),
    }  # fmt: skip
    return {name: f"{number:.10g}" for name, number in numbers.items()}


def _exact_contacts() -> dict[str, float]:
    """Of the problems with several solutions, or none, and of the masses that flutter."""
    lower, upper = p20.bad_angles(p20.COMPLIANT) or (np.nan, np.nan)
    growth = p22.exact(p22.system(len(p22.COUPLING)).stiffness).growth
    return {
        "P20_MU": p20.COMPLIANT, "P20_LOWER": lower, "P20_UPPER": upper, "P21_MU": p21.MU,
        "P22_GROWTH": growth.max(), "P22_FADE": -growth.min(),
    }  # fmt: skip


def _exact_sliders() -> dict[str, float]:
    """Of the masses that rub, and of the softened block."""
    stop, pair, shaken, pulled = p5.exact(), p6.exact(), p7.exact(), p8.exact()
    bounded = p23.bounded()
    return {
        "P5_TIME": stop.time, "P5_PLACE": stop.place,
        **{f"P6_{name.upper()}": number for name, number in pair.items()},
        "P7_SLIP": shaken["slip1"], "P7_REST": shaken["rest1"], "P7_LAG": shaken["lag2"],
        "P8_STICK": pulled["stick"], "P8_SLIP": pulled["slip"], "P8_JUMP": pulled["jump"],
        "P23_FREQUENCY": p23.FREQUENCY, "P23_AMPLITUDE": p23.rough()["amplitude"],
        "P23_STOP": bounded["stop"], "P23_PLACE": bounded["place"],
    }  # fmt: skip


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


def _sentences(measured: list[Measured]) -> str:
    """The answers in words, each once, with the methods that give it."""
    said: dict[str, list[str]] = {}
    for m in measured:
        if m.says and f"`{m.method}`" not in said.setdefault(m.says, []):
            said[m.says].append(f"`{m.method}`")
    return "\n".join(f"- {', '.join(methods)}: {says}." for says, methods in said.items())


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
