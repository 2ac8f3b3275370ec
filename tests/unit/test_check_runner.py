# SPDX-License-Identifier: MIT
"""The runner: verdicts of rules, and of routines that end the process of a rule."""

from __future__ import annotations

import ctypes
import os
import resource
import time

import numpy as np
import pytest
from bad_routines import rule, session, write

from usersub.check import cases, runner
from usersub.check.case import one
from usersub.check.rule import FAIL, NOT_APPLICABLE, PASS, SKIP, CannotCheck, Finding, NotApplicable
from usersub.check.runner import check, selected
from usersub.check.running.expectations import Expectation
from usersub.check.source.meant import meant
from usersub.check.subjects import targets
from usersub.check.subjects.prepare import prepared
from usersub.errors import CompileError, LoadError, RoutineError, SceneError


def _nothing(subject):
    return None


def _raises(error):
    def look(subject):
        raise error

    return look


def _runs(subject):
    """A rule that only runs the routine."""
    for answer in subject.respond(cases.slipping(subject)):
        if answer.failure is not None:
            raise CannotCheck(str(answer.failure))


#: What deaths are about.
ABOUT = [
    rule(id, _nothing)
    for id in (
        "memory.heap", "memory.stack", "process.crash", "process.stop", "process.returns",
    )
]  # fmt: skip


@pytest.fixture(scope="module")
def healthy(tmp_path_factory):
    return write(tmp_path_factory.mktemp("healthy"), "healthy")


@pytest.fixture
def checks(healthy):
    return session(healthy)


def verdicts_of(checks, *rules):
    report = checks.report(list(rules))
    return [(r.rule, r.verdict, r.detail) for r in report.results]


def test_verdicts_in_the_order_of_the_rules(checks):
    found = verdicts_of(
        checks,
        rule("a.fails", lambda s: [Finding("mu is 3, expected 0.3")]),
        rule("a.passes", _nothing),
        rule("a.passes-too", lambda s: iter(())),
        rule("a.not", _raises(NotApplicable("there is one direction"))),
        rule("a.cannot", _raises(CannotCheck("gfortran is missing"))),
        rule("a.error", _raises(RoutineError("the routine raised"))),
        rule("a.other", lambda s: None, interfaces=("fric",)),
        rule("a.fortran", lambda s: None, languages=("fortran",)),
    )
    assert found == [
        ("a.fails", FAIL, "mu is 3, expected 0.3"),
        ("a.passes", PASS, ""),
        ("a.passes-too", PASS, ""),
        ("a.not", NOT_APPLICABLE, "there is one direction"),
        ("a.cannot", SKIP, "gfortran is missing"),
        ("a.error", SKIP, "it could not be checked: the routine raised"),
        ("a.other", NOT_APPLICABLE, "it is about FRIC"),
        ("a.fortran", NOT_APPLICABLE, "it is about routines in fortran"),
    ]


def test_a_fault_of_a_rule_is_no_fault_of_the_routine(checks):
    report = checks.report([rule("a.broken", lambda s: 1 / 0)])
    result = report["a.broken"]
    assert result.verdict == SKIP and "a fault of usersub" in result.detail
    assert "ZeroDivisionError" in result.output and report.ok()


def test_only_the_first_finding_counts(checks):
    def look(subject):
        yield Finding("the first")
        time.sleep(60)

    (found,) = verdicts_of(checks, rule("a.two", look))
    assert found == ("a.two", FAIL, "the first")


def test_a_finding_keeps_all_that_belongs_to_it(checks):
    case = one((1e-2, 0.0), load=2.0)
    finding = Finding(
        "sentence", case, "law.c:7", "change it", {"error": np.array([1.0, np.inf]), "step": 1}
    )
    result = checks.report([rule("a.whole", lambda s: [finding], severity="warning")])["a.whole"]
    assert (result.case, result.where, result.hint) == (case, "law.c:7", "change it")
    assert result.figures["error"] == [1.0, np.inf] and result.figures["step"] == 1
    assert (result.interface, result.precision, result.severity) == (
        "vfric_coef", "double", "warning",
    )  # fmt: skip
    assert result.requirement == "a.whole holds." and result.finding == Finding(
        "sentence", case, "law.c:7", "change it", result.figures
    )


