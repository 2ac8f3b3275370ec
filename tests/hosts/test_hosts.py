# SPDX-License-Identifier: MIT
"""The example hosts: built against an installed C core as their README says, run, compared.

The C core is installed by CMake alone into a folder of its own; no Python is in the processes.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

_ROOT = Path(__file__).resolve().parents[2]
_HOSTS = _ROOT / "docs/examples/hosts"

# The verification block: deceleration mu p / (rho h) is constant.
_DECELERATION = 0.15 * 2000 / 7.3e-4
_TIME = 200 / _DECELERATION
_DISTANCE = 200**2 / (2 * _DECELERATION)
_EXPLICIT = ["vfric", "vfriction", "vfric_coef"]
_RUNS = [
    *[(program, i) for program in ("explicit_block", "explicit_block_cpp") for i in _EXPLICIT],
    *[("implicit_block", i) for i in ("fric", "fric_coef")],
]


def _run(*command: object, cwd: Path | None = None, env: dict | None = None) -> str:
    """Standard output of a command that has to succeed."""
    words = [str(c) for c in command]
    environment = {**os.environ, **(env or {})}
    done = subprocess.run(
        words, cwd=cwd, env=environment, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, f"{' '.join(words)}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def _need(*tools: str) -> None:
    for tool in tools:
        if shutil.which(tool) is None:
            pytest.skip(f"{tool} is missing; install it to build the example hosts")


def _cmake(source: Path, folder: Path, *options: str) -> None:
    """Configures and builds `source` in `folder`."""
    _need("cmake")
    if shutil.which("ninja"):
        options = ("-G", "Ninja", *options)
    _run("cmake", "-S", source, "-B", folder, *options)
    _run("cmake", "--build", folder, "--parallel", "2")


def _answer(line: str) -> tuple[float, float]:
    """Stopping time and distance that a host printed."""
    found = re.fullmatch(r"host=\w+ interface=\w+ stop_time=(\S+) stop_distance=(\S+)\n", line)
    assert found, line
    return float(found[1]), float(found[2])


def _check(line: str) -> None:
    """Against the closed form: 1e-9 relative, the bound asked of the rigid block. The integration
    is exact for a constant deceleration; the allowable elastic slip of the implicit host, 5e-11
    in, is 1e-9 of the way."""
    time, distance = _answer(line)
    assert time == pytest.approx(_TIME, rel=1e-9)
    assert distance == pytest.approx(_DISTANCE, rel=1e-9)


@pytest.fixture(scope="session")
def built(prefix: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The hosts and the example routine, built through find_package."""
    _need("c++")
    folder = tmp_path_factory.mktemp("hosts")
    _cmake(_HOSTS, folder, f"-DCMAKE_PREFIX_PATH={prefix}")
    return folder


@pytest.mark.parametrize(("program", "interface"), _RUNS)
def test_find_package(built, program, interface):
    _check(_run(built / program, built / "libfriction.so", interface))


@pytest.mark.parametrize("interface", _EXPLICIT)
def test_fortran_host(built, fortran, interface):
    _check(_run(built / "explicit_block_fortran", built / "libfriction.so", interface))


@pytest.mark.parametrize(
    ("source", "interface"),
    [("c/explicit_block.c", "vfric"), ("cpp/explicit_block.cpp", "vfriction")],
)
def test_pkg_config(built, prefix, tmp_path, source, interface):
    """The one line of the programs' comments."""
    _need("pkg-config")
    compiler = ["cc"] if source.endswith(".c") else ["c++", "-std=c++17"]
    _build_with_pkg_config([*compiler, str(_HOSTS / source)], "--cflags --libs", prefix, tmp_path)
    _check(_run(tmp_path / "host", built / "libfriction.so", interface))


def test_pkg_config_fortran(built, prefix, tmp_path, fortran):
    _need("pkg-config")
    command = [fortran, "$(pkg-config --variable=fortran_module usersub)"]
    command.append(str(_HOSTS / "fortran/explicit_block.f90"))
    _build_with_pkg_config(command, "--libs", prefix, tmp_path)
    _check(_run(tmp_path / "host", built / "libfriction.so", "vfric_coef"))


def _build_with_pkg_config(command: list[str], options: str, prefix: Path, folder: Path) -> None:
    # Without eval, a shell splits folders at their blanks although pkg-config has quoted them.
    line = f'eval "{" ".join(command)} -o host $(pkg-config {options} usersub)"'
    env = {"PKG_CONFIG_PATH": str(prefix / "lib/pkgconfig")}
    _run("sh", "-c", line, cwd=folder, env=env)


def test_no_python_in_the_process(built):
    """Neither host nor library links Python."""
    _need("ldd")
    for program in ("explicit_block", "explicit_block_cpp", "implicit_block"):
        assert "python" not in _run("ldd", built / program).lower()


