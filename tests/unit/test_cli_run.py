# SPDX-License-Identifier: MIT
"""`usersub run`: histories through all interfaces, against closed forms and by hand."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from usersub import abi
from usersub.cli.main import cli
from usersub.errors import MissingTool, RoutineError, SceneError
from usersub.scenefile import figure, run_scene
from usersub.scenefile.explicit import UNLIMITED

# Interpreted routines: these tests are about the history, not about numba.
HEAD = "import math\nimport usersub\n"
SPRING = """
@usersub.fric(compiled=False)
def spring(LM, TAU, DDTDDG, STATEV, SED, PNEWDT, DGAM, PRESS, DPRESS, TIME, DTIME, TEMP, PREDEF,
           COORDS, PROPS, NFDIR, NSTATV):
    LM[0] = 0
    for a in range(NFDIR):
        TAU[a] += PROPS[0] * (a + 1) * DGAM[a]
        DDTDDG[a, a] = PROPS[0] * (a + 1)
"""
ECHO = """
@usersub.{name}(compiled=False)
def echo(fTangential, fStickForce, {count}):
    for k in range({count}):
        fTangential[0, k] = -fStickForce[k]
"""
DECAY = {
    "vfric": """
@usersub.vfric(compiled=False)
def law(fTangential, nContact, dTimCur, dSlipFric, fStickForce, fNormal, props):
    for k in range(nContact):
        mu = props[1] + (props[0] - props[1]) * math.exp(-props[2] * dSlipFric[0, k] / dTimCur)
        fTangential[0, k] = -min(mu * fNormal[k], fStickForce[k])
""",
    "vfriction": """
@usersub.vfriction(compiled=False)
def law(fTangential, nBlock, rData, dSlipFric, fStickForce, fNormal, props):
    for k in range(nBlock):
        mu = props[1] + (props[0] - props[1]) * math.exp(-props[2] * dSlipFric[0, k] / rData[2])
        fTangential[0, k] = -min(mu * fNormal[k], fStickForce[k])
""",
    "vfric_coef": """
@usersub.vfric_coef(compiled=False)
def law(fCoef, slipRate, nBlock, props):
    for k in range(nBlock):
        fCoef[k] = props[1] + (props[0] - props[1]) * math.exp(-props[2] * slipRate[k])
""",
    "fric_coef": """
@usersub.fric_coef(compiled=False)
def law(fCoef, slipData, nBlock, props):
    for k in range(nBlock):
        fCoef[k, 0] = props[1] + (props[0] - props[1]) * math.exp(-props[2] * slipData[k, 0])
""",
}


def write(folder: Path, code: str, history: str, scene: str = "", more: str = "") -> Path:
    """A routine `law.py` and its scene file."""
    (folder / "law.py").write_text(HEAD + code)
    path = folder / "scene.toml"
    path.write_text(
        f'routine = "law.py"\nprops = [3.0, 0.25, 1.5]\n[scene]\n{scene}\n'
        f"[history]\n{history}\n{more}\n"
    )
    return path


def cli_run(*args: object):
    return CliRunner().invoke(cli, ["run", *map(str, args)], prog_name="usersub")


TWO = "time = [0, 1, 3]\nslip = [[0, 0], [2, 1], [1, 4]]\npressure = [5, 7, 11]\n"


def test_fric_takes_rows_and_substeps(tmp_path):
    run = run_scene(write(tmp_path, SPRING, TWO + "substeps = 4"))
    columns = run.history.columns
    np.testing.assert_allclose(columns["time"], [0.25, 0.5, 0.75, 1, 1.5, 2, 2.5, 3], rtol=0)
    np.testing.assert_allclose(columns["pressure"][:, 0], [5.5, 6, 6.5, 7, 8, 9, 10, 11], rtol=0)
    # Eight additions: 1e-14 relative to the largest.
    exact = columns["slip"] * np.array([3.0, 6.0])
    np.testing.assert_allclose(columns["tau"], exact, atol=24e-14)
    np.testing.assert_array_equal(columns["slip"][[3, 7], 0], [[2, 1], [1, 4]])


def test_fric_is_told_times_pressures_temperatures_fields_and_coordinates(tmp_path):
    code = """
