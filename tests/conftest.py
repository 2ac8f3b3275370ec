# SPDX-License-Identifier: MIT
"""Fixtures of all tests. A missing tool skips, with a reason; USERSUB_FORBID_SKIPS=1 forbids it."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal

import mpmath
import pytest
from hypothesis import settings

# Shared machines make deadlines a source of noise; a failing example is printed with its blob.
settings.register_profile("usersub", deadline=None, print_blob=True, max_examples=50)
settings.load_profile("usersub")

_NO_FORTRAN = "gfortran is missing; install it, for example with `apt-get install gfortran`"

#: Digits of every truth, once: a module that set its own would change those of the others.
mpmath.mp.dps = 60

# A shell without job control starts programs in the background with Ctrl-C ignored, and what they
# start inherits that: tests of interruption would wait for ever.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    with contextlib.suppress(ValueError):  # not the main thread
        signal.signal(signal.SIGINT, signal.default_int_handler)


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
    folder = _shared_folder(tmp_path_factory)
    before = os.environ.get("USERSUB_CACHE")
    os.environ.setdefault("USERSUB_CACHE", str(folder))
    yield
    if before is None:
        del os.environ["USERSUB_CACHE"]


def _shared_folder(tmp_path_factory: pytest.TempPathFactory):
    """One folder for all processes of a run in parallel (pytest -n)."""
    if "PYTEST_XDIST_WORKER" not in os.environ:
        return tmp_path_factory.mktemp("usersub-cache")
    return tmp_path_factory.getbasetemp().parent / "usersub-cache"


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


@pytest.fixture(scope="session")
def c_routine(tmp_path_factory: pytest.TempPathFactory):
    """Makes a Routine of C source with one interface function in it, by plain `cc`.

    Independent of usersub's own way of compiling user code, so that the tests of the drivers do not
    depend on it. The libraries stay loaded.
    """
    made: dict[tuple, object] = {}

    def make(interface: str, source: str, *, generation=None, precision="double", **more):
        key = (interface, source, generation, precision, tuple(sorted(more.items())))
        if key not in made:
            folder = tmp_path_factory.mktemp("c_routine")
            made[key] = _compiled(folder, interface, source, generation, precision, more)
        return made[key]

    return make


def _compiled(folder, interface, source, generation, precision, more):
    import ctypes
    import subprocess

    from usersub import abi, paths
    from usersub.routine.routine import FULL, Entry, Routine

    if shutil.which("cc") is None:
        pytest.skip("a C compiler is missing; install it, for example with `apt-get install gcc`")
    (folder / "routine.c").write_text(source)
    command = ["cc", "-O2", "-fPIC", "-shared", f"-I{paths.include_folder()}", "routine.c"]
    link = [f"-L{paths.library_path().parent}", "-lusersub", "-lm"]
    subprocess.run([*command, "-o", "routine.so", *link], cwd=folder, check=True)
    face = abi.interface(interface, generation)
    library = ctypes.CDLL(str(folder / "routine.so"))
    address = ctypes.cast(getattr(library, face.symbol), ctypes.c_void_p).value
    entry = Entry(address, FULL, library)

    def make_entry(asked: str) -> Entry:
        assert asked == precision, f"made in {precision} precision, asked for {asked}"
        return entry

    return Routine(face, "c", "routine.c", str(folder), make_entry, **more)
