# SPDX-License-Identifier: MIT
"""The cache of compiled user code: content-addressed, private to the user.

A file is named by the hash of everything that makes it (compiler version, flags, source with its
include files), because a loaded library is known to the process by its path. Files are written
under a temporary name and moved into place, so that processes may share the folder.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from usersub.errors import LoadError

#: Environment variable that names another folder.
VARIABLE = "USERSUB_CACHE"


def _default() -> Path:
    try:
        from platformdirs import user_cache_dir
    except ImportError:
        base = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
        return Path(base) / "usersub"
    return Path(user_cache_dir("usersub"))


def folder() -> Path:
    """The cache folder, made with mode 0700 if it is not there.

    Raises:
        LoadError: it cannot be made, or somebody else could put code into it.
    """
    path = Path(os.environ.get(VARIABLE) or _default()).expanduser().absolute()
    try:
        path.mkdir(parents=True, mode=0o700, exist_ok=True)
        found = path.stat()
    except OSError as error:
        raise LoadError(
            f"the cache folder {path} cannot be made ({error.strerror}); "
            f"set {VARIABLE} to a folder that can be written"
        ) from error
    if hasattr(os, "getuid") and found.st_uid != os.getuid():
        raise LoadError(
            f"the cache folder {path} belongs to user {found.st_uid}, expected {os.getuid()}; "
            f"set {VARIABLE} to a folder of your own"
        )
    if found.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
        raise LoadError(
            f"the cache folder {path} can be written by others (mode {found.st_mode & 0o777:o}), "
            f"expected 700; run `chmod 700 {path}`"
        )
    return path


def key(*parts: str | bytes) -> str:
    """Hash of `parts` (20 hexadecimal digits); their lengths count, so that none can run over."""
    digest = hashlib.sha256()
    for part in parts:
        data = part.encode("utf-8", "surrogateescape") if isinstance(part, str) else part
        digest.update(b"%d:" % len(data))
        digest.update(data)
    return digest.hexdigest()[:20]


def path(stem: str, digest: str, suffix: str) -> Path:
    """Where the file of this content lies; `stem` is for people who look into the folder."""
    plain = "".join(c if c.isascii() and (c.isalnum() or c in "-_") else "_" for c in stem)[:40]
    return folder() / f"{plain or 'code'}-{digest}{suffix}"


@contextmanager
def build_folder() -> Iterator[Path]:
    """A fresh folder inside the cache (so that a move is one rename), removed at the end."""
    home = folder()
    try:
        made = Path(tempfile.mkdtemp(prefix="build-", dir=home))
    except OSError as error:
        raise LoadError(
            f"the cache folder {home} cannot be written ({error.strerror}); "
            f"set {VARIABLE} to a folder that can be written"
        ) from error
    try:
        yield made
    finally:
        shutil.rmtree(made, ignore_errors=True)


def put(made: Path, target: Path) -> Path:
    """Moves the finished file `made` to its place; an equal file of another process may win."""
    os.chmod(made, 0o700 if target.suffix != ".json" else 0o600)
    os.replace(made, target)
    return target


def put_text(text: str, target: Path) -> Path:
    """Writes `text` to its place in one step."""
    handle, name = tempfile.mkstemp(prefix="text-", dir=target.parent)
    with os.fdopen(handle, "w", encoding="utf-8") as file:
        file.write(text)
    return put(Path(name), target)
