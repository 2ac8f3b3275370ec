# SPDX-License-Identifier: MIT
"""Drivers and threads: two drivers run at once, one driver refuses a second thread."""

from __future__ import annotations

import threading

import numpy as np
import pytest

import usersub
from usersub.errors import SceneError

#: A routine that waits for a second one, or for the flag `released`; its host can watch it.
MEETS = """
#include <unistd.h>
#include <usersub/abi.h>

volatile int inside, released;

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  __atomic_add_fetch(&inside, 1, __ATOMIC_SEQ_CST);
  for (int wait = 0; inside < 2 && !released && wait < 20000; ++wait)
    usleep(1000);
  for (int k = 0; k < *nBlock; ++k)
    fCoef[k] = inside < 2 && !released ? 0.0 : props[0] * slipRate[k];
}
"""
RATE = np.array([1.0, 3.0, 7.0])


def flags(routine):
    import ctypes

    library = routine.entry("double").keep
    return [ctypes.c_int.in_dll(library, name) for name in ("inside", "released")]


def drivers(routine, *props):
    return [
        usersub.CoefficientDriver(routine, usersub.Scene(points=3, props=[value]))
        for value in props
    ]


def start(function):
    thread = threading.Thread(target=function)
    thread.start()
    return thread


def test_two_drivers_run_at_the_same_time(c_routine):
    """Each call returns only after the other has begun: with the GIL held it could not."""
    routine = c_routine("vfric_coef", MEETS, thread_safe=True)
    inside, released = flags(routine)
    inside.value = released.value = 0
    found = {}

    def work(name, driver):
        found[name] = driver.evaluate(slip_rate=RATE)

    threads = [
        start(lambda n=n, d=d: work(n, d))
        for n, d in zip("ab", drivers(routine, 0.5, 0.25), strict=True)
    ]
    for thread in threads:
        thread.join()
    np.testing.assert_array_equal(found["a"], 0.5 * RATE)
    np.testing.assert_array_equal(found["b"], 0.25 * RATE)


def test_a_driver_that_is_in_use_refuses_another_thread(c_routine):
    routine = c_routine("vfric_coef", MEETS, thread_safe=True)
    inside, released = flags(routine)
    (driver,) = drivers(routine, 0.5)
    released.value = 1
    driver.evaluate(slip_rate=RATE)
    prepared = driver.prepare()
    for call in (lambda: driver.evaluate(slip_rate=RATE), prepared):
        inside.value = released.value = 0
        thread = start(call)
        while inside.value == 0:
            pass
        tries = [call] if call is prepared else [call, lambda: driver.bind(slip_rate=2 * RATE)]
        try:
            for other in tries:
                with pytest.raises(SceneError, match="VFRIC_COEF.*in use by another thread"):
                    other()
        finally:
            released.value = 1
            thread.join()
        np.testing.assert_array_equal(driver.array("coefficient"), 0.5 * RATE)
    assert prepared() == 0  # free again
