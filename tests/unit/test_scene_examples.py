# SPDX-License-Identifier: MIT
"""The scene files of `docs/examples` run, and each gives the number that it is there for."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from usersub.errors import SceneError
from usersub.scenefile import run_scene

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
NAMES = sorted(p.name for p in EXAMPLES.glob("*.toml"))


@pytest.fixture
def copied(tmp_path) -> Path:
    """The examples in a folder that may be written to."""
    for path in EXAMPLES.iterdir():
        if path.is_file():
            shutil.copy(path, tmp_path)
    return tmp_path


def decay(run) -> None:
    """Exponential decay at the two speeds of the first row: 200 and 100."""
    exact = 0.05 + 0.1 * np.exp(-0.01 * np.array([200.0, 100.0]))
    # 1e-6: single precision
    np.testing.assert_allclose(run.history.columns["mobilised"][0], exact, rtol=1e-6)
    assert run.written[0].name == "decay.npz"


def wear(run) -> None:
    """The coefficient follows the dissipated energy of the increment before."""
    state = run.history.columns["state"][:, 0]
    mu = 0.4 - 0.3 * np.exp(-state[-2, 0] / 20.0)
    np.testing.assert_allclose(run.history.columns["mobilised"][-1, 0], mu, rtol=1e-12)


def run_in(run) -> None:
    """The coefficient follows the slip so far, of which the elastic slip is no part."""
    state, tau = run.history.columns["state"][:, 0], run.history.columns["mobilised"][:, 0]
    mu = 0.3 - 0.2 * np.exp(-state[-1, 1] / 4.0)
    np.testing.assert_allclose(tau[-1], mu, rtol=1e-12)
    # 7 of motion, less the allowable elastic slip at first and twice that at each of the 3 turns.
    np.testing.assert_allclose(state[-1, 1], 7.0 - 0.005 * 7, rtol=1e-12)


def block(run) -> None:
    """The block stops when and where it should."""
    assert run.ok and run.problem[0].error <= run.problem[0].tolerance


CHECKS = {"decay.toml": decay, "wear.toml": wear, "run_in.toml": run_in, "block.toml": block}


@pytest.mark.parametrize("name", NAMES)
def test_example(name, copied):
    CHECKS[name](run_scene(copied / name))


def test_every_example_is_checked():
    assert set(NAMES) == set(CHECKS)


def test_vfric_coef_has_no_state_variables(tmp_path):
    file = tmp_path / "scene.toml"
    file.write_text(
        'routine = "coulomb"\ninterface = "vfric_coef"\nprops = [0.1]\n[scene]\nstates = 2\n'
        "[history]\ntime = [0, 1]\nslip = [[0, 0], [1, 0]]\npressure = 1.0\n"
    )
    with pytest.raises(SceneError, match="'states' = 2; expected 0"):
        run_scene(file)
