# SPDX-License-Identifier: MIT
"""The documentation's chapter on accuracy: prose from `accuracy.md.in`, the rest from results.

`python -m usersub.study.accuracy STUDY/results.json docs/explanation` writes it anew.
"""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from usersub.study import figures, orders, tables
from usersub.study.pareto import Front, fronts, heading, recommendation
from usersub.study.result import Result

_TEMPLATE = Path(__file__).with_name("accuracy.md.in")
_FIGURES = "figures"

#: Problems whose figures the chapter has; those of all others are on the study's page.
SHOWN = ("P2", "P5", "P8", "P11", "P15", "P17")


def write(results: Iterable[Result], stamp: Mapping[str, str], folder: Path) -> list[Path]:
    """Writes `accuracy.md` and its figures into a folder that exists; the files.

    Args:
        stamp: machine and versions.

    Raises:
        MissingTool: matplotlib is not installed.
        OSError: a file cannot be written.
    """
    found = fronts(results)
    made = [p for p in figures.pictures(found) if _shown(p.of)]
    made = [figures.renamed(picture, f"accuracy-{picture.name}") for picture in made]
    (folder / _FIGURES).mkdir(exist_ok=True)
    paths = figures.write(folder / _FIGURES, made, (".svg",))
    page = folder / "accuracy.md"
    page.write_text(text(found, stamp), encoding="utf-8")
    return [page, *paths]


def _shown(front: object) -> bool:
    return isinstance(front, Front) and front.problem in SHOWN


def text(found: Sequence[Front], stamp: Mapping[str, str]) -> str:
    """The chapter in Markdown."""
    curves = [curve for front in found for curve in orders.curves(front.runs)]
    told = [curve for curve in curves if orders.order_words(curve) != "rounding"]
    values = {
        "STAMP": "; ".join(f"{name}: {value}" for name, value in stamp.items()),
        "RUNS": _runs(found),
        "RECOMMENDATIONS": "\n\n".join(map(_recommended, found)),
        "FIGURES": "\n\n".join(
            f"![{picture.caption}]({_FIGURES}/accuracy-{picture.name}.svg)\n\n*{picture.caption}*"
            for picture in figures.pictures(found)
            if _shown(picture.of)
        ),
        "ORDERS": tables.markdown(orders.HEAD, orders.rows(told)),
        "EXACT": _exact(curves),
        "REFUSED": _refused(found),
    }
    template = _TEMPLATE.read_text(encoding="utf-8")
    return re.sub(r"@(\w+)@", lambda match: values[match[1]], template)


def _runs(found: Sequence[Front]) -> str:
    runs = {run.key: run for front in found for run in (*front.runs, *front.blocks)}
    refused = sum(len(front.refused) for front in found)
    problems = len({front.problem for front in found})
    return (
        f"{len(runs)} runs of {problems} problems gave an error and a run time, {refused} did not"
    )


def _recommended(front: Front) -> str:
    """Heading, sentences and the front as a table."""
    parts = [f"### {heading(front)}", "\n".join(f"- {s}" for s in recommendation(front))]
    if front.front:
        parts.append(tables.markdown(tables.RUN_HEAD, tables.run_rows(front.front)))
    return "\n\n".join(parts)


def _exact(curves: Sequence[orders.Curve]) -> str:
    """Methods that leave rounding alone, whatever the step."""
    exact: dict[tuple[str, str, str], list[str]] = {}
    for curve in curves:
        if orders.order_words(curve) == "rounding":
            who = exact.setdefault((curve.problem, curve.law, curve.method), [])
            name = curve.interface.upper()
            who += [name] * (name not in who)
    rows = [[*key, ", ".join(who)] for key, who in exact.items()]
    return tables.markdown(("problem", "law", "method", "interfaces"), rows)


def _refused(found: Sequence[Front]) -> str:
    rows = tables.refused_rows(found)
    if not rows:
        return "No run was refused."
    return tables.markdown(tables.REFUSED_HEAD, rows)


def main(arguments: Sequence[str] | None = None) -> None:
    """Writes the chapter from the results of a study."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("results", type=Path, help="results.json of a study")
    parser.add_argument("folder", type=Path, help="where accuracy.md is written")
    given = parser.parse_args(arguments)
    read = json.loads(given.results.read_text(encoding="utf-8"))
    write(map(Result.of, read["results"]), read["stamp"], given.folder)


if __name__ == "__main__":
    main()
