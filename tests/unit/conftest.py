# SPDX-License-Identifier: MIT
"""Fixtures of the unit tests."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

_ROOT = Path(__file__).resolve().parents[2]

# pytest imports test modules by path and leaves sys.path alone.
sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(scope="session")
def enforcement(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    """What of the C core needs nothing else (axes, enforcement, stick forces), compiled."""
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        pytest.skip("a C compiler is missing; install one, for example with `apt-get install gcc`")
    library = tmp_path_factory.mktemp("enforcement") / "libenforcement.so"
    sources = [
        _ROOT / "csrc/driver/trial.c",
        _ROOT / "csrc/driver/penalty.c",
        _ROOT / "csrc/driver/lagrange.c",
        _ROOT / "csrc/driver/stick_force.c",
        _ROOT / "tests/unit/native/axes.c",
    ]
    subprocess.run(
        [compiler, "-std=c11", "-D_GNU_SOURCE", "-O2", "-ffp-contract=off", "-fPIC", "-shared"]
        + ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
        + [f"-I{_ROOT / 'csrc/include'}", f"-I{_ROOT / 'csrc/driver'}"]
        + [*map(str, sources), "-o", str(library), "-lm"],
        check=True,
    )
    return ctypes.CDLL(str(library))
