# SPDX-License-Identifier: MIT
"""Lines of a routine's source around a place."""

from __future__ import annotations

from pathlib import Path

_AROUND = 4
_LARGEST = 4 << 20  # bytes; larger files are no source that somebody wrote


def split(where: str) -> tuple[str, int]:
    """File and line of "file:line"; line 0 if there is none."""
    name, _, line = where.rpartition(":")
    if name and line.isdecimal():
        return name, int(line)
    return where, 0


def excerpt(where: str, file: str) -> str:
    """The lines around a place, numbered, the line itself behind an arrow; "" if unknown.

    Args:
        where: "file:line".
        file: the routine's file, which `where` may name without its folder.
    """
    name, line = split(where)
    found = _find(name, file)
    if not line or found is None:
        return ""
    lines = found.read_text(encoding="utf-8", errors="replace").expandtabs(8).splitlines()
    if line > len(lines):
        return ""
    first, last = max(line - _AROUND, 1), min(line + _AROUND, len(lines))
    width = len(str(last))
    return "\n".join(
        f"{'->' if number == line else '  '} {number:>{width}} | {lines[number - 1]}"
        for number in range(first, last + 1)
    )


def _find(name: str, file: str) -> Path | None:
    places = [Path(name)]
    if file:
        places.insert(0, Path(file).parent / name)
        if Path(file).name == Path(name).name:
            places.insert(0, Path(file))
    for place in places:
        try:
            if place.is_file() and place.stat().st_size <= _LARGEST:
                return place
        except OSError:
            continue
    return None
