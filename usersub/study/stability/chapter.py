# SPDX-License-Identifier: MIT
"""The documentation's chapter on stability: prose from `stability.md.in`, tables from runs.

`python -m usersub.study.stability.chapter docs/explanation` runs everything and writes it anew.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

from usersub.study.stability.cases import CASES
from usersub.study.stability.cell import VERDICTS, Cell, Limit
from usersub.study.stability.measured import WITHIN
from usersub.study.stability.subjects import LANGUAGES

_TEMPLATE = Path(__file__).with_name("stability.md.in")


def write(
    cells: Sequence[Cell], limits: Sequence[Limit], stamp: Mapping[str, str], folder: Path
) -> Path:
    """Writes `stability.md` into a folder that exists; its path.

    Raises:
        OSError: the file cannot be written.
    """
    page = folder / "stability.md"
    page.write_text(text(cells, limits, stamp), encoding="utf-8")
    return page


def text(cells: Sequence[Cell], limits: Sequence[Limit], stamp: Mapping[str, str]) -> str:
    """The chapter in Markdown."""
    counts = Counter(cell.verdict for cell in cells)
    values = {
        "STAMP": "; ".join(f"{name}: {value}" for name, value in stamp.items()),
        "CELLS": f"{len(cells):,}",
        "INCREMENTS": f"{sum(cell.increments for cell in cells):,}",
        "VERDICTS": ", ".join(f"{counts[v]:,} {v}" for v in VERDICTS),
        "BY_CASE": _by_case(cells),
        "BY_SUBJECT": _by_subject(cells),
        "BOUNDED": _reasons(cells, "bounded"),
        "REFUSED": _reasons(cells, "refused"),
        "LIMITS": _limits([x for x in limits if x.theory]),
        "NOTHING": _limits([x for x in limits if x.theory == 0]),
        "FREE": _limits([x for x in limits if x.theory is None]),
        "WITHIN": f"{100 * WITHIN:g} %",
        "WORST": _worst(limits),
    }
    template = _TEMPLATE.read_text(encoding="utf-8")
    return re.sub(r"@([A-Z_]+)@", lambda match: values[match[1]], template)


def _row(cells: Sequence[object]) -> str:
    return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"


def _table(head: Sequence[str], align: str, rows: Sequence[Sequence[object]]) -> str:
    marks = ["---:" if a == "r" else "---" for a in align]
    return "\n".join([_row(head), _row(marks), *map(_row, rows)])


def _by_case(cells: Sequence[Cell]) -> str:
    rows = []
    for case, words in CASES.items():
        counts = Counter(cell.verdict for cell in cells if cell.case == case)
        if counts:
            rows.append([case, words, *(counts[v] or "-" for v in VERDICTS)])
    return _table(["case", "what", *VERDICTS], "llrrrr", rows)


def _by_subject(cells: Sequence[Cell]) -> str:
    rows = []
    for subject in dict.fromkeys(cell.subject for cell in cells):
        own = [cell for cell in cells if cell.subject == subject]
        counts = Counter(cell.verdict for cell in own)
        faces = ", ".join(dict.fromkeys(cell.interface.upper() for cell in own))
        rows.append([subject, faces, *(counts[v] or "-" for v in VERDICTS)])
    return _table(["law or driver", "interfaces", *VERDICTS], "llrrrr", rows)


def _reasons(cells: Sequence[Cell], verdict: str) -> str:
    """Kinds of reasons, the most frequent first; numbers, names and places left out."""
    kinds: Counter[str] = Counter()
    example: dict[str, Cell] = {}
    for cell in cells:
        if cell.verdict == verdict:
            kind = _kind(cell.reason)
            kinds[kind] += 1
            example.setdefault(kind, cell)
    rows = [
        [count, kind, f"{example[kind].subject}, {example[kind].case}: {example[kind].value}"]
        for kind, count in kinds.most_common()
    ]
    return _table(["cells", "reason", "for example"], "rll", rows) if rows else "None."


def _kind(reason: str) -> str:
    """A reason without what differs from cell to cell."""
    short = re.sub(r" \(routine .*\)$", "", reason)
    short = re.sub(r" (?:at|of) point \d+", "", short)
    if re.match(r"[a-z_]+: [\w\[\]]+ (?:=|has) ", short):
        return "a property is out of its range, told by the law"
    short = re.sub(r"^[A-Z_]+: ", "", short)
    short = re.sub(r"\b[a-z_]+ behind", "it, behind", short)
    short = re.sub(r"-?\b(?:\d[\d.]*(?:e[+-]?\d+)?|inf)\b", "...", short)
    short = re.sub(r"; expected .*", "", short)
    return short[:160]


def _limits(limits: Sequence[Limit]) -> str:
    head = ["limit", "law or driver", "interface", "precision", "measured", "theory", "ratio",
            "unit", "how"]  # fmt: skip
    rows = [
        [
            x.name, x.subject, x.interface.upper(), x.precision, _number(x.measured),
            "-" if x.theory is None else _number(x.theory),
            "-" if x.ratio is None else f"{x.ratio:.4f}", x.unit, x.words,
        ]
        for x in limits
    ]  # fmt: skip
    return _table(head, "llllrrrll", rows) if rows else "None."


def _number(value: float) -> str:
    return f"{value:.5g}"


def _worst(limits: Sequence[Limit]) -> str:
    ratios = [abs(x.ratio - 1.0) for x in limits if x.ratio is not None]
    return f"{100 * max(ratios):.2g} %" if ratios else "none was measured"


def _told(done: int, whole: int, words: str) -> None:
    """A line of progress, on what is watched and in a log."""
    print(f"{done}/{whole} {words}", file=sys.stderr, flush=True)


def main() -> None:
    """Runs matrix and limits and writes the chapter."""
    from usersub.study import stability
    from usersub.study.stamp import stamp

    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("folder", type=Path, help="where stability.md is written")
    parser.add_argument("--quick", action="store_true", help="fewer values, shorter runs")
    parser.add_argument("--language", action="append", help="of shipped laws; by default all")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes")
    parser.add_argument("--keep", type=Path, help="folder of what is finished, to go on from there")
    asked = parser.parse_args()
    languages = tuple(asked.language or LANGUAGES)
    cells = stability.matrix(
        languages=languages, quick=asked.quick, jobs=asked.jobs, progress=_told,
        keep=asked.keep and asked.keep / "stability.jsonl",
    )  # fmt: skip
    limits = stability.limits(quick=asked.quick, progress=_told, jobs=asked.jobs)
    print(write(cells, limits, stamp(), asked.folder))


if __name__ == "__main__":
    main()
