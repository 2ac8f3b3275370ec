# SPDX-License-Identifier: MIT
"""Cases through the drivers, against Coulomb's law by hand; what a routine is passed."""

from __future__ import annotations

import numpy as np
import pytest

import usersub
from usersub import laws
from usersub.check.case import Case, Step
from usersub.check.respond import respond
from usersub.check.subject import Subject

_MU, _SLIP = 0.3, 1e-3
_LOADS = (2.0, 3.0, 4.5)

# A handful of roundings, in axes that are turned forth and back; single precision likewise.
_TOLERANCE = {"double": 1e-13, "single": 1e-5}


def _subject(interface: str, precision: str = "double") -> Subject:
    routine = usersub.load(laws.path("coulomb", "python"))[interface]
    states = 2 if interface == "fric" else 0
    return Subject(
        "coulomb",
        routine.interface,
        precision,
        routine,
        props=(_MU, _SLIP),
        states=states,
        temperatures=False,
    )


def _path(*motions: tuple[float, float]) -> Case:
    still = Step(((0.0, 0.0),) * 3, _LOADS)
    moved = [Step((m,) * 3, _LOADS) for m in motions]
    return Case((still, *moved))


@pytest.mark.parametrize("interface", ["fric", "vfric", "vfriction"])
@pytest.mark.parametrize("angle", [0.0, 0.7])
def test_slip_is_opposed_by_coefficient_times_load(interface: str, angle: float) -> None:
    motions = ((0.3, 0.4), (-0.5, 1.2))
    case = _path(*motions).but(angle=angle, order=(2, 0, 1))
    answers = respond(_subject(interface), case)
    elastic = np.zeros(2)
    for answer, motion in zip(answers[1:], motions, strict=True):
        direction = elastic + motion
        direction /= np.linalg.norm(direction)
        assert answer.friction == pytest.approx(_MU * np.outer(direction, _LOADS), rel=1e-12)
        # Behind FRIC the return map goes on from the elastic slip, 0.005 of the length 1.
        elastic = 0.005 * direction if interface == "fric" else np.zeros(2)


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
def test_explicit_axes_are_exact(interface: str, precision: str) -> None:
    answer = respond(_subject(interface, precision), _path((0.3, 0.4)))[1]
    expected = _MU * np.outer((0.6, 0.8), _LOADS)
    assert answer.friction == pytest.approx(expected, rel=_TOLERANCE[precision])


def test_the_stick_force_limits_friction() -> None:
    step = Step(((0.3, 0.4),), (2.0,), stick=(0.05,))
    answer = respond(_subject("vfric"), Case((step,)))[0]
    assert np.linalg.norm(answer.friction) == pytest.approx(0.05, rel=1e-13)


def test_two_dimensions_have_one_direction() -> None:
    for interface in ("fric", "vfric"):
        steps = (Step(((0.0,),), (2.0,)), Step(((-0.5,),), (2.0,)))
        answer = respond(_subject(interface), Case(steps))[1]
        assert answer.friction == pytest.approx(np.array([[-0.6]]), rel=1e-13)


@pytest.mark.parametrize("interface", ["fric_coef", "vfric_coef"])
def test_enforcement_gives_friction_to_coefficients(interface: str) -> None:
    subject = _subject(interface).but(props=(_MU,), states=0)
    path = _path((0.3, 0.4))
    assert respond(subject, path)[1].coefficient == pytest.approx(_MU, rel=1e-15)
    assert respond(subject, path)[1].friction is None
    enforced = respond(subject, path, enforced=True)[1]
    assert enforced.friction == pytest.approx(_MU * np.outer((0.6, 0.8), _LOADS), rel=1e-13)


def test_a_failure_ends_the_answers() -> None:
    @usersub.vfric_coef
    def falls_over(fCoef, slipRate):
        if slipRate[0] > 1.0:
            raise ValueError("too fast")
        fCoef[:] = 0.1

    subject = Subject("falls_over", falls_over.interface, "double", falls_over)
    answers = respond(subject, _path((0.3, 0.4), (0.3, 0.4)))
    assert answers[0].failure is None
    assert "too fast" in str(answers[1].failure)
    assert len(answers) == 2


def test_every_point_and_surface_has_its_own_temperature() -> None:
    seen = []

    @usersub.vfric
    def looks(fTangential, tempSec, tempMain):
        fTangential[0, :] = -tempSec - 1000.0 * tempMain

    subject = Subject("looks", looks.interface, "double", looks)
    step = Step(((1.0, 0.0),) * 3, (1.0,) * 3, stick=(1e9,) * 3)
    for order in (None, (1, 2, 0)):
        answer = respond(subject, Case((step,), order=order))[0]
        seen.append(np.linalg.norm(answer.friction, axis=0))
    assert seen[0] == pytest.approx([20.0 + 23e3, 20.5 + 23.25e3, 21.0 + 23.5e3], rel=1e-13)
    assert seen[1] == pytest.approx(seen[0], rel=1e-13)
