# SPDX-License-Identifier: MIT
"""The pages that the benchmarks write."""

from __future__ import annotations

import os
import platform
import subprocess
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from tests.benchmarks.timing import Row

_HEAD = """\
% SPDX-License-Identifier: MIT

# Benchmarks

Written by `make bench`. Medians of the processor time of interleaved rounds in one process; where
"wall time" is said, of the clock. Only the ratios carry over to other machines. Each way to do some
work is divided by a limit that is measured in the same rounds: the same arithmetic written by hand
without any driver.

Machine: {machine}.

## Targets

Time over that of the limit, and the largest ratio that is wanted: 1.40 empty calls are 100 ns where
an empty call takes 72; two threads are to be 1.8 times as fast as one, that is 1.11 times the half
of its time. What is saved by leaving out stands in [Cost](cost.md).

{targets}

{missed}

## All that was measured

{table}

The rows of law functions compare a [law function](../how-to/law-functions.md) of five lines, behind
each interface, with the routine that one would write by hand for the same work: enforcement and
tangent included behind FRIC, derivatives behind FRIC_COEF.

"vector_math" is the option of the decorators that puts exp, log and pow as polynomials into the
loops of a Python routine, or has them from the vector functions of the C library ("libmvec"). The
polynomials have errors below 0.9 units of the last place (the C library's scalar functions: 0.52,
its vector functions: 2.2), give the same bits for every block size and on every machine, and cost
about as much as libmvec, for which reason they are what `True` means. Without the option a routine
has the bits of the C library's scalar functions, as the same law in C or Fortran has.
"""


def machine() -> str:
    """Processor, compilers and versions."""
    import numba

    model = platform.processor()
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.partition(":")[2].strip()
            break
    gcc = subprocess.run(["gcc", "-dumpfullversion"], capture_output=True, text=True).stdout
    return (
        f"{model}, {os.cpu_count()} processors; Python {platform.python_version()}, numpy "
        f"{np.__version__}, numba {numba.__version__}, gcc {gcc.strip()}, "
        f"{' '.join(platform.libc_ver())}"
    )


def _targets(rows: Sequence[Row]) -> str:
    lines = [
        "| work | way | points | ratio | target | |",
        "| --- | --- | ---: | ---: | ---: | --- |",
    ]
    for row in rows:
        if row.target is not None:
            said = "met" if row.met else "not met"
            lines.append(
                f"| {row.work} | {row.way} | {row.points} | {row.ratio:.2f} | "
                f"{row.target:.2f} | {said} |"
            )
    return "\n".join(lines)


def _missed(rows: Sequence[Row]) -> str:
    """Why targets are missed: a line for each work, or for works with the same reasons."""
    reasons: dict[str, list[str]] = {}
    for row in rows:
        if not row.met and row.reason not in reasons.setdefault(row.work, []):
            reasons[row.work].append(row.reason)
    works: dict[str, list[str]] = {}
    for work, why in reasons.items():
        works.setdefault(" ".join(why), []).append(work)
    if not works:
        return "All are met."
    return "Why the others are not met:\n\n" + "\n".join(
        f"- {'; '.join(where)}: {why}" for why, where in works.items()
    )


def _table(rows: Sequence[Row]) -> str:
    lines = [
        "| work | way | points | ns per point | limit, ns per point | ratio | limit |",
        "| --- | --- | ---: | ---: | ---: | ---: | --- |",
    ]
    for row in rows:
        cost = f"{row.seconds / row.points * 1e9:.4g}"
        limit = " | | "
        if row.limit:
            limit = f"{row.limit_seconds / row.points * 1e9:.4g} | {row.ratio:.2f} | {row.limit}"
        lines.append(f"| {row.work} | {row.way} | {row.points} | {cost} | {limit} |")
    return "\n".join(lines)


def benchmarks(rows: Sequence[Row]) -> str:
    """The page of the benchmarks."""
    return _HEAD.format(
        machine=machine(), targets=_targets(rows), missed=_missed(rows), table=_table(rows)
    )


def cost(template: Path, fields: dict[str, str]) -> str:
    """The page of the cost, from a template with names in braces."""
    text = template.read_text(encoding="utf-8")
    for name, words in fields.items():
        text = text.replace(f"{{{name}}}", words)
    return text
