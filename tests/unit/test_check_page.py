# SPDX-License-Identifier: MIT
"""The HTML page of the conformance suite: what stands on it, and that it is a page by itself."""

import importlib.util
import math
import re
from html.parser import HTMLParser

import pytest

import usersub
from usersub.check import cases
from usersub.check.case import Case, Step, one
from usersub.check.page import history, page, pictures, safely, source, write
from usersub.check.page.figures import Refused
from usersub.check.page.html import Html, element, escaped, join, table
from usersub.check.reports.report import Head, Report, Result, Value
from usersub.check.subject import Subject
from usersub.errors import Error, MissingTool

pytest.importorskip("matplotlib")

_VOID = {"meta", "br", "hr", "path", "use", "rect"}

#: Mends nothing: Coulomb friction with its coefficient over the slip rate, and a fault on demand.
_ROUTINE = """
#include <math.h>
#include <stdlib.h>
#include <usersub/abi.h>

void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {
  for (int k = 0; k < *nContact; ++k) {
    const double rate = *dTimCur > 0 ? dSlipFric[*nFricDir * k] / *dTimCur : 0;
    const double mu = 0.1 + 0.2 * exp(-rate);
    double force = mu * fNormal[k] / (1 + 0.1 * fNormal[k]);
    if (props[0] == 1 && fNormal[k] > 1.5)
      abort();
    if (props[0] == 2)
      *(volatile int *)0 = 1;
    if (props[0] == 3)
      for (volatile int again = 1; again;)
        ;
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
"""


class Tags(HTMLParser):
    """Follows the tags of a page: all closed in order, identifiers once, text kept."""

    def __init__(self):
        super().__init__()
        self.open, self.seen, self.ids, self.links, self.text = [], [], [], [], []

    def handle_starttag(self, tag, attributes):
        self.seen.append((tag, dict(attributes)))
        for name, value in attributes:
            if name == "id":
                self.ids.append(value)
            if name in ("href", "src", "xlink:href", "action", "data", "poster", "srcset"):
                self.links.append(value)
        if tag not in _VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in _VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if tag not in _VOID:
            assert self.open and self.open.pop() == tag, f"</{tag}> closes nothing"

    def handle_data(self, data):
        self.text.append(data)

    def all(self, tag):
        return [attributes for name, attributes in self.seen if name == tag]


def parsed(text):
    tags = Tags()
    tags.feed(text)
    tags.close()
    assert tags.open == []
    return tags


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("routine") / "mine.c"
    path.write_text(_ROUTINE, encoding="utf-8")
    return usersub.load(path)


def subject_of(file, fault=0.0):
    routine = file["vfric"]
    return Subject(
        "mine.c", routine.interface, routine=routine, path=file.path, file=file, props=(fault,),
        temperatures=False,
    )  # fmt: skip


def head_of(name="mine", file="mine.c"):
    values = (Value("properties", "0.3", "given"), Value("slip", "0.01", "found by running it"))
    return Head(
        name, file, "vfric", "", "double", "c", "gcc 12.2", ("-O2",), {"usersub": "0.1"}, 1,
        "0123abcd", "2026-01-02T03:04:05", values,
    )  # fmt: skip


def result(rule, verdict, detail="", **more):
    return Result(rule, verdict, detail, f"What {rule} asks.", f"Why {rule}.", **more)


def report_of(subject, *results, head=None):
    return Report(head or head_of(file=str(subject.path)), results, seconds=1.5, subject=subject)


