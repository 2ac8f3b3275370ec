# SPDX-License-Identifier: MIT
"""What a law function says of itself: by its name, its arguments and its decorator."""

from __future__ import annotations

import difflib
import dis
import inspect
from collections.abc import Callable
from dataclasses import dataclass
from types import CodeType, FunctionType
from typing import Any

from usersub.errors import AbiError
from usersub.routine.declaration import origin_of

COEFFICIENT, STRENGTH, TRACTION, BRISTLE = "coefficient", "strength", "traction", "bristle"

#: Quantities that a derivative can be asked by, in their order, of laws along the slip.
VARIABLES = ("slip_rate", "pressure", "temperature", "slip_increment")
#: The same of bristle laws; `motion` has two.
BRISTLE_VARIABLES = ("motion_1", "motion_2", "pressure", "temperature")

#: The arguments that a law may have, in the order in which the interfaces pass them.
ARGUMENTS = (*VARIABLES[:3], "fields", "slip_increment", "time_increment", "state", "props")
BRISTLE_ARGUMENTS = ("motion", "time_increment", "pressure", "temperature", "fields", "vectors",
                     "state", "props")  # fmt: skip

_WAYS = ("dual", "own", None)

#: A number, or a function of the properties that tells it.
Count = int | Callable[[Any], int]


@dataclass(frozen=True)
class Description:
    """A law function and what is known of it.

    Attributes:
        function: the function itself.
        kind: "coefficient", "strength", "traction" or "bristle".
        arguments: its arguments in their order.
        props: least number of properties.
        states, vectors: numbers of scalar and vector state variables.
        derivatives: "dual", "own" or None (taken to be zero).
        anisotropic: it returns one coefficient for each direction.
        origin: "file:line".
    """

    function: FunctionType
    kind: str
    arguments: tuple[str, ...]
    props: Count
    states: Count
    vectors: Count
    derivatives: str | None
    anisotropic: bool
    origin: str

    @property
    def name(self) -> str:
        """Name of the function."""
        return self.function.__name__

    @property
    def variables(self) -> tuple[str, ...]:
        """Quantities that it reads and has derivatives by, in their order."""
        if self.kind == BRISTLE:
            read = {"motion_1", "motion_2", *self.arguments}
            return tuple(v for v in BRISTLE_VARIABLES if v in read)
        return tuple(v for v in VARIABLES if v in self.arguments)

    def reads(self, *names: str) -> bool:
        """Whether it has at least one of these arguments."""
        return any(name in self.arguments for name in names)


def describe(
    kind: str,
    function: Any,
    props: Count,
    states: Count,
    vectors: Count,
    derivatives: str | None,
    anisotropic: bool | None,
) -> Description:
    """Reads a law function.

    Raises:
        AbiError: it cannot be one; the message says where and why.
    """
    if not isinstance(function, FunctionType):
        raise AbiError(f"@{kind} decorates a plain function, not {function!r}")
    where = f"{origin_of(function.__code__)}: {kind} law '{function.__name__}'"
    if function.__code__.co_flags & (
        inspect.CO_GENERATOR | inspect.CO_COROUTINE | inspect.CO_ASYNC_GENERATOR
    ):
        raise AbiError(f"{where} is a generator or coroutine; a law is a plain function")
    arguments = _arguments(function, kind, where)
    if kind == TRACTION and "motion" in arguments:
        kind = BRISTLE
    _check_settings(where, props, states, vectors, derivatives)
    _check_state(function, where, arguments, {"state": states, "vectors": vectors})
    return Description(
        function=function,
        kind=kind,
        arguments=arguments,
        props=props,
        states=states,
        vectors=vectors,
        derivatives=derivatives,
        anisotropic=_anisotropy(function, where, kind, derivatives, anisotropic),
        origin=origin_of(function.__code__),
    )


