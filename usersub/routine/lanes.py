# SPDX-License-Identifier: MIT
"""Straight code for the compiler: arithmetic on one number or on several side by side.

`Lanes` writes LLVM's language, one operation a line, elementwise and without branches, so that the
same lines serve a scalar and a vector of any width, with the same bits in every lane.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

_REAL, _WHOLE, _TRUTH = "double", "i64", "i1"


def bits_of(x: float) -> int:
    """The 64 bits of a double."""
    return struct.unpack("<Q", struct.pack("<d", x))[0]


@dataclass(frozen=True, eq=False)
class Value:
    """What one line has computed: its code, its name and the type of an element."""

    code: Lanes
    name: str
    kind: str

    def _both(self, other: Value | float, real: str, whole: str = "") -> Value:
        return self.code.line(real if self.kind == _REAL else whole, self, other)

    def __add__(self, other: Value | float) -> Value:
        return self._both(other, "fadd", "add")

    def __sub__(self, other: Value | float) -> Value:
        return self._both(other, "fsub", "sub")

    def __mul__(self, other: Value | float) -> Value:
        return self._both(other, "fmul")

    def __truediv__(self, other: Value | float) -> Value:
        return self._both(other, "fdiv")

    def __and__(self, other: Value | int) -> Value:
        return self.code.line("and", self, other)

    def __or__(self, other: Value | int) -> Value:
        return self.code.line("or", self, other)

    def __xor__(self, other: Value | int) -> Value:
        return self.code.line("xor", self, other)

    def __lshift__(self, other: int) -> Value:
        return self.code.line("shl", self, other)

    def __rshift__(self, other: int) -> Value:
        return self.code.line("lshr", self, other)

    def __lt__(self, other: Value | float) -> Value:
        return self.code.line("fcmp olt", self, other, _TRUTH)

    def __gt__(self, other: Value | float) -> Value:
        return self.code.line("fcmp ogt", self, other, _TRUTH)

    def same(self, other: Value | float) -> Value:
        """Whether both are numbers and equal."""
        return self.code.line("fcmp oeq", self, other, _TRUTH)

    def differs(self, other: Value | float) -> Value:
        """Whether both are numbers and not equal."""
        return self.code.line("fcmp one", self, other, _TRUTH)

    def is_nan(self) -> Value:
        """Whether it is no number."""
        return self.code.line("fcmp uno", self, self, _TRUTH)

    def bits(self) -> Value:
        """The bits of a double."""
        return self.code.cast("bitcast", self, _WHOLE)

    def real(self) -> Value:
        """The double of these bits."""
        return self.code.cast("bitcast", self, _REAL)

    def otherwise(self, yes: Value | float, no: Value | float) -> Value:
        """`yes` where this is true, `no` elsewhere."""
        return self.code.choose(self, yes, no)


class Lanes:
    """Lines for `width` numbers side by side; 0 for one number that is no vector."""

    def __init__(self, width: int):
        self.width = width
        self.lines: list[str] = []
        self.intrinsics: set[str] = set()

    def type_of(self, kind: str) -> str:
        """LLVM's name of the type."""
        return f"<{self.width} x {kind}>" if self.width else kind

    def argument(self, name: str) -> Value:
        """A double handed in."""
        return Value(self, f"%{name}", _REAL)

    def constant(self, x: float) -> Value:
        """A double, the same in every lane."""
        return Value(self, self._text(x, _REAL), _REAL)

    def _text(self, value: Value | float, kind: str) -> str:
        """A name, or a constant in every lane."""
        if isinstance(value, Value):
            return value.name
        text = f"0x{bits_of(value):016X}" if kind == _REAL else str(int(value))
        if not self.width:
            return text
        return "<" + ", ".join([f"{kind} {text}"] * self.width) + ">"

    def _keep(self, text: str, kind: str) -> Value:
        name = f"%v{len(self.lines)}"
        self.lines.append(f"  {name} = {text}")
        return Value(self, name, kind)

    def line(self, operation: str, a: Value, b: Value | float, kind: str = "") -> Value:
        """An operation on two values of one type."""
        operands = f"{self.type_of(a.kind)} {a.name}, {self._text(b, a.kind)}"
        return self._keep(f"{operation} {operands}", kind or a.kind)

    def cast(self, operation: str, a: Value, kind: str) -> Value:
        """The value as another type."""
        return self._keep(
            f"{operation} {self.type_of(a.kind)} {a.name} to {self.type_of(kind)}", kind
        )

    def choose(self, condition: Value, yes: Value | float, no: Value | float) -> Value:
        """One of two doubles, lane by lane."""
        real = self.type_of(_REAL)
        return self._keep(
            f"select {self.type_of(_TRUTH)} {condition.name}, {real} {self._text(yes, _REAL)}, "
            f"{real} {self._text(no, _REAL)}",
            _REAL,
        )

    def call(self, intrinsic: str, *values: Value | float) -> Value:
        """An operation that LLVM knows by name: fma, trunc, fabs."""
        suffix = f"v{self.width}f64" if self.width else "f64"
        real, name = self.type_of(_REAL), f"@llvm.{intrinsic}.{suffix}"
        self.intrinsics.add(f"declare {real} {name}({', '.join([real] * len(values))})")
        operands = ", ".join(f"{real} {self._text(value, _REAL)}" for value in values)
        return self._keep(f"call {real} {name}({operands})", _REAL)

    def fma(self, a: Value, b: Value | float, c: Value | float) -> Value:
        """a b + c, rounded once."""
        return self.call("fma", a, b, c)

    def one_by_one(self, function: str, *values: Value) -> Value:
        """A function of single numbers, for each lane."""
        if not self.width:
            given = ", ".join(f"double {value.name}" for value in values)
            return self._keep(f"call double {function}({given})", _REAL)
        real = self.type_of(_REAL)
        whole = Value(self, "poison", _REAL)
        for i in range(self.width):
            parts = [self._keep(f"extractelement {real} {v.name}, i64 {i}", _REAL) for v in values]
            given = ", ".join(f"double {part.name}" for part in parts)
            one = self._keep(f"call double {function}({given})", _REAL)
            whole = self._keep(
                f"insertelement {real} {whole.name}, double {one.name}, i64 {i}", _REAL
            )
        return whole
