# SPDX-License-Identifier: MIT
"""Numbers with derivatives as a numba type, and their arithmetic.

A dual is a structure of the value and its partial derivatives. Its value is made by the very code
that numba makes for a plain number, so it has the same bits. Numbers become duals of themselves
where a variable is now one and now the other; a dual never becomes a number by itself.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, compiler, types, typing
from numba.core.datamodel import models
from numba.core.datamodel.registry import register_default
from numba.core.imputils import lower_builtin, lower_cast
from numba.core.typeconv import Conversion
from numba.core.typing.templates import AbstractTemplate, infer_global

REAL = ir.DoubleType()
F8 = types.float64


class DualType(types.Type):
    """A number with `count` partial derivatives."""

    def __init__(self, count: int):
        self.count = count
        super().__init__(f"number with {count} derivatives")

    def unify(self, context: Any, other: Any) -> Any:
        """The type of a variable that is now a dual and now `other`."""
        return self if is_number(other) or other == self else None

    def can_convert_from(self, context: Any, other: Any) -> Any:
        """Numbers may become duals."""
        return Conversion.safe if is_number(other) else None


def is_number(ty: Any) -> bool:
    """Whether a type is that of plain numbers."""
    return isinstance(ty, types.Integer | types.Float | types.Boolean)


def is_dual(ty: Any) -> bool:
    """Whether a type is that of numbers with derivatives."""
    return isinstance(ty, DualType)


@register_default(DualType)
class _DualModel(models.StructModel):
    def __init__(self, manager: Any, fe_type: DualType):
        members = [("value", F8)] + [(f"partial{k}", F8) for k in range(fe_type.count)]
        super().__init__(manager, fe_type, members)


def pack(builder: Any, value: Any, partials: Sequence) -> Any:
    """A dual of its numbers."""
    dual = ir.Constant(ir.LiteralStructType([REAL] * (len(partials) + 1)), ir.Undefined)
    for k, part in enumerate((value, *partials)):
        dual = builder.insert_value(dual, part, k)
    return dual


class Operand:
    """One argument of an operation: its number and its derivatives, None where it has none."""

    def __init__(self, context: Any, builder: Any, ty: Any, value: Any):
        self.type, self.plain = ty, value
        self.partials: list | None = None
        if is_dual(ty):
            self.type, self.plain = F8, builder.extract_value(value, 0)
            self.partials = [builder.extract_value(value, k + 1) for k in range(ty.count)]
        #: the number as a real
        self.real = context.cast(builder, self.plain, self.type, F8)


def plain_call(context: Any, builder: Any, function: Callable, operands: Sequence[Operand]) -> Any:
    """What numba makes of the function for plain numbers, as a real, with its type before."""
    typer = context.typing_context
    arguments = tuple(o.type for o in operands)
    face = typer.resolve_value_type(function)
    signature = face.get_call_type(typer, arguments, {})
    values = [
        context.cast(builder, o.plain, o.type, ty)
        for o, ty in zip(operands, signature.args, strict=True)
    ]
    code = context.get_function(face, signature)
    context.add_linking_libs(getattr(code, "libs", ()))
    return code(builder, values), signature.return_type


def plain_real(context: Any, builder: Any, function: Callable, operands: Sequence[Operand]) -> Any:
    """The value of a function of plain numbers as a real."""
    value, ty = plain_call(context, builder, function, operands)
    return context.cast(builder, value, ty, F8)


def call_rule(context: Any, builder: Any, rule: Callable, *reals: Any) -> Any:
    """The value of a rule of `rules` for reals."""
    flags = compiler.Flags()
    flags.error_model = "numpy"
    signature = typing.signature(F8, *[F8] * len(reals))
    code = context.compile_subroutine(builder, rule, signature, flags=flags)
    return context.call_internal(builder, code.fndesc, signature, reals)


def lift(function: Callable, arity: int, result: Callable) -> None:
    """Tells numba that `function` takes duals in place of numbers.

    Args:
        function: the function or operator.
        arity: number of its arguments.
        result: makes code from (context, builder, operands); it returns the dual's value and
            partials, or a plain value of the type that numba gives for plain numbers.
    """

    class Template(AbstractTemplate):
        key = function

        def generic(self, args: tuple, kws: dict) -> Any:
            if kws or len(args) != arity or not any(map(is_dual, args)):
                return None
            if not all(is_dual(a) or is_number(a) for a in args):
                return None
            return typing.signature(returned(self.context, function, args, result), *args)

    infer_global(function)(Template)

    def lower(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        operands = [
            Operand(context, builder, ty, v) for ty, v in zip(signature.args, values, strict=True)
        ]
        made = result(context, builder, operands)
        return pack(builder, *made) if is_dual(signature.return_type) else made

    kinds = [[]]
    for _ in range(arity):
        kinds = [[*k, one] for k in kinds for one in (DualType, types.Number, types.Boolean)]
    for kind in kinds:
        if DualType in kind:
            lower_builtin(function, *kind)(lower)


def returned(context: Any, function: Callable, args: tuple, result: Callable) -> Any:
    """Type of what a lifted function returns."""
    dual = next(a for a in args if is_dual(a))
    if getattr(result, "gives_dual", True):
        return dual
    plain = tuple(F8 if is_dual(a) else a for a in args)
    return context.resolve_function_type(function, plain, {}).return_type


def without_derivative(function: Callable) -> Callable:
    """Code of a function whose result has no derivative: comparisons, steps."""

    def result(context: Any, builder: Any, operands: Sequence[Operand]) -> Any:
        return plain_call(context, builder, function, operands)[0]

    result.gives_dual = False  # type: ignore[attr-defined]
    return result


def _linear(operation: str) -> Callable:
    """Partials of a sum or a difference."""

    def part(builder: Any, p: Any, q: Any) -> Any:
        if p is None:
            return q if operation == "fadd" else builder.fneg(q)
        return p if q is None else getattr(builder, operation)(p, q)

    def result(context: Any, builder: Any, operands: Sequence[Operand]) -> Any:
        x, y = operands
        function = operator.add if operation == "fadd" else operator.sub
        value = plain_real(context, builder, function, operands)
        return value, [part(builder, p, q) for p, q in both(x, y)]

    return result


def both(x: Operand, y: Operand) -> list:
    """Pairs of partials of two operands, None where one has none."""
    count = len(x.partials or y.partials or ())
    return list(zip(x.partials or [None] * count, y.partials or [None] * count, strict=True))


def _product(context: Any, builder: Any, operands: Sequence[Operand]) -> Any:
    x, y = operands
    value = plain_real(context, builder, operator.mul, operands)
    partials = []
    for p, q in both(x, y):
        terms = [builder.fmul(p, y.real)] if p is not None else []
        terms += [builder.fmul(x.real, q)] if q is not None else []
        partials.append(terms[0] if len(terms) == 1 else builder.fadd(*terms))
    return value, partials


def _quotient(context: Any, builder: Any, operands: Sequence[Operand]) -> Any:
    x, y = operands
    value = plain_real(context, builder, operator.truediv, operands)
    partials = []
    for p, q in both(x, y):
        top = p
        if q is not None:
            reaction = builder.fmul(value, q)
            top = builder.fneg(reaction) if p is None else builder.fsub(p, reaction)
        partials.append(builder.fdiv(top, y.real))
    return value, partials


def _negative(context: Any, builder: Any, operands: Sequence[Operand]) -> Any:
    x = operands[0]
    value = plain_real(context, builder, operator.neg, operands)
    return value, [builder.fneg(p) for p in x.partials or ()]


def _same(context: Any, builder: Any, operands: Sequence[Operand]) -> Any:
    return operands[0].plain, operands[0].partials


for _name, _result in (
    ("add", _linear("fadd")), ("sub", _linear("fsub")), ("mul", _product), ("truediv", _quotient),
):  # fmt: skip
    lift(getattr(operator, _name), 2, _result)
    lift(getattr(operator, f"i{_name}"), 2, _result)
lift(operator.neg, 1, _negative)
lift(operator.pos, 1, _same)
for _ufunc, _result in (
    (np.add, _linear("fadd")), (np.subtract, _linear("fsub")), (np.multiply, _product),
    (np.divide, _quotient), (np.negative, _negative), (np.positive, _same),
):  # fmt: skip
    lift(_ufunc, _ufunc.nin, _result)
for _ufunc in (
    np.less, np.less_equal, np.greater, np.greater_equal, np.equal, np.not_equal, np.floor_divide,
):  # fmt: skip
    lift(_ufunc, 2, without_derivative(_ufunc))
for _comparison in ("lt", "le", "gt", "ge", "eq", "ne"):
    _function = getattr(operator, _comparison)
    lift(_function, 2, without_derivative(_function))
for _name in ("floordiv", "ifloordiv"):
    lift(getattr(operator, _name), 2, without_derivative(operator.floordiv))
lift(operator.not_, 1, without_derivative(operator.not_))
lift(bool, 1, without_derivative(bool))


@lower_cast(types.Integer, DualType)
@lower_cast(types.Float, DualType)
@lower_cast(types.Boolean, DualType)
def _number_to_dual(context, builder, from_type, to_type, value):
    real = context.cast(builder, value, from_type, F8)
    return pack(builder, real, [REAL(0.0)] * to_type.count)


@lower_cast(DualType, types.Boolean)
def _dual_to_truth(context, builder, from_type, to_type, value):
    return cgutils.is_not_null(builder, builder.extract_value(value, 0))
