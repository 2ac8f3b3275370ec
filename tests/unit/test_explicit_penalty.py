# SPDX-License-Identifier: MIT
"""Penalty enforcement of VFRIC_COEF by the explicit driver: elastic slip, damping, energy."""

from __future__ import annotations

import numpy as np
import pytest

import usersub
from usersub.errors import RoutineError, SceneError, StateError

#: Coefficient props[0] at rest, props[1] at any rate; negative for a normal force of props[2].
LAW = """\
#include <usersub/abi.h>
void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {
  for (int k = 0; k < *nBlock; ++k)
    fCoef[k] = pressure[k] == props[2] ? -1 : slipRate[k] > 0 ? props[1] : props[0];
}
"""
SLOPE, DT = 40.0, 0.125
DTYPES = {"double": np.float64, "single": np.float32}
#: Rounding of a hundred steps on numbers of size 1 to 10.
ATOL = {"double": 3e-14, "single": 2e-5}


def make(c_routine, points, dimension, precision="double", props=(0.3, 0.3, -1.0), **settings):
    head = "#define USUB_SINGLE\n" if precision == "single" else ""
    routine = c_routine("vfric_coef", head + LAW, precision=precision, thread_safe=True)
    settings = {"enforcement": "penalty", "stick_slope": SLOPE, "dissipation": 1, **settings}
    scene = usersub.Scene(
        points=points, dimension=dimension, precision=precision, props=list(props), **settings
    )
    return usersub.ExplicitDriver(routine, scene)


def one_point(c_routine, dimension=2, precision="double", **settings):
    """A function of a slip along x (and a normal force) that makes a step; and its driver."""
    made = make(c_routine, 1, dimension, precision, **settings)
    dtype = DTYPES[precision]
    normal = np.zeros((dimension, 1), dtype, order="F")
    normal[1] = 1.0

    def step(slip, normal_force=10.0, dt=DT):
        vector = np.zeros((dimension, 1), dtype, order="F")
        vector[0] = slip
        force = np.array([normal_force], dtype)
        return made.step(dt, slip_increment=vector, normal=normal, normal_force=force).force[0, 0]

    return step, made


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("dimension", [2, 3])
def test_stick_slip_and_back(c_routine, dimension, precision):
    step, made = one_point(c_routine, dimension, precision)
    # Numbers of few bits, exact in both precisions but for the bound 0.3 * 10.
    assert step(0.0625) == -2.5 and made.state["condition"][0] == 1
    assert step(0.0625) == pytest.approx(-3.0, rel=1e-6)
    assert made.state["condition"][0] == 0
    assert made.state["elastic_slip"][0, 0] == pytest.approx(0.075, rel=1e-6)
    assert step(-0.0625) == pytest.approx(-0.5, rel=1e-5) and made.state["condition"][0] == 1
    assert step(-0.125) == pytest.approx(3.0, rel=1e-6) and made.state["condition"][0] == 0
    assert step(0.0, normal_force=0.0) == 0.0 and made.state["condition"][0] == 2
    assert made.state["elastic_slip"][0, 0] == 0.0
    assert step(0.03125) == -1.25


def test_dissipation_and_elastic_energy(c_routine):
    step, made = one_point(c_routine)
    step(0.05)
    assert made.elastic_energy == pytest.approx(0.5 * SLOPE * 0.05**2, rel=1e-14)
    assert step(0.0) == pytest.approx(-2.0) and step(-0.05) == pytest.approx(0.0, abs=1e-15)
    response = made.step(DT)
    assert response.dissipation == 0.0  # a closed elastic loop loses nothing
    # Slip of 0.2 in one increment or in many: the force is 3 behind the elastic slip of 0.075.
    for increments in (1, 7):
        step, made = one_point(c_routine)
        for _ in range(increments):
            step(0.2 / increments)
        dissipated = made.step(DT, slip_increment=np.zeros((2, 1), order="F")).dissipation
        assert dissipated == pytest.approx(3.0 * (0.2 - 0.075), rel=1e-14)
        assert made.elastic_energy == pytest.approx(0.5 * 3.0 * 0.075, rel=1e-14)


@pytest.mark.parametrize("left", [0.0, 4.0])
def test_a_falling_bound_releases_energy(c_routine, left):
    step, made = one_point(c_routine)
    step(0.06)
    before = made.elastic_energy
    step(0.0, normal_force=left)
    response = made.step(DT)
    assert made.elastic_energy == pytest.approx(0.5 * (0.3 * left) ** 2 / SLOPE, abs=1e-16)
    assert response.dissipation + made.elastic_energy == pytest.approx(before, rel=1e-14)


