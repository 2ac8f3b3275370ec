# SPDX-License-Identifier: MIT
"""Measures the drivers against limits written by hand and against peers: `make bench`.

Writes docs/explanation/benchmarks.md and docs/explanation/cost.md, or the same names in the folder
that is named. Takes a few minutes; numbers mean something on a machine that does nothing else.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

from tests.benchmarks import coefficient, fric, lifted, pages, scaling, vfriction
from tests.benchmarks.timing import Row, medians

HOME = Path("docs/explanation")


def law_functions() -> list[Row]:
    """A law function behind each interface against the routine written by hand for it."""
    rows: list[Row] = []
    for name, (law, by_hand) in lifted.pairs().items():
        found = medians({"law": law, "by hand": by_hand}, 9)
        work = f"{name.upper()}, law function of five lines{lifted.WITH.get(name, '')}"
        limit = "routine by hand with numba"
        rows.append(
            Row(work, "driver, Python", lifted.POINTS, found["law"], limit, found["by hand"])
        )
    return rows


def measured(folder: Path) -> list[Row]:
    """All rows of the benchmarks, each part in a folder of its own."""
    parts = [
        coefficient.one_point,
        lambda home: coefficient.blocks(home, 10_000),
        lambda home: coefficient.blocks(home, 1_000_000),
        lambda home: coefficient.threads(1_000_000),
        lambda home: fric.rows(home, 10_000),
        lambda home: fric.slipping(home, 10_000),
        lambda home: vfriction.rows(home, 10_000),
        lambda home: vfriction.rows(home, 1_000_000),
        lambda home: law_functions(),
    ]
    rows: list[Row] = []
    for number, part in enumerate(parts):
        home = folder / str(number)
        home.mkdir()
        rows += part(home)
        _tell(f"{number + 1} of {len(parts)} groups of benchmarks")
    return rows


def cost_fields(folder: Path) -> dict[str, str]:
    """Tables of the page of the cost, by the names of its template."""
    from usersub.study import leaving_out, leaving_out_page

    _tell("cost against the number of points and threads")
    curves, threads = scaling.curves(), scaling.threads(folder)
    _tell("what is left out")
    savings = leaving_out.measure()
    return {
        "machine": pages.machine(),
        "sizes": scaling.size_table(curves),
        "threads": scaling.thread_table(threads),
        "memory": scaling.memory_table(curves),
        "beyond": scaling.beyond_table(curves, os.cpu_count() or 1),
        "cores": str(os.cpu_count() or 1),
        "leaving_out": leaving_out_page.page(savings),
    }


def _tell(words: str) -> None:
    print(words, file=sys.stderr, flush=True)


def main(home: str = str(HOME)) -> None:
    """Measures everything and writes both pages into the folder `home`."""
    with tempfile.TemporaryDirectory() as folder:
        text = pages.benchmarks(measured(Path(folder)))
        (Path(home) / "benchmarks.md").write_text(text, encoding="utf-8")
        print(text, end="")
        cost = pages.cost(HOME / "cost.md.in", cost_fields(Path(folder)))
        (Path(home) / "cost.md").write_text(cost, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
