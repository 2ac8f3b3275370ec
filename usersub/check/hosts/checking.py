# SPDX-License-Identifier: MIT
"""Checking a host: runs with the probe, then the rules."""

from __future__ import annotations

import datetime
import time
from collections.abc import Callable, Iterable, Sequence

from usersub import abi
from usersub.check.hosts.evidence import Evidence
from usersub.check.hosts.judges import all_rules
from usersub.check.hosts.log import ASSUMED, SEEN, Call
from usersub.check.hosts.rule import HostRule
from usersub.check.hosts.running import Options, Run, probe_path, run
from usersub.check.reports.heads import versions
from usersub.check.reports.report import Head, Report, Result, Value
from usersub.check.rule import FAIL, NOT_APPLICABLE, PASS, SKIP, CannotCheck, Finding, NotApplicable
from usersub.errors import Error

#: What the probe answers in a run, and what that is for.
SCENARIOS = {
    "plain": "friction with elastic slip; LM = 0, no cut-back",
    "multiplier": "LM = 2 in every third of six increments, LM = 1 in the fifth, LM = 1 for two "
    "iterations in the sixth",
    "cut-back": "PNEWDT = 0.5 in increments 2 and 5, once each",
}

#: Called with a few words before every run.
Progress = Callable[[str], None]


def check(
    command: Sequence[str],
    *,
    interfaces: Sequence[str] = (),
    scenarios: Sequence[str] = tuple(SCENARIOS),
    rules: Sequence[str] = (),
    options: Options | None = None,
    progress: Progress | None = None,
) -> list[Report]:
    """Runs a host with the probe in place of a user's routine and judges how it called.

    Args:
        command: program and arguments; `{probe}` in them becomes the path of the probe's library.
        interfaces: those that the host has to call; by default those that it called.
        scenarios: of `SCENARIOS`; others than "plain" are run for hosts that call FRIC.
        rules: identifiers; by default all.
        options: how the host is run.
        progress: called with the name of each scenario.

    Returns:
        one report for each interface.

    Raises:
        Error: the program cannot be started, or a scenario, rule or interface is not known.
    """
    chosen = _chosen(rules)
    _known("scenario", scenarios, SCENARIOS)
    _known("interface", interfaces, abi.NAMES)
    begin = time.monotonic()
    runs = list(_runs(command, scenarios, options or Options(), progress or (lambda words: None)))
    seconds = time.monotonic() - begin
    found = list(interfaces) or _called(runs)
    return [judge(name, runs, chosen, command, seconds) for name in found]


def _known(what: str, given: Iterable[str], known: Iterable[str]) -> None:
    for one in given:
        if one not in known:
            raise Error(f"unknown {what} '{one}'; expected one of {', '.join(known)}")


def _chosen(given: Sequence[str]) -> list[HostRule]:
    known = all_rules()
    _known("rule", given, known)
    return [rule for id, rule in known.items() if not given or id in given]


def _runs(
    command: Sequence[str], scenarios: Sequence[str], options: Options, progress: Progress
) -> Iterable[Run]:
    progress("plain")
    plain = run(command, "plain", options)
    yield plain
    if not plain.log.of("fric"):
        return
    numbers = [c["KINC"] for c in plain.log.of("fric")]
    last = max((n for n in numbers if n is not None), default=0)
    for scenario in scenarios:
        if scenario == "plain":
            continue
        progress(scenario)
        # A host of one increment can still be asked to cut that one back.
        script = {"USERSUB_PROBE_CUT_BACK": "1"} if last < 2 else {}
        yield run(command, scenario, options, script)


def _called(runs: list[Run]) -> list[str]:
    """Interfaces that were called; if there are none, all of them are reported as one."""
    found = dict.fromkeys(c.face.name for r in runs for c in r.log.calls)
    return [name for name in abi.NAMES if name in found] or ["fric"]


def judge(
    interface: str,
    runs: list[Run],
    rules: Iterable[HostRule] | None = None,
    command: Sequence[str] = (),
    seconds: float = 0.0,
) -> Report:
    """What the rules say of recorded runs, for one interface."""
    evidence = Evidence(interface, runs)
    judged: dict[str, Result] = {}
    for rule in all_rules().values() if rules is None else rules:
        _judge(rule, evidence, judged)
    chosen = all_rules() if rules is None else {rule.id for rule in rules}
    results = [judged[id] for id in all_rules() if id in chosen]
    notes = [*evidence.remarks, *(f"not seen: {sentence}" for sentence in evidence.unseen)]
    return Report(_head(interface, evidence, command), tuple(results), tuple(notes), seconds)


