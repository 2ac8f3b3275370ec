# SPDX-License-Identifier: MIT
"""Scenes in which compiled laws run, and what comes out of them by mpmath."""

from __future__ import annotations

import numpy as np
from mpmath import mpf

import usersub
from tests.unit import fortran_laws as model

LENGTH = 2.5
ALLOWABLE = 0.005 * LENGTH
TEMPERATURES = (310.0, 190.0)
FIELDS = (0.75, 0.3)
FIELDS_MAIN = (0.35, 0.6)
MEAN_FIELDS = tuple((a + b) / 2 for a, b in zip(FIELDS, FIELDS_MAIN, strict=True))


def standard(routine, law, directions, **more):
    """A driver of one point, after the increment that closes it."""
    length = more.pop("characteristic_length", LENGTH)
    own = {"bristle": law.vectors * directions, "traction": 0}.get(law.kind, directions)
    states = more.pop("states", own + law.states)
    scene = usersub.Scene(
        points=1, dimension=directions + 1, props=law.props, states=states, temperatures=1,
        fields=2, characteristic_length=length, temperature_tangent=1, **more,
    )  # fmt: skip
    driver = usersub.StandardDriver(routine, scene)
    driver.bind(
        temperature_secondary=np.array(TEMPERATURES[:1]),
        temperature_main=np.array(TEMPERATURES[1:]),
        field_secondary=np.array(FIELDS).reshape(2, 1, order="F"),
        field_main=np.array(FIELDS_MAIN).reshape(2, 1, order="F"),
    )
    driver.begin_increment(0.5)
    driver.iterate(slip_increment=np.zeros((directions, 1), order="F"), pressure=np.ones(1))
    driver.commit()
    return driver


def iterate(driver, motion, pressure, dt):
    driver.begin_increment(dt)
    return driver.iterate(
        slip_increment=np.array(motion, float).reshape(-1, 1, order="F"),
        pressure=np.array([pressure]),
    )


#: Motions in units of the allowable elastic slip: sticking, sliding, and on both sides of the
#: corner between the two; of the second increment, after (.4, -.3) of them.
REGIMES = {
    "stick": (0.1, -0.2),
    "slip": (2.5, 4.5),
    "far": (-300.0, 110.0),
    "before the corner": (0.2, -0.4990),
    "after the corner": (0.2, -0.5010),
}


def check_tangents(found, law, now):
    """Entry by entry, with the size of the tangent as the scale of entries that nearly vanish;
    differences by a variable of the size of 70 see the rounding of the stress."""
    rounding = 2e-13 * np.abs(found.tau).max() / 70
    for ours, truth in zip(
        (found.ddtddg, found.ddtddp, found.ddtddt), model.fric_tangents(law, now), strict=True
    ):
        scale = np.abs(truth).max()
        np.testing.assert_allclose(ours[..., 0], truth, rtol=1e-9, atol=1e-10 * scale + rounding)


POINTS = 4
DT = 0.25


