# SPDX-License-Identifier: MIT
"""Small C laws of every kind; the same laws as `fortran_laws`, which has them in mpmath."""

from __future__ import annotations

from dataclasses import dataclass

from tests.unit import fortran_laws as model

FILE = """\
/* SPDX-License-Identifier: MIT */
#define USUB_LAW "{name}"
{defines}
#include <usersub/{kind}_law.h>

{opening} {{
{value}
{derivative}
{end}
}}
"""


@dataclass(frozen=True)
class Source:
    """Texts of a law in C; `law` is what it has to do."""

    law: model.Law
    value: str
    derivative: str
    end: str = ""

    def text(self, dual: bool = False) -> str:
        """The file, with derivatives of its own or by duals."""
        law = self.law
        defines = [f"#define USUB_LAW_{d}" for d in law.defines]
        derivative = "  (void)0;"
        if dual:
            defines.append("#define USUB_LAW_DUAL")
        else:
            name = "tangent" if law.kind == "bristle" else "derivative"
            derivative = f"  if ({name}) {{\n{self.derivative}\n  }}"
        opening = "USUB_BRISTLE_FUNCTION" if law.kind == "bristle" else "USUB_LAW_FUNCTION"
        return FILE.format(
            name=law.name, defines="\n".join(defines), kind=law.kind, opening=opening,
            value=self.value, derivative=derivative, end=self.end,
        )  # fmt: skip


WORN = Source(
    model.COEFFICIENT,
    """\
  const usub_value decay = props[0] * usub_bounded_exp(-props[1] * rate);
  state[0] += slip * (1 + fields[1]);
  state[1] = pressure;
  const usub_value worn = 1 + state[0] / props[3];""",
    """\
    derivative[0] = -props[1] * decay;
    derivative[1] = props[4];
    derivative[2] = props[5] * fields[0];
    derivative[3] = -props[2] / props[3] / (worn * worn) * (1 + fields[1]);""",
    """\
  return decay + props[2] / worn + pressure * props[4] + temperature * props[5] * fields[0] +
         time_increment / 64;""",
)

PLAIN = Source(
    model.STATELESS,
    "",
    """\
    derivative[0] = props[1] * props[2] / ((props[2] + rate) * (props[2] + rate));
    derivative[3] = fields[0];""",
    "  return props[0] + props[1] * rate / (props[2] + rate) + slip * fields[0];",
)

COHESIVE = Source(
    model.STRENGTH,
    """\
  state[0] += slip;
  const usub_value cohesion = props[0] * usub_bounded_exp(-state[0] / props[1]);
  const usub_value factor = 1 + props[3] * log(1 + rate);""",
    """\
    derivative[0] = (cohesion + props[2] * pressure) * props[3] / (1 + rate);
    derivative[1] = props[2] * factor;
    derivative[3] = -cohesion / props[1] * factor;""",
    "  return (cohesion + props[2] * pressure) * factor;",
)

VISCOUS = Source(
    model.TRACTION,
    """\
  state[0] += slip * props[2];
  const usub_value factor = 1 + temperature / 256 + state[0];
  const usub_value share = props[0] * rate / (props[1] + rate);""",
    """\
    const usub_real to = props[1] + rate;
    derivative[0] = props[0] * props[1] / (to * to) * factor + pressure / 64;
    derivative[1] = rate / 64;
    derivative[2] = share / 256;
    derivative[3] = share * props[2];""",
    "  return share * factor + pressure * rate / 64;",
)

PLANKS = Source(
    model.ANISOTROPIC,
    """\
  const usub_value decay = usub_bounded_exp(-props[2] * rate);
  state[0] += slip;
  const usub_value worn = 1 + props[3] * state[0];
  mu[0] = props[0] * (1 + decay) + temperature * props[4];
  mu[1] = props[1] / worn + pressure * props[5];""",
    """\
    derivative[0][0] = -props[0] * props[2] * decay;
    derivative[0][2] = props[4];
    derivative[1][1] = props[5];
    derivative[1][3] = -props[1] * props[3] / (worn * worn);""",
)

SPRING = Source(
    model.SPRING,
    """\
  const usub_value moved[2] = {vectors[0][0] + motion[0], vectors[0][1] + motion[1]};
  const usub_value bound = props[1] + props[2] * pressure + temperature / 512;
  const usub_value length =
      sqrt(moved[0] * moved[0] + moved[1] * moved[1] + (usub_real)9.094947017729282e-13);
  const usub_value t = tanh(length / bound);
  state[0] += length;
  for (int a = 0; a < 2; ++a) {
    vectors[0][a] = moved[a] * t * bound / length;
    vectors[1][a] += 2 * motion[a];
    traction[a] = props[0] * vectors[0][a] + props[3] * motion[a] / time_increment * fields[0];
  }""",
    """\
    const usub_real along = 1 - t * t, secant = t * bound / length;
    const usub_real by_bound = t - along * length / bound;
    const usub_real n[2] = {moved[0] / length, moved[1] / length};
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b)
        tangent[a][b] = props[0] * n[a] * n[b] * (along - secant);
      tangent[a][a] += props[0] * secant + props[3] * fields[0] / time_increment;
      tangent[a][2] = props[0] * n[a] * by_bound * props[2];
      tangent[a][3] = props[0] * n[a] * by_bound / 512;
    }""",
)


def _capped(q, p):
    friction = p[0] + p[1] * q.slip_rate
    return (p[2] / q.pressure if p[2] < friction * q.pressure else friction), ()


#: A coefficient with a limit of the shear stress.
CAPPED = Source(
    model.Law(
        "capped", "coefficient", "", ("PROPS 3", "READS_RATE", "READS_PRESSURE"), "", "",
        (0.3, 0.02, 16.0), _capped,
    ),
    """\
  const usub_value friction = props[0] + props[1] * rate;
  const usub_value cap = props[2] / pressure;""",
    """\
    derivative[0] = friction <= cap ? props[1] : 0;
    derivative[1] = friction <= cap ? 0 : -cap / pressure;""",
    "  return fmin(friction, cap);",
)  # fmt: skip

SOURCES = {s.law.name: s for s in (WORN, PLAIN, COHESIVE, VISCOUS, PLANKS, SPRING, CAPPED)}