@usersub.fric(compiled=False)
def told(LM, TAU, STATEV, DGAM, PRESS, DPRESS, TIME, DTIME, KINC, TEMP, PREDEF, COORDS, NODE):
    LM[0] = 0
    TAU[0] = TAU[1] = 0.0
    STATEV[:] = [PRESS, DPRESS, TIME[0], TIME[1], DTIME, KINC, TEMP[0], TEMP[1], PREDEF[0, 1],
                 PREDEF[1, 0], COORDS[0], COORDS[1], NODE, DGAM[1]]
"""
    text = """
    time = [2, 3, 5]
    slip = [[0, 0], [2, 1], [1, 4]]
    pressure = [5, 7, 11]
    temperature_secondary = [10, 20, 30]
    temperature_main = [11, 21, 31]
    field_secondary = [[1, 2], [3, 4], [5, 6]]
    field_main = [[7, 8], [9, 10], [11, 12]]
    """
    state = run_scene(write(tmp_path, code, text, "states = 14")).history.columns["state"]
    np.testing.assert_array_equal(state[0, 0], [7, 2, 1, 3, 1, 1, 20, 21, 4, 9, 2, 1, 1, 1])
    np.testing.assert_array_equal(state[1, 0], [11, 4, 3, 5, 2, 2, 30, 31, 6, 11, 1, 4, 1, 3])


def test_points_keep_apart_and_open_points_are_not_called(tmp_path):
    text = """
    time = [0, 1, 2]
    slip = [[[0, 0], [0, 0], [0, 0]], [[1, 0], [0, 1], [1, 1]], [[2, 0], [0, 3], [2, 2]]]
    pressure = [[1, 1, 0], [1, 1, 0], [1, 0, 4]]
    """
    columns = run_scene(write(tmp_path, SPRING, text, "points = 3")).history.columns
    np.testing.assert_array_equal(columns["lm"], [[0, 0, 2], [0, 2, 0]])
    np.testing.assert_array_equal(columns["tau"][0], [[3, 0], [0, 6], [0, 0]])
    np.testing.assert_array_equal(columns["tau"][1], [[6, 0], [0, 0], [3, 6]])


CUTTING = """
@usersub.fric(compiled=False)
def cutting(LM, TAU, PNEWDT, DGAM, DTIME, TIME):
    LM[0] = 0
    TAU[:] += 2.0 * DGAM
    if DTIME > 0.3 and TIME[1] > 1.0:
        PNEWDT[0] = 0.5
