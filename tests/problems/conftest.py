# SPDX-License-Identifier: MIT
"""Parameters of the tests of laws and problems."""

from __future__ import annotations

import pytest

#: The three languages; Fortran skips where there is no compiler.
LANGUAGES = [
    "python",
    "c",
    pytest.param("fortran", marks=pytest.mark.needs_fortran),
]


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    if "language" in metafunc.fixturenames:
        metafunc.parametrize("language", LANGUAGES)
