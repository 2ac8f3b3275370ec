# SPDX-License-Identifier: MIT
"""The committed state of a driver: views, saving, loading."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from usersub.driver.base import Driver


class State(Mapping[str, np.ndarray]):
    """The committed state: a mapping from name to a view of the driver's own memory.

    Writing to a view sets initial conditions. Save between increments; the clock is saved too.
    """

    def __init__(self, driver: Driver) -> None:
        self._driver = driver
        # What only some settings need is not there without them.
        self._names = [
            name
            for name, port in driver.layout.ports.items()
            if port.role == "state" and driver.keeps(name)
        ]

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._names:
            raise KeyError(f"the state has no '{name}'; it has {', '.join(self._names)}")
        return self._driver.array(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def save(self, path: str | os.PathLike[str] | None = None) -> bytes:
        """The committed state as bytes, also written to the file `path` if one is given.

        The format is the C core's: versioned, with a check sum, in the byte order of the machine,
        which its header records.
        """
        data = self._driver.save_state()
        if path is not None:
            temporary = Path(f"{os.fspath(path)}.part")
            try:
                temporary.write_bytes(data)
                os.replace(temporary, path)
            finally:
                temporary.unlink(missing_ok=True)
        return data

    def load(self, source: bytes | bytearray | memoryview | str | os.PathLike[str]) -> None:
        """Takes over what `save` gave, from bytes or from a file.

        Raises:
            StateError: version, byte order, interface, sizes or check sum do not fit; nothing has
                changed.
        """
        if isinstance(source, bytes | bytearray | memoryview):
            self._driver.load_state(bytes(source))
        else:
            self._driver.load_state(Path(source).read_bytes())
