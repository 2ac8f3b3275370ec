# SPDX-License-Identifier: MIT
"""Routines made of pointers: what is accepted, what is told from types, what is refused."""

from __future__ import annotations

import ctypes

import cffi
import pytest

from usersub import abi
from usersub.errors import AbiError
from usersub.routine.pointers import from_pointer
from usersub.routine.routine import BLOCK, FULL

FFI = cffi.FFI()


def c_types(face: abi.Interface, real: str, hidden: bool = True) -> list[str]:
    """C types of the arguments of an interface, written here and not by the generators."""
    base = {"real": real, "int": "int", "char": "char"}
    types = [f"{base[a.kind]} *" for a in face.args]
    return types + ["size_t"] * (3 if hidden else 0)


def cffi_pointer(types: list[str], result: str = "void"):
    return FFI.cast(f"{result} (*)({', '.join(types)})", 4096)


CASES = [(f, p) for f in abi.INTERFACES for p in f.precisions]


@pytest.mark.parametrize("hidden", [True, False])
@pytest.mark.parametrize(("face", "precision"), CASES, ids=[f"{f.key}-{p}" for f, p in CASES])
def test_cffi_full(face, precision, hidden):
    pointer = cffi_pointer(
        c_types(face, {"double": "double", "single": "float"}[precision], hidden)
    )
    routine = from_pointer(face.name.upper(), pointer, generation=face.generation)
    assert routine.interface is face and routine.language == "pointer" and routine.uses is None
    entry = routine.entry(precision)
    assert (entry.address, entry.style, entry.keep) == (4096, FULL, pointer)
    other = {"double": "single", "single": "double"}[precision]
    with pytest.raises(AbiError, match=f"is of {precision} precision, but the scene is in"):
        routine.entry(other)
    if other in face.precisions:
        with pytest.raises(AbiError, match="expected '(double|float) \\*'"):
            from_pointer(face.name, pointer, precision=other)


def test_cffi_block_and_function_without_types():
    routine = from_pointer("vfric", cffi_pointer(["void **"], "int"), precision="single")
    assert routine.entry("single").style == BLOCK
    assert from_pointer("vfric", cffi_pointer(["void *"] * 42)).entry("double").style == FULL


def test_cffi_callback_and_library_function():
    @FFI.callback("int(void **)")
    def law(argv):
        return 0

    routine = from_pointer("fric", law, thread_safe=True)
    assert routine.entry().address == int(FFI.cast("uintptr_t", law))
    assert routine.thread_safe and not routine.block_safe
    ffi = cffi.FFI()
    ffi.cdef("double sin(double);")
    with pytest.raises(AbiError, match="returns double, expected void"):
        from_pointer("fric", ffi.dlopen(None).sin, style="full")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda t: t[:-4], "has 41 arguments, expected 42, or 45 with the hidden lengths"),
        (lambda t: [*t, "size_t"], "has 46 arguments, expected 42, or 45"),
        (lambda t: ["int *", *t[1:]], "argument fTangential is 'int *', expected 'double *'"),
        (lambda t: [*t[:2], "double *", *t[3:]], "argument kStep is 'double *', expected 'int *'"),
        (lambda t: [*t[:4], "long *", *t[5:]], "argument nContact is 'long *', expected 'int *'"),
        (
            lambda t: [*t[:23], "double *", *t[24:]],
            "argument surfSec is 'double *', expected 'char",
        ),
        (
            lambda t: [*t[:1], "float *", *t[2:]],
            "argument statev is 'float *', expected 'double *'",
        ),
        (lambda t: [*t[:-1], "double"], "a hidden length is 'double', expected 'size_t'"),
    ],
)
def test_wrong_full_signatures(change, words):
    with pytest.raises(AbiError) as caught:
        from_pointer("vfric", cffi_pointer(change(c_types(abi.interface("vfric"), "double"))))
    assert words in str(caught.value) and "does not fit VFRIC" in str(caught.value)


def test_wrong_block_signatures():
    with pytest.raises(AbiError, match="returns void, expected int"):
        from_pointer("vfric", cffi_pointer(["void **"]))
    with pytest.raises(AbiError, match=r"block style is 'int f\(void \*\*\)', not 'int f\(double"):
        from_pointer("vfric", cffi_pointer(["double *"], "int"))
    with pytest.raises(AbiError, match="block style is"):
        from_pointer("fric_coef", cffi_pointer(["void *"] * 16, "int"), style="block")


REALS = {"double": ctypes.c_double, "single": ctypes.c_float}


def ctypes_function(face, precision, result=None):
    base = {"real": REALS[precision], "int": ctypes.c_int, "char": ctypes.c_char}
    types = [ctypes.POINTER(base[a.kind]) for a in face.args] + [ctypes.c_size_t] * 3
    return ctypes.CFUNCTYPE(result, *types)(lambda *a: None)


@pytest.mark.parametrize(("face", "precision"), CASES, ids=[f"{f.key}-{p}" for f, p in CASES])
def test_ctypes_full(face, precision):
    function = ctypes_function(face, precision)
    routine = from_pointer(face.name, function, generation=face.generation)
    entry = routine.entry(precision)
    assert entry.address == ctypes.cast(function, ctypes.c_void_p).value
    assert entry.style == FULL and entry.keep is function


