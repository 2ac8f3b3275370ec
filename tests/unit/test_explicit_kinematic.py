# SPDX-License-Identifier: MIT
"""Stick forces that the explicit driver makes itself: kinematic enforcement, penalty for routines
that give the whole force."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import usersub
from tests.unit.test_driver_explicit import CASES, MU, SOURCES, as_dtype, contact, topology
from usersub import paths
from usersub.errors import SceneError

POINTS, DT = 9, 0.1
DTYPES = {"double": np.float64, "single": np.float32}


def make(c_routine, interface, dimension, precision="double", **settings):
    head = "#define USUB_SINGLE\n" if precision == "single" else ""
    routine = c_routine(interface, head + SOURCES[interface], precision=precision, thread_safe=True)
    scene = usersub.Scene(
        points=POINTS, dimension=dimension, precision=precision, props=[MU, 0.0], **settings
    )
    return usersub.ExplicitDriver(routine, scene)


def arrays_of(dimension, dtype=np.float64):
    """A third of the points stick: what the driver gets, and what the host would make of it."""
    arrays = contact(POINTS, dimension)
    stick = arrays.pop("stick_force")
    normal = arrays["normal"]
    velocity = arrays["slip_increment"] / DT
    tangential = velocity - normal * (velocity * normal).sum(0)
    arrays["mass"] = stick * DT / np.linalg.norm(tangential, axis=0)
    return as_dtype(arrays, dtype), stick, tangential


@pytest.mark.parametrize(("interface", "dimension"), CASES)
@pytest.mark.parametrize("precision", ["double", "single"])
def test_kinematic_stick_force(c_routine, interface, dimension, precision):
    dtype = DTYPES[precision]
    arrays, stick, tangential = arrays_of(dimension, dtype)
    settings, nodes = topology(interface, POINTS, dimension)
    made = make(
        c_routine, interface, dimension, precision,
        enforcement="kinematic", dissipation=1, **settings,
    )  # fmt: skip
    assert list(made.state["condition"]) == [2] * POINTS
    found = made.step(DT, **arrays, **as_dtype(nodes, dtype))
    eps = float(np.finfo(dtype).eps)
    np.testing.assert_allclose(made.array("stick_force"), stick, rtol=30 * eps)
    size = np.minimum(MU * arrays["normal_force"], stick)
    direction = tangential / np.linalg.norm(tangential, axis=0)
    np.testing.assert_allclose(found.force, -size * direction, atol=30 * eps)
    sticks = np.arange(POINTS) % 3 == 1
    np.testing.assert_array_equal(made.state["condition"], sticks)
    # What the correction leaves of the predicted slip does the work.
    left = tangential - size * direction * DT / arrays["mass"]
    assert np.abs(left[:, sticks]).max() < 100 * eps
    assert found.dissipation == pytest.approx((size * direction * left).sum() * DT, rel=30 * eps)


def test_axes_along_the_predicted_velocity(c_routine):
    """The slip may be another one, told to the routine: zero for a point that was at rest."""
    arrays, stick, tangential = arrays_of(3)
    velocity = np.asfortranarray(arrays["slip_increment"] / DT)
    arrays["slip_increment"] = np.zeros((3, POINTS), order="F")
    settings, nodes = topology("vfriction", POINTS, 3)
    made = make(c_routine, "vfriction", 3, enforcement="kinematic", states=1, **settings)
    found = made.step(DT, predicted_velocity=velocity, **arrays, **nodes)
    size = np.minimum(MU * arrays["normal_force"], stick)
    expected = -size * tangential / np.linalg.norm(tangential, axis=0)
    np.testing.assert_allclose(found.force, expected, atol=1e-14)
    np.testing.assert_array_equal(made.state["state"], 0.0)
    made.step(DT, slip_increment=np.asfortranarray(np.full((3, POINTS), 0.25)))
    normal = arrays["normal"]
    across = 0.25 - normal * 0.25 * normal.sum(0)
    expected = np.linalg.norm(across, axis=0)
    np.testing.assert_allclose(made.state["state"][0, 0], expected, rtol=1e-14)


def test_limit_on_the_shear_stress(c_routine):
    arrays, stick, tangential = arrays_of(3)
    area = np.linspace(0.5, 2.0, POINTS)
    settings, nodes = topology("vfric_coef", POINTS, 3)
    for method in ("kinematic", "default"):
        made = make(c_routine, "vfric_coef", 3, enforcement=method, shear_limit=0.6, **settings)
        more = {"stick_force": stick} if method == "default" else {}
        given = {n: a for n, a in arrays.items() if n != "mass" or method == "kinematic"}
        found = made.step(DT, area=area, **given, **nodes, **more)
        size = np.minimum(np.minimum(MU * arrays["normal_force"], 0.6 * area), stick)
        np.testing.assert_allclose(np.linalg.norm(found.force, axis=0), size, rtol=1e-14)
        assert (size == 0.6 * area).any() and (size < 0.6 * area).any()


def test_rest_is_rest(c_routine):
    """A point at rest without load has no stick force, and open points no condition."""
    made = make(c_routine, "vfric_coef", 2, enforcement="kinematic")
    normal = np.zeros((2, POINTS), order="F")
    normal[1] = 1.0
    force = np.where(np.arange(POINTS) % 2, 3.0, 0.0)
    found = made.step(
        DT, slip_increment=np.zeros((2, POINTS), order="F"), normal=normal, normal_force=force,
        mass=np.ones(POINTS),
    )  # fmt: skip
    np.testing.assert_array_equal(found.force, 0.0)
    np.testing.assert_array_equal(made.state["condition"], np.where(force > 0.0, 1, 2))


@pytest.mark.parametrize(("interface", "dimension"), [c for c in CASES if c[0] != "vfric_coef"])
@pytest.mark.parametrize("precision", ["double", "single"])
def test_penalty_stick_force_of_routines(c_routine, interface, dimension, precision):
    """The routine gives the force; the driver the length of the elastic trial force."""
    dtype, slope = DTYPES[precision], 0.7
    arrays, _, _ = arrays_of(dimension, dtype)
    arrays.pop("mass")
    settings, nodes = topology(interface, POINTS, dimension)
    nodes = as_dtype(nodes, dtype)
    area = np.linspace(0.5, 2.0, POINTS).astype(dtype)
    made = make(
        c_routine, interface, dimension, precision,
        enforcement="penalty", stick_slope=slope, **settings,
    )  # fmt: skip
    here = nodes["secondary_node"].ravel() - 1 if interface == "vfric" else np.arange(POINTS)
    before = np.zeros((dimension, POINTS), dtype, order="F")
    for seed in (5, 6, 7):
        slip = contact(POINTS, dimension, seed)["slip_increment"].astype(dtype, order="F")
        arrays["slip_increment"] = slip
        found = made.step(DT, area=area, **arrays, **nodes)
        stiffness = (slope * area[here]).astype(dtype)
        expected = usersub.stick_force_penalty(before, slip, arrays["normal"], stiffness)
        stick = made.array("stick_force")
        np.testing.assert_allclose(stick, expected, rtol=30 * np.finfo(dtype).eps)
        force = np.linalg.norm(found.force, axis=0)
        np.testing.assert_allclose(force, np.minimum(MU * arrays["normal_force"], stick), rtol=1e-5)
        np.testing.assert_array_equal(made.state["condition"], MU * arrays["normal_force"] >= stick)
        before = found.force.copy(order="F")


def test_previous_force_turns_with_the_surface(c_routine):
    settings, nodes = topology("vfriction", POINTS, 3)
    made = make(c_routine, "vfriction", 3, enforcement="penalty", stick_slope=0.01, **settings)
    arrays = {n: a for n, a in contact().items() if n != "stick_force"}
    made.step(DT, **arrays, **nodes)
    size = np.linalg.norm(made.step(DT, **arrays).force, axis=0)
    # No slip, every normal in another place: what is turned keeps its length.
    turned = np.asfortranarray(arrays["normal"] + 0.3 * np.roll(arrays["normal"], 1, axis=1))
    turned /= np.linalg.norm(turned, axis=0)
    made.step(DT, slip_increment=np.zeros((3, POINTS), order="F"), normal=turned)
    np.testing.assert_allclose(made.array("stick_force"), size, rtol=1e-14)


def test_plan_says_where_the_stick_force_is_from(c_routine):
    settings, _ = topology("vfric", POINTS, 3)
    told = make(c_routine, "vfric", 3, enforcement="kinematic", **settings).plan.explain()
    assert "kinematic: the driver computes the stick force from the mass" in told
    assert "kinematic: mass times predicted velocity by time increment" in told
    told = make(
        c_routine, "vfric", 3, enforcement="penalty", stick_slope=2.0, **settings
    ).plan.explain()
    assert "penalty: the driver computes the stick force, stiffness 2 times area" in told
    assert "penalty: length of the elastic trial force" in told
    assert "stick force: the host's" in make(c_routine, "vfric", 3, **settings).plan.explain()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"mass": None}, "array 'mass' is not bound; the driver needs it to compute the stick"),
        ({"mass": -1.0}, "mass of point 4 = -1"),
        ({"mass": np.nan}, "mass of point 4 = nan"),
        ({"predicted_velocity": np.inf}, "length of predicted_velocity of point 4"),
        ({"stick_force": 1.0}, "array 'stick_force' is computed by the driver"),
    ],
)
def test_what_kinematic_enforcement_refuses(c_routine, change, words):
    made = make(c_routine, "vfric_coef", 3, enforcement="kinematic")
    arrays, stick, _ = arrays_of(3)
    arrays["predicted_velocity"] = arrays["slip_increment"].copy(order="F")
    for name, value in change.items():
        if value is None:
            arrays.pop(name)
        elif name == "stick_force":
            arrays[name] = stick
        else:
            arrays[name][..., 4] = value
    with pytest.raises(SceneError, match=words):
        made.step(DT, **arrays)


def test_kinematic_needs_time(c_routine):
    made = make(c_routine, "vfric_coef", 3, enforcement="kinematic")
    with pytest.raises(SceneError, match="time increment is 0"):
        made.step(0.0, **arrays_of(3)[0])


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"damping": 1.0}, "the routine gives the force itself"),
        ({"shear_limit": 1.0}, "the routine gives the force itself"),
        ({"stick_slope": 1.0}, "the routine gives the force itself"),
        ({"enforcement": "penalty", "stick_slope": 1.0, "secondary_nodes": 0}, "secondary_nodes"),
    ],
)
def test_what_belongs_to_the_routine_is_refused(c_routine, settings, words):
    with pytest.raises(SceneError, match=words):
        make(c_routine, "vfric", 3, **{"secondary_nodes": 3, "main_nodes": 4, **settings})


def test_steps_allocate_nothing(tmp_path):
    """A host that counts allocations sees none in steps of any enforcement."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("a C compiler is missing; install one, for example with `apt-get install gcc`")
    library = paths.library_path()
    source = Path(__file__).parent / "native/allocations.c"
    subprocess.run(
        [compiler, "-O1", "-Wall", "-Wextra", "-Werror", f"-I{paths.include_folder()}", str(source)]
        + ["-o", str(tmp_path / "host"), str(library), f"-Wl,-rpath,{library.parent}"],
        check=True,
    )
    done = subprocess.run([tmp_path / "host"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout == "0 allocations in 300 steps\n"
