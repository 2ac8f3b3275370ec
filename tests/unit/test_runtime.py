# SPDX-License-Identifier: MIT
"""The runtime of the C core: leaving routines that do not return, threads, utility routines.

What ends or breaks a process is tried in a process of its own, a small program that loads the
routines as a host would.
"""

from __future__ import annotations

import os
import platform
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

_ROOT = Path(__file__).resolve().parents[2]
_NATIVE = _ROOT / "tests/unit/native"
_INCLUDE = _ROOT / "csrc/include"
_WRAPPED = (_INCLUDE / "usersub/wrap.txt").read_text(encoding="ascii").split()
_RUNTIME = sorted(str(path) for path in (_ROOT / "csrc/runtime").glob("*.c"))
_FLAGS = ["-std=gnu11", "-D_GNU_SOURCE", "-g", "-O1", "-fPIC", "-pthread", "-ffp-contract=off"]
_FLAGS += ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
_FLAGS += [f"-I{_INCLUDE}", f"-I{_ROOT / 'csrc/runtime'}"]

STOPPED, CRASHED = -10, -11  # USUB_ROUTINE_STOPPED, USUB_ROUTINE_CRASHED

# Routine of runtime_user.c: status, reason.
C_STOPS = {
    "call_xit": "XIT",
    "call_xplb_exit": "XPLB_EXIT",
    "call_exit": r"exit\(7\)",
    "call_underscore_exit": r"_exit\(8\)",
    "call_quick_exit": r"quick_exit\(9\)",
    "call_abort": "abort",
    "call_assert": r"assertion failed: zero == 1, .*runtime_user\.c:\d+ in call_assert",
    "call_fatal": r"STDB_ABQERR: point 17 has p = 0\.25 on UPPER",
    "stop_with_mutex": r"exit\(1\)",
    "lock_twice": r"MutexLock\(4\): this thread has already locked it",
    "lock_wrong_number": r"MutexLock\(101\): mutexes are numbered 1 to 100",
}
C_FAULTS = {
    "divide": "integer division by zero",
    "read_zero": "memory fault at address 0x0",
    "write_constant": "memory fault at address 0x[0-9a-f]{4,}",
    "trap": "a fault that the compiler saw coming, .*|illegal instruction",
    "overflow_stack": "stack overflow",
    "huge_frame": "stack overflow",
}
FORTRAN_STOPS = {
    "call_xit": "XIT",
    "call_xplb_exit": "XPLB_EXIT",
    "stop_plain": "STOP",
    "stop_number": "STOP 3",
    "stop_text": "STOP no such material",
    "error_stop_number": "ERROR STOP 4",
    "error_stop_text": "ERROR STOP worse",
    "call_exit": r"exit\(5\)",
    "call_abort": "abort",
    "bounds": "Fortran runtime error: At line .* of array 'a' above upper bound of 3",
    "allocate_twice": "Fortran runtime error: At line .*already allocated.*",
}


