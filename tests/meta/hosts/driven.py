# SPDX-License-Identifier: MIT
"""A host in Python that uses the drivers: points on springs (fric), masses that slide (vfriction).

python driven.py INTERFACE FAULT

FAULT is the name of a rule that the host breaks, or "none". The routine is the library that the
environment variable USERSUB_PROBE names.
"""

import os
import sys

import numpy as np

import usersub

POINTS, INCREMENTS = 3, 8
SPRING, AREA = 40.0, 1.5


def implicit(routine, fault):
    """Points that springs drag; an increment is halved when the routine asks for that."""
    scene = usersub.Scene(
        points=POINTS, states=2, characteristic_length=0.2, props=[0.25], interaction="RUBBER",
        secondary="TREAD", main="ROAD",
    )  # fmt: skip
    driver = usersub.StandardDriver(routine, scene)
    slip, pressure = np.zeros((2, POINTS), order="F"), np.full(POINTS, 20.0)
    driver.bind(
        slip_increment=slip, pressure=pressure, multiplier=np.zeros((2, POINTS), order="F"),
        coord=np.zeros((3, POINTS), order="F"),
    )  # fmt: skip
    wrong_pressure = np.zeros(POINTS)
    if fault == "host.pressure":
        driver.bind(pressure_increment=wrong_pressure)
    place, time = np.zeros((2, POINTS)), 0.0
    for _ in range(INCREMENTS):
        dt = 0.1
        while True:
            pressure[:] = 20.0 + np.arange(POINTS) + 10.0 * (time + dt)
            wrong_pressure[:] = 7.0
            named = {}
            if fault == "host.times":
                named = {"step_time": time, "total_time": time}
            if fault == "host.increments":
                named = {"increment": 1, "step_time": time + dt, "total_time": time + dt}
            driver.begin_increment(dt, **named)
            asked = iterate(driver, slip, place, time + dt)
            if asked >= 1.0:
                break
            driver.cut_back()
            dt *= 0.8 if fault == "host.cut-back" else asked
        driver.commit()
        place += slip
        time += dt


def iterate(driver, slip, place, time):
    """Newton's method of an increment; PNEWDT below one if the routine wants a shorter one."""
    driven = np.array([1.2 * np.sin(2.0 * time), 1.0 - np.cos(1.5 * time)])[:, None]
    slip[...] = 0.0
    for iteration in range(12):
        response = driver.iterate()
        if response.cut_back:
            return response.pnewdt
        left = SPRING * (driven - place - slip) - AREA * response.tau
        for p in range(POINTS):
            if response.lm[p] == 1:
                driver.array("multiplier")[:, p] = SPRING * (driven[:, 0] - place[:, p]) / AREA
                slip[:, p], left[:, p] = 0.0, 0.0
                continue
            tangent = SPRING * np.eye(2) + AREA * response.ddtddg[:, :, p]
            slip[:, p] += np.linalg.solve(tangent, left[:, p])
        if iteration and np.abs(left).max() < 1e-9:
            break
    return 1.0


def explicit(routine, fault):
    """Masses that slide and are pushed aside, with kinematic stick forces."""
    scene = usersub.Scene(
        points=POINTS, nodes=POINTS + 4, states=1, props=[0.25], interaction="RUBBER"
    )
    driver = usersub.ExplicitDriver(routine, scene)
    normal, slip = np.zeros((3, POINTS), order="F"), np.zeros((3, POINTS), order="F")
    normal[2] = 1.0
    coord, velocity = np.zeros((3, POINTS + 4), order="F"), np.zeros((3, POINTS + 4), order="F")
    velocity[:2, :POINTS] = [[3.0, 4.0, 5.0], [1.0, -1.0, 0.5]]
    main = np.asfortranarray(np.tile(np.arange(4, 8, dtype=np.int32)[:, None], (1, POINTS)))
    mass, stick = np.full(POINTS, 0.02), np.zeros(POINTS)
    driver.bind(
        slip_increment=slip, normal=normal, normal_force=np.full(POINTS, 2.0), area=np.ones(POINTS),
        secondary_node=np.arange(1, POINTS + 1, dtype=np.int32)[None, :], stick_force=stick,
        main_node=main, shape_main=np.full((4, POINTS), 0.25, order="F"), coord=coord,
        velocity=velocity,
    )  # fmt: skip
    if fault == "host.previous-force":
        driver.bind(previous_force=np.asfortranarray(np.ones((3, POINTS))))
    dt = 1e-3
    for number in range(20):
        moving = velocity[:, :POINTS]
        slip[...] = moving * dt
        stick[:] = usersub.stick_force_kinematic(np.asfortranarray(moving), normal, mass, dt)
        if fault == "host.stick-force":
            stick[:] = 0.0
        force = driver.step(dt).force
        coord[:, :POINTS] += moving * dt
        moving += force / mass * dt
        turn = 0.1 + 0.01 * number
        x, y = moving[0].copy(), moving[1].copy()
        moving[0], moving[1] = (
            x * np.cos(turn) - y * np.sin(turn),
            x * np.sin(turn) + y * np.cos(turn),
        )


if __name__ == "__main__":
    interface, fault = sys.argv[1:3]
    routine = usersub.load(os.environ["USERSUB_PROBE"])[interface]
    {"fric": implicit, "vfriction": explicit}[interface](routine, fault)
