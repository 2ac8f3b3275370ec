# SPDX-License-Identifier: MIT
"""The mutation run: its mutants are what they say, and a few of them are killed.

`make mutation` runs all, see docs/explanation/mutation.md.
"""

import tomllib

import pytest

from tests.meta import mutants, mutation, mutation_page
from tests.meta.mutants import OPERATORS
from tests.meta.mutation import KILLED, SAME, STILLBORN, SURVIVED, Fate

C = """\
/* a + b stays; props[0] stays */
#define USUB_LAW_PROPS 2 + 1
#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  const usub_real fall = props[0] - props[1];
  double sum = 0;
  for (int i = 0; i < 2; ++i)
    sum += props[i];
  if (rate < props[1])
    return -fall;
  derivative[0] = fmin(sum, fall);
  return fall;
}
"""
FORTRAN = """\
! a + b stays
    real(wp) :: mu, sum(3)
    mu = props(1) - props(2)*1e-3_wp
    do i = 1, 3
      sum(i) = mu
    end do
    if (mu < 0 .and. rate > 1) mu = min(mu, props(3))
    if (present(derivative)) derivative(1) = -mu
"""


def changes(language: str, text: str) -> set[tuple[str, str]]:
    return {(m.operator, m.after) for m in mutants.mutants("law", language, text)}


def test_mutants_of_c():
    found = changes("c", C)
    assert {
        ("sign", "const usub_real fall = props[0] + props[1];"),
        ("sign", "return fall;"),
        ("sign", "sum -= props[i];"),
        ("drop", ";"),
        ("index", "const usub_real fall = props[1] - props[1];"),
        ("off by one", "for (int i = 0; i <= 2; ++i)"),
        ("off by one", "for (int i = 1; i < 2; ++i)"),
        ("limit", "if (rate >= props[1])"),
        ("limit", "derivative[0] = fmax(sum, fall);"),
        ("float", "float sum = 0;"),
    } <= found
    assert not any("stays" in after or "define" in after for _, after in found)


def test_mutants_of_fortran():
    found = changes("fortran", FORTRAN)
    assert {
        ("sign", "mu = props(1) + props(2)*1e-3_wp"),
        ("drop", "continue"),
        ("index", "mu = props(1) - props(1)*1e-3_wp"),
        ("off by one", "do i = 2, 3"),
        ("off by one", "do i = 1, 3 - 1"),
        ("limit", "if (mu >= 0 .and. rate > 1) mu = min(mu, props(3))"),
        ("limit", "if (mu < 0 .or. rate > 1) mu = min(mu, props(3))"),
        ("limit", "if (mu < 0 .and. rate > 1) mu = max(mu, props(3))"),
        ("float", "real(4) :: mu, sum(3)"),
    } <= found
    assert not any("1e+3" in after or "stays" in after for _, after in found)


def test_every_operator_has_mutants_in_every_language():
    made = mutation.all_mutants()
    assert len({m.file for m in made}) >= 30
    for language in mutation.FILES:
        assert {m.operator for m in made if m.language == language} == set(OPERATORS)
    assert all(m.text != mutation.source(m.file, m.language) for m in made)


def test_sample_is_repeatable_and_spread():
    made = mutation.all_mutants(["coulomb", "stribeck"])
    chosen = mutation.sample(made, 1, 5)
    assert chosen == mutation.sample(made, 1, 5)
    keys = [(m.file, m.language, m.operator) for m in chosen]
    assert len(keys) == len(set(keys))
    assert sorted(m.id for m in mutation.sample(made, 0, 5)) == sorted(m.id for m in made)


def test_score_leaves_out_what_could_not_be_killed():
    some = mutants.mutants("law", "c", C)
    fates = [Fate(some[0], KILLED, "law.agrees"), Fate(some[1], SURVIVED), Fate(some[2], SAME),
             Fate(some[3], STILLBORN), Fate(some[4], KILLED, "tangent.slip")]  # fmt: skip
    assert mutation_page.score(fates) == pytest.approx(200 / 3)
    assert mutation_page.survivors(fates) == [fates[1]]
    assert "| all | both | 5 | 1 | 1 | 0 | 2 | 1 | 66.7 % |" in mutation_page.table(fates)


def test_reasons_are_those_of_mutants_that_exist():
    with (mutation.HERE / "mutation.toml").open("rb") as stream:
        reasons = tomllib.load(stream)
    made = {f"{m.language} {m.id}" for m in mutation.all_mutants()}
    assert set(reasons["equivalent"]) | set(reasons["survives"]) <= made


#: Mutants of a sample: enough to see that the machinery works.
FEW = mutation.sample(mutation.all_mutants(["shear_limit", "stribeck"], ["c"]), 1, 2)[:3]


@pytest.mark.parametrize("mutant", FEW, ids=lambda m: f"{m.file}-{m.line}-{m.operator}")
def test_a_few_mutants_are_killed(mutant):
    found = mutation.fate(mutant)
    assert found.end in (KILLED, SAME, STILLBORN), mutant.id


@pytest.mark.needs_fortran
def test_a_fortran_mutant_is_killed():
    (mutant,) = [
        m
        for m in mutation.all_mutants(["shear_limit"], ["fortran"])
        if m.operator == "sign" and m.before.endswith("-mu/pressure")
    ]
    found = mutation.fate(mutant)
    assert (found.end, found.rule) == (KILLED, "law.agrees")


def test_the_law_itself_is_the_same():
    text = mutation.source("shear_limit", "c")
    blank = mutants.Mutant("shear_limit", "c", "sign", 1, "", "", text + "/* nothing */\n")
    assert mutation.fate(blank).end == SAME