# Routines that end the process.


def test_a_death_fails_the_rule_that_it_is_about(tmp_path):
    checks = session(write(tmp_path, "exits"))
    harmless = rule("z.harmless", _nothing)
    report = checks.report([*ABOUT, rule("a.runs", _runs), rule("b.runs", _runs), harmless])
    result = report["process.stop"]
    assert result.verdict == FAIL and "exit code 0" in result.detail
    assert (result.case.points, result.case.directions, len(result.case.steps)) == (1, 1, 2)
    assert [r.rule for r in report.failures] == ["process.stop"]
    for id in ("a.runs", "b.runs"):
        assert report[id].verdict == SKIP and "see process.stop" in report[id].detail
    assert report["z.harmless"].verdict == PASS
    assert not report.ok()


def _frees_twice(subject):
    library = ctypes.CDLL(None)
    library.malloc.restype, library.free.argtypes = ctypes.c_void_p, [ctypes.c_void_p]
    place = library.malloc(40)
    library.free(place)
    library.free(place)


@pytest.mark.parametrize(
    ("look", "guilty", "words"),
    [
        (_frees_twice, "memory.heap", "double free"),
        (lambda s: ctypes.CDLL(None).__stack_chk_fail(), "memory.stack", "stack smashing"),
        (lambda s: ctypes.string_at(8), "process.crash", "SIGSEGV"),
        (lambda s: ctypes.CDLL(None).abort(), "process.stop", "abort"),
    ],
)
def test_what_a_death_is_about_is_read_from_its_last_words(checks, look, guilty, words):
    report = checks.report([*ABOUT, rule("a.dies", look)])
    assert [r.rule for r in report.failures] == [guilty]
    assert words in report[guilty].detail and report[guilty].case is None


def test_damage_that_shows_after_the_rule_has_passed(checks):
    def look(subject):
        library = ctypes.CDLL(None)
        library.malloc.restype = ctypes.c_void_p
        ctypes.memset([library.malloc(100_000) for _ in range(60)][-1], 65, 100_100)

    report = checks.report([*ABOUT, rule("a.damages", look)])
    assert [r.rule for r in report.failures] == ["memory.heap"]
    assert report["a.damages"].verdict == PASS


def test_an_endless_loop_fails_the_rule_on_returning(tmp_path):
    checks = session(write(tmp_path, "loops"))
    runs = [rule(f"a.runs{k}", _runs, seconds=0.5) for k in range(3)]
    report = checks.report([*ABOUT, *runs, rule("z.harmless", _nothing)])
    assert report["process.returns"].verdict == FAIL
    assert "had not returned after" in report["process.returns"].detail
    # The first increment has no motion, and the routine loops where there is some.
    whole = cases.slipping(checks.subject)
    assert report["process.returns"].case == whole.but(steps=whole.steps[:2])
    assert all("see process.returns" in report[r.id].detail for r in runs)
    assert report["z.harmless"].verdict == PASS


def test_a_slow_rule_is_no_endless_loop(checks):
    slow = rule("a.slow", lambda s: time.sleep(30), seconds=0.2)
    report = checks.report([*ABOUT, slow])
    assert report["a.slow"].verdict == SKIP and report.ok()
    assert report["process.returns"].verdict == PASS


def test_a_death_without_a_case_is_told_without_one(checks):
    report = checks.report([*ABOUT, rule("a.dies", lambda s: os.abort())])
    assert report["process.stop"].verdict == FAIL and report["process.stop"].case is None


