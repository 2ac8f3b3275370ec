# SPDX-License-Identifier: MIT
"""Python routines: what the function gets, checked against flat memory written by hand."""

from __future__ import annotations

import ctypes
import dataclasses
import math
import os
import subprocess
import sys
import textwrap

import numpy as np
import pytest
from numba.extending import register_jitable

import usersub
from usersub import abi
from usersub.errors import AbiError, CompileError, RoutineError
from usersub.routine import python
from usersub.routine.routine import (
    BLOCK,
    FULL,
    POINTS,
    READS,
    READS_AND_WRITES,
    UNUSED,
    WRITES,
)
from usersub.statuses import STATUSES

RAISED = next(s.value for s in STATUSES if s.name == "ROUTINE_RAISED")

#: Every dimension its own value, so that swapped ones show.
SIZES = {
    "NFDIR": 2, "MCRD": 3, "NPRED": 5, "NSTATV": 90, "NPROPS": 7,
    "nBlock": 41, "nProps": 7, "nFields": 5, "iData(5)": 11,
    "nContact": 6, "nFacNod": 4, "nSlvNod": 8, "nMstNod": 9, "nFricDir": 2, "nDir": 3,
    "nStateVar": 13, "nPred": 5, "numDefTfv": 10,
    "nBlockAnal": 37, "nBlockEdge": 31, "nNodState": 4, "nNodSlv": 2, "nNodMst": 6, "nStates": 3,
}  # fmt: skip

CASES = [(f, p) for f in abi.INTERFACES for p in f.precisions]
IDS = [f"{f.key}-{p}" for f, p in CASES]

#: Large written array of each interface, into which the probing laws report.
REPORT = {
    "fric": "STATEV", "fric_coef": "fCoef", "vfric": "statev", "vfriction": "state",
    "vfric_coef": "fCoef",
}  # fmt: skip


class Call:
    """The memory of one call: every element of every argument with a value of its own."""

    def __init__(self, face: abi.Interface, precision: str, sizes: dict[str, int] | None = None):
        self.face, self.sizes = face, {**SIZES, **(sizes or {})}
        real = np.float32 if precision == "single" else np.float64
        self.memory: list[np.ndarray] = []
        for i, arg in enumerate(face.args):
            if arg.kind == "char":
                data = np.frombuffer(f"Name {i}".ljust(80).encode(), np.uint8).copy()
            else:
                count = math.prod(self.shape(arg))
                data = (np.arange(count) + i + (0.5 if arg.kind == "real" else 0)).astype(
                    np.int32 if arg.kind == "int" else real
                )
                if arg.name in self.sizes:
                    data[0] = self.sizes[arg.name]
                if arg.name == "iData":
                    data[4] = self.sizes["iData(5)"]
            self.memory.append(data)
        self.argv = (ctypes.c_void_p * len(face.args))(
            *[data.ctypes.data if data.size else None for data in self.memory]
        )

    def shape(self, arg: abi.Arg) -> tuple[int, ...]:
        def size(text: str) -> int:
            total = 0
            for term in text.split("+"):
                total += int(term) if term.isdigit() else self.sizes[term]
            return total

        return tuple(size(text) for text in arg.shape)

    def of(self, name: str) -> np.ndarray:
        return self.memory[self.face.position(name)]

    def run(self, entry) -> int:
        if entry.style == BLOCK:
            function = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p)(entry.address)
            return function(ctypes.addressof(self.argv))
        if entry.style == POINTS:
            types = [*[ctypes.c_void_p] * 3, ctypes.c_int32, ctypes.c_void_p]
            function = ctypes.CFUNCTYPE(ctypes.c_int, *types)(entry.address)
            stride, done = (ctypes.c_int64 * len(self.argv))(), ctypes.c_int32(-1)
            points = (ctypes.c_int32 * 1)()
            return function(self.argv, stride, points, 1, ctypes.addressof(done))
        texts = [a for a in self.face.args if a.kind == "char"]
        types = [ctypes.c_void_p] * len(self.argv) + [ctypes.c_size_t] * len(texts)
        function = ctypes.CFUNCTYPE(ctypes.c_int, *types)(entry.address)
        return function(*self.argv, *[80] * len(texts))


