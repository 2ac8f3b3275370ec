# SPDX-License-Identifier: MIT
"""Machine and versions: once for a study, since times mean nothing without them."""

from __future__ import annotations

import os
import platform
from functools import cache
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as installed
from pathlib import Path

from usersub.errors import MissingTool


@cache
def version(package: str = "usersub") -> str:
    """Release of an installed package; "not installed"."""
    try:
        return installed(package)
    except PackageNotFoundError:
        return "not installed"


@cache
def machine() -> str:
    """Processor, cores that this process may use, operating system."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    words = f"{cores} core{'' if cores == 1 else 's'}"
    return f"{_processor()}, {words}, {platform.system()} {platform.machine()}"


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or "unknown processor"


@cache
def compiler(language: str) -> str:
    """The compiler of "c" or "fortran", in its own words; "not installed"."""
    from usersub.routine import compilers

    try:
        return compilers.find(language).version
    except MissingTool:
        return "not installed"


def versions() -> dict[str, str]:
    """Versions of what a study is made with."""
    found = {"usersub": version(), "Python": platform.python_version()}
    found |= {name: version(name) for name in ("numpy", "numba")}
    return found | {"C compiler": compiler("c"), "Fortran compiler": compiler("fortran")}


def stamp() -> dict[str, str]:
    """Machine and versions, in words."""
    return {"machine": machine(), **versions()}
