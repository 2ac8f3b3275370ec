# SPDX-License-Identifier: MIT
"""Whether the host calls the routine at all, and ends."""

from __future__ import annotations

from collections.abc import Iterator

from usersub.check.hosts.evidence import Evidence
from usersub.check.hosts.log import ASSUMED, FINE
from usersub.check.hosts.rule import host_rule
from usersub.check.hosts.running import Run
from usersub.check.rule import CannotCheck


@host_rule(
    "host.call",
    "The host calls the routine.",
    reference="the interface: a routine is called for every closed contact point",
    hint="Load the library whose path is in the environment variable USERSUB_PROBE, put {probe} "
    "in the command in place of the library, or name the library with --replace.",
)
def called(evidence: Evidence) -> Iterator[str]:
    """No call: the probe did not get in, or nothing closed."""
    plain = evidence.runs[0]
    if not evidence.calls:
        others = sorted({c.face.name.upper() for c in plain.log.calls})
        rest = f"it called {', '.join(others)}" if others else "it called no routine at all"
        asked = evidence.interface.upper()
        yield f"the host did not call {asked}; {rest}, and {plain.ending}{_last_line(plain)}"
        return
    if plain.log.total > len(plain.log.calls):
        evidence.remarks.append(
            f"{len(plain.log.calls)} of {plain.log.total} calls were recorded and judged "
            "(see --calls and --points)"
        )
    cut = {
        given.modern
        for call in evidence.calls
        for given, about in zip(call.face.args, call.arguments, strict=True)
        if about.found == FINE and len(about.entry) < about.size
    }
    if cut:
        names = ", ".join(sorted(cut))
        evidence.remarks.append(f"arguments above 4 MiB are judged by their size only: {names}")
    if not evidence.precision_is_known:
        evidence.remarks.append("double precision was assumed; --precision tells it")
    if any(c.generation_basis == ASSUMED for c in evidence.calls):
        evidence.remarks.append("the legacy form of FRIC_COEF was assumed; --generation tells it")


@host_rule(
    "host.ends",
    "The host ends by itself: it neither crashes nor hangs.",
    reference="a crash is a fault of the host here, since the probe touches no memory that it was "
    "not given",
    hint="Run the host under a debugger with the probe; the last recorded call is named.",
)
def ends(evidence: Evidence) -> Iterator[str]:
    """Crashes and hangs of the plain run; the other scenarios may rightly be refused."""
    plain = evidence.runs[0]
    if plain.code is None:
        if plain.log.calls and plain.quiet < 0.5 * plain.seconds:
            raise CannotCheck(f"the host {plain.ending} while it was calling (see --time-limit)")
        calls = f"{plain.log.total} calls, none in the last {plain.quiet:.0f} s"
        yield f"the host {plain.ending}, after {calls}{_last_line(plain)}"
    elif plain.code < 0:
        yield f"the host {plain.ending} after {plain.log.total} calls{_last_line(plain)}"
    for run in evidence.runs[1:]:
        if run.code != 0:
            evidence.remarks.append(f"in scenario {run.scenario} the host {run.ending}")


@host_rule(
    "host.status",
    "The host ends with exit status 0.",
    reference="convention of programs; a host that compares its results with known ones may "
    "rightly not like the friction of the probe",
    hint="Look at what the host printed. What it did before that has been judged.",
    severity="warning",
)
def status(evidence: Evidence) -> Iterator[str]:
    """Exit status of the plain run."""
    plain = evidence.runs[0]
    if plain.code is None or plain.code < 0:
        raise CannotCheck(f"the host {plain.ending}")
    if plain.code:
        yield f"the host {plain.ending} after {plain.log.total} calls{_last_line(plain)}"


def _last_line(run: Run) -> str:
    lines = [line.strip() for line in run.output.splitlines() if line.strip()]
    return f"; the last line that it wrote is {lines[-1][:160]!r}" if lines else ""


@host_rule(
    "host.threads",
    "No two calls at the same time write to the same memory.",
    reference="the interface: arguments that the routine writes are its own for the call",
    hint="Give every thread its own output arrays and its own contact points.",
)
def threads(evidence: Evidence) -> Iterator[str]:
    """Overlapping calls of different threads whose written arguments overlap."""
    calls = sorted(evidence.need_calls(), key=lambda c: (c.process, c.scenario, c.begin))
    if len({(c.process, c.thread) for c in calls}) == len({c.process for c in calls}):
        evidence.say("every process called from one thread")
    running: list = []
    for call in calls:
        running = [
            c
            for c in running
            if c.process == call.process and c.scenario == call.scenario and c.end > call.begin
        ]
        for other in running:
            if other.thread == call.thread:
                continue
            for name, at in _written(call):
                for theirs, there in _written(other):
                    if at[0] < there[1] and there[0] < at[1]:
                        yield (
                            f"calls {other.sequence} and {call.sequence} ran at the same time in "
                            f"two threads, and {theirs} of the one lies on {name} of the other"
                        )
                        return
        running.append(call)


def _written(call) -> Iterator[tuple[str, tuple[int, int]]]:
    for given, about in zip(call.face.args, call.arguments, strict=True):
        # A whole state array may serve several calls, each with its own nodes.
        if given.intent == "write" and about.size > 0:
            yield given.modern, (about.address, about.address + about.size)
