# SPDX-License-Identifier: MIT
"""Scenes refuse what is wrong with one sentence that names the setting and its value."""

from __future__ import annotations

import inspect
import pickle

import numpy as np
import pytest

from usersub import ports
from usersub.driver.scene import Scene
from usersub.errors import SceneError


def test_defaults_are_those_of_the_table():
    scene = Scene()
    assert dict(scene) == {s.key: s.default for s in ports.SETTINGS}
    assert scene.props == ()


def test_settings_are_attributes_and_keys():
    scene = Scene(
        points=7, dimension=2, slip_tolerance=0.01, contact="edge-to-edge", props=[1, 2.5]
    )
    assert (scene.points, scene["dimension"], scene.slip_tolerance) == (7, 2, 0.01)
    assert scene.props == (1.0, 2.5)
    assert repr(scene) == (
        "Scene(points=7, dimension=2, contact='edge-to-edge', slip_tolerance=0.01, "
        "props=[1.0, 2.5])"
    )


def test_signature_lists_every_setting():
    assert set(inspect.signature(Scene).parameters) == {s.key for s in ports.SETTINGS} | {"props"}


def test_numpy_numbers_are_numbers():
    scene = Scene(points=np.int64(3), elastic_slip=np.float32(0.5), props=np.array([1.0, 2.0]))
    assert scene.points == 3 and type(scene.points) is int
    assert scene.elastic_slip == 0.5 and scene.props == (1.0, 2.0)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"dimensions": 3}, ["dimensions", "did you mean 'dimension'"]),
        ({"points": 3.0}, ["points", "3.0", "integer"]),
        ({"points": "3"}, ["points", "'3'", "integer"]),
        ({"points": True}, ["points", "True", "integer"]),
        ({"points": -1}, ["points", "-1"]),
        ({"states": 2**31}, ["states", str(2**31)]),
        ({"elastic_slip": float("nan")}, ["elastic_slip", "nan"]),
        ({"shear_limit": -2.0}, ["shear_limit", "-2.0"]),
        ({"elastic_slip": "small"}, ["elastic_slip", "'small'", "real number"]),
        ({"precision": "doubel"}, ["precision", "'doubel'", "did you mean 'double'"]),
        ({"contact": 3}, ["contact", "3", "text"]),
        ({"interaction": "x" * 81}, ["interaction", "81", "80"]),
        ({"main": "größe"}, ["main", "ASCII"]),
        ({"props": [1.0, float("nan")]}, ["props[1]", "NaN"]),
        ({"props": [1.0, "2"]}, ["props[1]", "'2'"]),
        ({"props": 3.0}, ["props", "3.0", "sequence"]),
        ({"props": "12"}, ["props", "sequence"]),
    ],
)
def test_refusals(settings, words):
    with pytest.raises(SceneError) as caught:
        Scene(**settings)
    for word in words:
        assert word in str(caught.value)


def test_scene_cannot_be_changed_but_replaced():
    scene = Scene(points=4, props=[1.0])
    with pytest.raises(AttributeError, match=r"scene\.replace\(points=\.\.\.\)"):
        scene.points = 5
    with pytest.raises(AttributeError, match="did you mean 'points'"):
        scene.point  # noqa: B018
    other = scene.replace(points=5, props=[2.0])
    assert (scene.points, other.points, other.props) == (4, 5, (2.0,))


def test_equality_hash_and_pickle():
    scene = Scene(points=4, props=[1.0])
    assert scene == Scene(props=(1.0,), points=4)
    assert scene != Scene(points=4)
    assert len({scene, Scene(points=4, props=[1.0]), Scene()}) == 2
    assert pickle.loads(pickle.dumps(scene)) == scene