@pytest.fixture(scope="module")
def broken(file):
    """A report of every verdict and severity, and its page."""
    subject = subject_of(file)
    results = (
        result("zero.slip", "pass"),
        result(
            "frame.rotation", "fail", "force is (1, 2), expected (2, 1)", interface="vfric",
            case=cases.slipping(subject), where="mine.c:10", hint="Use the direction of the slip.",
            reproduction="import usersub.check\ncase = 1\nprint(case)",
            figures={"step": 3, "point": 0, "relative_error": [1e-3, 2.0]},
        ),
        result(
            "data.size", "fail", "17 MiB of static data, expected at most 16", severity="warning",
            output="hello from the routine",
        ),
        result(
            "blocks.permute", "fail", "known", expected=True, interface="vfric",
            case=cases.slipping(subject, 3),
        ),
        result("slip.sign", "pass", expected=True),
        result("memory.stack", "skip", "the routine crashed here"),
        result("tangent.slip", "not-applicable", "VFRIC has no tangent"),
    )  # fmt: skip
    report = report_of(subject, *results)
    return report, page([report])


def test_page_is_valid_and_alone(broken):
    tags = parsed(broken[1])
    assert len(tags.ids) == len(set(tags.ids)), "an identifier stands twice"
    assert all(link.startswith("#") for link in tags.links)
    assert {link[1:] for link in tags.links} <= set(tags.ids)
    assert not {"script", "link", "img", "iframe", "object"} & {tag for tag, _ in tags.seen}
    used = re.findall(r"url\(([^)]*)\)", broken[1])
    assert all(u.startswith("#") and u[1:] in tags.ids for u in used)
    assert "http" not in broken[1] and "@import" not in broken[1]


def test_page_is_accessible(broken):
    tags = parsed(broken[1])
    assert tags.all("html") == [{"lang": "en"}]
    assert len(tags.all("title")) == 1 == len(tags.all("h1")) == len(tags.all("main"))
    pictures = [a for a in tags.all("div") if a.get("role") == "img"]
    assert len(pictures) == len(tags.all("svg")) == len(tags.all("figure"))
    assert all(len(a["aria-label"]) > 30 for a in pictures)
    assert len(tags.all("caption")) == len(tags.all("table"))
    assert all(a.get("scope") in ("col", "row") for a in tags.all("th"))
    levels = [int(tag[1]) for tag, _ in tags.seen if re.fullmatch(r"h\d", tag)]
    assert all(b <= a + 1 for a, b in zip(levels, levels[1:], strict=False))
    assert "prefers-color-scheme: dark" in broken[1] and "@media print" in broken[1]


def test_failures_come_first_and_are_whole(broken):
    report, text = broken
    said = "".join(parsed(text).text)
    for failure in (*report.failures, *report.expected):
        for part in (failure.rule, failure.requirement, failure.detail, failure.reference):
            assert part in said
        assert failure.words in said
        assert failure.reproduction in said
    assert "Use the direction of the slip." in said and "hello from the routine" in said
    assert "-> 10 |     double force" in said and "   11 | " in said
    assert "marked: the fault, increment 4." in said
    assert "relative error" in said and "(0.001, 2)" in said
    parts = re.findall(r"<h3>([^<]*)</h3>", text)
    assert parts[0] == "Findings" and parts[-1] == "What was not checked, and why"
    titles = ["".join(parsed(t).text) for t in re.findall(r"<article[^>]*>\n?(<h4>.*?</h4>)", text)]
    assert [t.partition(" ")[2] for t in titles] == [
        "failure: frame.rotation", "warning: data.size", "failed as expected: blocks.permute"
    ]  # fmt: skip


def test_head_counts_and_foot(broken):
    report, text = broken
    said = "".join(parsed(text).text)
    for name, value in report.head.facts():
        assert name in said and value.partition(" (")[0] in said
    assert "found by running it" in said
    assert "1 failure, 1 warning, 1 failed as expected, 1 passed that were expected" in said
    foot = said[said.index("What was not checked, and why") :]
    assert "the routine crashed here" in foot and "VFRIC has no tangent" in foot
    for each in report.results:
        assert each.rule in said


