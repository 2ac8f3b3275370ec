# SPDX-License-Identifier: MIT
"""The page of a study and the chapter on accuracy."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path

import pytest

from tests.unit.study_results import cell, ladder, limit, refused, result, saving
from usersub.errors import MissingTool
from usersub.study import accuracy, canvas, page, tables

pytest.importorskip("matplotlib")

_EVIL = "<script>alert('&')</script>"


class _Reader(HTMLParser):
    """Checks that elements are closed in order; collects ids, links, tags and text."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: set[str] = set()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.text = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.ids += [value or "" for name, value in attrs if name == "id"]
        self.links += [value or "" for name, value in attrs if name in ("href", "src")]
        if tag not in ("meta", "br", "hr"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data


def _read(text: str) -> _Reader:
    reader = _Reader()
    reader.feed(text)
    reader.close()
    assert reader.open == []
    return reader


@pytest.fixture(scope="module")
def whole() -> _Reader:
    runs = [
        *ladder(2), *ladder(4, 1e-5, method=_EVIL, law=_EVIL), refused(_EVIL, law=_EVIL),
        result(block=1), result(block=64),
    ]  # fmt: skip
    return _read(page.page(
        runs, {"machine": _EVIL, "date": "2026-01-02"},
        savings=[saving(scene=_EVIL)],
        cells=[cell("slip", "bounded", reason=_EVIL), cell(_EVIL, "refused", subject=_EVIL)],
        limits=[limit(1.01, 1.0, words=_EVIL)],
        missing=[f"Nothing of {_EVIL}."],
        title=_EVIL,
    ))  # fmt: skip


def test_all_text_is_escaped(whole: _Reader) -> None:
    assert "script" not in whole.tags
    assert whole.text.count(_EVIL) > 10


def test_page_needs_nothing_else(whole: _Reader) -> None:
    assert whole.tags.isdisjoint({"script", "link", "img", "iframe", "object"})
    assert all(link.startswith("#") for link in whole.links)
    assert {link[1:] for link in whole.links} <= set(whole.ids)
    assert len(whole.ids) == len(set(whole.ids))


def test_page_has_every_part(whole: _Reader) -> None:
    for words in (
        "machine", "2026-01-02", "Recommendation", "For an error of 1e-3 use", "Leaving out",
        "Stability", "Limits", "Refused, and why", "Not measured", "Nothing of",
        "No runs of these languages: Fortran and Python.", "Observed orders.",
    ):  # fmt: skip
        assert words in whole.text, words
    assert "svg" in whole.tags and "figure" in whole.tags


def test_summary_counts_what_has_an_error() -> None:
    runs = [result(), result(error=float("nan")), refused("no law")]
    assert "1 of 3 runs of 1 problem have an error." in _read(page.page(runs, {})).text


def test_page_of_nothing() -> None:
    assert "Nothing was run." in _read(page.page([], {"machine": "one"})).text


def test_page_of_stability_alone() -> None:
    text = _read(page.page([], {}, cells=[cell("slip", "stable")])).text
    assert "1 stiff and extreme cases: 1 stable." in text
    assert "Recommendation" not in text


def test_page_is_the_same_every_time(tmp_path: Path) -> None:
    runs = [*ladder(2), result(block=1), result(block=8)]
    for name in ("a.html", "b.html"):
        page.write(tmp_path / name, runs, {"machine": "one"}, savings=[saving()])
    assert (tmp_path / "a.html").read_bytes() == (tmp_path / "b.html").read_bytes()


def test_missing_matplotlib_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(canvas.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(MissingTool, match="matplotlib"):
        page.write(tmp_path / "page.html", [result()], {})
    assert not list(tmp_path.iterdir())


def test_chapter_has_its_tables_and_figures(tmp_path: Path) -> None:
    runs = [*ladder(2), *ladder(0, 1e-16, problem="P1"), refused("no | law", problem="P3")]
    page_file, *drawn = accuracy.write(runs, {"machine": "one"}, tmp_path)
    text = page_file.read_text(encoding="utf-8")
    assert not re.search(r"@\w+@", text)
    assert "10 runs of 3 problems gave an error and a run time, 1 did not. machine: one." in text
    named = re.findall(r"\]\((figures/[^)]+\.svg)\)", text)
    assert [tmp_path / name for name in named] == drawn
    assert all(path.stat().st_size > 1000 for path in drawn)
    assert "| P1 | exponential_decay | implicit | FRIC |" in text
    assert "no \\| law" in text


def test_chapter_is_the_same_from_the_file_of_results(tmp_path: Path) -> None:
    runs = [*ladder(2, problem="P1"), refused("no law"), result(options=(("update", "exact"),))]
    (tmp_path / "results.json").write_text(tables.json_text(runs, {"machine": "one"}), "utf-8")
    (tmp_path / "again").mkdir()
    accuracy.main([str(tmp_path / "results.json"), str(tmp_path / "again")])
    accuracy.write(runs, {"machine": "one"}, tmp_path)
    for name in ("accuracy.md", "figures/accuracy-p2-exponential-decay-time.svg"):
        assert (tmp_path / name).read_bytes() == (tmp_path / "again" / name).read_bytes()
