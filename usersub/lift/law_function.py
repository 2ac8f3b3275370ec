# SPDX-License-Identifier: MIT
"""A law function behind the interfaces: what the decorators return."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from typing import Any

from usersub import abi
from usersub.errors import LoadError
from usersub.lift import anisotropic, bristle, coefficients, explicit, fric
from usersub.lift.description import BRISTLE, COEFFICIENT, TRACTION, Count, Description
from usersub.lift.kernels import Parts, parts
from usersub.lift.wanted import uses
from usersub.routine.declaration import declare
from usersub.routine.python import PythonRoutine, routine_of
from usersub.routine.routine import RoutineMaker

#: Interfaces of a law that gives a stress.
_OF_STRESS = ("fric", "vfric", "vfriction")


class LawFunction(RoutineMaker):
    """A law of one contact point, behind every interface that can carry it.

    Attributes:
        description: what is known of the law.
        interfaces: the names of these interfaces. Each is an attribute too: `law.vfric`.
    """

    def __init__(self, description: Description, vector_math: bool | str = False):
        self.description = description
        self._vector_math = vector_math
        self.interfaces = tuple(n for n in abi.NAMES if not _reason(description, n))
        self._parts: Parts | None = None
        self._made: dict[tuple[str, str, bool], PythonRoutine] = {}
        self.__doc__ = description.function.__doc__
        self.__wrapped__ = description.function
        self.__name__ = description.name
        self.origin = description.origin

    def __repr__(self) -> str:
        law = self.description
        names = ", ".join(name.upper() for name in self.interfaces)
        return f"<{law.kind} law '{law.name}' ({names}) at {law.origin}>"

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """Calls the law function itself."""
        return self.description.function(*arguments, **named)

    def __getattr__(self, name: str) -> PythonRoutine:
        if name in abi.NAMES:
            return self.behind(name)
        raise AttributeError(f"a law function has no attribute '{name}'")

    @property
    def name(self) -> str:
        """Name of the function."""
        return self.description.name

    @property
    def anisotropic(self) -> bool:
        """Whether it gives two coefficients."""
        return self.description.anisotropic

    def behind(
        self,
        interface: str,
        precision: str = "double",
        *,
        generation: str | None = None,
        compiled: bool = True,
    ) -> PythonRoutine:
        """The routine behind one interface, compiled when a driver first asks for it.

        Args:
            interface: its name in any case.
            precision: refuses an interface that does not exist in it.
            generation: of FRIC_COEF; the newest if not given.
            compiled: False runs it uncompiled, for a debugger.

        Raises:
            LoadError: the interface cannot carry the law, or there is none of this name.
        """
        try:
            face = abi.interface(interface, generation)
        except KeyError as error:
            raise LoadError(error.args[0]) from None
        if reason := _reason(self.description, face.name):
            raise LoadError(
                f"{self.description.kind} law '{self.name}' does not stand behind "
                f"{face.name.upper()}: {reason}; its interfaces are "
                f"{', '.join(n.upper() for n in self.interfaces)}"
            )
        if face.generation == abi.LEGACY and face.name == "fric_coef":
            if self.description.anisotropic or self.description.states != 0:
                raise LoadError(
                    f"law '{self.name}' needs FRIC_COEF of generation 2022: the legacy one has one "
                    "coefficient and no state variables"
                )
        if precision not in face.precisions:
            raise LoadError(
                f"law '{self.name}' behind {face.name.upper()} has no precision '{precision}'; "
                f"expected {' or '.join(face.precisions)}"
            )
        key = (face.name, face.generation, compiled)
        if key not in self._made:
            self._made[key] = self._make(face, compiled)
        return self._made[key]

    def states(
        self, interface: str, directions: int = 2, dimension: int = 3, props: Sequence = ()
    ) -> int:
        """Number of state variables that a scene needs for the law behind an interface.

        Args:
            interface: its name.
            directions: of friction (FRIC).
            dimension: number of coordinate directions (VFRIC, VFRICTION).
            props: the properties, where the number depends on them.
        """
        law, name = self.description, interface.lower()
        scalars, vectors = _number(law.states, props), _number(law.vectors, props)
        if name in ("fric_coef", "vfric_coef"):
            return scalars if name == "fric_coef" else 0
        if law.kind == BRISTLE:
            return vectors * (directions if name == "fric" else dimension) + scalars
        elastic = directions if name == "fric" and law.kind != TRACTION else 0
        return elastic + scalars

    def needed_props(self, props: Sequence = ()) -> int:
        """Least number of properties; where it depends on them, given these."""
        return _number(self.description.props, props)

    def value(self, *, compiled: bool = False, **quantities: Any) -> Any:
        """What the law gives for the quantities of a point, for tests and for trying it out.

        Args:
            compiled: by machine code instead of the interpreter.
            quantities: by the names of the arguments; `state` and `vectors` are overwritten.
                Quantities that the law does not read may be given too.
        """
        from usersub.lift.trial import value

        return value(self._all_parts(), quantities, compiled)

    def derivatives(self, *, compiled: bool = False, **quantities: Any) -> Any:
        """The value and its derivatives by the quantities that the law reads.

        Returns:
            value and a dictionary of derivatives by name; of an anisotropic or bristle law pairs
            of both.
        """
        from usersub.lift.trial import derivatives

        return derivatives(self._all_parts(), quantities, compiled)

    def _all_parts(self) -> Parts:
        if self._parts is None:
            self._parts = parts(self.description)
        return self._parts

    def _make(self, face: abi.Interface, compiled: bool) -> PythonRoutine:
        from usersub.lift.compiling import Prepared

        law = self.description
        function: Any = _maker(law, face)(self._all_parts())
        function.__name__ = function.__qualname__ = law.name
        function.__doc__ = law.function.__doc__
        declaration = declare(face.name, function, face.generation)
        declaration = dataclasses.replace(declaration, origin=law.origin)
        routine = routine_of(
            declaration,
            compiled=compiled,
            # State variables stand in rData for one point alone.
            block_safe=face.name != "fric_coef" or law.states == 0,
            vector_math=self._vector_math,
        )
        prepared = {
            field: Prepared(getattr(routine, field), self._all_parts(), function)
            for field in ("make_entry", "make_full_entry")
            if routine.replay is not None
        }
        return dataclasses.replace(routine, uses=uses(declaration, law), **prepared)


def _number(count: Count, props: Sequence) -> int:
    if not callable(count):
        return count
    import numpy as np

    return int(count(np.asarray(props, dtype=float)))


def _reason(law: Description, interface: str) -> str:
    """Why an interface cannot carry a law; "" where it can."""
    if law.kind != COEFFICIENT and interface not in _OF_STRESS:
        return "a stress is no coefficient times pressure"
    if law.anisotropic and interface not in ("fric", "fric_coef"):
        return "it knows one coefficient only"
    if interface == "vfric_coef" and law.states != 0:
        return "it has no state variables"
    return ""


def _maker(law: Description, face: abi.Interface) -> Callable[[Parts], Callable]:
    """What makes the routine's function."""
    if face.name == "fric_coef":
        legacy = face.generation == abi.LEGACY
        return coefficients.fric_coef_legacy if legacy else coefficients.fric_coef
    if face.name == "vfric_coef":
        return coefficients.vfric_coef
    if law.kind == BRISTLE:
        return {"fric": bristle.fric, "vfric": bristle.vfric, "vfriction": bristle.vfriction}[
            face.name
        ]
    if face.name != "fric":
        return explicit.vfric if face.name == "vfric" else explicit.vfriction
    if law.kind == TRACTION:
        return fric.traction
    return anisotropic.penalty if law.anisotropic else fric.penalty