def rotation(axis, angle):
    """Rotation matrix by Rodrigues' formula."""
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def between(a, b):
    """Shortest rotation of the unit vector a into b."""
    axis = np.cross(a, b)
    size = np.linalg.norm(axis)
    return np.eye(3) if size < 1e-12 else rotation(axis, np.arctan2(size, a @ b))


class Point:
    """One point in three dimensions, by matrices; independent of the driver's formulas."""

    def __init__(self, slope, damping, limit):
        self.slope, self.damping, self.limit = slope, damping, limit
        self.slip, self.normal, self.energy, self.lost = np.zeros(3), None, 0.0, 0.0

    def step(self, motion, normal, normal_force, area, mu, dt):
        if self.normal is not None:
            self.slip = between(self.normal, normal) @ self.slip
        self.normal = normal
        if normal_force <= 0.0:
            self.lost += 0.5 * self.slope * area * (self.slip @ self.slip)
            self.slip, self.energy = np.zeros(3), 0.0
            return np.zeros(3)
        motion = motion - normal * (motion @ normal)
        elastic, viscous = self.slope * area, self.damping * area / dt
        bound = min(mu * normal_force, self.limit * area)
        trial = elastic * (self.slip + motion) + viscous * motion
        size = np.linalg.norm(trial)
        stress = trial * min(1.0, bound / size)
        end = (stress + viscous * self.slip) / (elastic + viscous)
        plastic = np.linalg.norm(self.slip + motion - end)
        released = 0.0
        if size > bound:
            released = max(0.0, np.linalg.norm(self.slip) - bound / elastic)
        change = end - self.slip
        self.lost += bound * plastic + viscous * change @ change
        self.lost += 0.5 * elastic * released**2
        self.slip, self.energy = end, 0.5 * elastic * end @ end
        return -stress


@pytest.mark.parametrize("damping", [0.0, 2.5])
@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("dimension", [2, 3])
def test_random_paths_with_turning_normals(c_routine, dimension, precision, damping):
    points, dtype = 7, DTYPES[precision]
    generator = np.random.default_rng(3)
    made = make(c_routine, points, dimension, precision, damping=damping, shear_limit=5.0)
    models = [Point(SLOPE, damping, 5.0) for _ in range(points)]
    area = generator.uniform(0.4, 1.4, points).astype(dtype)
    angle = generator.uniform(0.0, 6.0, points)
    tilt = generator.uniform(0.2, 0.6, points) if dimension == 3 else np.full(points, np.pi / 2)
    conditions, dissipation = [], [0.0]
    for _ in range(100):
        # Vary mildly, in all directions; a point opens now and then.
        angle += generator.uniform(-0.2, 0.3, points)
        normal = np.array(
            [np.sin(tilt) * np.cos(angle), np.sin(tilt) * np.sin(angle), np.cos(tilt)]
        )
        normal[2] = 0.0 if dimension == 2 else normal[2]
        motion = generator.normal(0.0, 0.03, (3, points))
        motion[2] *= dimension == 3
        force = generator.uniform(2.0, 20.0, points) * (generator.uniform(size=points) > 0.05)
        arrays = {
            "slip_increment": np.asfortranarray(motion[:dimension].astype(dtype)),
            "normal": np.asfortranarray(normal[:dimension].astype(dtype)),
            "normal_force": force.astype(dtype),
        }
        found = made.step(DT, area=area, **arrays)
        conditions.append(made.state["condition"].copy())
        dissipation.append(found.dissipation)
        for p, model in enumerate(models):
            here = np.zeros((2, 3))
            here[:, :dimension] = arrays["slip_increment"][:, p], arrays["normal"][:, p]
            expected = model.step(*here, float(arrays["normal_force"][p]), float(area[p]), 0.3, DT)
            np.testing.assert_allclose(
                found.force[:, p], expected[:dimension], atol=ATOL[precision]
            )
            elastic = made.state["elastic_slip"][:, p]
            np.testing.assert_allclose(elastic, model.slip[:dimension], atol=ATOL[precision])
        tolerance = {"rel": 1e-12 if precision == "double" else 1e-5}
        assert found.dissipation == pytest.approx(sum(m.lost for m in models), **tolerance)
        assert made.elastic_energy == pytest.approx(sum(m.energy for m in models), **tolerance)
    assert (np.diff(dissipation) >= 0.0).all()
    assert set(np.unique(conditions)) == {0, 1, 2}


