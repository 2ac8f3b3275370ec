# SPDX-License-Identifier: MIT
"""`usersub check-host`: our own hosts keep every rule, and the probe gets into any host."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner

from usersub import paths
from usersub.check import hosts
from usersub.check.hosts import checking, log, running
from usersub.check.hosts.running import Options, Run
from usersub.cli.main import cli

_ROOT = Path(__file__).resolve().parents[2]
_EXAMPLES = _ROOT / "docs/examples/hosts"
_EXPLICIT = ["vfric", "vfriction", "vfric_coef"]

#: A host that calls VFRIC_COEF by hand: %s is how it finds the routine.
_SMALL = r"""
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <usersub/abi.h>
%s
int main(int count, char **arguments) {
  (void)count;
  (void)arguments;
  usub_vfric_coef_fn_d *routine = find(arguments);
  int n = 2, one = 1, zero = 0, flags[2] = {1, 1};
  double mu[2], derivative[6], times[3] = {0.5, 0.5, 0.5}, props[1] = {0.25}, rate[2] = {3, 4};
  double pressure[2] = {10, 20}, warm[2] = {20, 21}, none[1] = {0};
  char name[80];
  memset(name, ' ', sizeof name);
  memcpy(name, "SOLE", 4);
  for (int i = 1; i <= 3; ++i) {
    flags[1] = i;
    times[0] = times[1] = 0.5 * i;
    routine(mu, derivative, &n, &one, &one, &zero, flags, times, name, name, name, props, rate,
            pressure, warm, none, 80, 80, 80);
  }
  printf("%%g\n", mu[0]);
  return 0;
}
"""
_OPENED = """
static usub_vfric_coef_fn_d *find(char **arguments) {
  void *handle = dlopen(arguments[1], RTLD_NOW), *found = dlsym(handle, "vfric_coef_");
  usub_vfric_coef_fn_d *routine;
  memcpy(&routine, &found, sizeof routine);
  return routine;
}
"""
_LINKED = """
extern usub_vfric_coef_fn_d vfric_coef_;
static usub_vfric_coef_fn_d *find(char **arguments) {
  (void)arguments;
  return vfric_coef_;
}
"""
#: A routine that must never run.
_ROUTINE = "#include <stdlib.h>\nvoid vfric_coef_(void) { abort(); }\n"


def _cc(*words: object) -> None:
    if shutil.which("cc") is None:
        pytest.skip("cc is missing; install a C compiler to build hosts")
    command = ["cc", "-std=gnu11", "-w", f"-I{paths.include_folder()}", *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr


@pytest.fixture(scope="module")
def examples(tmp_path_factory) -> Path:
    """The example hosts in C, against the installed core."""
    folder, lib = tmp_path_factory.mktemp("examples"), paths.library_path().parent
    for name in ("explicit_block", "implicit_block"):
        _cc(_EXAMPLES / f"c/{name}.c", "-o", folder / name, f"-L{lib}", "-lusersub", "-lm",
            f"-Wl,-rpath,{lib}")  # fmt: skip
    return folder


@pytest.fixture(scope="module")
def small(tmp_path_factory) -> Path:
    """Hosts without usersub: one opens a library, one is linked against it; and that library."""
    folder = tmp_path_factory.mktemp("small")
    for name, text in (
        ("opened", _SMALL % _OPENED),
        ("linked", _SMALL % _LINKED),
        ("routine", _ROUTINE),
    ):
        (folder / f"{name}.c").write_text(text)
    _cc("-shared", "-fPIC", folder / "routine.c", "-o", folder / "libroutine.so")
    _cc(folder / "opened.c", "-o", folder / "opened", "-ldl")
    _cc(folder / "linked.c", "-o", folder / "linked", f"-L{folder}", "-lroutine",
        f"-Wl,-rpath,{folder}")  # fmt: skip
    return folder


def _check(command, interface, scenarios=("plain",), **options):
    words = [str(word) for word in command]
    return hosts.check(
        words, interfaces=[interface], scenarios=scenarios, options=Options(**options)
    )[0]


def _keeps_every_rule(report) -> None:
    assert [f"{r.rule}: {r.detail}" for r in report.failures] == []


@pytest.mark.parametrize("interface", _EXPLICIT)
def test_explicit_example(examples, interface):
    report = _check([examples / "explicit_block", "{probe}", interface], interface)
    _keeps_every_rule(report)
    assert report["host.call"].verdict == "pass"


@pytest.mark.parametrize("interface", ["fric", "fric_coef"])
def test_implicit_example(examples, interface):
    scenarios = tuple(checking.SCENARIOS)
    report = _check([examples / "implicit_block", "{probe}", interface], interface, scenarios)
    _keeps_every_rule(report)
    if interface == "fric":
        assert report["host.cut-back"].verdict == "pass"
        # It has no multipliers, and says so when a routine asks for them.
        assert "after LM = 1 the host ended with exit status 1" in report["host.sticking"].detail


@pytest.mark.parametrize("interface", _EXPLICIT)
def test_cpp_example(tmp_path, interface):
    if shutil.which("c++") is None:
        pytest.skip("c++ is missing; install a C++ compiler to build the host")
    lib, host = paths.library_path().parent, tmp_path / "host"
    source = _EXAMPLES / "cpp/explicit_block.cpp"
    command = ["c++", "-std=c++17", f"-I{paths.include_folder()}", source, "-o", host, f"-L{lib}",
               "-lusersub", f"-Wl,-rpath,{lib}"]  # fmt: skip
    subprocess.run([str(c) for c in command], check=True, timeout=120)
    _keeps_every_rule(_check([host, "{probe}", interface], interface))


@pytest.mark.needs_fortran
def test_fortran_example(fortran, tmp_path):
    lib, include = paths.library_path().parent, paths.include_folder()
    command = [fortran, f"-J{tmp_path}", include / "usersub/usersub.f90",
               _EXAMPLES / "fortran/explicit_block.f90", "-o", tmp_path / "host", f"-L{lib}",
               "-lusersub", f"-Wl,-rpath,{lib}"]  # fmt: skip
    subprocess.run([str(c) for c in command], check=True, timeout=120)
    for interface in _EXPLICIT:
        _keeps_every_rule(_check([tmp_path / "host", "{probe}", interface], interface))


_PROBLEM = """
import os, sys, usersub
from usersub.problems import PROBLEMS
name, interface, method, precision = sys.argv[1:]
routine = usersub.load(os.environ["USERSUB_PROBE"], precision=precision)[interface]
PROBLEMS[name].run(routine, method=method, precision=precision)
"""
_RUNS = [
    ("P1", "vfric", "CPE3", "double"),
    ("P1", "vfric", "C3D8R", "single"),
    ("P1", "vfriction", "CPE3 analytical", "double"),
    ("P1", "vfric_coef", "C3D8R", "single"),
    ("P3", "fric", "prescribed traction", "double"),
    ("P9", "fric_coef", "wedge lagrange", "double"),
    ("P16", "fric", "rigid load", "double"),
    ("P16", "vfriction", "rigid load", "double"),
    ("P24", "vfric_coef", "softened, damped", "double"),
]


@pytest.mark.parametrize(("name", "interface", "method", "precision"), _RUNS)
def test_python_hosts(tmp_path, name, interface, method, precision):
    """Hosts of the problems. Those that follow events exactly ask for friction at instants that
    they give up again, which no increment of a solver does; they are left out here."""
    (tmp_path / "host.py").write_text(_PROBLEM)
    command = [sys.executable, tmp_path / "host.py", name, interface, method, precision]
    report = _check(command, interface, preload=False)
    _keeps_every_rule(report)
    assert report.head.precision == precision


_SCENE = """
routine = "libnever.so"
interface = "fric"
props = [0.3]
[scene]
dimension = 2
states = 2
characteristic_length = 1.0
[history]
time = [0.0, 1.0, 3.0]
slip = [0.0, 1.0, -1.0]
pressure = 10.0
substeps = 10
"""


def test_scene_runner(tmp_path):
    """`usersub run` is a host as well; it prescribes the slip, so that LM = 1 cannot be obeyed."""
    (tmp_path / "never.c").write_text("#include <stdlib.h>\nvoid fric_(void) { abort(); }\n")
    _cc("-shared", "-fPIC", tmp_path / "never.c", "-o", tmp_path / "libnever.so")
    (tmp_path / "scene.toml").write_text(_SCENE)
    command = [sys.executable, "-m", "usersub", "run", tmp_path / "scene.toml"]
    report = _check(command, "fric", tuple(checking.SCENARIOS), replace="libnever.so")
    assert [r.rule for r in report.failures] == ["host.sticking"]
    assert report.ok()  # it is a warning


@pytest.mark.parametrize(
    ("program", "options"),
    [
        (["opened", "{probe}"], {}),
        (["opened", "FOLDER/libroutine.so"], {"replace": "FOLDER/libroutine.so"}),
        (["opened", "FOLDER/libroutine.so"], {"replace": "libroutine.so"}),
        (["opened", "libnowhere.so"], {"replace": "libnowhere.so"}),
        (["linked"], {}),
    ],
    ids=["placeholder", "path", "name", "absent", "linked"],
)
def test_ways_in(small, program, options):
    """The routine itself would abort."""
    words = [w.replace("FOLDER", str(small)) for w in program]
    words[0] = str(small / words[0])
    given = {k: v.replace("FOLDER", str(small)) for k, v in options.items()}
    report = _check(words, "vfric_coef", **given)
    _keeps_every_rule(report)
    assert report.head.values[0].value == "3 calls; it ended with exit status 0"


def test_no_way_in(small):
    report = _check([small / "opened", small / "libroutine.so"], "vfric_coef", preload=False)
    assert [r.rule for r in report.failures] == ["host.call", "host.ends"]
    assert "SIGABRT" in report["host.ends"].detail


def test_a_library_that_is_not_here(small, tmp_path):
    """A program linked against a missing library starts, since the probe has its name."""
    shutil.copy(small / "linked", tmp_path / "linked")
    gone = tmp_path / "gone"
    gone.mkdir()
    _cc(small / "linked.c", "-o", tmp_path / "linked", f"-L{small}", "-lroutine")
    report = _check([tmp_path / "linked"], "vfric_coef", replace="libroutine.so")
    _keeps_every_rule(report)


def test_run_path_of_the_host(small, tmp_path):
    """The probe stands between the host and dlopen; the host's own run path still counts."""
    plugins = tmp_path / "plugins"
    plugins.mkdir()
    (plugins / "plugin.c").write_text("int plugin(void) { return 7; }")
    _cc("-shared", "-fPIC", plugins / "plugin.c", "-o", plugins / "libplugin.so")
    (tmp_path / "host.c").write_text(
        '#include <dlfcn.h>\nint main(void) { return dlopen("libplugin.so", RTLD_NOW) ? 0 : 9; }'
    )
    flags = ["-ldl", "-Wl,--enable-new-dtags", "-Wl,-rpath,$ORIGIN/plugins"]
    _cc(tmp_path / "host.c", "-o", tmp_path / "host", *flags)
    report = _check([tmp_path / "host"], "fric", preload=True)
    assert report.head.values[0].value == "0 calls; it ended with exit status 0"


