# SPDX-License-Identifier: MIT
"""Results of studies that were never run: every field has a value of its own."""

from __future__ import annotations

import math
from itertools import count
from types import SimpleNamespace

from usersub.study.result import Result
from usersub.study.stability.cell import Cell, Limit

_KEYS = count()


def result(**changes: object) -> Result:
    """A result of P2 with some fields changed; every one has another key."""
    fields: dict[str, object] = {
        "problem": "P2", "law": "exponential_decay", "interface": "fric", "language": "c",
        "precision": "double", "method": "implicit", "step": 1.25e-5, "points": 64,
        "error": 2.1e-7, "error_of": "stopping time and distance", "run_time_s": 0.13,
        "ns_per_point": 17.5, "run_time_low": 0.11, "run_time_high": 0.17, "repeats": 5,
        "increments": 48, "block": None, "routine": "", "options": (),
        "key": f"key{next(_KEYS):05d}",
    }  # fmt: skip
    if "run_time_s" in changes and "run_time_low" not in changes:
        time = changes["run_time_s"]
        fields |= {"run_time_low": 0.95 * time, "run_time_high": 1.05 * time}
    return Result(**{**fields, **changes})


def refused(why: str, **changes: object) -> Result:
    """A point that did not run."""
    nan = dict.fromkeys(
        ("error", "step", "run_time_s", "ns_per_point", "run_time_low", "run_time_high"), math.nan
    )
    return result(**{**nan, "error_of": "", "refused": why, **changes})


def ladder(order: float, first: float = 1e-3, **changes: object) -> list[Result]:
    """Five runs whose error falls with this order, each twice as long as the one before."""
    return [
        result(
            step=1e-4 / 2**k, increments=32 * 2**k, error=first / 2 ** (order * k),
            run_time_s=1e-3 * 2**k, **changes,
        )
        for k in range(5)
    ]  # fmt: skip


def study() -> list[Result]:
    """Interfaces, languages, precisions, methods, blocks and a point that was refused."""
    runs = []
    for interface in ("fric", "fric_coef", "vfric", "vfriction", "vfric_coef"):
        for language in ("c", "fortran", "python"):
            runs += ladder(2, interface=interface, language=language)
        runs += ladder(4, 1e-5, interface=interface, method="rk4")
    runs += ladder(2, interface="vfric", precision="single")
    runs += [result(block=n, ns_per_point=10.0 + 300.0 / n) for n in (1, 16, 256)]
    return [*runs, refused('no <single> & no "half"', interface="fric", precision="single")]


def saving(**changes: object) -> SimpleNamespace:
    """What leaving out saves."""
    fields = {
        "interface": "vfriction", "language": "c", "routine": "decay", "scene": "isothermal",
        "points": 1000, "ns_needed": 4.0, "ns_full": 10.0, "ns_general": 12.0, "bytes_needed": 72,
        "bytes_full": 464, "bytes_general": 500, "same_bits": True,
    }  # fmt: skip
    return SimpleNamespace(**{**fields, **changes})


def cell(case: str, verdict: str, **changes: object) -> Cell:
    """A cell of the stability matrix."""
    fields = {
        "value": "1e300", "subject": "coulomb", "interface": "vfric", "language": "c",
        "precision": "double", "reason": "" if verdict == "stable" else f"{verdict} <by> design",
    }  # fmt: skip
    return Cell(case=case, verdict=verdict, **{**fields, **changes})


def limit(measured: float, theory: float | None, **changes: object) -> Limit:
    """A limit beside its theory."""
    fields = {
        "name": "largest stable step", "subject": "driver: penalty", "interface": "vfric",
        "language": "c", "precision": "double", "unit": "s", "words": "2/omega",
    }  # fmt: skip
    return Limit(measured=measured, theory=theory, **{**fields, **changes})
