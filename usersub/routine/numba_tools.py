# SPDX-License-Identifier: MIT
"""What generated adapters import: views and texts for numba. Imported only when one is compiled."""

from __future__ import annotations

from numba import carray, farray, float32, float64, int32, int64, njit, types, uint8
from numba.core.errors import TypingError
from numba.cpython.unicode import _empty_string, _set_code_point
from numba.extending import intrinsic, overload

from usersub.abi import NAME_LENGTH

__all__ = [
    "carray", "farray", "float32", "float64", "int32", "int64", "moved", "note", "nothing",
    "readonly", "text_at",
]  # fmt: skip

_ONE_BYTE = 1  # kind of numba's texts with one byte a character
_BLANK = 32


@intrinsic
def readonly(typing_context, array):
    """The same array, typed so that a routine that writes to it is refused by the compiler."""
    if not isinstance(array, types.Array):
        raise TypingError(f"readonly takes an array, not {array}")

    def code(context, builder, signature, arguments):
        return arguments[0]

    return array.copy(readonly=True)(array), code


@intrinsic
def moved(typing_context, pointer, count):
    """The pointer `count` bytes further on."""

    def code(context, builder, signature, arguments):
        return builder.gep(arguments[0], [arguments[1]])

    return types.voidptr(types.voidptr, types.int64), code


@intrinsic
def note(typing_context, place, value):
    """Writes an integer where others look for it after a fault: the compiler must not defer it."""

    def code(context, builder, signature, arguments):
        builder.store_atomic(arguments[1], arguments[0], "monotonic", 4)
        return context.get_dummy_value()

    return types.void(types.CPointer(types.int32), types.int32), code


@njit
def text_at(pointer, length):
    """The text at `pointer` without trailing blanks; a length above that of names is taken as it,
    since callers in C may leave hidden lengths out."""
    if length <= 0 or length > NAME_LENGTH:
        length = NAME_LENGTH
    raw = carray(pointer, (length,), uint8)
    while length > 0 and raw[length - 1] == _BLANK:
        length -= 1
    ascii_only = 1
    for i in range(length):
        if raw[i] > 127:
            ascii_only = 0
    text = _empty_string(_ONE_BYTE, length, ascii_only)
    for i in range(length):
        _set_code_point(text, i, raw[i])
    return text


def nothing(value):
    """Takes what the routine returned, which has to be nothing."""


@overload(nothing, inline="never")
def _nothing(value):
    if value not in (types.none, types.void) and not isinstance(value, types.Omitted):
        raise TypingError(
            f"the routine returns a value ({value}); results go into the elements of its arrays"
        )

    def code(value):
        pass

    return code