"""


def test_increments_are_halved_where_the_routine_asks(tmp_path):
    history = run_scene(write(tmp_path, CUTTING, TWO)).history
    np.testing.assert_array_equal(history.columns["time"], [1, *np.arange(5, 13) / 4])
    np.testing.assert_allclose(history.columns["tau"][-1, 0], [2, 8], rtol=1e-14)
    assert history.cut_backs == 1 + 2 + 4


def test_cut_backs_have_a_limit(tmp_path):
    path = write(tmp_path, CUTTING, TWO + "cut_backs = 2")
    with pytest.raises(RoutineError, match="PNEWDT = 0.5.*after 2 cut-backs.*history row 2 of 2"):
        run_scene(path)


def test_a_routine_that_returns_early_when_open_still_slides(tmp_path):
    """The published advice for FRIC: leave LM = 2 alone. Points with pressure at the start are
    closed there, so that this does not make them frictionless for ever."""
    code = SPRING.replace("    LM[0] = 0\n", "    if LM[0] == 2:\n        return\n    LM[0] = 0\n")
    columns = run_scene(write(tmp_path, code, TWO)).history.columns
    np.testing.assert_array_equal(columns["tau"][0, 0], [6, 6])


def test_no_motion_wanted_is_noted(tmp_path):
    code = "@usersub.fric(compiled=False)\ndef rough(LM):\n    LM[0] = 1\n"
    history = run_scene(write(tmp_path, code, TWO)).history
    assert "2 times a point asked for no relative motion (LM = 1)" in history.notes[0]
    result = cli_run(tmp_path / "scene.toml")
    assert result.exit_code == 0 and "note: 2 times" in result.stdout


@pytest.mark.parametrize("name", ["vfric", "vfriction"])
@pytest.mark.parametrize(
    ("rule", "expected"),
    [
        ("stick_force = [9.0, 6.0, 2.0]", [6.0, 2.0]),
        # |F - k ds|, F being the force of the increment before along -ds: 5 * 5, then 25 + ...
        ("stick_stiffness = 5.0", [25.0, 25.0]),
        ("mass = 8.0", [8.0 * 5.0 / 1.0, 0.0]),
        ("", [UNLIMITED, 0.0]),
    ],
)
def test_stick_force_rules(tmp_path, name, rule, expected):
    count = {"vfric": "nContact", "vfriction": "nBlock"}[name]
    text = "time = [0, 1, 3]\nslip = [[0, 0], [3, 4], [3, 4]]\npressure = 2.0\n" + rule
    columns = run_scene(write(tmp_path, ECHO.format(name=name, count=count), text)).history.columns
    np.testing.assert_allclose(columns["stick_force"][:, 0], expected, rtol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(columns["force"][:, 0], axis=1), expected, rtol=1e-14)
    # Force on the secondary side against the slip; stress positive along it.
    np.testing.assert_allclose(columns["force"][0, 0], -np.array([0.6, 0.8]) * expected[0])
    np.testing.assert_allclose(columns["tau"][0, 0], np.array([0.6, 0.8]) * expected[0])


@pytest.mark.parametrize("name", ["vfric", "vfriction"])
@pytest.mark.parametrize(
    ("scene", "rule", "expected"),
    [
        ('enforcement = "kinematic"', "mass = 8.0", [8.0 * 5.0 / 1.0, 0.0]),
        ('enforcement = "penalty"\nstick_slope = 5.0', "", [25.0, 25.0]),
    ],
)
def test_enforcement_by_the_driver(tmp_path, name, scene, rule, expected):
    count = {"vfric": "nContact", "vfriction": "nBlock"}[name]
    text = "time = [0, 1, 3]\nslip = [[0, 0], [3, 4], [3, 4]]\npressure = 2.0\n" + rule
    path = write(tmp_path, ECHO.format(name=name, count=count), text, scene)
    columns = run_scene(path).history.columns
    np.testing.assert_allclose(columns["stick_force"][:, 0], expected, rtol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(columns["force"][:, 0], axis=1), expected, rtol=1e-14)


def test_the_same_law_gives_the_same_through_all_interfaces(tmp_path):
    text = "time = [0, 1, 3]\nslip = [[0, 0], [2, 1], [1, 4]]\nnormal_force = [5, 7, 11]\n"
    text += "area = 2.0\nsubsteps = 3"
    found = {}
    for name, code in DECAY.items():
        scene = "elastic_slip = 1e-13" if name == "fric_coef" else ""
        found[name] = run_scene(write(tmp_path, code, text, scene)).history.columns["tau"]
    rate = np.array([np.sqrt(5.0)] * 3 + [np.sqrt(10.0) / 2] * 3)
    force = np.array([17, 19, 21, 25, 29, 33]) / 3
    direction = np.array([[2, 1]] * 3 + [[-1, 3]] * 3) / np.sqrt([[5]] * 3 + [[10]] * 3)
    exact = ((0.25 + 2.75 * np.exp(-1.5 * rate)) * force / 2)[:, None] * direction
    for name, tau in found.items():
        # 1e-12: the elastic slip of FRIC_COEF is 1e-13 of a unit of slip
        np.testing.assert_allclose(tau[:, 0], exact, rtol=1e-12, atol=1e-12, err_msg=name)


@pytest.mark.parametrize("contact", ["node-to-facet", "edge-to-edge", "analytical-rigid"])
def test_vfriction_is_told_of_its_surfaces(tmp_path, contact):
    code = """
@usersub.vfriction(compiled=False)
def told(fTangential, state, nBlock, nBlockAnal, nNodSec, nNodMain, shapeSec, shapeMain, coordSec,
         coordMain, velSec, velMain, jConSecUid, jConMainUid, areaCont, tempSec, tempMain,
         fieldMain):
    for k in range(nBlock):
        j = min(k, nBlockAnal - 1)
        own, other = coordSec[:, :, k] @ shapeSec[:, 0], coordMain[:, :, j] @ shapeMain[:, j]
        state[:, 0, k] = [*own, *other, *(velSec[:, :, k] @ shapeSec[:, 0]), abs(velMain).max(),
                          jConSecUid[0, k], jConMainUid[0, j], areaCont[k], tempSec[k],
                          tempMain[j], fieldMain[0, j]]
