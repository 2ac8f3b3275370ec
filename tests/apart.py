# SPDX-License-Identifier: MIT
"""Work in a small process of its own.

The rules of `usersub check` run in children of the process that asks. A test process that has
imported and compiled a lot takes many times as long to make one.
"""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from itertools import count
from pathlib import Path
from typing import Any, TypeVar

T = TypeVar("T")

#: Tasks after which a process, which has then grown as well, makes room for another.
_TASKS = 8


@cache
def _pool(number: int) -> ProcessPoolExecutor:
    if number:
        _pool(number - 1).shutdown()
    return ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn"))


_tasks = count()


def run(work: Callable[..., T], *args: Any, **options: Any) -> T:
    """What `work` returns, or raises, in the working directory and with the variables of the
    environment that are set here."""
    pool = _pool(next(_tasks) // _TASKS)
    return pool.submit(_there, Path.cwd(), dict(os.environ), work, args, options).result()


def _there(
    folder: Path,
    environment: dict[str, str],
    work: Callable[..., T],
    args: tuple[Any, ...],
    options: dict[str, Any],
) -> T:
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    return work(*args, **options)
