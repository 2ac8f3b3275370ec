# SPDX-License-Identifier: MIT
"""The tests of the C engine share modules that lie beside them."""

from __future__ import annotations

import ctypes
import subprocess
import sys
from pathlib import Path

import pytest

# pytest imports test modules by path and leaves sys.path alone.
sys.path.insert(0, str(Path(__file__).parent))

import engine_tables

_SOURCE = """\
#include <stddef.h>
void (*hook)(void **, size_t *);
void {symbol}({parameters}, size_t l0, size_t l1, size_t l2) {{
  void *argv[] = {{{names}}};
  size_t lengths[] = {{l0, l1, l2}};
  hook(argv, lengths);
}}
"""


@pytest.fixture(scope="session")
def full_probe_library(tmp_path_factory: pytest.TempPathFactory):
    """Compiled routines with the published argument list that hand their addresses to `hook`."""
    made: dict[str, ctypes.CDLL] = {}

    def make(interface: str) -> ctypes.CDLL:
        if interface not in made:
            count = len(engine_tables.rows(interface))
            names = ", ".join(f"a{i}" for i in range(count))
            source = _SOURCE.format(
                symbol=f"{interface}_",
                names=names,
                parameters="void *" + names.replace(" ", " void *"),
            )
            folder = tmp_path_factory.mktemp("probe")
            (folder / "probe.c").write_text(source)
            command = ["cc", "-shared", "-fPIC", "-o", "probe.so", "probe.c"]
            subprocess.run(command, cwd=folder, check=True)
            made[interface] = ctypes.CDLL(str(folder / "probe.so"))
        return made[interface]

    return make


@pytest.fixture
def probe(full_probe_library):
    """Makes a recording routine: `probe(style, interface, ...)`, see `engine_probe.make_probe`."""
    from engine_probe import make_probe

    alive = []  # C code has no reference to the callbacks

    def make(style: str, interface: str, **options):
        library = full_probe_library(interface) if style == "full" else None
        alive.append(make_probe(style, interface, library=library, **options))
        return alive[-1]

    return make