def make(source: str, decorator, **options):
    """The routine of the function in `source` (dedented), as a file of its own would make it."""
    namespace = dict(globals())
    exec(compile(textwrap.dedent(source), "<law>", "exec"), namespace)
    return decorator(namespace["law"], **options)


def decorator_of(face: abi.Interface):
    return getattr(python, face.name)


def spelled(arg: abi.Arg, generation: str) -> str:
    return {
        "modern": arg.modern, "older": arg.name, "lower": arg.name.lower(),
        "alias": arg.aliases[0] if arg.aliases else arg.modern.upper(),
    }[generation]  # fmt: skip


INDEX = "ijk"


@register_jitable
def probe1(a):
    total = np.float64(0.0)
    for i in range(a.shape[0]):
        total += a[i] * (1 + i)
    return total


@register_jitable
def probe2(a):
    total = np.float64(0.0)
    for i in range(a.shape[0]):
        for j in range(a.shape[1]):
            total += a[i, j] * (1 + i + 10 * j)
    return total


@register_jitable
def probe3(a):
    total = np.float64(0.0)
    for i in range(a.shape[0]):
        for j in range(a.shape[1]):
            for k in range(a.shape[2]):
                total += a[i, j, k] * (1 + i + 10 * j + 100 * k)
    return total


@register_jitable
def report1(a, r):
    a[: r.size] = r


