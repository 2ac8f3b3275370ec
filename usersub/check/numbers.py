# SPDX-License-Identifier: MIT
"""Numbers as they are typed on a command line."""

from __future__ import annotations

from usersub.errors import SceneError


def numbers(option: str, text: str | None) -> tuple[float, ...] | None:
    """Numbers that are separated by commas or blanks; Fortran's `0.3D0` is one too.

    Raises:
        SceneError: one of the words is no number.
    """
    if text is None:
        return None
    found = []
    for word in _words(text):
        try:
            found.append(float(word.lower().replace("d", "e")))
        except ValueError:
            raise SceneError(f"{option} has '{word}', expected numbers as in 0.3,1e-4") from None
    return tuple(found)


def _words(text: str) -> list[str]:
    """What stands between the commas, or between blanks; nothing between two commas is a word."""
    if not text.strip():
        return []
    return [word for part in text.split(",") for word in (part.split() or [""])]


def integer(option: str, text: str | None) -> int | None:
    """A number that is not negative.

    Raises:
        SceneError: it is none.
    """
    if text is None:
        return None
    if not text.strip().isdecimal():
        raise SceneError(f"{option} is '{text}', expected a whole number that is not negative")
    return int(text)
