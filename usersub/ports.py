# SPDX-License-Identifier: MIT
"""What a host hands over: the settings of a scene and the arrays of a driver, once.

From these tables come the C core's own tables (`csrc/driver/ports.inc`), the checks of the
Python drivers and the reference pages. Standard library only.

Shapes are Fortran-ordered (first index fastest), in the symbols of `DIMENSIONS`; the index of the
contact point is last, so that a block of points is a slice of the host's own memory.
Node numbers count from one, as in the routines.
"""

from __future__ import annotations

from dataclasses import dataclass

#: Symbols of array shapes. `N` is the number of contact points that the driver was made for.
DIMENSIONS = {
    "N": "contact points (`points`)",
    "D": "coordinate directions (`dimension`)",
    "F": "friction directions",
    "S": "state variables (`states`)",
    "P": "field variables (`fields`)",
    "A": "N, or 1 for an analytical rigid main surface",
    "B": "secondary nodes of a point: 1 node, 2 edge",
    "M": "main nodes of a point: 2 (two dimensions) or 4 facet, 2 edge, 1 analytical rigid",
    "X": "nodes of the secondary surface (`secondary_nodes`)",
    "Y": "nodes of the main surface (`main_nodes`)",
    "Z": "nodes of the model (`nodes`)",
    "T": "states a point keeps: 1 for nodes, 4 for edges",
}


@dataclass(frozen=True)
class Setting:
    """One setting of a scene: `key`, `kind` ("int", "real", "text"), `default`, `meaning`."""

    key: str
    kind: str
    default: object
    meaning: str
    choices: tuple[str, ...] = ()


@dataclass(frozen=True)
class Port:
    """One array between host and driver.

    Attributes:
        name: the name under which it is bound.
        drivers: the interfaces whose driver has it.
        kind: "real" (precision of the scene) or "int" (4 bytes).
        shape: symbols of `DIMENSIONS` or numbers, first index fastest.
        role: "in" read; "out" written, owned by the driver unless bound; "add" added to by a
            step, only if bound; "state" kept by the driver, visible to the host.
        unit, meaning: for the reader.
        unbound: what the routine sees where the host binds nothing; "" if it must be bound
            whenever the routine reads it, "required" if it must always be bound.
    """

    name: str
    drivers: tuple[str, ...]
    kind: str
    shape: tuple[str, ...]
    role: str
    unit: str
    meaning: str
    unbound: str = ""