def test_slip_turns_with_the_surface(c_routine):
    """A quarter turn about the z axis in any number of steps: exact, and of constant length."""
    for increments in (1, 2, 90):
        made = make(c_routine, 1, 3)
        arrays = {"normal_force": np.array([10.0])}
        start = np.array([[0.0], [0.03], [0.04]], order="F")
        normal = np.array([[1.0], [0.0], [0.0]], order="F")
        made.step(DT, slip_increment=start, normal=normal, **arrays)
        for i in range(increments):
            angle = 0.5 * np.pi * (i + 1) / increments
            normal = np.array([[np.cos(angle)], [np.sin(angle)], [0.0]], order="F")
            made.step(DT, slip_increment=np.zeros((3, 1), order="F"), normal=normal)
        np.testing.assert_allclose(
            made.state["elastic_slip"][:, 0], [-0.03, 0.0, 0.04], atol=2e-16 * (1 + increments)
        )


def test_without_a_turn_nothing_is_rounded(c_routine):
    """An oblique normal that stays leaves an elastic slip as it is, bit for bit."""
    made = make(c_routine, 1, 3)
    normal = np.array([[1.0], [2.0], [-2.0]], order="F") / 3.0
    slip = np.array([[0.02], [0.01], [0.02]], order="F")
    arrays = {"normal": normal, "normal_force": np.array([10.0])}
    first = made.step(DT, slip_increment=slip, **arrays).force
    kept = made.state["elastic_slip"].copy()
    for _ in range(1000):
        last = made.step(DT, slip_increment=np.zeros((3, 1), order="F")).force
    np.testing.assert_array_equal(last, first)
    np.testing.assert_array_equal(made.state["elastic_slip"], kept)


def test_a_flipped_normal_is_not_a_turn(c_routine):
    made = make(c_routine, 1, 3)
    slip = np.array([[0.02], [0.0], [0.01]], order="F")
    normal = np.array([[0.0], [1.0], [0.0]], order="F")
    made.step(DT, slip_increment=slip, normal=normal, normal_force=np.array([10.0]))
    made.step(DT, slip_increment=0.0 * slip, normal=-normal)
    np.testing.assert_array_equal(made.state["elastic_slip"], slip)
    # Between the two: what stands out of the new plane is dropped.
    angle = np.radians(150.0)
    normal = np.array([[np.sin(angle)], [-np.cos(angle)], [0.0]], order="F")
    found = made.step(DT, slip_increment=0.0 * slip, normal=normal)
    expected = slip - normal * (normal.T @ slip)
    np.testing.assert_allclose(found.force, -SLOPE * expected, rtol=1e-14, atol=1e-17)


def test_damping_relaxes_and_vanishes_in_slip(c_routine):
    damping, dt = 3.0, 0.1
    step, made = one_point(c_routine, damping=damping, props=(50.0, 50.0, -1.0))
    assert step(0.01, dt=dt) == pytest.approx(-(SLOPE * 0.01 + damping * 0.01 / dt), rel=1e-14)
    assert step(0.0, dt=dt) == pytest.approx(-SLOPE * 0.01, rel=1e-14)
    viscous = made.step(dt).dissipation
    assert viscous == pytest.approx(damping * 0.01**2 / dt, rel=1e-14)
    # In slip the whole stress is bounded, and the elastic slip goes to its limit as
    # slope g + damping dg/dt = bound.
    step, made = one_point(c_routine, damping=damping)
    gap = [0.075]
    for _ in range(40):
        assert step(0.3, dt=dt) == pytest.approx(-3.0, rel=1e-14)
        gap.append(0.075 - made.state["elastic_slip"][0, 0])
    ratio = damping / (damping + SLOPE * dt)
    np.testing.assert_allclose(gap[1:], 0.075 * ratio ** np.arange(1, 41), atol=1e-16)


def test_no_slip_rate_while_a_point_sticks(c_routine):
    """A static coefficient holds until it is reached; the kinetic one then rules."""
    step, _ = one_point(c_routine, props=(0.5, 0.2, -1.0))
    assert [step(0.06) for _ in range(3)] == pytest.approx([-2.0, -2.0, -2.0])
    step, _ = one_point(c_routine, props=(0.5, 0.2, -1.0))
    forces = [step(0.04) for _ in range(5)]
    assert forces == pytest.approx([-1.6, -3.2, -4.8, -5.0, -2.0])


def test_blocks_and_threads_change_no_bit(c_routine):
    points, answers = 61, []
    for settings in ({}, {"block": 7}, {"block": 5, "threads": 3}):
        made = make(c_routine, points, 3, damping=1.5, **settings)
        generator = np.random.default_rng(8)
        for _ in range(5):
            normal = generator.normal(size=(3, points))
            response = made.step(
                DT,
                slip_increment=np.asfortranarray(generator.normal(0.0, 0.05, (3, points))),
                normal=np.asfortranarray(normal / np.linalg.norm(normal, axis=0)),
                normal_force=generator.uniform(1.0, 9.0, points),
            )
        answers.append((response.force.tobytes(), response.dissipation, made.state.save()))
    assert answers[0] == answers[1] == answers[2]


