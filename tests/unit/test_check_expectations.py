# SPDX-License-Identifier: MIT
"""Files of rules that are left out or known to fail."""

from __future__ import annotations

import pytest

from usersub.check.numbers import integer, numbers
from usersub.check.running.expectations import (
    Expectation,
    chosen,
    matches,
    no_such_rule,
    parsed,
    read,
    unknown,
)
from usersub.errors import SceneError

RULES = ("frame.rotation", "frame.reversal", "memory.outside", "tangent.slip")


@pytest.mark.parametrize(
    ("pattern", "hits"),
    [
        ("frame.rotation", 1),
        ("Frame.Rotation", 1),
        ("frame", 2),
        ("frame.*", 2),
        ("*.slip", 1),
        ("*", 4),
        ("fram", 0),
        ("frame.rot", 0),
        ("slip", 0),
        ("memory.o?tside", 1),
    ],
)
def test_patterns(pattern, hits):
    assert sum(matches(pattern, rule) for rule in RULES) == hits


def test_a_file(tmp_path):
    file = tmp_path / "known.txt"
    file.write_text(
        "# known faults\n\nframe.rotation\n  vfric: memory   # issue 12\nVFRICTION:*.slip#x\n   #\n"
    )
    assert read(file) == (
        Expectation("frame.rotation", "", "", "known.txt:3"),
        Expectation("memory", "vfric", "issue 12", "known.txt:4"),
        Expectation("*.slip", "vfriction", "x", "known.txt:5"),
    )
    lines = read(file)
    assert chosen(lines, "memory.outside", "vfric") is lines[1]
    assert chosen(lines, "memory.outside", "fric") is None
    assert lines[1].words == "known.txt:4 (issue 12)"


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("frik: memory", "bad.txt:1: 'frik' is not an interface, expected one of fric"),
        ("memory outside", "'memory outside' is not one rule"),
    ],
)
def test_lines_that_cannot_be(tmp_path, line, words):
    file = tmp_path / "bad.txt"
    file.write_text(line)
    with pytest.raises(SceneError, match=words):
        read(file)


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(SceneError, match="cannot be read: No such file"):
        read(tmp_path / "gone.txt")
    (tmp_path / "binary").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(SceneError, match="not text in UTF-8"):
        read(tmp_path / "binary")


def test_texts_and_objects():
    ready = Expectation("frame")
    assert parsed(["fric: tangent", ready, " # nothing"]) == (
        Expectation("tangent", "fric"),
        ready,
    )


def test_unknown_patterns_are_told():
    given = (Expectation("frame.rotatoin", place="f:1"), Expectation("frame"), Expectation("x.*"))
    assert list(unknown(given, RULES)) == [
        "f:1: no rule is called 'frame.rotatoin'; did you mean 'frame.rotation'?",
        "no rule is called 'x.*'",
    ]
    assert no_such_rule("fram", RULES).endswith("did you mean 'frame'?")


def test_numbers():
    assert numbers("--props", "0.3, 1e-4 2D-3,1d0") == (0.3, 1e-4, 2e-3, 1.0)
    assert numbers("--props", "") == () and numbers("--props", None) is None
    assert integer("--states", "3") == 3 and integer("--states", None) is None
    with pytest.raises(SceneError, match="--props has 'x', expected numbers as in 0.3,1e-4"):
        numbers("--props", "0.3,x")
    with pytest.raises(SceneError, match="--props has ''"):
        numbers("--props", "1,,2")
    with pytest.raises(SceneError, match="--states is '-1'"):
        integer("--states", "-1")
