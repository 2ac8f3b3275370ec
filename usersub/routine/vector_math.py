# SPDX-License-Identifier: MIT
"""Vectorised exp, log and pow in compiled Python routines (`vector_math=True`).

Before a routine's loops are optimised, its requests for exp, log and pow get code of their own:
polynomials that are inlined (`vector_kernels`), or the vector functions of the C library, libmvec.
The loops then become vector loops. What is left over from whole vectors goes through the same
code, so that a point's bits do not depend on its neighbours or on the block size.

With libmvec the bits depend on the processor, as its versions for different vector lengths do not
agree; the polynomials give the same bits on every machine.
"""

from __future__ import annotations

import ctypes
import re
import sys
from functools import cache
from typing import Any

from usersub.errors import AbiError
from usersub.routine.lanes import Lanes, Value
from usersub.routine.vector_kernels import FUNCTIONS

#: What the option may be: nothing, inlined polynomials (True or by name), the C library's.
POLYNOMIAL, LIBMVEC = "polynomial", "libmvec"
CHOICES = (False, True, POLYNOMIAL, LIBMVEC)

_REQUEST = re.compile(r"@llvm\.(?P<name>exp|log|pow)\.(?:v(?P<width>\d+))?f(?P<bits>32|64)\b")
_DECLARED = re.compile(
    r"^declare [^\n]*@llvm\.(?:exp|log|pow)\.(?:v\d+)?f(?:32|64)\b[^\n]*\n", re.M
)


def choice(option: bool | str) -> str:
    """ "", POLYNOMIAL or LIBMVEC.

    Raises:
        AbiError: the option is none of the choices, or this machine has no libmvec.
    """
    if option not in CHOICES:
        raise AbiError(
            f"vector_math = {option!r}; expected False, True, {POLYNOMIAL!r} or {LIBMVEC!r}"
        )
    if option == LIBMVEC and library() is None:
        raise AbiError(
            f"vector_math = {LIBMVEC!r}: the C library of this machine has no libmvec; "
            f"vector_math = True works everywhere"
        )
    return POLYNOMIAL if option is True else option or ""


@cache
def library() -> Any:
    """libmvec, loaded for everybody who comes later; None where there is none."""
    if not sys.platform.startswith("linux"):
        return None
    try:
        # Machine code from the cache calls it by name, and would jump to nowhere without it.
        return ctypes.CDLL("libmvec.so.1", mode=ctypes.RTLD_GLOBAL)
    except OSError:
        return None


@cache
def pipeline(kind: str) -> type:
    """A pipeline for numba that gives the code it compiles vectorised functions.

    Only what is compiled by it changes: functions that the routine calls are given new code in the
    routine's own copy, and stay as they are for others.
    """
    from numba.core import compiler

    class VectorCompiler(compiler.Compiler):
        def __init__(self, typingctx: Any, targetctx: Any, library: Any, *rest: Any):
            if library is None:
                library = targetctx.codegen().create_library("vector_math")
                library.enable_object_caching()
            optimize = library._optimize_final_module

            def vectorise_then_optimize() -> None:
                library._final_module = vectorised(library._final_module, kind)
                optimize()

            library._optimize_final_module = vectorise_then_optimize
            super().__init__(typingctx, targetctx, library, *rest)

    return VectorCompiler


def vectorised(module: Any, kind: str) -> Any:
    """LLVM's module with code for every exp, log and pow; itself if there is none."""
    from llvmlite import binding

    text = str(module)
    requests = {match.groups() for match in _REQUEST.finditer(text)}
    if not requests:
        return module
    text = _REQUEST.sub(_own_name, _DECLARED.sub("", text))
    needed: set[str] = set()
    for name, width, bits in sorted(requests, key=str):
        count, kernel = FUNCTIONS[name]
        code = Lanes(int(width or 0))
        arguments = [code.argument(a) for a in ("x", "y")[:count]]
        if kind == LIBMVEC:  # one number after the other, of which the compiler makes vectors
            result = code.one_by_one(f"@usersub.{name}.one", *arguments)
        else:
            result = kernel(code, *arguments)
        text += _frame(name, int(bits), code, result)
        needed |= code.intrinsics
    if kind == LIBMVEC:
        for name in sorted({name for name, _, _ in requests}):
            text += _one_by_libmvec(name)
    # What the module has declared itself must not be declared twice.
    text += "".join(f"{line}\n" for line in sorted(needed) if not _is_declared(text, line))
    made = binding.parse_assembly(text)
    made.name = module.name
    made.verify()
    return made


