# SPDX-License-Identifier: MIT
"""FRIC, point by point: Coulomb friction with elastic slip, a mix of stick, slip and open points.

The limit is the law in one C loop over arrays of the same shape, which returns what the driver
returns: condition, stress, tangents, slip, energies and state.
"""

from __future__ import annotations

import ctypes
from pathlib import Path

import numpy as np

import usersub
from tests.benchmarks import native
from tests.benchmarks.fric_laws import C_LIMIT, C_ROUTINE, PROPS, fortran_routine, law
from tests.benchmarks.timing import Repeat, Row, calls, medians
from usersub import abi, paths
from usersub.routine.compiled import compiled_entry
from usersub.routine.declaration import declare
from usersub.routine.routine import BLOCK, Entry

COMPILED = "Python, loop compiled with the law"


def arrays(points: int, open_points: bool = True) -> dict[str, np.ndarray]:
    """Motions and pressures: a third each of stick, slip and, if wanted, open points."""
    random = np.random.default_rng(5)
    slip = random.normal(size=(2, points)) * np.where(random.random(points) < 0.5, 2e-4, 2e-2)
    pressure = random.uniform(1.0, 9.0, points)
    if open_points:
        pressure[random.random(points) < 1 / 3] *= -1
    return {"slip_increment": np.asfortranarray(slip), "pressure": pressure}


def prepared(routine: usersub.Routine, points: int, open_points: bool = True) -> tuple:
    """A driver in the middle of its second increment, and its prepared iteration."""
    return _iterated(routine, arrays(points, open_points))


def _iterated(routine: usersub.Routine, given: dict[str, np.ndarray]) -> tuple:
    scene = usersub.Scene(points=given["pressure"].size, dimension=3, props=PROPS, states=2)
    driver = usersub.StandardDriver(routine, scene)
    driver.begin_increment(1e-3)
    driver.iterate(**given)
    driver.commit()
    driver.begin_increment(1e-3)
    driver.iterate(**given)
    return driver, driver.prepare()


def _limit(folder: Path, driver: usersub.StandardDriver, given: dict, points: int) -> Repeat:
    """The loop by hand over arrays of its own, started from the driver's state."""
    function = native.library(folder, f"fric_limit_{points}.c", C_LIMIT).repeat
    sizes = {"tau": 2, "dg": 4, "dp": 2, "dslip": 2, "sed": 1, "sfd": 1, "state": 2}
    kept = [np.zeros(points, np.int32), *(np.zeros(points * n) for n in sizes.values())]
    start = driver.state["state"].ravel(order="F").copy()
    kept += [start, given["slip_increment"], given["pressure"], np.array(PROPS)]
    pointers = (ctypes.c_void_p * len(kept))(*(a.ctypes.data for a in kept))
    function.argtypes = [ctypes.c_void_p, ctypes.c_long, ctypes.c_long]

    def repeat(times: int, keep: object = kept) -> None:
        function(pointers, points, times)

    repeat(1)
    np.testing.assert_allclose(kept[1], driver.array("tau").ravel(order="F"), rtol=1e-12)
    np.testing.assert_allclose(kept[2], driver.array("ddtddg").ravel(order="F"), rtol=1e-9)
    return repeat


def _one_pointer() -> usersub.Routine:
    """The Python routine, called once a point with one pointer."""
    import dataclasses

    routine = usersub.fric(law)
    declaration = declare("fric", law, None)

    def entry(precision: str) -> Entry:
        return compiled_entry(declaration, precision, BLOCK)

    return dataclasses.replace(routine, make_entry=entry)


def _load(folder: Path, name: str, source: str) -> usersub.Routine:
    path = folder / name
    path.write_text(source)
    return usersub.load(path)["fric"]


def _peer_numpy_free(points: int) -> Repeat:
    """The law called from Python for each point, by the interpreter."""
    given = arrays(points)
    face = abi.interface("fric")
    by_name = {
        "LM": np.zeros(1, np.int32), "TAU": np.zeros(2), "DDTDDG": np.zeros((2, 2), order="F"),
        "DDTDDP": np.zeros(2), "DSLIP": np.zeros(2), "SED": np.zeros(1), "SFD": np.zeros(1),
        "STATEV": np.zeros(2), "PROPS": np.array(PROPS),
    }  # fmt: skip
    names = law.__code__.co_varnames[: law.__code__.co_argcount]
    assert all(any(a.name == n for a in face.args) for n in names)

    def repeat(times: int) -> None:
        for _ in range(times):
            for k in range(points):
                by_name["DGAM"] = given["slip_increment"][:, k]
                by_name["PRESS"] = given["pressure"][k]
                law(*[by_name[n] for n in names])

    return repeat