@register_jitable
def report2(a, r):
    for n in range(r.size):
        a[n % a.shape[0], n // a.shape[0]] = r[n]


@register_jitable
def report3(a, r):
    for n in range(r.size):
        m = n // a.shape[0]
        a[n % a.shape[0], m % a.shape[1], m // a.shape[1]] = r[n]


def probing_source(face: abi.Interface, spelling: str) -> str:
    """A law that names every argument, backwards, and reports two numbers for each of them: a
    position-weighted sum of its elements, and its shape. It ends by writing them into an array,
    first index first."""
    names = [spelled(a, spelling) for a in face.args]
    lines = [f"def law({', '.join(reversed(names))}):", f"    r = np.zeros({2 * len(names)})"]
    for i, (arg, name) in enumerate(zip(face.args, names, strict=True)):
        if arg.kind == "char":
            lines += [f"    r[{2 * i}] = len({name}) * 10", f"    if {name} == 'Name {i}':",
                      f"        r[{2 * i}] += 1"]  # fmt: skip
        elif not arg.shape and arg.intent == "read":
            lines.append(f"    r[{2 * i}] = {name}")
        else:
            rank = max(len(arg.shape), 1)
            shape = " + ".join(f"{100**k} * {name}.shape[{k}]" for k in range(rank))
            lines.append(f"    r[{2 * i}] = probe{rank}({name})")
            lines.append(f"    r[{2 * i + 1}] = {shape}")
    out = face.position(REPORT[face.name])
    lines.append(f"    report{len(face.args[out].shape)}({names[out]}, r)")
    return "\n".join(lines)


def expected_report(call: Call) -> np.ndarray:
    """The same two numbers for each argument from flat memory: element (i, j, k) of an array of
    shape (n0, n1, n2) lies at i + n0 (j + n1 k)."""
    report = np.zeros(2 * len(call.memory))
    for a, (arg, data) in enumerate(zip(call.face.args, call.memory, strict=True)):
        if arg.kind == "char":
            report[2 * a] = len(f"Name {a}") * 10 + 1
        elif not arg.shape and arg.intent == "read":
            report[2 * a] = data[0]
        else:
            n = (*call.shape(arg), 1, 1, 1)[:3]
            total = 0.0
            for k in range(n[2]):
                for j in range(n[1]):
                    for i in range(n[0]):
                        total += float(data[i + n[0] * (j + n[1] * k)]) * (1 + i + 10 * j + 100 * k)
            report[2 * a] = total
            report[2 * a + 1] = sum(100**d * s for d, s in enumerate(call.shape(arg) or (1,)))
    return report


def check_views(face, precision, spelling, entry_of, **options):
    call = Call(face, precision, {"nBlock": 16} if face.name == "vfriction" else None)
    expected = expected_report(call)
    routine = make(
        probing_source(face, spelling), decorator_of(face), generation=face.generation, **options
    )
    assert routine.interface is face
    assert call.run(entry_of(routine)(precision)) == 0
    report = call.of(REPORT[face.name])[: expected.size]
    # Sums are made in double; products and the report are rounded to the precision.
    np.testing.assert_allclose(report, expected, rtol=1e-12 if precision == "double" else 1e-6)


@pytest.mark.parametrize(("face", "precision"), CASES, ids=IDS)
def test_compiled_views(face, precision):
    spelling = {"double": "older", "single": "alias"}[precision]
    check_views(face, precision, spelling, lambda r: r.entry)


@pytest.mark.parametrize("spelling", ["modern", "older", "lower", "alias"])
@pytest.mark.parametrize(("face", "precision"), CASES, ids=IDS)
def test_uncompiled_views(face, precision, spelling):
    check_views(face, precision, spelling, lambda r: r.entry, compiled=False)


@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize("face", [abi.interface("fric"), abi.interface("vfric_coef")],
                         ids=lambda f: f.key)  # fmt: skip
def test_full_argument_list(face, compiled):
    check_views(face, "double", "modern", lambda r: r.full_entry, compiled=compiled)


@pytest.mark.parametrize("compiled", [True, False])
def test_hidden_length_of_a_text_is_used(compiled):
    routine = make(
        """
        def law(CINAME, STATEV):
            STATEV[0] = len(CINAME)
        """, python.fric, compiled=compiled,
    )  # fmt: skip
    call = Call(abi.interface("fric"), "double")
    entry = routine.full_entry()
    types = [ctypes.c_void_p] * 39 + [ctypes.c_size_t] * 3
    ctypes.CFUNCTYPE(ctypes.c_int, *types)(entry.address)(*call.argv, 4, 80, 80)
    assert call.of("STATEV")[0] == 4  # "Name 21" cut after four letters
    # Callers in C may leave the lengths out; then any number is in their place.
    ctypes.CFUNCTYPE(ctypes.c_int, *types)(entry.address)(*call.argv, 2**60, 80, 80)
    assert call.of("STATEV")[0] == len("Name 21")


@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda f: f.key)
def test_writes_land_in_column_major_order(face, compiled):
    written = [a for a in face.args if a.intent != "read"]
    lines = [f"def law({', '.join(a.modern for a in written)}):"]
    for n, arg in enumerate(written):
        rank = max(len(arg.shape), 1)
        pad = "    "
        for k in range(rank):
            lines.append(f"{pad}for {INDEX[k]} in range({arg.modern}.shape[{k}]):")
            pad += "    "
        value = " + ".join(f"{100**k} * {INDEX[k]}" for k in range(rank))
        lines.append(f"{pad}{arg.modern}[{', '.join(INDEX[:rank])}] = {n} + {value}")
    routine = make(
        "\n".join(lines), decorator_of(face), generation=face.generation, compiled=compiled
    )
    call = Call(face, "double")
    before = [data.copy() for data in call.memory]
    assert call.run(routine.entry()) == 0
    for n, arg in enumerate(written):
        shape = call.shape(arg) or (1,)
        flat = [
            n + sum(100**d * (f // math.prod(shape[:d]) % s) for d, s in enumerate(shape))
            for f in range(math.prod(shape))
        ]
        np.testing.assert_array_equal(call.of(arg.name), flat)
    for arg, old, new in zip(face.args, before, call.memory, strict=True):
        if arg.intent == "read":
            np.testing.assert_array_equal(old, new)


def test_uses_come_from_names_and_intents():
    @python.fric
    def law(LM, DDTDDG, DGAM):
        LM[0] = 0

    face = abi.interface("fric")
    told = {a.modern: u for a, u in zip(face.args, law.uses, strict=True) if u != UNUSED}
    # NFDIR is not named, but the shapes need it.
    assert told == {"LM": READS_AND_WRITES, "DDTDDG": WRITES, "DGAM": READS, "NFDIR": READS}


def test_state_behind_rdata_needs_idata():
    @python.fric_coef
    def law(rData):
        rData[7] = 1.0

    face = abi.interface("fric_coef", "2022")
    assert law.interface is face
    assert law.uses[face.position("iData")] == READS


@pytest.mark.parametrize(
    ("parameters", "generation"),
    [("fCoef, slipData", "2022"), ("fCoef, iData", "2022"), ("fCoef, slipRate", "legacy"),
     ("fCoef, JFLAGS", "legacy"), ("fCoef, props", "2022")],
)  # fmt: skip
def test_generation_is_told_by_the_names(parameters, generation):
    routine = make(f"def law({parameters}): pass", python.fric_coef)
    assert routine.interface.generation == generation
    assert (
        make("def law(fCoef): pass", python.fric_coef, generation="legacy").interface.generation
        == "legacy"
    )


@pytest.mark.parametrize(
    ("decorator", "source", "words"),
    [
        ("vfric", "def law(fTangental): pass", "'fTangental'; did you mean 'fTangential'"),
        ("fric", "def law(TAU, PRES): pass", "did you mean 'PRESS'"),
        ("vfric", "def law(coordSlv, coordSec): pass", "'coordSlv' and 'coordSec' are both"),
        ("vfric", "def law(props, PROPS): pass", "'props' and 'PROPS' are both argument"),
        ("vfric", "def law(fTangential, *rest): pass", "'*rest' stands for no argument"),
        ("vfric", "def law(fTangential, **rest): pass", "'**rest' stands for no argument"),
        ("vfric", "def law(*, fTangential): pass", "'fTangential' is keyword-only"),
        ("vfric", "def law(fTangential, props=None): pass", "'props' has a default value"),
        ("fric_coef", "def law(slipData, slipRate): pass", "mixes arguments of the generations"),
        ("vfric_coef", "def law(slipData): pass", "no argument 'slipData'"),
        ("fric", "def law(LM): yield LM", "generator or coroutine"),
        ("fric", "law = print", "decorates a function, not"),
        ("fric", "def law(LM, TAU):\n    LM = 0", "write LM[0] = ..."),
        ("vfric", "def law(fTangential):\n    fTangential = 1.0", "write fTangential[:] = ..."),
    ],
)  # fmt: skip
def test_refused_signatures(decorator, source, words):
    with pytest.raises(AbiError) as caught:
        make(source, getattr(python, decorator))
    assert words in str(caught.value)
    if "law = print" not in source:
        assert str(caught.value).startswith("<law>:1: routine 'law'")


def test_names_of_the_other_generation_say_so():
    with pytest.raises(AbiError, match="'slipData' belongs to the generation \"2022\""):
        make("def law(fCoef, slipData): pass", python.fric_coef, generation="legacy")


@pytest.mark.parametrize("compiled", [True, False])
def test_in_place_operators_are_allowed(compiled):
    @python.fric(compiled=compiled)
    def law(PNEWDT, TAU):
        PNEWDT *= 0.5
        TAU += 1.0

    call = Call(law.interface, "double")
    pnewdt, tau = call.of("PNEWDT")[0], call.of("TAU").copy()
    assert call.run(law.entry()) == 0
    assert call.of("PNEWDT")[0] == 0.5 * pnewdt
    np.testing.assert_array_equal(call.of("TAU"), tau + 1.0)


@pytest.mark.parametrize("compiled", [True, False])
def test_no_elements_and_no_memory(compiled):
    @python.vfric(compiled=compiled)
    def law(fTangential, statev, props, preDefSec, shape):
        for k in range(fTangential.shape[1]):
            fTangential[0, k] = 100 * statev.size + 10 * props.size + preDefSec.size + shape.size

    sizes = {"nStateVar": 0, "nProps": 0, "nPred": 0, "nFacNod": 0}
    call = Call(law.interface, "double", sizes)
    assert call.argv[law.interface.position("props")] is None
    assert call.run(law.entry()) == 0
    assert call.of("fTangential")[0] == 0
    empty = Call(law.interface, "double", {**sizes, "nContact": 0})
    assert empty.run(law.entry()) == 0


@pytest.mark.parametrize("compiled", [True, False])
def test_names_are_texts_without_trailing_blanks(compiled):
    @python.vfric_coef(compiled=compiled)
    def law(fCoef, surfInt, surfSec, surfMain):
        if surfInt == "  Pad-Disk µ":
            fCoef[0] = 1
        fCoef[1] = len(surfSec)
        fCoef[2] = len(surfMain)
        fCoef[3] = surfMain.startswith("X")

    call = Call(law.interface, "double")
    for name, text in (("surfInt", "  Pad-Disk µ"), ("surfSec", ""), ("surfMain", "X" * 80)):
        call.of(name)[:] = np.frombuffer(text.ljust(80).encode("latin-1"), np.uint8)
    assert call.run(law.entry()) == 0
    np.testing.assert_array_equal(call.of("fCoef")[:4], [1, 0, 80, 1])


def failing(fCoef, slipRate):
    fCoef[0] = 1.0
    if slipRate[0] > 0.0:
        raise ValueError("slip rate is out of range")
    fCoef[1] = 2.0


FAILING_LINE = failing.__code__.co_firstlineno + 3


def test_exception_becomes_a_status_and_the_replay_tells_it():
    routine = python.vfric_coef(failing)
    call = Call(routine.interface, "double")
    assert call.run(routine.entry()) == RAISED
    assert not hasattr(routine.entry().keep, "exception")
    twin = routine.replay("double")
    assert call.run(twin) == RAISED
    assert isinstance(twin.keep.exception, ValueError)
    assert str(twin.keep.exception) == "slip rate is out of range"
    assert twin.keep.where == f"{__file__}:{FAILING_LINE}"
    twin.keep.exception = None
    call.of("slipRate")[:] = -1.0
    assert call.run(routine.entry()) == 0
    assert call.run(twin) == 0
    assert twin.keep.exception is None and twin.keep.where == ""
    assert call.of("fCoef")[1] == 2.0


def test_uncompiled_frames_are_the_users():
    routine = python.vfric_coef(failing, compiled=False)
    assert routine.replay is None and not routine.thread_safe
    entry = routine.entry()
    assert Call(routine.interface, "double").run(entry) == RAISED
    trace = entry.keep.exception.__traceback__
    while trace.tb_next:
        trace = trace.tb_next
    assert trace.tb_lineno == FAILING_LINE
    assert trace.tb_frame.f_code is failing.__code__
    assert trace.tb_frame.f_locals["fCoef"].flags.f_contiguous


def test_uncompiled_keyboard_interrupt_is_kept():
    @python.vfric_coef(compiled=False)
    def law(fCoef):
        raise KeyboardInterrupt

    assert Call(law.interface, "double").run(law.entry()) == RAISED
    assert isinstance(law.entry().keep.exception, KeyboardInterrupt)


def test_debug_variable_runs_uncompiled(monkeypatch):
    monkeypatch.setenv("USERSUB_DEBUG", "1")
    routine = python.vfric_coef(failing)
    assert Call(routine.interface, "double").run(routine.entry()) == RAISED
    assert isinstance(routine.entry().keep.exception, ValueError)


@pytest.mark.parametrize("compiled", [True, False])
def test_division_by_zero_is_as_in_numpy(compiled):
    @python.vfric_coef(compiled=compiled)
    def law(fCoef, slipRate, rData):
        fCoef[0] = 1.0 / slipRate[0]
        fCoef[1] = rData[0] / (rData[0] - rData[0])

    call = Call(law.interface, "double")
    call.of("slipRate")[0] = 0.0
    with np.errstate(divide="ignore"):
        assert call.run(law.entry()) == 0
    assert np.all(call.of("fCoef")[:2] == np.inf)


class Opaque:
    value = 1.0


OPAQUE = Opaque()


def uses_an_object(fCoef):
    fCoef[0] = 0.0
    fCoef[1] = OPAQUE.value


def writes_its_input(fCoef, slipRate):
    fCoef[0] = 0.0
    slipRate[0] = 1.0


def returns_the_coefficient(fCoef, slipRate):
    return slipRate[0]


def helper(x):
    return 2 * x


def calls_a_plain_function(fCoef, slipRate):
    fCoef[0] = helper(slipRate[0])


@pytest.mark.parametrize(
    ("law", "line", "words"),
    [
        (uses_an_object, 2, "Untyped global name 'OPAQUE'"),
        (writes_its_input, 2, "writes to an array that the interface only lets it read"),
        (returns_the_coefficient, 0, "it returns a value (float64); results go into the elements"),
        (calls_a_plain_function, 1, "functions that it calls need @numba.njit"),
    ],
)
def test_compile_errors_name_line_and_reason(law, line, words):
    with pytest.raises(CompileError) as caught:
        python.vfric_coef(law).entry()
    message = str(caught.value)
    assert words in message
    assert message.startswith(f"{__file__}:{law.__code__.co_firstlineno + line}: ")
    assert "compiled=False" in message
    assert len(message) < 900


@pytest.mark.parametrize(
    ("law", "kind"), [(writes_its_input, ValueError), (returns_the_coefficient, TypeError)]
)
def test_uncompiled_mode_keeps_the_same_rules(law, kind):
    entry = python.vfric_coef(law, compiled=False).entry()
    assert Call(abi.interface("vfric_coef"), "double").run(entry) == RAISED
    assert isinstance(entry.keep.exception, kind)


def test_precisions():
    routine = python.vfric_coef(failing, precision="single")
    with pytest.raises(AbiError, match="exists in single precision, not in 'double'"):
        routine.entry("double")
    with pytest.raises(AbiError, match="FRIC exists in double precision, not in 'single'"):
        python.fric(lambda LM: None, precision="single")
    with pytest.raises(AbiError, match="exists in double and single precision, not in 'half'"):
        python.vfric_coef(failing).entry("half")


def test_a_routine_is_still_the_function():
    routine = python.vfric_coef(failing)
    f, s = np.zeros(2), -np.ones(2)
    routine(f, s)
    np.testing.assert_array_equal(f, [1.0, 2.0])
    assert routine.name == "failing" and routine.language == "python"
    assert routine.origin == f"{__file__}:{failing.__code__.co_firstlineno}"
    assert "VFRIC_COEF" in repr(routine) and "meaning" not in repr(routine)


def test_numba_dispatchers_are_accepted():
    import numba

    @numba.njit
    def law(fCoef, slipRate):
        fCoef[0] = 1.0 / slipRate[0]

    routine = python.vfric_coef(law)
    assert routine.function is law.py_func
    call = Call(routine.interface, "double")
    call.of("slipRate")[0] = 0.0
    assert call.run(routine.entry()) == 0
    assert call.of("fCoef")[0] == np.inf


def test_entries_are_made_once_and_kept_alive():
    routine = python.vfric_coef(failing)
    assert routine.entry() is routine.entry()
    assert routine.entry().style == BLOCK and routine.full_entry().style == FULL
    assert routine.entry("single") is not routine.entry("double")


def in_fresh_process(code: str, **environment: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)],
        capture_output=True, text=True, check=False, env={**os.environ, **environment},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_nothing_is_imported_before_it_is_needed():
    out = in_fresh_process("""
        import sys
        from usersub.routine import pointers, pyfile, python
        @python.vfric_coef(compiled=False)
        def law(fCoef): pass
        first = [m for m in ("numba", "numpy", "cffi", "scipy") if m in sys.modules]
        law.entry()
        print(first, "numba" in sys.modules)
    """)
    assert out.split() == ["[]", "False"]


# Closures of one name with a helper that is too long to be inlined, and numba's counter of
# functions set back as a fresh process has it: only the cache keeps them apart.
CLOSURES = """
import ctypes, itertools, math, sys
import numpy as np
from numba.core.bytecode import FunctionIdentity
from numba.extending import register_jitable
from usersub.routine import python

def make(c):
    @register_jitable
    def helper(x, n):
        s = 0.0
        for i in range(n):
            s += math.sin(x * i) * c + math.exp(-i * x * c) + math.tanh(s)
        for i in range(n):
            s += math.sin(x * i) * c + math.exp(-i * x * c) + math.tanh(s)
        return c
    @python.vfric_coef
    def law(fCoef, slipRate):
        for k in range(fCoef.shape[0]):
            fCoef[k] = helper(slipRate[k], 2)
        for k in range(fCoef.shape[0]):
            fCoef[k] = helper(slipRate[k], 2)
    return law

for c in map(float, sys.argv[1:] or "{}".split()):
    FunctionIdentity._unique_ids = itertools.count(1000)
    entry = make(c).entry()
    f, s, n = np.zeros(2), np.ones(2), np.array([2], np.int32)
    argv = (ctypes.c_void_p * 16)()
    argv[0], argv[2], argv[12] = f.ctypes.data, n.ctypes.data, s.ctypes.data
    assert ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p)(entry.address)(argv) == 0
    print(f[0] - c, entry.keep.cache_hits)
"""


def test_cache_between_processes_keeps_closures_apart(tmp_path):
    place = {"USERSUB_CACHE": str(tmp_path / "cache")}
    assert in_fresh_process(CLOSURES.replace("{}", "1"), **place).split() == ["0.0", "0"]
    assert in_fresh_process(CLOSURES.replace("{}", "2"), **place).split() == ["0.0", "0"]
    out = in_fresh_process(CLOSURES.replace("{}", "2 3 1"), **place).split()
    assert out == ["0.0", "1", "0.0", "0", "0.0", "1"]


def test_damaged_cache_is_no_failure(tmp_path, monkeypatch):
    monkeypatch.setenv("USERSUB_CACHE", str(tmp_path))
    python.vfric_coef(failing).entry()
    kept = list((tmp_path / "numba" / "__pycache__").glob("*.nbc"))
    assert kept
    for file in kept:
        file.write_bytes(b"nothing that numba wrote")
    routine = python.vfric_coef(failing)
    assert Call(routine.interface, "double").run(routine.entry()) == RAISED


def test_without_a_cache_folder(tmp_path, monkeypatch):
    blocked = tmp_path / "file"
    blocked.write_text("")
    monkeypatch.setenv("USERSUB_CACHE", str(blocked / "below"))
    routine = python.vfric_coef(failing)
    assert Call(routine.interface, "double").run(routine.entry()) == RAISED


def test_a_routine_can_be_copied_with_changes():
    routine = dataclasses.replace(python.vfric_coef(failing), name="other", block_safe=True)
    assert isinstance(routine, python.PythonRoutine)
    assert routine.name == "other" and routine.block_safe and routine.function is failing
    assert Call(routine.interface, "double").run(routine.entry()) == RAISED


def test_unknown_generation():
    with pytest.raises(AbiError, match="VFRIC has no generation '2022'; it has legacy"):
        make("def law(fTangential): pass", python.vfric, generation="2022")


@pytest.mark.parametrize("interface", abi.NAMES)
def test_a_routine_without_outputs_is_refused(interface):
    face = abi.interface(interface)
    reads = next(a.modern for a in face.args if a.intent == "read")
    writes = next(a.modern for a in face.args if a.intent != "read")
    with pytest.raises(AbiError, match=f"names nothing that it can write.*{writes}"):
        make(f"def law({reads}): pass", getattr(python, interface))


@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("fCoef[0] = props[1]", "IndexError: index 1 is out of bounds"),
        ("fCoef[4] = 0.5", "IndexError: index 4 is out of bounds"),
        ("fCoef[0] = nBlock // (nBlock - nBlock)", "ZeroDivisionError"),
        ("fCoef[0] = nBlock % (nBlock - nBlock)", "ZeroDivisionError"),
        ("q, fCoef[0] = divmod(nBlock, nBlock - nBlock)", "ZeroDivisionError"),
        ("fCoef[0] = 1.0 / (props[0] - props[0])", "inf"),
    ],
)
def test_wrong_index_or_division_is_told(tmp_path, body, words, compiled):
    """Compiled as uncompiled: nothing beyond an array is read or written, nothing becomes zero."""
    file = tmp_path / "law.py"
    file.write_text(
        f"import usersub\n\n\n@usersub.vfric_coef(compiled={compiled})\n"
        f"def law(fCoef, nBlock, props):\n    fCoef[:] = 0.25\n    {body}\n"
    )
    routine = usersub.load(file)["vfric_coef"]
    driver = usersub.CoefficientDriver(routine, usersub.Scene(points=4, props=[0.5]))
    before = driver.state.save()
    with (
        np.errstate(divide="ignore"),
        pytest.raises(RoutineError, match=rf"(?s){words}.*'law'.*law\.py"),
    ):
        driver.evaluate(slip_rate=np.ones(4))
    assert driver.state.save() == before
