# SPDX-License-Identifier: MIT
"""The standard driver: increments, iterations, LM, cut-backs, tangents, state."""

from __future__ import annotations

import math

import numpy as np
import pytest

import usersub
from usersub.errors import ContractError, RoutineError, SceneError

POINTS = 5

# Viscoplastic friction, problem P3: slip rate = k tau, backward Euler; state 1 counts the calls.
VISCOPLASTIC = """\
#include <usersub/abi.h>
void fric_(USUB_FRIC_PARAMETERS) {
  const double slope = 1.0 / (PROPS[0] * *DTIME);
  *LM = 0;
  for (int a = 0; a < *NFDIR; ++a) {
    TAU[a] = slope * DGAM[a];
    DSLIP[a] = DGAM[a];
    DDTDDG[a + *NFDIR * a] = slope;
    *SFD += TAU[a] * DGAM[a];
  }
  if (*NSTATV) STATEV[0] += 1.0;
}
"""


def viscoplastic(c_routine, points: int = POINTS, **settings) -> usersub.StandardDriver:
    routine = c_routine("fric", VISCOPLASTIC, thread_safe=True)
    return usersub.StandardDriver(
        routine, usersub.Scene(points=points, props=[1.0e-3], states=1, **settings)
    )


def motion(points: int = POINTS, seed: int = 3) -> dict[str, np.ndarray]:
    generator = np.random.default_rng(seed)
    return {
        "slip_increment": np.asfortranarray(generator.normal(size=(2, points))),
        "pressure": generator.uniform(1.0, 9.0, points),
    }


def test_p3_viscoplastic_slip(c_routine):
    # |tau| = 100, k = 1e-3, unit steps: slip 0.1 each, parallel to tau, exact for any step
    angles = np.linspace(0.2, 2.9, POINTS)
    direction = np.asfortranarray([np.cos(angles), np.sin(angles)])
    made = viscoplastic(c_routine)
    for step in range(1, 4):
        made.begin_increment(1.0)
        found = made.iterate(slip_increment=0.1 * direction, pressure=np.ones(POINTS))
        made.commit()
        np.testing.assert_allclose(found.tau, 100.0 * direction, rtol=1e-15)
        identity = np.eye(2)[:, :, None] * np.ones(POINTS)
        np.testing.assert_allclose(found.ddtddg, 1.0e3 * identity, rtol=1e-15)
        np.testing.assert_allclose(found.sfd, 10.0, rtol=1e-15)
        np.testing.assert_allclose(made.state["slip"], step * 0.1 * direction, rtol=1e-15)
        assert not found.lm.any() and found.ddtddt is None and not found.cut_back
    np.testing.assert_array_equal(made.state["state"], 3.0)


def test_iterations_start_from_the_committed_state(c_routine):
    made = viscoplastic(c_routine)
    before = made.state.save()
    made.begin_increment(0.5)
    for seed in (1, 2, 3):
        made.iterate(**motion(seed=seed))
        assert made.state["state"].max() == 0.0
    made.commit()
    np.testing.assert_array_equal(made.state["state"], 1.0)
    assert made.state.save() != before


def test_cut_back_is_as_if_never_tried(c_routine):
    tried, straight = viscoplastic(c_routine), viscoplastic(c_routine)
    for made in (tried, straight):
        made.begin_increment(0.5)
        made.iterate(**motion(seed=1))
        made.commit()
    before = tried.state.save()
    tried.begin_increment(7.0)
    tried.iterate(**motion(seed=2))
    tried.iterate(**motion(seed=9))
    tried.cut_back()
    assert tried.state.save()[-8 * POINTS :] == before[-8 * POINTS :]
    for made in (tried, straight):
        made.begin_increment(0.25)
        made.iterate(**motion(seed=4))
    for name in ("tau", "ddtddg", "lm", "dslip", "sed", "sfd"):
        assert tried.array(name).tobytes() == straight.array(name).tobytes()
    tried.commit()
    straight.commit()
    assert tried.state.save() == straight.state.save()


def test_order_of_calls(c_routine):
    made = viscoplastic(c_routine)
    for call in (made.iterate, made.commit, made.cut_back):
        with pytest.raises(SceneError, match="usub_begin_increment") as caught:
            call()
        assert caught.value.status == -4
    made.begin_increment(0.5)
    with pytest.raises(SceneError, match="commit or cut back"):
        made.begin_increment(0.5)
    with pytest.raises(SceneError, match="usub_iterate"):
        made.commit()