def test_ctypes_variants():
    block = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_void_p))(lambda argv: 0)
    assert from_pointer("fric", block).entry().style == BLOCK
    untyped = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 9, *[ctypes.c_char_p] * 2)
    with pytest.raises(AbiError, match="it has 11 arguments, expected 39"):
        from_pointer("vfriction", untyped(lambda *a: None))


def test_ctypes_numpy_types():
    np = pytest.importorskip("numpy")
    face = abi.interface("vfric_coef")
    base = {"real": np.float32, "int": np.int32, "char": np.uint8}
    types = [np.ctypeslib.ndpointer(base[a.kind]) for a in face.args]
    routine = from_pointer("vfric_coef", ctypes.CFUNCTYPE(None, *types)(4096))
    assert routine.entry("single").address == 4096


def test_functions_of_a_library_say_nothing_of_their_arguments():
    function = ctypes.CDLL(None).abs
    with pytest.raises(AbiError, match="function abs says nothing of its arguments"):
        from_pointer("fric", function)
    routine = from_pointer("fric", function, style="full", precision="double")
    assert routine.entry().address == ctypes.cast(function, ctypes.c_void_p).value


def test_addresses_need_style_and_precision():
    with pytest.raises(AbiError, match="the address 0x1000 says nothing of its arguments"):
        from_pointer("fric", 4096)
    with pytest.raises(AbiError, match="give style= and precision="):
        from_pointer("fric", 4096, style="full")
    with pytest.raises(AbiError, match="give style= and precision="):
        from_pointer("fric", FFI.cast("void *", 4096), precision="double")
    assert from_pointer("fric", 4096, style="full", precision="double").entry().address == 4096
    with pytest.raises(AbiError, match="the pointer for FRIC is NULL"):
        from_pointer("fric", 0, style="full", precision="double")
    with pytest.raises(AbiError, match="is NULL"):
        from_pointer("fric", FFI.cast("int(*)(void **)", 0))


def test_numba_cfuncs():
    import numba
    from numba import types

    def block(argv):
        return 0

    function = numba.cfunc(types.int32(types.CPointer(types.voidptr)))(block)
    entry = from_pointer("vfric", function, precision="single").entry("single")
    assert (entry.address, entry.style) == (function.address, BLOCK)

    face = abi.interface("fric_coef", "legacy")
    base = {"real": types.float64, "int": types.int32, "char": types.uint8}
    pointers = [types.CPointer(base[a.kind]) for a in face.args]
    names = ", ".join(f"a{i}" for i in range(16))
    namespace: dict = {}
    exec(f"def full({names}): pass", namespace)
    function = numba.cfunc(types.void(*pointers))(namespace["full"])
    routine = from_pointer("fric_coef", function, generation="legacy")
    assert routine.name == "the numba cfunc full" and routine.entry().style == FULL
    with pytest.raises(AbiError, match="argument fCoef is 'double \\*', expected 'float \\*'"):
        from_pointer("vfric_coef", function, precision="single")
    with pytest.raises(AbiError, match="is a Python function, not a pointer; use the decorator"):
        from_pointer("vfric", numba.njit(block))


def test_scipy_callables():
    scipy = pytest.importorskip("scipy")
    block = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_void_p))(lambda argv: 0)
    routine = from_pointer("vfric", scipy.LowLevelCallable(block))
    assert routine.entry().address == ctypes.cast(block, ctypes.c_void_p).value
    pointer = cffi_pointer(["void **"], "int")
    assert from_pointer("vfric", scipy.LowLevelCallable(pointer)).entry().address == 4096
    with pytest.raises(AbiError, match="LowLevelCallable with user data"):
        from_pointer("vfric", scipy.LowLevelCallable(block, ctypes.c_void_p(8)))


def test_capsules_carry_a_signature():
    make = ctypes.pythonapi.PyCapsule_New
    make.argtypes, make.restype = (
        [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p],
        ctypes.py_object,
    )
    label = b"int (void **)"
    routine = from_pointer("vfric", make(4096, label, None))
    assert routine.entry().address == 4096 and routine.entry().style == BLOCK
    bad = b"no signature"
    with pytest.raises(AbiError, match="name 'no signature' is no C signature"):
        from_pointer("vfric", make(4096, bad, None))


def test_arguments_are_checked():
    with pytest.raises(AbiError, match="unknown interface 'vfrik'; did you mean 'vfric'"):
        from_pointer("vfrik", 4096)
    with pytest.raises(AbiError, match="FRIC exists in double precision, not in 'single'"):
        from_pointer("fric", 4096, style="full", precision="single")
    with pytest.raises(AbiError, match='style is \'blocks\', expected "full" or "block"'):
        from_pointer("fric", 4096, style="blocks", precision="double")
    with pytest.raises(AbiError, match="is no pointer to a function"):
        from_pointer("fric", "fric_")
    with pytest.raises(AbiError, match="is no pointer to a function"):
        from_pointer("fric", FFI.new("int *"))
