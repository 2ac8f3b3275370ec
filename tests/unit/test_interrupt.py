# SPDX-License-Identifier: MIT
"""Ctrl-C ends the command line, even where a routine never returns."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time

import pytest

from usersub.cli.interrupt import INTERRUPTED

SCENE = """
routine = "law.{suffix}"
props = [0.3]
[history]
time = [0.0, 1.0]
slip = [[0.0, 0.0], [0.01, 0.0]]
normal_force = 10.0
"""
PYTHON = """
import pathlib
import usersub

pathlib.Path("begun").touch()


@usersub.vfric_coef(compiled=False)
def law(fCoef):
    while fCoef[0] < 1.0:
        fCoef[0] = 0.0
"""
C = """
#include <stdio.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  fclose(fopen("begun", "w"));
  for (volatile int k = 0; fCoef[0] < 1.0; k = 0)
    fCoef[k] = 0.0;
}
"""


@pytest.mark.parametrize(
    ("suffix", "code", "exit_code", "words"),
    [
        # The interpreter comes between two instructions: click says that it was interrupted.
        ("py", PYTHON, 1, "Aborted!"),
        ("c", C, INTERRUPTED, "interrupted in a routine that does not return"),
    ],
)
def test_interrupt(tmp_path, suffix, code, exit_code, words):
    (tmp_path / f"law.{suffix}").write_text(code)
    (tmp_path / "scene.toml").write_text(SCENE.format(suffix=suffix))
    process = subprocess.Popen(
        [sys.executable, "-m", "usersub", "run", "scene.toml"],
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )
    try:
        end = time.monotonic() + 60.0
        while not (tmp_path / "begun").exists() and process.poll() is None:
            assert time.monotonic() < end
            time.sleep(0.05)
        time.sleep(0.3)  # from loading the file into the endless loop
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60.0)
    finally:
        process.kill()
    assert (process.returncode, words in said) == (exit_code, True), said
