# SPDX-License-Identifier: MIT
"""The command line `usersub`."""

from usersub.cli.main import main

__all__ = ["main"]
