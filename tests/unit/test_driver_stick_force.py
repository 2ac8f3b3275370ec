# SPDX-License-Identifier: MIT
"""The numpy face of the stick forces."""

from __future__ import annotations

import numpy as np
import pytest

import usersub
from usersub.errors import SceneError

POINTS = 6


def arrays(dimension: int, dtype) -> tuple[np.ndarray, ...]:
    generator = np.random.default_rng(4)
    vectors = [generator.normal(size=(dimension, POINTS)) for _ in range(3)]
    vectors[0] /= np.linalg.norm(vectors[0], axis=0)
    scalars = generator.uniform(1.0, 3.0, POINTS)
    return *(np.asfortranarray(v.astype(dtype)) for v in vectors), scalars.astype(dtype)


def tangential(vector: np.ndarray, normal: np.ndarray) -> np.ndarray:
    return vector - normal * (vector * normal).sum(axis=0)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_values(dimension, dtype):
    normal, velocity, force, mass = arrays(dimension, dtype)
    tolerance = {"rtol": 20 * np.finfo(dtype).eps}
    found = usersub.stick_force_kinematic(velocity, normal, mass, 0.125)
    expected = mass * np.linalg.norm(tangential(velocity, normal), axis=0) / 0.125
    np.testing.assert_allclose(found, expected, **tolerance)
    assert found.dtype == dtype

    previous = np.asfortranarray(tangential(force, normal))
    out = np.empty(POINTS, dtype)
    assert usersub.stick_force_penalty(previous, velocity, normal, mass, out=out) is out
    trial = previous - mass * tangential(velocity, normal)
    np.testing.assert_allclose(out, np.linalg.norm(trial, axis=0), **tolerance)


def test_refusals():
    normal, velocity, force, mass = arrays(3, np.float64)
    kinematic, penalty = usersub.stick_force_kinematic, usersub.stick_force_penalty
    with pytest.raises(SceneError, match="normal is float32 of shape"):
        kinematic(velocity, normal.astype(np.float32, order="F"), mass, 0.1)
    with pytest.raises(SceneError, match="mass is float64 of shape"):
        kinematic(velocity, normal, mass[:-1].copy(), 0.1)
    with pytest.raises(SceneError, match="velocity is list"):
        kinematic([[0.0]], normal, mass, 0.1)
    with pytest.raises(SceneError, match="velocity is not Fortran"):
        kinematic(np.ascontiguousarray(velocity), normal, mass, 0.1)
    with pytest.raises(SceneError, match="previous_force has dtype int64"):
        penalty(np.zeros((3, POINTS), np.int64), velocity, normal, mass)
    with pytest.raises(SceneError, match="time_increment = 0"):
        kinematic(velocity, normal, mass, 0.0)
    with pytest.raises(SceneError, match="2 or 3 dimensions"):
        penalty(*(np.ones((4, POINTS), order="F") for _ in range(3)), mass)
    frozen = np.empty(POINTS)
    frozen.flags.writeable = False
    with pytest.raises(SceneError, match="out is read-only"):
        penalty(force, velocity, normal, mass, out=frozen)
