# SPDX-License-Identifier: MIT
"""VFRIC_COEF: drivers, limits and peers in the same rounds."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import usersub
from tests.benchmarks import laws, peers
from tests.benchmarks.timing import Repeat, Row, calls, medians
from usersub.core import lib

WORK = "VFRIC_COEF, exponential decay"
CALL = "one prepared call"


def prepared(routine: usersub.Routine, points: int, **settings) -> tuple:
    """A driver of `points` points, its arrays bound, and its prepared call."""
    scene = usersub.Scene(points=points, props=laws.PROPS, **settings)
    driver = usersub.CoefficientDriver(routine, scene)
    driver.bind(slip_rate=slip_rates(points), pressure=np.full(points, 2.0e3))
    driver.evaluate()
    return driver, driver.prepare()


def slip_rates(points: int) -> np.ndarray:
    """Slip rates between 0 and 200, in no order."""
    return np.random.default_rng(20).uniform(0.0, 200.0, points)


def one_point(folder: Path) -> list[Row]:
    """A prepared call for one point against an empty cffi call with one pointer, and peers."""
    nothing, call_nothing = prepared(laws.routine(folder, "empty.c", laws.C_EMPTY), 1)
    kept = [
        prepared(laws.routine(folder, "decay.c", laws.C_ROUTINE), 1),
        prepared(laws.python, 1),
    ]
    rate = slip_rates(1)
    found = medians(
        {
            "empty": calls(lib.usub_empty, nothing._handle),
            "nothing": calls(call_nothing),
            "C": calls(kept[0][1]),
            "Python": calls(kept[1][1]),
            "f2py": peers.by_f2py(folder, rate, 1),
            "ctypes": peers.by_pointer(folder, rate, "ctypes"),
            "cffi": peers.by_pointer(folder, rate, "cffi"),
        }
    )
    limit = ("empty cffi call", found["empty"])
    # 100 ns where the empty call takes 72
    target = 1.4
    reason = "The call itself is at its limit; the rest is `exp` and the checks of its result."
    return [
        Row(CALL, "empty cffi call", 1, found["empty"]),
        Row(CALL, "driver, routine that does nothing", 1, found["nothing"], *limit, target, reason),
        Row(CALL, "driver, C", 1, found["C"], *limit, target, reason),
        Row(CALL, "driver, Python", 1, found["Python"], *limit, target, reason),
        Row(CALL, "peer: f2py", 1, found["f2py"], *limit),
        Row(CALL, "peer: ctypes, addresses kept", 1, found["ctypes"], *limit),
        Row(CALL, "peer: cffi, pointers kept", 1, found["cffi"], *limit),
    ]


#: Routine, limit, target, why it is missed.
_TARGETS = {
    "C": ("C", 1.05),
    "Fortran": ("Fortran", 1.05),
    "Python": ("numba", 1.05),
    "Python, vector_math=True": ("libmvec", 1.05),
    'Python, vector_math="libmvec"': ("libmvec", None),
}

_LIMITS = {
    "C": "C by hand, scalar exp",
    "Fortran": "Fortran by hand, same flags",
    "numba": "numba called directly, scalar exp",
    "libmvec": "C by hand, libmvec",
    "polynomial": "C by hand, polynomial in the loop",
}


def blocks(folder: Path, points: int) -> list[Row]:
    """Many points: drivers against the loop by hand with the same `exp`."""
    rate, coefficient = slip_rates(points), np.empty(points)
    routines: dict[str, usersub.Routine] = {
        "C": laws.routine(folder, "decay.c", laws.C_ROUTINE),
        "Fortran": laws.routine(folder, "decay.f", laws.fortran_routine()),
        "Python": laws.python,
        "Python, vector_math=True": laws.vectorised,
        'Python, vector_math="libmvec"': laws.with_libmvec(),
    }
    repeats: dict[str, Repeat] = {}
    drivers = []
    for name, routine in routines.items():
        driver, call = prepared(routine, points)
        drivers.append(driver)
        repeats[name] = calls(call)
    for name, limit in laws.limits(folder).items():
        limit(coefficient, rate, 1)
        np.testing.assert_allclose(drivers[0].array("coefficient"), coefficient, rtol=1e-14)
        repeats[f"limit {name}"] = _repeated(limit, coefficient, rate)
    repeats["f2py"] = peers.by_f2py(folder, rate, points)
    repeats["numpy"] = peers.by_numpy(rate)
    found = medians(repeats)
    rows = [Row(WORK, f"limit: {words}", points, found[f"limit {name}"])
            for name, words in _LIMITS.items()]  # fmt: skip
    rows += [
        Row(WORK, f"driver, {name}", points, found[name], _LIMITS[limit],
            found[f"limit {limit}"], target, _reason(name))
        for name, (limit, target) in _TARGETS.items()
    ]  # fmt: skip
    vector = (_LIMITS["libmvec"], found["limit libmvec"])
    rows.append(Row(WORK, "peer: f2py, one call for all", points, found["f2py"], *vector))
    rows.append(Row(WORK, "peer: numpy expression", points, found["numpy"], *vector))
    return rows


def _reason(name: str) -> str:
    if "vector" in name:
        return (
            "With vector_math the law takes what it takes in the loop by hand, so little that "
            "clearing the coefficients and looking at slip rates and coefficients for NaN and "
            "infinity add a quarter; without these two the ratio is 0.98 for 10000 and 0.93 for a "
            "million points."
        )
    return (
        "Clearing and looking for NaN and infinity add 4 percent to a law with the scalar exp, "
        "arming against its crashes 1 to 2; for a million points the first two add 10 percent, "
        "since memory is then waited for before and after the law in place of during it."
    )


def _repeated(limit: laws.Limit, coefficient: np.ndarray, rate: np.ndarray) -> Repeat:
    return lambda times: limit(coefficient, rate, times)


def threads(points: int) -> list[Row]:
    """Wall time of one and of two threads, which see the same machine in turns."""
    import time

    found: dict[int, list[float]] = {1: [], 2: []}
    kept = {count: prepared(laws.python, points, threads=count) for count in found}
    for _ in range(15):
        for count, (_, call) in kept.items():
            start = time.perf_counter()
            call()
            found[count].append(time.perf_counter() - start)
    seconds = {count: float(np.median(values)) for count, values in found.items()}
    return [
        Row("VFRIC_COEF, two threads", "driver, Python, wall time", points, seconds[2],
            "half of one thread", seconds[1] / 2, 2 / 1.8,
            "Other work on the machine's processors counts in wall time.")
    ]  # fmt: skip
