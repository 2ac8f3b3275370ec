# SPDX-License-Identifier: MIT
"""Functions of duals for numba: `math`, numpy's spellings, powers, max and min."""

from __future__ import annotations

import builtins
import math
import operator
from collections.abc import Callable, Iterator, Sequence
from types import BuiltinFunctionType
from typing import Any

import numpy as np
from numba.core import types, typing
from numba.core.errors import TypingError
from numba.core.imputils import lower_builtin
from numba.core.registry import cpu_target
from numba.core.typing.templates import AbstractTemplate, infer_global
from numba.extending import box, intrinsic, overload, register_jitable

from usersub.lift import dual, primitives, rules
from usersub.lift.machine_dual import (
    F8,
    REAL,
    DualType,
    Operand,
    both,
    call_rule,
    is_dual,
    is_number,
    lift,
    pack,
    plain_real,
    without_derivative,
)

#: Most arguments of max and min.
_MOST_EXTREMES = 12


def spellings(name: str) -> Iterator[Callable]:
    """The functions of `math` and numpy that numba knows by the name of `math`."""
    for module, spelled in ((math, name), (np, rules.NUMPY_NAMES.get(name, name))):
        function = getattr(module, spelled, None)
        if function is not None and _known(function):
            yield function


def _known(function: Callable) -> bool:
    """Whether numba compiles the function for plain numbers."""
    context = cpu_target.typing_context
    try:
        context.resolve_value_type(function)
    except (TypingError, KeyError, ValueError):
        return False
    return True


def times(builder: Any, factor: Any, p: Any, infinite: bool) -> Any:
    """Factor times p; a p of zero stays zero where the factor may be infinite."""
    product = builder.fmul(factor, p)
    if not infinite:
        return product
    still = builder.fcmp_ordered("==", p, REAL(0.0))
    return builder.select(still, REAL(0.0), product)


def _smooth_one(name: str, function: Callable) -> Callable:
    def result(context: Any, builder: Any, operands: Sequence[Operand]) -> Any:
        x = operands[0]
        value = plain_real(context, builder, function, operands)
        factor = call_rule(context, builder, rules.ONE[name], x.real, value)
        infinite = name in rules.INFINITE
        return value, [times(builder, factor, p, infinite) for p in x.partials or ()]

    return result


def _smooth_two(name: str, function: Callable) -> Callable:
    """Partials of a function of two variables; powers by whole numbers are in `_power`."""

    def result(context: Any, builder: Any, operands: Sequence[Operand]) -> Any:
        value = plain_real(context, builder, function, operands)
        reals = [o.real for o in operands]
        factors = [
            call_rule(context, builder, rule, *reals, value) if o.partials is not None else None
            for rule, o in zip(rules.TWO[name], operands, strict=True)
        ]
        partials = []
        for pair in both(*operands):
            terms = [
                times(builder, factor, p, True)
                for factor, p in zip(factors, pair, strict=True)
                if p is not None
            ]
            partials.append(terms[0] if len(terms) == 1 else builder.fadd(*terms))
        return value, partials

    return result


def _kink_one(name: str, function: Callable) -> Callable:
    def result(context: Any, builder: Any, operands: Sequence[Operand]) -> Any:
        x, rule = operands[0], rules.KINKS_OF_ONE[name]
        value = plain_real(context, builder, function, operands)
        return value, [call_rule(context, builder, rule, x.real, p) for p in x.partials or ()]

    return result


def _kink_two(name: str, function: Callable) -> Callable:
    def result(context: Any, builder: Any, operands: Sequence[Operand]) -> Any:
        x, y = operands
        value = plain_real(context, builder, function, operands)
        return value, kink_partials(context, builder, name, x, y)

    return result


def kink_partials(context: Any, builder: Any, name: str, x: Operand, y: Operand) -> list:
    """Partials of max, min, hypot or copysign."""
    zero = REAL(0.0)
    return [
        call_rule(
            context, builder, rules.KINKS_OF_TWO[name], x.real, y.real,
            zero if p is None else p, zero if q is None else q,
        )
        for p, q in both(x, y)
    ]  # fmt: skip


def _define() -> None:
    """Tells numba all functions of the rules."""
    for name in rules.ONE:
        for function in spellings(name):
            lift(function, 1, _smooth_one(name, function))
    for name in rules.KINKS_OF_ONE:
        for function in (*spellings(name), *((abs, np.absolute) if name == "fabs" else ())):
            lift(function, 1, _kink_one(name, function))
    for name in rules.TWO:
        for function in spellings(name):
            lift(function, 2, _smooth_two(name, function))
    for name in rules.KINKS_OF_TWO:
        for function in spellings(name):
            lift(function, 2, _kink_two(name, function))
    for name in (*rules.STEPS, *rules.TESTS):
        for function in spellings(name):
            lift(function, 1, without_derivative(function))
    lift(int, 1, without_derivative(int))
    lift(round, 1, without_derivative(round))
    for function in (operator.mod, operator.imod, np.remainder):
        lift(function, 2, _smooth_two("mod", operator.mod))
    for function in (operator.pow, operator.ipow, pow):
        lift(function, 2, _smooth_two("pow", operator.pow))
        lower_builtin(function, DualType, types.IntegerLiteral)(_whole_power)
        lower_builtin(function, DualType, types.Integer)(_whole_power)


