# SPDX-License-Identifier: MIT
"""`primitives` for numba. Importing this module tells numba all about numbers with derivatives."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types, typing
from numba.core.datamodel import models
from numba.core.datamodel.registry import register_default
from numba.core.errors import TypingError
from numba.core.imputils import impl_ret_borrowed, lower_builtin
from numba.core.typing.templates import AbstractTemplate, infer_global
from numba.extending import intrinsic, overload, register_jitable
from numba.np import numpy_support

from usersub.lift import machine_functions, primitives
from usersub.lift.machine_dual import F8, REAL, DualType, is_dual, is_number, pack
from usersub.lift.primitives import ELEMENTS, OWN, OWN_PAIRS, PAIR, RETURNS, SINGLE

__all__ = ["machine_functions"]

_MEMORY = types.Array(F8, 1, "C")


class DualArrayType(types.Type):
    """Elements of an array of numbers in memory of their own, each with derivatives."""

    def __init__(self, count: int, dimensions: int):
        self.dual, self.dimensions = DualType(count), dimensions
        super().__init__(f"state with {count} derivatives in {dimensions} dimensions")


@register_default(DualArrayType)
class _DualArrayModel(models.StructModel):
    def __init__(self, manager: Any, fe_type: DualArrayType):
        super().__init__(manager, fe_type, [("memory", _MEMORY), ("rows", types.intp)])


def primitive(function: Callable, arity: int, result: Callable) -> Callable:
    """Tells numba the type of a primitive, `result(*types)`; decorates what makes its code, in the
    frame of the function that calls it."""

    class Template(AbstractTemplate):
        key = function
        prefer_literal = True

        def generic(self, args: tuple, kws: dict) -> Any:
            return None if kws or len(args) != arity else typing.signature(result(*args), *args)

    infer_global(function)(Template)
    return lower_builtin(function, *[types.Any] * arity)


@primitive(primitives.scratch, 1, lambda count: _MEMORY)
def _scratch(context, builder, signature, values):
    count = signature.args[0].literal_value
    data = cgutils.alloca_once(builder, REAL, ir.Constant(ir.IntType(64), max(1, count)))
    array = context.make_array(_MEMORY)(context, builder)
    shape, size = [context.get_constant(types.intp, n) for n in (count, 8)]
    context.populate_array(
        array, data=data, shape=[shape], strides=[size], itemsize=size, meminfo=None
    )
    return array._getvalue()


@primitive(primitives.seed, 3, lambda value, index, count: DualType(count.literal_value))
def _seed(context, builder, signature, values):
    value, index = signature.args[:2]
    real = context.cast(builder, values[0], value, F8)
    partials = [REAL(float(k == index.literal_value)) for k in range(signature.return_type.count)]
    return pack(builder, real, partials)


def _dual_array_type(memory, numbers, count):
    return DualArrayType(count.literal_value, numbers.ndim)


@primitive(primitives.dual_array, 3, _dual_array_type)
def _dual_array(context, builder, signature, values):
    result, numbers = signature.return_type, signature.args[1]
    view = context.make_array(numbers)(context, builder, values[1])
    made = cgutils.create_struct_proxy(result)(context, builder)
    made.memory = values[0]
    made.rows = cgutils.unpack_tuple(builder, view.shape)[0]
    array = impl_ret_borrowed(context, builder, result, made._getvalue())

    def fill(array, numbers):
        flat = 0
        for x in numbers.flat:
            _set_element(array, flat, x)
            flat += 1

    face = typing.signature(types.none, result, numbers)
    context.compile_internal(builder, fill, face, (array, values[1]))
    return array


@primitive(primitives.store, 2, lambda duals, numbers: types.none)
def _store(context, builder, signature, values):
    if signature.args[1].ndim == 1:

        def copy(duals, numbers):
            for i in range(numbers.shape[0]):
                numbers[i] = primitives.real(_element(duals, i))

    else:

        def copy(duals, numbers):
            for i in range(numbers.shape[0]):
                numbers[i, 0] = primitives.real(_element(duals, 2 * i))
                numbers[i, 1] = primitives.real(_element(duals, 2 * i + 1))

    return context.compile_internal(builder, copy, signature, values)


@primitive(primitives.tiny, 1, lambda numbers: F8)
def _tiny(context, builder, signature, values):
    kind = numpy_support.as_dtype(signature.args[0].dtype)
    return context.get_constant(F8, float(np.finfo(kind).tiny))


@primitive(primitives.real, 1, lambda value: F8 if is_dual(value) else types.unliteral(value))
def _real(context, builder, signature, values):
    if is_dual(signature.args[0]):
        return builder.extract_value(values[0], 0)
    return context.cast(builder, values[0], signature.args[0], signature.return_type)


@primitive(primitives.partial, 2, lambda value, index: F8)
def _partial(context, builder, signature, values):
    value, index = signature.args
    return builder.extract_value(values[0], index.literal_value + 1) if is_dual(value) else REAL(0)


def is_value(ty: Any) -> bool:
    return is_dual(ty) or (is_number(ty) and not isinstance(ty, types.Boolean))


def _is_zero_dimensional(ty: Any) -> bool:
    """Whether a type is what `numpy.where` makes of numbers: an array that is one number."""
    return isinstance(ty, types.Array) and ty.ndim == 0 and is_value(ty.dtype)


def _is_tuple(ty: Any, count: int) -> bool:
    return isinstance(ty, types.BaseTuple) and len(ty) == count


def is_four(ty: Any) -> bool:
    return _is_tuple(ty, 4) and all(map(is_value, ty))


def is_pair(ty: Any) -> bool:
    return _is_tuple(ty, 2) and all(map(is_value, ty))


def _check(function: Callable, expected: str, fits: Callable) -> None:
    """A primitive that hands on what a law returned if its type fits."""

    def result(ty: Any) -> Any:
        if function is primitives.number and _is_zero_dimensional(ty):
            return ty.dtype
        if not fits(ty):
            raise TypingError(RETURNS.format(told(ty), expected))
        return ty

    @primitive(function, 1, result)
    def hand_on(context, builder, signature, values):
        given = signature.args[0]
        if given == signature.return_type:
            return values[0]
        return builder.load(context.make_array(given)(context, builder, values[0]).data)


def told(ty: Any) -> str:
    """The type of what a function returned, in words."""
    if ty in (types.none, types.void) or isinstance(ty, types.Omitted):
        return "nothing"
    return f"a tuple of {len(ty)}" if isinstance(ty, types.BaseTuple) else f"{ty}"


_check(primitives.number, SINGLE, is_value)
_check(primitives.pair, PAIR, is_pair)
_check(
    primitives.with_derivatives, OWN,
    lambda ty: _is_tuple(ty, 2) and is_value(ty[0]) and is_four(ty[1]),
)  # fmt: skip
_check(
    primitives.pairs_with_derivatives, OWN_PAIRS,
    lambda ty: _is_tuple(ty, 2) and is_pair(ty[0]) and _is_tuple(ty[1], 2)
    and all(map(is_four, ty[1])),
)  # fmt: skip


@intrinsic
def _element(context, array, flat):
    """Element number `flat`, whatever the dimensions."""

    def code(context, builder, signature, values):
        place = _place(context, builder, array, *values)
        parts = [
            builder.load(builder.gep(place, [ir.Constant(ir.IntType(64), k)]))
            for k in range(array.dual.count + 1)
        ]
        return pack(builder, parts[0], parts[1:])

    return array.dual(array, flat), code


@intrinsic
def _set_element(context, array, flat, value):
    def code(context, builder, signature, values):
        dual = context.cast(builder, values[2], signature.args[2], array.dual)
        place = _place(context, builder, array, *values[:2])
        for k in range(array.dual.count + 1):
            part = builder.extract_value(dual, k)
            builder.store(part, builder.gep(place, [ir.Constant(ir.IntType(64), k)]))
        return context.get_dummy_value()

    return types.none(array, flat, value), code


@intrinsic
def _rows(context, array):
    def code(context, builder, signature, values):
        return cgutils.create_struct_proxy(array)(context, builder, values[0]).rows

    return types.intp(array), code


def _place(context: Any, builder: Any, array: DualArrayType, value: Any, flat: Any) -> Any:
    """Pointer to the first number of an element."""
    made = cgutils.create_struct_proxy(array)(context, builder, value)
    data = context.make_array(_MEMORY)(context, builder, made.memory).data
    each = ir.Constant(flat.type, array.dual.count + 1)
    return builder.gep(data, [builder.mul(flat, each)])


@register_jitable
def _within(index, count):
    """Index from the front; refuses one that is outside."""
    found = index + count if index < 0 else index
    if found < 0 or found >= count:
        raise IndexError("index of a state variable is out of bounds")
    return found


@register_jitable
def _flat(array, index):
    return _within(index, _rows(array))


@register_jitable
def _flat_pair(array, index):
    return 2 * _within(index[0], _rows(array)) + _within(index[1], 2)


def _place_of(array: Any, index: Any) -> Callable | None:
    """The function that turns an index into the number of an element."""
    if not isinstance(array, DualArrayType):
        return None
    if array.dimensions == 1 and isinstance(index, types.Integer):
        return _flat
    if array.dimensions == 2 and _is_tuple(index, 2):
        if all(isinstance(i, types.Integer) for i in index):
            return _flat_pair
    raise TypingError(ELEMENTS)


@overload(operator.getitem)
def _getitem(array, index):
    place = _place_of(array, index)
    return place and (lambda array, index: _element(array, place(array, index)))


@overload(operator.setitem)
def _setitem(array, index, value):
    if isinstance(array, types.Array) and is_dual(value):
        raise TypingError(primitives.KEPT)
    place = _place_of(array, index)
    return place and (lambda array, index, value: _set_element(array, place(array, index), value))


@overload(len)
def _len(array):
    return (lambda array: _rows(array)) if isinstance(array, DualArrayType) else None