def _judge(rule: HostRule, evidence: Evidence, judged: dict[str, Result]) -> Result:
    """The result of a rule and, before that, of those that it needs."""
    if rule.id in judged:
        return judged[rule.id]
    begin = time.monotonic()
    try:
        _check_needs(rule, evidence, judged)
        verdict, finding = PASS, Finding("")
        for found in rule.look(evidence):
            verdict = FAIL
            finding = found if isinstance(found, Finding) else Finding(found)
            _check_precision(rule, evidence, finding)
            break
    except NotApplicable as reason:
        verdict, finding = NOT_APPLICABLE, Finding(str(reason))
    except CannotCheck as reason:
        verdict, finding = SKIP, Finding(str(reason))
    except Exception as error:  # a host may pass what no rule foresees
        what = f"{type(error).__name__}: {error}"
        verdict, finding = SKIP, Finding(f"the rule itself failed on this record ({what})")
    judged[rule.id] = Result(
        rule.id,
        verdict,
        finding.detail,
        rule.requirement,
        rule.reference,
        rule.severity,
        evidence.interface,
        _precision(evidence.calls),
        where=finding.where,
        hint=finding.hint or (rule.hint if verdict == FAIL else ""),
        seconds=time.monotonic() - begin,
        figures=dict(finding.figures),
    )
    return judged[rule.id]


_WITHOUT_CALLS = frozenset({"host.call", "host.ends", "host.status"})


def _check_needs(rule: HostRule, evidence: Evidence, judged: dict[str, Result]) -> None:
    if evidence.interface not in rule.interfaces:
        names = ", ".join(name.upper() for name in rule.interfaces)
        raise NotApplicable(f"it is about {names}")
    if not evidence.calls and rule.id not in _WITHOUT_CALLS:
        raise CannotCheck("the routine was not called")
    for id in rule.needs:
        needed = _judge(all_rules()[id], evidence, judged)
        if needed.verdict == FAIL:
            raise CannotCheck(f"{id} failed, on which this rule stands")


#: Rules that look at no real number.
_WITHOUT_REALS = frozenset(
    {"host.call", "host.ends", "host.status", "host.threads", "host.counts", "host.names",
     "host.hidden-lengths", "host.nodes", "host.increments"}
)  # fmt: skip


def _check_precision(rule: HostRule, evidence: Evidence, finding: Finding) -> None:
    """Where neither precision was seen, what was found may come from reading in the wrong one."""
    if rule.id in _WITHOUT_REALS or evidence.precision_is_known:
        return
    raise CannotCheck(
        f"the precision is not known, and this would be so in double precision (give --precision): "
        f"{finding.detail}"
    )


def _precision(calls: list[Call]) -> str:
    return "single" if any(c.single for c in calls) else "double"


_BASIS = {SEEN: "seen in the calls", ASSUMED: "assumed"}


def _head(interface: str, evidence: Evidence, command: Sequence[str]) -> Head:
    calls = evidence.calls
    values = [
        Value(f"scenario {r.scenario}", f"{r.log.total} calls; it {r.ending}", "")
        for r in evidence.runs
    ]
    generation = calls[0].face.generation if calls and interface == "fric_coef" else ""
    if calls:
        for what, basis in (
            ("precision", calls[0].precision_basis),
            ("generation", calls[0].generation_basis),
        ):
            if basis in _BASIS:
                values.append(Value(what, getattr(_Facts(calls[0]), what), _BASIS[basis]))
    return Head(
        routine=" ".join(command) or "host",
        interface=interface,
        generation=generation,
        precision=_precision(calls),
        language="host",
        versions=versions(),
        abi_version=abi.ABI_VERSION,
        abi_hash=abi.abi_hash(),
        date=datetime.datetime.now().astimezone().isoformat(timespec="seconds"),
        values=tuple(values),
    )


class _Facts:
    """Precision and generation of a call in words."""

    def __init__(self, call: Call) -> None:
        self.precision = "single" if call.single else "double"
        self.generation = call.face.generation


__all__ = ["SCENARIOS", "Options", "check", "judge", "probe_path"]
