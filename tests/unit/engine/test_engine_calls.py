# SPDX-License-Identifier: MIT
"""The C interface used wrongly: names, counts, order, handles. Through the binding, as a C host."""

from __future__ import annotations

import ctypes

import pytest

from usersub.core import ffi, lib, text
from usersub.statuses import STATUSES

S = {status.name: status.value for status in STATUSES}
_BLOCK = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_void_p))
NOTHING = _BLOCK(lambda argv: 0)
ENTRY = ffi.cast("usub_entry", ctypes.cast(NOTHING, ctypes.c_void_p).value)


class Made:
    """Routine, scene and driver of the C interface."""

    def __init__(self, interface=b"vfric_coef", kind=b"explicit", **settings):
        self.error = ffi.new("usub_error *")
        self.routine_place = ffi.new("usub_routine **")
        self.driver_place = ffi.new("usub_driver **")
        scene = ffi.new("usub_scene **")
        self.check(
            lib.usub_routine_create(
                interface, ffi.NULL, b"double", 1, ENTRY, self.routine_place, self.error
            )
        )
        self.routine = ffi.gc(self.routine_place[0], lib.usub_routine_free)
        lib.usub_scene_create(scene)
        self.scene = ffi.gc(scene[0], lib.usub_scene_free)
        for key, value in {"points": 3, **settings}.items():
            setter = {int: lib.usub_scene_set_int, float: lib.usub_scene_set_real}.get(
                type(value), lib.usub_scene_set_text
            )
            assert setter(self.scene, key.encode(), value) == 0
        self.status = lib.usub_driver_create(
            kind, self.routine, self.scene, self.driver_place, self.error
        )
        self.driver = ffi.gc(self.driver_place[0], lib.usub_driver_free)

    def check(self, status):
        assert status == 0, text(self.error.message)

    def said(self) -> str:
        return text(lib.usub_message(self.driver))

    def bind(self, **arrays):
        for name, values in arrays.items():
            data = ffi.new("double[]", values)
            setattr(self, name, data)
            assert lib.usub_bind(self.driver, name.encode(), data, len(values)) == 0


def explicit(**settings) -> Made:
    made = Made(**settings)
    made.bind(
        slip_increment=[1.0] * 9,
        normal=[0.0, 0.0, 1.0] * 3,
        normal_force=[1.0] * 3,
        stick_force=[1.0] * 3,
    )
    return made


def create_routine(interface, generation, precision, style=1, entry=ENTRY):
    error, place = ffi.new("usub_error *"), ffi.new("usub_routine **")
    found = lib.usub_routine_create(interface, generation, precision, style, entry, place, error)
    assert place[0] == ffi.NULL and error.status == found
    return found, text(error.message)


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        ((b"umat", ffi.NULL, b"double"), "BAD_ARGUMENT", "unknown interface 'umat'"),
        ((ffi.NULL, ffi.NULL, b"double"), "BAD_ARGUMENT", "unknown interface '(null)'"),
        ((b"fric_coef", b"2019", b"double"), "BAD_ARGUMENT", "FRIC_COEF has 'legacy' and '2022'"),
        ((b"vfric", b"2022", b"double"), "BAD_ARGUMENT", "vfric has no generation '2022'"),
        ((b"vfric", ffi.NULL, b"half"), "BAD_ARGUMENT", "precision 'half'"),
        ((b"vfric", ffi.NULL, ffi.NULL), "BAD_ARGUMENT", "precision '(null)'"),
        ((b"FRIC", ffi.NULL, b"single"), "NOT_SUPPORTED", "double precision only"),
        ((b"fric", ffi.NULL, b"double", 3), "BAD_ARGUMENT", "style 3"),
        ((b"vfric", ffi.NULL, b"double", 2), "BAD_ARGUMENT", "style 2 of vfric"),
        ((b"vfric", ffi.NULL, b"double", 1, ffi.NULL), "BAD_ARGUMENT", "entry"),
    ],
)
def test_routines_that_cannot_be(arguments, status, words):
    found, said = create_routine(*arguments)
    assert found == S[status] and words in said