"""
    text = """
    time = [0, 2]
    slip = [[[0, 0], [0, 0]], [[2, 1], [3, -4]]]
    pressure = 5.0
    area = [[1, 2], [3, 4]]
    temperature_secondary = [[10, 20], [30, 40]]
    temperature_main = [11, 21]
    field = [[7], [8]]
    """
    scene = f'points = 2\nstates = 16\ncontact = "{contact}"'
    history = run_scene(write(tmp_path, code, text, scene)).history
    for point, slip in enumerate(([2.0, 1.0], [3.0, -4.0])):
        state = history.columns["state"][0, point]
        np.testing.assert_allclose(state[:3], [*slip, 0], atol=1e-15)
        # What the main edge or facet says is opposite the point; a rigid surface has no facet.
        opposite = {"node-to-facet": slip, "edge-to-edge": [slip[0], 0.0]}.get(contact, [0, 0])
        np.testing.assert_allclose(state[3:6], [*opposite, 0], atol=1e-15)
        np.testing.assert_allclose(state[6:10], [slip[0] / 2, slip[1] / 2, 0, 0], atol=1e-15)
        nodes = 2 if contact == "edge-to-edge" else 1
        expected = [1 + nodes * point, 1 + nodes * 2, 3 + point, 30 + 10 * point, 21, 8]
        np.testing.assert_array_equal(state[10:16], expected)


def test_vfric_in_two_dimensions(tmp_path):
    code = """
@usersub.vfric(compiled=False)
def told(fTangential, statev, nContact, jConSecid, jConMainid, jSecUid, jMainUid, shape, coordSec,
         coordMain, areaSec, preDefMain):
    for k in range(nContact):
        other = coordMain[:, jConMainid[:, k] - 1] @ shape[:, k]
        node = jConSecid[k] - 1
        statev[:, node] = [*coordSec[:, node], *other, areaSec[node], jSecUid[node],
                           jMainUid[jConMainid[1, k] - 1], preDefMain[k, 1]]
"""
    text = """
    time = [0, 2]
    slip = [[[0], [0], [0]], [[2], [-1], [4]]]
    normal_force = 5.0
    area = [[1, 2, 3], [4, 5, 6]]
    field = [[7, 9], [8, 10]]
    """
    scene = "points = 3\ndimension = 2\nstates = 8"
    state = run_scene(write(tmp_path, code, text, scene)).history.columns["state"][0]
    for point, slip in enumerate([2, -1, 4]):
        expected = [slip, 0, slip, 0, 4 + point, 1 + point, 5, 10]
        np.testing.assert_allclose(state[point], expected, atol=1e-15)


def test_single_precision(tmp_path):
    path = write(tmp_path, DECAY["vfric"], TWO, 'precision = "single"')
    run = run_scene(path)
    tau = run.history.columns["tau"]
    assert run.history.precision == "single" and "single precision" in run.plan
    np.testing.assert_array_equal(tau, tau.astype(np.float32))
    np.testing.assert_allclose(
        np.linalg.norm(tau[0, 0]), (0.25 + 2.75 * np.exp(-1.5 * np.sqrt(5))) * 7, rtol=1e-6
    )


FAILING = """
@usersub.vfric_coef(compiled=False)
def failing(fCoef, rData):
    if rData[1] > 2.0:
        raise ValueError("too late")
    fCoef[:] = 0.5
