# SPDX-License-Identifier: MIT
"""Routines that are Python functions: the five decorators.

The parameter names are arguments of the interface: any subset in any order, in either naming
generation and any case. They are the declaration of what the routine needs::

    @usersub.vfric_coef
    def mu(fCoef, slipRate, props):
        for k in range(fCoef.shape[0]):
            fCoef[k] = props[1] + (props[0] - props[1]) * math.exp(-props[2] * slipRate[k])

Arrays are Fortran-ordered views of the published shape, counted from zero; arrays that are only
read refuse to be written to. Scalars that are only read are scalars; scalars that are written (LM,
SED, SFD, PNEWDT) are arrays of one element: `LM[0] = 0`. Names are texts without trailing blanks.
numba compiles the function when a driver first asks for it (`error_model="numpy"`: a division by
zero gives infinity or NaN). With `compiled=False`, or USERSUB_DEBUG=1 in the environment, the
interpreter runs it, so that a debugger can step into it (in single precision numpy then keeps
`0.0 + x` single, where compiled code goes on in double).
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from usersub.errors import AbiError
from usersub.routine.declaration import Declaration, declare
from usersub.routine.routine import BLOCK, FULL, POINTS, Entry, Routine
from usersub.routine.vector_math import choice

__all__ = ["PythonRoutine", "fric", "fric_coef", "vfric", "vfric_coef", "vfriction"]


@dataclass(frozen=True, eq=False, repr=False)
class PythonRoutine(Routine):
    """A Python function behind one interface; calling it calls the function itself.

    Attributes:
        function: the function, uncompiled.
        make_full_entry: makes the entry with the published argument list.
    """

    function: Callable[..., None] = field(kw_only=True, repr=False)
    make_full_entry: Callable[[str], Entry] = field(kw_only=True, repr=False)

    def __post_init__(self) -> None:
        # What `help` and `inspect` show is the user's function.
        object.__setattr__(self, "__doc__", self.function.__doc__)
        object.__setattr__(self, "__wrapped__", self.function)

    def __repr__(self) -> str:
        face = self.interface
        return f"<{face.name.upper()} routine '{self.name}' ({face.generation}) at {self.origin}>"

    def __call__(self, *arguments: Any) -> None:
        """Calls the function with numpy arrays, uncompiled: for trying it out and for tests."""
        return self.function(*arguments)

    def full_entry(self, precision: str = "double") -> Entry:
        """An entry that other languages call like the published routine: all arguments by
        reference and the hidden lengths of the texts. An exception is reported on the standard
        error stream by numba, since these interfaces return nothing."""
        return self.make_full_entry(precision)


class _Maker:
    """Makes each entry of a function once, whichever thread asks first."""

    def __init__(
        self,
        declaration: Declaration,
        precision: str | None,
        style: int,
        compiled: bool,
        vector: str = "",
    ):
        self._declaration = declaration
        self._vector = vector
        self._precision = precision
        self._style = style
        self._compiled = compiled
        self._entries: dict[str, Entry] = {}
        self._lock = threading.Lock()

    def __call__(self, precision: str) -> Entry:
        face = self._declaration.interface
        if precision not in face.precisions or precision != (self._precision or precision):
            allowed = (self._precision,) if self._precision else face.precisions
            raise AbiError(
                f"routine '{self._declaration.name}' ({face.name.upper()}) exists in "
                f"{' and '.join(allowed)} precision, not in {precision!r}"
            )
        with self._lock:
            if precision not in self._entries:
                self._entries[precision] = self._make(precision)
            return self._entries[precision]

    def _make(self, precision: str) -> Entry:
        if self._compiled:
            from usersub.routine.compiled import compiled_entry

            return compiled_entry(self._declaration, precision, self._style, self._vector)
        from usersub.routine.interpreted import interpreted_entry

        return interpreted_entry(self._declaration, precision, self._style)


def _routine(
    name: str,
    law: Callable,
    precision: str | None,
    generation: str | None,
    compiled: bool,
    block_safe: bool,
    thread_safe: bool,
    vector_math: bool | str,
) -> PythonRoutine:
    declaration = declare(name, law, generation)
    precisions = declaration.interface.precisions
    if precision is not None and precision not in precisions:
        raise AbiError(
            f"{declaration.origin}: {name.upper()} exists in {' and '.join(precisions)} "
            f"precision, not in {precision!r}"
        )
    return routine_of(declaration, precision, compiled, block_safe, thread_safe, vector_math)


def routine_of(
    declaration: Declaration,
    precision: str | None = None,
    compiled: bool = True,
    block_safe: bool = False,
    thread_safe: bool = True,
    vector_math: bool | str = False,
) -> PythonRoutine:
    """The routine of a function whose arguments are declared."""
    vector = choice(vector_math)
    compiled = compiled and os.environ.get("USERSUB_DEBUG", "0") in ("", "0")
    # FRIC is called point by point: the loop over the points is compiled with the function.
    style = POINTS if compiled and declaration.interface.name == "fric" else BLOCK
    return PythonRoutine(
        interface=declaration.interface,
        language="python",
        name=declaration.name,
        origin=declaration.origin,
        make_entry=_Maker(declaration, precision, style, compiled, vector),
        uses=declaration.uses,
        block_safe=block_safe,
        # The interpreter runs one thread at a time, and a debugger wants the one it was started in.
        thread_safe=thread_safe and compiled,
        replay=_Maker(declaration, precision, BLOCK, False) if compiled else None,
        function=declaration.function,
        make_full_entry=_Maker(declaration, precision, FULL, compiled, vector),
    )


def _decorator(name: str) -> Callable[..., Any]:
    def decorate(
        function: Callable | None = None,
        *,
        precision: str | None = None,
        generation: str | None = None,
        compiled: bool = True,
        block_safe: bool = False,
        thread_safe: bool = True,
        vector_math: bool | str = False,
    ) -> Any:
        options = precision, generation, compiled, block_safe, thread_safe, vector_math
        if function is None:
            return lambda law: _routine(name, law, *options)
        return _routine(name, function, *options)

    decorate.__name__ = decorate.__qualname__ = name
    decorate.__doc__ = f"""Makes a {name.upper()} routine of a function whose parameters are named
    like arguments of the interface (see `usersub.routine.python`).

    Args:
        function: the function, or one that numba's `njit` made of it.
        precision: "double" or "single" if it works in one only; None: in all of the interface.
        generation: "legacy" or "2022" (FRIC_COEF); None: told by the names, else the newest.
        compiled: False runs it uncompiled, for a debugger.
        block_safe: FRIC_COEF: it handles more than one contact point a call.
        thread_safe: blocks may run in different threads.
        vector_math: True: exp, log and pow are polynomials inside the routine's own loops, three
            times as fast in long blocks, with the same bits for every block size and on every
            machine, and with errors below one unit of the last place, where the C library's are
            below .6 (`usersub.routine.vector_kernels`). "libmvec": the vector functions of
            the C library, with errors up to four units, for comparison.

    Returns:
        PythonRoutine: to be handed to a driver; calling it calls the function.

    Raises:
        AbiError: a parameter is not an argument of the interface; there is no such vector_math.
    """
    return decorate


fric = _decorator("fric")
fric_coef = _decorator("fric_coef")
vfric = _decorator("vfric")
vfriction = _decorator("vfriction")
vfric_coef = _decorator("vfric_coef")
