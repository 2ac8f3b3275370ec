# SPDX-License-Identifier: MIT
"""The argument lists of the five friction interfaces: the only place where they stand.

Everything else that knows an argument (C header, cffi declarations, numba adapters, Fortran
interfaces, documentation tables) is generated from the tables below by `usersub.emit`.

Words: an *interface* is one of FRIC, FRIC_COEF, VFRIC, VFRICTION, VFRIC_COEF. A *generation*
is one published form of an interface; only FRIC_COEF has two. An argument has the older
("slave/master") name and, where it was renamed, the newer ("secondary/main") one; position,
type and dimension are the same for both.

This module uses the standard library only.
"""

from __future__ import annotations

import difflib
import hashlib
from dataclasses import dataclass, field
from functools import cached_property

#: Version of the tables. A changed table needs a new line in `usersub/abi_versions.txt`.
ABI_VERSION = 1

#: Length of the blank-padded names that the drivers pass.
NAME_LENGTH = 80

LEGACY = "legacy"
RELEASE_2022 = "2022"

_PUBLISHED = "manual page of the interface"


@dataclass(frozen=True)
class Arg:
    """One argument of an interface.

    Attributes:
        name: older spelling ("Slv/Mst"), as published.
        modern: newer spelling ("Sec/Main"); equal to `name` where nothing was renamed.
        kind: "real" (precision of the solver), "int" (4 bytes) or "char" (blank-padded text).
        shape: dimensions in the caller's spelling, first index fastest; () for a scalar.
        intent: "read", "write" or "readwrite", seen from the routine.
        unit: physical dimension in words; "-" for none.
        meaning: what it is, in one sentence.
        assumed: what is assumed without a published source; "" where the source is published.
        aliases: spellings seen in the field.
    """

    name: str
    modern: str
    kind: str
    shape: tuple[str, ...]
    intent: str
    unit: str
    meaning: str
    assumed: str = ""
    aliases: tuple[str, ...] = ()

    @property
    def confirmed(self) -> bool:
        """Whether every fact of this entry stands in a published source."""
        return not self.assumed

    @property
    def spellings(self) -> tuple[str, ...]:
        """Every accepted spelling, newest first, each once."""
        return tuple(dict.fromkeys((self.modern, self.name, *self.aliases)))


@dataclass(frozen=True)
class Interface:
    """One interface in one generation.

    Attributes:
        name: lower-case name, for example "vfric_coef".
        generation: "legacy" or "2022"; "legacy" for the interfaces that have one form only.
        solver: "standard" (implicit) or "explicit".
        args: the arguments in their order.
        purpose: what a routine behind it has to supply.
        source: where the list was published.
        assumed: what is assumed about the list as a whole.
    """

    name: str
    generation: str
    solver: str
    args: tuple[Arg, ...] = field(repr=False)
    purpose: str
    source: str = _PUBLISHED
    assumed: str = ""

    @property
    def symbol(self) -> str:
        """External name on Linux: lower case and one underscore."""
        return self.name + "_"

    @property
    def key(self) -> str:
        """Identifier that is unique over interfaces and generations."""
        return self.name if self.generation == LEGACY else f"{self.name}_{self.generation}"

    @property
    def precisions(self) -> tuple[str, ...]:
        """Precisions in which the interface exists."""
        return ("double",) if self.solver == "standard" else ("double", "single")

    @cached_property
    def positions(self) -> dict[str, int]:
        """Position of each argument by lower-case spelling (the languages ignore case)."""
        return {s.lower(): i for i, a in enumerate(self.args) for s in a.spellings}

    def position(self, name: str) -> int:
        """Position of the argument called `name`, in any spelling and case.

        Raises:
            KeyError: no such argument; the message names the nearest spelling.
        """
        found = self.positions.get(name.lower())
        if found is None:
            known = {s.lower(): s for a in self.args for s in a.spellings}
            near = difflib.get_close_matches(name.lower(), known, n=1, cutoff=0.0)
            raise KeyError(
                f"{self.name.upper()} has no argument '{name}'; did you mean '{known[near[0]]}'? "
                f"Its arguments are {', '.join(a.modern for a in self.args)}"
            )
        return found


