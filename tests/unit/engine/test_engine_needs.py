# SPDX-License-Identifier: MIT
"""Arrays that are not there, by what the routine is known to read; and what a wrong word costs."""

from __future__ import annotations

import engine_explicit as ee
import engine_standard as es
import numpy as np
import pytest
from engine_explicit import bindable, run

import usersub
from usersub.errors import RoutineError, SceneError

RICH = {"temperatures": 1, "fields": 2}
#: Argument of a decorated routine and the array that it is made of.
EXPLICIT = {
    "vfric": {
        "fStickForce": "stick_force", "jConSecid": "secondary_node", "jConMainid": "main_node",
        "shape": "shape_main", "coordSec": "coord_secondary", "coordMain": "coord_main",
        "tempSec": "temperature_secondary", "tempMain": "temperature_main",
        "preDefSec": "field_secondary", "preDefMain": "field_main",
    },
    "vfriction": {
        "fStickForce": "stick_force", "jConSecUid": "secondary_node", "jConMainUid": "main_node",
        "shapeMain": "shape_main", "coordSec": "coord", "velMain": "velocity",
        "coordMain": "main_node", "tempSec": "temperature_secondary",
        "tempMain": "temperature_main", "fieldSec": "field_secondary", "fieldMain": "field_main",
    },
    "vfric_coef": {
        "tempAvg": "temperature_main", "fieldAvg": "field_secondary",
    },
}  # fmt: skip
CASES = [(i, argument, array) for i, rows in EXPLICIT.items() for argument, array in rows.items()]


def reading(interface: str, argument: str):
    """A decorated routine that names one argument besides its answer."""
    answer = "fCoef" if interface.endswith("coef") else "fTangential"
    answer = "LM, TAU" if interface == "fric" else answer
    space: dict = {}
    exec(f"def law({answer}, {argument}):\n    pass\n", space)
    return getattr(usersub, interface)(space["law"], compiled=False)


@pytest.mark.parametrize(("interface", "argument", "array"), CASES)
def test_what_an_explicit_routine_reads_has_to_be_bound(interface, argument, array):
    host = ee.Host(interface, **RICH)
    driver = usersub.ExplicitDriver(reading(interface, argument), host.scene())
    arrays = bindable(driver, host)
    with pytest.raises(SceneError, match=f"'{array}' is not bound, but the routine reads "):
        run(driver, arrays | {array: None})
    run(driver, arrays)
    others = {name for name in arrays if name not in (array, "slip_increment", "normal")}
    others -= {"normal_force", "stick_force", "secondary_node", "main_node", "coord"}
    others -= {name for name in arrays if name.split("_")[0] == array.split("_")[0]}
    driver.bind(**dict.fromkeys(others))
    run(driver, {})  # what it does not read need not be there


@pytest.mark.parametrize(
    ("interface", "argument", "setting"),
    [("vfric", "coordSec", "secondary_nodes"), ("vfric", "coordMain", "main_nodes"),
     ("vfriction", "coordSec", "nodes"), ("vfriction", "velMain", "nodes")],
)  # fmt: skip
def test_nodes_that_a_routine_reads_have_to_be_counted(interface, argument, setting):
    host = ee.Host(interface)
    scene = host.scene().replace(secondary_nodes=0, main_nodes=0, nodes=0)
    driver = usersub.ExplicitDriver(reading(interface, argument), scene)
    arrays = {n: host.arrays[n] for n in ("slip_increment", "normal", "normal_force")}
    with pytest.raises(SceneError, match=f"'{setting}' = 0, but the routine reads {argument}"):
        run(driver, arrays)


STANDARD = {
    "COORDS": "coord", "TEMP": "temperature_main", "PREDEF": "field_secondary",
}  # fmt: skip


@pytest.mark.parametrize(("argument", "array"), STANDARD.items())
def test_what_fric_reads_has_to_be_bound(argument, array):
    host = es.Host("fric", **RICH)
    driver = host.driver(reading("fric", argument), **{array: None})
    with pytest.raises(SceneError, match=f"'{array}' is not bound, but the routine reads"):
        driver.iterate()
    driver.bind(**{array: host.arrays[array]})
    driver.iterate()


@pytest.mark.parametrize(
    ("argument", "quantity"), [("tempAvg", "temperature"), ("fieldAvg", "field")]
)
@pytest.mark.parametrize("side", ["secondary", "main"])
def test_what_fric_coef_reads_has_to_be_bound(argument, quantity, side):
    host = es.Host("fric_coef", **RICH)
    array = f"{quantity}_{side}"
    driver = host.driver(reading("fric_coef", argument), **{array: None})
    with pytest.raises(SceneError, match=f"'{array}' is not bound, but the routine reads"):
        driver.iterate()


@pytest.mark.parametrize(
    ("interface", "contact", "bound", "array"),
    [
        ("vfric", "node-to-facet", "secondary_force", "secondary_node"),
        ("vfric", "node-to-facet", "main_force", "main_node"),
        ("vfric", "node-to-facet", "main_force", "shape_main"),
        ("vfriction", "edge-to-edge", "nodal_force", "shape_secondary"),
        ("vfriction", "analytical-rigid", "nodal_force", "main_node"),
        ("vfric_coef", "node-to-facet", "nodal_force", "shape_main"),
    ],
)
def test_what_spreads_forces_has_to_be_bound(probe, interface, contact, bound, array):
    host = ee.Host(interface, contact=contact)
    driver = usersub.ExplicitDriver(probe("full", interface).routine, host.scene())
    arrays = bindable(driver, host) | {array: None}
    arrays[bound] = np.zeros(driver.layout.shapes[bound], order="F")
    with pytest.raises(SceneError, match=f"'{array}' is not bound; the driver needs it to add"):
        run(driver, arrays)


def test_state_of_vfric_needs_the_nodes_of_the_points(probe):
    host = ee.Host("vfric", states=2)
    driver = usersub.ExplicitDriver(probe("full", "vfric").routine, host.scene())
    with pytest.raises(
        SceneError, match="'secondary_node' is not bound; the driver needs it to keep"
    ):
        run(driver, bindable(driver, host) | {"secondary_node": None})


FAULTS = {
    "STATEV[0] = 1;": r"a memory fault in STATEV, which is not there \(the scene has no state",
    "TAU[0] = PROPS[4];": r"a memory fault in PROPS\(5\), of which the scene has 3",
    "TAU[0] = *(PROPS + *NPROPS); ": r"a memory fault in PROPS\(4\), of which the scene has 3",
    "((double *)TEMP)[1] = 2;": r"a memory fault in TEMP, which is not there \(the scene has no",
}


@pytest.mark.parametrize("body", FAULTS)
def test_arguments_that_are_not_there_have_a_name(tmp_path, body):
    source = tmp_path / "law.c"
    source.write_text(f"#include <usersub/abi.h>\nvoid fric_(USUB_FRIC_PARAMETERS) {{ {body} }}\n")
    driver = es.Host("fric").driver(usersub.load(source).only())
    with pytest.raises(RoutineError, match=FAULTS[body]):
        driver.iterate()


def test_properties_can_all_be_read(tmp_path):
    source = tmp_path / "law.c"
    source.write_text(
        "#include <usersub/abi.h>\n"
        "void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) { fCoef[0] = props[*nProps - 1]; }\n"
    )
    for count in (1, 3, 512, 513, 1000):
        for precision in ("double", "single"):
            props = [float(i) for i in range(count)]
            scene = usersub.Scene(points=1, props=props, precision=precision)
            routine = usersub.load(source, precision=precision).only()
            assert usersub.CoefficientDriver(routine, scene).evaluate()[0] == count - 1
