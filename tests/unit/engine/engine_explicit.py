# SPDX-License-Identifier: MIT
"""An explicit host with different numbers everywhere, and what each routine is told of it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from engine_probe import Computed, padded

import usersub

PROPS = (0.25, -7.0, 3.5)
STEP, INCREMENT, TIMES, WORK = 2, 5, (0.625, 3.375, 0.125), 41.5
NODES, SECONDARY_NODES, MAIN_NODES = 19, 13, 11
NAMES = {"interaction": "Pad on Disc", "secondary": "pad-1", "main": "disc"}
#: Interface, dimension, kind of contact: all that exist.
PLACES = [("vfric", d, c) for d in (2, 3) for c in ("node-to-facet", "analytical-rigid")]
PLACES += [("vfriction", 3, c) for c in ("node-to-facet", "edge-to-edge", "analytical-rigid")]
PLACES += [("vfric_coef", d, c) for d in (2, 3) for c in ("node-to-facet", "analytical-rigid")]
PLACES += [("vfric_coef", 3, "edge-to-edge")]


@dataclass
class Host:
    """One scene with its arrays; `columns` are the points of a block."""

    interface: str
    points: int = 9
    dimension: int = 3
    contact: str = "node-to-facet"
    precision: str = "double"
    temperatures: int = 0
    fields: int = 0
    states: int = 0
    block: int = 0
    threads: int = 1
    seed: int = 3
    settings: dict = field(default_factory=dict)
    arrays: dict = field(init=False)

    def __post_init__(self) -> None:
        self.vfric = self.interface == "vfric"
        self.edges = self.contact == "edge-to-edge"
        self.rigid = self.contact == "analytical-rigid"
        self.real = np.float64 if self.precision == "double" else np.float32
        self.mains = 1 if self.rigid else self.points
        self.b = 2 if self.edges else 1
        self.m = 1 if self.rigid else 2 if self.edges or self.dimension == 2 else 4
        if self.vfric and self.rigid:
            self.m = 0
        self.t = 4 if self.edges else 1
        self.arrays = self._make_arrays()

    def scene(self) -> usersub.Scene:
        nodes = (
            {"secondary_nodes": SECONDARY_NODES, "main_nodes": MAIN_NODES}
            if self.vfric
            else {"nodes": NODES}
        )
        return usersub.Scene(
            points=self.points, dimension=self.dimension, contact=self.contact, block=self.block,
            precision=self.precision, temperatures=self.temperatures, fields=self.fields,
            states=self.states if self.interface != "vfric_coef" else 0, threads=self.threads,
            props=PROPS, **NAMES, **nodes, **self.settings,
        )  # fmt: skip

    def _make_arrays(self) -> dict[str, np.ndarray]:
        random = np.random.default_rng(self.seed)
        n, d, p = self.points, self.dimension, self.fields
        count_s, count_m = (SECONDARY_NODES, MAIN_NODES) if self.vfric else (NODES, NODES)

        def real(*shape):
            return np.asfortranarray(random.uniform(0.5, 2.0, shape).astype(self.real))

        def nodes(limit, *shape):
            return np.asfortranarray(random.integers(1, limit + 1, shape).astype(np.int32))

        normal = random.normal(size=(d, n))
        arrays = {
            "slip_increment": random.normal(size=(d, n)),
            "normal": normal / np.linalg.norm(normal, axis=0),
            "normal_force": real(n),
            "stick_force": real(n),
            "previous_force": random.normal(size=(d, n)),
            "shape_main": real(self.m, self.mains),
            "temperature_secondary": real(n) + 300,
            "temperature_main": real(self.mains) + 500,
            "field_secondary": real(p, n) + 20,
            "field_main": real(p, self.mains) + 40,
            "main_node": nodes(count_m, self.m, self.mains),
        }
        if self.vfric:
            secondary = random.permutation(count_s)[:n] + 1
            arrays |= {
                "secondary_node": secondary.astype(np.int32),
                "secondary_number": (random.permutation(count_s) + 101).astype(np.int32),
                "main_number": (random.permutation(count_m) + 201).astype(np.int32),
                "area": real(count_s),
                "coord_secondary": real(d, count_s) + 60,
                "coord_main": real(d, count_m) + 80,
            }
        else:
            arrays |= {
                "secondary_node": nodes(count_s, self.b, n),
                "shape_secondary": real(self.b, n) if self.edges else np.ones((1, n)),
                "area": real(n),
            }
        if self.interface == "vfriction":
            arrays |= {"coord": real(d, NODES) + 60, "velocity": real(d, NODES) + 80}
        made = {
            name: np.asfortranarray(a.astype(self.real)) if a.dtype.kind == "f" else a
            for name, a in arrays.items()
        }
        cold = () if self.temperatures else ("temperature_secondary", "temperature_main")
        return {name: a for name, a in made.items() if a.size and name not in cold}

    def axes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Length of the slip, t1, t2, n: projection in double precision."""
        slip = self.arrays["slip_increment"].astype(float)
        n = self.arrays["normal"].astype(float)
        tangential = slip - n * (slip * n).sum(axis=0)
        length = np.linalg.norm(tangential, axis=0)
        t1 = tangential / length
        t2 = np.cross(n.T, t1.T).T if self.dimension == 3 else np.zeros_like(t1)
        return length, t1, t2, n

    def local(self, vectors: np.ndarray) -> np.ndarray:
        """Global vectors (D, N) in local components: t1, (t2,) n."""
        _, t1, t2, n = self.axes()
        parts = [t1, t2, n] if self.dimension == 3 else [t1, n]
        return np.array([(vectors * part).sum(axis=0) for part in parts])

    def columns(self, name: str, block: slice) -> np.ndarray:
        """The part of an array that belongs to a block; all of it where one serves all points."""
        array = self.arrays[name]
        return array if array.shape[-1] != self.points else array[..., block]

    def main(self, name: str, block: slice) -> np.ndarray:
        return self.arrays[name] if self.rigid else self.arrays[name][..., block]

    def blocks(self) -> list[slice]:
        sizes = {"vfric": self.points, "vfriction": 64, "vfric_coef": 256}
        size = self.block or sizes[self.interface]
        return [slice(k, min(k + size, self.points)) for k in range(0, self.points, size)]

    def state_shape(self) -> tuple[int, ...]:
        if self.vfric:
            return (self.states, SECONDARY_NODES)
        return (self.states, self.t, self.points)

    # What the routines should see.

    def expected(self, block: slice, state: np.ndarray, previous: np.ndarray) -> dict:
        return getattr(self, f"_{self.interface}")(block, state, previous)

    def _common(self, block: slice) -> dict:
        warm = self.temperatures
        count = block.stop - block.start
        one = 1 if self.rigid else count
        return {
            "surfInt": padded(NAMES["interaction"]),
            "surfSec": padded(NAMES["secondary"]),
            "surfMain": padded(NAMES["main"]),
            "props": np.array(PROPS, self.real),
            "nProps": len(PROPS),
            "nTemp": warm,
            "tempSec": self.columns("temperature_secondary", block) if warm else np.zeros(count),
            "tempMain": self.main("temperature_main", block) if warm else np.zeros(one),
        }

    def _kinematics(self, block: slice, previous: np.ndarray) -> dict:
        length, t1, _, _ = self.axes()
        slip = np.zeros((self.dimension, self.points))
        slip[0] = length
        count = block.stop - block.start
        return {
            "fTangential": np.zeros((self.dimension - 1, count)),
            "dSlipFric": Computed(slip[:, block]),
            "fStickForce": self.arrays["stick_force"][block],
            "fTangPrev": Computed(self.local(previous)[:, block]),
            "fNormal": self.arrays["normal_force"][block],
            "dircosN": self.arrays["normal"][:, block],
            "t1": Computed(t1[:, block]),
        }

    def _vfric(self, block: slice, state: np.ndarray, previous: np.ndarray) -> dict:
        count = block.stop - block.start
        common, kinematics = self._common(block), self._kinematics(block, previous)
        kinematics["dirCosSl"] = kinematics.pop("t1")
        one = 1 if self.rigid else count
        p = self.fields
        return {
            **common,
            **kinematics,
            "statev": state,
            "kStep": STEP, "kInc": INCREMENT, "nContact": count, "nFacNod": self.m,
            "nSecNod": SECONDARY_NODES, "nMainNod": MAIN_NODES, "nFricDir": self.dimension - 1,
            "nDir": self.dimension, "nStateVar": self.states, "nPred": p, "numDefTfv": one,
            "jSecUid": self.arrays["secondary_number"], "jMainUid": self.arrays["main_number"],
            "jConSecid": self.arrays["secondary_node"][block],
            "jConMainid": self._facets("main_node", block, np.int32),
            "timStep": self.real(TIMES[0]), "timGlb": self.real(TIMES[1]),
            "dTimCur": self.real(TIMES[2]), "lContType": 0, "frictionWork": self.real(WORK),
            "shape": self._facets("shape_main", block, self.real),
            "coordSec": self.arrays["coord_secondary"], "coordMain": self.arrays["coord_main"],
            "areaSec": self.arrays["area"],
            "preDefSec": self.arrays["field_secondary"][:, block].T if p else np.zeros((count, 0)),
            "preDefMain": self.main("field_main", block).T if p else np.zeros((one, 0)),
        }  # fmt: skip

    def _facets(self, name: str, block: slice, dtype) -> np.ndarray:
        if self.m:
            return self.arrays[name][:, block]
        return np.zeros((0, block.stop - block.start), dtype)

    def _vfriction(self, block: slice, state: np.ndarray, previous: np.ndarray) -> dict:
        count = block.stop - block.start
        common, kinematics = self._common(block), self._kinematics(block, previous)
        kinematics["dircosSl"] = kinematics.pop("t1")
        secondary = self.arrays["secondary_node"][:, block]
        main = self.main("main_node", block)
        coord, velocity = self.arrays["coord"], self.arrays["velocity"]
        one, p = (1 if self.rigid else count), self.fields
        return {
            **common,
            **kinematics,
            "state": state[:, :, block],
            "nBlock": count, "nBlockAnal": one, "nBlockEdge": count if self.edges else 1,
            "nNodState": self.t, "nNodSec": self.b, "nNodMain": self.m,
            "nFricDir": 2, "nDir": 3, "nStates": self.states, "nFields": p,
            "jFlags": np.array([STEP, INCREMENT, 0]),
            "rData": np.array([*TIMES, WORK], self.real),
            "jConSecUid": secondary, "jConMainUid": main,
            "areaCont": self.arrays["area"][block],
            "shapeSec": self.arrays["shape_secondary"][:, block] if self.edges else np.ones((1, 1)),
            "shapeMain": self.main("shape_main", block),
            "coordSec": coord[:, secondary - 1], "coordMain": coord[:, main - 1],
            "velSec": velocity[:, secondary - 1], "velMain": velocity[:, main - 1],
            "fieldSec": self.arrays["field_secondary"][:, block] if p else np.zeros((0, count)),
            "fieldMain": self.main("field_main", block) if p else np.zeros((0, one)),
        }  # fmt: skip

    def _vfric_coef(self, block: slice, state: np.ndarray, previous: np.ndarray) -> dict:
        count, p = block.stop - block.start, self.fields
        common = self._common(block)
        warm = common.pop("tempSec").astype(float), common.pop("tempMain").astype(float)
        length = self.axes()[0][block]
        fields = np.zeros((count, 0))
        if p:
            one, two = self.arrays["field_secondary"][:, block], self.main("field_main", block)
            fields = Computed((one.astype(float) + two).T / 2)
        force, area = self.arrays["normal_force"][block], self.arrays["area"][block]
        return {
            **common,
            "fCoef": np.zeros(count),
            "fCoefDeriv": np.zeros((count, 3)),
            "nBlock": count, "nFields": p, "jFlags": np.array([STEP, INCREMENT]),
            "rData": np.array(TIMES, self.real),
            "slipRate": Computed(length / TIMES[2]),
            "pressure": Computed(force.astype(float) / area),
            "tempAvg": Computed((warm[0] + warm[1]) / 2),
            "fieldAvg": fields,
        }  # fmt: skip


def run(driver, arrays):
    return driver.step(
        TIMES[2], step_time=TIMES[0], total_time=TIMES[1], step=STEP,
        increment=INCREMENT, friction_work=WORK, **arrays,
    )  # fmt: skip


def bindable(driver, host) -> dict[str, np.ndarray]:
    return {n: a for n, a in host.arrays.items() if n in driver.layout.ports}
