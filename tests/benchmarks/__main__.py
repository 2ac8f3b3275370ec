# SPDX-License-Identifier: MIT
"""Measures the drivers against limits written by hand: `make bench`.

Prints a table and writes it to docs/explanation/benchmarks.md, or to the file that is named.
Timings are medians of the processor time of interleaved rounds in one process; only the ratios
carry over to other machines.
"""

from __future__ import annotations

import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import usersub
from tests.benchmarks import laws, lifted
from usersub.core import lib
from usersub.routine import fortran

ROUNDS = 25
ROUND_SECONDS = 0.02
C_FLAGS = ("-O2", "-ffp-contract=off", "-fno-semantic-interposition")

Row = tuple[str, str, int, float, float | None, str]


def once(repeat: Callable[[int], None], times: int) -> float:
    """Seconds of processor time of one call, in a round of `times` calls."""
    start = time.thread_time()
    repeat(times)
    return (time.thread_time() - start) / times


def medians(repeats: dict[str, Callable[[int], None]]) -> dict[str, float]:
    """Median seconds of one call of each, measured in turns so that all see the same machine."""
    times = {}
    for name, repeat in repeats.items():
        repeat(2)
        times[name] = max(1, int(ROUND_SECONDS / once(repeat, 3)))
    rounds: dict[str, list[float]] = {name: [] for name in repeats}
    for _ in range(ROUNDS):
        for name, repeat in repeats.items():
            rounds[name].append(once(repeat, times[name]))
    return {name: statistics.median(found) for name, found in rounds.items()}


def calls(function: Callable, *arguments: object) -> Callable[[int], None]:
    """A function that calls `function` a number of times from Python."""

    def repeat(times: int) -> None:
        for _ in range(times):
            function(*arguments)

    return repeat


def prepared(routine: usersub.Routine, points: int) -> tuple[usersub.CoefficientDriver, Callable]:
    """A driver of `points` points, its arrays bound, and its prepared call."""
    scene = usersub.Scene(points=points, props=laws.PROPS)
    driver = usersub.CoefficientDriver(routine, scene)
    driver.bind(slip_rate=slip_rates(points), pressure=np.full(points, 2.0e3))
    driver.evaluate()
    return driver, driver.prepare()


def slip_rates(points: int) -> np.ndarray:
    """Slip rates between 0 and 200, in no order."""
    return np.random.default_rng(20).uniform(0.0, 200.0, points)


def one_point(folder: Path) -> list[Row]:
    """A prepared call for one point against an empty cffi call with one pointer."""
    nothing, call_nothing = prepared(laws.routine(folder, "empty.c", laws.C_EMPTY), 1)
    _, call_c = prepared(laws.routine(folder, "decay.c", laws.C_ROUTINE), 1)
    _, call_python = prepared(laws.decay, 1)
    found = medians(
        {
            "empty": calls(lib.usub_empty, nothing._handle),
            "nothing": calls(call_nothing),
            "c": calls(call_c),
            "python": calls(call_python),
        }
    )
    limit = found["empty"]
    return [
        ("empty cffi call", "-", 1, limit, None, ""),
        ("prepared call, routine that does nothing", "C", 1, found["nothing"], limit, "empty call"),
        ("prepared call, exponential decay", "C", 1, found["c"], limit, "empty call"),
        ("prepared call, exponential decay", "Python", 1, found["python"], limit, "empty call"),
    ]


def blocks(folder: Path, points: int) -> list[Row]:
    """VFRIC_COEF for many points against the loop by hand of the same language."""
    routines = {"C": laws.routine(folder, "decay.c", laws.C_ROUTINE), "Python": laws.decay}
    limits = {
        "C": laws.limit(folder, "limit.c", laws.C_LIMIT, C_FLAGS),
        "Python": laws.python_limit(),
    }
    if laws.has_fortran():
        flags = fortran.flags(False, "double")
        routines["Fortran"] = laws.routine(folder, "decay.f", laws.fortran_routine())
        limits["Fortran"] = laws.limit(folder, "limit.f", laws.FORTRAN_LIMIT, flags)
    rate, coefficient = slip_rates(points), np.empty(points)
    repeats: dict[str, Callable[[int], None]] = {}
    drivers = []
    for language, routine in routines.items():
        driver, call = prepared(routine, points)
        drivers.append(driver)
        repeats[language] = calls(call)
        by_hand = limits[language]
        repeats[f"{language} limit"] = lambda times, f=by_hand: f(coefficient, rate, times)
        f = by_hand
        f(coefficient, rate, 1)
        np.testing.assert_allclose(driver.array("coefficient"), coefficient, rtol=1e-14)
    found = medians(repeats)
    return [
        (
            "VFRIC_COEF, exponential decay",
            language,
            points,
            found[language],
            found[f"{language} limit"],
            f"loop by hand in {language}",
        )
        for language in routines
    ]


def law_functions() -> list[Row]:
    """A law function behind each interface against the routine written by hand for it."""
    rows: list[Row] = []
    for name, (law, by_hand) in lifted.pairs().items():
        found = medians({"law": law, "by hand": by_hand})
        work = f"{name.upper()}, law function of five lines{lifted.WITH.get(name, '')}"
        limit = "routine by hand with numba"
        rows.append((work, "Python", lifted.POINTS, found["law"], found["by hand"], limit))
    return rows


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
        f"{model}; Python {platform.python_version()}, numpy {np.__version__}, "
        f"numba {numba.__version__}, gcc {gcc.strip()}"
    )


def table(rows: list[Row]) -> str:
    """The rows as a Markdown page."""
    lines = [
        "% SPDX-License-Identifier: MIT",
        "",
        "# Benchmarks",
        "",
        "Written by `make bench`. Medians of the processor time of interleaved rounds in one",
        "process; only the ratios carry over to other machines.",
        "",
        "The last rows compare a [law function](../how-to/law-functions.md) of five lines, behind",
        "each interface, with the routine that one would write by hand for the same work:",
        "enforcement and tangent included behind FRIC, derivatives behind FRIC_COEF.",
        "",
        f"Machine: {machine()}.",
        "",
        "| work | routine in | points | ns per point | limit, ns per point | ratio | limit |",
        "| --- | --- | ---: | ---: | ---: | ---: | --- |",
    ]
    for work, language, points, seconds, limit, of in rows:
        cost = f"{seconds / points * 1e9:.4g}"
        bound = f"{limit / points * 1e9:.4g} | {seconds / limit:.2f}" if limit else " | "
        lines.append(f"| {work} | {language} | {points} | {cost} | {bound} | {of} |")
    return "\n".join(lines) + "\n"


def main(output: str = "docs/explanation/benchmarks.md") -> None:
    """Measures everything and writes the table to the file `output`."""
    with tempfile.TemporaryDirectory() as folder:
        rows = one_point(Path(folder))
        for points in (10_000, 1_000_000):
            rows += blocks(Path(folder), points)
        rows += law_functions()
    text = table(rows)
    Path(output).write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main(*sys.argv[1:])