def _shape(text: str) -> tuple[str, ...]:
    return tuple(text.split(",")) if text else ()


def _arg(name, kind, shape, intent, unit, meaning, assumed="", modern=None, aliases=()):
    return Arg(
        name,
        modern or name,
        kind,
        _shape(shape),
        intent,
        unit,
        meaning,
        assumed,
        tuple(aliases),
    )


def _real(name, shape, unit, meaning, assumed="", intent="read", **more):
    return _arg(name, "real", shape, intent, unit, meaning, assumed, **more)


def _int(name, meaning, assumed="", shape="", intent="read", unit="-", **more):
    return _arg(name, "int", shape, intent, unit, meaning, assumed, **more)


def _name(name, meaning, assumed="", **more):
    return _arg(name, "char", "", "read", "-", meaning, assumed, **more)


_FRIC = (
    _int(
        "LM",
        "relative motion: returned 0 allowed, 1 none (Lagrange multipliers), 2 frictionless; "
        "on entry the value of the last iteration, or at the start of an increment the condition "
        "of the previous increment (0 slipping, 1 sticking, 2 open)",
        "a converged LM = 0 counts as 'slipping' at the next start, elastic stick included",
        intent="readwrite",
    ),
    _real(
        "TAU",
        "NFDIR",
        "stress",
        "friction stress, positive along the sliding motion; at the end of the increment on return",
        "on entry the value at the start of the increment",
        "readwrite",
    ),
    _real(
        "DDTDDG",
        "NFDIR,NFDIR",
        "stress/length",
        "derivative of stress increment a by sliding increment b",
        intent="write",
    ),
    _real(
        "DDTDDP",
        "NFDIR",
        "-",
        "derivative of stress increment by pressure increment",
        intent="write",
    ),
    _real(
        "DSLIP",
        "NFDIR",
        "length",
        "increment of non-recoverable slip; on entry the routine's own value of the last "
        "iteration if LM was 0 there, else zero",
        "zero in the first iteration of an increment",
        "readwrite",
    ),
    _real(
        "SED",
        "",
        "energy/area",
        "elastic energy density, start to end of the increment",
        intent="readwrite",
    ),
    _real(
        "SFD",
        "",
        "energy/area",
        "frictional dissipation of the increment",
        "energy per unit area; heat source in coupled analyses",
        "write",
        aliases=("SPD",),
    ),
    _real(
        "DDTDDT",
        "NFDIR,2",
        "stress/temperature",
        "derivative of stress by secondary (1) and main (2) surface temperature",
        "meaning read from its shape and from TEMP(2)",
        "write",
    ),
    _real(
        "PNEWDT",
        "",
        "-",
        "suggested over current time increment; below 1 asks for a cut-back",
        "preset to a large number; the smallest value of all calls counts",
        "readwrite",
    ),
    _real(
        "STATEV",
        "NSTATV",
        "any",
        "state variables, start to end of the increment",
        "every iteration starts from the values at the start of the increment",
        "readwrite",
    ),
    _real("DGAM", "NFDIR", "length", "increment of sliding motion in the current increment"),
    _real(
        "TAULM",
        "NFDIR",
        "stress",
        "constraint stress of a point that sticks by Lagrange multipliers, else zero",
        "non-zero only if LM was 1 in the previous iteration",
    ),
    _real("PRESS", "", "stress", "contact pressure", "value at the end of the increment"),
    _real("DPRESS", "", "stress", "change of pressure in the increment", "read from its name"),
    _real("DDPDDH", "", "stress/length", "contact stiffness", "read from its name"),
    _real(
        "SLIP",
        "NFDIR",
        "length",
        "total non-recoverable slip",
        "value at the start of the increment",
    ),
    _int("KSTEP", "step number"),
    _int("KINC", "increment number"),
    _real("TIME", "2", "time", "step time, total time", "both at the end of the increment"),
    _real("DTIME", "", "time", "time increment"),
    _int("NOEL", "element label of a contact element", "zero for surface contact"),
    _name("CINAME", "name of the interaction", "or of the contact element set"),
    _name(
        "SLNAME", "name of the secondary surface", "blank for contact elements", modern="SECNAME"
    ),
    _name("MSNAME", "name of the main surface", "blank for contact elements", modern="MAINNAME"),
    _int("NPT", "integration point of a contact element", "zero for surface contact"),
    _int("NODE", "number of the secondary node", "zero for contact elements"),
    _int("NPATCH", "not used", "documented as unused"),
    _real("COORDS", "MCRD", "length", "coordinates of the point", "current coordinates"),
    _real(
        "RCOORD",
        "MCRD",
        "length",
        "coordinates of the opposing point",
        "filled only for a rigid main surface",
    ),
    _real(
        "DROT",
        "2,2",
        "-",
        "rotation increment of the surface directions",
        "unit matrix except against a three-dimensional rigid surface",
    ),
    _real(
        "TEMP",
        "2",
        "temperature",
        "temperature of the secondary (1) and main (2) surface",
        "order of the two surfaces",
    ),
    _real(
        "PREDEF",
        "2,NPRED",
        "any",
        "field variables on the secondary (1) and main (2) surface",
        "order of the two surfaces",
    ),
    _int("NFDIR", "number of friction directions"),
    _int("MCRD", "number of coordinate directions"),
    _int("NPRED", "number of field variables"),
    _int("NSTATV", "number of state variables"),
    _real(
        "CHRLNGTH",
        "",
        "length",
        "characteristic contact face dimension",
        "meant for an allowable elastic slip",
    ),
    _real("PROPS", "NPROPS", "any", "properties given by the user"),
    _int("NPROPS", "number of properties"),
)


