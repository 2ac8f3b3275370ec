# SPDX-License-Identifier: MIT
"""Forces of the explicit drivers: rotation back, sign, both surfaces, points that come and go."""

from __future__ import annotations

import engine_explicit as ee
import numpy as np
import pytest
from engine_explicit import PLACES, bindable, run

import usersub
from usersub.errors import SceneError

#: A few roundings of the largest component.
TOLERANCE = {"double": 1e-14, "single": 2e-6}


def answer(me, view):
    """Different components for every point, told apart by the normal force."""
    call = me.calls[-1]
    if "fCoef" in call:
        view("fCoef")[:] = call["pressure"] / 4
        return
    force = view("fTangential")
    for a in range(force.shape[0]):
        force[a] = (a + 1) * call["fNormal"] - 5 * a


def nodal(host, value=0.0) -> dict[str, np.ndarray]:
    """Nodal arrays that hold something already."""
    if host.vfric:
        sizes = {"secondary_force": ee.SECONDARY_NODES, "main_force": ee.MAIN_NODES}
    else:
        sizes = {"nodal_force": ee.NODES}
    return {
        name: np.full((host.dimension, count), value, host.real, order="F")
        for name, count in sizes.items()
    }


def one_partition(host) -> None:
    """Makes the shape functions of every point sum to one, as on an element."""
    for name in ("shape_main", "shape_secondary"):
        if name in host.arrays:
            shape = host.arrays[name]
            host.arrays[name] = np.asfortranarray(shape / shape.sum(axis=0), host.real)


def expected_force(host) -> np.ndarray:
    """The answer in global components."""
    _, t1, t2, _ = host.axes()
    normal_force = host.arrays["normal_force"].astype(float)
    if host.interface == "vfric_coef":
        bound = normal_force * normal_force / host.arrays["area"] / 4
        return -np.minimum(bound, host.arrays["stick_force"]) * t1
    return normal_force * t1 + (2 * normal_force - 5) * t2


def expected_nodal(host, force) -> dict[str, np.ndarray]:
    made = {name: np.zeros(a.shape) for name, a in nodal(host).items()}
    secondary = made["secondary_force" if host.vfric else "nodal_force"]
    main = made["main_force" if host.vfric else "nodal_force"]
    for p in range(host.points):
        weights = host.arrays["shape_secondary"][:, p] if host.edges else [1.0]
        for node, weight in zip(
            np.ravel(host.arrays["secondary_node"][..., p]), weights, strict=True
        ):
            secondary[:, node - 1] += weight * force[:, p]
        if host.rigid:
            main[:, 0 if host.vfric else host.arrays["main_node"][0, 0] - 1] -= force[:, p]
            continue
        for m in range(host.m):
            node = host.arrays["main_node"][m, p]
            main[:, node - 1] -= host.arrays["shape_main"][m, p] * force[:, p]
    return made


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("block", [0, 1, 7])
@pytest.mark.parametrize(("interface", "dimension", "contact"), PLACES)
def test_forces_of_points_and_nodes(probe, interface, dimension, contact, block, precision):
    host = ee.Host(interface, 9, dimension, contact, precision, block=block)
    one_partition(host)
    made = probe("full", interface, precision=precision, act=answer)
    driver = usersub.ExplicitDriver(made.routine, host.scene())
    before, arrays = nodal(host, 100.0), nodal(host, 100.0)
    response = run(driver, bindable(driver, host) | arrays)
    made.checked_calls()
    force = expected_force(host)
    close = {"rtol": 0, "atol": 30 * TOLERANCE[precision] * np.abs(force).max()}
    np.testing.assert_allclose(response.force, force, **close)
    wanted = expected_nodal(host, force)
    close["atol"] += 100 * TOLERANCE[precision]  # what was there rounds the sum
    for name, array in arrays.items():
        np.testing.assert_allclose(array - before[name], wanted[name], **close)
    total = sum((arrays[name] - before[name]).sum(axis=1) for name in arrays)
    np.testing.assert_allclose(total, 0, atol=20 * close["atol"])
    n = host.arrays["normal"]
    assert np.abs((response.force * n).sum(axis=0)).max() <= close["atol"]  # tangential


