# SPDX-License-Identifier: MIT
"""Numbers in the figures of the page, against closed forms that answer in place of a routine."""

import numpy as np
import pytest

from usersub import abi
from usersub.check.page import drawing, figures, tangents
from usersub.check.page.canvas import drawn
from usersub.check.page.figures import Refused
from usersub.check.respond import Answer
from usersub.check.subject import Scales

MU, ELASTIC = 0.3, 1e-3


class Law:
    """A subject whose answers are a formula: `coefficient(rate, load, temperature, fields)`."""

    precision = "double"
    anisotropic = False

    def __init__(self, interface="fric", coefficient=lambda *_: MU, fields=0, temperatures=False):
        self.interface = abi.interface(interface)
        self.coefficient, self.fields, self.temperatures = coefficient, fields, temperatures
        self.scales = Scales(slip=1e-2, stick=ELASTIC if interface == "fric" else 0.0)

    def respond(self, case):
        elastic, answers = np.zeros((2, case.points)), []
        for step in case.steps:
            motion, load = np.array(step.motion).T, np.array(step.load)
            rate = np.hypot(*motion) / step.dt
            around = [() if t is None else np.array(t) for t in (step.temperature, step.fields)]
            mu = self.coefficient(rate, load, *around) * np.ones(case.points)
            if self.interface.name.endswith("coef"):
                answers.append(Answer(coefficient=mu))
            elif self.interface.solver == "explicit":
                answers.append(self.explicit(step, motion, mu * load))
            else:
                elastic = elastic + motion
                answer = self.standard(elastic, mu, load)
                elastic = answer.friction * ELASTIC / np.maximum(mu * load, 1e-300)
                answers.append(answer)
        return answers

    def explicit(self, step, motion, force):
        size = np.hypot(*motion)
        towards = motion / np.where(size > 0, size, 1.0)
        stick = 50.0 * np.array(step.load) if step.stick is None else np.array(step.stick)
        return Answer(friction=self.turned(towards * np.minimum(force, stick)))

    def turned(self, friction):
        return friction

    def standard(self, trial, mu, load):
        """Elastic slip up to ELASTIC, then Coulomb friction, with its tangent."""
        size = np.maximum(np.hypot(*trial), 1e-300)
        n, slips, unit = trial / size, size > ELASTIC, np.eye(2)[..., None]
        tau = mu * load * np.where(slips, n, trial / ELASTIC)
        by_slip = mu * load / size * (unit - n[:, None] * n[None])
        tangent = np.where(slips, by_slip, mu * load / ELASTIC * unit)
        return Answer(friction=tau, tangent=tangent, by_pressure=tau / load, lm=np.zeros(len(load)))


def test_surface():
    law = Law("vfric_coef", lambda rate, load, *_: 0.1 + 0.2 / (1 + rate) / (1 + load))
    data = figures.surface(law)
    rates, loads = np.array(data["rates"]), np.array(data["loads"])
    wanted = 0.1 + 0.2 / (1 + rates) / (1 + loads[:, None])
    np.testing.assert_allclose(data["values"], wanted, rtol=1e-12)
    assert data["by_rate"] and data["by_load"] and not data["wide"]
    assert drawn(drawing.surface(data), 9, 3.6, "x").count("pressure") >= 4
    only_rate = figures.surface(Law("fric", lambda rate, *_: 0.2 + 0.1 * np.exp(-rate)))
    assert only_rate["by_rate"] and not only_rate["by_load"]
    wide = figures.surface(Law("fric", lambda rate, *_: 1e-3 * rate))
    assert wide["wide"]
    with pytest.raises(Refused, match="is 0.3 at all slip rates"):
        figures.surface(Law())


def test_loop_is_elastic_then_coulomb():
    data = figures.loop(Law())
    motion, turn = np.array(data["motion"]), data["turn"]
    amplitude = 8 * ELASTIC
    assert motion[turn] == motion.max() == pytest.approx(amplitude)
    for load, friction in zip(data["loads"], data["friction"], strict=True):
        first = np.minimum(motion[: turn + 1] / ELASTIC, 1.0) * MU * load
        np.testing.assert_allclose(friction[: turn + 1], first, atol=1e-12)
        back = np.maximum(1.0 - (amplitude - motion[turn : 3 * turn]) / ELASTIC, -1.0) * MU * load
        np.testing.assert_allclose(friction[turn : 3 * turn], back, atol=1e-12)
    with pytest.raises(Refused, match="0.3 throughout"):
        figures.loop(Law("fric_coef"))


