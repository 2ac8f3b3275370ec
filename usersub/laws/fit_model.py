# SPDX-License-Identifier: MIT
"""A law as a function from parameters to coefficients at the rows of a table."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.driver.law import LawLike
from usersub.errors import SceneError
from usersub.laws.description import Law
from usersub.laws.fit_table import Table
from usersub.laws.law_object import LawObject
from usersub.laws.parts import Prop, Variable
from usersub.laws.registry import law as law_called
from usersub.laws.values import hint

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Stick force above every friction force of a table.
_NO_STICK = 1e300


class Model:
    """A law with its parameters: numbers, and entries of arrays such as "table[3]".

    Attributes:
        names: the parameters.
        start, scale: their start values and typical sizes.
        lower, upper: their bounds.
        held: parameters that are not fitted.
        numerical: parameters that only keep numbers finite.
    """

    def __init__(self, law: Any, table: Table, start: Mapping[str, Any]):
        self.function = law if isinstance(law, LawLike) and not isinstance(law, LawObject) else None
        given = law if isinstance(law, LawObject) else None
        described: Law
        if self.function is not None:
            described = _description(self.function, start)
        elif isinstance(law, str):
            described = law_called(law)
        elif isinstance(law, LawObject):
            described = law.law
        elif isinstance(law, Law):
            described = law
        else:
            raise SceneError(
                f"fit got {type(law).__name__} as its law; expected a name, usersub.laws.NAME, "
                "usersub.laws.NAME(...) or a law function"
            )
        _check_law(described, table)
        values = {**described.example, **(given.values if given is not None else {}), **start}
        self.law, self.table = described, table
        self.language = given.language if given is not None else "python"
        self.base = described(**values)
        self.told = given is not None or bool(start)
        self.names: list[str] = []
        self.held: set[str] = set()
        self.numerical: set[str] = set()
        numbers, props = [], []
        for prop in described.props:
            if not prop.given:
                continue
            flat = _leaves(self.base.values[prop.name])
            names = [prop.name] if not prop.shape else _entries(prop, len(flat))
            self.names += names
            numbers += flat
            props += [prop] * len(names)
            if not prop.fitted:
                self.numerical |= set(names)
            if prop.ascending or prop.lists or prop.range.whole or prop.range.choices:
                self.held |= set(names)  # where a table stands is no parameter
        self.props = props
        self.start = np.array(numbers, dtype=float)
        low = [_bound(p.range.at_least, p.range.above, -np.inf) for p in props]
        high = [_bound(p.range.at_most, p.range.below, np.inf) for p in props]
        self.lower, self.upper = (np.array(ends, dtype=float) for ends in (low, high))
        sizes = np.array([_size(p.unit, table) for p in props])
        self.by_unit = np.where(np.isnan(sizes), self.start, sizes)
        self.scale = np.maximum(np.abs(self.start), np.nan_to_num(1e-3 * sizes))
        self.scale[self.scale == 0] = np.nan_to_num(sizes, nan=1.0)[self.scale == 0]

    def indices(self, name: str) -> list[int]:
        """Places of a parameter, or of all entries of an array.

        Raises:
            SceneError: there is no such parameter.
        """
        found = [i for i, n in enumerate(self.names) if n == name or n.startswith(f"{name}[")]
        if not found:
            raise SceneError(
                f"{self.law.name} has no parameter '{name}'{hint(name, self.names)} "
                f"Parameters: {', '.join(self.names) or 'none'}"
            )
        return found

    def law_at(self, numbers: np.ndarray) -> LawObject:
        """The law with these parameters."""
        rest = iter(float(x) for x in numbers)
        values = {}
        for prop in self.law.props:
            if prop.given:
                value = self.base.values[prop.name]
                values[prop.name] = _filled(value, rest) if prop.shape else next(rest)
        return LawObject(self.law, values, self.language)

    def coefficients(self, numbers: np.ndarray) -> np.ndarray:
        """The coefficient at every row of the table."""
        law = self.law_at(numbers)
        maker = law if self.function is None else self.function
        if "vfric_coef" in maker.interfaces:
            return _coefficients(maker.behind("vfric_coef"), law.props, self.table)
        forces = _forces(maker.behind("vfriction"), law.props, self.table)
        return forces / self.table.get("pressure")


def _description(function: Any, start: Mapping[str, Any]) -> Law:
    """A law function's properties as the array `props`."""
    told = function.description
    if "props" not in start:
        raise SceneError(
            f'{function.name} is a law function and needs start={{"props": [...]}}: as many start '
            "values as it has properties"
        )
    return Law(
        name=function.name,
        folder=Path(told.origin),
        title=function.name,
        kind="bristle" if told.vectors != 0 else told.kind,
        equations=(function.name,),
        source=told.origin,
        props=(Prop("props", "any", "properties", shape=(str(len(start["props"])),)),),
        states=() if told.states == 0 else (Variable("state", "any", "state variables"),),
        anisotropic=function.anisotropic,
        example={"props": list(start["props"])},
    )


