# SPDX-License-Identifier: MIT
"""Small Fortran laws of every kind, and the same laws and their updates in mpmath."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import mpmath
import numpy as np
from mpmath import mpf

#: Digits of the truth, and the step of its differences.
DIGITS = 50
STEP = mpf(10) ** -20

HEAD = """\
! SPDX-License-Identifier: MIT
#define USUB_LAW '{name}'
{defines}
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
{function}
end module

#include "usersub/{kind}_law.fi"
"""

SCALAR = """\
  function law( &
#include "usersub/law_names.fi"
      ) result(answer)
#include "usersub/law_types.fi"
    real(wp) :: answer
{value}
#ifndef USUB_LAW_DIFFERENCES
    if (present(derivative)) then
{derivative}
    end if
#endif
  end function"""

PAIR = """\
  subroutine law( &
#include "usersub/law_names.fi"
      )
#include "usersub/law_types.fi"
{value}
#ifndef USUB_LAW_DIFFERENCES
    if (present(derivative)) then
{derivative}
    end if
#endif
  end subroutine"""

BRISTLE = """\
  subroutine bristle( &
#include "usersub/bristle_names.fi"
      )
#include "usersub/bristle_types.fi"
    real(wp) :: moved(2), length, bound
{value}
#ifndef USUB_LAW_DIFFERENCES
    if (present(tangent)) then
{derivative}
    end if