def _arguments(function: FunctionType, kind: str, where: str) -> tuple[str, ...]:
    """The names of the arguments, all of which the kind of law knows."""
    parameters = inspect.signature(function).parameters.values()
    for parameter in parameters:
        if parameter.kind not in (parameter.POSITIONAL_ONLY, parameter.POSITIONAL_OR_KEYWORD):
            raise AbiError(f"{where}: '{parameter}' stands for no quantity; name those it reads")
        if parameter.default is not parameter.empty:
            raise AbiError(
                f"{where}: '{parameter.name}' has a default value, but every argument that is "
                "named is passed; remove the default"
            )
    names = tuple(parameter.name for parameter in parameters)
    bristle = kind == TRACTION and "motion" in names
    known = BRISTLE_ARGUMENTS if bristle else ARGUMENTS
    for name in names:
        if name in known:
            continue
        if bristle and name in ARGUMENTS:
            reason = f"'{name}' does not go with 'motion';"
        elif name in ("motion", "vectors"):
            reason = f"'{name}' is for @usersub.traction with the argument 'motion';"
        else:
            near = difflib.get_close_matches(name, known, n=1, cutoff=0.0)
            reason = f"there is no quantity '{name}'; did you mean '{near[0]}'? As arguments"
        raise AbiError(f"{where}: {reason} it may have {', '.join(known)}")
    return names


def _check_settings(
    where: str, props: Count, states: Count, vectors: Count, derivatives: str | None
) -> None:
    for name, count in (("props", props), ("states", states), ("vectors", vectors)):
        whole = isinstance(count, int) and not isinstance(count, bool) and count >= 0
        if not whole and not isinstance(count, FunctionType):
            raise AbiError(
                f"{where}: {name} = {count!r}, expected a number from 0 on or a function of props "
                "that tells it"
            )
    if derivatives not in _WAYS:
        raise AbiError(f"{where}: derivatives = {derivatives!r}, expected 'dual', 'own' or None")


def _check_state(
    function: FunctionType, where: str, arguments: tuple[str, ...], declared: dict[str, Count]
) -> None:
    """Refuses state that is declared and not used, used and not declared, or only rebound."""
    for name, count in declared.items():
        setting = "states" if name == "state" else name
        if count != 0 and name not in arguments:
            raise AbiError(f"{where} declares {setting} = {count} but has no argument '{name}'")
        if count == 0 and name in arguments:
            raise AbiError(
                f"{where} has the argument '{name}' but declares no state variables; say how many: "
                f"{setting}=1"
            )
        if name in arguments:
            _check_use(function, where, name)


def _check_use(function: FunctionType, where: str, name: str) -> None:
    used = False
    for step in dis.get_instructions(function):
        values = step.argval if isinstance(step.argval, tuple) else (step.argval,)
        if name not in values:
            continue
        if step.opname in ("STORE_FAST", "STORE_DEREF"):
            raise AbiError(
                f"{where} assigns to the name '{name}', which nobody sees; write "
                f"{name}{'[i]' if name == 'state' else '[i, 0]'} = ..."
            )
        used = used or step.opname.startswith("LOAD")
    if not used:
        raise AbiError(f"{where} has the argument '{name}' but never uses it")


def _anisotropy(
    function: FunctionType, where: str, kind: str, derivatives: str | None, asked: bool | None
) -> bool:
    """Whether the law returns two coefficients, as asked or as its return statements tell."""
    if asked and kind != COEFFICIENT:
        raise AbiError(f"{where}: only a coefficient can be anisotropic")
    if asked is not None or derivatives == "own":
        return bool(asked)
    lengths = set(returned_tuples(function.__code__))
    if kind == BRISTLE:
        expected = "the tractions in both directions"
        wrong = lengths - {2}
    elif kind == COEFFICIENT:
        expected = "one coefficient, or one for each of the two directions"
        wrong = lengths - {2}
    else:
        expected = "one number"
        wrong = lengths
    if wrong:
        raise AbiError(f"{where} returns {wrong.pop()} numbers, expected {expected}")
    return kind == COEFFICIENT and bool(lengths)


def returned_tuples(code: CodeType) -> list[int]:
    """Lengths of the tuples in the return statements of a function."""
    lengths = []
    before: dis.Instruction | None = None
    for step in dis.get_instructions(code):
        if step.opname == "RETURN_CONST" and isinstance(step.argval, tuple):
            lengths.append(len(step.argval))
        elif step.opname == "RETURN_VALUE" and before is not None:
            if before.opname == "BUILD_TUPLE":
                lengths.append(before.arg or 0)
            elif before.opname == "LOAD_CONST" and isinstance(before.argval, tuple):
                lengths.append(len(before.argval))
        before = step
    return lengths