def _peer_ctypes(folder: Path) -> Repeat:
    """The C routine with its 42 arguments, one point a call, addresses kept."""
    flags = (*native.C_FLAGS, f"-I{paths.include_folder()}")
    function = native.library(folder, "peer_fric.c", C_ROUTINE, flags).fric_
    function.restype = None
    values: list = []
    for arg in abi.interface("fric").args:
        values.append(np.zeros(100, np.int32 if arg.kind == "int" else np.float64))
        if arg.name == "PROPS":
            values[-1][:2] = PROPS
        if arg.name in ("PRESS", "DGAM"):
            values[-1][:] = 1e-2
    pointers = [v.ctypes.data_as(ctypes.c_void_p) for v in values]
    function.argtypes = [ctypes.c_void_p] * len(pointers)

    def repeat(times: int, keep: object = values) -> None:
        for _ in range(times):
            function(*pointers)

    return repeat


def rows(folder: Path, points: int) -> list[Row]:
    """A mix of points against the loop by hand; peers for a point."""
    work = "FRIC, Coulomb with elastic slip and tangent, mixed"
    routines = {
        COMPILED: usersub.fric(law),
        "Python, one pointer a point": _one_pointer(),
        "C, 42 arguments a point": _load(folder, "law.c", C_ROUTINE),
        "Fortran, 42 arguments a point": _load(folder, "law.f", fortran_routine()),
    }
    targets = dict(zip(routines, (1.1, 2.0, 2.5, 2.5), strict=True))
    drivers = {name: prepared(routine, points) for name, routine in routines.items()}
    repeats = {name: calls(call) for name, (_, call) in drivers.items()}
    first = next(iter(drivers.values()))[0]
    repeats["limit"] = _limit(folder, first, arrays(points), points)
    repeats["peer: ctypes"] = _peer_ctypes(folder)
    few = 50
    repeats["peer: interpreter"] = _peer_numpy_free(few)
    found = medians(repeats)
    limit = ("C loop with the law inlined", found["limit"])
    per_point = {"peer: ctypes": 1, "peer: interpreter": few}
    made = [Row(work, "limit: C loop with the law inlined", points, found["limit"])]
    made += [
        Row(work, f"driver, {name}", points, found[name], *limit, targets[name], _reason(name))
        for name in routines
    ]
    made += [
        Row(work, name, points, found[name] / count * points, *limit)
        for name, count in per_point.items()
    ]
    return made


def slipping(folder: Path, points: int) -> list[Row]:
    """Points that all slip, in the order of the processor's expectations: what the call costs."""
    work = "FRIC, Coulomb with elastic slip and tangent, all slip"
    routines = {
        COMPILED: usersub.fric(law),
        "C, 42 arguments a point": _load(folder, "law.c", C_ROUTINE),
        "Fortran, 42 arguments a point": _load(folder, "law.f", fortran_routine()),
    }
    given = arrays(points, False)
    given["slip_increment"] *= np.where(np.abs(given["slip_increment"]).max(axis=0) < 1e-3, 1e2, 1)
    drivers = {name: _iterated(routine, given) for name, routine in routines.items()}
    repeats = {name: calls(call) for name, (_, call) in drivers.items()}
    repeats["limit"] = _limit(folder, next(iter(drivers.values()))[0], given, points)
    found = medians(repeats)
    limit = ("C loop with the law inlined", found["limit"])
    targets = dict(zip(routines, (1.1, 2.5, 2.5), strict=True))
    return [
        Row(work, "limit: C loop with the law inlined", points, found["limit"]),
        *(
            Row(work, f"driver, {name}", points, found[name], *limit, targets[name], _reason(name))
            for name in routines
        ),
    ]


#: Shares of the time of the driver, by samples: what the loop by hand has none of.
REASON = (
    "Half of the time is the law, which compiled with the loop over the points takes what it takes "
    "in the loop by hand; a sixth is copies of what points start from and what a commit takes, so "
    "that a failed iteration leaves nothing behind; a sixth is which points are open, and what "
    "they start from and return; a tenth is looking for NaN and infinity; the rest is mainly "
    "clearing."
)
REASON_CALLED = (
    "A law that is called point by point takes half of the time as well, but up to twice as long "
    "as in the loop by hand: its call stands between the points, and compilers make a branch of "
    "stick and slip there; setting and passing the arguments takes a fifth, most of the rest what "
    "was said before."
)


def _reason(name: str) -> str:
    return REASON if name == COMPILED else REASON_CALLED