FIXED_FORM = """\
      SUBROUTINE VFRIC_COEF(FCOEF, FCOEFDERIV, NBLOCK, NPROPS, NTEMP,
     1 NFIELDS, JFLAGS, RDATA, SURFINT, SURFSLV, SURFMST, PROPS,
     2 SLIPRATE, PRESSURE, TEMPAVG, FIELDAVG)
      INCLUDE 'VABA_PARAM.INC'
      CHARACTER*80 SURFINT, SURFSLV, SURFMST
      DIMENSION FCOEF(NBLOCK), FCOEFDERIV(NBLOCK,3), JFLAGS(2),
     1 RDATA(3), PROPS(NPROPS), SLIPRATE(NBLOCK), PRESSURE(NBLOCK),
     2 TEMPAVG(NBLOCK), FIELDAVG(NBLOCK,NFIELDS)
      IF (PROPS(1) .LT. 0.0D0) STOP 'negative coefficient'
      DO 10 K = 1, NBLOCK
        FCOEF(K) = PROPS(1)
   10 CONTINUE
      END
"""


@pytest.fixture(scope="session")
def fortran_routine(prefix: Path, fortran: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A user's fixed-form file, built by others: nothing of usersub is linked."""
    folder = tmp_path_factory.mktemp("routine")
    (folder / "mine.f").write_text(FIXED_FORM, encoding="ascii")
    include = prefix / "include/usersub/field/double"
    library = folder / "libmine.so"
    _run(fortran, "-shared", "-fPIC", "-O2", f"-I{include}", folder / "mine.f", "-o", library)
    return library


@pytest.mark.parametrize("program", ["explicit_block", "explicit_block_cpp"])
def test_fortran_routine(built, fortran_routine, program):
    _check(_run(built / program, fortran_routine, "vfric_coef", "0.15"))


@pytest.mark.parametrize(
    "program", ["explicit_block", "explicit_block_cpp", "explicit_block_fortran"]
)
def test_stop_in_a_routine_is_a_message(built, fortran_routine, program):
    """The host gets a status, says its own words and ends by its own will."""
    done = subprocess.run(
        [built / program, fortran_routine, "vfric_coef", "-0.15"], capture_output=True, text=True
    )
    assert done.returncode == 1
    assert "ROUTINE_STOPPED" in done.stderr
    assert "STOP negative coefficient" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["nothing.so", "vfric"], "LOAD_FAILED: library 'nothing.so' cannot be loaded"),
        (["LIBRARY", "vfrick"], "unknown interface 'vfrick'"),
        (["LIBRARY", "fric"], "'explicit' cannot call fric"),
    ],
)
def test_bad_arguments(built, arguments, words):
    command = [built / "libfriction.so" if a == "LIBRARY" else a for a in arguments]
    done = subprocess.run([built / "explicit_block", *command], capture_output=True, text=True)
    assert done.returncode == 1
    assert words in done.stderr


@pytest.mark.parametrize("interface", _EXPLICIT)
def test_python_driver_gives_the_same(built, interface):
    """The same host in Python, step by step: the same bits."""
    import numpy as np

    import usersub

    n, dt, mass = 5, 1e-6, 7.3e-4 * 5
    routine = usersub.load(built / "libfriction.so")[interface]
    scene = usersub.Scene(
        points=n, contact="analytical-rigid", secondary_nodes=n, nodes=n, props=[0.15]
    )
    driver = usersub.driver(routine, scene)
    normal = np.zeros((3, n), order="F")
    normal[2] = 1
    velocity, slip = np.zeros((3, n), order="F"), np.zeros((3, n), order="F")
    node = np.arange(1, n + 1, dtype=np.int32)
    stick = np.zeros(n)
    driver.bind(
        slip_increment=slip, normal=normal, normal_force=np.full(n, 2000.0), area=np.ones(n),
        stick_force=stick, secondary_node=node if interface == "vfric" else node[None, :],
    )  # fmt: skip
    time = distance = 0.0
    speed = 200.0
    for _ in range(1000):
        velocity[0] = speed
        slip[0] = speed * dt
        stick[:] = usersub.stick_force_kinematic(velocity, normal, np.full(n, mass / n), dt)
        total = 0.0
        for force in driver.step(dt).force[0]:
            total += force
        change = -total / mass * dt
        if speed - change <= 1e-9 * 200:
            break
        distance += (speed - 0.5 * change) * dt
        time += dt
        speed -= change
        deceleration = change / dt
    python = time + speed / deceleration, distance + 0.5 * speed * speed / deceleration
    assert python == _answer(_run(built / "explicit_block", built / "libfriction.so", interface))