def test_a_failure_has_its_status_without_a_place_for_the_message():
    place = ffi.new("usub_routine **")
    arguments = (b"fric", ffi.NULL, b"single", 1, ENTRY, place, ffi.NULL)
    assert lib.usub_routine_create(*arguments) == S["NOT_SUPPORTED"]
    arguments = (b"no/such/library.so", b"fric", ffi.NULL, b"double", place, ffi.NULL)
    assert lib.usub_routine_open(*arguments) == S["LOAD_FAILED"]


def test_libraries_that_cannot_be_loaded():
    error, place = ffi.new("usub_error *"), ffi.new("usub_routine **")
    arguments = (b"no/such/library.so", b"fric", ffi.NULL, b"double", place, error)
    assert lib.usub_routine_open(*arguments) == S["LOAD_FAILED"]
    assert "no/such/library.so" in text(error.message)
    arguments = (ffi.NULL, b"vfriction", ffi.NULL, b"double", place, error)
    assert lib.usub_routine_open(*arguments) == S["LOAD_FAILED"]
    assert "no symbol 'vfriction_'" in text(error.message)
    assert place[0] == ffi.NULL


def test_needs_and_promises_that_do_not_fit():
    made = Made()
    bad = S["BAD_ARGUMENT"]
    assert lib.usub_routine_set_uses(made.routine, bytes(16), 16) == 0
    assert lib.usub_routine_set_uses(made.routine, bytes(15), 15) == bad
    assert lib.usub_routine_set_uses(made.routine, bytes([4] * 16), 16) == bad
    assert lib.usub_routine_set_uses(made.routine, ffi.NULL, 16) == bad
    assert lib.usub_routine_set_flag(made.routine, b"thread_safe", 2) == bad
    assert lib.usub_routine_set_flag(made.routine, b"safe", 1) == bad


@pytest.mark.parametrize(
    ("interface", "kind", "settings", "status", "words"),
    [
        (b"fric", b"explicit", {}, "NOT_SUPPORTED", "a driver of kind 'explicit' cannot call fric"),
        (b"vfric", b"coefficient", {}, "NOT_SUPPORTED", "cannot call vfric"),
        (b"vfric", b"implicit", {}, "BAD_ARGUMENT", "driver kind 'implicit'"),
        (b"vfric", ffi.NULL, {}, "BAD_ARGUMENT", "driver kind '(null)'"),
        (b"vfric", b"explicit", {"points": 0}, "BAD_ARGUMENT", "'points' = 0; expected 1 or more"),
        (b"vfric", b"explicit", {"dimension": 4}, "BAD_ARGUMENT", "expected 2 or 3"),
        (b"vfric", b"explicit", {"threads": 0}, "BAD_ARGUMENT", "'threads' = 0"),
        (b"vfric", b"explicit", {"threads": 1025}, "BAD_ARGUMENT", "expected 1 to 1024"),
        (b"vfric", b"explicit", {"friction_directions": 1}, "BAD_ARGUMENT", "expected 2"),
        (b"fric", b"standard", {"friction_directions": 3}, "BAD_ARGUMENT", "expected 1 or 2"),
        (b"vfric", b"explicit", {"precision": b"single"}, "ABI_MISMATCH", "the scene in single"),
        (b"fric", b"standard", {"precision": b"single"}, "NOT_SUPPORTED", "double precision only"),
        (b"vfriction", b"explicit", {"dimension": 2}, "NOT_SUPPORTED", "three-dimensional"),
        (b"vfric", b"explicit", {"contact": b"edge-to-edge"}, "NOT_SUPPORTED", "knows nodes only"),
        (b"vfric", b"explicit", {"states": 1}, "BAD_ARGUMENT", "'secondary_nodes' = 0"),
        (b"fric", b"standard", {"anisotropic": 1}, "NOT_SUPPORTED", "returns one coefficient"),
        (b"fric_coef", b"standard", {}, "BAD_ARGUMENT", "'elastic_slip'"),
        (b"fric_coef", b"standard", {"characteristic_length": 2.0, "slip_tolerance": 0.0},
         "BAD_ARGUMENT", "'elastic_slip'"),
        (b"vfriction", b"explicit", {"states": 2**31 - 1, "points": 2**31 - 1}, "NO_MEMORY",
         "no memory"),
    ],
)  # fmt: skip
def test_scenes_that_do_not_fit(interface, kind, settings, status, words):
    made = Made(interface, kind, **settings)
    assert made.status == S[status] == made.error.status
    assert words in text(made.error.message)
    assert made.driver_place[0] == ffi.NULL


