# SPDX-License-Identifier: MIT
"""Entries that run a Python function uncompiled, so that a debugger can step into it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from usersub import abi
from usersub.emit.numba_adapter import RAISED, Term, is_array, shape_terms
from usersub.routine.declaration import Declaration
from usersub.routine.routine import BLOCK, Entry


@dataclass
class Record:
    """Keeps an uncompiled entry alive and says how its last call ended.

    Attributes:
        file: file of the user's function.
        callback: the C function.
        exception: what the routine raised at its last failure, or None. May be set to None.
    """

    file: str
    callback: Any = None
    exception: BaseException | None = None

    @property
    def where(self) -> str:
        """Innermost line of the user's file that the exception passed, as "file:line", or ""."""
        trace = self.exception.__traceback__ if self.exception else None
        found = ""
        while trace is not None:
            if trace.tb_frame.f_code.co_filename == self.file:
                found = f"{self.file}:{trace.tb_lineno}"
            trace = trace.tb_next
        return found


def interpreted_entry(declaration: Declaration, precision: str, style: int = BLOCK) -> Entry:
    """A C function that calls the Python function with numpy views.

    An exception gives USUB_ROUTINE_RAISED and is kept in `entry.keep.exception`.
    """
    import cffi

    ffi = cffi.FFI()
    record = Record(declaration.file)
    views = [_view(ffi, declaration.interface, i, precision) for i in declaration.positions]
    function = declaration.function

    def run(pointers: Sequence) -> int:
        try:
            if function(*[view(pointers) for view in views]) is not None:
                raise TypeError(
                    f"routine '{function.__name__}' returns a value; results go into the "
                    "elements of its arrays"
                )
        except BaseException as error:  # an exception must not cross the C code in between
            record.exception = error
            return RAISED
        return 0

    if style == BLOCK:
        record.callback = ffi.callback("int(void **)", run)
    else:
        texts = sum(a.kind == "char" for a in declaration.interface.args)
        types = ["void *"] * len(declaration.interface.args) + ["size_t"] * texts
        record.callback = ffi.callback(f"int({', '.join(types)})", lambda *all_: run(all_))
    return Entry(int(ffi.cast("uintptr_t", record.callback)), style, record)


def _view(ffi: Any, face: abi.Interface, position: int, precision: str) -> Callable:
    """Function that makes what the routine gets for one argument from all pointers."""
    import numpy as np

    arg = face.args[position]
    if arg.kind == "char":
        texts = [i for i, a in enumerate(face.args) if a.kind == "char"]
        hidden = len(face.args) + texts.index(position)
        return lambda pointers: _text(ffi, pointers, position, hidden)
    single = precision == "single"
    dtype = np.dtype(np.int32 if arg.kind == "int" else np.float32 if single else np.float64)
    if not is_array(arg):
        convert = int if arg.kind == "int" else dtype.type
        return lambda pointers: convert(_elements(ffi, np, pointers[position], dtype, 1)[0])
    dimensions = shape_terms(face, arg) or ((1,),)
    size = np.dtype(np.int32)

    def length(pointers: Sequence, term: Term) -> int:
        if isinstance(term, int):
            return term
        return int(_elements(ffi, np, pointers[term[0]], size, term[1] + 1)[term[1]])

    def view(pointers: Sequence) -> Any:
        shape = tuple(sum(length(pointers, t) for t in terms) for terms in dimensions)
        count = int(np.prod(shape))
        array = _elements(ffi, np, pointers[position], dtype, count).reshape(shape, order="F")
        array.flags.writeable = arg.intent != "read"
        return array

    return view


def _elements(ffi: Any, np: Any, pointer: Any, dtype: Any, count: int) -> Any:
    """`count` elements at `pointer`, without a copy."""
    if count == 0:
        return np.empty(0, dtype)
    return np.frombuffer(ffi.buffer(pointer, count * dtype.itemsize), dtype)


def _text(ffi: Any, pointers: Sequence, position: int, hidden: int) -> str:
    """A text without trailing blanks; FULL style has its length among the hidden arguments."""
    length = abi.NAME_LENGTH
    if isinstance(pointers, tuple) and 0 < pointers[hidden] <= abi.NAME_LENGTH:
        length = pointers[hidden]
    return bytes(ffi.buffer(pointers[position], length)).decode("latin-1").rstrip(" ")
