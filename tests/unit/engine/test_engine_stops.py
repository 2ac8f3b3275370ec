# SPDX-License-Identifier: MIT
"""Routines that do not come back: XIT, exit, abort, faults; in every kind of driver."""

from __future__ import annotations

import numpy as np
import pytest

import usersub
from usersub.errors import RoutineError

POINTS, BLOCK = 10, 4
STANDARD, EXPLICIT, COEFFICIENT = (
    usersub.StandardDriver, usersub.ExplicitDriver, usersub.CoefficientDriver,
)  # fmt: skip
#: Driver, then what the routine does before it ends and how it knows its first point.
KINDS = {
    "fric": (STANDARD, "*LM = 0; STATEV[0] += 1; const int point = *NODE - 1;"),
    "fric_coef": (STANDARD, "*fCoef = 0.5; rData[7] += 1; const int point = iData[3] - 1;"),
    "vfric": (EXPLICIT, "statev[0] += 1; const int point = jConSecid[0] - 1;"),
    "vfriction": (EXPLICIT, "state[0] += 1; const int point = jConSecUid[0] - 1;"),
    "vfric_coef": (EXPLICIT, "const int point = (int)pressure[0];"),
    "coefficient": (COEFFICIENT, "rData[7] += 1; const int point = iData[3] - 1;"),
}
ENDS = {
    "XIT": ("xit_()", "XIT"),
    "XPLB_EXIT": ("xplb_exit_()", "XPLB_EXIT"),
    "exit": ("exit(3)", "exit.*3"),
    "abort": ("abort()", "abort"),
    "division": ("zero = 1000 / zero", "division"),
    "null": ("*(volatile int *)(size_t)zero = 1", "memory fault"),
}
SOURCE = """\
#include <stdlib.h>
#include <usersub/abi.h>
void xit_(void);
void xplb_exit_(void);
void {symbol}_(USUB_{parameters}_PARAMETERS) {{
  static volatile int zero = 0;
  {body}
  if ({props}[0] >= 0 && point >= {props}[0]) switch ((int){props}[1]) {{
    {cases}
  }}
}}
"""


@pytest.fixture(scope="module")
def routines(tmp_path_factory):
    """One routine of each kind, which ends as its properties say."""
    cases = " ".join(f"case {i}: {how}; break;" for i, (how, _) in enumerate(ENDS.values()))
    made = {}
    for name, (_, body) in KINDS.items():
        symbol = "fric_coef" if name == "coefficient" else name
        parameters = "FRIC_COEF_2022" if symbol == "fric_coef" else symbol.upper()
        path = tmp_path_factory.mktemp(name) / "law.c"
        props = "PROPS" if name == "fric" else "props"
        path.write_text(
            SOURCE.format(symbol=symbol, parameters=parameters, body=body, cases=cases, props=props)
        )
        made[name] = usersub.load(path).only()
    return made


def arrays(driver, name: str) -> dict[str, np.ndarray]:
    """What the kinds want; the point's number is in nodes and pressures."""
    number = np.arange(POINTS)
    node = (number + 1).astype(np.int32)
    normal = np.zeros((3, POINTS), order="F")
    normal[2] = 1
    every = {
        "slip_increment": np.ones(driver.layout.shapes.get("slip_increment", 1), order="F"),
        "pressure": number + 1.0,
        "normal": normal,
        "normal_force": number + 0.0,
        "stick_force": np.ones(POINTS),
        "secondary_node": node if name == "vfric" else node[None, :],
        "slip_rate": np.ones(POINTS),
    }
    return {n: a for n, a in every.items() if n in driver.layout.ports}


def ready(routines, name: str, end: str, stop_at: int):
    """(driver, call) of a routine that ends so from point `stop_at` on; -1: never."""
    maker = KINDS[name][0]
    scene = usersub.Scene(
        points=POINTS, block=BLOCK, props=[stop_at, list(ENDS).index(end)], elastic_slip=0.1,
        states=0 if name == "vfric_coef" else 2, secondary_nodes=POINTS, main_nodes=4,
        nodes=POINTS, dissipation=1,
    )  # fmt: skip
    driver = maker(routines[name], scene)
    driver.bind(**arrays(driver, name))
    if maker is STANDARD:
        driver.begin_increment(0.5)
        return driver, driver.iterate
    return driver, driver.evaluate if maker is COEFFICIENT else lambda: driver.step(0.5)


@pytest.mark.parametrize("stop_at", [0, 6, 9])
@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("name", KINDS)
def test_what_a_stop_says_and_leaves(routines, name, end, stop_at):
    driver, call = ready(routines, name, end, stop_at)
    before = driver.state.save()
    if name in ("vfric", "vfriction", "vfric_coef"):
        if stop_at == 9:
            return  # the last point is the first of no block
        first = -(-stop_at // BLOCK) * BLOCK  # the routine looks at the first point of a block
        place, point = f"in points {first} to {min(first + BLOCK, POINTS) - 1}", -1
    else:
        place, point = "", stop_at
    with pytest.raises(RoutineError, match=f"{ENDS[end][1]}.*{place}") as caught:
        call()
    assert driver.state.save() == before
    title = "FRIC_COEF" if name == "coefficient" else name.upper()
    assert str(caught.value).startswith(f"{title}: the routine ended with ")
    assert getattr(caught.value, "point", None) in (point, None if point < 0 else point)


@pytest.mark.parametrize("name", KINDS)
def test_the_process_goes_on(routines, name):
    """After a stop the same driver, and a driver of a good routine, work."""
    _, call = ready(routines, name, "XIT", 4)
    for _ in range(3):
        with pytest.raises(RoutineError):
            call()
    _, good = ready(routines, name, "XIT", -1)
    good()
