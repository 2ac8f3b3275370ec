# SPDX-License-Identifier: MIT
"""A standard host with different numbers everywhere, and what each routine should be told of it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from engine_probe import Computed, padded

import usersub

PROPS = (0.25, -7.0, 3.5)
STEP, INCREMENT, TIMES = 2, 5, (0.625, 3.375, 0.125)
NAMES = {"interaction": "Pad on Disc", "secondary": "pad-1", "main": "disc"}
CRITICAL, LENGTH = 0.75, 12.5


@dataclass
class Host:
    """One scene with its arrays and committed state."""

    interface: str
    points: int = 6
    dimension: int = 3
    friction_directions: int = 0
    generation: str = "2022"
    temperatures: int = 0
    fields: int = 0
    states: int = 0
    block: int = 0
    threads: int = 1
    settings: dict = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.f = self.friction_directions or self.dimension - 1
        random = np.random.default_rng(11)
        n, d, f, p, s = self.points, self.dimension, self.f, self.fields, self.states

        def real(*shape):
            return np.asfortranarray(random.uniform(0.5, 2.0, shape))

        self.arrays = {
            "slip_increment": real(f, n) - 1.0,
            "pressure": real(n),
            "pressure_increment": real(n),
            "contact_stiffness": real(n) + 10,
            "multiplier": real(f, n) + 30,
            "element": np.arange(n, dtype=np.int32) + 51,
            "integration_point": np.arange(n, dtype=np.int32) + 71,
            "node": np.arange(n, dtype=np.int32) + 91,
            "coord": real(d, n) + 40,
            "coord_main": real(d, n) + 50,
            "rotation": real(2, 2, n),
            "temperature_secondary": real(n) + 300,
            "temperature_main": real(n) + 400,
            "field_secondary": real(p, n) + 60,
            "field_main": real(p, n) + 70,
        }
        self.arrays = {name: a for name, a in self.arrays.items() if a.size}
        self.committed = {
            "slip": real(f, n) + 2,
            "condition": (np.arange(n, dtype=np.int32) + 1) % 3,
            "committed_tau": real(f, n) + 3,
            "committed_sed": real(n) + 4,
            "committed_pressure": real(n) + 5,
            "state": real(s, n) + 6,
        }
        if self.interface == "fric_coef":
            self.committed["elastic_slip"] = 0.1 * real(f, n)
            self.committed["equivalent_slip"] = real(n) + 8

    def scene(self) -> usersub.Scene:
        return usersub.Scene(
            points=self.points, dimension=self.dimension, block=self.block, threads=self.threads,
            friction_directions=self.friction_directions, generation=self.generation,
            temperatures=self.temperatures, fields=self.fields, states=self.states, props=PROPS,
            characteristic_length=LENGTH, elastic_slip=CRITICAL, **NAMES, **self.settings,
        )  # fmt: skip

    def driver(self, routine, **arrays) -> usersub.StandardDriver:
        """A driver in an open increment, with committed state and arrays bound."""
        driver = usersub.StandardDriver(routine, self.scene())
        for name, values in self.committed.items():
            driver.state[name][...] = values
        cold = () if self.temperatures else ("temperature_secondary", "temperature_main")
        ports = driver.layout.ports
        bound = {n: a for n, a in self.arrays.items() if n in ports and n not in cold}
        driver.bind(**{**bound, **arrays})
        self.begin(driver)
        return driver

    def begin(self, driver) -> None:
        driver.begin_increment(
            TIMES[2], step_time=TIMES[0], total_time=TIMES[1], step=STEP, increment=INCREMENT
        )

    def fric(self, i: int) -> dict:
        """Arguments of FRIC at point i in the first iteration."""
        a, c, f, p = self.arrays, self.committed, self.f, self.fields
        condition = c["condition"][i]
        pair = np.zeros(2)
        if self.temperatures:
            pair = np.array([a["temperature_secondary"][i], a["temperature_main"][i]])
        predef = np.zeros((2, 0))
        if p:
            predef = np.array([a["field_secondary"][:, i], a["field_main"][:, i]])
        return {
            "LM": condition, "TAU": c["committed_tau"][:, i], "DDTDDG": np.zeros((f, f)),
            "DDTDDP": np.zeros(f), "DSLIP": np.zeros(f), "SED": c["committed_sed"][i], "SFD": 0.0,
            "DDTDDT": np.zeros((f, 2)), "PNEWDT": 1e36, "STATEV": c["state"][:, i],
            "DGAM": a["slip_increment"][:, i],
            "TAULM": a["multiplier"][:, i] if condition == 1 else np.zeros(f),
            "PRESS": a["pressure"][i], "DPRESS": a["pressure_increment"][i],
            "DDPDDH": a["contact_stiffness"][i], "SLIP": c["slip"][:, i], "KSTEP": STEP,
            "KINC": INCREMENT, "TIME": np.array(TIMES[:2]), "DTIME": TIMES[2],
            "NOEL": 51 + i, "CINAME": padded(NAMES["interaction"]),
            "SECNAME": padded(NAMES["secondary"]), "MAINNAME": padded(NAMES["main"]),
            "NPT": 71 + i, "NODE": 91 + i, "NPATCH": 0, "COORDS": a["coord"][:, i],
            "RCOORD": a["coord_main"][:, i], "DROT": a["rotation"][:, :, i], "TEMP": pair,
            "PREDEF": predef, "NFDIR": f, "MCRD": self.dimension, "NPRED": p,
            "NSTATV": self.states, "CHRLNGTH": LENGTH, "PROPS": np.array(PROPS),
            "NPROPS": len(PROPS),
        }  # fmt: skip

    def slip_data(self, i: int) -> np.ndarray:
        """What an isotropic coefficient is asked at: the plastic slip of the elastic predictor."""
        f, c = self.f, self.committed
        elastic = c["elastic_slip"][:, i]
        if f == 2 and "rotation" in self.arrays:
            elastic = self.arrays["rotation"][:, :, i] @ elastic
        predictor = elastic + self.arrays["slip_increment"][:, i]
        size = np.linalg.norm(predictor)
        plastic = np.zeros(2)
        plastic[:f] = max(size - CRITICAL, 0.0) * predictor / size
        length = np.linalg.norm(plastic)
        slip = np.zeros(2)
        slip[:f] = c["slip"][:, i]
        rate = [length / TIMES[2], *plastic / TIMES[2]]
        return np.array([*rate, c["equivalent_slip"][i] + length, *(slip + plastic)])

    def fric_coef(self, i: int) -> dict:
        """Arguments of FRIC_COEF at point i, one point a call."""
        a, c, p, warm = self.arrays, self.committed, self.fields, self.temperatures
        means = {
            name: (a[f"{name}_secondary"][..., i] + a[f"{name}_main"][..., i]) / 2
            for name in ("temperature", *(["field"] if p else []))
        }
        common = {
            "nBlock": 1, "nProps": 3, "nTemp": warm, "nFields": p,
            "surfInt": padded(NAMES["interaction"]), "surfSec": padded(NAMES["secondary"]),
            "surfMain": padded(NAMES["main"]), "props": np.array(PROPS),
            "pressure": a["pressure"][[i]],
            "tempAvg": Computed([means["temperature"]]) if warm else np.zeros(1),
            "fieldAvg": Computed(means["field"][None, :]) if p else np.zeros((1, 0)),
        }  # fmt: skip
        data = self.slip_data(i)
        if self.generation == "legacy":
            return common | {
                "fCoef": np.zeros(1), "fCoefDeriv": np.zeros((1, 3)), "rData": np.array(TIMES),
                "jFlags": np.array([STEP, INCREMENT]), "slipRate": Computed(data[:1]),
            }  # fmt: skip
        head = [*TIMES, *a["rotation"][:, :, i].ravel(order="F")]
        return common | {
            "fCoef": np.array([[0.0, np.nan]]), "fCoefDeriv": np.zeros((1, 20, 2)),
            "rData": np.array([*head, *c["state"][:, i]]),
            "iData": np.array([STEP, INCREMENT, 1, 91 + i, self.states, self.f]),
            "slipData": Computed(data[None, :]),
        }  # fmt: skip
