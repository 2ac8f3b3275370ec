# SPDX-License-Identifier: MIT
"""The C core for Python: `ffi` and `lib` of `usersub._core`, checked against the tables.

Everybody takes them from here and not from `usersub._core`, so that a library that was built from
other tables is refused before the first call.
"""

from __future__ import annotations

from usersub import abi
from usersub.errors import AbiError

try:
    from usersub._core import ffi, lib
except ImportError as error:
    raise AbiError(
        f"the compiled part usersub._core cannot be loaded ({error}); "
        "install the package again with `pip install .`"
    ) from error

__all__ = ["ffi", "lib", "text"]


def text(pointer) -> str:
    """The Python string of a C string."""
    return ffi.string(pointer).decode("utf-8", "replace")


def _check_tables() -> None:
    """Raises AbiError unless library and Python tables are of one version and hash."""
    found = lib.usub_abi_version(), text(lib.usub_abi_hash())
    expected = abi.ABI_VERSION, abi.abi_hash()
    if found != expected:
        raise AbiError(
            f"the library was built from tables of version {found[0]}, hash {found[1]}, "
            f"but this package has version {expected[0]}, hash {expected[1]}; build it again"
        )


_check_tables()
