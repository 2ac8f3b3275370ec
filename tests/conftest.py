# SPDX-License-Identifier: MIT
"""Fixtures of all tests. A missing tool skips with a reason; USERSUB_FORBID_SKIPS=1 forbids that."""

from __future__ import annotations

import os
import shutil

import pytest
from hypothesis import settings

# Shared machines make deadlines a source of noise; a failing example is printed with its blob.
settings.register_profile("usersub", deadline=None, print_blob=True, max_examples=50)
settings.load_profile("usersub")

_NO_FORTRAN = "gfortran is missing; install it, for example with `apt-get install gfortran`"


def _forbid_skips() -> bool:
    return os.environ.get("USERSUB_FORBID_SKIPS", "") not in ("", "0")


@pytest.fixture(scope="session")
def fortran() -> str:
    """Path of gfortran; skips the test where there is none."""
    found = shutil.which("gfortran")
    if found is None:
        pytest.skip(_NO_FORTRAN)
    return found


@pytest.fixture(autouse=True, scope="session")
def _own_cache(tmp_path_factory: pytest.TempPathFactory):
    """Keeps compiled user code of the tests out of the user's cache."""
    folder = tmp_path_factory.mktemp("usersub-cache")
    before = os.environ.get("USERSUB_CACHE")
    os.environ.setdefault("USERSUB_CACHE", str(folder))
    yield
    if before is None:
        del os.environ["USERSUB_CACHE"]


def pytest_runtest_setup(item: pytest.Item) -> None:
    if item.get_closest_marker("needs_fortran") and shutil.which("gfortran") is None:
        pytest.skip(_NO_FORTRAN)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo):
    report = yield
    return _refuse_skip(report, item.nodeid)


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector: pytest.Collector):
    report = yield
    return _refuse_skip(report, collector.nodeid)


def _refuse_skip(report, where: str):
    """Turns a skip into a failure where skips are forbidden; an expected failure is no skip."""
    if _forbid_skips() and report.skipped and not hasattr(report, "wasxfail"):
        reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else report.longrepr
        report.outcome = "failed"
        report.longrepr = f"{where} was skipped where skips are forbidden: {reason}"
    return report