def _surface_names(slave, master, modern_slave="surfSec", modern_master="surfMain"):
    return (
        _name("surfInt", "name of the interaction"),
        _name(
            slave,
            "name of the secondary surface",
            "blank in general contact",
            modern=modern_slave,
        ),
        _name(
            master,
            "name of the main surface",
            "blank in general contact",
            modern=modern_master,
            aliases=("surfMast",),
        ),
    )


def _coefficient_counts():
    return (
        _int("nBlock", "number of contact points in the call", "1 in FRIC_COEF in practice"),
        _int("nProps", "number of properties"),
        _int("nTemp", "1 if temperatures exist, else 0", "values 0 and 1"),
        _int("nFields", "number of field variables"),
    )


def _coefficient_tail():
    return (
        _real("pressure", "nBlock", "stress", "contact pressure"),
        _real("tempAvg", "nBlock", "temperature", "average temperature of the two surfaces"),
        _real("fieldAvg", "nBlock,nFields", "any", "average field variables of the two surfaces"),
    )


_FRIC_COEF = (
    _real("fCoef", "nBlock", "-", "friction coefficient", intent="write"),
    _real(
        "fCoefDeriv",
        "nBlock,3",
        "per slip rate, pressure, temperature",
        "derivatives of the coefficient by slip rate, pressure and temperature",
        "order of the three derivatives; feeds the tangent only",
        "write",
    ),
    *_coefficient_counts(),
    _int("jFlags", "1 step number, 2 increment number", shape="2"),
    _real("rData", "3", "time", "1 step time, 2 total time, 3 time increment"),
    *_surface_names("surfSlv", "surfMst"),
    _real("props", "nProps", "any", "properties given by the user"),
    _real("slipRate", "nBlock", "length/time", "equivalent slip rate"),
    *_coefficient_tail(),
)

_FRIC_COEF_2022 = (
    _real(
        "fCoef",
        "nBlock,2",
        "-",
        "friction coefficients; an isotropic routine sets the first and leaves the second alone",
        intent="write",
    ),
    _real(
        "fCoefDeriv",
        "nBlock,20,2",
        "per variable",
        "derivatives by 1 slip-rate magnitude, 2 pressure, 3 temperature, 4 and 5 slip rate, "
        "6 equivalent slip, 7 and 8 slip; the last index is the coefficient",
        "slots 9 to 20 have no published name and are ignored",
        "write",
    ),
    *_coefficient_counts(),
    _int(
        "iData",
        "1 step, 2 increment, 3 iteration, 4 node, 5 number of state variables, "
        "6 number of friction directions",
        shape="6",
    ),
    _real(
        "rData",
        "7+iData(5)",
        "any",
        "1 step time, 2 total time, 3 time increment, 4 to 7 rotation increment, "
        "from 8 the state variables",
        "state variables are start-of-increment values on entry, end-of-increment on return",
        "readwrite",
    ),
    *_surface_names("surfSlv", "surfMst"),
    _real("props", "nProps", "any", "properties given by the user"),
    _real(
        "slipData",
        "nBlock,6",
        "length/time, length",
        "1 slip-rate magnitude, 2 and 3 slip rate, 4 equivalent slip, 5 and 6 slip",
        "values at the end of the increment",
    ),
    *_coefficient_tail(),
)

