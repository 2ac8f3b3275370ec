# SPDX-License-Identifier: MIT
"""The stability matrix: verdicts, limits beside theory, and what it led to."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import usersub
from usersub import laws
from usersub.study import stability
from usersub.study.stability import (
    bisecting,
    bounds,
    cases,
    chapter,
    histories,
    judging,
    long_laws,
    running,
    subjects,
)
from usersub.study.stability.explicit_limits import spring_steps
from usersub.study.stability.implicit_limits import (
    critical_stiffness,
    newton_iterations,
    of_problems,
)
from usersub.study.stability.long_limits import standard_holds


def subject(law="coulomb", interface="vfric_coef", precision="double"):
    return subjects.of_law(law, interface, "c", precision)


def trace(friction, motion, *, load=1.0, of=None):
    """What came of one point, made up: shape (increments, 2)."""
    of = of or subject()
    steps = len(motion)
    history = histories.History(
        "made", ["one"], of, np.asarray(motion, float)[:, :, np.newaxis], np.full((steps, 1), load),
        np.ones(steps), np.zeros(1),
    )  # fmt: skip
    return running.Trace(history, np.asarray(friction, float)[:, :, np.newaxis])


def verdict(made):
    (cell,) = judging.judge(made)
    return cell.verdict, cell.reason


SLIDE = [(1.0, 0.0), (1.0, 0.0)]


def test_friction_up_to_its_bound_is_stable():
    assert verdict(trace([(0.3, 0.0), (0.3, 0.0)], SLIDE)) == ("stable", "")


def test_a_force_above_its_bound_fails():
    """mu p is 0.3; five units in the last place are too many, two are not."""
    above = 0.3 * (1 + 10 * 2.0**-52)
    assert verdict(trace([(0.3, 0.0), (above, 0.0)], SLIDE))[0] == "fails"
    assert verdict(trace([(0.3, 0.0), (0.3 * (1 + 2.0**-51), 0.0)], SLIDE))[0] == "stable"


def test_energy_out_of_nothing_fails():
    found, reason = verdict(trace([(-0.1, 0.0), (0.0, 0.0)], SLIDE))
    assert found == "fails" and "energy is created" in reason


def test_a_lagging_bristle_is_bounded():
    of = subject("dahl", "fric")
    made = trace([(0.3, 0.0), (0.3, 0.0)], [(1.0, 0.0), (0.0, 0.0)], of=of)
    made.history.load[1] = 0.5
    found, reason = verdict(made)
    assert found == "bounded" and "2 times" in reason
    stiff = trace([(0.3, 0.0), (0.3, 0.0)], SLIDE, of=replace(of, follows=True))
    stiff.history.load[1] = 0.5
    assert verdict(stiff)[0] == "fails"


@pytest.mark.parametrize("law", ["coulomb", "softened", "rate_state_slip"])
def test_shipped_laws_never_fail(law):
    cells = stability.matrix([law], languages=("c",), quick=True)
    assert len(cells) > 300
    assert not [cell for cell in cells if cell.verdict == "fails"]
    assert {"stable", "refused"} <= {cell.verdict for cell in cells}
    assert all(cell.reason for cell in cells if cell.verdict != "stable")


def test_drivers_never_fail():
    own = [s for s in subjects.of_drivers(("c",), ("double", "single")) if "penalty" in s.name]
    cells = [
        cell
        for one in own[::3]
        for history in (*cases.pressures(one, True), *cases.stiffness(one, True))
        for cell in judging.judge(running.run(history))
    ]
    assert cells and not [cell for cell in cells if cell.verdict == "fails"]


def test_two_runs_agree():
    asked = {"laws": ["lugre"], "languages": ("c",), "precisions": ("single",), "quick": True}
    assert stability.matrix(**asked) == stability.matrix(**asked)


@usersub.vfriction
def careless(fTangential, dSlipFric, fNormal):
    """NaN at rest, infinity for tiny slips, and no look at the stick force."""
    for k in range(fNormal.shape[0]):
        s = dSlipFric[0, k]
        fTangential[0, k] = -0.3 * fNormal[k] * s / math.sqrt(s * s)


def test_a_users_routine():
    told = []
    cells = stability.matrix(
        routine=careless, precisions=("double",), quick=True, progress=lambda *a: told.append(a)
    )
    fails = [(cell.case, cell.reason) for cell in cells if cell.verdict == "fails"]
    assert any(case == "hold" and "nan" in reason for case, reason in fails)
    assert any("more than the stick force" in reason for _, reason in fails)
    assert any("overflow before the bound" in reason for _, reason in fails)
    assert {cell.subject for cell in cells} == {"careless"}
    assert told[-1][:2] == (1, 1)


def test_bounds_are_those_of_the_equations():
    assert bounds.of("shear_limit", {"mu": 0.3, "tau_max": 20.0})(100.0) == 20.0
    assert bounds.of("cohesion", {"c": 10.0, "mu": 0.3})(100.0) == 40.0
    assert bounds.of("rate_state_ageing", {}) is None
    assert bounds.of("coulomb", {"mu": 0.3})(-1.0) == 0.0


def test_bisection():
    assert bisecting.limit(lambda x: x <= 3.0, 2.5) == pytest.approx(3.0, rel=1e-3)
    assert bisecting.limit(lambda x: True, 1.0) == math.inf
    assert bisecting.limit(lambda x: False, 1.0) == 0.0


def test_limits_are_those_of_theory():
    found = [*spring_steps(300), *critical_stiffness(quick=True)]
    assert len(found) == 12
    for one in found:
        assert one.ratio == pytest.approx(1.0, abs=0.05), one


@pytest.mark.parametrize("settings", [{"elastic_slip": 3e-10}, {"stick_slope": 1e12}])
def test_newton_ends_at_rest_after_sliding(settings):
    """The coefficient falls with the rate: slip by rounding would never come to rest."""
    assert newton_iterations("exponential_decay", (0.3, 0.2, 0.5), settings) <= 7


def test_holds_neither_creep_nor_age_wrongly():
    for one in standard_holds(200):
        if one.theory:
            assert one.measured == pytest.approx(one.theory, rel=1e-9)
        else:
            assert one.measured == 0.0


@pytest.mark.parametrize(
    "language", ["python", "c", pytest.param("fortran", marks=pytest.mark.needs_fortran)]
)
def test_an_elastic_slip_at_its_limit_sticks(language):
    """FRIC of a law: what rounding leaves above the limit is no slip in the next increment."""
    law = laws.coulomb(mu=0.3).in_language(language)
    scene = usersub.Scene(points=64, dimension=3, characteristic_length=2.0)
    driver = usersub.StandardDriver(law.behind("fric"), scene.replace(props=law.props, states=2))
    angle = np.linspace(0.1, 6.0, 64)
    way = np.asfortranarray([np.cos(angle), np.sin(angle)])
    for motion in (0.0 * way, way, 0.0 * way):
        driver.begin_increment(1.0)
        found = driver.iterate(slip_increment=np.asfortranarray(motion), pressure=np.ones(64))
        driver.commit()
    assert not found.dslip.any()
    np.testing.assert_allclose(np.hypot(*found.tau), 0.3, rtol=4e-16)
    # the tangent of sticking: full stiffness along the slip too
    along = np.einsum("ik,ijk,jk->k", way, found.ddtddg, way)
    np.testing.assert_allclose(along, 30.0, rtol=1e-12)


def test_the_chapter_has_all_tables():
    cells = stability.matrix(["dahl"], languages=("c",), precisions=("double",), quick=True)
    limits = [stability.Limit("a", "b", "fric", "c", "double", 1.9, 2.0, "-", "w")]
    text = chapter.text(cells, limits, {"machine": "a"})
    assert "@" not in text and "| dahl |" in text and "0.9500" in text and "5 %" in text


def test_uniqueness_is_told_in_words():
    """P20 says no solution or two; P21 and P22 say what is lost without the full tangent."""
    p20, p21, p22 = (one.words for one in of_problems())
    assert "no solution" in p20 and "two solutions" in p20
    assert "Without DDTDDP" in p21
    assert "the symmetric part of the tangent misses 4 of 4" in p22


def test_no_law_creeps_in_long_cycles_and_holds(monkeypatch):
    monkeypatch.setattr(long_laws, "SETTLED", 600)
    found = [*long_laws.cycles(300, 0, 1), *long_laws.holds(300, 0, 1)]
    assert {one.subject for one in found} >= set(laws.LAWS) - {"rough"}
    for one in found:
        if one.theory is not None:
            assert one.measured <= 1e-12, one
