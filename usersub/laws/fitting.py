# SPDX-License-Identifier: MIT
"""Fits the parameters of a law to measured coefficients, with their uncertainty."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from usersub.errors import MissingTool, RoutineError, SceneError
from usersub.laws.fit_model import Model
from usersub.laws.fit_table import Table, read
from usersub.laws.law_object import LawObject

#: Singular values of the scaled Jacobian below this share of the largest are none.
_RANK = 1e-6
#: Change of the coefficients, relative to them, by which nobody sees a parameter.
_NOTHING = 1e-9
#: Share in directions that the data do not see, from which on a parameter takes part in them.
_TAKES_PART = 0.01
#: Distance from a bound, in typical sizes, at which a parameter lies on it.
_ON_BOUND = 1e-6


class FitWarning(UserWarning):
    """A parameter is not identified, badly determined or on a bound."""


@dataclass(frozen=True)
class Fit:
    """What `fit` found.

    Attributes:
        law: the law with the fitted properties, which any driver takes; the law function itself
            where one was fitted.
        props: the fitted properties as the routines take them.
        parameters: value by name, fixed ones included.
        names: the fitted parameters, in the order of `covariance`.
        errors: standard error by name; 0 for fixed parameters, infinite where not identified,
            NaN where there are no more rows than parameters.
        covariance: of the fitted parameters.
        predicted: coefficients of the fit at the rows of the table.
        residuals: measured minus predicted coefficients.
        rms: root of the mean squared residual, weighted.
        degrees: rows less fitted parameters.
        warnings: sentences about parameters that the data do not determine.
    """

    law: Any
    props: tuple[float, ...]
    parameters: dict[str, float]
    names: tuple[str, ...]
    errors: dict[str, float]
    covariance: np.ndarray = field(repr=False)
    predicted: np.ndarray = field(repr=False)
    residuals: np.ndarray = field(repr=False)
    rms: float
    degrees: int
    warnings: tuple[str, ...]

    def __str__(self) -> str:
        equation = f": {self.law.equation}" if isinstance(self.law, LawObject) else ""
        lines = [self.law.name + equation]
        for name, value in self.parameters.items():
            error = f"+- {self.errors[name]:.3g}" if name in self.names else "(fixed)"
            lines.append(f"  {name} = {value:.8g} {error}")
        lines.append(f"  rms of residuals {self.rms:.3g}, {self.degrees} degrees of freedom")
        return "\n".join([*lines, *(f"  warning: {w}" for w in self.warnings)])


def fit(
    law: Any,
    table: Any,
    *,
    fixed: Mapping[str, Any] | Iterable[str] = (),
    start: Mapping[str, Any] | None = None,
    bounds: Mapping[str, tuple[float | None, float | None]] | None = None,
    weights: Sequence[float] | None = None,
) -> Fit:
    """Fits a law to measured coefficients by weighted least squares.

    Args:
        law: name of a coefficient, strength or viscous law without memory, or a law object, whose
            properties are the start values, or a law function, whose parameters are called
            props[0], props[1], ...
        table: rows (rate, pressure, temperature, mu): an array of these columns, a mapping from
            names to columns (also field_1, ... and weight), a data frame or the path of a CSV file.
            mu of a strength or viscous law is its stress over the pressure.
        fixed: properties that are not fitted: their values by name, or names that keep their start
            values. Points of tables are always fixed, and properties that only keep numbers finite
            (floors) unless `bounds` names them.
        start: start values by name; without any, the fit also starts from values that the units of
            the parameters and the table suggest.
        bounds: (low, high) by name, None for no bound; those of the law hold besides.
        weights: of the squared residuals; in proportion to 1/variance.

    Raises:
        SceneError: law, table or a parameter does not fit; the message says which.
        MissingTool: scipy is not installed.
    """
    try:
        from scipy.optimize import least_squares
    except ImportError as error:
        raise MissingTool(
            "fitting needs scipy; install it with `pip install 'usersub[fit]'`"
        ) from error
    rows = read(table)
    values = dict(fixed) if isinstance(fixed, Mapping) else {}
    model = Model(law, rows, {**(start or {}), **values})
    for name in values if values else fixed:
        model.held |= {model.names[i] for i in model.indices(name)}
    _bounds(model, bounds or {})
    model.held |= model.numerical - {model.names[i] for b in bounds or {} for i in model.indices(b)}
    free = np.array([i for i, name in enumerate(model.names) if name not in model.held], dtype=int)
    if not free.size:
        raise SceneError(f"{model.law.name}: all parameters are fixed; nothing is left to fit")
    root = np.sqrt(_weights(rows, weights))
    scale, lower, upper = (a[free] for a in (model.scale, model.lower, model.upper))
    measured = rows.get("mu")

    def numbers(z: np.ndarray) -> np.ndarray:
        full = model.start.copy()
        full[free] = np.clip(z * scale, lower, upper)
        return full

    def residuals(z: np.ndarray) -> np.ndarray:
        try:
            return (model.coefficients(numbers(z)) - measured) * root
        except (RoutineError, SceneError):  # not finite here, or outside of an open bound
            return np.full(rows.rows, 1e6 * (1.0 + np.abs(measured).max()))

    model.coefficients(model.start)  # what fails here is no matter of the search
    best = None
    for begin in _starts(model, free):
        inside = _inside(begin / scale, lower / scale, upper / scale)
        found = least_squares(
            residuals, inside, jac="3-point", bounds=(lower / scale, upper / scale),
            xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=400,
        )  # fmt: skip
        if best is None or found.cost < best.cost * (1 - 1e-9):
            best = found
    assert best is not None
    return _result(model, free, best, numbers(best.x), root, rows)


def _starts(model: Model, free: np.ndarray) -> list[np.ndarray]:
    """Start values of the fitted parameters: as told, else also by units."""
    starts = [model.start[free]]
    if not model.told:
        by_unit = np.where(model.start == 0, 0.0, model.by_unit)[free]
        starts += [by_unit, *(np.where(by_unit == model.start[free], by_unit, by_unit * f)
                              for f in (0.1, 10.0))]  # fmt: skip
    return [s for i, s in enumerate(starts) if not any(np.array_equal(s, t) for t in starts[:i])]


def _inside(z: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Start values well inside of their bounds."""
    width = np.where(np.isfinite(high - low), high - low, np.inf)
    margin = np.minimum(1e-3 * np.maximum(np.abs(z), 1.0), 0.1 * width)
    return np.clip(z, low + margin, high - margin)


