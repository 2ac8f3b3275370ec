# SPDX-License-Identifier: MIT
"""`python -m tests.laws.reference [--check] [LAW ...]`: reference values of the laws.

Each law's folder has a `reference.py` (the law once more, in mpmath, from its equation) with CASES;
this writes `reference.json` beside it, or with `--check` compares. The form of both is told in
`CONTRIBUTING.md`.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import struct
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from mpmath import mp, mpf, workdps

from usersub import laws

#: Digits of the evaluation, and those that are written: more than a double has.
DIGITS, WRITTEN = 240, 25
#: Step of one-sided differences, relative to the variable where that is above one; a power of two,
#: since the digits that are set at the import of this module do not count.
STEP = mpf(2) ** -266

VARIABLES = ("slip_rate", "pressure", "temperature", "slip_increment")
BRISTLE_VARIABLES = ("motion 1", "motion 2", "pressure", "temperature")
#: What a point or an increment of CASES may have, and what stands for it.
POINT = {"slip_rate": 0.0, "pressure": 0.0, "temperature": 0.0, "fields": (), "state": ()}
INCREMENT = {"motion": (0.0, 0.0), "pressure": 0.0, "temperature": 0.0, "fields": ()}
TIME_INCREMENT = 0.25
_MARKS = ("no_derivative", "below")


def file(law: str) -> Path:
    """The file with the reference values of a law."""
    return laws.law(law).folder / "reference.json"


@cache
def module(law: str) -> ModuleType:
    """`reference.py` of a law."""
    path = laws.law(law).folder / "reference.py"
    spec = importlib.util.spec_from_file_location(f"usersub_reference_{law}", path)
    assert spec is not None and spec.loader is not None
    made = importlib.util.module_from_spec(spec)
    with workdps(DIGITS):  # constants of the file have all digits
        spec.loader.exec_module(made)
    return made


def single(x: float) -> float:
    """`x` rounded to single precision."""
    return struct.unpack("f", struct.pack("f", x))[0]


def _same(x: float) -> float:
    return float(x)


def quantities(given: dict[str, Any], default: dict[str, Any], law: str) -> dict[str, Any]:
    """One entry of CASES, complete and checked; time increments are powers of two, so that rates
    behind the interfaces are exact."""
    known = {*default, "time_increment", *_MARKS}
    unknown = set(given) - known
    if unknown:
        raise SystemExit(f"{law}: CASES has {sorted(unknown)}; known: {sorted(known)}")
    found = {**default, "time_increment": TIME_INCREMENT, **given}
    dt = found["time_increment"]
    if dt != 0 and mp.frexp(mpf(dt))[0] != 0.5:
        raise SystemExit(f"{law}: time_increment = {dt}; expected 0 or a power of two")
    if dt == 0 and found.get("slip_rate"):
        raise SystemExit(f"{law}: a point without time increment has a slip rate")
    return found


def _exact(value: Any, rounding: Callable[[float], float]) -> Any:
    """Numbers and sequences of numbers as mpf, after rounding to a precision."""
    if isinstance(value, Sequence) and not isinstance(value, str):
        return tuple(_exact(v, rounding) for v in value)
    return mpf(rounding(value))


def _namespace(point: dict[str, Any], rounding: Callable[[float], float]) -> SimpleNamespace:
    q = SimpleNamespace(
        **{k: _exact(v, rounding) for k, v in point.items() if k not in _MARKS},
    )
    if "slip_rate" in point:
        q.slip_increment = _exact(point["slip_rate"] * point["time_increment"], rounding)
    return q


def _moved(q: SimpleNamespace, name: str, step: mpf) -> SimpleNamespace:
    """A copy in which one variable is larger by `step`."""
    made = SimpleNamespace(**vars(q))
    if name.startswith("motion"):
        index = int(name[-1]) - 1
        made.motion = tuple(x + step * (i == index) for i, x in enumerate(q.motion))
    else:
        setattr(made, name, getattr(q, name) + step)
    return made


def _size(q: SimpleNamespace, name: str) -> mpf:
    x = q.motion[int(name[-1]) - 1] if name.startswith("motion") else getattr(q, name)
    return max(abs(x), mpf(1))


def _differences(
    function: Callable[[SimpleNamespace], Sequence[mpf]],
    q: SimpleNamespace,
    names: Sequence[str],
    point: dict[str, Any],
) -> list[list[mpf | None]]:
    """Derivatives of each result (row) by each variable: one-sided, from above unless `below`."""
    here = function(q)
    rows: list[list[mpf | None]] = [[] for _ in here]
    for name in names:
        if name in point.get("no_derivative", ()):
            columns: list[mpf | None] = [None] * len(here)
        else:
            step = STEP * _size(q, name) * (-1 if name in point.get("below", ()) else 1)
            there = function(_moved(q, name, step))
            columns = [(b - a) / step for a, b in zip(here, there, strict=True)]
        for row, value in zip(rows, columns, strict=True):
            row.append(value)
    return rows


def point_values(law: laws.Law, q: SimpleNamespace, props: Sequence[mpf]) -> tuple[list, list]:
    """Values (one, or two of an anisotropic law) and the state at the end."""
    found = module(law.name).value(q, props)
    value, state = found if law.states else (found, ())
    return (list(value) if law.anisotropic else [value]), list(state)


def _point(law: laws.Law, given: dict[str, Any], props: Sequence[float]) -> dict[str, Any]:
    """One point with its values, in double (with derivatives) and in single precision."""
    point = quantities(given, POINT, law.name)
    made = {k: v for k, v in point.items() if k not in _MARKS}
    for precision, rounding in (("double", _same), ("single", single)):
        q, exact = _namespace(point, rounding), _exact(props, rounding)
        value, state = point_values(law, q, exact)
        made[precision] = {"value": value} | ({"state": state} if law.states else {})
        if precision == "double":
            made[precision]["derivative"] = _differences(
                lambda at, p=exact: point_values(law, at, p)[0], q, VARIABLES, point
            )
    return made


def _path(law: laws.Law, given: Sequence[dict], props: Sequence[float], plane: bool) -> list[dict]:
    """The increments of a path with their results in both precisions."""
    path = [quantities(increment, INCREMENT, law.name) for increment in given]
    made = [{k: v for k, v in point.items() if k not in _MARKS} for point in path]
    update = module(law.name).update
    vectors, states = law.count(props)
    for precision, rounding in (("double", _same), ("single", single)):
        exact = _exact(props, rounding)
        kept = (((mpf(0), mpf(0)),) * vectors, (mpf(0),) * states)
        for point, row in zip(path, made, strict=True):
            if plane:
                point = {**point, "motion": (point["motion"][0], 0.0)}
                row["motion"] = list(point["motion"])
            q = _namespace(point, rounding)
            q.vectors, q.state = kept
            traction, *kept = update(q, exact)
            kept = tuple(map(tuple, kept[0])), tuple(kept[1])
            row[precision] = {"traction": list(traction), "vectors": kept[0], "state": kept[1]}
            if precision == "double":
                row[precision]["tangent"] = _differences(
                    lambda at, p=exact: update(at, p)[0], q, BRISTLE_VARIABLES, point
                )
    return made


def values(name: str) -> dict[str, Any]:
    """All reference values of a law, as they are written."""
    law = laws.law(name)
    made = []
    with workdps(DIGITS):
        for case in module(name).CASES:
            props = [float(p) for p in case["props"]]
            if law.kind == "bristle":
                paths = [False, True] if not made else [False]  # the first also in one direction
                for plane in paths:
                    rows = _path(law, case["path"], props, plane)
                    made.append({"props": props, "directions": 1 if plane else 2, "path": rows})
            else:
                points = [_point(law, p, props) for p in case["points"]]
                made.append({"props": props, "points": points})
    return {
        "about": "Written by `python -m tests.laws.reference` from reference.py; do not edit.",
        "law": name,
        "derivatives by": list(BRISTLE_VARIABLES if law.kind == "bristle" else VARIABLES),
        "cases": made,
    }


def _number(x: Any, law: str) -> str:
    if x is None:
        return "null"
    if not isinstance(x, mpf):
        return json.dumps(x)
    if not mp.isfinite(x):
        raise SystemExit(f"{law}: a reference value is {x}; take the point out or mark it")
    return mp.nstr(x, WRITTEN, strip_zeros=True)


def _text(value: Any, law: str, indent: int = 0) -> str:
    """JSON with every point or increment on lines of its own."""
    pad = " " * (indent + 1)
    if isinstance(value, dict):
        inner = [f"{json.dumps(k)}: {_text(v, law, indent + 1)}" for k, v in value.items()]
        flat = "{" + ", ".join(inner) + "}"
        if len(flat) + indent <= 100 and "\n" not in flat:
            return flat
        return "{\n" + ",\n".join(pad + line for line in inner) + "\n" + " " * indent + "}"
    if isinstance(value, list | tuple):
        inner = [_text(v, law, indent + 1) for v in value]
        if not any(line.startswith("{") for line in inner):
            return "[" + ", ".join(inner) + "]"
        return "[\n" + ",\n".join(pad + line for line in inner) + "\n" + " " * indent + "]"
    return _number(value, law)


def text(name: str) -> str:
    """`reference.json` of a law."""
    return _text(values(name), name) + "\n"


def with_reference() -> Iterator[str]:
    """Laws that have a `reference.py`."""
    return (name for name in laws.LAWS if (laws.law(name).folder / "reference.py").is_file())


def main(arguments: list[str] | None = None) -> int:
    """Runs the command; returns 0, or 1 if `--check` finds a difference."""
    parser = argparse.ArgumentParser(prog="python -m tests.laws.reference", description=__doc__)
    parser.add_argument("--check", action="store_true", help="compare only; exit 1 if they differ")
    parser.add_argument("laws", nargs="*", metavar="LAW", help="laws; by default all")
    options = parser.parse_args(arguments)
    differ = []
    for name in options.laws or with_reference():
        wanted = text(name)
        if not file(name).is_file() or file(name).read_text(encoding="utf-8") != wanted:
            differ.append(name)
            if not options.check:
                file(name).write_text(wanted, encoding="utf-8")
    words = "differs from reference.py" if options.check else "written"
    print("\n".join(f"{file(name)}: {words}" for name in differ) or "reference values are current")
    return 1 if differ and options.check else 0


if __name__ == "__main__":
    sys.exit(main())