def test_a_death_fails_the_rule_itself_where_no_other_is_asked_for(tmp_path):
    checks = session(write(tmp_path, "exits"))
    assert checks.report([rule("a.runs", _runs)])["a.runs"].verdict == FAIL


def test_a_death_is_told_once_where_memory_has_failed(tmp_path):
    checks = session(write(tmp_path, "exits"))
    outside = rule("memory.outside", lambda s: [Finding("tau(9) was written")])
    report = checks.report([outside, *ABOUT, rule("a.runs", _runs)])
    assert [r.rule for r in report.failures] == ["memory.outside"]
    assert report["a.runs"].detail.endswith("see memory.outside")


def test_children_of_a_routine_do_not_stay(tmp_path):
    checks = session(write(tmp_path, "leaves_child"))
    assert checks.report([rule("a.runs", _runs)])["a.runs"].verdict == PASS


def test_a_single_rule(tmp_path, checks):
    assert checks.one(rule("a.passes", _nothing)).verdict == PASS
    dead = session(write(tmp_path, "exits")).one(rule("a.runs", _runs))
    assert dead.verdict == FAIL and "exit code 0" in dead.detail


@pytest.mark.parametrize("group", ["a", "repeat"])
def test_time_is_shared_out(healthy, group):
    checks = session(healthy, seconds=2.0, workers=1)
    slow = [rule(f"{group}.slow{k}", lambda s: time.sleep(1.0)) for k in range(8)]
    report = checks.report(slow)
    assert report.results[0].verdict == PASS
    assert report.results[-1].verdict == SKIP and "no time was left" in report.results[-1].detail


# Lists.


def test_skipped_and_expected(healthy):
    checks = session(
        healthy,
        skip=[Expectation("a.skipped", reason="not yet", place="list:1")],
        expect=[Expectation("b"), Expectation("c.*", "fric"), Expectation("d.gone")],
    )
    fails = [Finding("no")]
    report = checks.report(
        [
            rule("a.skipped", lambda s: fails),
            rule("b.fails", lambda s: fails),
            rule("b.passes", _nothing),
            rule("c.fails", lambda s: fails),
        ]
    )
    assert report["a.skipped"].detail == "left out as asked list:1 (not yet)"
    assert [r.rule for r in report.expected] == ["b.fails"]
    assert [r.rule for r in report.surprises] == ["b.passes"]
    assert [r.rule for r in report.failures] == ["c.fails"]
    assert any("'d.gone'" in note for note in report.notes)


def test_an_expected_failure_that_passes_is_not_all_right(healthy):
    checks = session(healthy, expect=[Expectation("b.passes")])
    report = checks.report([rule("b.passes", _nothing)])
    assert not report.failures and not report.ok()


def test_rules_are_chosen_by_identifier_group_and_pattern():
    every = [r.id for r in selected(None)]
    assert [r.id for r in selected(["repeat.same"])] == ["repeat.same"]
    assert [r.id for r in selected("repeat")] == [i for i in every if i.startswith("repeat.")]
    assert [r.id for r in selected(["*.same", "blocks"])] == [
        i for i in every if i.endswith(".same") or i.startswith("blocks.")
    ]
    with pytest.raises(LoadError, match="no rule is called 'repeat.sam'; did you mean"):
        selected(["repeat.sam"])


# Targets.


def only(target, **options):
    """The reports of a target, of one rule that needs nothing."""
    return check(target, rules=["repeat.same"], **options)


def test_the_built_in_laws_by_name():
    reports = only("coulomb", interface="vfric_coef")
    assert [r.head.interface for r in reports] == ["vfric_coef"]
    assert reports[0].head.law == "coulomb" and reports[0].ok()
    assert reports[0].subject.props == (0.3,)


def test_a_law_object_brings_its_properties():
    from usersub import laws

    (report,) = only(laws.coulomb(mu=0.125).in_language("c"), interface="fric")
    assert report.subject.props == (0.125,) and report.head.language == "c"


