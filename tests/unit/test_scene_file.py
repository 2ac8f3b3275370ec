# SPDX-License-Identifier: MIT
"""Scene files are read strictly: what they say, and what every wrong one is told."""

from __future__ import annotations

import json
import tempfile
import tomllib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from usersub import abi, ports
from usersub.errors import SceneError
from usersub.scenefile import columns, history, read
from usersub.scenefile.interpolate import at
from usersub.scenefile.setup import history_of

HISTORY = """
time = [0.0, 1.0, 3.0]
slip = [[0.5, 0.0], [1.5, 2.0], [0.5, 4.0]]
pressure = [5.0, 7.0, 11.0]
"""


def scene_file(folder: Path, history: str = HISTORY, scene: str = "", top: str = "") -> Path:
    """A scene file with a routine beside it that nobody compiles."""
    (folder / "law.c").write_text("")
    head = "" if "routine" in top else 'routine = "law.c"\n'
    text = f"{head}{top}\n[scene]\n{scene}\n[history]\n{history}\n"
    path = folder / "scene.toml"
    path.write_text(text)
    return path


def complete(path: Path, interface: str = "vfriction"):
    return history_of(read(path), abi.interface(interface))


def test_inline_history(tmp_path):
    settings, found = complete(scene_file(tmp_path))
    assert settings["dimension"] == 3 and settings["points"] == 1
    np.testing.assert_array_equal(found.slip[:, 0], [[0, 0], [1, 2], [0, 4]])
    np.testing.assert_array_equal(found.pressure, [[5], [7], [11]])
    row = at(found, 1, 0.25)
    assert row.time == 1.5
    np.testing.assert_array_equal(row.slip, [[0.75, 2.5]])
    np.testing.assert_array_equal(row.pressure, [8.0])


def test_points_have_their_own_columns(tmp_path):
    text = """
    time = [0, 1]
    slip = [[[0, 0], [0, 0]], [[1, 2], [3, 4]]]
    normal_force = [[6, 8], [10, 12]]
    area = [[2, 4], [2, 4]]
    temperature_secondary = [20, 30]
    temperature_main = [[40, 50], [60, 70]]
    field = [[1, 2, 3], [4, 5, 6]]
    """
    settings, found = complete(scene_file(tmp_path, text, "points = 2"))
    assert settings["temperatures"] == 1 and settings["fields"] == 3
    np.testing.assert_array_equal(found.slip[1], [[1, 2], [3, 4]])
    np.testing.assert_array_equal(found.pressure, [[3, 2], [5, 3]])
    np.testing.assert_array_equal(found.normal_force, [[6, 8], [10, 12]])
    np.testing.assert_array_equal(found.temperature[0], [[20, 20], [30, 30]])
    np.testing.assert_array_equal(found.temperature[1], [[40, 50], [60, 70]])
    np.testing.assert_array_equal(found.fields[1][1], [[4, 5, 6], [4, 5, 6]])


def test_slip_increments_add_up(tmp_path):
    text = "time = [0, 1, 2]\nslip_increment = [[0, 0], [1, 2], [3, 5]]\npressure = 4.0"
    _, found = complete(scene_file(tmp_path, text))
    np.testing.assert_array_equal(found.slip[:, 0], [[0, 0], [1, 2], [4, 7]])
    np.testing.assert_array_equal(found.pressure, [[4], [4], [4]])


def test_csv_names_components_and_points(tmp_path):
    (tmp_path / "h.csv").write_text(
        "# a comment\ntime, slip_2, slip_1[0], slip_1[1], pressure, field_1\n\n"
        "0, 0, 0, 0, 5, 1\n2, 1, 3, 4, 6, 2\n"
    )
    _, found = complete(scene_file(tmp_path, 'file = "h.csv"\nsubsteps = 4', "points = 2"))
    np.testing.assert_array_equal(found.slip[1], [[3, 1], [4, 1]])
    np.testing.assert_array_equal(found.fields[0][:, 1, 0], [1, 2])
    assert found.substeps == 4


def test_npz_and_inline_columns_together(tmp_path):
    np.savez(tmp_path / "h.npz", time=[0.0, 0.5], slip=np.array([[0.0, 0.0], [1.0, 2.0]]))
    _, found = complete(scene_file(tmp_path, 'file = "h.npz"\npressure = [1.0, 2.0]'))
    np.testing.assert_array_equal(found.slip[1], [[1, 2]])
    np.testing.assert_array_equal(found.time, [0, 0.5])