"""
OUTPUT = '[output]\ncsv = "out.csv"\nnpz = "out.npz"\nfigure = "out.svg"'


def test_failure_names_the_row_and_writes_nothing(tmp_path):
    result = cli_run(write(tmp_path, FAILING, TWO, more=OUTPUT))
    assert result.exit_code == 1 and result.stdout == ""
    assert "ValueError: too late" in result.stderr
    assert "(history row 2 of 2, time 1 to 3)" in result.stderr
    assert result.stderr.count("\n") == 1
    assert sorted(p.name for p in tmp_path.iterdir() if p.is_file()) == ["law.py", "scene.toml"]


def test_files(tmp_path):
    path = write(tmp_path, DECAY["vfric_coef"], TWO, "dimension = 3", OUTPUT)
    result = cli_run(path)
    assert result.exit_code == 0, result.stderr
    assert "wrote" in result.stdout and "law: VFRIC_COEF, python, double" in result.stdout
    columns = run_scene(path).history.columns
    lines = (tmp_path / "out.csv").read_text().splitlines()
    header = lines[0].split(",")
    last = dict(zip(header, map(float, lines[-1].split(",")), strict=True))
    assert last["tau_2"] == columns["tau"][-1, 0, 1] and last["increment"] == 2
    with np.load(tmp_path / "out.npz") as stored:
        assert set(stored.files) == set(columns)
        np.testing.assert_array_equal(stored["tau"], columns["tau"])
    svg = (tmp_path / "out.svg").read_text()
    assert svg.lstrip().startswith("<?xml") and len(svg) > 5000


def test_png(tmp_path):
    more = '[output]\nfigure = "out.png"'
    run = run_scene(write(tmp_path, DECAY["vfric"], TWO, more=more))
    assert run.written[0].read_bytes().startswith(b"\x89PNG")


def test_figure_without_matplotlib(tmp_path, monkeypatch):
    monkeypatch.setattr(figure.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(MissingTool, match=r"pip install 'usersub\[report\]'"):
        run_scene(write(tmp_path, DECAY["vfric"], TWO, more='[output]\nfigure = "a.png"'))


def test_for_programs(tmp_path):
    path = write(tmp_path, DECAY["vfric_coef"], TWO + "substeps = 2")
    found = json.loads(cli_run(path, "--json").stdout)
    assert found["command"] == "run" and found["ok"] is True
    assert found["interface"] == "vfric_coef" and found["language"] == "python"
    assert [row["increment"] for row in found["results"]] == [1, 2, 3, 4]
    assert {"tau_1", "tau_2", "coefficient", "point"} <= set(found["results"][0])


def test_plan_and_all_lines(tmp_path):
    path = write(tmp_path, DECAY["vfric_coef"], TWO + "substeps = 21")
    short = cli_run(path).stdout
    assert "24 of 42 lines" in short and "stick_force" not in short
    long = cli_run(path, "--all", "--plan").stdout
    assert "lines" not in long and "stick_force" in long
    assert "the routine does not use it" in long


def test_which_of_several(tmp_path):
    path = write(tmp_path, DECAY["vfric"] + DECAY["vfric_coef"].replace("law", "other"), TWO)
    with pytest.raises(SceneError, match='holds vfric, vfric_coef; say which with interface = "'):
        run_scene(path)
    path.write_text('interface = "vfric_coef"\n' + path.read_text())
    assert run_scene(path).history.routine == "other"


@pytest.mark.parametrize("language", ["python", "c", "fortran"])
def test_built_in_law(tmp_path, language, request):
    if language == "fortran":
        request.getfixturevalue("fortran")
    path = tmp_path / "scene.toml"
    path.write_text(
        f'routine = "coulomb"\ninterface = "vfric"\nlanguage = "{language}"\nprops = [0.25]\n'
        f"[history]\n{TWO}"
    )
    history = run_scene(path).history
    np.testing.assert_allclose(history.columns["mobilised"], 0.25, rtol=1e-14)


@pytest.mark.parametrize(
    ("top", "words"),
    [
        ('routine = "coulom"\ninterface = "fric"', "did you mean 'coulomb'?"),
        ('routine = "coulomb"', "needs the key 'interface'"),
        ('routine = "law.py"\ninterface = "fric"', "FRIC"),
        ('routine = "law.py"\nlanguage = "c"', "is for built-in laws"),
    ],
)
def test_wrong_routine(tmp_path, top, words):
    path = write(tmp_path, DECAY["vfric"], TWO)
    path.write_text(f"{top}\n[history]\n{TWO}")
    result = cli_run(path)
    assert result.exit_code == 1 and words in result.stderr
    assert result.stderr.count("\n") == 1


def test_scene_that_does_not_fit_names_the_file(tmp_path):
    text = TWO.replace("[0, 0], [2, 1], [1, 4]", "[0], [2], [1]")
    result = cli_run(write(tmp_path, DECAY["vfriction"], text, "dimension = 2"))
    assert result.exit_code == 1
    assert result.stderr.startswith(f"usersub run: {tmp_path / 'scene.toml'}: ")
    assert "dimension" in result.stderr


def test_all_interfaces_have_been_seen():
    assert {*DECAY, "fric"} == set(abi.NAMES)


PROBLEM = '[scene]\nprecision = "single"\n[problem]\nname = "p1"\n'


def test_problem_with_own_routine_and_output(tmp_path):
    path = write(tmp_path, DECAY["vfric_coef"], TWO)
    code = "@usersub.vfric_coef\ndef law(fCoef, props):\n    fCoef[:] = props[0]\n"
    (tmp_path / "law.py").write_text(HEAD + code)
    path.write_text('routine = "law.py"\n' + PROBLEM + OUTPUT)
    result = cli_run(path)
    assert result.exit_code == 0, result.stderr
    assert "P1" in result.stdout and "wrote" in result.stdout
    header = (tmp_path / "out.csv").read_text().splitlines()[0]
    assert header.startswith("time,")
    (row,) = json.loads(cli_run(path, "--json").stdout)["results"]
    assert row["ok"] and row["precision"] == "single" and row["interface"] == "vfric_coef"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[problem]\nname = "p1x"', "did you mean 'P1'?"),
        ('[problem]\nname = "P1"\nmethod = "rigit"', "did you mean 'rigid'?"),
        ('[problem]\nname = "P1"\nmetod = "rigid"', "metod"),
        ('[problem]\nname = "P1"\nmethod = 3', "method"),
        ('interface = "fric_coef"\n[problem]\nname = "P3"', "fric_coef"),
    ],
)
def test_problem_that_does_not_fit(tmp_path, text, words):
    path = tmp_path / "scene.toml"
    path.write_text(text)
    result = cli_run(path)
    assert result.exit_code == 1 and words in result.stderr
    assert result.stderr.startswith(f"usersub run: {path}: ")


def test_iterations_go_on_until_lm_settles(tmp_path):
    code = """
