# SPDX-License-Identifier: MIT
"""The tests of the laws: parameters, compilation ahead, table of measured accuracy."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

# pytest imports test modules by path and leaves sys.path alone.
sys.path.insert(0, str(Path(__file__).parent))

import law_cases


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    if "language" in metafunc.fixturenames:
        metafunc.parametrize("language", law_cases.LANGUAGES)


#: Compiles laws into the cache, those first that the tests come to last.
_COMPILE = """
import sys
from usersub import abi, laws
names = sys.argv[1:]
for name in reversed(names):
    for language in reversed(laws.LANGUAGES):
        for precision in ("single", "double"):
            try:
                file = laws.load(name, language, precision=precision)
                for interface in file:
                    if precision in abi.interface(interface).precisions:
                        file[interface].entry(precision)
            except Exception as error:
                pass  # a test will say it
"""
#: Tests of laws from which on a second process is worth its start.
_MANY = 100


@pytest.fixture(scope="session", autouse=True)
def _compiled_ahead(request: pytest.FixtureRequest, _own_cache: None) -> Iterator[None]:
    """Has a second processor compile while the first one tests; the tests do not rely on it."""
    items = [i for i in request.session.items if "tests/laws/" in i.nodeid]
    names = [n for n in law_cases.names() if any(n in i.nodeid for i in items)]
    if len(items) < _MANY:
        yield
        return
    command = [sys.executable, "-c", _COMPILE, *names]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL) as process:
        yield
        process.kill()


def pytest_terminal_summary(terminalreporter, config: pytest.Config) -> None:
    """Prints the largest errors with -v."""
    if config.option.verbose < 1 or not law_cases.SEEN:
        return
    terminalreporter.section("largest error of values in units in the last place")
    rows: dict[tuple[str, str], dict[str, float]] = {}
    for (law, _, precision, language), units in law_cases.SEEN.items():
        row = rows.setdefault((law, precision), {})
        row[language] = max(row.get(language, 0.0), units)
    for (law, precision), row in rows.items():
        cells = ", ".join(f"{language} {units:.2f}" for language, units in row.items())
        terminalreporter.line(f"{law} {precision}: {cells}")
