# SPDX-License-Identifier: MIT
"""Reference values of the laws, and how results are compared with them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from decimal import Decimal
from functools import cache
from typing import Any

import numpy as np
import pytest

from usersub import abi, laws

LANGUAGES = ["python", "c", pytest.param("fortran", marks=pytest.mark.needs_fortran)]
PRECISIONS = {name: abi.interface(name).precisions for name in abi.NAMES}
REAL = {"double": np.float64, "single": np.float32}

#: Relative tolerance of tractions, tangents and states behind FRIC, and of derivatives.
RELATIVE = 1e-12

#: Largest error of the values that was seen, in units in the last place: by law, interface,
#: precision and language; `pytest -v tests/laws` prints it.
SEEN: dict[tuple[str, str, str, str], float] = {}


@cache
def reference(law: str) -> list[dict[str, Any]]:
    """The cases of `reference.json`; numbers are exact (Decimal)."""
    file = laws.law(law).folder / "reference.json"
    return json.loads(file.read_text(encoding="utf-8"), parse_float=Decimal)["cases"]


def combinations(
    interfaces: Iterable[str], kinds: Iterable[str] = ("coefficient", "strength", "traction")
) -> list:
    """Parameters (law, interface, precision) for every law of `kinds` behind `interfaces`."""
    return [
        pytest.param(law.name, interface, precision, id=f"{law.name}-{interface}-{precision}")
        for law in laws.LAWS.values()
        for interface in interfaces
        if interface in law.interfaces and law.kind in kinds
        for precision in PRECISIONS[interface]
    ]


def names(kinds: Iterable[str] = ("coefficient", "strength", "traction", "bristle")) -> list[str]:
    """Names of the laws of `kinds`; by default of those that have reference values."""
    return [law.name for law in laws.LAWS.values() if law.kind in kinds]


def floats(values: Any) -> np.ndarray:
    """Numbers of a reference file as doubles; null becomes NaN."""
    if isinstance(values, list):
        return np.array([floats(v) for v in values], dtype=float)
    return np.array(np.nan if values is None else float(values))


def column(points: list[dict], name: str) -> np.ndarray:
    """One variable of all points: shape (N,), of fields and states (count, N)."""
    return floats([p[name] for p in points]).T


def result(points: list[dict], precision: str, name: str) -> list:
    """One result of all points, as in the file."""
    return [p[precision][name] for p in points]


def by_time_increment(points: list[dict]) -> Iterator[tuple[float, list[dict]]]:
    """Points that have the same time increment, as one call of a driver takes them."""
    for dt in dict.fromkeys(float(p["time_increment"]) for p in points):
        yield dt, [p for p in points if float(p["time_increment"]) == dt]


def units_off(found: np.ndarray, exact: list[Decimal], precision: str) -> float:
    """Largest distance from the exact values in units in the last place."""
    real = REAL[precision]
    worst = 0.0
    for x, wanted in zip(found.ravel(), exact, strict=True):
        if not np.isfinite(x):
            return np.inf
        place = Decimal(float(np.spacing(real(abs(wanted)))))
        worst = max(worst, float(abs(Decimal(float(x)) - Decimal(wanted)) / place))
    return worst


def assert_units(key: tuple[str, str, str, str], found: np.ndarray, exact: list[Decimal]) -> None:
    """Checks values against the accuracy that the law states; remembers the error."""
    law, _, precision, _ = key
    accuracy = laws.law(law).accuracy
    allowed = accuracy.ulp if precision == "double" else accuracy.single_ulp
    units = units_off(found, exact, precision)
    SEEN[key] = max(SEEN.get(key, 0.0), units)
    assert units <= allowed, f"{units:.3g} units in the last place, {allowed:g} are stated"


def relative(law: str, precision: str, factor: float = 1.0) -> float:
    """Relative tolerance of forces: the stated accuracy and some roundings of the driver."""
    if precision == "double":
        return RELATIVE
    return factor * (laws.law(law).accuracy.single_ulp + 8) * float(np.finfo(np.float32).eps)


def scene_of(law: str, case: dict, interface: str, points: list[dict], **settings: Any) -> dict:
    """Settings of a scene for points of a case."""
    described, props = laws.law(law), [float(p) for p in case["props"]]
    directions = settings.pop("directions", 2)
    return {
        "points": len(points), "props": props, "temperatures": 1,
        "fields": len(points[0]["fields"]),
        "states": described.state_count(interface, directions, directions + 1, props),
        **settings,
    }  # fmt: skip