def test_a_failed_increment_never_was(c_routine):
    made = make(c_routine, 3, 2, props=(0.3, 0.3, 6.5))
    slip = np.array([[0.01, 0.02, 0.2], [0.0, 0.0, 0.0]], order="F")
    normal = np.array([[0.0] * 3, [1.0] * 3], order="F")
    force = np.array([4.0, 5.0, 6.0])
    made.step(DT, slip_increment=slip, normal=normal, normal_force=force)
    saved = made.state.save()
    with pytest.raises(RoutineError, match="fCoef = -1 at point 2"):
        made.step(DT, normal_force=np.array([4.0, 5.0, 6.5]))
    assert made.state.save() == saved
    with pytest.raises(SceneError, match="area of point 1 = 0"):
        made.step(DT, normal_force=force, area=np.array([1.0, 0.0, 1.0]))
    assert made.state.save() == saved


def test_state_is_saved_and_refused_elsewhere(c_routine):
    arrays = {
        "slip_increment": np.array([[0.01, 0.2], [0.0, 0.1]], order="F"),
        "normal": np.array([[0.0, 0.6], [1.0, 0.8]], order="F"),
        "normal_force": np.array([4.0, 5.0]),
    }
    made, other = make(c_routine, 2, 2), make(c_routine, 2, 2)
    made.step(DT, **arrays)
    other.state.load(made.state.save())
    for driver in (made, other):
        driver.step(DT, **arrays)
    assert made.state.save() == other.state.save()
    assert made.elastic_energy == other.elastic_energy > 0.0
    free = make(c_routine, 2, 2, enforcement="default", stick_slope=0.0)
    assert list(free.state) == []
    with pytest.raises(StateError, match="enforces sticking"):
        free.state.load(made.state.save())


def test_points_that_leave_forget_their_slip(c_routine):
    made = make(c_routine, 2, 2)
    arrays = {
        "slip_increment": np.full((2, 2), 0.01, order="F"),
        "normal": np.array([[0.0, 0.0], [1.0, 1.0]], order="F"),
        "normal_force": np.array([4.0, 5.0]),
    }
    made.step(DT, **arrays)
    made.points = 1
    made.step(DT)
    np.testing.assert_array_equal(made.state["elastic_slip"], [[0.02, 0.0], [0.0, 0.0]])
    np.testing.assert_array_equal(made.state["condition"], [1, 2])


def test_huge_slips_are_finite_or_refused(c_routine):
    step, made = one_point(c_routine)
    assert step(1e300) == pytest.approx(-3.0, rel=1e-14)
    saved = made.state.save()
    with pytest.raises(RoutineError, match="friction force of point 0 overflows"):
        step(1e307, dt=10.0)
    assert made.state.save() == saved
    # Components that are still numbers, of a length that is none.
    made = make(c_routine, 1, 3, "single", stick_slope=3e38)
    slip = np.array([[0.9], [0.0], [0.9]], np.float32, order="F")
    normal = np.array([[0.0], [1.0], [0.0]], np.float32, order="F")
    with pytest.raises(RoutineError, match="friction force of point 0 overflows"):
        made.step(DT, slip_increment=slip, normal=normal, normal_force=np.ones(1, np.float32))


def test_plan_says_what_the_driver_does(c_routine):
    _, made = one_point(c_routine, damping=2.0, shear_limit=7.0)
    told = made.plan.explain()
    assert "penalty: the driver keeps the elastic slip, stiffness 40 times area, damping 2" in told
    assert "limit on the shear stress: 7" in told
    assert "0 while a point sticks" in told


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"stick_slope": 0.0}, "penalty enforcement needs the scene setting 'stick_slope'"),
        ({"enforcement": "lagrange"}, "Lagrange multipliers are of the implicit driver"),
        ({"enforcement": "kinematic"}, "kinematic enforcement allows no elastic slip"),
        ({"changing": 1}, "changing friction is of the implicit driver"),
        (
            {"enforcement": "default", "stick_slope": 0.0, "damping": 1.0},
            "only penalty enforcement has an elastic slip",
        ),
    ],
)
def test_settings_that_contradict_each_other(c_routine, settings, words):
    with pytest.raises(SceneError, match=words):
        make(c_routine, 1, 2, **settings)


def test_a_slope_alone_means_penalty(c_routine):
    step, made = one_point(c_routine, enforcement="default")
    assert step(0.01) == pytest.approx(-0.4) and "elastic_slip" in made.state


def test_damping_needs_time(c_routine):
    step, _ = one_point(c_routine, damping=1.0)
    with pytest.raises(SceneError, match="time increment is 0"):
        step(0.01, dt=0.0)