def test_figures_of_the_routine(broken):
    said = "".join(parsed(broken[1]).text)
    for title in ("Response surface", "Hysteresis loop", "Friction force and stick force"):
        assert title in said
    assert "could not be drawn" not in said
    assert "slip rate [length per time]" in said and "normal force [force]" in said
    # Friction over load falls from 0.3 at rest to 0.1 as the rate grows, and with the load.
    found = re.search(r"Values from ([\d.e-]+) to ([\d.e-]+): friction force over", said)
    assert float(found[1]) == pytest.approx(0.1 / 2, rel=1e-6)  # load 10, rate 40
    assert float(found[2]) == pytest.approx(0.3 / 1.01, rel=1e-3)  # load 0.1, rate 4e-5


def test_page_is_deterministic(broken):
    report, text = broken
    assert page([report]) == text


def test_several_reports():
    failed = result("slip.sign", "fail", "wrong sign", case=one((0.01, 0.0)))
    text = page([Report(head_of(), (failed,))] * 2)
    tags = parsed(text)
    assert len(tags.ids) == len(set(tags.ids))
    assert "Reports on this page" in text and "#report-2" in text


def test_user_text_is_escaped(tmp_path):
    evil = "<script>alert('x')</script>&\x00\ud800"
    case = one((0.01, 0.0))
    results = (
        result(evil, "fail", evil, where=f"{evil}:3", hint=evil, reproduction=evil, case=case,
               figures={evil: evil}, output=evil),
        result("memory.stack", "skip", evil),
        result("tangent.slip", "not-applicable", evil),
    )  # fmt: skip
    head = head_of(evil, evil)
    report = Report(head, results, notes=(evil,))
    write([report], tmp_path / "page.html")
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    tags = parsed(text)
    assert "<script" not in text and "\x00" not in text
    assert "script" not in {tag for tag, _ in tags.seen}
    assert "<script>alert('x')</script>&" in "".join(tags.text)


def test_report_without_subject():
    """As of a host, or from another process: no figures, the rest as ever."""
    report = Report(head_of(), (result("host.axes", "fail", "t1 has length 2, expected 1"),))
    said = "".join(parsed(page([report])).text)
    assert "t1 has length 2" in said and "What the routine does" not in said


@pytest.mark.parametrize(
    ("results", "outcome"),
    [
        ((("pass", {}),), "\u2713 No errors were found."),
        ((("fail", {"severity": "warning"}), ("pass", {})), "\u2713 No errors were found."),
        ((("fail", {}), ("pass", {})), "\u2717 The contract is broken."),
        ((("fail", {"expected": True}),), "\u2713 No errors were found."),
        ((("pass", {"expected": True}),), "\u2717 No errors were found, but a failure"),
        ((("skip", {}), ("not-applicable", {})), "? Nothing could be checked."),
    ],
)
def test_outcome(results, outcome):
    made = tuple(result(f"slip.rule{k}", v, **more) for k, (v, more) in enumerate(results))
    assert outcome in "".join(parsed(page([Report(head_of(), made)])).text)


def test_nothing_checked():
    assert "nothing was checked" in page([])
    text = page([Report(head_of())])
    said = "".join(parsed(text).text)
    assert "Nothing could be checked" in said and "Every rule was checked" not in said


def test_without_matplotlib(monkeypatch, tmp_path):
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name: None if name == "matplotlib" else find(name)
    )
    with pytest.raises(MissingTool, match=r"pip install 'usersub\[report\]'"):
        write([], tmp_path / "page.html")
    assert not list(tmp_path.iterdir())


def test_page_that_cannot_be_written(tmp_path):
    with pytest.raises(Error, match="cannot be written"):
        write([], tmp_path / "no" / "page.html")


@pytest.mark.parametrize("fault", [2.0, 3.0], ids=["crash", "endless"])
def test_routine_that_cannot_be_run(file, fault, monkeypatch):
    monkeypatch.setattr(safely, "_FIGURE", 0.3)
    subject = subject_of(file, fault)
    failed = result(
        "process.crash", "fail", "it crashed", interface="vfric", case=cases.slipping(subject)
    )
    text = page([report_of(subject, failed)])
    said = "".join(parsed(text).text)
    assert said.lower().count("could not be drawn") == 5  # four figures and the response
    assert "no answer" in said  # the case itself is drawn


