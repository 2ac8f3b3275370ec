# SPDX-License-Identifier: MIT
"""Routines with a fault planted: the stability matrix has to say "fails" for each kind."""

from __future__ import annotations

import math
import os

import pytest

import usersub
from usersub.study import stability
from usersub.study.stability import cases, judging, parts, running, subjects
from usersub.study.stability.cell import Cell

ASKED = (("coulomb",), ("c",), ("double",), None, True)


def cells(subject, *made):
    """Cells of some cases of a subject, run through its driver."""
    return [
        cell
        for make in made
        for history in make(subject, True)
        for cell in judging.judge(running.run(history))
    ]


def instead(routine, interface, precision="double"):
    """Coulomb friction as a subject, with another routine in its place."""
    return subjects.of_law("coulomb", interface, "c", precision).but(make=lambda: routine)


def fails(found):
    return [cell.reason for cell in found if cell.verdict == "fails"]


@usersub.vfriction
def no_number_for_fast_slip(fTangential, dSlipFric, fNormal):
    for k in range(fNormal.shape[0]):
        fTangential[0, k] = -0.3 * fNormal[k] if dSlipFric[0, k] < 1e100 else math.nan


@usersub.fric_coef
def no_number_at_high_pressure(fCoef, pressure):
    for k in range(pressure.shape[0]):
        fCoef[0, k] = 0.3 if pressure[k] < 1e200 else math.nan


@usersub.fric_coef
def infinite_at_high_pressure(fCoef, pressure):
    for k in range(pressure.shape[0]):
        fCoef[0, k] = 0.3 if pressure[k] < 1e200 else math.inf


@usersub.fric
def no_number_in_the_tangent(LM, TAU, DDTDDG, DDTDDP, PRESS, DGAM):
    LM[0] = 0
    for a in range(2):
        TAU[a] = 0.0
        DDTDDG[a, a] = math.nan if DGAM[0] == 0.0 else 1.0


@pytest.mark.parametrize(
    ("routine", "interface"),
    [
        (no_number_for_fast_slip, "vfriction"),
        (no_number_at_high_pressure, "fric_coef"),
        (no_number_in_the_tangent, "fric"),
    ],
)
def test_no_number_fails(routine, interface):
    found = cells(instead(routine, interface), cases.slips, cases.pressures)
    assert any("NaN from finite input" in reason for reason in fails(found))


def test_an_infinite_coefficient_of_a_bounded_law_fails():
    found = cells(instead(infinite_at_high_pressure, "fric_coef"), cases.pressures)
    assert any("overflow before the bound" in reason for reason in fails(found))


@pytest.mark.parametrize("precision", ["double", "single"])
def test_eight_units_in_the_last_place_fail(precision):
    """Two are rounding; in denormal numbers a unit is all of the number."""

    def made(ulps):
        eps = 2.0**-52 if precision == "double" else 2.0**-23
        factor = 1.0 + ulps * eps

        @usersub.vfriction
        def too_much(fTangential, dSlipFric, fNormal, fStickForce, props):
            for k in range(fNormal.shape[0]):
                force = min(props[0] * fNormal[k], fStickForce[k])
                fTangential[0, k] = -force * factor if dSlipFric[0, k] > 0 else 0.0

        return instead(too_much, "vfriction", precision)

    found = cells(made(8), cases.slips)
    assert fails(found) and all("more than the" in reason for reason in fails(found))
    assert not fails(cells(made(2), cases.slips))


@usersub.vfriction
def pushes_after_a_while(fTangential, dSlipFric, fNormal, fStickForce, state):
    """Brakes as it should for half of the increments; then it drives, within its bound."""
    for k in range(fNormal.shape[0]):
        state[0, 0, k] += 1.0
        force = min(0.3 * fNormal[k], fStickForce[k]) if dSlipFric[0, k] > 0 else 0.0
        fTangential[0, k] = -force if state[0, 0, k] < 50.0 else 0.1 * force


@usersub.vfriction
def pushes(fTangential, dSlipFric, fNormal, fStickForce):
    for k in range(fNormal.shape[0]):
        force = min(0.3 * fNormal[k], fStickForce[k])
        fTangential[0, k] = 1e-9 * force if dSlipFric[0, k] > 0 else 0.0


@pytest.mark.parametrize(("routine", "states"), [(pushes, 0), (pushes_after_a_while, 1)])
def test_energy_out_of_nothing_fails(routine, states):
    """A billionth of the strength is enough; and what was dissipated before is no excuse."""
    subject = instead(routine, "vfriction").but(states=states)
    found = fails(cells(subject, cases.reversals))
    assert found and all("energy is created" in reason for reason in found)


@usersub.vfriction
def endless(fTangential, dSlipFric, fNormal):
    for k in range(fNormal.shape[0]):
        x = 1.0
        while dSlipFric[0, k] > 1e100 and x > 0.0:
            x = x + 1.0 if x < 1e9 else 1.0
        fTangential[0, k] = 0.0


CRASHES = """#include <usersub/abi.h>
void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  for (int k = 0; k < *nBlock; ++k) {
    if (dSlipFric[k * *nDir] > 1e100)
      *(volatile int *)8 = 1;
    fTangential[k * *nFricDir] = 0;
  }
}
"""


def test_an_endless_loop_fails(monkeypatch):
    monkeypatch.setattr(running, "_TIME_LIMIT", 0.3)
    (subject,) = subjects.of_routine(endless, precisions=("double",))
    assert any("did not return" in reason for reason in fails(cells(subject, cases.slips)))


def test_a_crash_fails(tmp_path):
    file = tmp_path / "crashes.c"
    file.write_text(CRASHES)
    (subject,) = subjects.of_routine(usersub.load(file).only(), precisions=("double",))
    assert any("memory fault" in reason for reason in fails(cells(subject, cases.slips)))


# Several processes.


def dies(asked, number):
    """Work of which one part ends its process."""
    if number == 1:
        os._exit(3)
    return [Cell("a", str(number), "s", "fric", "c", "double", "stable")]


def test_a_process_that_dies_fails_and_the_others_go_on():
    found = dict(parts.in_processes(ASKED, range(4), 2, dies))
    assert sorted(found) == [0, 1, 2, 3]
    assert [found[n][0].verdict for n in range(4)] == ["stable", "fails", "stable", "stable"]
    assert found[1][0].reason == "the process died"


def test_finished_parts_are_not_run_again(tmp_path):
    asked = {"laws": ["coulomb"], "languages": ("c",), "precisions": ("double",), "quick": True}
    keep, told = tmp_path / "kept" / "cells.jsonl", []
    first = stability.matrix(**asked, keep=keep)
    lines = keep.read_text().splitlines()
    keep.write_text("\n".join([*lines[:3], lines[3][:40]]))  # ended while it wrote
    assert stability.matrix(**asked, keep=keep, progress=lambda *a: told.append(a)) == first
    assert [done for done, _, _ in told] == [3, 4, 5]
    keep.write_text("\n".join([lines[0].replace("c", "d", 1), *lines[1:]]))  # of other sources
    told.clear()
    assert stability.matrix(**asked, keep=keep, progress=lambda *a: told.append(a)) == first
    assert len(told) == 5


def test_several_processes_give_the_same_cells():
    asked = {"laws": ["softened"], "languages": ("c",), "quick": True}
    assert stability.matrix(**asked, jobs=2) == stability.matrix(**asked)
