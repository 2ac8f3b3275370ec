# SPDX-License-Identifier: MIT
"""`python -m usersub.emit`: writes the generated files, or with `--check` compares them."""

from __future__ import annotations

import argparse
import difflib
import sys
from pathlib import Path

from usersub import emit
from usersub.emit import versions

ROOT = Path(__file__).resolve().parents[2]


def differences(root: Path = ROOT) -> list[str]:
    """Unified diffs between the committed files and what the tables say; [] if they agree."""
    found = []
    for path, wanted in emit.artefacts().items():
        file = root / path
        there = file.read_text(encoding="utf-8") if file.is_file() else ""
        if there != wanted:
            found.append(
                "".join(
                    difflib.unified_diff(
                        there.splitlines(keepends=True),
                        wanted.splitlines(keepends=True),
                        f"{path} (committed)",
                        f"{path} (generated)",
                    )
                )
            )
    return found


def write(root: Path = ROOT) -> list[str]:
    """Writes the files that differ; returns their paths."""
    written = []
    for path, wanted in emit.artefacts().items():
        file = root / path
        if not file.is_file() or file.read_text(encoding="utf-8") != wanted:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(wanted, encoding="utf-8")
            written.append(path)
    return written


def main(arguments: list[str] | None = None) -> int:
    """Runs the command; returns 0, or 1 if `--check` finds a difference."""
    parser = argparse.ArgumentParser(prog="python -m usersub.emit", description=__doc__)
    parser.add_argument("--check", action="store_true", help="compare only; exit 1 if they differ")
    options = parser.parse_args(arguments)
    if not (ROOT / "csrc").is_dir():
        parser.error(f"{ROOT} is no source tree of usersub: there is nothing to generate here")
    if options.check:
        found = differences() + versions.problems()
        print("\n".join(found) or "generated files are up to date")
        return 1 if found else 0
    for path in write():
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