def explicit(routine, law, precision, contact="node-to-facet", dimension=3):
    """Two increments of points that differ in everything; forces and state of both."""
    general = routine.interface.name != "vfric"
    main = 1 if contact == "analytical-rigid" else POINTS
    corners = {"analytical-rigid": 1, "edge-to-edge": 2}.get(contact, 4 if dimension == 3 else 2)
    sizes = {"nodes": 40} if general else {"secondary_nodes": POINTS, "main_nodes": corners}
    states = dimension * law.vectors + law.states
    if routine.interface.name == "vfric_coef":
        states = 0
    scene = usersub.Scene(
        points=POINTS, dimension=dimension, props=law.props, states=states, temperatures=1,
        fields=2, precision=precision, contact=contact, **sizes,
    )  # fmt: skip
    driver = usersub.ExplicitDriver(routine, scene)
    generator = np.random.default_rng(11)
    normal = generator.normal(size=(dimension, POINTS))
    normal /= np.linalg.norm(normal, axis=0)
    order = np.array([2, 0, 3, 1])  # contact points are not in the order of the surface
    area = generator.uniform(0.5, 2.0, POINTS)
    arrays = {
        "normal": normal,
        "temperature_secondary": generator.uniform(200.0, 300.0, POINTS),
        "temperature_main": generator.uniform(200.0, 300.0, main),
        "field_secondary": generator.uniform(0.2, 0.9, (2, POINTS)),
        "field_main": generator.uniform(0.2, 0.9, (2, main)),
        "area": area if general else area[np.argsort(order)],
    }
    node = (order + 1).astype(np.int32)
    if general:
        nodes = 2 if contact == "edge-to-edge" else 1
        arrays["secondary_node"] = np.asfortranarray(np.tile(node, (nodes, 1)))
        arrays["main_node"] = np.full((corners, main), 9, np.int32, order="F")
        if contact == "edge-to-edge":
            arrays["shape_secondary"] = np.full((2, POINTS), 0.5)
        arrays["shape_main"] = np.full((corners, main), 1.0 / corners)
    else:
        arrays["secondary_node"] = node
        arrays["main_node"] = np.ones((corners, POINTS), np.int32, order="F")
    seen = []
    for _ in range(2):
        slip = generator.normal(size=(dimension, POINTS)) * 0.05
        slip -= normal * np.einsum("ik,ik->k", slip, normal)
        arrays |= {
            "slip_increment": slip,
            "normal_force": generator.uniform(5.0, 9.0, POINTS) * [1, 0, 1, 1],
            "stick_force": np.array([1e6, 1e6, 2.25, 1e6]),
        }
        real = np.float32 if precision == "single" else np.float64
        given = {
            k: np.asfortranarray(a if a.dtype == np.int32 else a.astype(real))
            for k, a in arrays.items()
            if k in driver.layout.ports
        }
        force = driver.step(DT, **given).force
        rounded = {k: a.astype(float) for k, a in given.items()}
        rounded["stick_force"] = arrays["stick_force"]
        state = np.zeros((0, POINTS)) if not states else driver.state["state"]
        if states and not general:
            state = state[:, order]
        rounded["area"] = area.astype(real).astype(float)
        seen.append((rounded, force, state.copy()))
    return seen


def expected(law, given, before, k, precision):
    """Force and states of point k in mpmath; `before`: states, vectors in global components."""
    real = np.float32 if precision == "single" else float
    n = given["slip_increment"].shape[0]
    main = min(k, given["temperature_main"].size - 1)
    slip = np.array([mpf(v) for v in given["slip_increment"][:, k]])
    length = sum(v * v for v in slip) ** mpf("0.5")
    force, area = mpf(given["normal_force"][k]), mpf(given["area"][k])
    q = {
        "pressure": force / area,
        "temperature": (
            mpf(given["temperature_secondary"][k]) + mpf(given["temperature_main"][main])
        ) / 2,
        "fields": tuple(
            (mpf(a) + mpf(b)) / 2
            for a, b in zip(given["field_secondary"][:, k], given["field_main"][:, main],
                            strict=True)
        ),
        "time_increment": mpf(DT),
    }  # fmt: skip
    props = [mpf(float(real(p))) for p in law.props]
    before = [mpf(float(v)) for v in before]
    t1 = slip / length
    if law.kind != "bristle":
        q = model.Quantities(**q, slip=length, slip_rate=length / DT, state=tuple(before))
        value, end = law.truth(q, props)
        value *= force if law.kind == "coefficient" else area
        return -t1 * min(value, mpf(given["stick_force"][k])), end
    t2 = np.zeros(3) if n == 2 else np.cross(np.array([mpf(v) for v in given["normal"][:, k]]), t1)
    axes = [t1, t2[:n]]
    vectors = tuple(
        tuple(sum(a * b for a, b in zip(axis, before[n * v : n * v + n], strict=True))
              for axis in axes)
        for v in range(law.vectors)
    )  # fmt: skip
    q = model.Quantities(
        **q, motion=(length, mpf(0)), vectors=vectors, state=tuple(before[n * law.vectors :])
    )
    traction, vectors, scalars = law.truth(q, props)
    end = [c for v in vectors for c in v[0] * axes[0] + v[1] * axes[1]]
    return -area * (traction[0] * axes[0] + traction[1] * axes[1]), [*end, *scalars]


EXPLICIT = [
    ("vfric", "node-to-facet", 2),
    ("vfric", "node-to-facet", 3),
    ("vfriction", "node-to-facet", 3),
    ("vfriction", "edge-to-edge", 3),
    ("vfriction", "analytical-rigid", 3),
    ("vfric_coef", "node-to-facet", 3),
]
