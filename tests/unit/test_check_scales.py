# SPDX-License-Identifier: MIT
"""Sizes at which routines show what they do; the truth follows from their formulas.

Scales are found on decades and told with two digits: they are compared by a factor of ten, the
largest elastic motion by its definition.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import usersub
from usersub import laws
from usersub.check.subject import Scales, Subject
from usersub.check.subjects import scales, tracing

_HEAD = "#include <math.h>\n#include <usersub/abi.h>\n#include <omi_for_c.h>\n"
_VFRIC_COEF = """
void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {{
  for (int k = 0; k < *nBlock; ++k) {{
    const double v = slipRate[k], p = pressure[k], t = *nTemp > 0 ? tempAvg[k] : 0;
    (void)v; (void)p; (void)t;
    fCoef[k] = {value};
  }}
}}
"""
_FRIC = """
void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {{
  *LM = 0;
  for (int i = 0; i < *NFDIR; ++i) {{
    const double x = DGAM[i];
    {body}
  }}
}}
"""


def subject_of(path: Path, interface: str) -> Subject:
    file = usersub.load(path)
    routine = file[interface]
    return Subject(path.name, routine.interface, routine=routine, path=path, file=file)


def coefficient(folder: Path, value: str, **more: object) -> Subject:
    path = folder / "mu.c"
    path.write_text(_HEAD + _VFRIC_COEF.format(value=value))
    return subject_of(path, "vfric_coef").but(temperatures=False, **more)


def fric(folder: Path, body: str) -> Subject:
    path = folder / "fric.c"
    path.write_text(_HEAD + _FRIC.format(body=body))
    return subject_of(path, "fric").but(temperatures=False)


def law(name: str, interface: str) -> Subject:
    return tracing.find(subject_of(laws.path(name, "c"), interface), given=set())


def test_elastic_stick_and_slip():
    """The allowable elastic slip of a scene with characteristic length 1 is 0.005."""
    found = scales.find(law("coulomb", "fric"))
    assert found.scales.stick == pytest.approx(0.0025, rel=0.05)
    assert 10 * 0.005 <= found.scales.slip * 1.001
    assert found.scales.load == 1.0
    assert "0.005" in found.origin["scales"]


def test_friction_that_is_the_same_at_every_motion_keeps_the_ordinary_sizes():
    found = scales.find(law("coulomb", "vfric"))
    assert found.scales == Scales()
    assert found.origin["scales"] == "nothing tells: the ordinary ones"


def test_dashpots_have_no_stick_and_no_scale():
    """Friction follows the motion, but does not stay when the motion ends."""
    found = scales.find(law("damping", "fric"))
    assert found.scales.stick == 0.0
    assert found.scales.slip == Scales().slip


def test_regularised_friction_is_no_stick(tmp_path):
    """Nothing is kept at rest. Friction reaches tanh(1) of the limit at a motion of 1e-4."""
    found = scales.find(fric(tmp_path, "TAU[i] = .3 * PRESS[0] * tanh(x / 1e-4);"))
    assert found.scales.stick == 0.0
    assert 3e-4 <= found.scales.slip <= 3e-3


@pytest.mark.parametrize("rate", [1e-5, 0.1, 40.0])
def test_where_friction_changes_with_the_rate(tmp_path, rate):
    found = scales.find(coefficient(tmp_path, f".1 + .4 * exp(-v / {rate})"))
    slip_rate = found.scales.slip / found.scales.dt
    assert rate / 10 <= slip_rate <= 10 * rate


@pytest.mark.parametrize("limit", [1e-3, 5.0, 1e5])
def test_loads_below_a_shear_limit(tmp_path, limit):
    """Friction follows the load up to `limit`; a load of one stays if it is below."""
    found = scales.find(coefficient(tmp_path, f".3 * (p > {limit} ? {limit} / p : 1)"))
    assert found.scales.load == 1.0 if limit > 1 else limit / 100 <= found.scales.load <= limit


def test_loads_that_are_seen_beside_a_cohesion(tmp_path):
    found = scales.find(fric(tmp_path, "TAU[i] = (1e5 + .3 * PRESS[0]) * (x ? x / fabs(x) : 0);"))
    assert 1e5 <= found.scales.load <= 1e7


def test_no_friction_below_a_load(tmp_path):
    found = scales.find(coefficient(tmp_path, "p < 50 ? 0 : .3"))
    assert found.scales.load == 100.0


def test_temperature_where_a_table_has_its_range(tmp_path):
    """Constant below 300 and above 900 degrees."""
    value = ".5 - .4 * fmin(fmax((t - 300) / 600, 0), 1)"
    found = scales.find(coefficient(tmp_path, value).but(temperatures=True))
    assert 300 < found.scales.temperature < 900
    assert "temperature" in found.origin["scales"]


def test_no_friction_at_all(tmp_path):
    found = scales.find(coefficient(tmp_path, "0"))
    assert found.scales == Scales()
    assert "no friction" in found.origin["scales"]


@pytest.mark.parametrize(
    ("value", "words"),
    [("({ volatile double x = p; while (x > 0) x += 1e-9; x; })", "did not return within"),
     ("*(volatile double *)8", "no friction")],
    ids=["endless", "crash"],
)  # fmt: skip
def test_routines_that_cannot_be_run(tmp_path, value, words):
    found = scales.find(coefficient(tmp_path, value))
    assert found.scales == Scales()
    assert words in found.origin["scales"]