def test_scene_settings_that_are_none():
    scene = Made().scene
    bad = S["BAD_ARGUMENT"]

    def said():
        return text(lib.usub_scene_message(scene))

    assert lib.usub_scene_set_int(scene, b"pints", 3) == bad
    assert "no scene setting is called 'pints'" in said() and "points" in said()
    assert lib.usub_scene_set_int(scene, ffi.NULL, 3) == bad
    assert lib.usub_scene_set_int(scene, b"points", -1) == bad and "= -1" in said()
    assert lib.usub_scene_set_real(scene, b"points", 1.0) == bad and "is an integer" in said()
    assert lib.usub_scene_set_real(scene, b"shear_limit", float("inf")) == bad
    assert lib.usub_scene_set_real(scene, b"shear_limit", float("nan")) == bad
    assert lib.usub_scene_set_text(scene, b"contact", b"glue") == bad and "edge-to-edge" in said()
    assert lib.usub_scene_set_text(scene, b"contact", b"") == bad
    assert lib.usub_scene_set_text(scene, b"main", ffi.NULL) == bad
    assert lib.usub_scene_set_text(scene, b"main", b"x" * 81) == bad and "80 characters" in said()
    assert lib.usub_scene_set_props(scene, ffi.NULL, 2) == bad
    assert lib.usub_scene_set_props(scene, [1.0, float("nan")], 2) == bad and "props[1]" in said()
    assert lib.usub_scene_set_text(scene, b"main", b"x" * 80) == 0 and said() == ""


def test_binding_that_is_refused():
    made = explicit(states=0)
    data = ffi.new("double[16]")
    cases = [
        (b"slip", data, 9, "no array is called 'slip'; arrays: slip_increment"),
        (ffi.NULL, data, 9, "no array is called '(null)'"),
        (b"normal", data, 8, "'normal' has 8 elements; expected 9, shape (D,N)"),
        (b"normal", ffi.cast("char *", data) + 4, 9, "not aligned"),
        (b"nodal_force", data, 0, "no nodes to add forces to; scene setting 'nodes' = 0"),
    ]
    for name, place, count, words in cases:
        assert lib.usub_bind(made.driver, name, place, count) == S["BAD_ARGUMENT"]
        assert words in made.said()
    assert lib.usub_bind(made.driver, b"field_main", data, 0) == 0 and made.said() == ""
    standard = Made(b"fric", b"standard")
    assert lib.usub_bind(standard.driver, b"slip", data, 6) == S["BAD_ARGUMENT"]
    assert "kept by the driver" in standard.said()


