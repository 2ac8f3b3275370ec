# SPDX-License-Identifier: MIT
"""LM and PNEWDT, with a routine that sticks by Lagrange multipliers."""

from __future__ import annotations

from tests.unit.frictions import fails, law, made, passes, refuses
from usersub.check.subject import Subject

#: Sticks until the multiplier is above the critical stress, slips until motion ends.
_LAGRANGE = """
#include <math.h>
#include <usersub/abi.h>
void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  const int n = *NFDIR;
  const double limit = *PRESS > 0 ? PROPS[0] * *PRESS : 0;
  const double pull = hypot(TAULM[0], n > 1 ? TAULM[1] : 0);
  const double way = hypot(DGAM[0], n > 1 ? DGAM[1] : 0);
  if (*LM == 2) return;
  if (*LM == 1 ? pull <= limit : way == 0) {
    *LM = 1;
    return;
  }
  const double *along = *LM == 1 ? TAULM : DGAM, size = *LM == 1 ? pull : way;
  *LM = 0;
  for (int a = 0; a < n; ++a) {
    TAU[a] = limit * along[a] / (size > 0 ? size : 1);
    DSLIP[a] = DGAM[a];
  }
}
"""


def _lagrange(c_routine, old: str = "", new: str = "") -> Subject:
    assert _LAGRANGE.count(old or "fric, FRIC") == 1
    routine = c_routine("fric", _LAGRANGE.replace(old, new) if old else _LAGRANGE)
    return Subject("lagrange", routine.interface, routine=routine, props=(0.3,))


def test_multipliers_pass(c_routine) -> None:
    subject = _lagrange(c_routine)
    passes(subject, "multiplier.protocol pnewdt.positive bound.opposes-slip slip.sign")
    passes(subject, "frame.turn frame.reversal pressure.negative friction.present")
    passes(law("rough", "fric"), "multiplier.protocol pnewdt.positive")
    passes(law("coulomb", "fric"), "multiplier.protocol pnewdt.positive")


def test_point_that_is_never_let_go_is_caught(c_routine) -> None:
    subject = _lagrange(c_routine, "*LM == 1 ? pull <= limit : way == 0", "*LM == 1 || way == 0")
    fails(subject, "multiplier.protocol", "LM stays 1 .* expected the point to be released")


def test_stress_against_the_multiplier_is_caught(c_routine) -> None:
    subject = _lagrange(c_routine, "TAU[a] = limit", "TAU[a] = -limit")
    fails(subject, "multiplier.protocol", "released in increment .* expected stress along it")


def test_taking_turns_is_caught(c_routine) -> None:
    subject = _lagrange(c_routine, "*LM == 1 ? pull <= limit : way == 0", "*LM == 0")
    fails(subject, "multiplier.protocol", "LM of increment .* goes .*; expected it to settle")


def test_unknown_state_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", "*LM = 0;", "*LM = slips ? 3 : 0;")
    fails(subject, "multiplier.protocol", "LM = 3 .*expected 0, 1 or 2")


def test_open_in_contact_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", "*LM = 0;", "*LM = hypot(DGAM[0], n > 1 ? DGAM[1] : 0) > 0 "
                   "&& TAU[0] > 0.2 * p ? 2 : 0;")  # fmt: skip
    fails(subject, "multiplier.protocol", "LM is 2 in increment .* had friction")


def test_pnewdt_is_caught(c_routine) -> None:
    for value in ("0", "-1", "NAN"):
        subject = made(c_routine, "fric", "*LM = 0;", f"*LM = 0; if (slips) *PNEWDT = {value};")
        fails(subject, "pnewdt.positive", "PNEWDT = .*; expected a value above 0")
        refuses(subject, "multiplier.protocol", "PNEWDT")
    passes(made(c_routine, "fric", "*LM = 0;", "*LM = 0; *PNEWDT = 0.5;"), "pnewdt.positive")
