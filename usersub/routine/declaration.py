# SPDX-License-Identifier: MIT
"""What the signature of a Python function says: interface, generation, arguments it needs."""

from __future__ import annotations

import dis
import inspect
from collections.abc import Callable
from dataclasses import dataclass
from types import CodeType, FunctionType

from usersub import abi
from usersub.emit.numba_adapter import dimension_positions, is_array
from usersub.errors import AbiError
from usersub.routine.routine import READS, READS_AND_WRITES, UNUSED, WRITES

_INTENTS = {"read": READS, "write": WRITES, "readwrite": READS_AND_WRITES}

_REFUSED = {
    inspect.Parameter.VAR_POSITIONAL: "'*{}' stands for no argument",
    inspect.Parameter.VAR_KEYWORD: "'**{}' stands for no argument",
    inspect.Parameter.KEYWORD_ONLY: "'{}' is keyword-only, but arguments are passed by position",
}


@dataclass(frozen=True)
class Declaration:
    """A Python function as a routine.

    Attributes:
        interface: interface and generation.
        function: the function itself, uncompiled.
        law: what numba is to compile: `function`, or the numba dispatcher the user made of it.
        positions: for each parameter the position of its argument in the interface.
        origin: "file:line" of the function, or of the law that it calls.
    """

    interface: abi.Interface
    function: FunctionType
    law: Callable
    positions: tuple[int, ...]
    origin: str

    @property
    def name(self) -> str:
        """Name of the function."""
        return self.function.__name__

    @property
    def file(self) -> str:
        """The user's file: that of the function, or of the law which the function calls."""
        return self.origin.rpartition(":")[0]

    @property
    def uses(self) -> tuple[int, ...]:
        """What is done with each argument; those that give the shape of another one are read."""
        sizes = dimension_positions(self.interface, self.positions)
        return tuple(
            _INTENTS[arg.intent] if i in self.positions else (READS if i in sizes else UNUSED)
            for i, arg in enumerate(self.interface.args)
        )


def origin_of(code: CodeType) -> str:
    """Where a function stands, as "file:line"."""
    return f"{code.co_filename}:{code.co_firstlineno}"


def declare(name: str, law: Callable, generation: str | None = None) -> Declaration:
    """Reads the parameter names of `law` as arguments of the interface `name`.

    Raises:
        AbiError: not a plain function, or a parameter is no argument of the interface.
    """
    function = getattr(law, "py_func", law)
    if not isinstance(function, FunctionType):
        raise AbiError(f"@{name} decorates a function, not {law!r}")
    where = f"{origin_of(function.__code__)}: routine '{function.__name__}'"
    if function.__code__.co_flags & (
        inspect.CO_GENERATOR | inspect.CO_COROUTINE | inspect.CO_ASYNC_GENERATOR
    ):
        raise AbiError(f"{where} is a generator or coroutine; a routine is a plain function")
    names = _parameter_names(function, where)
    try:
        face = abi.interface(name, generation or _generation(name, names, where))
        positions = tuple(face.position(parameter) for parameter in names)
    except KeyError as error:
        raise AbiError(f"{where}: {error.args[0]}{_other(name, names)}") from None
    seen: dict[int, str] = {}
    for parameter, position in zip(names, positions, strict=True):
        if position in seen:
            raise AbiError(
                f"{where} names one argument twice: '{seen[position]}' and '{parameter}' are "
                f"both argument {position + 1} of {name.upper()}"
            )
        seen[position] = parameter
    _check_assignments(function, face, positions, where)
    if all(face.args[position].intent == "read" for position in positions):
        writable = ", ".join(a.modern for a in face.args if a.intent != "read")
        raise AbiError(
            f"{where} names nothing that it can write and would have no effect; expected at least "
            f"one of {writable}"
        )
    return Declaration(face, function, law, positions, origin_of(function.__code__))


def _parameter_names(function: FunctionType, where: str) -> list[str]:
    names = []
    for parameter in inspect.signature(function, follow_wrapped=False).parameters.values():
        if parameter.kind in _REFUSED:
            why = _REFUSED[parameter.kind].format(parameter.name)
            raise AbiError(f"{where}: {why}; name the arguments that the routine needs")
        if parameter.default is not inspect.Parameter.empty:
            raise AbiError(
                f"{where}: '{parameter.name}' has a default value, but the driver always passes "
                "every argument that is named; remove the default"
            )
        names.append(parameter.name)
    return names


def _own_names(face: abi.Interface) -> set[str]:
    """Lower-case spellings that only this generation of the interface has."""
    others = [i for i in abi.INTERFACES if i.name == face.name and i is not face]
    if not others:
        return set()
    return set(face.positions) - {s for other in others for s in other.positions}


def _generation(name: str, names: list[str], where: str) -> str | None:
    """The generation that the parameter names tell; None if they tell none."""
    faces = [i for i in abi.INTERFACES if i.name == name]
    lower = {n.lower() for n in names}
    told = [i.generation for i in faces if lower & _own_names(i)]
    if len(told) > 1:
        mixed = [n for n in names if any(n.lower() in _own_names(i) for i in faces)]
        raise AbiError(
            f"{where} mixes arguments of the generations {' and '.join(told)} of "
            f"{name.upper()}: {', '.join(mixed)}"
        )
    return told[0] if told else None


def _other(name: str, names: list[str]) -> str:
    """A clause for names that belong to another generation of the interface."""
    for face in abi.INTERFACES:
        if face.name == name:
            strange = [n for n in names if n.lower() in _own_names(face)]
            if strange:
                return f" ('{strange[0]}' belongs to the generation \"{face.generation}\")"
    return ""


def _check_assignments(
    function: FunctionType, face: abi.Interface, positions: tuple[int, ...], where: str
) -> None:
    """Refuses `LM = 0` for a written argument: it would rebind the name and write nothing."""
    parameters = function.__code__.co_varnames[: len(positions)]
    written = {
        parameter: face.args[position]
        for parameter, position in zip(parameters, positions, strict=True)
        if is_array(face.args[position]) and face.args[position].intent != "read"
    }
    in_place = False
    for step in dis.get_instructions(function):
        if "STORE_FAST" in step.opname or step.opname == "STORE_DEREF":
            stored = step.argval if isinstance(step.argval, tuple) else (step.argval,)
            stored = stored[:1] if step.opname == "STORE_FAST_LOAD_FAST" else stored
            for parameter in written.keys() & set(stored):
                if not in_place:
                    element = "[:]" if written[parameter].shape else "[0]"
                    raise AbiError(
                        f"{where} assigns to the name '{parameter}', which the driver does not "
                        f"see; write {parameter}{element} = ..., or take another name"
                    )
        in_place = step.opname == "BINARY_OP" and step.argrepr.endswith("=")
