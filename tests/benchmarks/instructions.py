# SPDX-License-Identifier: MIT
"""Counts the instructions of the drivers, which do not depend on how busy the machine is.

`make instructions` compares with `instructions.json`; `python -m tests.benchmarks.instructions
--write` records the counts anew, after a change that is meant to cost or to save. Counts hold for
one compiler: with another one there is nothing to compare.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from usersub import paths

HERE = Path(__file__).parent
RECORD = HERE / "instructions.json"

#: Larger changes are refused, in both directions: a saving is to be recorded too.
TOLERANCE = 0.03

SCENES = (
    "VFRIC_COEF, one point",
    "VFRIC_COEF, 4096 points",
    "VFRICTION, one point",
    "VFRICTION, 4096 points",
    "FRIC, one point",
    "FRIC, 4096 points",
)

#: The C library's plain copies and fills: which it takes otherwise depends on the processor.
_PLAIN = "-AVX,-AVX2,-AVX512F,-AVX512VL,-AVX_Fast_Unaligned_Load,-ERMS,-FSRM"

#: Head of the printed table.
_HEAD = f"{'':28}{'counted':>12}{'recorded':>12}{'change':>9}"


class Incomparable(Exception):  # noqa: N818 - no error: there is nothing to compare with
    """Counts of this machine say nothing about those on record; the text says why."""


def compiler() -> str:
    """What compiled the installed library, in its own words."""
    from elftools.elf.elffile import ELFFile

    with open(paths.library_path(), "rb") as file:
        comment = ELFFile(file).get_section_by_name(".comment")
        text = comment.data().decode() if comment else ""
    found = re.search(r"GCC: \([^)]*\) ([\d.]+)", text)
    return f"gcc {found[1]}" if found else text.replace("\0", " ").strip() or "unknown"


def check_comparable(record: dict) -> None:
    """Raises Incomparable where tool or compiler are others than those on record."""
    for tool in ("gcc", "valgrind"):
        if shutil.which(tool) is None:
            raise Incomparable(f"{tool} is not there")
    processor = Path("/proc/cpuinfo")
    if not processor.is_file() or " avx2" not in processor.read_text():
        raise Incomparable("the processor has no AVX2, for which loops of the library are made")
    if compiler() != record["compiler"]:
        raise Incomparable(
            f"the library was compiled by {compiler()}, the counts on record are of "
            f"{record['compiler']}"
        )


def counts(scenes: tuple[str, ...] = SCENES) -> dict[str, int]:
    """Instructions of the calls of each scene."""
    with tempfile.TemporaryDirectory() as folder:
        program, library = Path(folder) / "host", Path(paths.library_path())
        subprocess.run(
            ["gcc", "-O2", f"-I{paths.include_folder()}", HERE / "instructions.c", "-o", program,
             library, f"-Wl,-rpath,{library.parent}"],
            check=True,
        )  # fmt: skip
        return {scene: _count(program, scene) for scene in scenes}


def _count(program: Path, scene: str) -> int:
    done = subprocess.run(
        ["valgrind", "--tool=callgrind", "--toggle-collect=measured",
         "--callgrind-out-file=/dev/null", program, scene],
        capture_output=True, text=True,
        env={**os.environ, "GLIBC_TUNABLES": f"glibc.cpu.hwcaps={_PLAIN}"},
    )  # fmt: skip
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode or found is None:
        raise RuntimeError(f"{scene}: counting failed: {done.stderr}")
    return int(found[1])


def changes(found: dict[str, int], record: dict) -> dict[str, float]:
    """By how much of the recorded count each scene has changed."""
    return {scene: count / record["counts"][scene] - 1 for scene, count in found.items()}


def main(arguments: list[str]) -> int:
    """Compares or records; 1 if a count has changed by more than the tolerance."""
    found = counts()
    if "--write" in arguments:
        record = {"compiler": compiler(), "tolerance": TOLERANCE, "counts": found}
        RECORD.write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")
        return 0
    record = json.loads(RECORD.read_text(encoding="utf-8"))
    changed = changes(found, record)
    print(_HEAD)
    for scene, count in found.items():
        print(f"{scene:28}{count:12}{record['counts'][scene]:12}{changed[scene]:9.1%}")
    try:
        check_comparable(record)
    except Incomparable as reason:
        print(f"Not compared: {reason}.")
        return 0
    worst = max(map(abs, changed.values()))
    if worst > record["tolerance"]:
        print(
            f"Changed by {worst:.1%}, more than {record['tolerance']:.0%}. If that is meant: "
            "python -m tests.benchmarks.instructions --write"
        )
    return int(worst > record["tolerance"])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