def _bounds(model: Model, bounds: Mapping[str, tuple[float | None, float | None]]) -> None:
    for name, (low, high) in bounds.items():
        for i in model.indices(name):
            if low is not None:
                model.lower[i] = max(model.lower[i], low)
            if high is not None:
                model.upper[i] = min(model.upper[i], high)
            if not model.lower[i] < model.upper[i]:
                raise SceneError(
                    f"{model.law.name}: the bounds of {model.names[i]} are {model.lower[i]:g} and "
                    f"{model.upper[i]:g}; expected room in between"
                )


def _weights(rows: Table, weights: Sequence[float] | None) -> np.ndarray:
    found = rows.get("weight") if weights is None else np.asarray(weights, dtype=float)
    if found.shape != (rows.rows,) or not (np.isfinite(found).all() and (found >= 0).all()):
        raise SceneError(
            f"weights have the shape {found.shape}; expected {rows.rows} numbers of 0 or more"
        )
    if not found.any():
        raise SceneError("all weights are 0; expected at least one above")
    return found


def _result(
    model: Model, free: np.ndarray, best: Any, numbers: np.ndarray, root: np.ndarray, rows: Table
) -> Fit:
    names = [model.names[i] for i in free]
    scale = model.scale[free]
    told, lost = _identified(best.jac, names, float(np.linalg.norm(root * rows.get("mu"))))
    degrees = int((root > 0).sum()) - len(names)
    # The scatter is estimated from the residuals; weights only tell rows apart.
    variance = 2.0 * best.cost / degrees if degrees > 0 else np.nan
    covariance = variance * _inverse(best.jac) * np.outer(scale, scale)
    for i, name in enumerate(names):
        if name in lost:
            covariance[i, :] = covariance[:, i] = np.nan
            covariance[i, i] = np.inf
    errors = dict.fromkeys(model.names, 0.0)
    errors |= dict(zip(names, np.sqrt(np.diag(covariance)).tolist(), strict=True))
    if degrees <= 0:
        told.append(f"{len(names)} parameters from {degrees + len(names)} rows: no errors are told")
    for i, name in zip(free, names, strict=True):
        value, near = numbers[i], _ON_BOUND * model.scale[i]
        for bound in (model.lower[i], model.upper[i]):
            if abs(value - bound) <= near:
                told.append(f"{name} lies on its bound {bound:g}")
        if name not in lost and errors[name] > abs(value) > near:
            told.append(
                f"{name} is badly determined: its standard error {errors[name]:.3g} is larger "
                f"than its value {value:.3g}"
            )
    for sentence in told:
        warnings.warn(f"{model.law.name}: {sentence}", FitWarning, stacklevel=3)
    predicted = model.coefficients(numbers)
    residuals = rows.get("mu") - predicted
    return Fit(
        law=model.law_at(numbers) if model.function is None else model.function,
        props=model.law_at(numbers).props,
        parameters=dict(zip(model.names, numbers.tolist(), strict=True)),
        names=tuple(names),
        errors=errors,
        covariance=covariance,
        predicted=predicted,
        residuals=residuals,
        rms=float(np.sqrt(np.sum((root * residuals) ** 2) / np.sum(root**2))),
        degrees=max(degrees, 0),
        warnings=tuple(told),
    )