def test_both_precisions(healthy):
    reports = only(healthy, precision="both", props=[0.3], states=0, fields=0)
    assert [r.head.precision for r in reports] == ["double", "single"]
    assert all(r.results[0].precision == r.head.precision for r in reports)


def test_a_routine_without_a_file():
    import usersub

    @usersub.vfric_coef(compiled=False)
    def mine(fCoef, props):
        fCoef[:] = props[0]

    (report,) = only(mine, props=[0.3])
    assert report.head.routine == "mine" and report.head.language == "python"


def test_a_law_function_behind_all_its_interfaces(monkeypatch):
    import usersub

    @usersub.coefficient(props=1)
    def mine(props):
        return props[0]

    monkeypatch.setattr(targets, "_ready", lambda routine, precision: (routine, None))
    found = list(targets.subjects(mine, targets.wishes(precision="both")))
    assert [(s.interface.name, s.precision) for s in found] == [
        ("fric", "double"), ("fric_coef", "double"), ("vfric", "double"), ("vfric", "single"),
        ("vfriction", "double"), ("vfriction", "single"),
        ("vfric_coef", "double"), ("vfric_coef", "single"),
    ]  # fmt: skip
    assert {s.path.name for s in found} == {"test_check_runner.py"}


def test_a_file_that_does_not_compile_is_still_looked_at(tmp_path):
    path = tmp_path / "broken.c"
    path.write_text("#include <usersub/abi.h>\nvoid vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {\n")
    (report,) = check(path, rules=["signature.count", "repeat"])
    assert report.head.interface == "vfric_coef" and report.subject.failure is not None
    assert report["repeat.same"].verdict == SKIP
    assert "the routine cannot be loaded" in report["repeat.same"].detail


def test_a_file_without_an_interface_cannot_be_looked_at(tmp_path):
    path = tmp_path / "empty.c"
    path.write_text("int x;\n")
    with pytest.raises(LoadError, match="none of the interfaces"):
        only(path)
    path.write_text("int x\n")
    with pytest.raises(CompileError):
        only(path)
    with pytest.raises(LoadError, match="there is no file"):
        only(tmp_path / "gone.c")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("while True: pass", "had not returned after"),
        ("import os; os._exit(0)", "ended the whole process"),
        ("import ctypes; ctypes.string_at(8)", "crashed with SIGSEGV"),
        ("import sys; sys.exit(3)", "SystemExit"),
        ("1 / 0", "ZeroDivisionError"),
    ],
)
def test_a_python_file_that_does_not_let_itself_be_loaded(tmp_path, monkeypatch, text, words):
    monkeypatch.setattr(targets, "_SECONDS", 0.5)
    file = tmp_path / "bad.py"
    file.write_text(text + "\n")
    with pytest.raises(LoadError, match=words):
        only(file)


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({"precision": "quad"}, SceneError, "precision is 'quad', expected double, single, both"),
        ({"interface": "frik"}, LoadError, "'frik' is not an interface"),
        ({"law": "coulom"}, LoadError, "did you mean 'coulomb'"),
        ({"props": ["a"]}, SceneError, "props is ['a'], expected finite numbers"),
        ({"props": [float("nan")]}, SceneError, "props is [nan], expected finite numbers"),
        ({"generation": "2030"}, SceneError, "expected 'legacy' or '2022'"),
        ({"states": -1}, SceneError, "states is -1"),
        ({"rules": ["nothing.there"]}, LoadError, "no rule is called"),
        ({"interface": "fric", "precision": "single"}, SceneError, "FRIC are double"),
    ],
)
def test_values_that_cannot_be(options, error, words):
    with pytest.raises(error) as raised:
        check("coulomb", **{"rules": ["repeat.same"], **options})
    assert words in str(raised.value)


