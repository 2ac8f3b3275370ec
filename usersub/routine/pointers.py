# SPDX-License-Identifier: MIT
"""Routines that are pointers to functions of this process: cffi, ctypes, numba, scipy, addresses.

Where the pointer knows its own type, the number and the types of its arguments are compared with
the table of the interface; nothing is called before that.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any

from usersub import abi
from usersub.errors import AbiError
from usersub.routine.routine import BLOCK, FULL, Entry, Routine

_STYLES = {"full": FULL, "block": BLOCK}
_REALS = {"double *": "double", "float *": "single"}


@dataclass(frozen=True)
class _Function:
    """A pointer that was understood: types as C spells them, None where they are not known."""

    address: int
    arguments: tuple[str, ...] | None
    result: str
    name: str


def from_pointer(
    interface: str,
    pointer: Any,
    *,
    precision: str | None = None,
    generation: str | None = None,
    style: str | None = None,
    block_safe: bool = False,
    thread_safe: bool = False,
) -> Routine:
    """Makes a routine of a pointer to a function.

    Args:
        interface: name of the interface.
        pointer: a cffi function pointer, a ctypes function, a numba `cfunc`, a scipy
            `LowLevelCallable` (without user data), a capsule with a signature, or an address. It
            is kept alive by the routine.
        precision: "double" or "single"; None: told by the types of the pointer, else "double".
        generation: of FRIC_COEF; None: the newest.
        style: "full" (the published arguments, with or without the hidden lengths of the texts),
            "block" (`int f(void **argv)`); None: told by the number of arguments.
        block_safe: FRIC_COEF: it handles more than one contact point a call.
        thread_safe: blocks may run in different threads.

    Raises:
        AbiError: the function does not fit the interface, or the pointer does not know its type
            and `style` and `precision` are not given.
    """
    try:
        face = abi.interface(interface, generation)
    except KeyError as error:
        raise AbiError(error.args[0]) from None
    if style not in (None, *_STYLES):
        raise AbiError(f'style is {style!r}, expected "full" or "block"')
    if precision not in (None, *face.precisions):
        raise AbiError(
            f"{face.name.upper()} exists in {' and '.join(face.precisions)} precision, "
            f"not in {precision!r}"
        )
    function = _understood(pointer)
    if function.address == 0:
        raise AbiError(f"the pointer for {face.name.upper()} is NULL")
    if function.arguments is None:
        if style is None or precision is None:
            raise AbiError(
                f"{function.name} says nothing of its arguments; give style= and precision=, or "
                "a pointer that has a type (for ctypes: set argtypes)"
            )
    else:
        style = style or ("block" if len(function.arguments) == 1 else "full")
        precision = _checked(face, function, style, precision)
    entry = Entry(function.address, _STYLES[style], pointer)
    return Routine(
        interface=face,
        language="pointer",
        name=function.name,
        origin="",
        make_entry=_Maker(face, entry, precision),
        block_safe=block_safe,
        thread_safe=thread_safe,
    )


@dataclass(frozen=True)
class _Maker:
    """Hands out the entry in the one precision that it has."""

    face: abi.Interface
    entry: Entry
    precision: str

    def __call__(self, precision: str) -> Entry:
        if precision != self.precision:
            raise AbiError(
                f"the {self.face.name.upper()} pointer is of {self.precision} precision, but the "
                f"scene is in {precision!r}"
            )
        return self.entry


def _checked(face: abi.Interface, function: _Function, style: str, precision: str | None) -> str:
    """Compares types with the table; returns the precision."""
    arguments = function.arguments or ()
    what = f"{function.name} does not fit {face.name.upper()}"
    if style == "block":
        if len(arguments) != 1 or arguments[0] not in ("void **", "void *"):
            raise AbiError(f"{what}: block style is 'int f(void **)', not {_spelled(function)}")
        if function.result != "int":
            raise AbiError(
                f"{what}: it returns {function.result}, expected int (0 or a negative status)"
            )
        return precision or "double"
    if function.result not in ("void", "int"):
        raise AbiError(f"{what}: it returns {function.result}, expected void")
    texts = sum(a.kind == "char" for a in face.args)
    count = len(face.args)
    if len(arguments) not in (count, count + texts):
        raise AbiError(
            f"{what}: it has {len(arguments)} arguments, expected {count}, or {count + texts} "
            "with the hidden lengths of its texts"
        )
    expected = precision
    for arg, found in zip(face.args, arguments, strict=False):
        if arg.kind == "real" and found in _REALS:
            expected = expected or _REALS[found]
            fits = _REALS[found] == expected and expected in face.precisions
        else:
            fits = found == "void *" or found == f"{arg.kind} *"
        if not fits:
            real = "float *" if expected == "single" else "double *"
            wanted = real if arg.kind == "real" else f"{arg.kind} *"
            raise AbiError(f"{what}: argument {arg.modern} is '{found}', expected '{wanted}'")
    for found in arguments[count:]:
        if found not in ("size_t", "int"):
            raise AbiError(f"{what}: a hidden length is '{found}', expected 'size_t'")
    return expected or "double"


def _spelled(function: _Function) -> str:
    return f"'{function.result} f({', '.join(function.arguments or ())})'"


def _understood(pointer: Any) -> _Function:
    """Address and types of any supported pointer."""
    kind: Any = type(pointer)
    if kind is int:
        return _Function(pointer, None, "", f"the address {pointer:#x}")
    if kind.__name__ == "LowLevelCallable" and hasattr(pointer, "user_data"):
        if pointer.user_data is not None:
            raise AbiError("a LowLevelCallable with user data has no place to pass them; bind none")
        return _understood(pointer.function)
    if kind.__name__ == "PyCapsule":
        return _of_capsule(pointer)
    if kind.__module__ == "_cffi_backend":
        return _of_cffi(pointer)
    if isinstance(pointer, ctypes._CFuncPtr):  # type: ignore[attr-defined]
        return _of_ctypes(pointer)
    if hasattr(pointer, "native_name") and hasattr(pointer, "address"):
        return _of_numba(pointer)
    if callable(pointer):
        raise AbiError(
            f"{pointer!r} is a Python function, not a pointer; use the decorator of the interface, "
            "or ffi.addressof(lib, name) for a function of a cffi library"
        )
    raise AbiError(f"{pointer!r} is no pointer to a function")


def _of_cffi(pointer: Any) -> _Function:
    import cffi

    ffi = cffi.FFI()
    if not isinstance(pointer, ffi.CData):
        raise AbiError(f"{pointer!r} is no pointer; use ffi.addressof(lib, name)")
    kind = ffi.typeof(pointer)
    if kind.kind not in ("function", "pointer"):
        raise AbiError(f"{pointer!r} is no pointer to a function")
    address = int(ffi.cast("uintptr_t", pointer))
    if kind.kind == "function":
        return _of_cffi_type(kind, address, "the cffi function")
    if kind.item.kind != "void":
        raise AbiError(f"{pointer!r} is no pointer to a function")
    return _Function(address, None, "", "a 'void *' of cffi")


def _of_cffi_type(kind: Any, address: int, name: str) -> _Function:
    def spelled(item: Any) -> str:
        if item.kind != "pointer":
            return _plain(item.cname, _cffi_size(item))
        inner = item.item
        return "void **" if inner.kind == "pointer" else _pointer_to(inner.cname, _cffi_size(inner))

    return _Function(address, tuple(map(spelled, kind.args)), spelled(kind.result), name)


def _cffi_size(kind: Any) -> int:
    import cffi

    return 0 if kind.kind in ("void", "function") else cffi.FFI().sizeof(kind)


def _of_ctypes(pointer: Any) -> _Function:
    address = ctypes.cast(pointer, ctypes.c_void_p).value or 0
    name = f"the ctypes function {getattr(pointer, '__name__', '')}".rstrip()
    if pointer.argtypes is None:
        return _Function(address, None, "", name)

    def spelled(kind: Any) -> str:
        if kind is None:
            return "void"
        if kind is ctypes.c_void_p:
            return "void *"
        if kind is ctypes.c_char_p:
            return "char *"
        if hasattr(kind, "_dtype_"):  # numpy.ctypeslib.ndpointer
            dtype = kind._dtype_
            return _pointer_to({"f": "float", "i": "int"}.get(dtype.kind, dtype.name),
                               dtype.itemsize) if dtype is not None else "void *"  # fmt: skip
        if issubclass(kind, ctypes._Pointer):  # type: ignore[attr-defined]
            inner = kind._type_
            if inner is ctypes.c_void_p or issubclass(inner, ctypes._Pointer):  # type: ignore[attr-defined]
                return "void **"
            return _pointer_to(inner.__name__.removeprefix("c_"), ctypes.sizeof(inner))
        return _plain(kind.__name__.removeprefix("c_"), ctypes.sizeof(kind))

    return _Function(address, tuple(map(spelled, pointer.argtypes)), spelled(pointer.restype), name)


def _of_numba(pointer: Any) -> _Function:
    from numba import types

    def spelled(kind: Any) -> str:
        if kind in (types.void, types.none):
            return "void"
        if kind == types.voidptr:
            return "void *"
        if isinstance(kind, types.CPointer):
            inner = kind.dtype
            if inner == types.voidptr or isinstance(inner, types.CPointer):
                return "void **"
            return _pointer_to(str(inner), inner.bitwidth // 8)
        return _plain(str(kind), getattr(kind, "bitwidth", 0) // 8)

    signature = pointer._sig
    return _Function(
        pointer.address,
        tuple(map(spelled, signature.args)),
        spelled(signature.return_type),
        f"the numba cfunc {pointer.__name__}",
    )


def _of_capsule(pointer: Any) -> _Function:
    import cffi

    name_of = ctypes.pythonapi.PyCapsule_GetName
    name_of.argtypes, name_of.restype = [ctypes.py_object], ctypes.c_char_p
    address_of = ctypes.pythonapi.PyCapsule_GetPointer
    address_of.argtypes = [ctypes.py_object, ctypes.c_char_p]
    address_of.restype = ctypes.c_void_p
    label = name_of(pointer)
    address = address_of(pointer, label) or 0
    signature = (label or b"").decode("utf-8", "replace")
    try:
        kind = cffi.FFI().typeof(signature.replace("(", "(*)(", 1))
    except Exception as error:
        raise AbiError(
            f"the capsule's name {signature!r} is no C signature such as 'int (void **)'"
        ) from error
    return _of_cffi_type(kind, address, f"the capsule '{signature}'")


def _pointer_to(name: str, size: int) -> str:
    """A pointer type in the words of the table, or as it is spelled."""
    if name == "void":
        return "void *"
    if "char" in name or size == 1:
        return "char *"
    if name in ("float64", "double") or (name == "float" and size == 8):
        return "double *"
    if name in ("float32", "float"):
        return "float *"
    return "int *" if "int" in name and size == 4 else f"{name} *"


def _plain(name: str, size: int) -> str:
    """A type that is no pointer: results and hidden lengths."""
    if name in ("void", "None"):
        return "void"
    if any(word in name for word in ("int", "long", "size_t")):
        return {4: "int", 8: "size_t"}.get(size, name)
    return name
