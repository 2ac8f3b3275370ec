# SPDX-License-Identifier: MIT
"""Whole routines in C, in which one expression at a time can be made wrong, as subjects.

FRIC: Coulomb friction with a constant stiffness of stick and a coefficient that depends on pressure
and temperature; VFRICTION and FRIC_COEF: a coefficient that falls with the slip rate.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

import pytest

from usersub.check.rule import RULES, CannotCheck, Finding, NotApplicable
from usersub.check.rules import all_rules
from usersub.check.subject import Subject

FRIC = """
#include <math.h>
#include <usersub/abi.h>
void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  const int n = *NFDIR;
  const double p = *PRESS > 0 ? *PRESS : 0, heat = 0.5 * (TEMP[0] + TEMP[1]);
  const double weak = 1 - 1e-3 * heat;
  const double mu = PROPS[0] * weak * (1 + 0.1 * p), k = PROPS[1];
  const double limit = mu * p;
  double trial[2] = {0, 0};
  if (*LM == 2) return;
  for (int a = 0; a < n; ++a) trial[a] = TAU[a] + k * DGAM[a];
  const double size = hypot(trial[0], trial[1]);
  const int slips = size > limit;
  const double part = slips ? limit / size : 1;
  *LM = 0;
  *SED = *SFD = 0;
  for (int a = 0; a < n; ++a) {
    const double along = slips ? trial[a] / size : 0;
    for (int b = 0; b < n; ++b) {
      const double other = slips ? trial[b] / size : 0;
      DDTDDG[a + n * b] = k * part * ((a == b) - along * other);
    }
    DDTDDP[a] = *PRESS < 0 ? 0 : (mu + p * PROPS[0] * weak * 0.1) * along;
    DDTDDT[a] = -0.5 * p * PROPS[0] * 1e-3 * (1 + 0.1 * p) * along;
    DDTDDT[a + n] = DDTDDT[a];
    TAU[a] = part * trial[a];
    DSLIP[a] = (1 - part) * trial[a] / k;
    *SED += 0.5 * TAU[a] * TAU[a] / k;
    *SFD += TAU[a] * DSLIP[a];
  }
}
"""

VFRICTION = """
#include <math.h>
#include <usersub/abi.h>
void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  const double dt = rData[2];
  for (int k = 0; k < *nBlock; ++k) {
    if (!(fNormal[k] > 0)) continue;
    const double slip = fabs(dSlipFric[3 * k]), rate = dt > 0 ? slip / dt : 0;
    const double pressure = areaCont[k] > 0 ? fNormal[k] / areaCont[k] : 0;
    const double mu = props[0] + 0 * pressure + (props[1] - props[0]) * (1 - exp(-rate));
    double force = mu * fNormal[k];
    if (force > fStickForce[k]) force = fStickForce[k];
    fTangential[2 * k] = (usub_real)-force;
  }
}
"""

FRIC_COEF = """
#include <math.h>
#include <usersub/abi.h>
void FOR_NAME(fric_coef, FRIC_COEF)(USUB_FRIC_COEF_2022_PARAMETERS) {
  const double rate = slipData[0], part = exp(-rate), p = pressure[0];
  fCoef[0] = (props[1] + (props[0] - props[1]) * part) * (1 + 0.1 * p) - 1e-4 * tempAvg[0];
  fCoefDeriv[0] = -(props[0] - props[1]) * part * (1 + 0.1 * p);
  fCoefDeriv[1] = 0.1 * (props[1] + (props[0] - props[1]) * part);
  fCoefDeriv[2] = -1e-4;
}
"""

SOURCES = {
    "fric": (FRIC, (0.3, 100.0)),
    "vfriction": (VFRICTION, (0.3, 0.2)),
    "fric_coef": (FRIC_COEF, (0.3, 0.2)),
}
GENERATION = {"fric_coef": "2022"}


def made(c_routine: Callable, interface: str, old: str = "", new: str = "") -> Subject:
    """The routine with `old` replaced by `new`, which has to be in it exactly once."""
    source, props = SOURCES[interface]
    if old:
        assert source.count(old) == 1, f"{source.count(old)} times in the source: {old}"
        source = source.replace(old, new)
    routine = c_routine(interface, source, generation=GENERATION.get(interface))
    return Subject(interface, routine.interface, routine=routine, props=props)


def found(subject: Subject, name: str) -> Finding | None:
    """The first finding of a rule."""
    all_rules()
    rule = RULES[name]
    assert subject.interface.name in rule.interfaces
    return next(iter(rule.look(subject) or ()), None)


def fails(subject: Subject, name: str, words: str) -> Finding:
    """The rule has to fail with words like these, a hint, and a case that shows it by itself."""
    finding = found(subject, name)
    assert finding is not None, f"{name} says nothing"
    assert re.search(words, finding.detail), finding.detail
    assert finding.hint
    judge = RULES[name].judge
    assert judge is not None and finding.case is not None
    assert judge(subject, finding.case) is not None
    return finding


def passes(subject: Subject, names: str) -> None:
    """Rules, apart by blanks, have to say nothing."""
    for name in names.split():
        finding = found(subject, name)
        assert finding is None, f"{name}: {finding}"


def refuses(subject: Subject, name: str, words: str) -> None:
    """The rule has to say why it does not apply."""
    with pytest.raises((NotApplicable, CannotCheck), match=words):
        found(subject, name)


def law(name: str, interface: str, **props: object) -> Subject:
    """A shipped law with its example properties."""
    from usersub import laws

    one = laws.LAWS[name]
    thing = one(**{**one.example, **props})
    routine = thing.behind(interface, "c")
    return Subject(
        name,
        routine.interface,
        routine=routine,
        props=thing.props,
        states=thing.states(interface),
        anisotropic=one.anisotropic and interface == "fric_coef",
    )


def groups(*prefixes: str) -> Iterator[str]:
    """Identifiers of all rules of some groups."""
    return (name for name in all_rules() if name.partition(".")[0] in prefixes)
