# SPDX-License-Identifier: MIT
"""From one point function in Python to routines behind the interfaces.

A law is a function of one contact point that returns the coefficient (or the shear traction) and
its derivatives by slip rate, pressure and temperature::

    def exponential_decay(slip_rate, _pressure, _temperature, props):
        transition = (props[0] - props[1]) * bounded_exp(-props[2] * slip_rate)
        return props[1] + transition, -props[2] * transition, 0.0, 0.0

    fric, fric_coef, vfric, vfriction, vfric_coef = coefficient_law(exponential_decay, props=3)

A leading underscore says that a variable is not read: then it is neither fetched nor passed. The
temperature is the mean of both surfaces, 0 where the scene has none. The rules behind each
interface are those of `coefficient_law.h` and `traction_law.h`, the twins for C.
"""

from __future__ import annotations

import dataclasses
import inspect
import math
from collections.abc import Callable

from usersub.laws.lift_fric import coefficient_fric, traction_fric
from usersub.routine.python import PythonRoutine, fric_coef, vfric, vfric_coef, vfriction

__all__ = ["coefficient_law", "bounded_exp", "jitable", "traction_law"]

#: exp(x) is a normal number down to here; below nothing is left that a coefficient could show.
_EXP_BOUND = -700.0

_VARIABLES = ("slip_rate", "pressure", "temperature")

#: Arguments that are left out where a law does not read the slip rate, pressure, temperature.
_FETCHED = {
    "fric": ((), (), ("TEMP",)),
    "fric_coef": (("slipRate",), ("pressure",), ("tempAvg",)),
    "fric_coef_2022": (("slipData",), ("pressure",), ("tempAvg",)),
    "vfric": (("dSlipFric",), ("areaSec", "jConSecid"), ("tempSec", "tempMain")),
    "vfriction": (("dSlipFric", "rData"), ("areaCont",), ("tempSec", "tempMain")),
    "vfric_coef": (("slipRate",), ("pressure",), ("tempAvg",)),
}


def jitable(function: Callable) -> Callable:
    """Lets compiled code call `function`, which itself stays as it is, for debuggers."""
    from numba.extending import register_jitable

    return register_jitable(function)


def bounded_exp(x):
    """exp(x) for x <= 0, without the slow numbers below the normal ones."""
    return math.exp(max(x, _EXP_BOUND))


def _ratio(numerator, denominator):
    """Quotient, or zero where there is nothing to divide by."""
    return numerator / denominator if denominator > 0 else 0.0


class _Law:
    """What the routines of one law share: the point function, what it reads, its properties."""

    def __init__(self, function: Callable, props: int | Callable, traction: bool):
        names = list(inspect.signature(function).parameters)
        if [n.lstrip("_") for n in names] != [*_VARIABLES, "props"]:
            raise TypeError(
                f"the point function {function.__name__} takes {', '.join(names)}; expected are "
                f"{', '.join(_VARIABLES)}, props, with an underscore before what is not read"
            )
        self.name, self.traction = function.__name__, traction
        self.point = jitable(function)
        self.reads = [n == v for v, n in zip(_VARIABLES, names, strict=False)]
        self.origin = f"{function.__code__.co_filename}:{function.__code__.co_firstlineno}"
        self.needed = jitable(props if callable(props) else lambda _: props)
        self.ratio = jitable(_ratio)
        jitable(bounded_exp)

    def finish(self, routine: PythonRoutine) -> PythonRoutine:
        """Names the routine after the law and leaves out what the law does not read."""
        face, uses = routine.interface, list(routine.uses)
        for read, names in zip(self.reads, _FETCHED[face.key], strict=True):
            for name in () if read else names:
                if not (self.traction and name in ("areaSec", "jConSecid", "areaCont")):
                    uses[face.position(name)] = 0
        return dataclasses.replace(routine, name=self.name, origin=self.origin, uses=tuple(uses))

    def too_few(self, interface: str) -> str:
        """Message for a scene with too few properties."""
        return f"{self.name} behind {interface} has too few properties"


def coefficient_law(
    function: Callable, props: int | Callable, generation: str = "2022"
) -> tuple[PythonRoutine, ...]:
    """Routines of a friction coefficient behind all five interfaces.

    Args:
        function: the point function, see the module.
        props: least number of properties, or a function of `props` that tells it.
        generation: of FRIC_COEF.

    Returns:
        FRIC, FRIC_COEF, VFRIC, VFRICTION, VFRIC_COEF.
    """
    law = _Law(function, props, traction=False)
    make = _fric_coef if generation == "2022" else _fric_coef_legacy
    made = (coefficient_fric(law), make(law), _vfric(law), _vfriction(law), _vfric_coef(law))
    return tuple(law.finish(routine) for routine in made)


def traction_law(function: Callable, props: int | Callable) -> tuple[PythonRoutine, ...]:
    """Routines of a shear traction that depends on the slip rate: FRIC, VFRIC, VFRICTION."""
    law = _Law(function, props, traction=True)
    return tuple(law.finish(r) for r in (traction_fric(law), _vfric(law), _vfriction(law)))


