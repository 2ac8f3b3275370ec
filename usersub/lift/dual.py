# SPDX-License-Identifier: MIT
"""Numbers with derivatives, for the interpreter: what a law calculates with under a debugger.

The value is calculated exactly as without derivatives: by the same operation on the same operands.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any

from usersub.errors import ContractError
from usersub.lift import rules

#: Sentence for what would make a plain number of a dual.
LOSES = "{} of a quantity that carries derivatives would lose them; calculate with it as it is"


class Dual:
    """A value and its derivatives by the variables of the law.

    Attributes:
        value: the number.
        partials: its derivatives, from above where it has a kink.
    """

    __slots__ = ("partials", "value")

    def __init__(self, value: Any, partials: tuple[float, ...]):
        self.value, self.partials = value, partials

    def __repr__(self) -> str:
        return f"Dual({float(self.value)!r}, {self.partials!r})"

    def __add__(self, other: Any) -> Dual:
        return _two(operator.add, self, other, lambda x, y, v, p, q: p + q)

    def __radd__(self, other: Any) -> Dual:
        return _two(operator.add, other, self, lambda x, y, v, p, q: p + q)

    def __sub__(self, other: Any) -> Dual:
        return _two(operator.sub, self, other, lambda x, y, v, p, q: p - q)

    def __rsub__(self, other: Any) -> Dual:
        return _two(operator.sub, other, self, lambda x, y, v, p, q: p - q)

    def __mul__(self, other: Any) -> Dual:
        return _two(operator.mul, self, other, _product)

    def __rmul__(self, other: Any) -> Dual:
        return _two(operator.mul, other, self, _product)

    def __truediv__(self, other: Any) -> Dual:
        return _two(operator.truediv, self, other, _quotient)

    def __rtruediv__(self, other: Any) -> Dual:
        return _two(operator.truediv, other, self, _quotient)

    def __pow__(self, other: Any) -> Dual:
        return _smooth_two("pow", operator.pow, self, other)

    def __rpow__(self, other: Any) -> Dual:
        return _smooth_two("pow", operator.pow, other, self)

    def __mod__(self, other: Any) -> Dual:
        return _smooth_two("mod", operator.mod, self, other)

    def __rmod__(self, other: Any) -> Dual:
        return _smooth_two("mod", operator.mod, other, self)

    def __floordiv__(self, other: Any) -> Any:
        return self.value // _value(other)

    def __rfloordiv__(self, other: Any) -> Any:
        return other // self.value

    def __neg__(self) -> Dual:
        return Dual(-self.value, tuple(-p for p in self.partials))

    def __pos__(self) -> Dual:
        return self

    def __abs__(self) -> Dual:
        return _kink_one(rules.absolute, abs, self)

    def __eq__(self, other: object) -> Any:
        return self.value == _value(other)

    def __ne__(self, other: object) -> Any:
        return self.value != _value(other)

    def __lt__(self, other: Any) -> Any:
        return self.value < _value(other)

    def __le__(self, other: Any) -> Any:
        return self.value <= _value(other)

    def __gt__(self, other: Any) -> Any:
        return self.value > _value(other)

    def __ge__(self, other: Any) -> Any:
        return self.value >= _value(other)

    __hash__ = None  # type: ignore[assignment]

    def __bool__(self) -> bool:
        return bool(self.value)

    def __int__(self) -> int:
        return int(self.value)

    def __floor__(self) -> int:
        return math.floor(self.value)

    def __ceil__(self) -> int:
        return math.ceil(self.value)

    def __trunc__(self) -> int:
        return math.trunc(self.value)

    def __round__(self, digits: int | None = None) -> Any:
        if digits is None:
            return round(self.value)
        raise ContractError("round() to digits has no derivative")

    def __float__(self) -> float:
        raise ContractError(LOSES.format("float()"))

    def __complex__(self) -> complex:
        raise ContractError(LOSES.format("complex()"))

    def __divmod__(self, other: Any) -> Any:
        return self // other, self % other

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **more: Any) -> Any:
        name = ufunc.__name__
        if method == "__call__" and not more:
            if name in OPERATORS:
                # A numpy number as the first operand would come back here.
                constant = (0.0,) * len(self.partials)
                first = inputs[0] if isinstance(inputs[0], Dual) else Dual(inputs[0], constant)
                return getattr(operator, OPERATORS[name])(first, *inputs[1:])
            name = _MATH_NAMES.get(name, name)
            if name in FUNCTIONS:
                return calculate(name, ufunc, *inputs)
        raise ContractError(refusal(f"numpy.{ufunc.__name__}"))

    def __array_function__(self, function: Any, kinds: Any, inputs: Any, more: Any) -> Any:
        import numpy as np

        if function is np.where and len(inputs) == 3 and not more:
            return inputs[1] if inputs[0] else inputs[2]
        if function is np.clip and len(inputs) == 3 and not more:
            least = _kink_two("max", max, inputs[0], inputs[1])
            return _kink_two("min", min, least, inputs[2])
        if function is np.interp and len(inputs) == 3 and not more and isinstance(inputs[0], Dual):
            x, points, values = inputs
            slope = rules.interpolation_slope(x.value, points, values)
            return Dual(np.interp(x.value, points, values), tuple(slope * p for p in x.partials))
        raise ContractError(refusal(f"numpy.{function.__name__}"))


#: numpy's functions that are operators.
OPERATORS = {
    "add": "add", "subtract": "sub", "multiply": "mul", "divide": "truediv",
    "true_divide": "truediv", "power": "pow", "negative": "neg", "positive": "pos",
    "remainder": "mod", "floor_divide": "floordiv", "less": "lt", "less_equal": "le",
    "greater": "gt", "greater_equal": "ge", "equal": "eq", "not_equal": "ne", "absolute": "abs",
}  # fmt: skip

_MATH_NAMES = {numpy: name for name, numpy in rules.NUMPY_NAMES.items()}


def refusal(name: str) -> str:
    """Sentence for a function that no rule knows."""
    return (
        f"{name} has no derivative rule; known are "
        f"{', '.join(sorted(FUNCTIONS))}: use them, or derivatives='own'"
    )


def calculate(name: str, plain: Callable, *inputs: Any) -> Any:
    """A function of `math` or numpy of which at least one argument is a Dual.

    Args:
        name: its name in `math`.
        plain: the function itself, for the value.
    """
    return FUNCTIONS[name](name, plain, *inputs)


def _value(x: Any) -> Any:
    return x.value if isinstance(x, Dual) else x


def _product(x: Any, y: Any, v: Any, p: float, q: float) -> float:
    return p * y + x * q


def _quotient(x: Any, y: Any, v: Any, p: float, q: float) -> float:
    return (p - v * q) / y


def _two(plain: Callable, x: Any, y: Any, rule: Callable) -> Any:
    """A function of two arguments by the derivative `rule` of (x, y, v, px, py)."""
    if not all(isinstance(a, Dual) or _is_number(a) for a in (x, y)):
        return NotImplemented
    count = len((x if isinstance(x, Dual) else y).partials)
    zeros = (0.0,) * count
    px = x.partials if isinstance(x, Dual) else zeros
    py = y.partials if isinstance(y, Dual) else zeros
    x, y = _value(x), _value(y)
    v = plain(x, y)
    return Dual(v, tuple(float(rule(x, y, v, p, q)) for p, q in zip(px, py, strict=True)))


def _is_number(x: Any) -> bool:
    import numpy as np

    return isinstance(x, int | float | np.integer | np.floating | np.bool_)


def _times(factor: Callable[[], float], p: float, infinite: float) -> float:
    """Factor times p; a p of zero stays zero where the factor may be infinite."""
    if p == 0.0 and infinite:
        return 0.0
    try:
        return factor() * p
    except ZeroDivisionError:
        return infinite * math.copysign(math.inf, p)


def _smooth_one(name: str, plain: Callable, x: Dual) -> Dual:
    v = plain(x.value)
    rule, infinite = rules.ONE[name], rules.INFINITE.get(name, 0.0)
    return Dual(v, tuple(_times(lambda: rule(x.value, v), p, infinite) for p in x.partials))


def _smooth_two(name: str, plain: Callable, x: Any, y: Any) -> Any:
    by_x, by_y = rules.TWO[name]
    infinite = rules.INFINITE.get(name, 0.0)

    def rule(a: Any, b: Any, v: Any, p: float, q: float) -> float:
        first = _times(lambda: by_x(a, b, v), p, infinite) if p else 0.0
        return first + (_times(lambda: by_y(a, b, v), q, infinite) if q else 0.0)

    return _two(plain, x, y, rule)


def _kink_one(rule: Callable, plain: Callable, x: Dual) -> Dual:
    return Dual(plain(x.value), tuple(float(rule(x.value, p)) for p in x.partials))


def _kink_two(name: str, plain: Callable, *inputs: Any) -> Any:
    rule = rules.KINKS_OF_TWO[name]
    result = inputs[0]
    for x in inputs[1:]:
        if isinstance(x, Dual) or isinstance(result, Dual):
            result = _two(plain, result, x, lambda a, b, v, p, q: rule(a, b, p, q))
        else:
            result = plain(result, x)
    return result


def _step(name: str, plain: Callable, x: Dual) -> Any:
    return plain(x.value)


#: How each function that knows duals is calculated.
FUNCTIONS: dict[str, Callable] = {
    **dict.fromkeys(rules.ONE, _smooth_one),
    **dict.fromkeys(rules.TWO, _smooth_two),
    **{n: lambda name, plain, x: _kink_one(rules.KINKS_OF_ONE[name], plain, x)
       for n in rules.KINKS_OF_ONE},
    **dict.fromkeys(rules.KINKS_OF_TWO, _kink_two),
    **dict.fromkeys((*rules.STEPS, *rules.TESTS), _step),
}  # fmt: skip