def test_command(small, tmp_path):
    """JSON on standard output, a JUnit file beside it, exit code 0."""
    junit = tmp_path / "host.xml"
    words = ["check-host", "--json", "--junit", str(junit), "--", str(small / "opened"), "{probe}"]
    done = CliRunner().invoke(cli, words)
    assert done.exit_code == 0, done.output
    whole = json.loads(done.stdout)
    assert whole["ok"] and whole["results"][0]["head"]["interface"] == "vfric_coef"
    assert "host.coefficient" in junit.read_text()


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--", "./not-a-host"], "the host './not-a-host' is not a program that can be run"),
        (["--rule", "host.nothing", "--", "true"], "unknown rule 'host.nothing'"),
    ],
)
def test_refusals(words, sentence):
    done = CliRunner().invoke(cli, ["check-host", *words])
    assert done.exit_code == 1
    assert sentence in done.stderr


def test_rules_that_are_chosen(small):
    report = hosts.check([str(small / "opened"), "{probe}"], rules=["host.times"])[0]
    assert [r.rule for r in report.results] == ["host.times"]


def test_a_record_that_breaks_off(small, tmp_path):
    """What was written before the end of a host is read."""
    record = tmp_path / "calls"
    log.create(record, 100)
    environment = {"USERSUB_PROBE_LOG": str(record)}
    subprocess.run([small / "opened", running.probe_path()], env=environment, check=True)
    whole = log.read(record)
    assert [c["nBlock"] for c in whole.calls] == [2, 2, 2]
    record.write_bytes(record.read_bytes()[:-200])
    assert len(log.read(record).calls) == 2
    record.write_bytes(b"something else")
    with pytest.raises(Exception, match="is not a record of the probe"):
        log.read(record)


def test_calls_beyond_the_limit_are_counted(small):
    report = _check([small / "opened", "{probe}"], "vfric_coef", calls=2)
    assert report.head.values[0].value.startswith("3 calls")
    assert "2 of 3 calls were recorded and judged (see --calls and --points)" in report.notes


def test_threads_that_share_outputs(small, tmp_path):
    """Recorded calls of which two run at once in two threads, with the same output arrays."""
    record = tmp_path / "calls"
    log.create(record, 100)
    environment = {"USERSUB_PROBE_LOG": str(record)}
    subprocess.run([small / "opened", running.probe_path()], env=environment, check=True)
    one, two, three = log.read(record).calls
    other = replace(two, thread=one.thread + 1, begin=one.begin, end=one.end)
    run = Run("plain", log.Log((one, other, three), 3, 0, ""), 0, 0.1, 0.0, "")
    found = checking.judge("vfric_coef", [run])["host.threads"]
    assert found.verdict == "fail"
    assert "ran at the same time in two threads, and fCoef of the one lies on fCoef" in found.detail
