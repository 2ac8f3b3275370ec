# SPDX-License-Identifier: MIT
"""Published-style Fortran files, unchanged, through the drivers, against their formulas.

Tolerance 1e-13 relative throughout: a few roundings of double precision.
"""

from __future__ import annotations

import ctypes
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import usersub
from usersub.routine.info import info

pytestmark = pytest.mark.needs_fortran

_FIELD = Path(__file__).resolve().parents[1] / "field"
_EXACT = {"rtol": 1e-13, "atol": 0.0}


@pytest.fixture(autouse=True)
def empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Runs in a folder of its own, in which no file may appear."""
    folder = tmp_path / "working"
    folder.mkdir()
    monkeypatch.chdir(folder)
    yield folder
    assert [p.name for p in folder.iterdir()] == []


@pytest.fixture
def said() -> list[tuple[int, str]]:
    """What routines say during the test."""
    found: list[tuple[int, str]] = []
    usersub.messages_to(lambda level, text: found.append((level, text)))
    yield found
    usersub.messages_to()


def _slip(first: np.ndarray, rows: int) -> np.ndarray:
    array = np.zeros((rows, len(first)), order="F")
    array[0] = first
    return array


def _explicit(file: str, precision: str = "double", **scene):
    """A step of an explicit routine for four points that slide along x on the plane z = 0."""
    real = np.float64 if precision == "double" else np.float32
    routine = usersub.load(_FIELD / file, precision=precision).only()
    normal_force = np.array([1.0, 2.5, 0.0, 4.0], dtype=real)
    stick_force = np.array([100.0, 0.25, 100.0, 100.0], dtype=real)
    slip = np.asfortranarray(_slip(np.array([1e-3, 2e-3, 3e-3, 5e-4]), 3), dtype=real)
    normal = np.zeros((3, 4), dtype=real, order="F")
    normal[2] = 1
    if routine.interface.name == "vfric":
        scene |= {"secondary_nodes": 6, "main_nodes": 4}
    else:
        scene |= {"nodes": 10}
    driver = usersub.ExplicitDriver(
        routine, usersub.Scene(points=4, dimension=3, precision=precision, **scene)
    )
    arrays = {
        "slip_increment": slip,
        "normal": normal,
        "normal_force": normal_force,
        "stick_force": stick_force,
    }
    return driver, arrays


def _touched(driver) -> None:
    """One increment in which the points come to touch: LM is 2 there, and old code returns."""
    count, rows = driver.points, driver.array("slip").shape[0]
    driver.begin_increment(0.5)
    driver.iterate(slip_increment=np.zeros((rows, count), order="F"), pressure=np.ones(count))
    driver.commit()


def test_old_fric_with_short_names():
    """CHARACTER*8, PREDEF(*), SPD, GETPARTINFO: elastic stick at one point, slip at the other."""
    mu, stiffness = 0.3, 2e4
    scene = usersub.Scene(points=2, dimension=3, props=[mu, stiffness], interaction="DRY")
    driver = usersub.StandardDriver(usersub.load(_FIELD / "fric_char8.f").only(), scene)
    slip = np.array([[1e-6, 4e-4], [-2e-6, -3e-4]], order="F")
    pressure = np.array([5.0, 7.0])
    _touched(driver)
    driver.begin_increment(0.5)
    found = driver.iterate(slip_increment=slip, pressure=pressure)
    trial = stiffness * slip
    limit = mu * pressure
    expected = np.clip(trial, -limit, limit)
    np.testing.assert_allclose(found.tau, expected, **_EXACT)
    plastic = (trial - expected) / stiffness
    np.testing.assert_allclose(found.dslip, plastic, **_EXACT)
    np.testing.assert_allclose(found.sfd, (expected * plastic).sum(axis=0), **_EXACT)
    np.testing.assert_array_equal(found.lm, [0, 0])


def test_short_names_see_the_first_eight_characters():
    routine = usersub.load(_FIELD / "fric_char8.f").only()
    arrays = {"slip_increment": np.array([[1.0]], order="F"), "pressure": np.array([5.0])}
    for name, expected in (("GREASED", 0.0), ("GREASED JOINT", 0.0), ("GREASY", 1.5)):
        scene = usersub.Scene(points=1, dimension=2, props=[0.3, 2e4], interaction=name)
        driver = usersub.StandardDriver(routine, scene)
        _touched(driver)
        driver.begin_increment(0.5)
        assert driver.iterate(**arrays).tau[0, 0] == pytest.approx(expected, rel=1e-13), name


def test_xit_leaves_the_process_alive_and_unit_7_is_heard(said):
    scene = usersub.Scene(points=1, dimension=2, props=[0.3])
    driver = usersub.StandardDriver(usersub.load(_FIELD / "fric_char8.f").only(), scene)
    _touched(driver)
    driver.begin_increment(0.5)
    with pytest.raises(usersub.RoutineError, match="XIT"):
        driver.iterate(slip_increment=np.ones((1, 1), order="F"), pressure=np.ones(1))
    assert [text.split() for level, text in said if level == 0] == [
        "FRIC NEEDS TWO PROPERTIES, GOT 1".split()
    ]


def test_crlf_tabs_and_bytes_of_other_encodings():
    """A legacy FRIC_COEF in a scene of generation 2022."""
    data = (_FIELD / "fric_coef_tabs.for").read_bytes()
    assert data.count(b"\r\n") == data.count(b"\n") and b"\t" in data and b"\xf6" in data
    routine = usersub.load(_FIELD / "fric_coef_tabs.for").only()
    assert routine.interface.key == "fric_coef"
    scene = usersub.Scene(points=3, dimension=3, props=[0.4, 0.1, 0.02], generation="2022")
    driver = usersub.CoefficientDriver(routine, scene)
    rate = np.array([0.0, 30.0, 1e3])
    found = driver.evaluate(slip_rate=rate, pressure=np.array([1.0, 2.0, 3.0]))
    np.testing.assert_allclose(found, 0.1 + 0.3 * np.exp(-0.02 * rate), **_EXACT)


def test_state_behind_a_cray_pointer():
    """FRIC_COEF of 2022 in a standard driver: mu of the equivalent slip of each point."""
    routine = usersub.load(_FIELD / "fric_coef_state.f").only()
    assert routine.interface.key == "fric_coef_2022"
    scene = usersub.Scene(points=2, dimension=3, props=[0.5, 3.0], states=2, elastic_slip=1e-9)
    driver = usersub.StandardDriver(routine, scene)
    slip = np.array([[0.25, 0.0], [0.0, 0.5]], order="F")
    driver.begin_increment(0.1, increment=4)
    found = driver.iterate(slip_increment=slip, pressure=np.array([2.0, 3.0]))
    driver.commit()
    equivalent = np.array([0.25, 0.5]) - 1e-9
    mu = 0.5 / (1 + 3.0 * equivalent)
    # The slip is reached by an iteration on the coefficient; it ends at rounding.
    np.testing.assert_allclose(np.linalg.norm(found.tau, axis=0), mu * [2.0, 3.0], rtol=1e-9)
    np.testing.assert_allclose(driver.array("state")[0], equivalent, rtol=1e-6)
    np.testing.assert_array_equal(driver.array("state")[1], [4, 4])


@pytest.mark.parametrize("precision", ["double", "single"])
def test_common_data_that_another_entry_fills(precision):
    file = usersub.load(_FIELD / "vfric_common.for", precision=precision)
    assert not file.only().thread_safe
    driver, arrays = _explicit("vfric_common.for", precision, props=[0.2], states=1)
    nodes = np.array([2, 4, 6, 1], dtype=np.int32)
    force = driver.step(0.1, secondary_node=nodes, **arrays).force
    expected = [-0.2, -0.25, 0.0, -0.8]
    np.testing.assert_allclose(force[0], expected, rtol=1e-6)
    real = ctypes.c_double if precision == "double" else ctypes.c_float
    ctypes.CFUNCTYPE(None, ctypes.POINTER(real))(file.symbol("VUSDFLD"))(real(0.05))
    force = driver.step(0.1, **arrays).force
    np.testing.assert_allclose(force[0], [-0.05, -0.125, 0.0, -0.2], rtol=1e-6)
    assert ctypes.CFUNCTYPE(ctypes.c_int)(file.symbol("kcount"))() == 2
    state = driver.array("state")[0]
    slips = 2 * arrays["slip_increment"][0]
    np.testing.assert_allclose(state[[1, 3, 0]], slips[[0, 1, 3]], rtol=1e-6)
    assert state[5] == 0  # the third point is not loaded
    ctypes.CFUNCTYPE(None, ctypes.POINTER(real))(file.symbol("vusdfld"))(real(0.0))


def test_header_before_every_unit_types_get_thread_id():
    driver, arrays = _explicit("vfriction_threads.f", props=[0.4, 0.1, 2.0], states=2)
    nodes = np.array([[7, 3, 9, 5]], dtype=np.int32, order="F")
    force = driver.step(0.1, secondary_node=nodes, **arrays).force
    rate = arrays["slip_increment"][0] / 0.1
    mu = 0.1 + 0.3 * np.exp(-2.0 * rate)
    expected = -np.minimum(mu * arrays["normal_force"], arrays["stick_force"])
    np.testing.assert_allclose(force[0], expected, **_EXACT)
    state = driver.array("state")
    np.testing.assert_array_equal(state[0, 0], [1, 1, 0, 1])
    np.testing.assert_array_equal(state[1, 0], [7, 3, 0, 5])


def test_own_xit_and_include_file_in_another_case():
    driver, arrays = _explicit("vfriction_own_xit.f", props=[0.9])
    for _ in range(2):  # the first call goes through the file's own XIT
        force = driver.step(0.1, **arrays).force
        np.testing.assert_allclose(force[0], [-0.6, -0.25, 0.0, -2.4], **_EXACT)
    assert "variable first" in info(_FIELD / "vfriction_own_xit.f").shared_state
    driver, arrays = _explicit("vfriction_own_xit.f", props=[0.9], interaction="WET SIDE")
    np.testing.assert_allclose(driver.step(0.1, **arrays).force[0, 3], -0.2, **_EXACT)


@pytest.mark.parametrize("precision", ["double", "single"])
def test_free_form_with_module(precision):
    real = np.float64 if precision == "double" else np.float32
    routine = usersub.load(_FIELD / "vfric_coef_free.f90", precision=precision).only()
    scene = usersub.Scene(
        points=3, props=[0.5, 10.0, 0.01], precision=precision, temperatures=1, nodes=1
    )
    driver = usersub.CoefficientDriver(routine, scene)
    pressure = np.array([0.0, 5.0, 20.0], dtype=real)
    temperature = np.array([20.0, -10.0, 100.0], dtype=real)
    found = driver.evaluate(
        slip_rate=np.zeros(3, dtype=real), pressure=pressure, temperature=temperature
    )
    expected = 0.5 / (1 + pressure / 10) * (1 + 0.01 * temperature)
    np.testing.assert_allclose(found, expected, rtol=1e-13 if precision == "double" else 1e-6)


def test_free_form_by_directive():
    driver, arrays = _explicit("vfric_directive.for", props=[0.3, 0.5])
    area = np.array([1.0, 2.0, 4.0, 0.5, 8.0, 3.0])
    nodes = np.array([2, 4, 6, 3], dtype=np.int32)
    force = driver.step(0.1, secondary_node=nodes, area=area, **arrays).force
    a = area[nodes - 1]
    expected = 0.3 * np.sqrt(arrays["normal_force"] / a) * a
    np.testing.assert_allclose(force[0], -np.minimum(expected, arrays["stick_force"]), **_EXACT)


def test_two_interfaces_and_entries_of_the_commercial_solver():
    file = usersub.load(_FIELD / "fric_with_entries.f")
    assert list(file) == ["fric", "vfric_coef"]
    found = info(file)
    assert found.entries == ("UEL", "UEXTERNALDB", "UFIELD", "VUMAT")
    assert found.absent == ("GETVRM", "KRETURNMAP")
    assert found.shared_state == ("COMMON /KDATA/",)
    with pytest.raises(usersub.LoadError, match=r"FRIC, VFRIC_COEF.*choose one"):
        file.only()
    lop = ctypes.byref(ctypes.c_int(0))
    ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 6)(file.symbol("uexternaldb"))(*[lop] * 6)
    scene = usersub.Scene(points=1, dimension=2, props=[0.02, 0.9], characteristic_length=2.0)
    driver = usersub.StandardDriver(file["FRIC"], scene)
    driver.begin_increment(0.5)
    slip = np.array([[0.3]], order="F")
    found = driver.iterate(slip_increment=slip, pressure=np.array([8.0]))
    # The literal .005 of the source is in single precision.
    stiffness = 0.02 / (float(np.float32(0.005)) * 2.0)
    np.testing.assert_allclose(found.tau, 0.25 * 8 * np.tanh(stiffness * slip), **_EXACT)


def test_everything_that_a_routine_may_say(said):
    scene = usersub.Scene(points=2, dimension=2, props=[0.1, 50.0])
    driver = usersub.StandardDriver(usersub.load(_FIELD / "fric_messages.f").only(), scene)
    driver.begin_increment(0.5)
    arrays = {
        "slip_increment": np.ones((1, 2), order="F"),
        "pressure": np.array([20.0, 30.0]),
        "node": np.array([41, 17], dtype=np.int32),
    }
    found = driver.iterate(**arrays)
    np.testing.assert_allclose(found.tau[0], [2.0, 3.0], **_EXACT)
    warnings = [text for level, text in said if level == -1]
    assert len(warnings) == 2 and "41" in warnings[0] and "GREASED" in warnings[0]
    lines = [text.strip() for level, text in said if level == 0]
    assert lines.count("on unit 6") == 2 and "on unit 7:    17" in lines
    assert any(line.startswith("job ") for line in lines)
    before = driver.array("committed_tau").copy()
    with pytest.raises(usersub.RoutineError):
        driver.iterate(**(arrays | {"pressure": np.array([20.0, 60.0])}))
    assert any(level == -3 and "PRESSURE TOO LARGE" in text for level, text in said)
    np.testing.assert_array_equal(driver.array("committed_tau"), before)


def test_arrays_of_the_thread_instead_of_common(said):
    driver, arrays = _explicit("vfriction_arrays.f", props=[0.2, 1.0])
    assert driver.routine.thread_safe
    force = driver.step(0.1, **arrays).force
    np.testing.assert_allclose(force[0], [-0.2, -0.25, 0.0, -0.8], **_EXACT)
    driver, arrays = _explicit("vfriction_arrays.f", props=[0.2, -1.0])
    with pytest.raises(usersub.RoutineError, match="XPLB_EXIT"):
        driver.step(0.1, **arrays)
    assert any(level == -2 and text.startswith("SUM") for level, text in said)


def test_compile_error_has_file_line_column_and_words():
    with pytest.raises(usersub.CompileError) as caught:
        usersub.load(_FIELD / "planted" / "compile_error.f")
    assert "compile_error.f:5:22: Symbol 'unknown' at (1) has no IMPLICIT type" in str(caught.value)


def test_line_numbers_survive_inserted_declarations(tmp_path):
    text = (_FIELD / "vfriction_threads.f").read_text()
    broken = text.replace("      Return\n", "      Return Nowhere)\n")
    line = broken[: broken.index("Nowhere")].count("\n") + 1
    source = tmp_path / "broken.f"
    source.write_text(broken)
    with pytest.raises(usersub.CompileError, match=rf"broken\.f:{line}:"):
        usersub.load(source)


def test_missing_symbol_is_named():
    with pytest.raises(usersub.LoadError, match="calls KELSEWHERE, which neither"):
        usersub.load(_FIELD / "planted" / "missing_symbol.f")


def test_functions_of_a_file_are_found_in_any_case():
    file = usersub.load(_FIELD / "fric_with_entries.f")
    assert file.symbol("vumat") == file.symbol("VUMAT_") != 0
    with pytest.raises(usersub.LoadError, match="no function 'umat'; it has"):
        file.symbol("umat")


def test_absent_function_says_its_name_and_ends_the_call():
    """Nothing is armed outside of a driver, so that the process ends, with a sentence."""
    script = (
        "import ctypes, usersub\n"
        "from usersub.routine import messages\n"
        "messages.connect()\n"
        f"place = usersub.load({str(_FIELD / 'fric_with_entries.f')!r}).symbol('vumat')\n"
        "n, x = ctypes.c_int(1), ctypes.c_double(2)\n"
        "ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 2)(place)(ctypes.byref(n), ctypes.byref(x))\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 1
    assert "GETVRM was called, which usersub does not provide" in done.stderr


def test_large_local_arrays_need_no_large_stack(tmp_path):
    """20 MB of local data: static, so that the routine keeps to one thread."""
    source = tmp_path / "large.f90"
    source.write_text(
        "subroutine vfric_coef(fc,fd,nb,np,nt,nf,jf,rd,a,b,c,props,rate,p,t,f)\n"
        " include 'vaba_param.inc'\n character*80 a, b, c\n dimension fc(nb), props(np)\n"
        " dimension work(2500000)\n do k = 1, 2500000\n  work(k) = k\n end do\n"
        " fc(1) = props(1) + work(int(props(2)))\nend\n"
    )
    routine = usersub.load(source).only()
    assert not routine.thread_safe and info(source).shared_state == ("variable work",)
    driver = usersub.CoefficientDriver(routine, usersub.Scene(points=1, props=[0.25, 2e6], nodes=1))
    assert driver.evaluate(slip_rate=np.zeros(1), pressure=np.ones(1))[0] == 2000000.25


def test_huge_common_block_is_not_touched(tmp_path):
    """1.6 GB of COMMON data of which one word is used."""
    source = tmp_path / "huge.for"
    source.write_text(
        "      SUBROUTINE VFRIC_COEF(FC,FD,NB,NP,NT,NF,JF,RD,A,B,C,PROPS,RATE,P,T,F)\n"
        "      INCLUDE 'VABA_PARAM.INC' ! with a remark\n      CHARACTER*8 A, B, C\n"
        "      COMMON /HUGE/ X(200000000)\n      DIMENSION FC(NB), PROPS(NP)\n"
        "      X(123456789) = PROPS(1)\n      FC(1) = X(123456789) + X(1)\n      END\n"
    )
    driver = usersub.CoefficientDriver(
        usersub.load(source).only(), usersub.Scene(points=1, props=[0.25], nodes=1)
    )
    assert driver.evaluate(slip_rate=np.zeros(1), pressure=np.ones(1))[0] == 0.25


def test_second_entry_of_a_unit_is_a_routine_without_a_check(tmp_path):
    """gfortran describes units with ENTRY without their arguments."""
    arguments = "(FC,FD,NB,NP,NT,NF,J,R,A,B,C,PROPS,S,P,T,F)"
    source = tmp_path / "entry.f"
    source.write_text(
        f"      SUBROUTINE VFRIC_COEF{arguments}\n      INCLUDE 'VABA_PARAM.INC'\n"
        "      CHARACTER*80 A, B, C\n      DIMENSION FC(NB), PROPS(NP)\n"
        f"      FC(1) = PROPS(1)\n      RETURN\n      ENTRY FRIC_COEF{arguments}\n"
        "      FC(1) = PROPS(2)\n      END\n"
    )
    file = usersub.load(source, generation="legacy")
    assert [r.checked for r in info(file).routines] == [False, False]
    assert file["fric_coef"].uses is None
    scene = usersub.Scene(points=1, props=[0.25, 0.75], nodes=1)
    for name, expected in (("fric_coef", 0.75), ("vfric_coef", 0.25)):
        driver = usersub.CoefficientDriver(file[name], scene)
        assert driver.evaluate(slip_rate=np.zeros(1), pressure=np.ones(1))[0] == expected


def test_names_of_files_may_hold_blanks_quotes_and_letters(tmp_path):
    source = tmp_path / "my law's größe.F"
    source.write_bytes((_FIELD / "vfriction_own_xit.f").read_bytes())
    (tmp_path / "MY_LIMITS.inc").write_bytes((_FIELD / "my_limits.inc").read_bytes())
    used = usersub.load(source).only().uses
    assert used == usersub.load(_FIELD / "vfriction_own_xit.f").only().uses


def test_include_files_in_folders_and_of_other_systems(tmp_path):
    """Backslashes, folders in another case, one include file in another, an own typing rule."""
    (tmp_path / "Include" / "Deep").mkdir(parents=True)
    (tmp_path / "Include" / "outer.inc").write_text("      include 'deep/INNER.INC'\r\n")
    (tmp_path / "Include" / "Deep" / "inner.inc").write_text(
        "      implicit real*8 (a-h,o-z)\r\n      parameter (half = 0.5d0)\r\n"
    )
    source = tmp_path / "law.for"
    source.write_text(
        "      SUBROUTINE VFRIC_COEF(FC,FD,NB,NP,NT,NF,JF,RD,A,B,C,PROPS,RATE,P,T,F)\n"
        "#include <SMAAspUserSubroutines.hdr>\n      INCLUDE 'include\\OUTER.inc'\n"
        "      CHARACTER*80 A, B, C\n      DIMENSION FC(NB), P(NB)\n"
        "      FC(1) = HALF*P(1) + GET_THREAD_ID()\n      END\n"
    )
    driver = usersub.CoefficientDriver(
        usersub.load(source).only(), usersub.Scene(points=1, nodes=1)
    )
    assert driver.evaluate(slip_rate=np.zeros(1), pressure=np.array([3.0]))[0] == 1.5


def test_extensions_of_other_compilers(tmp_path):
    source = tmp_path / "law.f"
    source.write_text(
        "      SUBROUTINE VFRIC_COEF(FC,FD,NB,NP,NT,NF,JF,RD,A,B,C,PROPS,RATE,P,T,F)\n"
        "      INCLUDE 'VABA_PARAM.INC'\n      CHARACTER*80 A, B, C\n"
        "      DIMENSION FC(NB), PROPS(NP)\n      STRUCTURE /PAIR/\n        REAL*8 FIRST\n"
        "        REAL*8 SECOND\n      END STRUCTURE\n      RECORD /PAIR/ MU\n"
        "      MU.FIRST = PROPS(1)\n      MU.SECOND = 2\nD     FC(1) = 7\n"
        "      FC(1) = MU.FIRST*MU.SECOND\n      END\n"
    )
    driver = usersub.CoefficientDriver(
        usersub.load(source).only(), usersub.Scene(points=1, props=[0.25], nodes=1)
    )
    assert driver.evaluate(slip_rate=np.zeros(1), pressure=np.ones(1))[0] == 0.5


def test_fortran_object(tmp_path, fortran, said):
    text = (_FIELD / "fric_messages.f").read_text().replace("#include", "C     include")
    (tmp_path / "law.f").write_text(
        text.replace("INCLUDE 'ABA_PARAM.INC'", "IMPLICIT REAL*8(A-H,O-Z)")
    )
    part = tmp_path / "law.o"
    flags = ["-c", "-fPIC", "-ffixed-line-length-132", "-fallow-argument-mismatch"]
    subprocess.run([fortran, *flags, str(tmp_path / "law.f"), "-o", str(part)], check=True)
    scene = usersub.Scene(points=1, dimension=2, props=[0.1, 50.0])
    driver = usersub.StandardDriver(usersub.load(part).only(), scene)
    driver.begin_increment(0.5)
    driver.iterate(slip_increment=np.ones((1, 1), order="F"), pressure=np.array([20.0]))
    assert (0, " on unit 6") in said