def recorder(answers: list[int]):
    """A FRIC routine that records LM, DSLIP, TAU on entry and answers LM from a list."""
    seen: list[dict] = []

    @usersub.fric(compiled=False)
    def law(LM, TAU, DSLIP, TAULM, PRESS, DPRESS, SLIP):
        seen.append(
            {
                "LM": int(LM[0]), "TAU": TAU.copy(), "DSLIP": DSLIP.copy(), "TAULM": TAULM.copy(),
                "DPRESS": float(DPRESS), "SLIP": SLIP.copy(),
            }
        )  # fmt: skip
        LM[0] = answers[len(seen) - 1]
        TAU[:] = 10.0 * len(seen) + PRESS
        DSLIP[:] = 0.5 * len(seen)

    return law, seen


def test_lm_protocol():
    law, seen = recorder([0, 1, 0, 1, 0, 2, 0])
    made = usersub.StandardDriver(law, usersub.Scene(points=1, dimension=3))
    multiplier = np.array([[3.0], [4.0]])
    slip = np.asfortranarray([[0.1], [0.2]])

    def iterate(pressure: float):
        return made.iterate(
            slip_increment=slip, pressure=np.array([pressure]), multiplier=multiplier
        )

    made.begin_increment(1.0)
    found = iterate(7.0)  # open before: LM = 2 on entry, DSLIP zero
    assert seen[0]["LM"] == 2 and not seen[0]["DSLIP"].any() and not seen[0]["TAULM"].any()
    assert seen[0]["DPRESS"] == 7.0
    np.testing.assert_array_equal(found.tau.ravel(), 17.0)
    found = iterate(7.0)  # last LM = 0: own DSLIP of the last iteration; answers 1
    assert seen[1]["LM"] == 0
    np.testing.assert_array_equal(seen[1]["DSLIP"], 0.5)
    np.testing.assert_array_equal(seen[1]["TAU"], 0.0)  # start of the increment
    np.testing.assert_array_equal(found.tau, multiplier)  # the host's constraint carries the stress
    assert found.lm[0] == 1 and not found.dslip.any()
    iterate(7.0)  # last LM = 1: constraint stress, no DSLIP
    assert seen[2]["LM"] == 1 and not seen[2]["DSLIP"].any()
    np.testing.assert_array_equal(seen[2]["TAULM"], [3.0, 4.0])
    iterate(7.0)  # answers 1 again
    made.commit()
    assert made.state["condition"][0] == 1  # sticking

    made.begin_increment(1.0)
    found = iterate(9.0)  # starts with the condition of the previous increment
    assert seen[4]["LM"] == 1 and seen[4]["DPRESS"] == 2.0
    np.testing.assert_array_equal(seen[4]["TAU"], [3.0, 4.0])
    made.commit()
    np.testing.assert_array_equal(made.state["slip"].ravel(), 2.5)
    assert made.state["condition"][0] == 0

    made.begin_increment(1.0)
    found = iterate(9.0)  # answers 2: frictionless
    assert seen[5]["LM"] == 0
    assert found.lm[0] == 2 and not found.tau.any() and not found.dslip.any()
    made.cut_back()

    made.begin_increment(1.0)
    found = iterate(-1.0)  # open: not called
    assert len(seen) == 6 and found.lm[0] == 2 and not found.tau.any()
    made.commit()
    assert made.state["condition"][0] == 2
    made.begin_increment(1.0)
    iterate(2.0)
    assert seen[6]["LM"] == 2
    np.testing.assert_array_equal(seen[6]["SLIP"], 2.5)  # non-recoverable slip is kept


def test_closed_overrides_the_sign_of_the_pressure():
    law, seen = recorder([0] * 9)
    made = usersub.StandardDriver(law, usersub.Scene(points=2, dimension=2))
    made.begin_increment(1.0)
    arrays = {"slip_increment": np.ones((1, 2)), "pressure": np.array([-1.0, 2.0])}
    found = made.iterate(closed=np.array([1, 0], np.int32), **arrays)
    assert len(seen) == 1
    np.testing.assert_array_equal(found.lm, [0, 2])