SETTINGS: tuple[Setting, ...] = (
    Setting("points", "int", 1, "contact points that the driver holds, at most"),
    Setting("dimension", "int", 3, "coordinate directions: 2 or 3"),
    Setting(
        "friction_directions",
        "int",
        0,
        "friction directions; 0 means dimension - 1. Standard only: 2 in an axisymmetric "
        "analysis with twist",
    ),
    Setting("precision", "text", "double", "precision of all real arrays", ("double", "single")),
    Setting(
        "contact",
        "text",
        "node-to-facet",
        "kind of contact (explicit)",
        ("node-to-facet", "edge-to-edge", "analytical-rigid"),
    ),
    Setting("secondary_nodes", "int", 0, "nodes of the secondary surface (VFRIC)"),
    Setting("main_nodes", "int", 0, "nodes of the main surface (VFRIC)"),
    Setting("nodes", "int", 0, "nodes of the model (VFRICTION, VFRIC_COEF)"),
    Setting("states", "int", 0, "state variables (DEPVAR)"),
    Setting("fields", "int", 0, "field variables"),
    Setting("temperatures", "int", 0, "1 if the surfaces have temperatures"),
    Setting("interaction", "text", "", "name of the interaction"),
    Setting("secondary", "text", "", "name of the secondary surface"),
    Setting("main", "text", "", "name of the main surface"),
    Setting(
        "generation",
        "text",
        "2022",
        "generation of FRIC_COEF that the host speaks",
        ("legacy", "2022"),
    ),
    Setting("anisotropic", "int", 0, "1 if FRIC_COEF sets two coefficients"),
    Setting("elastic_slip", "real", 0.0, "allowable elastic slip; 0 means by slip_tolerance"),
    Setting("slip_tolerance", "real", 0.005, "allowable elastic slip over characteristic_length"),
    Setting("characteristic_length", "real", 0.0, "characteristic contact face dimension"),
    Setting(
        "enforcement",
        "text",
        "default",
        "how sticking is enforced. FRIC_COEF: penalty (default) or lagrange; explicit: kinematic "
        "or penalty (default: the host's stick_force)",
        ("default", "penalty", "lagrange", "kinematic"),
    ),
    Setting(
        "stick_slope",
        "real",
        0.0,
        "softened tangential behaviour: slope of stress against elastic slip; 0 means none "
        "(FRIC_COEF, VFRIC_COEF)",
    ),
    Setting(
        "damping",
        "real",
        0.0,
        "tangential damping: stress per slip velocity; 0 means none (FRIC_COEF, VFRIC_COEF)",
    ),
    Setting(
        "shear_limit",
        "real",
        0.0,
        "limit on the equivalent shear stress; 0 means none (FRIC_COEF, VFRIC_COEF)",
    ),
    Setting(
        "changing",
        "int",
        0,
        "1 if friction goes from its values at the start of the step to its new ones by an "
        "amplitude; 2 if the coefficient does and the allowable elastic slip is new at once "
        "(FRIC_COEF)",
    ),
    Setting("tangent", "int", 1, "1 if the host wants tangents (standard)"),
    Setting("temperature_tangent", "int", 0, "1 if the host wants DDTDDT (standard)"),
    Setting("derivatives", "int", 0, "1 if the host wants fCoefDeriv (coefficient driver)"),
    Setting("dissipation", "int", 0, "1 if the driver sums the frictional dissipation (explicit)"),
    Setting(
        "skip_open",
        "int",
        0,
        "1 if points without normal force are left out of the routine's blocks: no force, state as "
        "it was (VFRICTION, VFRIC_COEF)",
    ),
    Setting("block", "int", 0, "contact points a call; 0 lets the plan choose"),
    Setting("threads", "int", 1, "threads over blocks"),
    Setting(
        "checked",
        "int",
        0,
        "1 runs the routine in guarded memory and compares what it does; slower",
    ),
    Setting("pass_everything", "int", 0, "1 to pass every argument, read or not (for comparison)"),
)

_STANDARD = ("fric", "fric_coef")
_EXPLICIT = ("vfric", "vfriction", "vfric_coef")
_GENERAL = ("vfriction", "vfric_coef")
_ALL = _STANDARD + _EXPLICIT
_COEFFICIENT = ("coefficient",)


def _port(name, drivers, shape, role, unit, meaning, unbound="", kind="real"):
    return Port(name, drivers, kind, tuple(shape.split(",")), role, unit, meaning, unbound)


