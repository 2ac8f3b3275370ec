# SPDX-License-Identifier: MIT
"""Loading files: what is found, what is refused and how, prebuilt libraries and objects."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import usersub
from usersub.routine import compilers
from usersub.routine.info import info
from usersub.routine.support import support

_FIELD = Path(__file__).resolve().parents[1] / "field"
_LAW = """\
#include <stdlib.h>
extern void xplb_exit_(void);
double limit = 5;
void vfric_coef_(double *f, double *d, int *n, int *np, int *nt, int *nf, int *jf, double *rd,
                 char *a, char *b, char *c, double *props, double *rate, double *p, double *t,
                 double *av) {
  for (int k = 0; k < *n; ++k) {
    if (p[k] > 2 * limit) exit(3);
    if (p[k] > limit) xplb_exit_();
    f[k] = props[0] * rate[k];
  }
}
"""


def _cc(tmp_path: Path, source: str, name: str, *flags: str) -> Path:
    """Compiles like somebody who does not know of usersub."""
    code = tmp_path / "plain.c"
    code.write_text(source)
    made = tmp_path / name
    subprocess.run([*compilers.find("c").command, str(code), "-o", str(made), *flags], check=True)
    return made


def _coefficient(routine, pressure: float) -> float:
    scene = usersub.Scene(points=1, props=[0.25], nodes=1)
    driver = usersub.CoefficientDriver(routine, scene)
    return driver.evaluate(slip_rate=np.array([0.5]), pressure=np.array([pressure]))[0]


def test_file_that_is_not_there():
    with pytest.raises(usersub.LoadError, match=r"there is no file /nowhere/law\.f"):
        usersub.load("/nowhere/law.f")


def test_suffix_that_is_not_known(tmp_path):
    (tmp_path / "law.txt").write_text("")
    with pytest.raises(usersub.LoadError, match=r"suffix '\.txt', expected one of \.f, \.for"):
        usersub.load(tmp_path / "law.txt")


def test_precision_that_does_not_exist():
    with pytest.raises(
        usersub.AbiError, match="precision is 'half', expected 'double' or 'single'"
    ):
        usersub.load(_FIELD / "vfric_coef_table.c", precision="half")


@pytest.mark.needs_fortran
def test_file_without_an_interface_lists_what_it_has():
    with pytest.raises(usersub.LoadError) as caught:
        usersub.load(_FIELD / "planted" / "no_interface.f")
    assert "none of the interfaces FRIC, FRIC_COEF, VFRIC, VFRICTION, VFRIC_COEF" in str(
        caught.value
    )
    assert "defines: FRICTION, UMAT" in str(caught.value)


def test_c_name_without_for_name_gets_a_hint():
    with pytest.raises(usersub.LoadError, match=r"FOR_NAME\(vfric_coef,VFRIC_COEF\)"):
        usersub.load(_FIELD / "planted" / "vfric_coef_plain_name.c")


def test_cxx_name_without_extern_c_gets_a_hint(tmp_path):
    source = tmp_path / "law.cpp"
    source.write_text("#include <omi_for_c.h>\nvoid FOR_NAME(fric_coef,FRIC_COEF)(double *) {}\n")
    with pytest.raises(usersub.LoadError, match='behind extern "C"'):
        usersub.load(source)


def test_interface_that_the_file_does_not_have():
    file = usersub.load(_FIELD / "vfric_coef_table.c")
    with pytest.raises(usersub.LoadError, match="has no FRIC; it has VFRIC_COEF"):
        file["fric"]
    with pytest.raises(usersub.LoadError, match="has no VFRIC; it has VFRIC_COEF"):
        usersub.load(_FIELD / "vfric_coef_table.c", interface="vfric")
    with pytest.raises(usersub.LoadError, match="'friction' is not an interface"):
        usersub.load(_FIELD / "vfric_coef_table.c", interface="friction")


def test_a_file_is_a_mapping_without_case():
    file = usersub.load(_FIELD / "vfric_coef_table.c")
    assert list(file) == ["vfric_coef"] and len(file) == 1
    assert "VFRIC_COEF" in file and "fric" not in file
    assert file["Vfric_Coef"] is file.only()
    assert file.language == "c" and file.path.name == "vfric_coef_table.c"
    assert repr(file) == "<RoutineFile vfric_coef_table.c: VFRIC_COEF>"


@pytest.mark.needs_fortran
def test_one_interface_of_a_file_with_a_fault_in_another(tmp_path):
    text = (_FIELD / "fric_with_entries.f").read_text().replace("DDTDDT,PNEWDT,", "DDTDDT,")
    source = tmp_path / "law.f"
    source.write_text(text)
    with pytest.raises(usersub.AbiError, match="FRIC has 38 arguments"):
        usersub.load(source)
    assert list(usersub.load(source, interface="VFRIC_COEF")) == ["vfric_coef"]


@pytest.mark.needs_fortran
def test_standard_interfaces_stay_in_double_precision():
    file = usersub.load(_FIELD / "fric_with_entries.f", precision="single")
    assert file["fric"].entry("double").address != 0
    with pytest.raises(usersub.AbiError, match="FRIC exists in double precision, not in 'single'"):
        file["fric"].entry("single")


def test_generation_that_does_not_exist():
    with pytest.raises(usersub.AbiError, match="'2030', expected 'legacy' or '2022'"):
        usersub.load(_FIELD / "fric_coef_throws.cpp", generation="2030")


def test_python_file(tmp_path):
    source = tmp_path / "law.py"
    source.write_text(
        "import usersub\n\n@usersub.vfric_coef\ndef mu(fCoef, slipRate):\n    fCoef[:] = 0.5\n"
    )
    file = usersub.load(source)
    assert file.language == "python" and list(file) == ["vfric_coef"]
    assert info(file).routines[0].checked
    with pytest.raises(usersub.LoadError, match="has no symbols"):
        file.symbol("mu")


@pytest.mark.parametrize("flags", [(), ("-Wl,-z,now",)], ids=["lazy", "now"])
def test_prebuilt_library_without_debug_information(tmp_path, flags):
    library = _cc(tmp_path, _LAW, "law.so", "-shared", "-fPIC", "-O1", *flags)
    routine = usersub.load(library).only()
    assert routine.language == "library" and routine.uses is None and not routine.thread_safe
    assert _coefficient(routine, 1.0) == 0.125
    for pressure, reason in ((6.0, "XPLB_EXIT"), (20.0, "exit")):
        with pytest.raises(usersub.RoutineError, match=reason):
            _coefficient(routine, pressure)
    found = info(library)
    assert found.shared_state == ("variable limit",)
    assert not found.routines[0].checked
    assert "not checked" in found.routines[0].notes[0]
    with pytest.raises(usersub.AbiError, match="built in double precision, but single"):
        routine.entry("single")


def test_prebuilt_library_with_debug_information_is_checked(tmp_path):
    library = _cc(tmp_path, _LAW, "law.so", "-shared", "-fPIC", "-g")
    assert info(library).routines[0].checked
    wrong = _LAW.replace("char *b, char *c", "char *b")
    library = _cc(tmp_path, wrong, "wrong.so", "-shared", "-fPIC", "-g")
    with pytest.raises(usersub.AbiError, match="VFRIC_COEF has 15 arguments"):
        usersub.load(library)
    with pytest.raises(usersub.AbiError, match=r"is double \*, expected float \* in single"):
        usersub.load(tmp_path / "law.so", precision="single")


def test_stripped_library_with_data_is_not_thread_safe(tmp_path):
    source = _LAW.replace("= 5", "= 5, more[64]").replace("> limit)", "> limit + more[k])")
    library = _cc(tmp_path, source, "law.so", "-shared", "-fPIC", "-s")
    assert not usersub.load(library).only().thread_safe


def test_object_file(tmp_path):
    part = _cc(tmp_path, _LAW, "law.o", "-c", "-fPIC")
    routine = usersub.load(part).only()
    assert _coefficient(routine, 1.0) == 0.125
    with pytest.raises(usersub.RoutineError, match="exit"):
        _coefficient(routine, 20.0)


def test_library_with_symbols_that_nobody_defines(tmp_path):
    source = _LAW.replace("xplb_exit_", "kelsewhere_")
    library = _cc(tmp_path, source, "law.so", "-shared", "-fPIC")
    routine = usersub.load(library).only()
    with pytest.raises(usersub.LoadError, match=r"law\.so needs kelsewhere_, which neither"):
        routine.entry()


@pytest.mark.skipif(sys.platform != "linux", reason="calls are redirected on Linux")
def test_library_that_calls_what_only_the_solver_has(tmp_path):
    """It runs as long as it does not come to the call, and lives through it."""
    source = _LAW.replace("xplb_exit_", "getvrm_")
    library = _cc(tmp_path, source, "law.so", "-shared", "-fPIC")
    routine = usersub.load(library).only()
    assert info(library).absent == ("GETVRM",)
    assert _coefficient(routine, 1.0) == 0.125
    with pytest.raises(usersub.RoutineError, match="GETVRM was called, which usersub does not"):
        _coefficient(routine, 6.0)
    assert _coefficient(routine, 1.0) == 0.125


def test_file_that_is_no_library(tmp_path):
    (tmp_path / "law.so").write_text("text")
    with pytest.raises(usersub.LoadError, match=r"law\.so is not an object or library"):
        usersub.load(tmp_path / "law.so")


def test_two_files_with_the_same_names_do_not_meet(tmp_path):
    """COMMON blocks, static data and helpers of one library are not those of another."""
    text = (_FIELD / "vfric_coef_table.c").read_text()
    text = text.replace("static usub_real at", "usub_real at")
    (tmp_path / "one.c").write_text(text)
    (tmp_path / "two.c").write_text(text.replace("return props[1]", "return 1 + props[1]"))
    one, two = usersub.load(tmp_path / "one.c").only(), usersub.load(tmp_path / "two.c").only()
    for routine, expected in ((one, 0.3), (two, 1.3), (one, 0.3)):
        scene = usersub.Scene(points=1, props=[0.3, 0.3, 1.0], nodes=1)
        driver = usersub.CoefficientDriver(routine, scene)
        found = driver.evaluate(slip_rate=np.array([0.5]), pressure=np.array([1.0]))
        assert found[0] == pytest.approx(expected, rel=1e-15)


def test_info_is_plain_data():
    found = info(_FIELD / "vfric_coef_table.c").as_dict()
    assert json.loads(json.dumps(found))["routines"][0]["arguments"][0] == {
        "name": "fCoef",
        "declared": "fCoef",
        "kind": "real",
        "shape": ["nBlock"],
        "does": "writes",
    }
    assert (
        info(usersub.load(_FIELD / "vfric_coef_table.c").only()).routines[0].interface
        == "vfric_coef"
    )


def test_loading_c_imports_neither_numba_nor_fortran_tools():
    script = (
        "import sys, usersub\n"
        f"usersub.load({str(_FIELD / 'vfric_coef_table.c')!r}).only().entry()\n"
        "assert not {'numba', 'scipy', 'matplotlib', 'rich'} & set(sys.modules)\n"
    )
    environment_is_inherited = subprocess.run([sys.executable, "-c", script], check=False)
    assert environment_is_inherited.returncode == 0


def test_our_headers_and_library_are_there():
    base = support()
    assert base.library.is_file() and "exit" in base.wrapped
    assert all(folder.is_dir() for folder in base.include_folders("single"))


def test_what_is_no_file_and_no_generation(tmp_path):
    (tmp_path / "law.f").mkdir()
    with pytest.raises(usersub.LoadError, match=r"law\.f is a folder, expected a file"):
        usersub.load(tmp_path / "law.f")
    with pytest.raises(usersub.AbiError, match="generation is '1999', expected 'legacy' or '2022'"):
        usersub.load(tmp_path / "law.f", generation="1999")


def test_a_message_lists_a_dozen_functions(tmp_path):
    file = tmp_path / "many.c"
    file.write_text("".join(f"void part_{k:02d}(void) {{}}\n" for k in range(40)))
    with pytest.raises(usersub.LoadError, match="PART_11, and 28 more") as raised:
        usersub.load(file)
    assert "PART_12" not in str(raised.value)


def test_repr_is_short(tmp_path):
    file = tmp_path / "law.c"
    file.write_text(
        "#include <usersub/abi.h>\n"
        "void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) { fCoef[0] = 0.5; }\n"
    )
    shown = repr(usersub.load(file)["vfric_coef"])
    assert shown == f"<VFRIC_COEF routine 'law.c' (legacy, c) at {file}:2>"