def test_smallest_pnewdt_counts():
    @usersub.fric(compiled=False)
    def law(TAU, PNEWDT, NODE):
        if NODE == 2:
            PNEWDT[0] = 0.4
        elif NODE == 4:
            PNEWDT[0] = 0.7

    made = usersub.StandardDriver(law, usersub.Scene(points=POINTS))
    made.begin_increment(1.0)
    found = made.iterate(**motion())
    assert found.cut_back and found.pnewdt == 0.4
    call = made.prepare()
    assert call() == 1  # the status that asks for a cut-back


@pytest.mark.parametrize(
    ("statement", "error", "words"),
    [
        ("*LM = 3;", ContractError, ["LM = 3"]),
        ("*PNEWDT = -1;", ContractError, ["PNEWDT = -1"]),
        ("TAU[1] = 0.0 / 0.0;", RoutineError, ["TAU", "element 2"]),
        ("DDTDDG[2] = 1e308 * 10;", RoutineError, ["DDTDDG", "element 3", "inf"]),
    ],
)
def test_what_a_routine_must_not_return(c_routine, statement, error, words):
    guard = f"if (*NODE == 4) {{ {statement} }}"
    source = VISCOPLASTIC.rstrip()[:-1] + guard + "\n}\n"
    routine = c_routine("fric", source)
    made = usersub.StandardDriver(routine, usersub.Scene(points=POINTS, props=[1e-3], states=1))
    before = made.state.save()
    made.begin_increment(1.0)
    with pytest.raises(error) as caught:
        made.iterate(**motion())
    for word in [*words, "point 3"]:
        assert word in str(caught.value)
    assert caught.value.point == 3
    made.cut_back()
    assert made.state.save()[200:] == before[200:]


def test_nothing_is_committed_after_a_failure():
    law_fails = []

    @usersub.fric(compiled=False)
    def law(LM, TAU, STATEV, NODE):
        LM[0] = 0
        if law_fails and NODE == 3:
            raise ValueError("no")
        TAU[:] = 5.0 + len(law_fails)
        STATEV[0] += 1.0

    made = usersub.StandardDriver(law, usersub.Scene(points=POINTS, states=1))
    made.begin_increment(1.0)
    made.iterate(**motion())
    law_fails.append(True)
    with pytest.raises(RoutineError):
        made.iterate(**motion())
    with pytest.raises(SceneError):
        made.commit()
    law_fails.clear()
    made.iterate(**motion())
    made.commit()
    np.testing.assert_array_equal(made.state["committed_tau"], 5.0)
    np.testing.assert_array_equal(made.state["state"], 1.0)


@pytest.mark.parametrize("name", ["pressure", "slip_increment"])
@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_values_that_are_not_finite(c_routine, name, value):
    arrays = motion()
    arrays[name][..., 2] = value
    made = viscoplastic(c_routine)
    made.begin_increment(1.0)
    with pytest.raises(SceneError, match=f"{name}.*2"):
        made.iterate(**arrays)


@pytest.mark.parametrize("block", [1, 4, 33])
@pytest.mark.parametrize("threads", [1, 3])
def test_blocks_and_threads_give_the_same_bits(c_routine, block, threads):
    points = 100
    saved = []
    for choice in ({}, {"block": block, "threads": threads}):
        made = viscoplastic(c_routine, points, **choice)
        for seed in (1, 2):
            made.begin_increment(0.1)
            made.iterate(**motion(points, seed))
            made.commit()
        saved.append(made.state.save())
    assert saved[0] == saved[1]


def test_state_continues_in_another_driver(c_routine):
    first, second = viscoplastic(c_routine), viscoplastic(c_routine)
    first.begin_increment(0.25)
    first.iterate(**motion())
    first.commit()
    second.state.load(first.state.save())
    for made in (first, second):
        made.begin_increment(0.5)
        made.iterate(**motion(seed=6))
        made.commit()
    assert first.state.save() == second.state.save()  # the clock went on, too


def test_initial_conditions(c_routine):
    made = viscoplastic(c_routine)
    made.state["state"][0] = np.arange(POINTS)
    made.begin_increment(1.0)
    made.iterate(**motion())
    made.commit()
    np.testing.assert_array_equal(made.state["state"][0], np.arange(POINTS) + 1.0)


# FRIC_COEF with enforcement.

COULOMB = {
    "2022": "fCoef[0] = props[0];",
    "legacy": "for (int k = 0; k < *nBlock; ++k) fCoef[k] = props[0];",
}


