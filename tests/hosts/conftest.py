# SPDX-License-Identifier: MIT
"""An installed C core for the hosts, without Python."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

_ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session", autouse=True)
def _tools_of_the_environment():
    """CMake and ninja may come with the Python environment, whether or not it is activated."""
    before = os.environ["PATH"]
    os.environ["PATH"] = f"{before}{os.pathsep}{Path(sys.executable).parent}"
    yield
    os.environ["PATH"] = before


@pytest.fixture(scope="session")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The C core, built and installed by CMake alone, and moved to a folder with a blank in it."""
    for tool in ("cc", "cmake"):
        if shutil.which(tool) is None:
            pytest.skip(f"{tool} is missing; install it to build the example hosts")
    folder = tmp_path_factory.mktemp("core")
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    configure = ["cmake", "-S", _ROOT, "-B", folder / "build", "-DCMAKE_INSTALL_LIBDIR=lib"]
    for command in (
        [*configure, *generator],
        ["cmake", "--build", folder / "build", "--parallel", "2"],
        ["cmake", "--install", folder / "build", "--prefix", folder / "installed"],
    ):
        done = subprocess.run(command, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stdout + done.stderr
    return (folder / "installed").rename(folder / "moved and renamed")
