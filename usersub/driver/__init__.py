# SPDX-License-Identifier: MIT
"""The Python drivers: a routine in a scene, called with one pointer.

The package is also the function `usersub.driver(routine, scene)`, which picks the driver that the
routine's interface belongs to.
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usersub.driver.explicit import ExplicitDriver
    from usersub.driver.law import LawLike
    from usersub.driver.scene import Scene
    from usersub.driver.standard import StandardDriver
    from usersub.routine.routine import Routine


def make(
    routine: Routine | LawLike, scene: Scene, *, reuse: bool = False
) -> StandardDriver | ExplicitDriver:
    """The driver of `routine` in `scene`: Standard for FRIC and FRIC_COEF, else Explicit.

    A law stands behind interfaces of both: Explicit where the scene has nodes (`nodes`,
    `secondary_nodes`) or single precision.
    """
    from usersub.driver.explicit import ExplicitDriver
    from usersub.driver.law import LawLike, solver_of
    from usersub.driver.scene import Scene
    from usersub.driver.standard import StandardDriver

    solver = getattr(getattr(routine, "interface", None), "solver", None)
    if isinstance(routine, LawLike) and isinstance(scene, Scene):
        solver = solver_of(routine, scene)
    kind = StandardDriver if solver == "standard" else ExplicitDriver
    return kind(routine, scene, reuse=reuse)


class _CallablePackage(ModuleType):
    """A package that can be called: `usersub.driver` is folder and function under one name."""

    def __call__(self, routine: Routine, scene: Scene, *, reuse: bool = False):
        return make(routine, scene, reuse=reuse)


sys.modules[__name__].__class__ = _CallablePackage