def coulomb(c_routine, spoken: str = "2022", **settings) -> usersub.StandardDriver:
    parameters = "USUB_FRIC_COEF_PARAMETERS" if spoken == "legacy" else (
        "USUB_FRIC_COEF_2022_PARAMETERS"
    )  # fmt: skip
    source = f"#include <usersub/abi.h>\nvoid fric_coef_({parameters}) {{ {COULOMB[spoken]} }}\n"
    routine = c_routine("fric_coef", source, generation=spoken)
    scene = usersub.Scene(points=POINTS, props=[0.4], elastic_slip=0.01, **settings)
    return usersub.StandardDriver(routine, scene)


@pytest.mark.parametrize("generation", ["2022", "legacy"])
def test_penalty_enforcement_of_coulomb(c_routine, generation):
    arrays = motion()
    stuck = np.array([True, False, True, False, False])
    length = np.linalg.norm(arrays["slip_increment"], axis=0)
    arrays["slip_increment"] *= np.where(stuck, 0.004, 0.3) / length
    made = coulomb(c_routine, generation)
    made.begin_increment(1.0)
    found = made.iterate(**arrays)
    made.commit()
    limit = 0.4 * arrays["pressure"]
    expected = arrays["slip_increment"] / np.where(stuck, 0.01, 0.3) * limit
    np.testing.assert_allclose(found.tau, expected, rtol=1e-14)
    np.testing.assert_allclose(made.array("coefficient")[0], 0.4)
    slipped = arrays["slip_increment"] * np.where(stuck, 0.0, (0.3 - 0.01) / 0.3)
    np.testing.assert_allclose(found.dslip, slipped, atol=1e-15)
    np.testing.assert_allclose(
        made.state["elastic_slip"] + slipped, arrays["slip_increment"], rtol=1e-13
    )
    # tangent in stick: limit / elastic slip, and tau / p
    for point in np.flatnonzero(stuck):
        np.testing.assert_allclose(
            found.ddtddg[:, :, point], np.eye(2) * limit[point] / 0.01, rtol=1e-13
        )
    np.testing.assert_allclose(found.ddtddp, found.tau / arrays["pressure"], rtol=1e-13)


@pytest.mark.parametrize("generation", ["2022", "legacy"])
def test_tangent_by_differences(c_routine, generation):
    arrays = motion()
    made = coulomb(c_routine, generation)
    made.begin_increment(1.0)
    tangent = made.iterate(**arrays).ddtddg
    h = 1e-6
    for direction in range(2):
        values = []
        for sign in (1, -1):
            moved = arrays["slip_increment"].copy(order="F")
            moved[direction] += sign * h
            values.append(made.iterate(slip_increment=moved, pressure=arrays["pressure"]).tau)
        # central differences: h^2 against the curvature of the direction, rounding by 2 h
        np.testing.assert_allclose(
            tangent[:, direction], (values[0] - values[1]) / (2 * h), rtol=1e-6, atol=1e-6
        )


def test_generations(c_routine):
    with pytest.raises(usersub.AbiError, match="generation"):
        coulomb(c_routine, "2022", generation="legacy")
    coulomb(c_routine, "legacy", generation="2022")
    coulomb(c_routine, "legacy", generation="legacy")


def test_fric_coef_needs_an_elastic_slip(c_routine):
    made = coulomb(c_routine)
    with pytest.raises(SceneError, match="elastic_slip"):
        usersub.StandardDriver(made.routine, made.scene.replace(elastic_slip=0.0))
    by_length = made.scene.replace(
        elastic_slip=0.0, characteristic_length=2.0, slip_tolerance=0.005
    )
    other = usersub.StandardDriver(made.routine, by_length)
    for driver in (made, other):
        driver.begin_increment(1.0)
    found = [driver.iterate(**motion()).tau for driver in (made, other)]
    np.testing.assert_array_equal(found[0], found[1])


def test_shear_limit(c_routine):
    made = coulomb(c_routine, shear_limit=0.7)
    made.begin_increment(1.0)
    arrays = motion()
    found = made.iterate(**arrays)
    size = np.minimum(0.4 * arrays["pressure"], 0.7)
    np.testing.assert_allclose(np.linalg.norm(found.tau, axis=0), size, rtol=1e-14)
    limited = 0.4 * arrays["pressure"] > 0.7
    assert limited.any() and not found.ddtddp[:, limited].any()