def _inverse(jacobian: np.ndarray) -> np.ndarray:
    """Inverse of J^T J on the directions that the data see, with columns of equal length."""
    lengths = np.linalg.norm(jacobian, axis=0)
    lengths[lengths == 0] = 1.0
    _, sizes, directions = np.linalg.svd(jacobian / lengths, full_matrices=False)
    seen = sizes > _RANK * sizes[0]
    root = directions[seen] / sizes[seen, np.newaxis]
    return root.T @ root / np.outer(lengths, lengths)


def _identified(jacobian: np.ndarray, names: list[str], size: float) -> tuple[list[str], set[str]]:
    """Sentences about directions that the data do not see, and the parameters in them.

    A column says how the residuals, of the given size, change where a parameter changes by its
    typical size. Columns are made equally long before the singular values tell which of them
    depend on one another.
    """
    lengths = np.linalg.norm(jacobian, axis=0)
    seen = lengths > _NOTHING * size
    told = [
        f"{name} is not identified: the data do not depend on it"
        for name, sees in zip(names, seen, strict=True)
        if not sees
    ]
    lost = {name for name, sees in zip(names, seen, strict=True) if not sees}
    if not seen.any():
        return told, lost
    rest = [name for name in names if name not in lost]
    unit = jacobian[:, seen] / lengths[seen]
    padded = np.vstack([unit, np.zeros((max(len(rest) - len(unit), 0), len(rest)))])
    _, sizes, directions = np.linalg.svd(padded, full_matrices=False)
    unseen = directions[sizes <= _RANK * sizes[0]]
    together = np.abs(unseen.T @ unseen) > _TAKES_PART
    while together.any():
        group = together[np.flatnonzero(together.any(axis=1))[0]]
        for _ in rest:
            group = together[group].any(axis=0) | group
        involved = [name for name, takes in zip(rest, group, strict=True) if takes]
        lost |= set(involved)
        told.append(
            f"{', '.join(involved)} are not identified: the data fit as well where they change "
            "together"
        )
        together[group] = together[:, group] = False
    return told, lost
