# SPDX-License-Identifier: MIT
"""Source text of the adapter between an interface's pointers and a Python function.

The text is compiled by numba (`usersub.routine.compiled`). It reads the dimensions, makes
Fortran-ordered views of the arguments that the function names, calls the function and turns an
exception into a status. Nothing here imports numba.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from usersub import abi
from usersub.routine.routine import BLOCK, FULL, POINTS
from usersub.statuses import STATUSES

#: Status of a Python routine that raised.
RAISED = next(s.value for s in STATUSES if s.name == "ROUTINE_RAISED")

_TERM = re.compile(r"(?P<number>\d+)|(?P<name>[A-Za-z]\w*)(\((?P<index>\d+)\))?")

#: Longest tuple or argument list in the generated source.
_LONGEST = 25

#: One term of a dimension: a number, or (position of an integer argument, zero-based element).
Term = int | tuple[int, int]


def shape_terms(face: abi.Interface, arg: abi.Arg) -> tuple[tuple[Term, ...], ...]:
    """The dimensions of an argument, each as the terms that are to be added up."""
    dimensions = []
    for text in arg.shape:
        terms: list[Term] = []
        for piece in text.split("+"):
            match = _TERM.fullmatch(piece)
            if match is None:
                raise ValueError(f"dimension '{text}' of {arg.name} is not understood")
            if match["number"]:
                terms.append(int(match["number"]))
            else:
                terms.append((face.position(match["name"]), int(match["index"] or 1) - 1))
        dimensions.append(tuple(terms))
    return tuple(dimensions)


def dimension_positions(face: abi.Interface, positions: Sequence[int]) -> set[int]:
    """Positions of the integer arguments that give the shapes of the arguments at `positions`."""
    return {
        term[0]
        for position in positions
        for terms in shape_terms(face, face.args[position])
        for term in terms
        if not isinstance(term, int)
    }


def is_array(arg: abi.Arg) -> bool:
    """Whether a Python routine gets the argument as an array: it has a shape or is written."""
    return arg.kind != "char" and bool(arg.shape or arg.intent != "read")


def _view(face: abi.Interface, position: int, pointer: str, real: str, length: str) -> str:
    """Expression of what the function gets for one argument."""
    arg = face.args[position]
    if arg.kind == "char":
        return f"text_at({pointer}, {length})"
    dtype = real if arg.kind == "real" else "int32"
    if not is_array(arg):
        value = f"carray({pointer}, (1,), {dtype})[0]"
        return f"int64({value})" if arg.kind == "int" else value
    sizes = [
        " + ".join(str(t) if isinstance(t, int) else f"size_{t[0]}_{t[1]}" for t in terms)
        for terms in shape_terms(face, arg)
    ] or ["1"]
    make = "farray" if len(sizes) > 1 else "carray"
    view = f"{make}({pointer}, ({', '.join(sizes)},), {dtype})"
    return f"readonly({view})" if arg.intent == "read" else view


def adapter_source(
    face: abi.Interface, positions: Sequence[int], precision: str, style: int = BLOCK
) -> str:
    """Source of `adapter`, which calls the global function `law`.

    Args:
        face: the interface.
        positions: for each parameter of the function the position of its argument.
        precision: "double" or "single".
        style: BLOCK: one `void **`. POINTS: the same, once for each of several contact points;
            names and numbers that give shapes are those of all points. FULL: the published
            argument list with hidden character lengths; there an exception is left to numba, which
            reports it on the standard error stream, as the published interfaces return nothing.
    """
    real = {"double": "float64", "single": "float32"}[precision]
    texts = [i for i, a in enumerate(face.args) if a.kind == "char"]
    pointers = [f"argv[{i}]" for i in range(len(face.args))]
    parameters = "argv, stride, points, count, done" if style == POINTS else "argv"
    lengths = {i: str(abi.NAME_LENGTH) for i in texts}
    if style == FULL:
        pointers = [f"p{i}" for i in range(len(face.args))]
        parameters = ", ".join(pointers + [f"n{i}" for i in texts])
        lengths = {i: f"n{i}" for i in texts}
    terms = {
        term
        for position in positions
        for dimension in shape_terms(face, face.args[position])
        for term in dimension
        if not isinstance(term, int)
    }
    same = [
        f"size_{i}_{k} = int64(carray({pointers[i]}, ({k + 1},), int32)[{k}])"
        for i, k in sorted(terms)
    ]
    own = []
    for i in positions:
        moves = style == POINTS and i not in texts
        pointer = f"moved(argv[{i}], k * stride[{i}])" if moves else pointers[i]
        view = f"a{i} = {_view(face, i, pointer, real, lengths.get(i, ''))}"
        (own if moves else same).append(view)
    lines = [
        "# SPDX-License-Identifier: MIT",
        f"# Adapter of {face.key} in {precision} precision, made by {__name__}.",
        "from usersub.routine.numba_tools import *",
        "",
        f"def adapter({parameters}):",
        *(f"    {line}" for line in [*same, *_guarded(style, own, _call(positions))]),
        "    return 0",
    ]
    return "\n".join(lines) + "\n"


def _call(positions: Sequence[int]) -> list[str]:
    """Lines that call the function."""
    arguments = [f"a{i}" for i in positions]
    if len(arguments) <= _LONGEST:
        return [f"nothing(law({', '.join(arguments)}))"]
    # Python builds longer argument lists in a way that numba does not read.
    pieces = [arguments[i : i + _LONGEST] for i in range(0, len(arguments), _LONGEST)]
    parts = " + ".join(f"({', '.join(p)},)" for p in pieces)
    return [f"parts = {parts}", "nothing(law(*parts))"]


def _guarded(style: int, own: list[str], call: list[str]) -> list[str]:
    """Lines with the call, for each point if there are several, that end with its exceptions."""
    if style == FULL:
        return call
    guarded = [
        "try:",
        *(f"    {line}" for line in call),
        "except Exception:",
        f"    return {RAISED}",
    ]
    if style == BLOCK:
        return guarded
    # Views stand before the `try`: numba takes many times as long for those inside.
    return [
        "for j in range(count):",
        *(f"    {line}" for line in ["k = points[j]", "note(done, k)", *own, *guarded]),
    ]