# One array a line or two reads as a table; the formatter would make it five times as long.
# fmt: off
PORTS: tuple[Port, ...] = (
    # Standard.
    _port("slip_increment", _STANDARD, "F,N", "in", "length",
          "sliding motion of the increment in local directions", "required"),
    _port("pressure", _STANDARD, "N", "in", "stress",
          "contact pressure at the end of the increment", "required"),
    _port("closed", _STANDARD, "N", "in", "-", "1 where the point is closed, 0 where it is open",
          "closed where the pressure is positive", kind="int"),
    _port("pressure_increment", ("fric",), "N", "in", "stress", "change of the pressure",
          "pressure minus the pressure of the last committed increment"),
    _port("contact_stiffness", ("fric",), "N", "in", "stress/length",
          "pressure increment by overclosure increment", "0"),
    _port("multiplier", _STANDARD, "F,N", "in", "stress",
          "constraint stress of points that stick by Lagrange multipliers",
          "0 (FRIC); FRIC_COEF must have it where the enforcement is lagrange"),
    _port("element", ("fric",), "N", "in", "-", "element labels (contact elements)", "0",
          kind="int"),
    _port("integration_point", ("fric",), "N", "in", "-", "integration points (contact elements)",
          "0", kind="int"),
    _port("node", _STANDARD, "N", "in", "-", "numbers of the secondary nodes",
          "number of the point, from one; 0 where element labels are bound", kind="int"),
    _port("coord", ("fric",), "D,N", "in", "length", "coordinates of the points"),
    _port("coord_main", ("fric",), "D,N", "in", "length", "coordinates of the opposing points",
          "0"),
    _port("rotation", _STANDARD, "2,2,N", "in", "-", "rotation increment of the local directions",
          "unit matrix"),
    _port("temperature_secondary", _STANDARD, "N", "in", "temperature",
          "temperature of the secondary surface"),
    _port("temperature_main", _STANDARD, "N", "in", "temperature",
          "temperature of the main surface"),
    _port("field_secondary", _STANDARD, "P,N", "in", "any",
          "field variables of the secondary surface"),
    _port("field_main", _STANDARD, "P,N", "in", "any", "field variables of the main surface"),
    _port("tau", _STANDARD, "F,N", "out", "stress", "friction stress"),
    _port("ddtddg", _STANDARD, "F,F,N", "out", "stress/length",
          "derivative of the stress by the sliding motion (row stress, column motion)"),
    _port("ddtddp", _STANDARD, "F,N", "out", "-", "derivative of the stress by the pressure"),
    _port("ddtddt", _STANDARD, "F,2,N", "out", "stress/temperature",
          "derivative of the stress by the two temperatures"),
    _port("lm", _STANDARD, "N", "out", "-",
          "relative motion: 0 allowed, 1 none, 2 frictionless or open", kind="int"),
    _port("dslip", _STANDARD, "F,N", "out", "length", "increment of non-recoverable slip"),
    _port("sed", _STANDARD, "N", "out", "energy/area", "elastic energy density"),
    _port("sfd", _STANDARD, "N", "out", "energy/area", "dissipation of the increment"),
    _port("coefficient", ("fric_coef",), "2,N", "out", "-", "friction coefficients"),
    _port("slip", _STANDARD, "F,N", "state", "length", "accumulated non-recoverable slip"),
    _port("condition", _STANDARD, "N", "state", "-",
          "condition of the last committed increment: 0 slipping, 1 sticking, 2 open", kind="int"),
    _port("committed_tau", _STANDARD, "F,N", "state", "stress", "committed friction stress"),
    _port("committed_sed", _STANDARD, "N", "state", "energy/area", "committed elastic energy"),
    _port("committed_pressure", _STANDARD, "N", "state", "stress", "committed pressure"),
    _port("elastic_slip", ("fric_coef",), "F,N", "state", "length", "committed elastic slip"),
    _port("equivalent_slip", ("fric_coef",), "N", "state", "length",
          "accumulated magnitude of the slip"),
    _port("committed_coefficient", ("fric_coef",), "2,N", "state", "-",
          "coefficients of the last committed increment in which the point was closed"),
    _port("start_coefficient", ("fric_coef",), "2,N", "state", "-",
          "coefficients at the start of the step, from which changing friction goes"),
    _port("committed_allowable", ("fric_coef",), "N", "state", "length",
          "allowable elastic slip of the last committed increment"),
    _port("start_allowable", ("fric_coef",), "N", "state", "length",
          "allowable elastic slip at the start of the step; 0 where there is none"),
    _port("state", _STANDARD, "S,N", "state", "any", "committed state variables"),
    # Explicit.
    _port("slip_increment", _EXPLICIT, "D,N", "in", "length",
          "slip increment of the secondary against the main surface, global components",
          "required"),
    _port("normal", _EXPLICIT, "D,N", "in", "-",
          "unit normal of the main surface, global components", "required"),
    _port("normal_force", _EXPLICIT, "N", "in", "force", "normal force, not negative",
          "required"),
    _port("stick_force", _EXPLICIT, "N", "in", "force",
          "force that would stop the slip; the driver's own where the enforcement is kinematic or "
          "penalty"),
    _port("mass", _EXPLICIT, "N", "in", "mass",
          "mass that the stick force stops (kinematic enforcement)"),
    _port("predicted_velocity", _EXPLICIT, "D,N", "in", "length/time",
          "velocity that the increment would end with without friction, of the secondary against "
          "the main surface, global components (kinematic enforcement)",
          "slip increment by time increment"),
    _port("previous_force", _EXPLICIT, "D,N", "in", "force",
          "friction force of the previous increment, global components",
          "the driver's own force of the last step, in VFRIC that of the secondary node"),
    _port("secondary_node", ("vfric",), "N", "in", "-",
          "surface node number of each contact point", kind="int"),
    _port("main_node", ("vfric",), "M,N", "in", "-",
          "surface node numbers of each main facet", kind="int"),
    _port("secondary_number", ("vfric",), "X", "in", "-", "global numbers of the secondary nodes",
          "surface node number", kind="int"),
    _port("main_number", ("vfric",), "Y", "in", "-", "global numbers of the main nodes",
          "surface node number", kind="int"),
    _port("secondary_node", _GENERAL, "B,N", "in", "-",
          "secondary node numbers of each contact point", kind="int"),
    _port("main_node", _GENERAL, "M,A", "in", "-", "main node numbers of each contact point",
          kind="int"),
    _port("shape_main", _EXPLICIT, "M,A", "in", "-", "main shape functions at the contact point"),
    _port("shape_secondary", _GENERAL, "B,N", "in", "-",
          "secondary shape functions at the contact point", "1 for nodes"),
    _port("area", ("vfric",), "X", "in", "area", "area of each secondary node", "1"),
    _port("area", _GENERAL, "N", "in", "area", "contact area", "1"),
    _port("coord_secondary", ("vfric",), "D,X", "in", "length",
          "coordinates of the secondary nodes"),
    _port("coord_main", ("vfric",), "D,Y", "in", "length", "coordinates of the main nodes"),
    _port("coord", ("vfriction",), "D,Z", "in", "length", "coordinates of all nodes"),
    _port("velocity", ("vfriction",), "D,Z", "in", "length/time", "velocities of all nodes"),
    _port("temperature_secondary", _EXPLICIT, "N", "in", "temperature",
          "temperature of the secondary surface"),
    _port("temperature_main", _EXPLICIT, "A", "in", "temperature",
          "temperature of the main surface"),
    _port("field_secondary", _EXPLICIT, "P,N", "in", "any",
          "field variables of the secondary surface"),
    _port("field_main", _EXPLICIT, "P,A", "in", "any", "field variables of the main surface"),
    _port("force", _EXPLICIT, "D,N", "out", "force",
          "friction force on the secondary side of each point, global components"),
    _port("coefficient", ("vfric_coef",), "N", "out", "-", "friction coefficient"),
    _port("secondary_force", ("vfric",), "D,X", "add", "force", "forces on the secondary nodes"),
    _port("main_force", ("vfric",), "D,Y", "add", "force", "forces on the main nodes"),
    _port("nodal_force", _GENERAL, "D,Z", "add", "force", "forces on all nodes"),
    _port("condition", _EXPLICIT, "N", "state", "-",
          "condition of the last increment where the driver enforces sticking: 0 slipping, "
          "1 sticking, 2 open", kind="int"),
    _port("elastic_slip", ("vfric_coef",), "D,N", "state", "length",
          "elastic slip of penalty enforcement, global components"),
    _port("last_normal", _GENERAL, "D,N", "state", "-",
          "normals of the last increment, with which elastic slips and forces turn (penalty)"),
    _port("last_normal", ("vfric",), "D,X", "state", "-",
          "the same by secondary node"),
    _port("state", ("vfric",), "S,X", "state", "any", "state variables by secondary node"),
    _port("state", ("vfriction",), "S,T,N", "state", "any", "state variables by contact point"),
    # Coefficient alone: FRIC_COEF and VFRIC_COEF without enforcement.
    _port("slip_rate", _COEFFICIENT, "N", "in", "length/time", "equivalent slip rate"),
    _port("slip_data", _COEFFICIENT, "6,N", "in", "length/time, length",
          "1 slip-rate magnitude, 2 and 3 slip rate, 4 equivalent slip, 5 and 6 slip "
          "(FRIC_COEF of 2022)"),
    _port("pressure", _COEFFICIENT, "N", "in", "stress", "contact pressure"),
    _port("temperature", _COEFFICIENT, "N", "in", "temperature",
          "average temperature of the two surfaces"),
    _port("field", _COEFFICIENT, "P,N", "in", "any",
          "average field variables of the two surfaces"),
    _port("coefficient", _COEFFICIENT, "N", "out", "-", "friction coefficient"),
    _port("second_coefficient", _COEFFICIENT, "N", "out", "-",
          "second coefficient of an anisotropic FRIC_COEF"),
    _port("derivative", _COEFFICIENT, "3,N", "out", "per slip rate, pressure, temperature",
          "derivatives of the coefficient"),
    _port("state", _COEFFICIENT, "S,N", "state", "any", "state variables (FRIC_COEF of 2022)"),
)
# fmt: on