_VFRIC = (
    _real(
        "fTangential",
        "nFricDir,nContact",
        "force",
        "friction force in local axes, first component between minus the stick force and zero; "
        "zero on entry",
        intent="write",
    ),
    _real(
        "statev",
        "nStateVar,nSlvNod",
        "any",
        "state variables by secondary surface node",
        intent="readwrite",
    ),
    _int("kStep", "step number"),
    _int("kInc", "increment number"),
    _int("nContact", "number of contact points"),
    _int(
        "nFacNod",
        "nodes of a main facet",
        "2 in two and 4 in three dimensions, 0 for an analytical rigid surface",
    ),
    _int("nSlvNod", "nodes of the secondary surface", modern="nSecNod"),
    _int("nMstNod", "nodes of the main surface", modern="nMainNod"),
    _int("nFricDir", "number of friction directions", "nDir - 1"),
    _int("nDir", "number of coordinate directions"),
    _int("nStateVar", "number of state variables"),
    _int("nProps", "number of properties"),
    _int("nTemp", "1 if temperatures exist, else 0", "values 0 and 1"),
    _int("nPred", "number of field variables"),
    _int(
        "numDefTfv",
        "points of the main surface with temperatures and fields",
        "nContact, or 1 for an analytical rigid surface",
    ),
    _int("jSlvUid", "global numbers of the secondary nodes", shape="nSlvNod", modern="jSecUid"),
    _int("jMstUid", "global numbers of the main nodes", shape="nMstNod", modern="jMainUid"),
    _int(
        "jConSlvid",
        "surface node number of each contact point",
        shape="nContact",
        modern="jConSecid",
    ),
    _int(
        "jConMstid",
        "surface node numbers of the main facet of each contact point",
        shape="nFacNod,nContact",
        modern="jConMainid",
    ),
    _real("timStep", "", "time", "step time", "at the end of the increment"),
    _real("timGlb", "", "time", "total time", "at the end of the increment"),
    _real(
        "dTimCur", "", "time", "time increment", "of the current increment", aliases=("dTimPrev",)
    ),
    *_surface_names("surfSlv", "surfMst"),
    _int("lContType", "type of contact", "an opaque number; the drivers pass 0"),
    _real(
        "dSlipFric",
        "nDir,nContact",
        "length",
        "slip increment in local axes: only the first component is not zero, and it is positive",
    ),
    _real(
        "fStickForce",
        "nContact",
        "force",
        "force that would stop the slip",
        "of the kinematic or the penalty method, as the host enforces",
    ),
    _real(
        "fTangPrev",
        "nDir,nContact",
        "force",
        "friction force of the previous increment in the current local axes",
        "zero for points that were open",
    ),
    _real(
        "fNormal", "nContact", "force", "normal force, not negative", "at the end of the increment"
    ),
    _real(
        "frictionWork", "", "energy", "frictional dissipation so far", "total of the whole model"
    ),
    _real(
        "shape",
        "nFacNod,nContact",
        "-",
        "main facet shape functions at the contact point",
        "read from its name and dimensions",
    ),
    _real(
        "coordSlv",
        "nDir,nSlvNod",
        "length",
        "coordinates of the secondary nodes",
        modern="coordSec",
    ),
    _real(
        "coordMst", "nDir,nMstNod", "length", "coordinates of the main nodes", modern="coordMain"
    ),
    _real(
        "dirCosSl",
        "nDir,nContact",
        "-",
        "global components of local direction 1 (slip)",
        aliases=("dirCosT1", "dircosS1"),
    ),
    _real("dircosN", "nDir,nContact", "-", "global components of the main normal"),
    _real("props", "nProps", "any", "properties given by the user"),
    _real(
        "areaSlv",
        "nSlvNod",
        "area",
        "area of each secondary node",
        "1 where the host gives none",
        modern="areaSec",
    ),
    _real(
        "tempSlv",
        "nContact",
        "temperature",
        "temperature of the secondary surface",
        modern="tempSec",
    ),
    _real(
        "preDefSlv",
        "nContact,nPred",
        "any",
        "field variables of the secondary surface",
        modern="preDefSec",
    ),
    _real(
        "tempMst",
        "numDefTfv",
        "temperature",
        "temperature of the main surface",
        modern="tempMain",
    ),
    _real(
        "preDefMst",
        "numDefTfv,nPred",
        "any",
        "field variables of the main surface",
        modern="preDefMain",
    ),
)