def _check_law(law: Law, table: Table) -> None:
    what = ""
    if law.kind not in ("coefficient", "strength", "traction"):
        what = f"it is a {law.kind} law, whose traction depends on the motion so far"
    elif law.anisotropic:
        what = "it gives two coefficients"
    elif law.states or "slip_increment" in law.reads:
        what = "it has a memory, and rows of a table have none"
    elif not law.props:
        what = "it has no parameters"
    if what:
        raise SceneError(f"{law.name} cannot be fitted to a table: {what}")
    needed = [c for c, q in (("rate", "slip_rate"), ("pressure", "pressure"),
                             ("temperature", "temperature")) if q in law.reads]  # fmt: skip
    if law.kind != "coefficient":
        needed.append("pressure")  # mu is the stress over it
        if not (table.get("pressure") > 0).all():
            raise SceneError(f"{law.name} gives a stress; mu needs a pressure above 0 in every row")
    # A tabulated law may have a single point of a variable.
    tabulated = any(p.ascending for p in law.props)
    for name in dict.fromkeys(needed):
        if not tabulated and name not in table.columns:
            raise SceneError(f"{law.name} depends on the {name}, but the table has no such column")


def _coefficients(routine: Routine, props: tuple[float, ...], table: Table) -> np.ndarray:
    import usersub

    fields = table.fields
    scene = usersub.Scene(points=table.rows, temperatures=1, fields=len(fields))
    driver = usersub.CoefficientDriver(routine, scene.replace(props=props))
    arrays: dict[str, Any] = {"slip_rate": table.get("rate"), "pressure": table.get("pressure")}
    arrays["temperature"] = table.get("temperature")
    if len(fields):
        arrays["field"] = np.asfortranarray(fields)
    return driver.evaluate(time_increment=1.0, **arrays)


def _forces(routine: Routine, props: tuple[float, ...], table: Table) -> np.ndarray:
    """Friction forces of points of unit area that slide along the first direction."""
    import usersub

    n, fields = table.rows, table.fields
    scene = usersub.Scene(points=n, nodes=n + 4, temperatures=1, fields=len(fields))
    driver = usersub.ExplicitDriver(routine, scene.replace(props=props))
    slip, normal = np.zeros((3, n), order="F"), np.zeros((3, n), order="F")
    slip[0], normal[2] = table.get("rate"), 1.0
    arrays: dict[str, Any] = {
        "slip_increment": slip, "normal": normal, "normal_force": table.get("pressure"),
        "stick_force": np.full(n, _NO_STICK), "area": np.ones(n),
        "temperature_secondary": table.get("temperature"),
        "temperature_main": table.get("temperature"),
        "secondary_node": np.arange(1, n + 1, dtype=np.int32).reshape(1, n, order="F"),
        "main_node": np.full((4, n), n + 1, np.int32, order="F"),
    }  # fmt: skip
    if len(fields):
        arrays["field_secondary"] = arrays["field_main"] = np.asfortranarray(fields)
    force = driver.step(1.0, **{k: a for k, a in arrays.items() if k in driver.layout.ports}).force
    return np.linalg.norm(force, axis=0)


def _entries(prop: Prop, count: int) -> list[str]:
    return [f"{prop.name}[{i}]" for i in range(count)]


def _leaves(value: Any) -> list[float]:
    if isinstance(value, list):
        return [x for part in value for x in _leaves(part)]
    return [float(value)]


def _filled(value: Any, rest: Iterator[float]) -> Any:
    """Nested lists of the same form with other numbers."""
    if isinstance(value, list):
        return [_filled(part, rest) for part in value]
    return next(rest)


def _bound(closed: float | None, opened: float | None, none: float) -> float:
    return closed if closed is not None else opened if opened is not None else none


def _size(unit: str, table: Table) -> float:
    """Typical size of a quantity with this unit at the rows of the table; NaN if not known."""
    rate = table.get("rate")
    sizes = {
        "length/time": _middle(rate),
        "stress": _middle(table.get("pressure")),
        "temperature": _middle(np.abs(table.get("temperature"))),
    }
    stress, speed = sizes["stress"], sizes["length/time"]
    traction = stress * float(np.mean(np.abs(table.get("mu")))) or np.nan
    sizes |= {"time/length": 1 / speed, "1/stress": 1 / stress, "-": np.nan}
    sizes |= {"1/temperature": 1 / sizes["temperature"]}
    sizes |= {"stress time/length": traction / speed, "length/(time stress)": speed / traction}
    plain = re.sub(r"\s+", " ", unit.strip())
    return sizes.get(plain, np.nan)


def _middle(values: np.ndarray) -> float:
    positive = values[values > 0]
    return float(np.median(positive)) if positive.size else np.nan
