# SPDX-License-Identifier: MIT
"""P5 to P8, P23 and P24: exact answers found once more in other ways, creep, drift, stability."""

from __future__ import annotations

import math
from itertools import pairwise

import mpmath
import numpy as np
import pytest
from mpmath import mpf
from scipy.integrate import solve_ivp

from usersub import laws, problems
from usersub.problems import p5, p6, p7, p8, p23
from usersub.problems.slider import Follower
from usersub.problems.slider_explicit import CentralDifferences, KinematicContact, Rubbing
from usersub.problems.slider_implicit import ImplicitContact

#: scipy's integrator, between events that it finds itself.
_PRECISE = {"rtol": 1e-12, "atol": 1e-14, "method": "DOP853"}


def _until_zero(equation, time, state, end, component=1, offset=lambda t: 0.0):
    """Integrates up to where a velocity has come to rest against the ground."""

    def rest(t, y):
        return y[component] - offset(t)

    rest.terminal = True
    # The start may be a rest itself.
    first = solve_ivp(equation, (time, time + 1e-4), state, **_PRECISE)
    found = solve_ivp(
        equation, (time + 1e-4, end), first.y[:, -1], events=rest, max_step=1e-3, **_PRECISE
    )
    assert found.t_events[0].size == 1
    return found.t_events[0][0], found.y_events[0][0]


def test_p5_by_integration():
    force, time, state, turns = p5.MU * p5.NORMAL_FORCE, 0.0, [p5.START, 0.0], 0
    while abs(p5.STIFFNESS * state[0]) > force:
        friction = math.copysign(force, state[0])
        time, state = _until_zero(
            lambda t, y, f=friction: [y[1], (-p5.STIFFNESS * y[0] + f) / p5.MASS], time, state, 1.0
        )
        turns += 1
    exact = p5.exact()
    assert turns == exact.half_cycles == 4
    # The accuracy of the integration.
    assert time == pytest.approx(exact.time, rel=1e-10)
    assert state[0] == pytest.approx(exact.place, rel=1e-9)


def test_p5_has_the_stated_numbers():
    assert p5.exact().time == pytest.approx(0.1256637061, abs=5e-11)
    assert p5.exact().place == pytest.approx(5.5e-4, rel=1e-13)
    assert pytest.approx(1e-3, rel=1e-15) == p5.BAND


def test_p6_by_integration_and_with_more_digits():
    found = p6.exact()

    def equation(t, y):
        spring = p6.STIFFNESS * (y[2] - y[0])
        pull = p6.PULL if t < p6.END_OF_PULL else 0.0
        friction = -p6.KINETIC * p6.NORMAL_FORCE
        return [y[1], (spring + friction) / p6.MASS, y[3], (pull - spring) / p6.MASS]

    with mpmath.workdps(30):
        frequency = mpmath.sqrt(mpf(p6.STIFFNESS) / mpf(p6.MASS))
        slip = mpmath.acos(1 - mpf("0.3") * 10000 / 3000) / frequency
        assert abs(found["slip"] / slip - 1) < 1e-15
        speed = mpf(p6.PULL) / mpf(p6.STIFFNESS) * frequency
    loose = [0.0, 0.0, p6.PULL / p6.STIFFNESS, float(speed)]
    pulled = solve_ivp(equation, (found["slip"], p6.END_OF_PULL), loose, **_PRECISE)
    x1, v1, x2, v2 = pulled.y[:, -1]
    answer = [found[name] for name in ("x1", "v1", "x2", "v2")]
    assert [x1, v1, x2, v2] == pytest.approx(answer, rel=1e-10)
    rest, state = _until_zero(equation, p6.END_OF_PULL, pulled.y[:, -1], 0.4)
    assert (rest, state[0]) == pytest.approx((found["rest"], found["place"]), rel=1e-10)


def test_p6_has_the_stated_numbers():
    found = p6.exact()
    stated = {
        "slip": 3.5124073655e-2, "x1": 2.59308836, "v1": 25.47097248, "x2": 2.63736142,
        "v2": 20.92062065, "rest": 0.3149232755, "place": 3.95560577,
    }  # fmt: skip
    for name, number in stated.items():
        assert found[name] == pytest.approx(number, rel=2e-9), name
    # It stays at rest: the spring never carries as much as friction again.
    system = p6.Pair()
    state = p6.Pair().slide(
        (np.array([found["x1"], found["x2"]]), np.array([found["v1"], found["v2"]])),
        p6.END_OF_PULL, -p6.KINETIC * p6.NORMAL_FORCE, found["rest"] - p6.END_OF_PULL,
    )  # fmt: skip
    (x1, x2), (_, v2) = state
    swing = math.hypot(x2 - x1, v2 / math.sqrt(p6.STIFFNESS / p6.MASS))
    assert p6.STIFFNESS * swing < 0.05 * p6.STATIC * system.normal_force