_SUBSTITUTED = "the newer name follows the pattern of the renamed arguments"

_VFRICTION = (
    _real(
        "fTangential",
        "nFricDir,nBlock",
        "force",
        "friction force in local axes, first component between minus the stick force and zero; "
        "zero on entry",
        intent="write",
    ),
    _real(
        "state",
        "nStates,nNodState,nBlock",
        "any",
        "state variables of each contact point",
        intent="readwrite",
    ),
    _int("nBlock", "number of contact points in the call"),
    _int("nBlockAnal", "nBlock, or 1 for an analytical rigid main surface"),
    _int("nBlockEdge", "nBlock for edges, else 1"),
    _int("nNodState", "1 for nodes, 4 for edges"),
    _int("nNodSlv", "secondary nodes of a point: 1 node, 2 edge", modern="nNodSec"),
    _int(
        "nNodMst",
        "main nodes of a point: 4 facet, 2 edge, 1 analytical rigid",
        modern="nNodMain",
    ),
    _int("nFricDir", "number of friction directions: 2"),
    _int("nDir", "number of coordinate directions: 3"),
    _int("nStates", "number of state variables"),
    _int("nProps", "number of properties"),
    _int("nTemp", "1 if temperatures exist, else 0", "values 0 and 1"),
    _int("nFields", "number of field variables"),
    _int(
        "jFlags",
        "1 step number, 2 increment number, 3 type of contact",
        "the type is an opaque number; the drivers pass 0",
        shape="3",
    ),
    _real(
        "rData",
        "4",
        "time, energy",
        "1 step time, 2 total time, 3 time increment, 4 frictional dissipation so far",
    ),
    *_surface_names("surfSlv", "surfMst"),
    _int(
        "jConSlvUid",
        "node numbers of the secondary side",
        shape="nNodSlv,nBlock",
        modern="jConSecUid",
    ),
    _int(
        "jConMstUid",
        "node numbers of the main side",
        shape="nNodMst,nBlockAnal",
        modern="jConMainUid",
    ),
    _real("props", "nProps", "any", "properties given by the user"),
    _real(
        "dSlipFric",
        "nDir,nBlock",
        "length",
        "slip increment in local axes: only the first component is not zero, and it is positive",
    ),
    _real("fStickForce", "nBlock", "force", "force that would stop the slip"),
    _real(
        "fTangPrev",
        "nDir,nBlock",
        "force",
        "friction force of the previous increment in the current local axes",
        "zero for points that were open",
    ),
    _real("fNormal", "nBlock", "force", "normal force, not negative"),
    _real(
        "areaCont",
        "nBlock",
        "area",
        "contact area of the point",
        "1 or a nominal area for edges",
    ),
    _real("dircosN", "nDir,nBlock", "-", "global components of the main normal"),
    _real("dircosSl", "nDir,nBlock", "-", "global components of local direction 1 (slip)"),
    _real(
        "shapeSlv",
        "nNodSlv,nBlockEdge",
        "-",
        "secondary shape functions at the contact point",
        _SUBSTITUTED,
        modern="shapeSec",
    ),
    _real(
        "shapeMst",
        "nNodMst,nBlockAnal",
        "-",
        "main shape functions at the contact point",
        _SUBSTITUTED,
        modern="shapeMain",
    ),
    _real(
        "coordSlv",
        "nDir,nNodSlv,nBlock",
        "length",
        "coordinates of the secondary nodes",
        _SUBSTITUTED,
        modern="coordSec",
    ),
    _real(
        "coordMst",
        "nDir,nNodMst,nBlockAnal",
        "length",
        "coordinates of the main nodes",
        _SUBSTITUTED,
        modern="coordMain",
    ),
    _real(
        "velSlv",
        "nDir,nNodSlv,nBlock",
        "length/time",
        "velocities of the secondary nodes, global components",
        _SUBSTITUTED,
        modern="velSec",
    ),
    _real(
        "velMst",
        "nDir,nNodMst,nBlockAnal",
        "length/time",
        "velocities of the main nodes, global components",
        _SUBSTITUTED,
        modern="velMain",
    ),
    _real(
        "tempSlv",
        "nBlock",
        "temperature",
        "temperature of the secondary surface",
        _SUBSTITUTED,
        modern="tempSec",
    ),
    _real(
        "tempMst",
        "nBlockAnal",
        "temperature",
        "temperature of the main surface",
        _SUBSTITUTED,
        modern="tempMain",
    ),
    _real(
        "fieldSlv",
        "nFields,nBlock",
        "any",
        "field variables of the secondary surface",
        _SUBSTITUTED,
        modern="fieldSec",
    ),
    _real(
        "fieldMst",
        "nFields,nBlockAnal",
        "any",
        "field variables of the main surface",
        _SUBSTITUTED,
        modern="fieldMain",
    ),
)

