# SPDX-License-Identifier: MIT
"""Friction user subroutines without the commercial solver.

Write a friction law once, in Python, C or Fortran, against the argument conventions of FRIC,
FRIC_COEF, VFRIC, VFRICTION or VFRIC_COEF, and run it on whole vectors of contact points:

    import numpy as np, usersub

    @usersub.vfric_coef
    def mu(fCoef, slipRate, props):
        fCoef[:] = props[1] + (props[0] - props[1]) * np.exp(-props[2] * slipRate)

    scene = usersub.Scene(points=1000, props=[0.15, 0.05, 0.01])
    driver = usersub.CoefficientDriver(mu, scene)
    coefficient = driver.evaluate(slip_rate=np.linspace(0.0, 200.0, 1000), pressure=np.ones(1000))

The names below are loaded when they are first used, so that a program imports only what it needs.
"""

from __future__ import annotations

import importlib

TYPE_CHECKING = False  # as `typing` has it, which would take longer than all the rest

if TYPE_CHECKING:
    from usersub import deck as deck
    from usersub import laws as laws
    from usersub.driver import make as driver
    from usersub.driver.coefficient import CoefficientDriver as CoefficientDriver
    from usersub.driver.explicit import ExplicitDriver as ExplicitDriver
    from usersub.driver.scene import Scene as Scene
    from usersub.driver.standard import StandardDriver as StandardDriver
    from usersub.driver.stick_force import stick_force_kinematic as stick_force_kinematic
    from usersub.driver.stick_force import stick_force_penalty as stick_force_penalty
    from usersub.errors import AbiError as AbiError
    from usersub.errors import CompileError as CompileError
    from usersub.errors import ContractError as ContractError
    from usersub.errors import DeckError as DeckError
    from usersub.errors import Error as Error
    from usersub.errors import LoadError as LoadError
    from usersub.errors import MissingTool as MissingTool
    from usersub.errors import RoutineError as RoutineError
    from usersub.errors import SceneError as SceneError
    from usersub.errors import StateError as StateError
    from usersub.interaction import Amplitude as Amplitude
    from usersub.interaction import Change as Change
    from usersub.interaction import Friction as Friction
    from usersub.interaction import Interaction as Interaction
    from usersub.lift import LawFunction as LawFunction
    from usersub.lift import coefficient as coefficient
    from usersub.lift import strength as strength
    from usersub.lift import traction as traction
    from usersub.routine.loading import RoutineFile as RoutineFile
    from usersub.routine.loading import load as load
    from usersub.routine.messages import messages_to as messages_to
    from usersub.routine.pointers import from_pointer as from_pointer
    from usersub.routine.python import fric as fric
    from usersub.routine.python import fric_coef as fric_coef
    from usersub.routine.python import vfric as vfric
    from usersub.routine.python import vfric_coef as vfric_coef
    from usersub.routine.python import vfriction as vfriction
    from usersub.routine.routine import Routine as Routine
    from usersub.scenefile import run_scene as run_scene

_HOME = {
    "AbiError": "errors",
    "Amplitude": "interaction",
    "Change": "interaction",
    "CoefficientDriver": "driver.coefficient",
    "CompileError": "errors",
    "ContractError": "errors",
    "DeckError": "errors",
    "Error": "errors",
    "ExplicitDriver": "driver.explicit",
    "Friction": "interaction",
    "Interaction": "interaction",
    "LawFunction": "lift",
    "LoadError": "errors",
    "MissingTool": "errors",
    "Routine": "routine.routine",
    "RoutineError": "errors",
    "RoutineFile": "routine.loading",
    "Scene": "driver.scene",
    "SceneError": "errors",
    "StandardDriver": "driver.standard",
    "StateError": "errors",
    "coefficient": "lift",
    "fric": "routine.python",
    "fric_coef": "routine.python",
    "from_pointer": "routine.pointers",
    "load": "routine.loading",
    "messages_to": "routine.messages",
    "run_scene": "scenefile",
    "stick_force_kinematic": "driver.stick_force",
    "stick_force_penalty": "driver.stick_force",
    "strength": "lift",
    "traction": "lift",
    "vfric": "routine.python",
    "vfric_coef": "routine.python",
    "vfriction": "routine.python",
}

__all__ = [
    "AbiError",
    "Amplitude",
    "Change",
    "CoefficientDriver",
    "CompileError",
    "ContractError",
    "DeckError",
    "Error",
    "ExplicitDriver",
    "Friction",
    "Interaction",
    "LawFunction",
    "LoadError",
    "MissingTool",
    "Routine",
    "RoutineError",
    "RoutineFile",
    "Scene",
    "SceneError",
    "StandardDriver",
    "StateError",
    "__version__",
    "coefficient",
    "deck",
    "driver",
    "fric",
    "fric_coef",
    "from_pointer",
    "laws",
    "load",
    "messages_to",
    "run_scene",
    "stick_force_kinematic",
    "stick_force_penalty",
    "strength",
    "traction",
    "vfric",
    "vfric_coef",
    "vfriction",
]


def __getattr__(name: str) -> object:
    if name == "__version__":
        from importlib.metadata import version

        value: object = version("usersub")
    elif name == "driver":
        value = importlib.import_module("usersub.driver")
    elif name in ("deck", "laws"):
        value = importlib.import_module(f"usersub.{name}")
    elif name in _HOME:
        value = getattr(importlib.import_module(f"usersub.{_HOME[name]}"), name)
    else:
        raise AttributeError(f"module 'usersub' has no attribute '{name}'")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(set(globals()) | set(__all__))