def _run(*command: object) -> str:
    """Output of a command that has to succeed."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


@pytest.fixture(scope="session")
def compiler() -> str:
    found = shutil.which("gcc") or shutil.which("cc") or shutil.which("clang")
    if found is None:
        pytest.skip("a C compiler is missing; install one, for example with `apt-get install gcc`")
    return found


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("runtime")


@pytest.fixture(scope="session")
def runtime(compiler: str, folder: Path) -> Path:
    """The runtime alone as a shared library, its internal functions visible."""
    library = folder / "libruntime.so"
    _run(compiler, *_FLAGS, "-shared", *_RUNTIME, "-o", library, "-lm", "-ldl")
    return library


@pytest.fixture(scope="session")
def call(compiler: str, folder: Path, runtime: Path) -> Callable[..., list[str]]:
    """Runs a routine of a library under a guard (runtime_main.c); the lines that it printed."""
    program = folder / "main"
    source = _NATIVE / "runtime_main.c"
    _run(compiler, *_FLAGS, source, "-o", program, runtime, f"-Wl,-rpath,{folder}", "-ldl")
    return lambda library, symbol, *how: _run(program, library, symbol, *how).splitlines()


def _link(runtime: Path, how: str) -> list[str]:
    """Options for user code that is built with us, or in one of the ways of others."""
    return {
        "wrapped": [f"-Wl,--wrap={name}" for name in _WRAPPED]
        + ["-Wl,-Bsymbolic", str(runtime), f"-Wl,-rpath,{runtime.parent}"],
        "plain": ["-Wl,-z,lazy"],
        "closed": ["-Wl,-z,now", "-Wl,-z,relro"],
        "without_plt": ["-fno-plt"],
    }[how]


@pytest.fixture(scope="session")
def c_user(compiler: str, folder: Path, runtime: Path) -> Callable[[str], Path]:
    def build(how: str) -> Path:
        library = folder / f"c_{how}.so"
        if not library.exists():
            source = _NATIVE / "runtime_user.c"
            options = _link(runtime, how)
            _run(compiler, "-O1", "-fPIC", "-shared", "-w", source, "-o", library, *options)
        return library

    return build


@pytest.fixture(scope="session")
def fortran_user(fortran: str, folder: Path, runtime: Path) -> Callable[[str], Path]:
    def build(how: str) -> Path:
        library = folder / f"fortran_{how}.so"
        if not library.exists():
            options = ["-O1", "-fPIC", "-shared", "-w", "-std=legacy", "-fcheck=bounds"]
            options += [f"-J{folder}", "-fallow-argument-mismatch", _NATIVE / "runtime_user.f90"]
            _run(fortran, *options, "-o", library, *_link(runtime, how))
        return library

    return build


def _left(lines: list[str], status: int, reason: str) -> None:
    """The routine was left twice, alike, and the process went on."""
    lines = [line for line in lines if not line.startswith(("message", "redirected"))]
    # Guards are gone once left, so that nobody can leave to them again.
    assert re.fullmatch(rf"first {status} \[(?:{reason})\] armed 0", lines[0]), lines
    assert lines[1] == lines[0].replace("first", "second")
    assert lines[2:] == ["first 0 [] armed 1", "second 0 [] armed 1", "alive"]


def test_wrap_list_is_complete(runtime: Path):
    """Every listed name has its function, every function is listed."""
    import ctypes

    library = ctypes.CDLL(str(runtime))
    assert all(hasattr(library, f"__wrap_{name}") for name in _WRAPPED)
    files = ("stop.c", "units.c")
    source = "".join((_ROOT / "csrc/runtime" / f).read_text(encoding="utf-8") for f in files)
    assert set(re.findall(r"USUB_UTILITY .*\b__wrap_(\w+)\(", source)) == set(_WRAPPED)


@pytest.mark.parametrize("symbol", C_STOPS)
def test_c_stop(call, c_user, symbol):
    _left(call(c_user("wrapped"), symbol), STOPPED, C_STOPS[symbol])


_DIVIDES = pytest.param(
    "divide",
    marks=pytest.mark.skipif(
        platform.machine() not in ("x86_64", "AMD64", "i686"),
        reason="integer division by zero is no fault on this processor",
    ),
)


@pytest.mark.parametrize("symbol", [_DIVIDES, *(s for s in C_FAULTS if s != "divide")])
@pytest.mark.parametrize("where", ["main", "thread"])
def test_c_fault(call, c_user, symbol, where):
    _left(call(c_user("wrapped"), symbol, "faults", where), CRASHED, C_FAULTS[symbol])


@pytest.mark.parametrize("symbol", FORTRAN_STOPS)
def test_fortran_stop(call, fortran_user, symbol):
    _left(call(fortran_user("wrapped"), symbol), STOPPED, FORTRAN_STOPS[symbol])


@pytest.mark.parametrize("how", ["plain", "closed", "without_plt"])
@pytest.mark.parametrize("symbol", ["call_xit", "call_exit", "call_abort", "call_fatal"])
def test_library_built_by_others(call, c_user, how, symbol):
    """Not linked with us: the addresses of its calls are changed after loading."""
    lines = call(c_user(how), symbol, "redirect")
    assert lines[0] == "redirected 1"
    _left(lines, STOPPED, C_STOPS[symbol])


@pytest.mark.parametrize("how", ["plain", "closed", "without_plt"])
@pytest.mark.parametrize("symbol", ["stop_text", "error_stop_number", "bounds", "call_exit"])
def test_fortran_library_built_by_others(call, fortran_user, how, symbol):
    _left(call(fortran_user(how), symbol, "redirect"), STOPPED, FORTRAN_STOPS[symbol])


@pytest.mark.parametrize(
    ("symbol", "status", "reason"),
    [
        ("let_it_out", CRASHED, "abort"),  # by the C++ library itself
        ("call_terminate", STOPPED, "std::terminate"),
        ("catch_it", 0, ""),
    ],
)
def test_cpp(call, folder, runtime, symbol, status, reason):
    compiler = shutil.which("c++")
    if compiler is None:
        pytest.skip("a C++ compiler is missing; install one, for example `apt-get install g++`")
    library = folder / "cpp.so"
    if not library.exists():
        options = ["-O1", "-fPIC", "-shared", _NATIVE / "runtime_user.cpp", "-o", library]
        _run(compiler, *options, *_link(runtime, "wrapped"))
    lines = call(library, symbol, "faults")
    if status:
        _left(lines, status, reason)
    else:
        assert lines[0] == "first 0 [] armed 1"


def test_abort_of_a_dependency(call, c_user):
    """Without redirection abort is the signal of the C library, which the fault handlers catch."""
    _left(call(c_user("plain"), "call_abort", "faults"), CRASHED, "abort")


@pytest.mark.parametrize(
    ("symbol", "code", "words"),
    [("call_exit", 7, ""), ("call_xit", 1, "XIT"), ("call_fatal", 1, "STDB_ABQERR: point 17")],
)
def test_no_guard(folder, c_user, call, symbol, code, words):
    """User code that no driver called ends the program, as it asked."""
    command = [folder / "main", c_user("wrapped"), symbol, "bare"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == code
    assert words in done.stdout


@pytest.mark.parametrize("symbol", [_DIVIDES, "read_zero", "trap"])
def test_fault_without_guard(folder, c_user, call, symbol):
    """A fault outside of a guard still ends the process by its signal."""
    command = [folder / "main", c_user("wrapped"), symbol, "bare", "faults"]
    done = subprocess.run(command, capture_output=True, timeout=60)
    assert done.returncode in (-4, -8, -11)  # SIGILL, SIGFPE, SIGSEGV


def _messages(lines: list[str]) -> list[str]:
    return [line.removeprefix("message ") for line in lines if line.startswith("message")]


def test_standard_messages(call, fortran_user):
    """%I, %R, %S take their values one after the other; trailing blanks go; levels are kept."""
    lines = _messages(call(fortran_user("wrapped"), "standard_message"))
    assert (
        lines[:3]
        == lines[3:]
        == [
            "1 [a BRAKE b 12 c 0.15 d -2500000 e PAD12345 f -7 g 100% h]",
            "-1 [short abc]",
            "-2 [nothing to fill in]",
        ]
    )


@pytest.mark.parametrize("precision", ["single", "double"])
def test_explicit_messages(call, fortran_user, precision):
    """Reals are in the precision of the routine, which the guard knows."""
    symbol = f"explicit_message_{precision}"
    lines = _messages(call(fortran_user("wrapped"), symbol, precision))
    assert lines[0] == "-2 [r 0.1 0.75 i 3]"


def test_pause_is_a_message(call, fortran_user):
    assert _messages(call(fortran_user("wrapped"), "pause_once"))[0] == "1 [PAUSE look here]"


def test_part_job_and_machine(call, fortran_user):
    assert _messages(call(fortran_user("wrapped"), "ask"))[:8] == [
        "1 [standard [] 42 0]",
        "1 [explicit [] 43 0]",
        "1 [refused 1]",
        "1 [job usersub 7 . 1]",
        "1 [job usersub 7 . 1]",
        "1 [rank 0 of 1]",
        "1 [rank 0 of 1]",
        "1 [thread 0 of 1]",
    ]


def test_arrays_from_fortran(call, fortran, folder, runtime):
    """Created, filled, lengthened, looked up, deleted; the two scopes and three kinds apart."""
    library = folder / "arrays.so"
    options = ["-O1", "-fPIC", "-shared", "-w", "-cpp", "-fcray-pointer", "-std=legacy"]
    options += ["-ffree-form", f"-I{_INCLUDE / 'usersub/field'}", _NATIVE / "runtime_arrays.F90"]
    _run(fortran, *options, "-o", library, *_link(runtime, "wrapped"))
    assert _messages(call(library, "arrays"))[:3] == [
        "-1 [MutexUnlock(100): this thread has not locked it]",
        "-1 [MutexLock(99): MutexInit(99) was not called before]",
        "1 [done]",
    ]


def _stress(compiler: str, folder: Path, name: str, *options: str) -> Path:
    program = folder / name
    source = _NATIVE / "runtime_stress.c"
    _run(compiler, *_FLAGS, *options, source, *_RUNTIME, "-o", program, "-lm", "-ldl")
    return program


def test_threads(compiler, folder):
    """Pool, guards, mutexes, arrays from many threads; a child process makes threads anew."""
    assert "all is well" in _run(_stress(compiler, folder, "stress"), "fork")


@pytest.mark.parametrize("sanitizer", ["address,undefined", "thread"])
def test_threads_sanitized(compiler, folder, sanitizer):
    options = [f"-fsanitize={sanitizer}", "-fno-sanitize-recover=all"]
    program = _stress(compiler, folder, f"stress_{sanitizer[0]}", *options)
    done = subprocess.run([program], capture_output=True, text=True, timeout=300)
    if "unexpected memory mapping" in done.stderr and shutil.which("setarch"):
        # Kernels that spread addresses more than this sanitizer knows.
        done = subprocess.run(["setarch", "-R", program], capture_output=True, text=True)
    if "LeakSanitizer has encountered a fatal error" in done.stderr:
        # No process may be traced here, as in some containers: without the search for leaks.
        environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0"}
        done = subprocess.run([program], capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "all is well" in done.stdout
