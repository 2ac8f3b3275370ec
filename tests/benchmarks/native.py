# SPDX-License-Identifier: MIT
"""Compiling what is measured beside the drivers: loops by hand in C and Fortran, and f2py."""

from __future__ import annotations

import ctypes
import importlib.util
import io
import subprocess
import sysconfig
from collections.abc import Sequence
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from types import ModuleType

import numpy as np

#: Flags of the loops by hand: those with which user code is compiled.
C_FLAGS = ("-O2", "-ffp-contract=off", "-fno-semantic-interposition")
#: The machine's own instructions and vector functions of the C library. Never for linking: with
#: -ffast-math there, gcc switches denormal numbers off for the whole process.
VECTOR_FLAGS = ("-O3", "-march=native", "-mprefer-vector-width=512", "-ffast-math")


def library(folder: Path, name: str, source: str, flags: Sequence[str] = C_FLAGS) -> ctypes.CDLL:
    """The compiled source as a library."""
    path = folder / name
    path.write_text(source)
    made = path.with_suffix(".o")
    compiler = "gfortran" if path.suffix in (".f", ".f90") else "gcc"
    subprocess.run([compiler, *flags, "-fPIC", "-c", "-o", made, path], check=True)
    target = folder / f"lib{path.stem}.so"
    subprocess.run([compiler, "-shared", "-o", target, made, "-lmvec", "-lm"], check=True)
    return ctypes.CDLL(str(target))


def f2py(folder: Path, name: str, source: str) -> ModuleType:
    """The Fortran source as a module of f2py, whose generated C is compiled here."""
    from numpy import f2py as tool

    path = folder / f"{name}.f90"
    path.write_text(source)
    build = folder / name
    build.mkdir()
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        tool.run_main([str(path), "-m", name, "--build-dir", str(build), "--lower"])
    home = Path(tool.__file__).parent / "src"
    includes = [f"-I{p}" for p in (np.get_include(), sysconfig.get_paths()["include"], home)]
    objects = []
    for file in (build / f"{name}module.c", home / "fortranobject.c"):
        objects.append(build / f"{file.stem}.o")
        command = ["gcc", "-O2", "-w", "-fPIC", *includes, "-c", file, "-o", objects[-1]]
        subprocess.run(command, check=True)
    objects.append(build / "law.o")
    subprocess.run(["gfortran", "-O2", "-fPIC", "-c", path, "-o", objects[-1]], check=True)
    target = build / f"{name}.so"
    subprocess.run(["gfortran", "-shared", "-o", target, *objects], check=True)
    spec = importlib.util.spec_from_file_location(name, target)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
