# SPDX-License-Identifier: MIT
"""Laws in Fortran behind VFRIC, VFRICTION and VFRIC_COEF; truth from mpmath."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import workdps

import usersub
from tests.unit import fortran_laws as model
from tests.unit.law_scenes import EXPLICIT, POINTS, expected, explicit
from usersub.errors import LoadError

pytestmark = pytest.mark.needs_fortran


@pytest.fixture(scope="module")
def files(tmp_path_factory, fortran):
    """Files of the laws: (name, differences, precision) to a loaded file."""
    folder, made = tmp_path_factory.mktemp("fortran-laws"), {}

    def get(name: str, differences: bool = False, precision: str = "double"):
        key = (name, differences, precision)
        if key not in made:
            path = folder / f"{name}{'_differences' * differences}.f90"
            path.write_text(model.LAWS[name].source(differences))
            made[key] = usersub.load(path, precision=precision)
        return made[key]

    return get


@pytest.fixture(autouse=True)
def _digits():
    with workdps(model.DIGITS):
        yield


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize(("interface", "contact", "dimension"), EXPLICIT)
@pytest.mark.parametrize("name", ["worn", "plain", "cohesive", "viscous", "spring"])
def test_explicit_forces_and_states(files, name, interface, contact, dimension, precision):
    if interface == "vfric_coef" and name != "plain":
        with pytest.raises(LoadError):
            files(name)[interface]
        return
    law = model.LAWS[name]
    tolerance = 1e-12 if precision == "double" else 2e-5
    seen = explicit(files(name, precision=precision)[interface], law, precision, contact, dimension)
    before = np.zeros((seen[0][2].shape[0], POINTS))
    for given, force, state in seen:
        nodes = state.reshape(state.shape[0], -1, POINTS) if state.size else state[:, None]
        assert (nodes == nodes[:, :1]).all()
        state = nodes[:, 0] if state.size else before
        for k in range(POINTS):
            if given["normal_force"][k] == 0:
                assert not force[:, k].any()
                np.testing.assert_array_equal(state[:, k], before[:, k])
                continue
            truth, end = expected(law, given, before[:, k], k, precision)
            truth = np.array(truth, float)
            scale = np.abs(truth).max()
            np.testing.assert_allclose(force[:, k], truth, rtol=0, atol=tolerance * scale)
            if interface != "vfric_coef":
                np.testing.assert_allclose(
                    state[:, k], np.array(end, float), rtol=tolerance, atol=tolerance * 0.05
                )
        before = state


def test_a_bristle_is_not_bounded_by_the_stick_force(files):
    """It brings its own stick, and pushes across the slip too."""
    seen = explicit(files("spring")["vfriction"], model.SPRING, "double")
    given, force, _ = seen[1]
    along = given["slip_increment"] / np.linalg.norm(given["slip_increment"], axis=0)
    assert -force[:, 2] @ along[:, 2] > given["stick_force"][2]
    across = force - along * np.einsum("ik,ik->k", force, along)
    assert np.linalg.norm(across, axis=0)[[0, 2, 3]].min() > 0.01