def test_stick_force():
    data = figures.stick_force(Law("vfriction"))
    held = np.array(data["stick"])
    assert held[-1] == pytest.approx(2 * MU)
    np.testing.assert_allclose(data["force"], np.minimum(held, MU), rtol=1e-12)
    with pytest.raises(Refused, match="no friction force"):
        figures.stick_force(Law("vfric", lambda *_: 0.0))
    with pytest.raises(Refused, match="50 times the normal force"):
        figures.stick_force(Law("vfric", lambda *_: 80.0))


def test_dependence_tells_what_is_read():
    def mu(rate, load, temperature, fields):
        return 0.5 - 1e-4 * temperature[:, 0] + 0.1 * fields[:, 0, 1]

    data = figures.dependence(Law("vfric_coef", mu, fields=2, temperatures=True))
    curves = {curve["name"]: curve for curve in data["curves"]}
    assert data["without"] == ["field variable 1"]
    assert set(curves) == {"temperature", "field variable 2"}
    found = np.array(curves["temperature"]["y"])
    np.testing.assert_allclose(found, 0.55 - 1e-4 * np.array(curves["temperature"]["x"]))
    found = np.array(curves["field variable 2"]["y"])
    np.testing.assert_allclose(found, 0.498 + 0.1 * np.array(curves["field variable 2"]["x"]))
    with pytest.raises(Refused, match="not depend on temperature"):
        figures.dependence(Law("vfric_coef", temperatures=True))


def test_directions():
    class Turned(Law):
        def turned(self, friction):
            c, s = np.cos(0.3), np.sin(0.3)
            return np.array([[c, -s], [s, c]]) @ friction

    data = figures.directions(Turned("vfric"))
    assert data["angle"] == pytest.approx(np.degrees(0.3))
    np.testing.assert_allclose(np.hypot(*np.array(data["friction"])), MU, rtol=1e-12)
    with pytest.raises(Refused, match="same size in all directions"):
        figures.directions(Law("vfric"))
    with pytest.raises(Refused, match="zero"):
        figures.directions(Law("vfric", lambda *_: 0.0))


def entries(law):
    data = tangents.tangent(law)
    drawn(drawing.tangent(data), 9, 4.4, "x")
    return {e["name"]: np.array(e["error"]) for e in data["entries"]}, data


def test_right_tangent():
    errors, data = entries(Law())
    assert len(errors) == 6
    # Central differences of the finest steps keep 1e-10; on the border one side is right.
    assert max(e.max() for e in errors.values()) <= 1e-6
    assert data["motions"][0] < ELASTIC < data["motions"][-1]


def test_wrong_entries_are_told_apart():
    class Wrong(Law):
        def standard(self, trial, mu, load):
            answer = super().standard(trial, mu, load)
            answer.tangent[0, 1] *= -1.0
            answer.by_pressure[1] *= 1.001
            return answer

    errors, data = entries(Wrong())
    slips = np.array(data["motions"]) > 1.01 * ELASTIC
    c, s = np.cos(0.5), np.sin(0.5)
    # In slip DDTDDG is c^2, -cs, s^2 over the motion, DDTDDP(2) is mu s beside mu c.
    wanted = 2 * c * s / max(c * c, c * s, s * s)
    # One-sided differences of a step of 1e-3 count too, and are that far off.
    np.testing.assert_allclose(errors["DDTDDG(1,2)"][:, slips], wanted, rtol=2e-3)
    np.testing.assert_allclose(errors["DDTDDG(1,2)"][:, ~slips], 1e-8, rtol=1e-6)
    np.testing.assert_allclose(errors["DDTDDP(2)"], 1e-3 * s / c, rtol=2e-3)
    for name in ("DDTDDG(1,1)", "DDTDDG(2,1)", "DDTDDG(2,2)", "DDTDDP(1)"):
        assert errors[name].max() <= 1e-6


def test_no_tangent():
    class Sticks(Law):
        def standard(self, trial, mu, load):
            answer = super().standard(trial, mu, load)
            answer.lm[:] = 1
            return answer

    with pytest.raises(Refused, match="LM = 0"):
        tangents.tangent(Sticks())
    with pytest.raises(Refused, match="lets no point slip here"):
        figures.surface(Sticks())
