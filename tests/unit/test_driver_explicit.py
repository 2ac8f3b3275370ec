# SPDX-License-Identifier: MIT
"""The explicit driver: axes, rotation, bounds, scatter, state, refusals."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import usersub
from usersub.errors import RoutineError, SceneError, StateError

POINTS = 9
MU = 0.3

COULOMB = """\
#include <math.h>
#include <usersub/abi.h>
void vfriction_(USUB_VFRICTION_PARAMETERS) {
  for (int k = 0; k < *nBlock; ++k) {
    const usub_real limit = props[0] * fNormal[k];
    fTangential[2 * k] = -(limit < fStickForce[k] ? limit : fStickForce[k]);
    fTangential[2 * k + 1] = props[1];
    if (*nStates) state[*nStates * k] += dSlipFric[3 * k];
  }
}
"""

COULOMB_VFRIC = """\
#include <usersub/abi.h>
void vfric_(USUB_VFRIC_PARAMETERS) {
  for (int k = 0; k < *nContact; ++k) {
    const usub_real limit = props[0] * fNormal[k];
    fTangential[*nFricDir * k] = -(limit < fStickForce[k] ? limit : fStickForce[k]);
    if (*nStateVar) statev[*nStateVar * (jConSecid[k] - 1)] += dSlipFric[*nDir * k];
  }
}
"""

CONSTANT = """\
#include <usersub/abi.h>
void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {
  for (int k = 0; k < *nBlock; ++k) fCoef[k] = props[0];
}
"""

SOURCES = {"vfric": COULOMB_VFRIC, "vfriction": COULOMB, "vfric_coef": CONSTANT}


def unit_vectors(generator, points: int, dimension: int) -> np.ndarray:
    vectors = generator.normal(size=(dimension, points))
    return np.asfortranarray(vectors / np.linalg.norm(vectors, axis=0))


def contact(points: int = POINTS, dimension: int = 3, seed: int = 5) -> dict[str, np.ndarray]:
    """Slip, normal and forces, different for every point; a third of the points stick."""
    generator = np.random.default_rng(seed)
    normal_force = generator.uniform(1.0, 5.0, points)
    stick_force = MU * normal_force * np.where(np.arange(points) % 3 == 1, 0.5, 2.0)
    return {
        "slip_increment": np.asfortranarray(generator.normal(size=(dimension, points))),
        "normal": unit_vectors(generator, points, dimension),
        "normal_force": normal_force,
        "stick_force": stick_force,
    }


def as_dtype(arrays: dict[str, np.ndarray], dtype) -> dict[str, np.ndarray]:
    return {n: a.astype(dtype, order="F") if a.dtype.kind == "f" else a for n, a in arrays.items()}


def directions(arrays: dict[str, np.ndarray]) -> np.ndarray:
    """Direction of the tangential slip, by projection."""
    slip, normal = arrays["slip_increment"], arrays["normal"]
    tangential = slip - normal * (slip * normal).sum(axis=0)
    return tangential / np.linalg.norm(tangential, axis=0)


def coulomb(arrays: dict[str, np.ndarray]) -> np.ndarray:
    """Coulomb force bounded by the stick force, against the slip."""
    size = np.minimum(MU * arrays["normal_force"], arrays["stick_force"])
    return -size * directions(arrays)


def topology(interface: str, points: int, dimension: int) -> tuple[dict, dict[str, np.ndarray]]:
    """Settings and arrays of a surface whose points have a secondary node and a facet each."""
    facet = 2 if dimension == 2 else 4
    generator = np.random.default_rng(11)
    weights = generator.uniform(0.5, 1.5, (facet, points))
    arrays = {"shape_main": np.asfortranarray(weights / weights.sum(axis=0))}
    mains = facet * points
    main_node = np.arange(mains, dtype=np.int32).reshape((facet, points), order="F") + 1
    secondary_node = generator.permutation(points).astype(np.int32) + 1
    if interface == "vfric":
        arrays |= {"secondary_node": secondary_node, "main_node": np.asfortranarray(main_node)}
        return {"secondary_nodes": points, "main_nodes": mains}, arrays
    arrays["secondary_node"] = secondary_node.reshape((1, points), order="F")
    arrays["main_node"] = np.asfortranarray(main_node + np.int32(points))
    return {"nodes": points + mains}, arrays


def make(c_routine, interface: str, points=POINTS, dimension=3, precision="double", **settings):
    head = "#define USUB_SINGLE\n" if precision == "single" else ""
    routine = c_routine(interface, head + SOURCES[interface], precision=precision, thread_safe=True)
    scene = usersub.Scene(
        points=points, dimension=dimension, precision=precision, props=[MU, 0.0], **settings
    )
    return usersub.ExplicitDriver(routine, scene)


CASES = [
    ("vfric", 2), ("vfric", 3), ("vfriction", 3), ("vfric_coef", 2), ("vfric_coef", 3),
]  # fmt: skip


@pytest.mark.parametrize(("interface", "dimension"), CASES)
@pytest.mark.parametrize("precision", ["double", "single"])
def test_coulomb_with_stick_bound(c_routine, interface, dimension, precision):
    arrays = contact(dimension=dimension)
    settings, nodes = topology(interface, POINTS, dimension)
    dtype = np.float64 if precision == "double" else np.float32
    made = make(c_routine, interface, POINTS, dimension, precision, **settings)
    found = made.step(0.1, **as_dtype({**arrays, **nodes}, dtype))
    assert found.force.dtype == dtype
    assert (found.coefficient is not None) == (interface == "vfric_coef")
    # normalising, rotating and back: a few roundings of numbers of size 1
    np.testing.assert_allclose(found.force, coulomb(arrays), atol=30 * np.finfo(dtype).eps)


@pytest.mark.parametrize(("interface", "dimension"), CASES)
def test_forces_on_both_surfaces(c_routine, interface, dimension):
    arrays = contact(dimension=dimension)
    settings, nodes = topology(interface, POINTS, dimension)
    made = make(c_routine, interface, POINTS, dimension, **settings)
    if interface == "vfric":
        before = {
            "secondary_force": np.full((dimension, POINTS), 0.5, order="F"),
            "main_force": np.full((dimension, settings["main_nodes"]), 0.25, order="F"),
        }
    else:
        before = {"nodal_force": np.full((dimension, settings["nodes"]), 0.5, order="F")}
    after = {name: array.copy(order="F") for name, array in before.items()}
    force = made.step(0.1, **arrays, **nodes, **after).force

    expected = {name: array.copy() for name, array in before.items()}
    secondary = expected.get("secondary_force", expected.get("nodal_force"))
    main = expected.get("main_force", expected.get("nodal_force"))
    for point in range(POINTS):
        secondary[:, nodes["secondary_node"].ravel(order="F")[point] - 1] += force[:, point]
        for corner, node in enumerate(nodes["main_node"][:, point]):
            main[:, node - 1] -= nodes["shape_main"][corner, point] * force[:, point]
    for name, array in after.items():
        np.testing.assert_allclose(array, expected[name], rtol=1e-14, atol=1e-15)
    total = sum(array.sum(axis=1) - before[name].sum(axis=1) for name, array in after.items())
    np.testing.assert_allclose(total, 0.0, atol=1e-13)  # equal and opposite


def test_second_direction(c_routine):
    arrays = contact()
    settings, nodes = topology("vfriction", POINTS, 3)
    made = make(c_routine, "vfriction", **settings)
    made = usersub.ExplicitDriver(made.routine, made.scene.replace(props=[MU, 0.7]))
    force = made.step(0.1, **arrays, **nodes).force
    t2 = np.cross(arrays["normal"], directions(arrays), axis=0)
    np.testing.assert_allclose(force, coulomb(arrays) + 0.7 * t2, atol=1e-14)


def test_kinematics_that_a_routine_sees():
    seen = {}

    @usersub.vfriction(compiled=False)
    def law(fTangential, dSlipFric, fTangPrev, dircosSl, dircosN, fNormal):
        for name, array in list(locals().items()):
            seen[name] = np.array(array)
        fTangential[0, :] = -0.1 * fNormal

    arrays = contact()
    made = usersub.ExplicitDriver(law, usersub.Scene(points=POINTS, props=[]))
    arrays.pop("stick_force")
    first = made.step(0.1, **arrays).force
    t1, normal, slip = directions(arrays), arrays["normal"], arrays["slip_increment"]
    np.testing.assert_allclose(seen["dircosSl"], t1, atol=1e-15)
    np.testing.assert_array_equal(seen["dircosN"], normal)
    np.testing.assert_allclose(seen["dSlipFric"][0], (slip * t1).sum(axis=0), rtol=1e-14)
    np.testing.assert_array_equal(seen["dSlipFric"][1:], 0.0)
    np.testing.assert_array_equal(seen["fTangPrev"], 0.0)

    turned = np.asfortranarray(np.roll(slip, 1, axis=0))
    made.step(0.1, slip_increment=turned)
    t1 = directions({**arrays, "slip_increment": turned})
    local = [(first * axis).sum(axis=0) for axis in (t1, np.cross(normal, t1, axis=0), normal)]
    np.testing.assert_allclose(seen["fTangPrev"], local, atol=1e-15)


@pytest.mark.parametrize("dimension", [2, 3])
def test_zero_slip_has_axes(c_routine, dimension):
    arrays = contact(dimension=dimension)
    arrays["slip_increment"][:] = 0.0
    made = make(c_routine, "vfric_coef", dimension=dimension)
    force = made.step(0.1, **arrays).force
    size = np.minimum(MU * arrays["normal_force"], arrays["stick_force"])
    np.testing.assert_allclose(np.linalg.norm(force, axis=0), size, rtol=1e-14)
    np.testing.assert_allclose((force * arrays["normal"]).sum(axis=0), 0.0, atol=1e-14)


@given(block=st.integers(0, 40), threads=st.integers(1, 4), points=st.integers(1, 60))
def test_blocks_and_threads_give_the_same_bits(c_routine, block, threads, points):
    arrays = contact(points)
    settings, nodes = topology("vfriction", points, 3)
    bits = []
    for choice in ({"block": points, "threads": 1}, {"block": block, "threads": threads}):
        made = make(c_routine, "vfriction", points, states=1, dissipation=1, **settings, **choice)
        nodal = np.zeros((3, settings["nodes"]), order="F")
        for _ in range(2):
            response = made.step(0.1, **arrays, **nodes, nodal_force=nodal)
        bits.append((
            response.force.tobytes(), nodal.tobytes(), made.state.save(),
            response.dissipation,
        ))  # fmt: skip
    assert bits[0] == bits[1]


def test_dissipation(c_routine):
    arrays = contact()
    made = make(c_routine, "vfric_coef", dissipation=1)
    force = made.step(0.1, **arrays).force
    work = -(force * arrays["slip_increment"]).sum()
    assert work > 0.0
    assert made.step(0.1).dissipation == pytest.approx(2.0 * work, rel=1e-14)


FAILS_LATE = """\
#include <math.h>
#include <usersub/abi.h>
void vfriction_(USUB_VFRICTION_PARAMETERS) {
  static int calls = 0;
  for (int k = 0; k < *nBlock; ++k) {
    state[*nStates * k] += 1;
    fTangential[2 * k] = props[0] > 0 && jConSecUid[k] == 7 ? NAN : -1;
  }
}
"""


def test_failure_leaves_everything_as_before(c_routine):
    routine = c_routine("vfriction", FAILS_LATE)
    settings, nodes = topology("vfriction", POINTS, 3)
    scene = usersub.Scene(points=POINTS, states=2, block=2, props=[1.0], dissipation=1, **settings)
    made = usersub.ExplicitDriver(routine, scene)
    made.state["state"][:] = np.arange(2 * POINTS).reshape((2, 1, POINTS), order="F")
    nodal = np.ones((3, settings["nodes"]), order="F")
    before = made.state.save(), nodal.copy()
    with pytest.raises(RoutineError, match=r"fTangential\(1\) = nan at point") as caught:
        made.step(0.1, **contact(), **nodes, nodal_force=nodal)
    assert caught.value.status == -12
    assert caught.value.point == int(np.flatnonzero(nodes["secondary_node"][0] == 7)[0])
    np.testing.assert_array_equal(made.state["state"].ravel(order="F"), np.arange(2.0 * POINTS))
    np.testing.assert_array_equal(nodal, before[1])
    made.step(0.1, secondary_node=np.ones((1, POINTS), np.int32, order="F"), nodal_force=None)
    np.testing.assert_array_equal(made.state["state"][0, 0], np.arange(0.0, 2.0 * POINTS, 2) + 1)


@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
def test_state_saves_and_loads(c_routine, interface, tmp_path):
    settings, nodes = topology(interface, POINTS, 3)
    settings["states"] = 2
    made = make(c_routine, interface, **settings)
    for _ in range(3):
        made.step(0.1, **contact(), **nodes)
    made.state.save(tmp_path / "state.bin")
    saved = made.state.save()
    assert (tmp_path / "state.bin").read_bytes() == saved

    other = make(c_routine, interface, **settings)
    other.state.load(tmp_path / "state.bin")
    np.testing.assert_array_equal(other.state["state"], made.state["state"])
    assert made.state["state"].any()
    for driver in (made, other):
        driver.step(0.1, **contact(seed=8), **nodes)
    assert other.state.save() == made.state.save()


def test_state_that_does_not_fit(c_routine):
    settings, nodes = topology("vfriction", POINTS, 3)
    made = make(c_routine, "vfriction", states=2, **settings)
    made.step(0.1, **contact(), **nodes)
    saved = made.state.save()
    damaged = bytearray(saved)
    damaged[-3] ^= 1
    other = make(c_routine, "vfriction", states=3, **settings)
    before = made.state.save()
    for target, data in [
        (made, bytes(damaged)), (made, saved[:-1]), (made, b""), (made, b"x" * 500), (other, saved),
    ]:  # fmt: skip
        with pytest.raises(StateError):
            target.state.load(data)
    assert made.state.save() == before
    with pytest.raises(KeyError, match="the state has no 'statev'; it has state"):
        made.state["statev"]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"normal_force": -1.0}, ["normal_force", "-1"]),
        ({"normal_force": math.nan}, ["normal_force", "nan"]),
        ({"stick_force": math.nan}, ["stick_force"]),
        ({"slip_increment": math.inf}, ["slip_increment"]),
        ({"normal": 2.0}, ["normal"]),
    ],
)
def test_values_that_are_refused(c_routine, changes, words):
    arrays = contact()
    for name, value in changes.items():
        arrays[name][..., 4] = value
    made = make(c_routine, "vfric_coef")
    with pytest.raises(SceneError) as caught:
        made.step(0.1, **arrays)
    for word in [*words, "4"]:
        assert word in str(caught.value)


@pytest.mark.parametrize("bad", [0, -3, POINTS + 1])
def test_node_numbers_are_checked(c_routine, bad):
    settings, nodes = topology("vfric", POINTS, 3)
    nodes["secondary_node"][2] = bad
    made = make(c_routine, "vfric", states=1, **settings)
    with pytest.raises(SceneError, match=f"secondary_node = {bad} at point 2; expected 1 to 9"):
        made.step(0.1, **contact(), **nodes)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"dimension": 4}, ["dimension", "4", "2 or 3"]),
        ({"points": 0}, ["points", "0"]),
        ({"dimension": 2}, ["VFRICTION", "dimension"]),
        ({"threads": 0}, ["threads", "0"]),
    ],
)
def test_scenes_that_do_not_fit(c_routine, settings, words):
    with pytest.raises(SceneError) as caught:
        make(c_routine, "vfriction", **settings)
    for word in words:
        assert word in str(caught.value)


def test_precision_of_the_standard_interfaces():
    @usersub.fric(compiled=False)
    def law(TAU):
        TAU[:] = 0.0

    with pytest.raises(SceneError, match="FRIC exists in double precision only"):
        usersub.driver(law, usersub.Scene(precision="single"))


def test_time_must_make_sense(c_routine):
    made = make(c_routine, "vfric_coef")
    with pytest.raises(SceneError, match="time increment nan"):
        made.step(math.nan, **contact())
    with pytest.raises(SceneError, match="friction work nan"):
        made.step(0.1, friction_work=math.nan, **contact())
    with pytest.raises(SceneError, match="step = 1.5"):
        made.step(0.1, step=1.5, **contact())


def test_prepared_step(c_routine):
    arrays = contact()
    made = make(c_routine, "vfric_coef")
    expected = made.step(0.1, **arrays).force
    call = made.prepare()
    made.array("force")[:] = 0.0
    assert call() == 0
    np.testing.assert_array_equal(made.array("force"), expected)
    arrays["normal_force"][0] = math.nan
    with pytest.raises(SceneError, match="normal_force"):
        call()
