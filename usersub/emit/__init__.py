# SPDX-License-Identifier: MIT
"""Generators: everything that knows an argument, an array or a status, made from the tables.

Each module of this package that makes committed files has one function
`artefacts() -> dict[path, text]`. `python -m usersub.emit` writes them,
`python -m usersub.emit --check` compares and never repairs.
"""

from __future__ import annotations

import importlib

#: Modules that make committed files, in the order of writing.
GENERATORS = (
    "abi_header",
    "status_header",
    "core_tables",
    "calls",
    "probe",
    "fortran_module",
    "fortran_lists",
    "field_files",
    "reference",
    "law_readme",
    "rule_page",
)


def artefacts() -> dict[str, str]:
    """Every committed generated file: path below the root of the repository to text."""
    made: dict[str, str] = {}
    for name in GENERATORS:
        module = importlib.import_module(f"{__name__}.{name}")
        for path, text in module.artefacts().items():
            if path in made:
                raise RuntimeError(f"two generators make {path}")
            made[path] = text
    return made
