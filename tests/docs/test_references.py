# SPDX-License-Identifier: MIT
"""What the manual says about files is so, and pages use the words that were agreed on."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [p for p in sorted((ROOT / "docs").rglob("*.md")) if "_build" not in p.parts]
PAGES += [ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
_PATH = re.compile(r"`((?:csrc|usersub|tests|docs|reference_impls)/[\w./-]+)`")


def name(page):
    return page.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_named_files_exist(page):
    named = _PATH.findall(page.read_text(encoding="utf-8"))
    places = (ROOT, ROOT / "csrc/include")  # `usersub/abi.h` is named as a program includes it
    missing = [n for n in named if not any((p / n).exists() for p in places)]
    # usersub/field/ lies in the include folder as well; templates of paths are no files
    assert [n for n in missing if "<" not in n] == []


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_no_trademark_and_no_machine(page):
    text = page.read_text(encoding="utf-8")
    assert not re.search(r"abaqus|simulia|dassault", text, re.IGNORECASE)
    assert not re.search(r"/tmp/|/home/|/root/", text)