def test_progress_is_told(checks):
    told = []
    rules = [rule("a.one", _nothing), rule("a.two", _nothing)]
    checks.report(rules, lambda done, total, now: told.append((done, total, now)))
    assert told[0][:2] == (0, 2) and [t[:2] for t in told[1:]] == [(1, 2), (2, 2)]


def test_a_healthy_law_takes_little_time():
    """Processor time, since the machine may be busy with other things."""

    def used():
        return sum(
            sum(resource.getrusage(who)[:2])
            for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
        )

    before = used()
    runner.check("coulomb", interface="vfric_coef")
    assert used() - before < 15.0  # two cores for 30 s, at a quarter of it


def test_rules_share_processes_where_that_changes_nothing(checks, tmp_path):
    def tells_its_process(subject):
        raise NotApplicable(str(os.getpid()))

    ids = ("a.one", "repeat.own", "a.two", "memory.heap", "b.three", "b.four", "c.five")
    rules = [rule(id, tells_its_process) for id in ids]

    def processes(session):
        found = {r.rule: r.detail for r in session.report(rules).results}
        assert list(found) == list(ids)
        return found

    found = processes(session(checks.subject.path, workers=1))
    shared = [found[id] for id in ids if id not in ("repeat.own", "memory.heap")]
    assert len(set(shared)) == 2 and len(set(found.values())) == 4
    keeps = tmp_path / "keeps.c"
    keeps.write_text(
        "#include <usersub/abi.h>\nstatic int calls;\n"
        "void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {\n  fCoef[0] = ++calls;\n}\n"
    )
    assert len(set(processes(session(keeps, workers=1)).values())) == len(ids)


def test_a_process_that_rules_share_may_die(tmp_path):
    checks = session(write(tmp_path, "exits"), workers=1)
    rules = [rule(f"a.{k}", _nothing) for k in range(3)]
    rules[1:1] = [rule("a.runs", _runs)]
    report = checks.report([*rules, *ABOUT])
    assert [r.verdict for r in report.results[:4]] == [PASS, SKIP, PASS, PASS]
    assert [r.rule for r in report.failures] == ["process.stop"]


def test_a_process_that_cannot_be_started(checks, monkeypatch):
    def broken(home, seconds):
        os._exit(70)

    monkeypatch.setattr("usersub.check.running.inside._settle", broken)
    report = checks.report([rule("a.one", _nothing), rule("a.two", _nothing)])
    assert all("could not be started" in r.detail for r in report.results)


def test_what_was_found_in_a_damaged_process_is_looked_at_again(checks):
    damaged = []

    def damages(subject):
        damaged.append(True)
        yield Finding("tau(9) was written")

    def misled(subject):
        return [Finding("it fails")] if damaged else None

    rules = [rule("memory.outside", damages), rule("a.misled", misled)]
    report = session(checks.subject.path, workers=1).report([*rules, rule("a.other", _nothing)])
    assert [r.rule for r in report.failures] == ["memory.outside"]


# What is found out.


def _found(folder, what, **given):
    wish = targets.wishes("vfric_coef", **given)
    (subject,) = targets.subjects(write(folder, what), wish)
    return prepared(subject, 20.0)


def test_what_is_given_stays(tmp_path):
    found = _found(tmp_path, "healthy", props=[1.0, 2.0], fields=3, scales={"slip": 2.5})
    assert (found.props, found.fields, found.scales.slip) == ((1.0, 2.0), 3, 2.5)
    assert {found.origin[name] for name in ("props", "fields", "scales")} == {"given"}
    assert found.routine is not None and found.path == tmp_path / "healthy.c"


def test_what_is_not_given_is_found_out_and_told(tmp_path):
    found = _found(tmp_path, "healthy")
    assert (found.props, found.fields, found.temperatures) == ((), 0, False)
    assert all(found.origin[name] for name in ("props", "fields", "temperatures"))