def _whole_power(context: Any, builder: Any, signature: Any, values: Any) -> Any:
    """x**n for a whole n: the value as numba multiplies it out, the derivative n x**(n-1)."""
    x = Operand(context, builder, signature.args[0], values[0])
    exponent, n = signature.args[1], values[1]
    if isinstance(exponent, types.IntegerLiteral):
        if abs(exponent.literal_value) > 0x10000:
            raise NotImplementedError
        less: Any = types.literal(exponent.literal_value - 1)
        n_less, n_real = None, REAL(float(exponent.literal_value))
    else:
        less = exponent
        one = builder.select(builder.icmp_signed("==", n, n.type(0)), n.type(0), n.type(1))
        n_less = builder.sub(n, one)
        n_real = context.cast(builder, n, exponent, F8)

    def power(ty: Any, whole: Any) -> Any:
        plain = typing.signature(F8, F8, ty)
        return context.get_function(operator.pow, plain)(builder, (x.real, whole))

    value = power(exponent, n)
    factor = builder.fmul(n_real, power(less, n_less))
    zero = builder.fcmp_ordered("==", n_real, REAL(0.0))
    factor = builder.select(zero, REAL(0.0), factor)
    return pack(builder, value, [times(builder, factor, p, True) for p in x.partials or ()])


def _extreme(function: Callable, name: str) -> None:
    """max or min of two and more numbers of which at least one is a dual."""

    class Extreme(AbstractTemplate):
        key = function

        def generic(self, args: tuple, kws: dict) -> Any:
            if kws or not 2 <= len(args) <= _MOST_EXTREMES or not any(map(is_dual, args)):
                return None
            if not all(is_dual(a) or is_number(a) for a in args):
                return None
            found = next(a for a in args if is_dual(a))
            return typing.signature(found, *[found] * len(args))

    infer_global(function)(Extreme)
    exceeds = operator.gt if name == "max" else operator.lt

    def lower(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        operands = [
            Operand(context, builder, ty, v) for ty, v in zip(signature.args, values, strict=True)
        ]
        best = operands[0]
        for other in operands[1:]:
            partials = kink_partials(context, builder, name, best, other)
            value = _larger(context, builder, exceeds, best, other)
            best = Operand(context, builder, F8, value)
            best.partials = partials
        return pack(builder, best.real, best.partials or ())

    for count in range(2, _MOST_EXTREMES + 1):
        lower_builtin(function, *[DualType] * count)(lower)


@intrinsic
def _moved(context, value, slope, x):
    """A dual of a value and of its slope by x."""

    def code(context, builder, signature, values):
        number = Operand(context, builder, x, values[2])
        partials = [builder.fmul(values[1], p) for p in number.partials or ()]
        return pack(builder, values[0], partials)

    return x(value, slope, x), code


@overload(np.where)
def _where(condition, x, y):
    if is_dual(x) or is_dual(y):
        return lambda condition, x, y: x if condition else y
    return None


@overload(np.clip)
def _clip(a, a_min, a_max):
    if all(is_dual(ty) or is_number(ty) for ty in (a, a_min, a_max)):
        # numba itself clips arrays only, so this serves plain numbers too.
        return lambda a, a_min, a_max: min(max(a, a_min), a_max)
    return None


@overload(np.interp)
def _interp(x, xp, fp):
    if not is_dual(x):
        return None
    slope = rules.interpolation_slope

    def interp(x, xp, fp):
        value = primitives.real(x)
        return _moved(np.interp(value, xp, fp), slope(value, xp, fp), x)

    return interp


def _of_tuple(function: Callable) -> None:
    """max or min of a tuple of numbers of which at least one is a dual."""

    @overload(function)
    def extreme(items):
        if isinstance(items, types.BaseTuple) and any(map(is_dual, items)):
            return lambda items: function(*items)
        return None


@box(DualType)
def _box(ty, value, c):
    """What `print` in a law shows: the value."""
    return c.pyapi.float_from_double(c.builder.extract_value(value, 0))


def _larger(context: Any, builder: Any, exceeds: Callable, x: Operand, y: Operand) -> Any:
    """As numba does it for plain numbers: the second one only if it exceeds the first."""
    compare = context.get_function(exceeds, typing.signature(types.boolean, F8, F8))
    return builder.select(compare(builder, (y.real, x.real)), y.real, x.real)


def _refuse(function: Any, sentence: str) -> None:
    """Has numba say why the function takes no dual."""

    class Refusal(AbstractTemplate):
        key = function

        def generic(self, args: tuple, kws: dict) -> Any:
            if any(map(is_dual, args)):
                raise TypingError(sentence)
            return None

    infer_global(function)(Refusal)


cpu_target.typing_context.refresh()


def _refuse_others() -> None:
    """Functions that numba knows and no rule does."""
    _refuse(float, dual.LOSES.format("float()"))
    _refuse(complex, dual.LOSES.format("complex()"))
    known = {id(function) for name in dual.FUNCTIONS for function in spellings(name)}
    known |= {id(getattr(np, name)) for name in dual.OPERATORS}
    for module in (math, np):
        for name, function in vars(module).items():
            if name.startswith("_") or id(function) in known:
                continue
            if isinstance(function, BuiltinFunctionType if module is math else np.ufunc):
                spelled = f"{module.__name__}.{name}"
                if module is math and name in dual.FUNCTIONS:
                    _refuse(function, f"numba does not know {spelled}; use numpy.{name}")
                else:
                    _refuse(function, dual.refusal(spelled))


for _rule in (
    rules.reciprocal_square, rules.square_of_sech, rules.absolute, rules.interpolation_slope,
):  # fmt: skip
    register_jitable(error_model="numpy")(_rule)
cpu_target.typing_context.refresh()
_define()
_extreme(builtins.max, "max")
_extreme(builtins.min, "min")
_of_tuple(builtins.max)
_of_tuple(builtins.min)
_refuse_others()
