# SPDX-License-Identifier: MIT
"""What is saved by leaving out: rows for every interface and kind of scene, and their page."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import usersub
from usersub.driver import costs
from usersub.study import leaving_out, leaving_out_page
from usersub.study.host_arrays import host_arrays

#: Arguments that no exponential decay reads.
NEVER = {
    "fric": {"COORDS", "RCOORD", "TEMP", "PREDEF", "DPRESS", "NOEL"},
    "fric_coef": {"tempAvg", "fieldAvg"},
    "vfric": {"coordSec", "coordMain", "shape", "areaSec", "tempMain", "preDefSec"},
    "vfriction": {
        "coordSec",
        "coordMain",
        "velSec",
        "velMain",
        "shapeMain",
        "tempSec",
        "fieldMain",
    },
    "vfric_coef": {"fCoefDeriv", "pressure", "tempAvg", "fieldAvg"},
}


@pytest.fixture(autouse=True)
def tick(monkeypatch):
    """A clock that makes every call as long as the next, and few rounds."""
    now = iter(range(10**6))
    monkeypatch.setattr(costs, "clock", lambda: next(now))
    monkeypatch.setattr(costs, "ROUNDS", 2)


@pytest.fixture(scope="module")
def rows():
    with pytest.MonkeyPatch.context() as patch:
        now = iter(range(10**6))
        patch.setattr(costs, "clock", lambda: next(now))
        return leaving_out.measure(points=70, quick=True)


def test_every_interface_has_its_kinds_of_scenes(rows):
    kinds = {i: [s.scene for s in rows if s.interface == i] for i in leaving_out.INTERFACES}
    assert kinds == {
        "fric": [
            "general", "two-dimensional", "isothermal", "stateless", "derivative-free", "least",
        ],
        "fric_coef": [
            "general", "two-dimensional", "isothermal", "stateless", "derivative-free", "least",
        ],
        "vfric": ["general", "two-dimensional", "isothermal", "stateless", "least"],
        "vfriction": [
            "general", "isothermal", "stateless", "node-to-facet", "least", "half open",
        ],
        "vfric_coef": [
            "general", "two-dimensional", "isothermal", "node-to-facet", "least", "half open",
        ],
    }  # fmt: skip


def test_the_plan_leaves_out_what_no_one_needs(rows):
    for saving in rows:
        assert saving.same_bits and saving.untouched, saving
        assert set(saving.left_out) >= NEVER[saving.interface], saving
        assert saving.bytes_needed < saving.bytes_full
        # The memory is that of the whole process, with what the interpreter does meanwhile.
        assert saving.memory_needed <= saving.memory_full + 1e5 / 70
        assert saving.ns_needed == pytest.approx(1e9 / 70)
        assert (saving.language, saving.points) == ("c", 70)
        if saving.scene == "general":
            assert saving.bytes_full == saving.bytes_general


def test_bytes_of_vfriction(rows):
    """By hand: answer 16, length of the slip 24, stick and normal force 8 each."""
    found = {s.scene: s for s in rows if s.interface == "vfriction"}
    assert found["node-to-facet"].bytes_needed == 16 + 24 + 8 + 8
    nodes = (1 + 4) * (4 + 2 * 3 * 8) + 4 * 8  # numbers, coordinates, velocities; shape functions
    point = 16 + 3 * 24 + 24 + 3 * 8 + 2 * 8 + 2 * 2 * 8 + 2 * 8  # forces ... state
    assert found["node-to-facet"].bytes_full == nodes + point
    assert found["node-to-facet"].bytes_ratio >= 6
    assert found["stateless"].bytes_full == found["general"].bytes_full - 2 * 4 * 8
    assert found["isothermal"].bytes_full == found["general"].bytes_full - 2 * 8 - 2 * 2 * 8


@pytest.mark.parametrize("interface", ["fric", "vfric"])
def test_two_dimensions_pass_less(rows, interface):
    found = {s.scene: s for s in rows if s.interface == interface}
    assert found["two-dimensional"].bytes_needed < found["general"].bytes_needed
    assert found["two-dimensional"].bytes_full < found["general"].bytes_full


def wrongly_declared(tmp_path, interface, body, unused):
    """A routine of which it is said that it does not use an argument that it does."""
    path = tmp_path / f"{interface}.c"
    path.write_text(
        "#include <usersub/abi.h>\n"
        f"void {interface}_(USUB_{interface.upper()}_PARAMETERS) {{ {body} }}\n"
    )
    routine = usersub.load(path).only()
    names = [a.modern for a in routine.interface.args]
    uses = list(routine.uses)
    uses[names.index(unused)] = 0
    return replace(routine, uses=tuple(uses))


def test_a_wrong_declaration_is_found(tmp_path):
    routine = wrongly_declared(
        tmp_path, "vfric_coef",
        "for (int k = 0; k < *nBlock; ++k) fCoef[k] = pressure[k];", "pressure",
    )  # fmt: skip
    (general, *_) = leaving_out.measure(routine, points=40)
    assert "pressure" in general.left_out
    assert not general.untouched and not general.same_bits


def test_a_routine_of_the_user_with_properties_and_state(tmp_path):
    @usersub.vfriction
    def law(fTangential, state, fNormal, props):
        for k in range(fNormal.shape[0]):
            state[2, 0, k] += 1.0
            fTangential[0, k] = -props[1] * fNormal[k]

    rows = leaving_out.measure(law, props=[0.0, 0.2], states=3, points=40)
    assert {s.language for s in rows} == {"python"}
    assert all(s.same_bits and s.untouched for s in rows)
    assert rows[0].bytes_needed == 16 + 8 + 3 * 4 * 8


def test_scenes_without_the_temperatures_that_it_reads_are_left_away(tmp_path):
    @usersub.vfric_coef(compiled=False)
    def law(fCoef, tempAvg):
        fCoef[:] = 1.0 / tempAvg

    rows = leaving_out.measure(law, points=40)
    assert [s.scene for s in rows] == [
        "general", "two-dimensional", "node-to-facet", "least", "half open",
    ]  # fmt: skip
    assert all("tempAvg" not in s.left_out for s in rows)


def test_a_routine_that_fails_is_said_and_left_away(tmp_path):
    path = tmp_path / "law.c"
    path.write_text(
        "#include <usersub/abi.h>\nvoid vfric_coef_(USUB_VFRIC_COEF_PARAMETERS)"
        " { for (int k = 0; k < *nBlock; ++k) fCoef[k] = *nTemp ? 0.1 : -1.0; }\n"
    )
    said: list[str] = []
    rows = leaving_out.measure(usersub.load(path).only(), points=40, progress=said.append)
    assert [s.scene for s in rows] == ["general", "two-dimensional", "node-to-facet", "half open"]
    assert any(w.startswith("VFRIC_COEF, isothermal scene: VFRIC_COEF: the rout") for w in said)


def test_laws_stand_behind_the_chosen_interfaces():
    law = usersub.laws.coulomb(mu=0.3)
    found = leaving_out.measure(law, interfaces=("vfric_coef", "vfric"), points=20)
    assert {s.interface for s in found} == {"vfric_coef", "vfric"}
    assert {s.routine for s in found} == {"law.c"}


def test_arrays_are_those_of_points_that_slide():
    scene = usersub.Scene(points=30, nodes=12, props=[0.3], enforcement="kinematic", fields=2)
    driver = usersub.ExplicitDriver(usersub.laws.coulomb(mu=0.3).behind("vfriction", "c"), scene)
    arrays = host_arrays(driver)
    assert "stick_force" not in arrays and "mass" not in arrays
    normal, slip = arrays["normal"], arrays["slip_increment"]
    np.testing.assert_allclose((normal**2).sum(axis=0), 1.0, rtol=1e-15)
    assert abs((normal * slip).sum(axis=0)).max() < 1e-18
    assert arrays["main_node"].min() == 1 and arrays["main_node"].max() == 12


# The page.


def test_page_has_a_row_for_each_and_says_what_is_met(rows):
    slow = [replace(s, ns_full=3 * s.ns_needed) for s in rows]
    page = leaving_out_page.page(slow)
    assert "{" not in page.replace("{math}", "")
    assert page.count("\n| VFRICTION |") == 6 + 4
    assert "3.00 times the time and 8.8 times the bytes" in page and ": met." in page
    assert f"In all {len(rows)} rows the answers are the same to the bit" in page
    assert "not met" in leaving_out_page.page(rows)
    bad = [replace(rows[0], same_bits=False), *rows[1:]]
    assert f"Not so in 1 of {len(rows)} rows: FRIC (three dimensions" in leaving_out_page.page(bad)


def test_page_without_what_was_not_measured(rows):
    some = [replace(s, memory_needed=float("nan")) for s in rows if s.interface == "fric"]
    page = leaving_out_page.page(some)
    assert "VFRICTION was not measured." in page
    assert "| - |" in leaving_out_page.plan_table(some)