@usersub.fric(compiled=False)
def chatters(LM, TAU, STATEV, KINC):
    STATEV[0] = LM[0]
    LM[0] = (LM[0] + 1) % 3 if KINC == 2 else 0
    TAU[0] = TAU[1] = 0.0
"""
    history = run_scene(write(tmp_path, code, TWO + "iterations = 4", "states = 1")).history
    assert any("in 1 increments LM still changed after 4 iterations" in n for n in history.notes)
    # On entry of the fourth iteration of increment 2: 0, 1, 2, 0.
    np.testing.assert_array_equal(history.columns["state"][:, 0, 0], [0, 0])


def test_numbers_too_large_are_noted_without_warnings(tmp_path):
    huge = "time = [0, 1]\nslip = [[0, 0], [1e308, 0]]\npressure = 50.0"
    result = cli_run(write(tmp_path, DECAY["vfric"], huge))
    assert result.exit_code == 0 and "Warning" not in result.stderr
    assert "note: dissipation is not finite from increment 1 on" in result.stdout


def test_more_points_than_memory(tmp_path, monkeypatch):
    def full(*arguments):
        raise MemoryError("Unable to allocate 30 TiB")

    monkeypatch.setattr("usersub.scenefile.setup.complete", full)
    result = cli_run(write(tmp_path, DECAY["vfric"], TWO))
    assert result.exit_code == 1
    assert result.stderr == "usersub run: not enough memory: Unable to allocate 30 TiB\n"


def test_a_problem_in_a_precision_that_its_interface_lacks(tmp_path):
    path = tmp_path / "scene.toml"
    for top in ("", 'routine = "viscoplastic_creep"\nlanguage = "c"\n'):
        path.write_text(top + '[problem]\nname = "P3"\n[scene]\nprecision = "single"\n')
        result = cli_run(path)
        assert result.exit_code == 1
        assert "precision 'single'" in result.stderr and "double" in result.stderr


def test_figure_labels_do_not_overlap(tmp_path):
    figures = pytest.importorskip("matplotlib.figure")
    small = "time = [0, 1, 2]\nslip = [[0, 0], [0.01, 0.02], [-0.01, 0]]\npressure = 5.0"
    run = run_scene(write(tmp_path, DECAY["vfric"], small))
    drawn = figures.Figure(figsize=(9.0, 4.0), layout="constrained")
    figure._draw_points(drawn, run.history)
    drawn.canvas.draw()
    for axes in drawn.axes:
        boxes = [t.get_window_extent() for t in axes.get_xticklabels() if t.get_text()]
        visible = [b for b in boxes if axes.bbox.x0 - 1 <= 0.5 * (b.x0 + b.x1) <= axes.bbox.x1 + 1]
        assert len(visible) > 2
        for left, right in zip(visible, visible[1:], strict=False):
            assert left.x1 < right.x0
