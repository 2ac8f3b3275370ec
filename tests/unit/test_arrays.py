# SPDX-License-Identifier: MIT
"""Arrays are bound as they are or refused; nothing is converted."""

from __future__ import annotations

import numpy as np
import pytest

from usersub import ports
from usersub.driver.arrays import Layout, ports_of, shape_of, sizes
from usersub.driver.scene import Scene
from usersub.errors import SceneError

POINTS = 5


def layout(precision: str = "double", **settings) -> Layout:
    scene = Scene(points=POINTS, dimension=3, nodes=11, precision=precision, **settings)
    return Layout("VFRICTION 'law'", "vfriction", "explicit", scene)


def test_every_symbol_has_a_size():
    assert set(sizes(Scene(), "vfric", "explicit")) == set(ports.DIMENSIONS)


@pytest.mark.parametrize("contact", ["node-to-facet", "edge-to-edge", "analytical-rigid"])
def test_sizes_by_contact(contact):
    size = sizes(Scene(points=POINTS, dimension=3, contact=contact), "vfriction", "explicit")
    expected = {
        "node-to-facet": {"A": POINTS, "B": 1, "M": 4, "T": 1},
        "edge-to-edge": {"A": POINTS, "B": 2, "M": 2, "T": 4},
        "analytical-rigid": {"A": 1, "B": 1, "M": 1, "T": 1},
    }[contact]
    assert {symbol: size[symbol] for symbol in expected} == expected


def test_numbers_in_shapes():
    port = ports_of("fric", "standard")["rotation"]
    assert shape_of(port, sizes(Scene(points=POINTS), "fric", "standard")) == (2, 2, POINTS)


def test_good_arrays_pass():
    check = layout()
    check.check("normal", np.zeros((3, POINTS), order="F"))
    check.check("normal", np.zeros((POINTS, 3)).T)
    check.check("main_node", np.zeros((4, POINTS), np.int32, order="F"))
    layout("single").check("normal_force", np.zeros(POINTS, np.float32))


def read_only() -> np.ndarray:
    array = np.zeros((3, POINTS), order="F")
    array.flags.writeable = False
    return array


@pytest.mark.parametrize(
    ("name", "array", "words"),
    [
        ("normal", [[0.0] * POINTS] * 3, ["'normal'", "list", "float64", "(3, 5)"]),
        ("normal", np.zeros((3, POINTS), np.float32, order="F"), ["float32", "float64", "single"]),
        ("normal", np.zeros((3, POINTS), np.int64, order="F"), ["int64", "float64"]),
        ("normal", np.zeros((POINTS, 3)), ["(5, 3)", "(3, 5)", "(D,N)", "'.T'"]),
        ("normal", np.zeros((3, POINTS + 1), order="F"), ["(3, 6)", "(3, 5)"]),
        ("normal", np.zeros((3, POINTS)), ["'normal'", "Fortran", "order='F'", "'.T'"]),
        ("normal", np.zeros((6, POINTS), order="F")[::2], ["Fortran", "asfortranarray"]),
        ("normal_force", np.zeros(2 * POINTS)[::2], ["'normal_force'", "Fortran"]),
        ("main_node", np.zeros((4, POINTS), order="F"), ["'main_node'", "float64", "int32"]),
        ("force", read_only(), ["'force'", "read-only"]),
        ("state", np.zeros((0, 1, POINTS), order="F"), ["'state'", "driver.state['state']"]),
        ("normals", np.zeros((3, POINTS), order="F"), ["'normals'", "did you mean 'normal'"]),
    ],
)
def test_refusals(name, array, words):
    with pytest.raises(SceneError) as caught:
        layout().check(name, array)
    for word in words:
        assert word in str(caught.value)


def test_unaligned_memory_is_refused():
    raw = np.zeros(POINTS * 8 + 1, np.uint8)
    with pytest.raises(SceneError, match="'normal_force' is not aligned"):
        layout().check("normal_force", raw[1:].view(np.float64))


def test_inputs_may_be_read_only_and_shared():
    check = layout()
    check.check("normal", read_only())
    array = np.zeros(POINTS)
    check.check_overlaps({"normal_force": array, "stick_force": array})


def test_written_arrays_must_not_share_memory():
    memory = np.zeros((3, POINTS + 1), order="F")
    bound = {"force": memory[:, 1:], "normal": memory[:, :-1]}
    with pytest.raises(SceneError, match="'force' and 'normal' share memory"):
        layout().check_overlaps(bound)