def test_calls_in_the_wrong_order():
    wrong, made = S["WRONG_ORDER"], explicit()
    assert lib.usub_step(made.driver) == wrong and "usub_set_time" in made.said()
    assert lib.usub_set_time(made.driver, 1, 1, 1.0, 1.0, 1.0) == 0 and made.said() == ""
    assert lib.usub_step(made.driver) == 0
    for call in (lib.usub_begin_increment, lib.usub_iterate, lib.usub_commit, lib.usub_cut_back):
        assert call(made.driver) == wrong and "not in a standard driver" in made.said()
    assert lib.usub_evaluate(made.driver) == wrong and "coefficient" in made.said()
    assert lib.usub_replay(made.driver, ENTRY) == wrong and "no block has failed" in made.said()
    made = Made(b"fric", b"standard")
    made.bind(slip_increment=[1.0] * 6, pressure=[1.0] * 3)
    assert lib.usub_step(made.driver) == wrong and "explicit" in made.said()
    assert lib.usub_begin_increment(made.driver) == wrong and "usub_set_time" in made.said()
    lib.usub_set_time(made.driver, 1, 1, 1.0, 1.0, 1.0)
    for call in (lib.usub_iterate, lib.usub_commit, lib.usub_cut_back):
        assert call(made.driver) == wrong and "usub_begin_increment" in made.said()
    assert lib.usub_begin_increment(made.driver) == 0
    assert lib.usub_begin_increment(made.driver) == wrong and "is open" in made.said()
    assert lib.usub_commit(made.driver) == wrong and "usub_iterate" in made.said()
    assert lib.usub_set_points(made.driver, 2) == wrong and "number of points" in made.said()
    assert lib.usub_set_time(made.driver, 1, 1, 1.0, 1.0, 1.0) == wrong
    assert lib.usub_iterate(made.driver) == 0 and lib.usub_commit(made.driver) == 0


def test_arrays_that_are_missing():
    made = Made()
    lib.usub_set_time(made.driver, 1, 1, 1.0, 1.0, 1.0)
    for name, count in [("slip_increment", 9), ("normal", 9), ("normal_force", 3)]:
        assert lib.usub_step(made.driver) == S["MISSING_ARRAY"]
        assert f"'{name}' is not bound; it is required" in made.said()
        made.bind(**{name: [0.0, 0.0, 1.0] * (count // 3)})
    assert lib.usub_step(made.driver) == S["MISSING_ARRAY"]
    assert "'stick_force' is not bound; the driver needs it to bound the friction" in made.said()
    made.bind(stick_force=[1.0] * 3)
    assert lib.usub_step(made.driver) == 0 and made.said() == ""


def test_null_handles():
    null, bad = ffi.NULL, S["BAD_ARGUMENT"]
    for call in (lib.usub_step, lib.usub_evaluate, lib.usub_iterate, lib.usub_commit,
                 lib.usub_begin_increment, lib.usub_cut_back, lib.usub_empty):  # fmt: skip
        assert call(null) == bad
    assert lib.usub_bind(null, b"normal", null, 0) == bad
    assert lib.usub_array(null, b"normal", null, null) == bad
    assert lib.usub_set_points(null, 1) == lib.usub_set_time(null, 1, 1, 0, 0, 0) == bad
    assert lib.usub_set_friction_work(null, 0.0) == lib.usub_get_time(null, null, null) == bad
    assert lib.usub_state_save(null, null, 0) == lib.usub_state_load(null, null, 0) == bad
    assert lib.usub_state_size(null) == 0 and lib.usub_plan_count(null) == 0
    assert lib.usub_plan_block(null) == lib.usub_plan_threads(null) == 0
    assert lib.usub_plan_get(null, 0, null) == lib.usub_replay(null, ENTRY) == bad
    assert lib.usub_failed_point(null) == -1 and text(lib.usub_message(null)) == ""
    assert lib.usub_dissipation(null) == 0 and lib.usub_pnewdt(null) == 1e36
    assert lib.usub_driver_create(b"explicit", null, null, null, null) == bad
    assert lib.usub_scene_create(null) == bad and lib.usub_scene_set_int(null, b"points", 1) == bad
    lib.usub_driver_free(null)
    lib.usub_scene_free(null)
    lib.usub_routine_free(null)