def wrong_history(text: str) -> str:
    """HISTORY with the lines of `text` instead of those of the same keys."""
    keys = [line.split("=")[0].strip() for line in text.splitlines()]
    kept = [x for x in HISTORY.splitlines() if x.split("=")[0].strip() not in keys]
    return "\n".join([*kept, text])


@pytest.mark.parametrize(
    ("history", "words"),
    [
        ("pressure = [5.0, 7.0]", ["pressure", "2", "3 rows"]),
        ("pressure = [5.0, -7.0, 1.0]", ["pressure = -7", "not be below 0"]),
        ("pressure = [5.0, nan, 1.0]", ["pressure", "finite"]),
        (f"pressure = [5.0, {10**400}, 1.0]", ["pressure", "finite number"]),
        ("pressure = [5.0, true, 1.0]", ["pressure", "finite number"]),
        ('pressure = "high"', ["pressure", '"high"', "number"]),
        ("time = [0.0, 1.0, 1.0]", ["time", "strictly increasing"]),
        ("time = 1.0", ["time", "one array"]),
        ("slip = [[0.0, 1.0], [2.0], [1.0, 1.0]]", ["slip", "equally long"]),
        ("slip = [0.0, 1.0, 2.0]", ["an array of 3 numbers", "3 rows x 2 components", "dimension"]),
        ("presure = 5.0", ["[history]", "presure", "did you mean 'pressure'?"]),
        ("normal_force = 5.0", ["gives both 'pressure' and 'normal_force'"]),
        ("slip_increment = [[0, 0], [0, 0], [0, 0]]", ["both 'slip' and 'slip_increment'"]),
        ("substeps = 5000000000", ["substeps = 5000000000", "smaller than 2147483648"]),
        ("area = 0.0", ["area = 0", "positive"]),
        ("substeps = 0", ["substeps = 0", "at least 1"]),
        ("substeps = 1.5", ["substeps = 1.5", "an integer"]),
        ("cut_backs = -1", ["cut_backs = -1", "at least 0"]),
        ("stick_stiffness = 0.0", ["stick_stiffness = 0", "positive"]),
        ("stick_stiffness = 2.0\nmass = 1.0", ["stick_stiffness and mass", "one rule"]),
        ("temperature_main = 20.0", ["temperature_main", "temperature_secondary"]),
        ("temperature_secondary = 20.0", ["no 'temperature_main'"]),
        ("field = [[1, 2], [1, 2], [1, 2]]\nfield_main = [[1], [1], [1]]", ["'field'", "or"]),
        ('file = "h.xls"', ["h.xls", ".csv or .npz"]),
        ('file = "missing.csv"', ["missing.csv", "no such file"]),
        ('file = "missing.npz"', ["missing.npz", "no such file"]),
    ],
)
def test_wrong_history(tmp_path, history, words):
    with pytest.raises(SceneError) as raised:
        complete(scene_file(tmp_path, wrong_history(history)))
    check(raised, "scene.toml" if "missing" not in history else "", words)


def check(raised, file: str, words: list[str]) -> None:
    """One sentence that names the file and holds all words."""
    message = str(raised.value)
    assert file in message and "\n" not in message
    for word in words:
        assert word in message, message


@pytest.mark.parametrize(
    ("scene", "words"),
    [
        ("dimensoin = 2", ["[scene]", "dimensoin", "did you mean 'dimension'?"]),
        ('dimension = "3"', ["[scene] dimension", '"3"', "an integer"]),
        ("dimension = 1", ["dimension = 1", "must be 2 or 3"]),
        ("dimension = 4", ["dimension = 4", "must be 2 or 3"]),
        ("points = 0", ["points = 0", "at least 1"]),
        ("points = 3000000000", ["points = 3000000000", "smaller than 2147483648"]),
        ("states = -1", ["states = -1"]),
        ('precision = "doubel"', ["precision", "doubel", "did you mean 'double'?"]),
        ("elastic_slip = nan", ["elastic_slip", "finite number"]),
        ("fields = 2", ["needs the column 'field'", "fields = 2"]),
        ("temperatures = 1", ["needs the column 'temperature'"]),
    ],
)
def test_wrong_scene(tmp_path, scene, words):
    with pytest.raises(SceneError) as raised:
        complete(scene_file(tmp_path, scene=scene))
    check(raised, "scene.toml", words)


