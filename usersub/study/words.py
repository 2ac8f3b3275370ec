# SPDX-License-Identifier: MIT
"""How the study names runs, and writes numbers for people."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usersub.study.result import Plain, Result

#: Languages as they are written.
LANGUAGES = {"c": "C", "fortran": "Fortran", "python": "Python", "library": "library"}

_UNITS = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))


def number(value: float | None, digits: int = 2) -> str:
    """A number with few digits: `2.1e-7`, `0.13`, `1e-3`, `1200`; a dash where there is none."""
    if value is None or math.isnan(value):
        return "-"
    if math.isinf(value):
        return f"{value:g}"
    if value == 0.0 or 0.0095 < abs(value) < 1e5:
        rounded = float(f"{value:.{digits}g}")
        return f"{rounded:.0f}" if rounded == int(rounded) else f"{rounded:g}"
    mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
    return f"{float(mantissa):g}e{int(exponent)}"


def seconds(value: float) -> str:
    """A time with two digits and its unit."""
    if not 0.0 < value < math.inf:
        return "-" if math.isnan(value) else f"{value:g} s"
    value = float(f"{value:.1e}")
    unit, name = next((u for u in _UNITS if value >= u[0]), _UNITS[-1])
    return f"{number(value / unit)} {name}"


def joined(parts: Sequence[str], last: str = "and") -> str:
    """The parts as one would say them."""
    if len(parts) < 2:
        return "".join(parts)
    return f"{', '.join(parts[:-1])} {last} {parts[-1]}"


def language(name: str) -> str:
    """A language as it is written."""
    return LANGUAGES.get(name, name)


def law(name: str) -> str:
    """A law as it is written: a shipped one in words, any other as its author named it."""
    from usersub.laws import LAWS
    from usersub.problems.own import OWN

    return name.replace("_", " ") if name in LAWS or name in OWN else name


def method(run: Result) -> str:
    """The method with all that was chosen beside it, without step, block and precision."""
    return ", ".join([run.method, *(_option(name, value) for name, value in run.options)])


def _option(name: str, value: Plain) -> str:
    words = name.replace("_", " ")
    if isinstance(value, bool):
        return words if value else f"no {words}"
    return f"{words} {number(value, 4) if isinstance(value, float) else value}"


def short(run: Result) -> str:
    """Method, options and precision in words."""
    return f"{method(run)}, single precision" if run.precision == "single" else method(run)


#: What `Result.increments` counts where they are increments of time.
_TIMES = ("increments", "times finer than the largest stable increment")


def by_time(run: Result) -> bool:
    """Whether the time increment is what was refined, rather than points or a table."""
    return run.refined in _TIMES


def refinement(run: Result) -> str:
    """How fine a run is: `step 1e-5 s`, `64 contact points`; a dash where nothing refines."""
    if run.increments is None:
        return "-"
    if not by_time(run):
        return f"{run.increments} {run.refined}"
    if math.isfinite(run.step):
        return f"step {number(run.step)} s"
    return f"{run.increments} increments"


def named(run: Result) -> str:
    """A run in words: `FRIC in C, implicit, step 1e-5`."""
    whose = f" ({Path(run.routine).name})" if run.routine else ""
    parts = [f"{run.interface.upper()} in {language(run.language)}{whose}", short(run)]
    if run.increments is not None:
        parts.append(refinement(run))
    if run.block is not None:
        parts.append(f"block {run.block}")
    return ", ".join(parts)