#endif
  end subroutine"""


@dataclass(frozen=True)
class Quantities:
    """What a point function is given, in mpmath; `state` and `vectors` of the start."""

    slip_rate: mpf = mpf(0)
    pressure: mpf = mpf(0)
    temperature: mpf = mpf(0)
    fields: tuple = ()
    slip: mpf = mpf(0)
    time_increment: mpf = mpf(0)
    state: tuple = ()
    motion: tuple = ()
    vectors: tuple = ()


@dataclass(frozen=True)
class Law:
    """A law as Fortran text and as a function of `Quantities` and properties.

    `truth` gives value (or pair), new state; of a bristle: traction, vectors, state.
    """

    name: str
    kind: str
    form: str
    defines: tuple[str, ...]
    value: str
    derivative: str
    props: tuple[float, ...]
    truth: Callable
    states: int = 0
    vectors: int = 0

    def source(self, differences: bool = False) -> str:
        """The file."""
        defines = [f"#define USUB_LAW_{d}" for d in self.defines]
        if differences:
            defines.append("#define USUB_LAW_DIFFERENCES")
        function = self.form.format(value=self.value, derivative=self.derivative)
        return HEAD.format(
            name=self.name, kind=self.kind, defines="\n".join(defines), function=function
        )


EVERYTHING = ("RATE", "PRESSURE", "TEMPERATURE", "FIELDS", "SLIP", "TIME")
READS_ALL = tuple(f"READS_{name}" for name in EVERYTHING)


def _coefficient(q, p):
    worn = q.state[0] + q.slip * (1 + q.fields[1])
    decay = p[0] * mpmath.exp(-p[1] * q.slip_rate)
    worn_part = p[2] / (1 + worn / p[3])
    rest = q.pressure * p[4] + q.temperature * p[5] * q.fields[0]
    return decay + worn_part + rest + q.time_increment / 64, (worn, q.pressure)


#: Reads everything; two state variables, of which the second only remembers.
COEFFICIENT = Law(
    "worn", "coefficient", SCALAR, ("PROPS 6", "STATES 2", *READS_ALL),
    """\
    state(1) = state(1) + slip*(1 + fields(2))
    state(2) = pressure
    answer = props(1)*bounded_exp(-props(2)*rate) + props(3)/(1 + state(1)/props(4)) &
        + pressure*props(5) + temperature*props(6)*fields(1) + time_increment/64""",
    """\
      derivative(1) = -props(2)*props(1)*bounded_exp(-props(2)*rate)
      derivative(2) = props(5)
      derivative(3) = props(6)*fields(1)
      derivative(4) = -props(3)/props(4)/(1 + state(1)/props(4))**2*(1 + fields(2))""",
    (0.21, 0.75, 0.13, 0.011, 1.5e-4, 3e-4), _coefficient, states=2,
)  # fmt: skip


def _plain(q, p):
    return p[0] + p[1] * q.slip_rate / (p[2] + q.slip_rate) + q.slip * q.fields[0], ()


#: No state: behind VFRIC_COEF too.
STATELESS = Law(
    "plain", "coefficient", SCALAR, ("PROPS 3", "READS_RATE", "READS_SLIP", "READS_FIELDS"),
    "    answer = props(1) + props(2)*rate/(props(3) + rate) + slip*fields(1)",
    """\
      derivative(1) = props(2)*props(3)/(props(3) + rate)**2
      derivative(4) = fields(1)""",
    (0.12, 0.19, 0.6), _plain,
)  # fmt: skip


def _strength(q, p):
    worn = q.state[0] + q.slip
    cohesion = p[0] * mpmath.exp(-worn / p[1])
    return (cohesion + p[2] * q.pressure) * (1 + p[3] * mpmath.log(1 + q.slip_rate)), (worn,)


STRENGTH = Law(
    "cohesive", "strength", SCALAR,
    ("PROPS 4", "STATES 1", "READS_RATE", "READS_PRESSURE", "READS_SLIP"),
    """\
    state(1) = state(1) + slip
    answer = (props(1)*bounded_exp(-state(1)/props(2)) + props(3)*pressure) &
        *(1 + props(4)*log(1 + rate))""",
    """\
      derivative(1) = answer*props(4)/(1 + props(4)*log(1 + rate))/(1 + rate)
      derivative(2) = props(3)*(1 + props(4)*log(1 + rate))
      derivative(4) = -props(1)/props(2)*bounded_exp(-state(1)/props(2)) &
          *(1 + props(4)*log(1 + rate))""",
    (3.5, 0.021, 0.31, 0.085), _strength, states=1,
)  # fmt: skip


def _traction(q, p):
    grown = q.state[0] + q.slip * p[2]
    factor = 1 + q.temperature / 256 + grown
    return p[0] * q.slip_rate / (p[1] + q.slip_rate) * factor + q.pressure * q.slip_rate / 64, (
        grown,
    )


TRACTION = Law(
    "viscous", "traction", SCALAR,
    ("PROPS 3", "STATES 1", "READS_RATE", "READS_PRESSURE", "READS_TEMPERATURE", "READS_SLIP"),
    """\
    state(1) = state(1) + slip*props(3)
    answer = props(1)*rate/(props(2) + rate)*(1 + temperature/256 + state(1)) + pressure*rate/64""",
    """\
      derivative(1) = props(1)*props(2)/(props(2) + rate)**2*(1 + temperature/256 + state(1)) &
          + pressure/64
      derivative(2) = rate/64
      derivative(3) = props(1)*rate/(props(2) + rate)/256
      derivative(4) = props(1)*rate/(props(2) + rate)*props(3)""",
    (4.5, 0.35, 7.0), _traction, states=1,
)  # fmt: skip


def _anisotropic(q, p):
    worn = q.state[0] + q.slip
    first = p[0] * (1 + mpmath.exp(-p[2] * q.slip_rate)) + q.temperature * p[4]
    return (first, p[1] / (1 + p[3] * worn) + q.pressure * p[5]), (worn,)


ANISOTROPIC = Law(
    "planks", "coefficient", PAIR,
    ("PROPS 6", "STATES 1", "ANISOTROPIC", "READS_RATE", "READS_PRESSURE", "READS_TEMPERATURE",
     "READS_SLIP"),
    """\
    state(1) = state(1) + slip
    mu(1) = props(1)*(1 + bounded_exp(-props(3)*rate)) + temperature*props(5)
    mu(2) = props(2)/(1 + props(4)*state(1)) + pressure*props(6)""",
    """\
      derivative(1, 1) = -props(1)*props(3)*bounded_exp(-props(3)*rate)
      derivative(3, 1) = props(5)
      derivative(2, 2) = props(6)
      derivative(4, 2) = -props(2)*props(4)/(1 + props(4)*state(1))**2""",
    (0.11, 0.55, 1.7, 21.0, 2e-4, 3e-3), _anisotropic, states=1,
)  # fmt: skip


def _bristle(q, p):
    old = q.vectors[0]
    moved = [old[a] + q.motion[a] for a in range(2)]
    bound = p[1] + p[2] * q.pressure + q.temperature / 512
    length = mpmath.sqrt(moved[0] ** 2 + moved[1] ** 2 + mpf(1) / 2**40)
    end = tuple(m * mpmath.tanh(length / bound) * bound / length for m in moved)
    rate = [m / q.time_increment for m in q.motion]
    traction = tuple(p[0] * end[a] + p[3] * rate[a] * q.fields[0] for a in range(2))
    seconds = tuple(q.vectors[1][a] + 2 * q.motion[a] for a in range(2))
    return traction, (end, seconds), (q.state[0] + length,)


#: A saturating spring with dashpot; a second vector and a scalar that only remember.
SPRING = Law(
    "spring", "bristle", BRISTLE,
    ("PROPS 4", "VECTORS 2", "STATES 1", "READS_PRESSURE", "READS_TEMPERATURE", "READS_FIELDS",
     "READS_TIME"),
    """\
    moved = vectors(:, 1) + motion
    bound = props(2) + props(3)*pressure + temperature/512
    length = sqrt(moved(1)**2 + moved(2)**2 + 2.0_wp**(-40))
    vectors(:, 1) = moved*tanh(length/bound)*bound/length
    vectors(:, 2) = vectors(:, 2) + 2*motion
    state(1) = state(1) + length
    traction = props(1)*vectors(:, 1) + props(4)*motion/time_increment*fields(1)""",
    """\
      associate (t => tanh(length/bound), n => moved/length)
        tangent(1, 1) = props(1)*(t*bound/length + n(1)*n(1)*(1 - t*t - t*bound/length))
        tangent(1, 2) = props(1)*n(1)*n(2)*(1 - t*t - t*bound/length)
        tangent(2, 1) = tangent(1, 2)
        tangent(2, 2) = props(1)*(t*bound/length + n(2)*n(2)*(1 - t*t - t*bound/length))
        tangent(1, 1) = tangent(1, 1) + props(4)*fields(1)/time_increment
        tangent(2, 2) = tangent(2, 2) + props(4)*fields(1)/time_increment
        tangent(:, 3) = props(1)*n*(t - (1 - t*t)*length/bound)*props(3)
        tangent(:, 4) = props(1)*n*(t - (1 - t*t)*length/bound)/512
      end associate""",
    (40.0, 0.05, 0.003, 0.7), _bristle, states=1, vectors=2,
)  # fmt: skip

LAWS = {law.name: law for law in (COEFFICIENT, STATELESS, STRENGTH, TRACTION, ANISOTROPIC, SPRING)}


@dataclass(frozen=True)
class Increment:
    """An increment of a FRIC scene: floats."""

    motion: tuple[float, ...]
    pressure: float
    temperatures: tuple[float, float]
    fields: tuple[float, ...]
    dt: float
    state: tuple[float, ...]
    allowable: float


def fric(law: Law, now: Increment):
    """Stress, slip, end of state variables of an increment behind FRIC, in mpmath."""
    return _updated(law, now, [mpf(m) for m in now.motion], mpf(now.pressure), _mean(now))


def fric_tangents(law: Law, now: Increment):
    """DDTDDG, DDTDDP, DDTDDT by differences of the update in mpmath."""
    n = len(now.motion)

    def stress(step, which):
        motion = [mpf(m) + step * (which == a) for a, m in enumerate(now.motion)]
        pressure = mpf(now.pressure) + step * (which == "p")
        return _updated(law, now, motion, pressure, _mean(now) + step * (which == "t"))[0]

    def slope(which):
        up, down = stress(STEP, which), stress(-STEP, which)
        return [float((u - d) / (2 * STEP)) for u, d in zip(up, down, strict=True)]

    by_temperature = slope("t")
    return (
        np.array([slope(b) for b in range(n)]).T,
        np.array(slope("p")),
        np.array([[0.5 * t] * 2 for t in by_temperature]),
    )


def _mean(now: Increment):
    return (mpf(now.temperatures[0]) + mpf(now.temperatures[1])) / 2


def _updated(law, now, motion, pressure, temperature):
    n, p = len(motion), [mpf(v) for v in law.props]
    given = {
        "pressure": pressure, "temperature": temperature, "fields": tuple(map(mpf, now.fields)),
        "time_increment": mpf(now.dt),
    }  # fmt: skip
    state = [mpf(s) for s in now.state]
    if law.kind == "bristle":
        vectors = tuple(_two(state[n * v : n * v + n]) for v in range(law.vectors))
        q = Quantities(
            **given, motion=_two(motion), vectors=vectors, state=tuple(state[n * law.vectors :])
        )
        traction, vectors, scalars = law.truth(q, p)
        return traction[:n], motion, [c for v in vectors for c in v[:n]] + list(scalars)
    if law.kind == "traction":
        length = mpmath.norm(motion)
        q = Quantities(**given, slip=length, slip_rate=length / now.dt, state=tuple(state))
        value, end = law.truth(q, p)
        return [value * m / length if length else mpf(0) for m in motion], motion, list(end)

    def ask(plastic):
        length = mpmath.norm(plastic)
        rate = length / now.dt if now.dt else mpf(0)
        return law.truth(
            Quantities(**given, slip=length, slip_rate=rate, state=tuple(state[n:])), p
        )

    g = [state[a] + motion[a] for a in range(n)]
    c = mpf(now.allowable)
    if "ANISOTROPIC" not in law.defines or n == 1:
        excess = max(mpmath.norm(g) - c, 0)
        value, end = ask([v * excess / (c + excess) for v in g])
        value = value[0] if isinstance(value, tuple) else value
        strength = value if law.kind == "strength" else value * pressure
        a = [mpf(1)] * n
    else:

        def scaled(excess):
            (first, second), end = ask([v * excess / (c + excess) for v in g])
            mean = (first + second) / 2
            return [first / mean, second / mean], mean, end

        def miss(excess):
            a = scaled(excess)[0]
            return mpmath.hypot(a[0] * g[0], a[1] * g[1]) - c - excess

        excess = mpf(0)
        if miss(excess) > 0:
            excess = mpmath.findroot(miss, (mpf(0), 2 * max(map(abs, g))), solver="anderson")
        a, mean, end = scaled(excess)
        strength = mean * pressure
    size = c + excess
    tau = [strength * a[i] ** 2 * g[i] / size for i in range(n)]
    elastic = [v * c / size for v in g]
    return tau, [v - e for v, e in zip(g, elastic, strict=True)], elastic + list(end)


def _two(values):
    return tuple(values) + (mpf(0),) * (2 - len(values))
