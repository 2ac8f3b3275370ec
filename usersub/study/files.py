# SPDX-License-Identifier: MIT
"""Files of user code in a study: what they hold, and whether they have changed."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from pathlib import Path

from usersub.errors import LoadError


@lru_cache(maxsize=8)
def _loaded(path: str, content: str) -> tuple[str, tuple[str, ...]]:
    from usersub.routine.loading import load

    file = load(path)
    return file.language, tuple(file)


def routine_file(path: str) -> tuple[str, tuple[str, ...], str]:
    """Language and interfaces of a file of user code, and a hash of its content.

    Raises:
        LoadError, CompileError, MissingTool: it cannot be loaded.
    """
    content = content_of(path)
    return (*_loaded(path, content), content)


def content_of(path: str) -> str:
    """A hash of a file, by which a changed one is told.

    Raises:
        LoadError: there is no such file.
    """
    if not Path(path).is_file():
        raise LoadError(f"there is no file {path}")
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()[:20]