def _is_declared(text: str, line: str) -> bool:
    name = re.escape(line.partition("@")[2].partition("(")[0])
    return re.search(rf"^declare [^\n]*@{name}\(", text, re.M) is not None


def _own_name(match: re.Match) -> str:
    return "@usersub." + match[0].removeprefix("@llvm.")


def _frame(name: str, bits: int, body: Lanes, result: Value) -> str:
    """The definition of one request; single precision goes through double precision."""
    lanes = f"v{body.width}" if body.width else ""
    real, wide = body.type_of("double" if bits == 64 else "float"), body.type_of("double")
    arguments = ["x", "y"][: FUNCTIONS[name][0]]
    given = ", ".join(f"{real} %{a}{'' if bits == 64 else '.given'}" for a in arguments)
    lines = [f"define internal {real} @usersub.{name}.{lanes}f{bits}({given}) alwaysinline {{"]
    returned = result.name
    if bits == 32:
        lines += [f"  %{a} = fpext {real} %{a}.given to {wide}" for a in arguments]
    lines += body.lines
    if bits == 32:
        lines.append(f"  %rounded = fptrunc {wide} {returned} to {real}")
        returned = "%rounded"
    return "\n".join(["", *lines, f"  ret {real} {returned}", "}", ""])


_WIDTHS = {2: "b", 4: "d", 8: "e"}


@cache
def _variant() -> tuple[str, int]:
    """Letter and width of the vector functions: those of the vectors that LLVM makes here."""
    from llvmlite import binding
    from numba.core.registry import cpu_target

    codegen = cpu_target.target_context.codegen()
    module = binding.parse_assembly(_LOOP)
    passes, builder = codegen._module_pass_manager()
    passes.run(module, builder)
    widths = [int(width) for width in re.findall(r"<(\d+) x double>", str(module))]
    width = max((w for w in widths if w in _WIDTHS), default=2)
    letter = _WIDTHS[width]
    if letter == "d" and not dict(binding.get_host_cpu_features()).get("avx2"):
        letter = "c"
    return letter, width


#: Doubles an array, for seeing how wide a vector the compiler takes.
_LOOP = """
define void @double(ptr noalias %x) {
start:
  br label %loop
loop:
  %i = phi i64 [ 0, %start ], [ %next, %loop ]
  %at = getelementptr double, ptr %x, i64 %i
  %value = load double, ptr %at
  %twice = fadd double %value, %value
  store double %twice, ptr %at
  %next = add i64 %i, 1
  %more = icmp ult i64 %next, 4096
  br i1 %more, label %loop, label %done
done:
  ret void
}
"""


def _symbol(name: str) -> str:
    letter, width = _variant()
    return f"_ZGV{letter}N{width}{'v' * FUNCTIONS[name][0]}_{name}"


def _one_by_libmvec(name: str) -> str:
    """The function for one number, which tells the compiler of its vector variant.

    It is one lane of this variant, and is not inlined before the compiler has made its loops.
    """
    _, width = _variant()
    count, symbol = FUNCTIONS[name][0], _symbol(name)
    vector = f"<{width} x double>"
    own = f"usersub.{name}.one"
    names = ("x", "y")[:count]
    lines = ["", f"declare {vector} @{symbol}({', '.join([vector] * count)})"]
    lines.append(
        f"define internal double @{own}({', '.join(f'double %{a}' for a in names)}) noinline "
        f"nounwind willreturn memory(none) "
        f'"vector-function-abi-variant"="_ZGV_LLVM_N{width}{"v" * count}_{own}({symbol})" {{'
    )
    for a in names:
        lines.append(f"  %{a}.one = insertelement {vector} poison, double %{a}, i64 0")
        lines.append(
            f"  %{a}.all = shufflevector {vector} %{a}.one, {vector} poison, "
            f"<{width} x i32> zeroinitializer"
        )
    given = ", ".join(f"{vector} %{a}.all" for a in names)
    lines += [
        f"  %all = call {vector} @{symbol}({given}) nounwind willreturn memory(none)",
        f"  %result = extractelement {vector} %all, i64 0",
        "  ret double %result",
        "}",
        "",
    ]
    return "\n".join(lines)
