# SPDX-License-Identifier: MIT
"""Runs the code of README and tutorials, page by page, in a temporary folder.

A fenced block with a caption is written to the file of that name. A `python` block is run, a
`console` block's lines behind `$` are run by a shell; the lines below, or a `text` block that
follows a `python` block, are what has to be printed (`...` stands for anything).
"""

import contextlib
import doctest
import io
import linecache
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs/tutorials").glob("*.md"))]
PAGES += sorted((ROOT / "docs/how-to").glob("*.md"))

_FENCE = re.compile(r"^(`{3,})(?:\{code-block\} *)?(\w*)[^\n]*\n(.*?)^\1 *$", re.M | re.S)
_CAPTION = re.compile(r"\A:caption: (\S+)\n+")
_FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
#: Shell commands that set a machine up and are not run.
_SET_UP = ("pip install", "apt", "git clone", "sudo")


@dataclass(frozen=True)
class Block:
    """A fenced block: `language`, `text`, the `file` that it is, line of the page."""

    language: str
    text: str
    file: str
    line: int


def blocks(text):
    """The fenced blocks of a page."""
    found = []
    for match in _FENCE.finditer(text):
        body = match[3]
        caption = _CAPTION.match(body)
        if caption:
            body = body[caption.end() :]
        line = text[: match.start()].count("\n") + 1
        found.append(Block(match[2], body, caption[1] if caption else "", line))
    return found


def check_output(wanted, got, where):
    same = doctest.OutputChecker().check_output(wanted, got, _FLAGS)
    assert same, f"{where}: expected\n{wanted}\nbut the page's code printed\n{got}"


def run_python(block, names, where):
    # The source has to be found by name, as at an interactive prompt.
    file = f"<{where}>"
    linecache.cache[file] = (len(block.text), None, block.text.splitlines(keepends=True), file)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(block.text, file, "exec"), names)
    return printed.getvalue()


def commands(text):
    """Pairs of a command and what it has to print."""
    for part in re.split(r"^\$ ", text, flags=re.M)[1:]:
        command, _, output = re.sub(r"\\\n", " ", part).partition("\n")
        yield command, output


def run_console(block, environment, where):
    for command, wanted in commands(block.text):
        if command.startswith(_SET_UP):
            continue
        done = subprocess.run(
            ["bash", "-c", command], env=environment, text=True, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, timeout=300,
        )  # fmt: skip
        if wanted.strip():
            check_output(wanted, done.stdout, f"{where}: $ {command}")
        else:
            assert done.returncode == 0, f"{where}: $ {command}\n{done.stdout}"


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.relative_to(ROOT).as_posix())
def test_code_of_page(page, tmp_path, monkeypatch):
    found = blocks(page.read_text(encoding="utf-8"))
    if any("fortran" in b.language or "gfortran" in b.text for b in found):
        if shutil.which("gfortran") is None:
            pytest.skip("gfortran is missing; install it, e.g. with `apt-get install gfortran`")
    monkeypatch.chdir(tmp_path)
    scripts = Path(sys.executable).parent
    environment = {
        **os.environ, "PATH": f"{scripts}{os.pathsep}{os.environ['PATH']}", "COLUMNS": "100",
        "NO_COLOR": "1",
    }  # fmt: skip
    names, printed = {"__name__": "__page__"}, None
    for block in found:
        where = f"{page.relative_to(ROOT)}:{block.line}"
        if block.file:
            Path(block.file).parent.mkdir(parents=True, exist_ok=True)
            Path(block.file).write_text(block.text, encoding="utf-8")
        elif block.language == "python":
            printed = run_python(block, names, where)
            continue
        elif block.language == "console":
            run_console(block, environment, where)
        elif block.language == "text" and printed is not None:
            check_output(block.text, printed, where)
        printed = None


@pytest.mark.parametrize("page", PAGES[1:], ids=lambda p: p.relative_to(ROOT).as_posix())
def test_page_is_checked_at_all(page):
    """A page with code shows what comes out of it, so that wrong numbers are found."""
    found = blocks(page.read_text(encoding="utf-8"))
    runs = [b for b in found if b.language in ("python", "console") and not b.file]
    shown = [b for b in runs if "assert" in b.text or b.language == "console"]
    shown += [b for b in found if b.language == "text"]
    assert not runs or shown


def test_blocks_are_found():
    page = "a\n```python\nx = 1\n```\n\n```{code-block} fortran\n:caption: f.f\n\n      end\n```\n"
    assert blocks(page) == [
        Block("python", "x = 1\n", "", 2),
        Block("fortran", "      end\n", "f.f", 6),
    ]


def test_commands_are_found():
    text = "$ usersub run a \\\n    --json\n{...}\n$ true\n"
    assert list(commands(text)) == [("usersub run a      --json", "{...}\n"), ("true", "")]


def test_wrong_output_is_refused():
    with pytest.raises(AssertionError, match="expected"):
        check_output("0.15\n", "0.16\n", "here")
    check_output("0.15 ...\n", "0.15   0.16\n", "here")
