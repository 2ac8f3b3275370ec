# SPDX-License-Identifier: MIT
"""The C core, driven by a C host under the address and undefined-behaviour sanitizers."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror"]
SANITIZERS = ["-fsanitize=address,undefined", "-fno-sanitize-recover=undefined"]


def test_every_kind_of_driver_is_clean(tmp_path):
    """No warning, no bad address, no undefined behaviour, no leak in `native/engine_asan.c`."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("a C compiler is missing; install it, for example with `apt-get install gcc`")
    (tmp_path / "none.c").write_text("int main(void) { return 0; }\n")
    probe = [compiler, *SANITIZERS, "none.c", "-o", "none"]
    if subprocess.run(probe, cwd=tmp_path, capture_output=True).returncode != 0:
        pytest.skip("the compiler has no sanitizers; install libasan and libubsan")
    folders = ("driver", "runtime", "checked")
    sources = [path for folder in folders for path in (ROOT / "csrc" / folder).glob("*.c")]
    command = [
        compiler, "-std=gnu11", "-g", "-O1", "-ffp-contract=off", *WARNINGS, *SANITIZERS,
        "-D_GNU_SOURCE", '-DUSUB_RELEASE="0"', f"-I{ROOT / 'csrc/include'}",
        f"-I{ROOT / 'csrc/driver'}", "-rdynamic", "-o", "engine", *map(str, sources),
        str(ROOT / "tests/unit/native/engine_asan.c"), "-lm", "-ldl", "-lpthread",
    ]  # fmt: skip
    built = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert built.returncode == 0, built.stderr
    environment = {**os.environ, "UBSAN_OPTIONS": "print_stacktrace=1"}
    environment.pop("LD_PRELOAD", None)
    environment.pop("ASAN_OPTIONS", None)
    ran = subprocess.run(
        ["./engine"], cwd=tmp_path, env=environment, capture_output=True, text=True
    )
    assert (ran.returncode, ran.stdout) == (0, "ok\n"), ran.stderr