def test_a_routine_that_ends_the_process_does_not_end_the_check(tmp_path):
    found = _found(tmp_path, "exits")
    assert found.props == () and "ended the" in found.origin["props"]


def test_a_fault_of_the_search_leaves_the_defaults(tmp_path, monkeypatch):
    monkeypatch.setattr("usersub.check.subjects.tracing.find", lambda subject, given: 1 / 0)
    found = _found(tmp_path, "healthy")
    assert "could not be found out" in found.origin["props"]
    assert "a fault of usersub" in found.origin["scales"]


def test_a_death_in_the_search_leaves_what_was_found_before(tmp_path, monkeypatch):
    monkeypatch.setattr("usersub.check.subjects.scales.find", lambda subject: os.abort())
    found = _found(tmp_path, "healthy")
    assert "traced" in found.origin["props"] and "SIGABRT" in found.origin["scales"]


def test_nothing_is_found_out_of_a_routine_that_cannot_be_loaded(tmp_path):
    path = tmp_path / "broken.c"
    path.write_text("#include <usersub/abi.h>\nvoid vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {\n")
    (subject,) = targets.subjects(path, targets.wishes())
    assert prepared(subject, 5.0) is subject


def test_the_head_tells_what_the_routine_was_run_with(checks):
    facts = dict(checks.report([rule("a.passes", _nothing)]).head.facts())
    assert facts["properties"] == "0.3 (given)" and facts["routine"] == "healthy.c"
    assert facts["language"] == "c" and "-O" in facts["flags"] and facts["compiler"]
    assert "numpy" in facts["versions"] and "hash" in facts["tables"]
    assert facts["scales"].startswith("slip 0.01, stick 0, load 1, dt 0.25")


# Files in which nothing can be loaded.


@pytest.mark.parametrize(
    ("name", "text", "interfaces"),
    [
        ("a.f", "      SUBROUTINE FRIC(LM)\n      END\n      SUBROUTINE VFRIC(F)\n      END\n",
         ["fric", "vfric"]),
        ("a.f90", "module m\ncontains\n  subroutine vfriction(f)\n  end\nend\n", ["vfriction"]),
        ("a.c", "void FOR_NAME(fric_coef, FRIC_COEF)(double *fCoef) {}\n", ["fric_coef"]),
        ("a.cpp", "void vfric_coef(float *fCoef) {}\n", ["vfric_coef"]),
        ("a.py", "import usersub\n@usersub.vfric\ndef mine(fTangential): ...\n", ["vfric"]),
        ("a.f", "      SUBROUTINE VFRICTON(FTANGENTIAL)\n      END\n", ["vfriction"]),
        ("a.py", "def mine(fTangential, dSlipFric, fStickForce, nSlvNod): ...\n", ["vfric"]),
        ("vfric_coef.py", "def mine(fCoef, slipRate, props): ...\n", ["vfric_coef"]),
        ("a.f", "      SUBROUTINE UMAT(STRESS)\n      END\n", []),
        ("a.c", "int x;\n", []),
    ],
)  # fmt: skip
def test_what_a_file_is_meant_for(tmp_path, name, text, interfaces):
    file = tmp_path / name
    file.write_text(text)
    assert list(meant(file)) == interfaces


# Failures that only follow from others.

_OUTSIDE = """\
#include <usersub/abi.h>
void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {
  for (int k = 0; k < *nBlock; ++k)
    fCoef[k] = *nBlock > 1 ? slipRate[*nBlock] : 0.3;
}
"""


@pytest.fixture(scope="module")
def reading_outside(tmp_path_factory):
    file = tmp_path_factory.mktemp("outside") / "outside.c"
    file.write_text(_OUTSIDE)
    return file


def _fails_at(case_of):
    return lambda subject: [Finding("it fails", case_of(subject))]


