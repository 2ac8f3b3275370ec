# SPDX-License-Identifier: MIT
"""The record of table versions: a changed table without a new line is an error."""

from __future__ import annotations

from pathlib import Path

from usersub import abi

RECORD = Path(__file__).resolve().parents[1] / "abi_versions.txt"


def recorded(path: Path = RECORD) -> dict[int, str]:
    """Hash by version, as recorded."""
    rows = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.partition("#")[0].split()
        if words:
            rows[int(words[0])] = words[1]
    return rows


def problems(path: Path = RECORD) -> list[str]:
    """What is wrong with the record; [] if it fits the tables."""
    rows = recorded(path)
    there = rows.get(abi.ABI_VERSION)
    if there != abi.abi_hash():
        return [
            f"{path.name}: version {abi.ABI_VERSION} is recorded as {there}, but the tables have "
            f"hash {abi.abi_hash()}; raise abi.ABI_VERSION and add a line that says what changed"
        ]
    if max(rows) != abi.ABI_VERSION:
        return [f"{path.name}: newest line is {max(rows)}, abi.ABI_VERSION is {abi.ABI_VERSION}"]
    return []