@pytest.mark.parametrize(("interface", "dimension", "contact"), PLACES)
def test_nodes_that_belong_to_many_points(probe, interface, dimension, contact):
    host = ee.Host(interface, 9, dimension, contact)
    for name in ("secondary_node", "main_node"):
        if name in host.arrays:
            host.arrays[name][...] = 2 if name == "main_node" else 5
    made = probe("full", interface, act=answer)
    driver = usersub.ExplicitDriver(made.routine, host.scene())
    arrays = nodal(host)
    run(driver, bindable(driver, host) | arrays)
    wanted = expected_nodal(host, expected_force(host))
    for name, array in arrays.items():
        np.testing.assert_allclose(array, wanted[name], rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("bad", [0, -1, 10_000, 2**31 - 1, -(2**31)])
@pytest.mark.parametrize("name", ["secondary_node", "main_node"])
@pytest.mark.parametrize(("interface", "dimension", "contact"), PLACES)
def test_node_numbers_that_are_none(probe, interface, dimension, contact, name, bad):
    host = ee.Host(interface, 9, dimension, contact)
    if name not in host.arrays:
        return  # an analytical rigid surface of VFRIC has no nodes
    column = min(4, host.arrays[name].shape[-1] - 1)
    host.arrays[name][..., column] = bad
    made = probe("full", interface, act=answer)
    driver = usersub.ExplicitDriver(made.routine, host.scene())
    arrays = nodal(host, 100.0)
    with pytest.raises(SceneError, match=f"{name} = {bad} at point {column}; expected 1 to"):
        run(driver, bindable(driver, host) | arrays)
    assert not made.calls
    assert all((array == 100).all() for array in arrays.values())


def test_one_surface_alone(probe):
    host = ee.Host("vfric")
    made = probe("full", "vfric", act=answer)
    for name, array in nodal(host).items():
        driver = usersub.ExplicitDriver(made.routine, host.scene())
        run(driver, bindable(driver, host) | {name: array})
        wanted = expected_nodal(host, expected_force(host))[name]
        np.testing.assert_allclose(array, wanted, rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
def test_fewer_points_and_none(probe, interface):
    host = ee.Host(interface, block=4)
    made = probe("full", interface, act=answer)
    driver = usersub.ExplicitDriver(made.routine, host.scene())
    arrays = bindable(driver, host)
    everything = run(driver, arrays).force
    for points in (5, 0, 1, 9):
        made.calls.clear()
        driver.points = points
        total = nodal(host)
        force = run(driver, arrays | total).force
        np.testing.assert_array_equal(force[:, :points], everything[:, :points])
        count = "nContact" if interface == "vfric" else "nBlock"
        assert sum(call[count] for call in made.checked_calls()) == points
        assert len(made.calls) == -(-points // 4)
        if points == 0:
            assert not any(a.any() for a in total.values())


def test_previous_force_of_vfric_stays_with_the_node(probe):
    """Contact points of VFRIC come and go: the force is that of the node, zero for a newcomer."""
    host = ee.Host("vfric")
    made = probe("full", "vfric", act=answer)
    driver = usersub.ExplicitDriver(made.routine, host.scene())
    arrays = bindable(driver, host) | {"previous_force": None}
    force = run(driver, arrays).force
    nodes = host.arrays["secondary_node"].copy()
    order = np.array([3, 0, 7])
    newcomer = np.setdiff1d(np.arange(1, ee.SECONDARY_NODES + 1), nodes)[0]
    host.arrays["secondary_node"][:4] = [*nodes[order], newcomer]
    driver.points = 4
    second = run(driver, {}).force
    previous = np.column_stack([force[:, order], np.zeros(3)])
    previous = np.column_stack([previous, np.zeros((3, 5))])
    expected = host.local(previous)[:, :4]
    np.testing.assert_allclose(made.checked_calls()[-1]["fTangPrev"], expected, atol=1e-13)
    host.arrays["secondary_node"][:4] = nodes[:4]  # nodes 0 and 3 were there, 1 and 2 were not
    run(driver, {})
    previous = np.zeros((3, 9))
    previous[:, 0], previous[:, 3] = second[:, 1], second[:, 0]
    expected = host.local(previous)[:, :4]
    np.testing.assert_allclose(made.checked_calls()[-1]["fTangPrev"], expected, atol=1e-13)


def test_previous_force_of_vfriction_stays_with_the_point(probe):
    host = ee.Host("vfriction", block=2)
    made = probe("full", "vfriction", act=answer)
    driver = usersub.ExplicitDriver(made.routine, host.scene())
    force = run(driver, bindable(driver, host) | {"previous_force": None}).force
    driver.points = 3
    force[:, :3] = run(driver, {}).force[:, :3]
    driver.points = 9
    made.calls.clear()
    run(driver, {})
    force[:, 3:] = 0.0  # these were open
    found = np.concatenate([call["fTangPrev"] for call in made.checked_calls()], axis=1)
    np.testing.assert_allclose(found, host.local(force), atol=1e-13)


@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
def test_dissipation(probe, interface):
    host = ee.Host(interface, settings={"dissipation": 1})
    made = probe("full", interface, act=answer)
    driver = usersub.ExplicitDriver(made.routine, host.scene())
    arrays = bindable(driver, host)
    wanted = -(expected_force(host) * host.arrays["slip_increment"]).sum()
    assert run(driver, arrays).dissipation == pytest.approx(wanted, rel=1e-12)
    assert run(driver, arrays).dissipation == pytest.approx(2 * wanted, rel=1e-12)
