# SPDX-License-Identifier: MIT
"""Hosts that break one rule on demand: each is caught by that rule, and by no other."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from usersub import paths
from usersub.check import hosts
from usersub.check.hosts.judges import all_rules
from usersub.check.hosts.running import Options

_HERE = Path(__file__).parent / "hosts"
_ROOT = Path(__file__).resolve().parents[2]

#: Fault of implicit.c -> rule, words of the sentence.
FRIC = {
    "never-calls": ("host.call", "did not call FRIC; it called no routine at all"),
    "crash": ("host.ends", "was ended by SIGSEGV after"),
    "exit": ("host.status", "ended with exit status 3"),
    "hang": ("host.ends", "none in the last"),
    "directions-zero": ("host.counts", "NFDIR = 0; expected 1 or 2"),
    "props-change": ("host.props", "PROPS in call"),
    "coords-null": ("host.arrays", "COORDS is a null pointer"),
    "coords-nowhere": ("host.arrays", "RCOORD is the address 0x10, where nothing can be read"),
    "tau-short": ("host.arrays", "TAU can be read for 8 bytes; expected (NFDIR) = (2), 16 bytes"),
    "energy-read-only": ("host.arrays", "SFD cannot be written to"),
    "unaligned": ("host.arrays", "which is not a multiple of 8"),
    "shared": ("host.apart", "DDTDDG and DDTDDT share memory"),
    "nan-temperature": ("host.finite", "TEMP(2) = nan"),
    "name-nul": ("host.names", "CINAME = 'RUBBER ON STEEL' holds a NUL at character 16"),
    "name-lower": ("host.names", "expected 'RUBBER ON STEEL'"),
    "name-shifted": ("host.names", "begins with a blank"),
    "lengths": ("host.hidden-lengths", "the hidden length of CINAME is 8"),
    "node-zero": ("host.nodes", "NOEL = 0 and NODE = 0"),
    "increment-iterates": ("host.increments", "KINC = 2 after 1, although it starts at 0"),
    "increment-stays": ("host.increments", "KINC = 2 again, although TIME(2) went on"),
    "step-exchanged": ("host.increments", "the two numbers look exchanged"),
    "cut-counted": ("host.increments", "expected 2 again, since no time has gone by"),
    "time-start": ("host.times", "TIME(1) = 0 in the first increment of the step"),
    "time-exchanged": ("host.times", "TIME(2) = 0.11 is less than TIME(1)"),
    "lm-lost": ("host.multiplier", "LM = 2 on entry, but the routine had returned 0"),
    "lm-start": ("host.multiplier", "at the end of the increment before; expected 0"),
    "lm-open": ("host.multiplier", "expected 2 (open)"),
    "lm-range": ("host.multiplier", "LM = 3 on entry; expected 0, 1 or 2"),
    "dslip-lost": ("host.multiplier", "DSLIP = (0, 0) on entry, but the routine had returned"),
    "dslip-kept": ("host.multiplier", "on entry of the first iteration; expected zero"),
    "dslip-after-lm": ("host.multiplier", "although the routine returned LM = 2"),
    "taulm-always": ("host.multiplier", "only a point that sticks (LM = 1) has constraint"),
    "moves": ("host.sticking", "although the routine returned LM = 1 in all of them"),
    "tau-updated": ("host.outputs-used", "which is what the iteration before returned"),
    "tau-lost": ("host.outputs-used", "TAU = (0, 0) on entry, but the increment before ended with"),
    "sed-lost": ("host.outputs-used", "SED = 0 on entry"),
    "slip-lost": ("host.outputs-used", "with DSLIP added"),
    "dpress-total": ("host.pressure", "DPRESS = 101.15 with PRESS = 101.15"),
    "pnewdt-preset": ("host.presets", "PNEWDT = 0.5 on entry"),
    "pnewdt-ignored": ("host.cut-back", "the host went on to increment 3"),
    "cut-too-little": ("host.cut-back", "expected at most 0.06"),
    "state-updated": ("host.state", "which was returned in call 1 (step 1, increment 1, node 101)"),
    "state-lost": ("host.state", "STATEV(1) = 0 on entry"),
    "state-mixed": ("host.state", "node 102); expected"),
    "state-after-cut": ("host.state", "scenario cut-back"),
    "rotation-zero": ("host.axes", "DROT = (0, 0, 0, 0) (by columns) is not a rotation"),
}  # fmt: skip

#: Fault of explicit.c -> rule, words; for VFRIC and VFRICTION unless the words are by interface.
FORCE = {
    "output-kept": ("host.zeroed-outputs", "fTangential(1,1) = -0.4 on entry; expected 0"),
    "normal-negative": ("host.normal-force", "fNormal(1) = -2"),
    "axes-length": ("host.axes", "has length 1.48388"),
    "axes-skew": ("host.axes", "have the scalar product 0.6"),
    "axes-exchanged": ("host.axes", "the two arrays look exchanged"),
    "layout": ("host.axes", "has length 1.71509"),
    "t1-reversed": ("host.slip-direction", "points against that"),
    "t1-stale": ("host.slip-direction", "points not along that"),
    "slip-negative": ("host.slip-direction", "dSlipFric(1,1) = -0.005"),
    "slip-vector": ("host.slip-direction", "dSlipFric(2,1) = 0.001"),
    "previous-local": ("host.previous-force", "in the axes of that increment"),
    "previous-global": ("host.previous-force", "in global components"),
    "previous-sign": ("host.previous-force", "with the other sign"),
    "previous-open": ("host.previous-force", "was not in contact in the increment before"),
    "stick-negative": ("host.stick-force", "expected 0 or more"),
    "stick-zero": ("host.stick-force", "fStickForce is zero in all calls"),
    "stick-stale": ("host.stick-force", "goes with the slip of the increment before"),
    "state-lost": ("host.state", "0 on entry"),
    "state-mixed": ("host.state", "which was returned"),
    "shapes-transposed": ("host.shapes", "of contact point 1 sums to 1.4"),
    "nodes-from-zero": ("host.nodes", "holds 0"),
    "flags-exchanged": ("host.increments", "the two numbers look exchanged"),
    "time-start": ("host.times", "in the first increment of the step"),
    "dt-before": ("host.times", "expected the same number"),
    "dt-zero": ("host.times", "= 0 starts at"),
    "lengths": ("host.hidden-lengths", "the hidden length of surfInt is 0"),
    "name-nul": ("host.names", "holds a NUL"),
    "crash": ("host.ends", "SIGSEGV"),
}  # fmt: skip
ONE_INTERFACE = {
    ("vfric", "nodes-global"): ("host.nodes", "jConSecid holds 101; expected 1 to nSecNod = 3"),
    ("vfric", "nodes-too-few"): ("host.counts", "nContact = 3 with nSecNod = 1"),
    ("vfric", "directions"): ("host.counts", "nFricDir = 3; expected 1 or 2"),
    ("vfriction", "edges"): ("host.counts", "nBlockEdge = 3 with nNodSec = 1; expected 1"),
    ("vfric_coef", "rate-negative"): ("host.coefficient", "slipRate(1) = -5.09"),
    ("vfric_coef", "derivative-null"): ("host.arrays", "fCoefDeriv is a null pointer"),
    ("vfric_coef", "time-start"): ("host.times", "rData(1) = 0 in the first increment"),
    ("vfric_coef", "flags-exchanged"): ("host.increments", "jFlags(1) counts up to 12"),
}  # fmt: skip
#: Fault of coefficient.c, which speaks the 2022 form.
COEFFICIENT = {
    "rate-negative": ("host.coefficient", "slipData(1,1) = -3.7"),
    "rate-component": ("host.coefficient", "have the magnitude 3.7"),
    "equivalent-signed": ("host.coefficient", "expected the equivalent slip to grow"),
    "iteration-zero": ("host.iterations", "iData(3) = 0; expected 1 or more"),
    "iteration-total": ("host.iterations", "iData(3) = 4 is the smallest in its increment"),
    "directions": ("host.counts", "iData(6) = 3"),
    "rotation-zero": ("host.axes", "rData(4) to rData(7)"),
    "state-updated": ("host.state", "rData(8) = "),
    "state-lost": ("host.state", "rData(8) = 0 on entry"),
    "state-mixed": ("host.state", "node 102)"),
}  # fmt: skip
#: Rules that the linked Fortran host, and the Python host, break by their own name.
FORTRAN = [
    "host.times", "host.axes", "host.slip-direction", "host.previous-force",
    "host.zeroed-outputs", "host.state",
]  # fmt: skip
PYTHON = [
    ("fric", "host.times"), ("fric", "host.increments"), ("fric", "host.pressure"),
    ("fric", "host.cut-back"), ("vfriction", "host.previous-force"),
    ("vfriction", "host.stick-force"),
]  # fmt: skip
#: Rules that no fault here breaks, and why.
WITHOUT_FAULT = {"host.threads": "tests/hosts/test_check_host.py breaks it with recorded calls"}


@pytest.fixture(scope="session")
def programs(tmp_path_factory) -> Path:
    """The hosts in C, the explicit one in both precisions."""
    if shutil.which("cc") is None:
        pytest.skip("cc is missing; install a C compiler to build the broken hosts")
    folder = tmp_path_factory.mktemp("broken")
    include = [f"-I{_ROOT / 'csrc/include'}", f"-I{_ROOT / 'csrc/driver'}"]
    for name, source, options in (
        ("implicit", "implicit.c", []),
        ("coefficient", "coefficient.c", []),
        ("explicit", "explicit.c", []),
        ("explicit_single", "explicit.c", ["-DUSUB_SINGLE"]),
    ):
        _build("cc", "-std=gnu11", "-D_GNU_SOURCE", "-O1", "-Wall", "-Wextra", *include, *options,
               _HERE / source, "-o", folder / name, "-ldl", "-lm", "-lpthread")  # fmt: skip
    return folder


def _build(*command: object) -> None:
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr


def _report(command, interface, scenarios=("plain",), **options):
    """The report of a host, which is given little time to hang."""
    given = Options(**{"time_limit": 20.0, **options})
    return hosts.check(
        [str(word) for word in command], interfaces=[interface], scenarios=scenarios, options=given
    )[0]


def _healthy(report) -> None:
    assert [f"{r.rule}: {r.detail}" for r in report.failures] == []
    assert [f"{r.rule}: {r.detail}" for r in report.of("skip")] == []


def _caught(report, rule: str, words: str = "") -> None:
    assert [r.rule for r in report.failures] == [rule], [r.detail for r in report.failures]
    assert words in report[rule].detail
    assert report[rule].hint


_ALL = ("plain", "multiplier", "cut-back")


def test_healthy_fric(programs):
    _healthy(_report([programs / "implicit", "{probe}", "fric", "none"], "fric", _ALL))


@pytest.mark.parametrize("way", ["open", "anew", "twice", "reversed"])
def test_other_healthy_fric(programs, way):
    """What hosts may do: see implicit.c."""
    command = [programs / "implicit", "{probe}", "fric", f"healthy-{way}"]
    _healthy(_report(command, "fric", _ALL))


@pytest.mark.parametrize("way", ["calls", "threads"])
@pytest.mark.parametrize("program", ["explicit", "explicit_single"])
def test_other_healthy_vfriction(programs, program, way):
    """A call for each point, and such calls at the same time in several threads."""
    command = [programs / program, "{probe}", "vfriction", f"healthy-{way}"]
    report = _report(command, "vfriction")
    _healthy(report)
    assert report.head.values[0].value.startswith("66 calls")


@pytest.mark.parametrize("fault", FRIC)
def test_fric(programs, fault):
    limit = 1.0 if fault == "hang" else 20.0
    scenarios = ("plain",) if fault in ("hang", "crash", "never-calls") else _ALL
    command = [programs / "implicit", "{probe}", "fric", fault]
    report = _report(command, "fric", scenarios, time_limit=limit)
    _caught(report, *FRIC[fault])


@pytest.mark.parametrize("program", ["explicit", "explicit_single"])
@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
def test_healthy_explicit(programs, program, interface):
    report = _report([programs / program, "{probe}", interface, "none"], interface)
    _healthy_but_state(report, interface)
    assert report.head.precision == ("single" if program == "explicit_single" else "double")


def _healthy_but_state(report, interface) -> None:
    _healthy(report)
    applies = interface != "vfric_coef"
    assert (report["host.state"].verdict == "pass") == applies


@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
@pytest.mark.parametrize("fault", FORCE)
def test_force(programs, interface, fault):
    _caught(_report([programs / "explicit", "{probe}", interface, fault], interface), *FORCE[fault])


@pytest.mark.parametrize(("interface", "fault"), ONE_INTERFACE)
def test_one_interface(programs, interface, fault):
    report = _report([programs / "explicit", "{probe}", interface, fault], interface)
    _caught(report, *ONE_INTERFACE[interface, fault])


@pytest.mark.parametrize("fault", ["t1-stale", "previous-local", "stick-stale", "state-mixed"])
@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
def test_single_precision(programs, interface, fault):
    report = _report([programs / "explicit_single", "{probe}", interface, fault], interface)
    _caught(report, FORCE[fault][0])


@pytest.mark.parametrize("form", ["legacy", "2022"])
def test_healthy_coefficient(programs, form):
    """The form of FRIC_COEF is seen in the calls."""
    report = _report([programs / "coefficient", "{probe}", form, "none"], "fric_coef")
    _healthy(report)
    assert report.head.generation == form


@pytest.mark.parametrize("fault", COEFFICIENT)
def test_coefficient(programs, fault):
    command = [programs / "coefficient", "{probe}", "2022", fault]
    _caught(_report(command, "fric_coef", generation="2022"), *COEFFICIENT[fault])


def test_legacy_coefficient(programs):
    report = _report([programs / "coefficient", "{probe}", "legacy", "rate-negative"], "fric_coef")
    _caught(report, "host.coefficient", "slipRate(1) = -3.7")


@pytest.fixture(scope="session")
def linked(fortran, tmp_path_factory) -> Path:
    """The host in Fortran, linked against a routine that must never run."""
    folder = tmp_path_factory.mktemp("linked")
    (folder / "routine.f90").write_text("subroutine vfric()\n stop 'never'\nend\n")
    _build(fortran, "-shared", "-fPIC", folder / "routine.f90", "-o", folder / "libroutine.so")
    include = paths.include_folder()
    _build(fortran, "-cpp", "-O1", "-w", f"-I{include}", f"-J{folder}", _HERE / "linked.F90", "-o",
           folder / "linked", f"-L{folder}", "-lroutine", f"-Wl,-rpath,{folder}")  # fmt: skip
    return folder / "linked"


@pytest.mark.needs_fortran
def test_healthy_fortran(linked):
    _healthy(_report([linked, "none"], "vfric"))


@pytest.mark.needs_fortran
@pytest.mark.parametrize("rule", FORTRAN)
def test_fortran(linked, rule):
    _caught(_report([linked, rule], "vfric"), rule)


@pytest.mark.parametrize("interface", ["fric", "vfriction"])
def test_healthy_python(interface):
    report = _report([sys.executable, _HERE / "driven.py", interface, "none"], interface, _ALL)
    _healthy(report)


@pytest.mark.parametrize(("interface", "rule"), PYTHON)
def test_python(interface, rule):
    scenarios = ("plain", "cut-back") if rule == "host.cut-back" else ("plain",)
    command = [sys.executable, _HERE / "driven.py", interface, rule]
    _caught(_report(command, interface, scenarios, preload=False), rule)


def test_every_rule_has_a_fault():
    broken = {rule for rule, _ in [*FRIC.values(), *FORCE.values(), *COEFFICIENT.values()]}
    assert broken | set(WITHOUT_FAULT) == set(all_rules())


def test_every_fault_is_planted():
    """The names here are those that the sources ask for."""
    for table, source in (
        (FRIC, "implicit.c"),
        (FORCE, "explicit.c"),
        (COEFFICIENT, "coefficient.c"),
    ):
        text = (_HERE / source).read_text() + (_HERE / "common.h").read_text()
        assert [name for name in table if f'is("{name}")' not in text] == []
    assert os.access(_HERE / "driven.py", os.R_OK)