@pytest.mark.parametrize(
    ("top", "words"),
    [
        ('interfac = "fric"', ["interfac", "did you mean 'interface'?"]),
        ('interface = "vfricton"', ["vfricton", "did you mean 'vfriction'?"]),
        ("interface = 3", ["interface = 3", "text"]),
        ('language = "rust"', ["rust", "python, c, fortran"]),
        ('generation = "2020"', ["2020", "legacy, 2022"]),
        ("props = [1.0, inf]", ["props", "finite numbers"]),
        ('props = "1"', ["props", "array of finite numbers"]),
        ('routine = "nowhere.f90"', ["routine", "nowhere.f90", "no file"]),
        ('routine = " "', ["routine", "built-in law"]),
        ('routine = "."', ["routine", "is a folder"]),
        ("routine = [1]", ["routine", "text"]),
        ("[problem]\nname = 'p1'", ["both", "[history] and [problem]"]),
        ("[outputs]", ["[outputs]", "did you mean 'output'?"]),
        ('[output]\ncsv = "a.txt"', ["csv", "a.txt", ".csv"]),
        ('[output]\nfigure = "a.pdf"', ["figure", "a.pdf", ".png or .svg"]),
        ('[output]\nnpz = "no/folder/a.npz"', ["npz", "there is no folder"]),
        ("output = 3", ["output = 3", "a table"]),
    ],
)
def test_wrong_top(tmp_path, top, words):
    with pytest.raises(SceneError) as raised:
        read(scene_file(tmp_path, top=top))
    check(raised, "scene.toml", words)


def test_no_toml(tmp_path):
    path = tmp_path / "scene.toml"
    for text, word in [("a = ", "is not TOML"), ("a = 1", "has no key .a."), ("", "neither")]:
        path.write_text(text)
        with pytest.raises(SceneError, match=word):
            read(path)
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(SceneError, match="UTF-8"):
        read(path)
    with pytest.raises(SceneError, match="no such scene file"):
        read(tmp_path / "other.toml")
    with pytest.raises(SceneError, match="cannot be read"):
        read(tmp_path)


def test_needs_a_routine(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(f"[history]\n{HISTORY}")
    with pytest.raises(SceneError, match="needs the key 'routine'"):
        read(path)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time,slip_1,slip_2,pressure\n0,0,0,1\n1,1,1\n", [":3:", "3 values, expected 4"]),
        ("time,slip_1,slip_2,pressure\n0,0,0,1\n1,x,1,1\n", [":3:", "slip_1 = 'x'"]),
        ("time,slip_1,slip_2,pressure\n0,0,0,1\n1,nan,1,1\n", [":3:", "finite"]),
        ("time,slip_1,slip_2,presure\n0,0,0,1\n", ["presure", "did you mean 'pressure'?"]),
        ("time,slip_1,pressure\n0,0,1\n1,1,1\n", ["slip_2", "missing"]),
        ("time,slip_1,slip_2,slip_3,pressure\n0,0,0,0,1\n1,0,0,0,1\n", ["slip_3", "too many"]),
        ("time,slip_1,slip_2,pressure[1]\n0,0,0,1\n1,0,0,1\n", ["pressure[1]", "points = 1"]),
        ("time,time,slip_1,slip_2,pressure\n0,0,0,0,1\n", ["'time'", "twice"]),
        ("time[0],slip_1,slip_2,pressure\n0,0,0,1\n1,0,0,1\n", ["time must be one column"]),
        ("time,slip_1,slip_2,pressure_2\n0,0,0,1\n", ["pressure_2", "no component 2"]),
        ("time,slip_1,slip_2,pressure\n", ["no rows"]),
        ("", ["no rows"]),
        ('time,"slip\n', ["cannot be read as CSV"]),
        ("0,0,0,1\n1,1,1,1\n", ["the number 0", "expected a header"]),
        ("time;slip_1;slip_2;pressure\n0;0,5;0;1\n", ["time;slip_1", "separated by commas"]),
        ("time,slip_1,slip_2,pressure\n0,0,0,1\n1,1_0,1,1\n", [":3:", "slip_1 = '1_0'"]),
    ],
)
def test_wrong_csv(tmp_path, text, words):
    (tmp_path / "h.csv").write_text(text)
    with pytest.raises(SceneError) as raised:
        complete(scene_file(tmp_path, 'file = "h.csv"'))
    check(raised, "h.csv", words)


@pytest.mark.parametrize(
    ("arrays", "words"),
    [
        ({"tiem": [0.0, 1.0]}, ["tiem", "did you mean 'time'?"]),
        ({"time": ["a", "b"]}, ["time", "finite real numbers"]),
        ({"time": [0.0, np.inf]}, ["time", "finite real numbers"]),
        ({"time": np.array([None, 1])}, ["cannot be read as NPZ"]),
        ({"time": [[0.0, 1.0]]}, ["time must be one array"]),
    ],
)
def test_wrong_npz(tmp_path, arrays, words):
    np.savez(tmp_path / "h.npz", slip=np.zeros((2, 2)), pressure=[1.0, 1.0], **arrays)
    with pytest.raises(SceneError) as raised:
        complete(scene_file(tmp_path, 'file = "h.npz"'))
    check(raised, "h.npz", words)


