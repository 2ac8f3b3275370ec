# SPDX-License-Identifier: MIT
"""Rules about the ends of the range and NaN, and the raw calls that they make."""

from __future__ import annotations

import math

import numpy as np
import pytest
from check_routines import BODY_C, PROPS, found, in_c, in_fortran, subject, written

from usersub import abi
from usersub.check.probing.raw import RawCall, point_axis
from usersub.check.rules.extremes import beyond, unusual
from usersub.check.subject import Subject

pytestmark = pytest.mark.usefixtures("fortran")


@pytest.mark.parametrize("rule", ["extremes.finite", "extremes.far", "extremes.not-a-number"])
@pytest.mark.parametrize("precision", ["double", "single"])
def test_whole_routines_pass(tmp_path, rule, precision):
    assert found(rule, subject(in_fortran(tmp_path), precision=precision)) == []


def test_cases_reach_from_denormal_to_huge(tmp_path):
    about = subject(in_c(tmp_path))
    cases = [*unusual(about), *beyond(about)]
    motions = {abs(c) for case in cases for s in case.steps for m in s.motion for c in m if c}
    loads = {p for case in cases for s in case.steps for p in s.load}
    assert max(motions) > 1e299
    assert min(motions) < 1e-320
    assert max(loads) > 1e299
    assert min(loads) < 1e-320


def test_infinity_over_infinity(tmp_path):
    # The square of the rate overflows above 1e154; the limit is props[1].
    body = "double s = slipRate[k] * slipRate[k]; fCoef[k] = (props[0] + props[1] * s) / (1 + s);"
    (finding,) = found("extremes.far", subject(in_c(tmp_path, body)))
    assert "fCoef = nan" in finding.detail
    assert finding.case is not None


def test_an_overflow_on_the_way_to_a_finite_answer(tmp_path):
    # Constant for all rates but for rounding: 1e-150 v^2 / sqrt(1e-300 v^4 + 1) is 1 above 1e75.
    body = (
        "double s = slipRate[k] * slipRate[k]; "
        "fCoef[k] = slipRate[k] > 1 ? props[0] * 1e-150 * s / (1e-150 * slipRate[k]) "
        "/ slipRate[k] : props[0];"
    )
    (finding,) = found("extremes.far", subject(in_c(tmp_path, body)))
    assert "fCoef = inf" in finding.detail
    assert "smaller inputs" in finding.detail


def test_an_overflow_of_the_law_itself_is_no_fault(tmp_path):
    body = "fCoef[k] = props[0] + 1e-3 * slipRate[k] * slipRate[k];"
    assert found("extremes.far", subject(in_c(tmp_path, body))) == []


def test_zero_over_zero_for_tiny_motions(tmp_path):
    body = (
        "double s = sqrt(slipRate[k] * slipRate[k]); "
        "fCoef[k] = slipRate[k] > 0 ? props[0] * slipRate[k] / s * (s > 0) : props[0];"
    )
    (finding,) = found("extremes.far", subject(in_c(tmp_path, body)))
    assert finding.case is not None


def test_what_diverging_analyses_pass_is_an_error(tmp_path):
    # The fourth power of the rate overflows in single precision above 1e9.
    body = (
        "float s = slipRate[k]; s = s * s * s * s; fCoef[k] = (props[0] + props[1] * s) / (1 + s);"
    )
    (finding,) = found("extremes.finite", subject(in_c(tmp_path, body)))
    assert "fCoef = nan" in finding.detail


def test_nan_that_spreads_to_the_next_point(tmp_path):
    body = "sum += 0 * slipRate[k]; " + BODY_C + " fCoef[k] += sum;"
    (finding,) = found(
        "extremes.not-a-number", subject(in_c(tmp_path, body, first="double sum = 0;"))
    )
    assert finding.detail.startswith("NaN in slipRate of point 2 changes fCoef of point 3 from")


def test_nan_answered_by_another_point(tmp_path):
    body = "if (slipRate[k] == slipRate[k]) v = slipRate[k]; " + BODY_C.replace("slipRate[k]", "v")
    (finding,) = found(
        "extremes.not-a-number", subject(in_c(tmp_path, body, first="double v = 0;"))
    )
    assert "it is the answer of another point" in finding.detail


def test_nan_that_becomes_an_index(tmp_path):
    body = "fCoef[k] = table[(int)slipRate[k]];"  # NaN becomes the lowest integer
    above = "static const double table[2] = {0.3, 0.2};"
    (finding,) = found("extremes.not-a-number", subject(in_c(tmp_path, body, above=above)))
    assert "crashes (SIGSEGV) if slipRate is NaN" in finding.detail


# Raw calls.


@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda face: face.key)
@pytest.mark.parametrize("contact", ["node-to-facet", "edge-to-edge", "analytical-rigid"])
@pytest.mark.parametrize("dimension", [2, 3])
def test_shapes_are_those_of_the_table(face, contact, dimension):
    from usersub.routine.routine import FULL, Entry

    about = Subject("law", face, props=PROPS, states=2, fields=3)
    call = RawCall(about, 4 if face.name != "fric" else 1, dimension, contact, Entry(1, FULL))
    sizes = {
        a.name.lower(): int(call[a.name]) for a in face.args if a.kind == "int" and not a.shape
    }
    for argument in face.args:
        if argument.kind == "char":
            assert bytes(call[argument.name]) == b" " * 80
            continue
        shape = call[argument.name].shape
        known = [int(s) if s.isdigit() else sizes.get(s.lower()) for s in argument.shape]
        assert len(shape) == len(known)
        assert all(k in (None, s) for k, s in zip(known, shape, strict=True)), argument.name
        assert np.isfinite(call[argument.name]).all()


def test_a_point_is_its_own_part(tmp_path):
    call = RawCall(subject(in_c(tmp_path)), 3)
    assert call.run_apart().how == "returned"
    slow = call["fCoef"].copy()
    call.restore()
    call.point(1)["slipRate"][...] *= 2
    assert call.run() == 0
    assert (call["fCoef"] != slow).tolist() == [False, True, False]
    rate = 0.05 / 0.25
    expected = PROPS[1] + (PROPS[0] - PROPS[1]) * math.exp(-PROPS[2] * rate)
    assert slow == pytest.approx([expected] * 3, rel=1e-15)


@pytest.mark.parametrize(
    ("statement", "seconds", "how"),
    [
        ("if (slipRate[k] > 0) *(volatile int *)0 = 1;", 60.0, "crashed"),
        ("for (volatile int i = 0;; ++i) ;", 0.5, "time"),
        ("exit(0);", 60.0, "stopped"),
    ],
)
def test_calls_that_do_not_come_back_are_told_apart(tmp_path, statement, seconds, how):
    call = RawCall(subject(in_c(tmp_path, f"{BODY_C} {statement}")))
    assert call.run_apart(seconds=seconds).how == how


def test_exceptions_of_python_are_told(tmp_path):
    path = written(
        tmp_path / "law.py",
        "import usersub\n@usersub.vfric_coef(compiled=False)\ndef law(fCoef):\n"
        "    raise ValueError('no')\n",
    )
    ended = RawCall(subject(path)).run_apart()
    assert (ended.how, ended.words) == ("failed", "ValueError: no")


def test_the_dimension_of_points():
    face = abi.interface("vfric")
    assert point_axis(face.args[face.position("dSlipFric")]) == 1
    assert point_axis(face.args[face.position("preDefSlv")]) == 0
    assert point_axis(face.args[face.position("props")]) is None