def test_p7_by_integration():
    """With the base's velocity as an event, half period by half period."""
    found = p7.exact()
    limit = p7.MU * p7.GRAVITY
    for half in range(1, p7.HALVES + 1):
        slip = found[f"slip{half}"]
        x, v, a = p7.base(slip)
        assert abs(a) == pytest.approx(limit, rel=1e-12)
        way = math.copysign(limit, a)
        rest, state = _until_zero(
            lambda t, y, way=way: [y[1], way], slip, [x, v], slip + 0.49,
            offset=lambda t: p7.base(t)[1],
        )  # fmt: skip
        assert rest == pytest.approx(found[f"rest{half}"], rel=1e-10)
        lag = state[0] - p7.base(rest)[0]
        assert lag == pytest.approx(found[f"lag{half}"], rel=1e-8)
        assert abs(p7.base(rest)[2]) < limit  # it rests, and does not slip the other way


def test_p8_by_integration_and_stated_numbers():
    found = p8.exact()
    assert found["stick"] == pytest.approx(0.2, rel=1e-14)
    assert found["slip"] == pytest.approx(0.47123889804, abs=1e-11)
    assert found["jump"] == pytest.approx(6.7123889804e-2, abs=1e-12)
    start = p8.STATIC / (p8.STIFFNESS * p8.SPEED)

    def equation(t, y):
        return [y[1], (p8.STIFFNESS * (p8.SPEED * t - y[0]) - p8.KINETIC) / p8.MASS]

    rest, state = _until_zero(equation, start, [0.0, 0.0], start + 1.0)
    assert rest - start == pytest.approx(found["slip"], rel=1e-10)
    assert state[0] == pytest.approx(found["jump"], rel=1e-9)
    # The spring is then below Fs, and reaches it again by the pull alone.
    left = p8.STATIC - p8.STIFFNESS * (p8.SPEED * rest - state[0])
    assert left / (p8.STIFFNESS * p8.SPEED) == pytest.approx(found["stick"], rel=1e-9)


def test_p23_by_integration():
    block, slope = p23.BLOCK, p23.SLOPE
    assert pytest.approx(37.012 * math.sqrt(slope), rel=2e-5) == p23.FREQUENCY
    swing = p23.rough()["amplitude"]
    assert swing == pytest.approx(block.velocity / p23.FREQUENCY, rel=1e-15)
    bound = p23.MU * block.pressure
    exact = p23.bounded()

    def slipping(t, y):
        return [y[1], -min(slope * y[0], bound) * block.area / block.mass]

    def kink(t, y):
        return slope * y[0] - bound

    kink.terminal = True
    first = solve_ivp(slipping, (0.0, 1e-2), [0.0, block.velocity], events=kink, **_PRECISE)
    x, v = first.y_events[0][0]
    stop, state = _until_zero(
        lambda t, y: [y[1], -bound * block.area / block.mass], first.t_events[0][0], [x, v], 1e-2
    )
    assert (stop, state[0]) == pytest.approx((exact["stop"], exact["place"]), rel=1e-8)
    assert exact["ring"] == pytest.approx(bound / slope, rel=1e-15)


def _events(interface, method="kinematic events", slider=p5.SLIDER):
    law = next(iter(slider.props))
    host, _ = slider._host(
        laws.routine(law, interface, "c"), law, "double", method, 3, slider.end / 150.37
    )
    return host


@pytest.mark.parametrize(
    ("interface", "method"),
    [
        ("vfric", "kinematic events"),
        ("vfriction", "kinematic events"),
        ("vfric_coef", "kinematic events"),
        ("fric_coef", "lagrange events"),
    ],
)
def test_p5_does_not_creep_at_all(interface, method):
    outcome = problems.run("P5", interface=interface, language="c", method=method, hold=5000)
    assert outcome.ok and outcome.details["creep"] == 0.0


@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
def test_p5_does_not_creep_in_central_differences(interface):
    outcome = problems.run("P5", interface=interface, language="c", method="kinematic", hold=5000)
    assert outcome.ok and outcome.details["creep"] == 0.0


@pytest.mark.parametrize(
    ("interface", "method"),
    [("fric", "penalty events"), ("fric_coef", "penalty events"), ("vfric_coef", "penalty")],
)
def test_p5_creeps_within_the_elastic_slip(interface, method):
    outcome = problems.run("P5", interface=interface, language="c", method=method, hold=5000)
    explicit = interface == "vfric_coef"
    allowable = p5.MU * p5.NORMAL_FORCE / p5.SLIDER.slope if explicit else p5.SLIDER.allowable
    assert outcome.ok and outcome.details["creep"] <= allowable


