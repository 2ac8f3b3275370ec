# SPDX-License-Identifier: MIT
"""Running a host with the probe in place of a user's routine."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from usersub import paths
from usersub.check.hosts import log
from usersub.errors import Error, LoadError

#: What the host's command may hold in place of the path of a library.
PLACEHOLDER = "{probe}"
#: Characters of what a host printed that are kept.
_KEPT = 4000


@dataclass(frozen=True)
class Options:
    """How a host is run.

    Attributes:
        time_limit: seconds after which it is ended.
        precision: "auto", "double" or "single": what the explicit interfaces are called with.
        generation: "auto", "legacy" or "2022": the form of FRIC_COEF that the host speaks.
        replace: libraries whose dlopen gives the probe: a path, or a bare file name.
        preload: whether the probe is loaded before all libraries; None means unless the command
            has the placeholder and nothing is replaced.
        calls: calls that are recorded at most.
        points: contact points of FRIC and FRIC_COEF that are recorded at most.
        folder: working directory of the host; None for the current one.
        environment: further variables.
    """

    time_limit: float = 60.0
    precision: str = "auto"
    generation: str = "auto"
    replace: str = ""
    preload: bool | None = None
    calls: int = 2000
    points: int = 8
    folder: Path | None = None
    environment: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Run:
    """One run of a host.

    Attributes:
        scenario: what the probe answered.
        log: what was recorded.
        code: exit status; negative is the number of the signal that ended it; None if the time
            limit did.
        seconds: how long it ran.
        quiet: seconds at the end without a call; all of them if there was none.
        output: end of what it printed.
    """

    scenario: str
    log: log.Log
    code: int | None
    seconds: float
    quiet: float
    output: str

    @property
    def ending(self) -> str:
        """How it ended, as a clause."""
        if self.code is None:
            return f"was still running after {self.seconds:.0f} s and was ended"
        if self.code < 0:
            try:
                name = signal.Signals(-self.code).name
            except ValueError:
                name = f"signal {-self.code}"
            return f"was ended by {name}"
        return f"ended with exit status {self.code}"


def probe_path() -> Path:
    """The probe: a library with the entries of all interfaces.

    Raises:
        LoadError: it is not where the installation puts it.
    """
    path = paths.library_path().with_name("libusersub-probe.so")
    if not path.is_file():
        raise LoadError(
            f"the probe {path} is not there; it is built on Linux only, where installing the "
            "package again makes it"
        )
    return path


def run(
    command: Sequence[str], scenario: str, options: Options, script: dict[str, str] | None = None
) -> Run:
    """Runs a host and reads what the probe recorded.

    Args:
        command: program and arguments; `{probe}` in them becomes the path of the probe.
        scenario: what the probe answers, see `checking.SCENARIOS`.
        script: further variables for the probe.

    Raises:
        Error: the program cannot be started.
    """
    probe = probe_path()
    with tempfile.TemporaryDirectory(prefix="usersub-host-") as name:
        folder = Path(name)
        record = folder / "calls"
        log.create(record, options.calls)
        environment = _environment(command, scenario, options, probe, record, folder)
        environment.update(script or {})
        words = [word.replace(PLACEHOLDER, str(probe)) for word in command]
        code, seconds, ended, output = _run(words, environment, options, folder)
        found = log.read(record, scenario)
    quiet = ended - found.latest / 1e9 if found.latest else seconds
    return Run(scenario, found, code, seconds, max(quiet, 0.0), output)


def _environment(
    command: Sequence[str],
    scenario: str,
    options: Options,
    probe: Path,
    record: Path,
    folder: Path,
) -> dict[str, str]:
    made = {
        **os.environ,
        **options.environment,
        "USERSUB_PROBE": str(probe),
        "USERSUB_PROBE_LOG": str(record),
        "USERSUB_PROBE_SCENARIO": scenario,
        "USERSUB_PROBE_PRECISION": options.precision,
        "USERSUB_PROBE_GENERATION": options.generation,
        "USERSUB_PROBE_POINTS": str(options.points),
    }
    named = any(PLACEHOLDER in word for word in command)
    preload = options.preload if options.preload is not None else bool(options.replace) or not named
    libraries = folder / "libraries"
    libraries.mkdir()
    if preload:
        # A blank in the path of the probe would end it.
        in_front = libraries / probe.name
        in_front.symlink_to(probe)
        made["LD_PRELOAD"] = _in_front(str(in_front), made.get("LD_PRELOAD", ""))
    if options.replace:
        made["USERSUB_PROBE_REPLACE"] = options.replace
        # A program that is linked against a library which is not here finds the probe.
        named_so = libraries / Path(options.replace).name
        if not named_so.is_symlink():
            named_so.symlink_to(probe)
        made["LD_LIBRARY_PATH"] = _in_front(str(libraries), made.get("LD_LIBRARY_PATH", ""))
    return made


def _in_front(first: str, others: str) -> str:
    return f"{first}:{others}" if others else first


def _run(
    words: list[str], environment: dict[str, str], options: Options, folder: Path
) -> tuple[int | None, float, float, str]:
    """Exit status, seconds, clock at the end, and what was printed."""
    if shutil.which(words[0], path=environment.get("PATH")) is None:
        raise Error(f"the host '{words[0]}' is not a program that can be run")
    printed = folder / "printed"
    begin = time.monotonic()
    with printed.open("wb") as stream:
        host = subprocess.Popen(
            words,
            env=environment,
            cwd=options.folder,
            stdin=subprocess.DEVNULL,
            stdout=stream,
            stderr=subprocess.STDOUT,
            start_new_session=True,  # what it starts can be ended with it
        )
        try:
            code: int | None = host.wait(timeout=options.time_limit)
        except subprocess.TimeoutExpired:
            code = None
        finally:
            _end(host)
    now = time.monotonic()
    size = printed.stat().st_size
    with printed.open("rb") as stream:
        stream.seek(max(0, size - _KEPT))
        output = stream.read().decode(errors="replace")
    return code, now - begin, now, output


def _end(host: subprocess.Popen[bytes]) -> None:
    """Ends the host and what it started."""
    try:
        os.killpg(host.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    host.wait()
