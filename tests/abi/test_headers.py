# SPDX-License-Identifier: MIT
"""The C headers alone, in three languages; what the compiler refuses; calls in the right order."""

import shutil
import subprocess

import pytest

from usersub import abi
from usersub.emit import text
from usersub.emit.__main__ import ROOT
from usersub.statuses import STATUSES

INCLUDE = ROOT / "csrc/include"
FIELD = INCLUDE / "usersub/field"
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
STANDARDS = [("c99", "c"), ("c11", "c"), ("c++17", "c++")]

CC, CXX = shutil.which("cc") or shutil.which("gcc"), shutil.which("c++") or shutil.which("g++")
pytestmark = pytest.mark.skipif(CC is None, reason="no C compiler (cc, gcc) on this machine")


def compiled(tmp_path, source, language="c", *flags):
    """Compiles `source`; returns exit status and the compiler's words."""
    compiler = CC if language == "c" else CXX
    if compiler is None:
        pytest.skip("no C++ compiler (c++, g++) on this machine")
    file = tmp_path / "source"
    file.write_text(source)
    done = subprocess.run(
        [compiler, "-x", language, "-c", str(file), "-o", str(tmp_path / "out.o"), *WARNINGS,
         f"-I{INCLUDE}", f"-I{FIELD}", *flags],
        capture_output=True, text=True,
    )  # fmt: skip
    return done.returncode, done.stderr


@pytest.mark.parametrize(("standard", "language"), STANDARDS, ids=[s for s, _ in STANDARDS])
@pytest.mark.parametrize("flags", [(), ("-DUSUB_SINGLE",)], ids=["double", "single"])
@pytest.mark.parametrize(
    "header",
    ["usersub/abi.h", "usersub/status.h", "usersub/usersub.h", "omi_for_c.h",
     "SMAAspUserSubroutines.h", "SMAAspUserArrays.h", "SMAAspUserUtilities.h"],
)  # fmt: skip
def test_header_alone(tmp_path, header, standard, language, flags):
    source = f"#include <{header}>\n#include <{header}>\nint usub_here;\n"
    assert compiled(tmp_path, source, language, f"-std={standard}", *flags) == (0, "")


def declaration(face):
    return f"void FOR_NAME({face.name}, {face.name.upper()})({text.constant(face)}_PARAMETERS)"


@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda f: f.key)
@pytest.mark.parametrize(("standard", "language"), STANDARDS, ids=[s for s, _ in STANDARDS])
@pytest.mark.parametrize("precision", ["double", "single"])
def test_parameter_list_is_the_function_type(tmp_path, face, standard, language, precision):
    types = text.function_types(face)
    name = types["float" if precision == "single" and len(types) > 1 else "double"]
    extern = 'extern "C" ' if language == "c++" else ""
    source = (
        "#include <omi_for_c.h>\n#include <usersub/abi.h>\n"
        f"{extern}{declaration(face)};\n"
        f"{name} *usub_checked = {face.symbol};\n"
    )
    flags = ["-DUSUB_SINGLE"] if precision == "single" else []
    assert compiled(tmp_path, source, language, f"-std={standard}", *flags) == (0, "")


@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda f: f.key)
def test_swapped_arguments_are_refused(tmp_path, face):
    # Two neighbours of different C type change places, and only that.
    parameters = text.c_parameters(face, "double")
    kinds = [text.c_type(a, "double") for a in face.args]
    first = next(i for i in range(len(kinds) - 1) if kinds[i] != kinds[i + 1])
    parameters[first : first + 2] = parameters[first : first + 2][::-1]
    name = text.function_types(face)["double"]
    source = (
        f"#include <usersub/abi.h>\nvoid law({', '.join(parameters)});\n{name} *checked = law;\n"
    )
    status, words = compiled(tmp_path, source, "c", "-std=c11")
    assert status != 0 and "incompatible pointer type" in words


def test_wrong_precision_is_refused(tmp_path):
    source = (
        "#include <usersub/abi.h>\nvoid law(USUB_VFRIC_PARAMETERS);\nusub_vfric_fn_d *f = law;\n"
    )
    assert compiled(tmp_path, source, "c")[0] == 0
    status, words = compiled(tmp_path, source, "c", "-DUSUB_SINGLE")
    assert status != 0 and "incompatible pointer type" in words


def ran(tmp_path, source, *flags):
    file, program = tmp_path / "program.c", tmp_path / "program"
    file.write_text(source)
    subprocess.run(
        [CC, "-std=c11", *WARNINGS, f"-I{INCLUDE}", f"-I{ROOT / 'csrc'}", *flags, str(file), "-o",
         str(program)],
        check=True,
    )  # fmt: skip
    return subprocess.run([program], capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize(
    ("face", "real"),
    [(f, real) for f in abi.INTERFACES for real in text.function_types(f)],
    ids=lambda x: getattr(x, "key", x),
)
def test_call_passes_every_address_in_its_place(tmp_path, face, real):
    count = len(face.args)
    takes = "\n".join(f"  seen[{i}] = (const void *){a.modern};" for i, a in enumerate(face.args))
    lengths = " + ".join(f"{a.modern}_length" for a in text.texts(face))
    source = f"""
#include <stdio.h>
#include "driver/call.inc"
static const void *seen[{count}];
static size_t total;
static void law({text.constant(face)}_PARAMETERS) {{
{takes}
  total = {lengths};
}}
int main(void) {{
  static double memory[{count}];
  void *argv[{count}];
  for (int i = 0; i < {count}; ++i) argv[i] = &memory[i];
  usub_call_{face.key}_{real[0]}((usub_entry)law, argv);
  int wrong = 0;
  for (int i = 0; i < {count}; ++i) wrong += seen[i] != argv[i];
  printf("%d %d %zu\\n", wrong, (int){text.constant(face)}_COUNT, total);
  return 0;
}}
"""
    # The other calls of call.inc are unused here; GCC does not warn about inline ones.
    flags = ["-DUSUB_SINGLE"] if real == "float" else []
    assert ran(tmp_path, source, *flags) == f"0 {count} {3 * abi.NAME_LENGTH}\n"


def test_statuses_in_c(tmp_path):
    source = """
#include <stdio.h>
#include <usersub/status.h>
#define SHOW(name, value, text) printf("%s %d %d %s\\n", #name, value, USUB_##name, text);
int main(void) { USUB_STATUSES(SHOW) return 0; }
"""
    expected = "".join(f"{s.name} {s.value} {s.value} {s.text}\n" for s in STATUSES)
    assert ran(tmp_path, source) == expected


def test_positions_in_c(tmp_path):
    names = [f"{text.constant(f)}_{a.modern.upper()}" for f in abi.INTERFACES for a in f.args]
    shows = "".join(f'printf("%d\\n", {name});' for name in names)
    source = f"#include <stdio.h>\n#include <usersub/abi.h>\nint main(void) {{ {shows} return 0; }}"
    expected = [i for f in abi.INTERFACES for i in range(len(f.args))]
    assert [int(line) for line in ran(tmp_path, source).split()] == expected


def test_cdef_is_understood_by_cffi():
    import cffi

    from usersub.emit import cdef

    ffi = cffi.FFI()
    ffi.cdef(cdef.cdef_text())
    assert "usub_step" in cdef.tagged_region()
    assert ffi.sizeof("usub_error") == 4 + 1024