def _vfric(law: _Law) -> PythonRoutine:
    point, needed, ratio, message = law.point, law.needed, law.ratio, law.too_few("VFRIC")
    reads_rate, reads_pressure, reads_temperature = law.reads
    traction = law.traction

    @vfric
    def routine(fTangential, dSlipFric, dTimCur, fNormal, fStickForce, areaSec, jConSecid, tempSec,
                tempMain, nTemp, props):  # fmt: skip
        if props.shape[0] < needed(props):
            raise ValueError(message)
        for i in range(fNormal.shape[0]):
            normal = fNormal[i]
            if not normal > 0:
                continue
            rate = ratio(abs(dSlipFric[0, i]), dTimCur) if reads_rate else 0.0
            factor = areaSec[jConSecid[i] - 1] if traction else normal
            pressure = ratio(normal, areaSec[jConSecid[i] - 1]) if reads_pressure else 0.0
            temperature = 0.0
            if reads_temperature and nTemp > 0:
                temperature = 0.5 * (tempSec[i] + tempMain[min(i, tempMain.shape[0] - 1)])
            value = point(rate, pressure, temperature, props)[0]
            fTangential[0, i] = -min(value * factor, fStickForce[i])

    return routine


def _vfriction(law: _Law) -> PythonRoutine:
    point, needed, ratio, message = law.point, law.needed, law.ratio, law.too_few("VFRICTION")
    reads_rate, reads_pressure, reads_temperature = law.reads
    traction = law.traction

    @vfriction
    def routine(fTangential, dSlipFric, rData, fNormal, fStickForce, areaCont, tempSec, tempMain,
                nTemp, props):  # fmt: skip
        if props.shape[0] < needed(props):
            raise ValueError(message)
        for k in range(fNormal.shape[0]):
            normal = fNormal[k]
            if not normal > 0:
                continue
            rate = ratio(abs(dSlipFric[0, k]), rData[2]) if reads_rate else 0.0
            factor = areaCont[k] if traction else normal
            pressure = ratio(normal, areaCont[k]) if reads_pressure else 0.0
            temperature = 0.0
            if reads_temperature and nTemp > 0:
                temperature = 0.5 * (tempSec[k] + tempMain[min(k, tempMain.shape[0] - 1)])
            value = point(rate, pressure, temperature, props)[0]
            fTangential[0, k] = -min(value * factor, fStickForce[k])

    return routine


def _vfric_coef(law: _Law) -> PythonRoutine:
    point, needed, message = law.point, law.needed, law.too_few("VFRIC_COEF")
    reads_rate, reads_pressure, reads_temperature = law.reads

    @vfric_coef
    def routine(fCoef, nBlock, nTemp, slipRate, pressure, tempAvg, props):
        if props.shape[0] < needed(props):
            raise ValueError(message)
        for k in range(nBlock):
            fCoef[k] = point(
                slipRate[k] if reads_rate else 0.0,
                pressure[k] if reads_pressure else 0.0,
                tempAvg[k] if reads_temperature and nTemp > 0 else 0.0,
                props,
            )[0]

    return routine


def _fric_coef(law: _Law) -> PythonRoutine:
    point, needed, message = law.point, law.needed, law.too_few("FRIC_COEF")
    reads_rate, reads_pressure, reads_temperature = law.reads

    @fric_coef(generation="2022", block_safe=True)
    def routine(fCoef, fCoefDeriv, nBlock, nTemp, slipData, pressure, tempAvg, props):
        if props.shape[0] < needed(props):
            raise ValueError(message)
        for k in range(nBlock):
            fCoef[k, 0], fCoefDeriv[k, 0, 0], fCoefDeriv[k, 1, 0], fCoefDeriv[k, 2, 0] = point(
                slipData[k, 0] if reads_rate else 0.0,
                pressure[k] if reads_pressure else 0.0,
                tempAvg[k] if reads_temperature and nTemp > 0 else 0.0,
                props,
            )

    return routine


def _fric_coef_legacy(law: _Law) -> PythonRoutine:
    point, needed, message = law.point, law.needed, law.too_few("FRIC_COEF")
    reads_rate, reads_pressure, reads_temperature = law.reads

    @fric_coef(generation="legacy", block_safe=True)
    def routine(fCoef, fCoefDeriv, nBlock, nTemp, slipRate, pressure, tempAvg, props):
        if props.shape[0] < needed(props):
            raise ValueError(message)
        for k in range(nBlock):
            fCoef[k], fCoefDeriv[k, 0], fCoefDeriv[k, 1], fCoefDeriv[k, 2] = point(
                slipRate[k] if reads_rate else 0.0,
                pressure[k] if reads_pressure else 0.0,
                tempAvg[k] if reads_temperature and nTemp > 0 else 0.0,
                props,
            )

    return routine