def test_a_failure_that_follows_from_a_fault_of_memory(reading_outside):
    rules = [
        rule("memory.outside", lambda s: [Finding("slipRate(8) was read")]),
        rule("frame.follows", _fails_at(lambda s: cases.slipping(s, 7))),
        rule("frame.own", _fails_at(lambda s: cases.slipping(s, 1))),
        rule("frame.no-case", lambda s: [Finding("it fails")]),
        rule("signature.count", _fails_at(lambda s: cases.slipping(s, 7))),
    ]
    report = session(reading_outside).report(rules)
    assert {r.rule for r in report.failures} == {
        "memory.outside", "frame.own", "frame.no-case", "signature.count",
    }  # fmt: skip
    follows = report["frame.follows"]
    assert follows.verdict == SKIP and follows.case is None
    assert "touches memory outside of the arguments" in follows.detail
    assert "slipRate(8), of which there are 7" in follows.detail
    assert follows.detail.endswith("see memory.outside")


def test_what_follows_from_results_that_are_not_repeated(checks, monkeypatch):
    fails = [Finding("it fails")]
    ids = ("repeat.same", "repeat.threads", "data.uninitialised", "frame.own", "history.own")
    rules = [rule(id, lambda s: fails) for id in ids]

    def failures(rules):
        return [r.rule for r in session(checks.subject.path).report(rules).failures]

    # Without data that outlive a call it is the local variables that differ.
    assert failures(rules) == ["data.uninitialised", "frame.own", "history.own"]
    assert failures([r for r in rules if r.id != "data.uninitialised"]) == [
        "repeat.same", "history.own",
    ]  # fmt: skip
    monkeypatch.setattr("usersub.check.running.consequences._keeps", lambda subject: True)
    assert failures(rules) == ["repeat.same", "history.own"]


def test_a_stop_that_another_rule_meets(tmp_path):
    file = tmp_path / "stops.c"
    file.write_text(
        "#include <stdlib.h>\n#include <usersub/abi.h>\n"
        "void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {\n"
        "  if (slipRate[0] > 0.0)\n    exit(3);\n  fCoef[0] = 0.3;\n}\n"
    )
    rules = [*ABOUT, rule("frame.runs", _runs), rule("extremes.runs", _runs)]
    report = session(file).report(rules)
    assert [r.rule for r in report.failures] == ["process.stop"]
    assert "exit" in report["process.stop"].detail and report["process.stop"].case is not None
    only_extreme = session(file).report([r for r in rules if r.id != "frame.runs"])
    assert not only_extreme.failures


def test_a_loop_at_some_loads_only(tmp_path):
    file = tmp_path / "loops.c"
    file.write_text(
        "#include <usersub/abi.h>\nvoid vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {\n"
        "  for (int k = 0; k < *nBlock; ++k) {\n    fCoef[k] = 0.3;\n"
        "    while (pressure[k] > 20.0 && pressure[k] < 20.3)\n"
        '      __asm__ volatile("");\n  }\n}\n'
    )

    def many(subject):
        subject.but(tell=None).respond(cases.slipping(subject, 512))

    report = session(file).report([*ABOUT, rule("a.many", many, seconds=0.5)])
    found = report["process.returns"]
    assert found.verdict == FAIL and found.case.points == 1
    assert 20.0 < found.case.steps[-1].load[0] < 20.3
    assert report["a.many"].detail.endswith("see process.returns")


def test_nothing_follows_where_no_rule_on_memory_failed(reading_outside):
    rules = [rule("frame.fails", _fails_at(lambda s: cases.slipping(s, 7)))]
    assert session(reading_outside).report(rules)["frame.fails"].verdict == FAIL


def test_single_rules_know_of_those_before_them(reading_outside):
    checks = session(reading_outside)
    fails = rule("frame.fails", _fails_at(lambda s: cases.slipping(s, 7)))
    assert checks.one(fails).verdict == FAIL
    checks.one(rule("memory.outside", lambda s: [Finding("slipRate(8) was read")]))
    assert checks.one(fails).verdict == SKIP
