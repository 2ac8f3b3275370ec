# SPDX-License-Identifier: MIT
"""Routines that record every argument they get, behind each of the ways a routine can be made."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

import engine_tables
import numpy as np

import usersub

_BLOCK = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_void_p))
_HOOK = ctypes.CFUNCTYPE(None, ctypes.POINTER(ctypes.c_void_p), ctypes.POINTER(ctypes.c_size_t))


class Probe:
    """A recording routine.

    Attributes:
        routine: what a driver takes.
        calls: one dict a call, argument name to copy.
        lengths: hidden lengths of the names (style "full").
        act: called with (probe, view) after recording; `view(name)` is the argument to write to.
            Its result is the status of a "block" probe.
    """

    def __init__(self, interface: str, precision: str, generation: str | None, act) -> None:
        self.interface, self.precision = interface, precision
        self.generation = generation or ("2022" if interface == "fric_coef" else "legacy")
        self.calls: list[dict[str, Any]] = []
        self.lengths: list[list[int]] = []
        self.errors: list[BaseException] = []
        self.act = act
        self.routine: Any = None

    def _tell(self, argv) -> int:
        addresses = [argv[i] for i in range(len(engine_tables.rows(self.interface)))]
        place = (self.interface, self.generation, self.precision, addresses)
        self.calls.append(engine_tables.decode(*place))
        if self.act is None:
            return 0
        return self.act(self, lambda name: engine_tables.writable(*place, name)) or 0

    def block(self, argv) -> int:
        try:
            return self._tell(argv)
        except BaseException as error:  # ctypes would only print it
            self.errors.append(error)
            return -9

    def full(self, argv, lengths) -> None:
        self.lengths.append(lengths[0:3])
        self.block(argv)

    def checked_calls(self) -> list[dict[str, Any]]:
        if self.errors:
            raise self.errors[0]
        return self.calls


def make_probe(
    style: str,
    interface: str,
    *,
    library=None,
    precision: str = "double",
    generation: str | None = None,
    act: Callable | None = None,
    **promises,
) -> Probe:
    """A probe of `style` "block" (ctypes), "full" (C) or "python" (an uncompiled decorator)."""
    made = Probe(interface, precision, generation, act)
    if style == "python":
        made.routine = _decorated(made, generation)
        return made
    if style == "full":
        hook = _HOOK(made.full)
        ctypes.c_void_p.in_dll(library, "hook").value = ctypes.cast(hook, ctypes.c_void_p).value
        pointer = ctypes.cast(getattr(library, f"{interface}_"), ctypes.c_void_p).value
    else:
        hook = _BLOCK(made.block)
        pointer = ctypes.cast(hook, ctypes.c_void_p).value
    made.keep = hook
    made.routine = usersub.from_pointer(
        interface, pointer, precision=precision, generation=generation, style=style, **promises
    )
    return made


def _decorated(probe: Probe, generation: str | None):
    names = [row[0] for row in engine_tables.rows(probe.interface, probe.generation)]
    space: dict[str, Any] = {"record": lambda **found: _record(probe, found)}
    pairs = ", ".join(f"{n}={n}" for n in names)
    exec(f"def probe({', '.join(names)}):\n    record({pairs})\n", space)
    decorator = getattr(usersub, probe.interface)
    return decorator(space["probe"], compiled=False, generation=generation)


def _record(probe: Probe, found: dict[str, Any]) -> None:
    copies: dict[str, Any] = {}
    for name, kind, shape in engine_tables.rows(probe.interface, probe.generation):
        value = found[name]
        if kind == "C":
            copies[name] = value.ljust(80).encode()
        else:
            copies[name] = np.array(value, order="F") if shape else np.ravel(value)[0]
    probe.calls.append(copies)


def compare(calls: list[dict[str, Any]], expected: list[dict[str, Any]], tolerance: float) -> None:
    """Every argument of every call: texts, integers and copies exactly, computed ones within
    `tolerance` of their largest entry. An expected value of type `Computed` is one of these."""
    assert len(calls) == len(expected)
    for number, (found, wanted) in enumerate(zip(calls, expected, strict=True)):
        assert set(found) == set(wanted)
        for name, value in wanted.items():
            where = f"call {number}, argument {name}"
            value, computed = value if isinstance(value, tuple) else (value, False)
            if isinstance(value, bytes):
                assert found[name] == value, where
                continue
            assert np.shape(found[name]) == np.shape(value), where
            if computed:
                size = np.max(np.abs(value), initial=0.0)
                np.testing.assert_allclose(
                    found[name], value, rtol=0, atol=tolerance * size, err_msg=where
                )
            else:
                np.testing.assert_array_equal(found[name], value, err_msg=where)


def padded(name: str) -> bytes:
    """Upper case, blank-padded to 80, as names are passed."""
    return name.upper().encode().ljust(80)


class Computed(tuple):
    """An expected value that the driver computes, so that the last bits are free."""

    def __new__(cls, value):
        return super().__new__(cls, (np.asarray(value), True))
