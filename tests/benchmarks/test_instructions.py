# SPDX-License-Identifier: MIT
"""The drivers need as many instructions as are on record, within the tolerance."""

from __future__ import annotations

import json

import pytest

from tests.benchmarks import instructions

RECORD = json.loads(instructions.RECORD.read_text(encoding="utf-8"))


def test_counts_are_those_on_record():
    try:
        instructions.check_comparable(RECORD)
    except instructions.Incomparable as reason:
        pytest.xfail(str(reason))  # not a skip, which CI forbids: other machines may run it
    changed = instructions.changes(instructions.counts(), RECORD)
    changed = {s: f"{c:+.1%}" for s, c in changed.items() if abs(c) > RECORD["tolerance"]}
    assert not changed, (
        "instructions have changed by more than is tolerated; if that is meant: "
        "python -m tests.benchmarks.instructions --write"
    )


def test_a_change_is_seen_and_another_compiler_is_said():
    more = {scene: round(count * 1.05) for scene, count in RECORD["counts"].items()}
    assert all(c > RECORD["tolerance"] for c in instructions.changes(more, RECORD).values())
    with pytest.raises(instructions.Incomparable, match="of clang 1|AVX2|is not there"):
        instructions.check_comparable({**RECORD, "compiler": "clang 1"})