def test_response_up_to_the_crash(file):
    subject = subject_of(file, 1.0)
    steps = tuple(Step(((0.01, 0.0),), (load,)) for load in (0.5, 1.0, 2.0, 1.0))
    from functools import partial

    works = {"case": partial(history.answers, subject, Case(steps))}
    tried = safely.Budget().tried(works)["case"]
    forces = [piece["response"][0][0] for piece in tried.data]
    mu = 0.1 + 0.2 * math.exp(-0.04)
    assert forces == pytest.approx([mu * p / (1 + 0.1 * p) for p in (0.5, 1.0)], rel=1e-12)
    assert "could not be drawn" in tried.reason


def test_work_that_ends_its_process():
    import os

    def leave():
        os._exit(3)

    def refuse():
        raise Refused("nothing here")

    tried = safely.Budget().tried({"left": leave, "refused": refuse, "done": lambda: {"x": 1}})
    assert "exit code 3" in tried["left"].reason
    assert tried["refused"].reason == "nothing here"
    assert tried["done"] == safely.Tried(({"x": 1},))


def test_budget_of_a_page():
    spent = safely.Budget(0.0).tried({"a": lambda: {"x": 1}})
    assert not spent["a"].data and "took too long" in spent["a"].reason


@pytest.mark.parametrize(
    "case",
    [
        one((math.nan, 0.0), (1e308, 1e308), (1e308, 1e308)),
        one((5e-324, 0.0), load=5e-324),
        one((0.0,), load=math.inf),
        Case((Step(((0.0, 0.0),) * 40, (1.0,) * 40),)),
    ],
    ids=["overflow", "denormal", "infinite", "many"],
)
def test_extreme_cases_are_drawn(file, case):
    failed = result("extremes.finite", "fail", "not finite", interface="vfric", case=case)
    drawn = pictures.of_case(subject_of(file), failed, safely.Budget(), "here")
    parsed(drawn)
    assert "nan" not in "".join(re.findall(r' d="([^"]*)"', drawn))


@pytest.mark.parametrize(
    ("figures", "step", "point", "sure"),
    [
        ({"step": 1, "point": 2}, 1, 2, True),
        ({}, 2, 0, False),
        ({"step": 9, "point": 0}, 2, 0, False),
        ({"step": 1}, 2, 0, False),
        ({"step": "x", "point": None}, 2, 0, False),
    ],
)
def test_mark(figures, step, point, sure):
    steps = (Step(((0.0, 0.0),) * 3, (1.0,) * 3),) * 3
    assert history.mark_of(Case(steps), figures) == history.Mark(step, point, sure, 3)


def test_excerpt(tmp_path):
    path = tmp_path / "long.f"
    path.write_bytes("\n".join(f"line {n}" for n in range(1, 13)).encode() + b"\n\xff\n")
    lines = source.excerpt("long.f:9", str(path)).splitlines()
    assert lines[4] == "->  9 | line 9" and lines[0] == "    5 | line 5" and len(lines) == 9
    assert source.excerpt(f"{path}:1", "").splitlines()[0] == "-> 1 | line 1"
    for nowhere in ("long.f", "long.f:99", "none.f:1", "", ":3"):
        assert source.excerpt(nowhere, str(path)) == ""


def test_html_pieces():
    assert element("p", "a < b", Html("<br>")) == "<p>a &lt; b<br></p>"
    assert (
        element("a", "x", href='"&', class_="c", id=None) == '<a href="&quot;&amp;" class="c">x</a>'
    )
    assert escaped(Html("<b>")) == "<b>" and join(["a", "", "<"], " ") == "a &lt;"
    assert 'scope="row">r</th><td>1</td>' in table("c", ("n", "v"), [("r", "1")])