def test_npz_that_is_none(tmp_path):
    for content in (b"PK\x03\x04 nonsense", b"nonsense", b""):
        (tmp_path / "h.npz").write_bytes(content)
        with pytest.raises(SceneError, match="cannot be read as NPZ: (?!.*pickle)"):
            complete(scene_file(tmp_path, 'file = "h.npz"'))


def test_columns_of_the_other_solver_are_refused(tmp_path):
    path = scene_file(tmp_path, HISTORY + "stick_force = 3.0", "elastic_slip = 1.0")
    complete(path, "vfric")
    with pytest.raises(SceneError, match="only VFRIC, VFRICTION and VFRIC_COEF know"):
        complete(path, "fric")


def test_a_column_is_given_once(tmp_path):
    (tmp_path / "h.csv").write_text("time,slip_1,slip_2\n0,0,0\n1,1,1\n")
    with pytest.raises(SceneError, match="gives 'time' itself and in file"):
        complete(scene_file(tmp_path, 'file = "h.csv"\ntime = [0, 1]\npressure = 1.0'))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("props = [1.0]\n[problem]\nname = 'P1'", ["props = [1.0]", "[problem]"]),
        ("[scene]\npoints = 3\n[problem]\nname = 'P1'", ["[scene] points = 3", "'precision'"]),
        ("[problem]\nname = 'P1'\nlanguage = 'c'", ["language", "belongs at the top"]),
        ("[problem]\nname = 'P1'\nprecision = 'single'", ["precision", "belongs in [scene]"]),
        ("[problem]\nmethod = 'rigid'", ["[problem] needs the key 'name'"]),
        ("[problem]\nname = 1", ["name = 1", "text"]),
        ("[problem]\nname = 'P1'\npoints = 0", ["points = 0", "at least 1"]),
        ("[problem]\nname = 'P1'\nsteps = 1.5", ["steps = 1.5", "an integer"]),
        ("[problem]\nname = 'P1'\nother = [1]", ["other = [1]", "true or false"]),
    ],
)
def test_wrong_problem(tmp_path, text, words):
    path = tmp_path / "scene.toml"
    path.write_text(text)
    with pytest.raises(SceneError) as raised:
        read(path)
    check(raised, "scene.toml", words)


def toml(value) -> str:
    """A value in TOML; enough for what the strategy below makes."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)} = {toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value)


VALUES = st.recursive(
    st.booleans() | st.integers(-(2**40), 2**40) | st.floats() | st.sampled_from(["", "a.csv"]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from("ab"), inner),
    max_leaves=6,
)
TABLES = {
    "": ["routine", "interface", "generation", "language", "props", "x"],
    "scene": [*(s.key for s in ports.SETTINGS), "x"],
    "history": [*columns.NAMES, *history.KEYS, "x"],
    "output": ["csv", "npz", "figure", "x"],
}


@settings(max_examples=200)
@given(
    st.fixed_dictionaries(
        {t: st.dictionaries(st.sampled_from(k), VALUES, max_size=1) for t, k in TABLES.items()}
    ),
    st.sampled_from(["fric", "vfric"]),
)
def test_any_nonsense_is_a_scene_error(tables, interface):
    """Whatever stands behind the keys, the reader says so; it never fails otherwise."""
    base = {"": {"routine": "law.c"}, "history": tomllib.loads(HISTORY)}
    lines = []
    for name, table in tables.items():
        lines += [f"[{name}]"] if name else []
        lines += [f"{k} = {toml(v)}" for k, v in {**base.get(name, {}), **table}.items()]
    text = "\n".join(lines)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "law.c").write_text("")
        path = Path(folder) / "scene.toml"
        path.write_text(text)
        try:
            history_of(read(path), abi.interface(interface))
        except SceneError as error:
            assert str(path) in str(error) or str(folder) in str(error)


def test_the_manual_lists_every_column_and_key():
    page = (Path(__file__).parents[2] / "docs" / "reference" / "scene-files.md").read_text()
    widths = {"1": "1", "F": "friction directions", "P": "fields"}
    for column in columns.COLUMNS:
        row = f"| `{column.name}` | {column.unit} | {widths[column.width]} | {column.meaning} |"
        assert row in page
    for key, (_, default, meaning) in history.KEYS.items():
        assert f"| `{key}` | {'' if default is None else default} | {meaning} |" in page