@pytest.mark.parametrize(("name", "module"), [("P5", p5), ("P6", p6), ("P7", p7), ("P8", p8)])
def test_events_do_not_depend_on_the_increments(name, module):
    for steps in (90, 157, 333):
        for interface, method in (("vfric", "kinematic events"), ("fric_coef", "lagrange events")):
            outcome = problems.run(
                name, interface=interface, language="c", method=method, steps=steps
            )
            assert outcome.error < 1e-12, (interface, steps, outcome.details)


@pytest.mark.parametrize("name", ["P5", "P6", "P8"])
def test_central_differences_converge(name):
    """Of first order in the times of events, but not smoothly: each falls into some increment."""
    coarse = {"P5": 1000, "P6": 1000, "P8": 4000}[name]
    few, many = (
        problems.run(name, interface="vfric_coef", language="c", method="kinematic", steps=steps)
        for steps in (coarse, 5 * coarse)
    )
    assert many.error < 0.5 * few.error


def test_p5_place_is_of_second_order():
    # Where in an increment the turns fall changes from run to run, so the bound is what falls.
    for steps in (500, 1000, 2000, 4000, 8000):
        outcome = problems.run(
            "P5", interface="vfric", language="c", method="kinematic", steps=steps
        )
        assert outcome.details["place"] < 300.0 / steps**2, steps


def test_penalty_goes_with_its_stiffness():
    """What is left of P5 is the elastic slip: a quarter of it with four times the stiffness."""
    import dataclasses

    routine, errors = laws.routine("coulomb", "vfric_coef", "c"), []
    for factor, steps in ((1.0, 4500), (4.0, 9000)):
        softer = dataclasses.replace(
            p5.SLIDER, slope=factor * p5.SLIDER.slope, damping=factor**0.5 * p5.SLIDER.damping
        )
        errors.append(softer.run(routine, "coulomb", "double", "penalty", steps=steps))
    assert errors[1].details["place"] < 0.35 * errors[0].details["place"]


def test_p8_drift_over_many_cycles():
    """The worst of 20 cycles, and the phase after them."""
    for interface in problems.PROBLEMS["P8"].interfaces:
        method = problems.PROBLEMS["P8"].methods[interface][0]
        outcome = problems.run("P8", interface=interface, language="c", method=method)
        assert outcome.details["last"] < 1e-13, interface


@pytest.mark.parametrize(("share", "stable"), [(0.98, True), (1.05, False)])
def test_p7_stiffness_that_an_increment_allows(share, stable):
    """A block on a base that shakes below mu g sticks, unless 4 m/dt^2 is passed.

    The limit of a code with another host, 9e5 to 1e6 at 3e-5, is not that of a single mass:
    with dt = 3e-5 it is 4.4e9, and both stiffnesses are far below.
    """
    dt = 3e-5
    limit = 4.0 * p7.MASS / dt**2
    assert limit == pytest.approx(4.444e9, rel=1e-3)
    for slope in (share * limit, *((9e5, 1e6) if stable else ())):
        routine = laws.routine("coulomb", "vfric_coef", "c")
        rubbing = Rubbing(routine, [p7.MU], p7.Block(), 1, "double", "penalty", stick_slope=slope)
        host = CentralDifferences(_Gentle(), rubbing, dt)
        host.run(400 * dt)
        slips = [e for e in host.events if e.kind == "slip"]
        assert bool(slips) != stable, slope


class _Gentle(p7.Block):
    """The block on a base that never reaches mu g, shaken at once."""

    def ground(self, time):
        """Half of the acceleration that friction can give."""
        a = 0.5 * p7.MU * p7.GRAVITY
        return 0.5 * a * time**2, a * time, a


def test_rests_and_slips_take_turns():
    for interface in ("vfric", "fric_coef"):
        for slider in (p7.SLIDER, p8.SLIDER):
            method = "kinematic events" if interface == "vfric" else "lagrange events"
            host = _events(interface, method, slider)
            kinds = [e.kind for e in host.follow(slider.end)]
            assert len(kinds) > 10 and all(a != b for a, b in pairwise(kinds))


def test_hosts_are_what_their_names_say():
    assert isinstance(_events("vfric"), Follower)
    assert isinstance(_events("vfric").contact, KinematicContact)
    assert isinstance(_events("fric", "penalty events").contact, ImplicitContact)
    assert isinstance(_events("vfric_coef", "penalty"), CentralDifferences)


def test_p24_dissipates_in_proportion():
    """More and smaller increments of the path change the balance by rounding only."""
    for interface in ("fric", "fric_coef", "vfric_coef"):
        for steps in (24, 240, 2400):
            outcome = problems.run("P24", interface=interface, language="c", steps=steps)
            assert outcome.error < 1e-13 * steps, (interface, outcome.details)
