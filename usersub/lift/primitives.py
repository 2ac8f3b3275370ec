# SPDX-License-Identifier: MIT
"""What a lifted law is made of, as the interpreter runs it; `machine` compiles the same names.

A value with derivatives is a `Dual` here. State variables that a law reads and overwrites are held
in `DualArray`, so that what is stored keeps its derivatives until the law has returned.
"""

from __future__ import annotations

from typing import Any

from usersub.errors import ContractError
from usersub.lift.dual import Dual

#: Sentences about what a law may return and do.
RETURNS = "the function returns {}, expected {}"
SINGLE = "one number"
PAIR = "two numbers"
OWN = "value, (by slip_rate, by pressure, by temperature, by slip_increment)"
OWN_PAIRS = "(value 1, value 2), (derivatives 1, derivatives 2) with four derivatives each"
ELEMENTS = "state variables are read and written one by one: state[i], vectors[i, 0], vectors[i, 1]"
KEPT = (
    "an array of numbers would lose the derivatives of what is stored in it; use variables, tuples "
    "or state variables"
)


def scratch(count: int) -> Any:
    """`count` numbers of memory."""
    import numpy as np

    return np.empty(count)


def seed(value: Any, index: int, count: int) -> Dual:
    """A variable: the derivative by itself, number `index` of `count`, is one."""
    return Dual(value, tuple(1.0 if k == index else 0.0 for k in range(count)))


class DualArray:
    """Elements of an array of numbers, each with derivatives."""

    def __init__(self, numbers: Any, count: int):
        zeros = (0.0,) * count
        self._shape = numbers.shape
        self._zeros = zeros
        rows = numbers.shape[0]
        if numbers.ndim == 1:
            self._items = {(i,): Dual(numbers[i], zeros) for i in range(rows)}
        else:
            self._items = {(i, j): Dual(numbers[i, j], zeros) for i in range(rows) for j in (0, 1)}

    def __len__(self) -> int:
        return self._shape[0]

    def _key(self, index: Any) -> tuple[int, ...]:
        given = index if isinstance(index, tuple) else (index,)
        if len(given) != len(self._shape) or any(isinstance(i, slice) for i in given):
            raise ContractError(ELEMENTS)
        return tuple(range(n)[i] for i, n in zip(given, self._shape, strict=True))

    def __getitem__(self, index: Any) -> Dual:
        return self._items[self._key(index)]

    def __setitem__(self, index: Any, value: Any) -> None:
        if not isinstance(value, Dual):
            value = Dual(value, self._zeros)
        self._items[self._key(index)] = value

    def store(self, numbers: Any) -> None:
        """Writes the values back."""
        for key, item in self._items.items():
            numbers[key] = item.value


def dual_array(memory: Any, numbers: Any, count: int) -> DualArray:
    """The elements of `numbers` with `count` derivatives of zero each; `memory` is for machine
    code."""
    return DualArray(numbers, count)


def store(duals: DualArray, numbers: Any) -> None:
    """Writes the values of the elements back to `numbers`."""
    duals.store(numbers)


def real(value: Any) -> Any:
    """The value without its derivatives."""
    return value.value if isinstance(value, Dual) else value


def tiny(numbers: Any) -> float:
    """Smallest normal number of the precision of an array of numbers, such as `props`."""
    import numpy as np

    return float(np.finfo(getattr(numbers, "dtype", float)).tiny)


def partial(value: Any, index: int) -> Any:
    """Derivative number `index`; zero of a value that has none."""
    return value.partials[index] if isinstance(value, Dual) else 0.0


def number(result: Any) -> Any:
    """What a law returned that is to return one number."""
    import numpy as np

    if isinstance(result, np.ndarray) and result.ndim == 0:  # of numpy.where
        result = result[()]
    if isinstance(result, bool) or not isinstance(result, Dual | int | float | np.number):
        raise ContractError(RETURNS.format(_told(result), SINGLE))
    return result


def pair(result: Any) -> Any:
    """What a law returned that is to return two numbers."""
    if not isinstance(result, tuple) or len(result) != 2:
        raise ContractError(RETURNS.format(_told(result), PAIR))
    return number(result[0]), number(result[1])


def with_derivatives(result: Any) -> Any:
    """What a law returned that gives its own derivatives: value, four derivatives."""
    if not (_is_tuple(result, 2) and _is_tuple(result[1], 4)):
        raise ContractError(RETURNS.format(_told(result), OWN))
    return number(result[0]), result[1]


def pairs_with_derivatives(result: Any) -> Any:
    """As `with_derivatives`, of two values."""
    if not (_is_tuple(result, 2) and _is_tuple(result[1], 2)
            and all(_is_tuple(each, 4) for each in result[1])):  # fmt: skip
        raise ContractError(RETURNS.format(_told(result), OWN_PAIRS))
    return pair(result[0]), result[1]


def _is_tuple(value: Any, count: int) -> bool:
    return isinstance(value, tuple) and len(value) == count


def _told(result: Any) -> str:
    """A result in words."""
    if result is None:
        return "nothing"
    if isinstance(result, tuple):
        return f"a tuple of {len(result)}"
    return f"a {type(result).__name__}"
