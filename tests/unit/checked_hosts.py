# SPDX-License-Identifier: MIT
"""Small checked drivers of every interface, and routines in C that do one thing wrong."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, field

import numpy as np

import usersub
from usersub import abi

POINTS, PROPS, STATES, FIELDS = 3, (0.3, 100.0), 2, 2
SECONDARY_NODES, MAIN_NODES, NODES = 5, 7, 9

#: What a host needs, so that the rest of a routine is right.
NEEDED = {
    "fric": "*LM = 0; for (int a = 0; a < *NFDIR; a++) { TAU[a] = 0; DDTDDP[a] = 0; "
    "for (int b = 0; b < *NFDIR; b++) DDTDDG[a + *NFDIR * b] = 0; }",
    "fric_coef": "for (int k = 0; k < *nBlock; k++) fCoef[k] = 0.5;",
    "vfric": "for (int k = 0; k < *nContact * *nFricDir; k++) fTangential[k] = -0.25;",
    "vfriction": "for (int k = 0; k < *nBlock * *nFricDir; k++) fTangential[k] = -0.25;",
    "vfric_coef": "for (int k = 0; k < *nBlock; k++) fCoef[k] = 0.5;",
}


def source(
    interface: str, body: str = "", generation: str = "legacy", *, head: str = "", needed: str = ""
) -> str:
    """C source of a routine that does what is needed (or `needed`), and then `body`."""
    key = abi.interface(interface, generation).key.upper()
    return (
        f"#include <usersub/abi.h>\n{head}\nvoid {interface}_(USUB_{key}_PARAMETERS) {{\n"
        f"{needed or NEEDED[interface]}\n{body}\n}}\n"
    )


def flags_of(precision: str) -> str:
    """What the header wants to know of the precision."""
    return "#define USUB_SINGLE\n" if precision == "single" else ""


@dataclass
class Host:
    """One checked driver and how it is called. `call()` makes the routine run once or more."""

    interface: str
    dimension: int = 3
    contact: str = "node-to-facet"
    precision: str = "double"
    kind: str = ""
    generation: str = "legacy"
    points: int = POINTS
    settings: dict = field(default_factory=dict)

    @property
    def edges(self) -> bool:
        return self.contact == "edge-to-edge"

    @property
    def rigid(self) -> bool:
        return self.contact == "analytical-rigid"

    def sizes(self, n: int) -> dict[str, int]:
        """Values of the integers that stand in dimensions, in a call of `n` points."""
        d, vfric = self.dimension, self.interface == "vfric"
        corners = 2 if self.edges or d == 2 else 4
        values = {
            "NFDIR": d - 1, "MCRD": d, "NPRED": FIELDS, "NSTATV": STATES, "NPROPS": len(PROPS),
            "nBlock": n, "nContact": n, "nProps": len(PROPS), "nFields": FIELDS, "nPred": FIELDS,
            "nFricDir": d - 1, "nDir": d, "nStateVar": STATES, "nStates": STATES,
            "nSlvNod": SECONDARY_NODES, "nMstNod": MAIN_NODES,
            "nFacNod": 0 if self.rigid else corners, "nNodMst": 1 if self.rigid else corners,
            "nNodSlv": 2 if self.edges else 1, "nNodState": 4 if self.edges else 1,
            "numDefTfv": 1 if self.rigid else n, "nBlockAnal": 1 if self.rigid else n,
            "nBlockEdge": n if self.edges else 1, "7+iData(5)": 7 + self.states,
        }  # fmt: skip
        assert vfric or self.interface in NEEDED
        return values

    @property
    def states(self) -> int:
        legacy = self.interface == "fric_coef" and self.generation == "legacy"
        return 0 if legacy or self.interface == "vfric_coef" else STATES

    def shape(self, arg: abi.Arg, n: int) -> tuple[int, ...]:
        """Dimensions of an argument in a call of `n` points."""
        if arg.kind == "char":
            return (80,)
        values = self.sizes(n)
        return tuple(int(s) if s.isdigit() else values[s] for s in arg.shape)

    def driver(self, routine, **settings):
        explicit = self.interface in ("vfric", "vfriction", "vfric_coef")
        kind = self.kind or ("explicit" if explicit else "standard")
        nodes = {}
        if explicit and kind == "explicit":
            nodes = {"nodes": NODES}
            if self.interface == "vfric":
                nodes = {"secondary_nodes": SECONDARY_NODES, "main_nodes": MAIN_NODES}
        more = {"contact": self.contact} if kind == "explicit" else {}
        if self.interface == "fric_coef":
            more["generation"] = self.generation
            more["elastic_slip"] = 1e-3
        scene = usersub.Scene(
            points=self.points, dimension=self.dimension, precision=self.precision,
            props=PROPS, states=self.states, fields=FIELDS, temperatures=1,
            **{"checked": 1, **nodes, **more, **self.settings, **settings},
        )  # fmt: skip
        made = {
            "standard": usersub.StandardDriver,
            "explicit": usersub.ExplicitDriver,
            "coefficient": usersub.CoefficientDriver,
        }[kind](routine, scene)
        made.bind(**self._arrays(made))
        return made

    def _arrays(self, driver) -> dict[str, np.ndarray]:
        """Sensible values for every input of the driver."""
        given = {}
        for name, port in driver.layout.ports.items():
            shape, dtype = driver.layout.shapes[name], driver.layout.dtypes[name]
            if port.role != "in" or 0 in shape or name in ("closed", "multiplier", "mass"):
                continue
            if name in ("predicted_velocity", "rotation", "element", "integration_point"):
                continue
            array = np.zeros(shape, dtype, order="F")
            array[...] = 1 if dtype == np.int32 else 0.75
            if name == "normal":
                array[...] = 0
                array[-1] = 1
            elif name == "slip_increment":
                array[...] = 0
                array[0] = 0.01
            elif name == "slip_data" and "slip_rate" in driver.layout.ports:
                array[0] = 0.1
            given[name] = array
        return given

    def run(self, driver) -> None:
        """One call of the driver."""
        if isinstance(driver, usersub.StandardDriver):
            driver.begin_increment(0.5)
            try:
                driver.iterate()
            finally:
                driver.cut_back()
        elif isinstance(driver, usersub.ExplicitDriver):
            driver.step(0.5)
        else:
            driver.evaluate(time_increment=0.5)

    def points_a_call(self) -> int:
        """Contact points of the first call of the routine."""
        if self.interface == "fric" or (self.interface == "fric_coef"):
            return 1
        return self.points


#: Every interface in every place: dimension, contact, precision, kind of driver, generation.
HOSTS = [
    *(Host("fric", d) for d in (2, 3)),
    *(Host("fric_coef", d, generation=g) for d in (2, 3) for g in ("legacy", "2022")),
    *(Host("fric_coef", kind="coefficient", generation=g) for g in ("legacy", "2022")),
    *(
        Host("vfric", d, c, p)
        for d in (2, 3)
        for c in ("node-to-facet", "analytical-rigid")
        for p in ("double", "single")
    ),
    *(
        Host("vfriction", 3, c, p)
        for c in ("node-to-facet", "edge-to-edge", "analytical-rigid")
        for p in ("double", "single")
    ),
    *(Host("vfric_coef", d, precision=p) for d in (2, 3) for p in ("double", "single")),
    Host("vfric_coef", kind="coefficient", precision="single"),
]


def name_of(host: Host) -> str:
    """For test identifiers."""
    words = (host.interface, host.generation, host.dimension, host.contact, host.precision)
    return "-".join(map(str, (*words, host.kind or "enforced")))


def acting(host: Host) -> str:
    """Source of a routine that touches one byte where global variables say."""
    face = abi.interface(host.interface, host.generation)
    names = ", ".join(f"(void *){a.modern}" for a in face.args)
    head = (
        flags_of(host.precision)
        + "int act_argument = -1, act_write; long act_bytes; volatile char act_sink;"
    )
    body = (
        f"void *argv[] = {{{names}}};\n"
        "if (act_argument >= 0) {\n"
        "  volatile char *at = (char *)argv[act_argument] + act_bytes;\n"
        "  if (act_write) *at = 1; else act_sink = *at;\n"
        "}"
    )
    text = source(host.interface, body, host.generation)
    return head + "\n" + text


class Controls:
    """The global variables of a routine made by `acting`."""

    def __init__(self, routine, precision: str) -> None:
        self.library = routine.make_entry(precision).keep

    def set(self, argument: int, by: int, write: bool) -> None:
        ctypes.c_int.in_dll(self.library, "act_argument").value = argument
        ctypes.c_long.in_dll(self.library, "act_bytes").value = by
        ctypes.c_int.in_dll(self.library, "act_write").value = int(write)
