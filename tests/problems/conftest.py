# SPDX-License-Identifier: MIT
"""Parameters and shared runs of the tests of laws and problems."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator

import pytest

from usersub.problems import Case, Outcome

#: The three languages; Fortran skips where there is no compiler.
LANGUAGES = [
    "python",
    "c",
    pytest.param("fortran", marks=pytest.mark.needs_fortran),
]


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    if "language" in metafunc.fixturenames:
        metafunc.parametrize("language", LANGUAGES)


#: Compiles the Python laws into the cache, those first that the tests come to last.
_COMPILE = """
from usersub import laws
for law in reversed(list(laws.LAWS.values())):
    for interface in law.interfaces:
        for precision in ("double", "single") if interface.startswith("v") else ("double",):
            laws.routine(law.name, interface).entry(precision)
"""

#: Tests from which on a second process is worth its start.
_MANY = 200


@pytest.fixture(scope="session", autouse=True)
def _compiled_ahead(request: pytest.FixtureRequest, _own_cache: None) -> Iterator[None]:
    """Has a second processor compile while the first one tests; the tests do not rely on it."""
    if len(request.session.items) < _MANY:
        yield
        return
    with subprocess.Popen([sys.executable, "-c", _COMPILE], stderr=subprocess.DEVNULL) as process:
        yield
        process.kill()


@pytest.fixture(scope="session")
def outcome_of() -> Callable[[Case], Outcome]:
    """Runs a case, or recalls its outcome."""
    known: dict[tuple[str, ...], Outcome] = {}

    def run(case: Case) -> Outcome:
        assert not case.options
        key = (case.problem, case.law, case.interface, case.language, case.precision, case.method)
        if key not in known:
            known[key] = case.run()
        return known[key]

    return run