_SHEAR = "the whole shear behaviour of the interface"
_COEFFICIENT = "the friction coefficient; the driver enforces it"

#: Every interface in every generation, in the order of the mission.
INTERFACES: tuple[Interface, ...] = (
    Interface("fric", LEGACY, "standard", _FRIC, _SHEAR),
    Interface("fric_coef", LEGACY, "standard", _FRIC_COEF, _COEFFICIENT, "published field code"),
    Interface("fric_coef", RELEASE_2022, "standard", _FRIC_COEF_2022, _COEFFICIENT),
    Interface("vfric", LEGACY, "explicit", _VFRIC, _SHEAR),
    Interface("vfriction", LEGACY, "explicit", _VFRICTION, _SHEAR, "published field code"),
    Interface(
        "vfric_coef",
        LEGACY,
        "explicit",
        _FRIC_COEF,
        _COEFFICIENT,
        "none found",
        "the whole list is taken to be that of legacy FRIC_COEF, in the precision of the solver, "
        "with many points a call; derivatives are not used",
    ),
)

#: The five interface names.
NAMES: tuple[str, ...] = tuple(dict.fromkeys(i.name for i in INTERFACES))


def interface(name: str, generation: str | None = None) -> Interface:
    """The interface called `name` (any case), in `generation` or in its newest one.

    Raises:
        KeyError: unknown name or generation; the message lists what exists.
    """
    of_name = [i for i in INTERFACES if i.name == name.lower()]
    if not of_name:
        near = difflib.get_close_matches(name.lower(), NAMES, n=1, cutoff=0.4)
        hint = f"; did you mean '{near[0]}'?" if near else "."
        raise KeyError(f"unknown interface '{name}'{hint} Interfaces: {', '.join(NAMES)}")
    if generation is None:
        return of_name[-1]
    for found in of_name:
        if found.generation == generation:
            return found
    raise KeyError(
        f"{name.upper()} has no generation '{generation}'; "
        f"it has {', '.join(i.generation for i in of_name)}"
    )


def canonical() -> str:
    """The tables that bind two binaries as text, one line an argument: what the hash is made of."""
    lines = []
    for face in INTERFACES:
        lines.append(f"interface {face.name} {face.generation} {face.solver}")
        lines += [
            f"{a.name} {a.modern} {a.kind} ({','.join(a.shape)}) {a.intent}" for a in face.args
        ]
    return "\n".join(lines) + "\n"


def abi_hash() -> str:
    """First 16 hexadecimal digits of the SHA-256 of `canonical()`."""
    return hashlib.sha256(canonical().encode()).hexdigest()[:16]
