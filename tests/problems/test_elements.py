# SPDX-License-Identifier: MIT
"""Meshes of the finite-element block: mass, rigid motion, linear fields, hourglass modes."""

from __future__ import annotations

import numpy as np
import pytest

from usersub.problems.block import Block
from usersub.problems.elements import hexahedra, triangles

BLOCK = Block(length=3.0, width=0.7, height=1.3, density=2.0, young=50.0, poisson=0.27)


@pytest.mark.parametrize(("make", "rigid"), [(triangles, 3), (hexahedra, 6)])
def test_mass_area_load_and_rigid_motions(make, rigid):
    mesh = make(BLOCK)
    assert mesh.mass.sum() == pytest.approx(BLOCK.mass, rel=1e-14)
    assert mesh.area.sum() == pytest.approx(BLOCK.area, rel=1e-14)
    assert mesh.top_load.sum() == pytest.approx(1.0, rel=1e-14)
    assert not mesh.top_load[mesh.bottom].any()
    stiffness = mesh.stiffness
    assert stiffness == pytest.approx(stiffness.T, abs=1e-12 * np.abs(stiffness).max())
    values = np.linalg.eigvalsh(stiffness)
    # Nothing but rigid motions is free: no hourglass mode has zero energy.
    assert np.sum(np.abs(values) < 1e-10 * values[-1]) == rigid
    assert values[0] > -1e-10 * values[-1]


@pytest.mark.parametrize("make", [triangles, hexahedra])
def test_linear_field_has_the_energy_of_elasticity(make):
    mesh = make(BLOCK)
    d = mesh.coordinates.shape[1]
    rng = np.random.default_rng(20240229)
    gradient = rng.normal(size=(d, d))
    strain = np.zeros((3, 3))
    strain[:d, :d] = 0.5 * (gradient + gradient.T)
    lame = BLOCK.young * BLOCK.poisson / ((1 + BLOCK.poisson) * (1 - 2 * BLOCK.poisson))
    shear = BLOCK.young / (2 * (1 + BLOCK.poisson))
    density = 0.5 * lame * np.trace(strain) ** 2 + shear * (strain**2).sum()
    u = (mesh.coordinates @ gradient.T).ravel()
    volume = BLOCK.area * BLOCK.height
    assert 0.5 * u @ mesh.stiffness @ u == pytest.approx(density * volume, rel=1e-12)
