# SPDX-License-Identifier: MIT
"""Parameters and shared runs of the tests of laws and problems."""

from __future__ import annotations

from collections.abc import Callable

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
