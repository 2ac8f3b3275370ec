# SPDX-License-Identifier: MIT
"""`python -m tests.meta.table [--check]`: what the rules find, and that they find nothing else.

Runs all rules over every planted file and over every built-in law in every language, interface and
precision, and writes docs/explanation/conformance.md; `--check` compares instead. It takes about
half an hour on two cores; `make conformance` does it. CI compares, with `--own`, by which planted
files are looked at by their own rule only, and `--minutes`, after which the others count as well;
`--from` then says where to begin. `--part I/N` compares a part.
"""

from __future__ import annotations

import argparse
import json
import math
import multiprocessing
import os
import sys
import tempfile
import time
import tomllib
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.conformance import law_matrix
from tests.conformance.law_matrix import Combination
from tests.meta import planting
from tests.meta.planting import Planted
from usersub import abi, laws
from usersub.check import all_rules as rules
from usersub.errors import Error

PAGE = Path(__file__).resolve().parents[2] / "docs/explanation/conformance.md"
#: Files or combinations that a process looks at.
_TASKS = 24
#: By so many combinations a run begins behind the one before it.
_STEP = 101
LANGUAGES = {"c": "C", "fortran": "Fortran", "python": "Python"}

HEAD = """\
% SPDX-License-Identifier: MIT

# What the rules find

A conformance suite is worth what it finds, and what it does not make up. This page is written by \
`make conformance`, which runs every rule over routines that are broken on purpose and over every \
built-in law. CI does it again for every commit, planted faults by their own rules, and compares; \
it stops after some minutes, and begins elsewhere for each commit. How small faults in the laws \
themselves fare is told in [](mutation.md).

"""
PLANTED_HEAD = """\
## Planted faults

For each rule there are routines in `tests/meta/planted` that break it and are healthy otherwise, \
as far as a fault lets itself be isolated: in C, in Fortran and in Python, where it can be made. \
"2 of 2" says that all of two files were found by their own rule in the right words, and that no \
rule of severity "error" found what is not there.

"""
LAWS_HEAD = """\
## No false alarm

The built-in laws pass all rules, agreement with the law's formula included. A cell counts the \
reports (interfaces times precisions) without a failure or an unanswered rule, in C, Fortran and \
Python.

"""
FAULTS_HEAD = """\
## Faults of the field

What is wrong in published friction code, and the rules that see it.

"""


@dataclass(frozen=True)
class Answer:
    """What became of one file or combination; `fault` is "" where all is well."""

    key: Any
    fault: str


def look_at_planted(planted: Planted) -> Answer:
    """All rules over one planted file."""
    try:
        reports = planted.check(jobs=1, seconds=600)
        planted.caught(reports)
        return Answer(planted, "; ".join(planted.others(reports)))
    except (AssertionError, Error) as error:
        return Answer(planted, str(error))


def look_at_own(planted: Planted) -> Answer:
    """Its own rule over one planted file."""
    try:
        planted.caught(planted.check([planted.rule], jobs=1, seconds=600))
        return Answer(planted, "")
    except (AssertionError, Error) as error:
        return Answer(planted, str(error))


def look_at_law(combination: Combination) -> Answer:
    """All rules over one combination."""
    try:
        report = combination.report()
    except Error as error:
        return Answer(combination, str(error))
    found = [*law_matrix.alarms(report), *law_matrix.unanswered(report)]
    return Answer(combination, "; ".join(f"{r.rule}: {r.detail}" for r in found))


def excuses() -> dict[str, dict[str, str]]:
    """Rule -> language -> why its fault cannot be made in it."""
    with (planting.HERE / "planted/languages.toml").open("rb") as stream:
        return tomllib.load(stream)


def planted_table(answers: Sequence[Answer]) -> str:
    """One row a rule; reasons for what is not there below."""
    why, notes = excuses(), dict[str, str]()
    lines = ["| rule | severity | C | Fortran | Python |", "| --- | --- | --- | --- | --- |"]
    for rule in rules().values():
        cells = []
        for language in LANGUAGES:
            some = [a for a in answers if (a.key.rule, a.key.language) == (rule.id, language)]
            if some:
                cells.append(f"{sum(not a.fault for a in some)} of {len(some)}")
            else:
                reason = why.get(rule.id, {}).get(language, "")
                number = notes.setdefault(reason, str(len(notes) + 1))
                cells.append(f"– ({number})")
        lines.append(f"| `{rule.id}` | {rule.severity} | {' | '.join(cells)} |")
    below = [f"{number}. {reason[:1].upper()}{reason[1:]}." for reason, number in notes.items()]
    return "\n".join(lines) + "\n\nWhy not:\n\n" + "\n".join(below) + "\n"


def laws_table(answers: Sequence[Answer]) -> str:
    """One row a law."""
    lines = ["| law | interfaces | C | Fortran | Python |", "| --- | --- | --- | --- | --- |"]
    for name in laws.LAWS:
        faces = laws.law(name).interfaces
        shown = ", ".join(i.upper() for i in abi.NAMES if i in faces)
        cells = []
        for language in LANGUAGES:
            some = [a for a in answers if (a.key.law, a.key.language) == (name, language)]
            cells.append(f"{sum(not a.fault for a in some)} of {len(some)}")
        lines.append(f"| `{name}` | {shown} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def faults_table() -> str:
    """One row a fault of the field.

    Raises:
        KeyError: a rule that does not exist.
    """
    with (planting.HERE / "faults.toml").open("rb") as stream:
        found = tomllib.load(stream)["fault"]
    known = rules()
    lines = ["| fault | rules |", "| --- | --- |"]
    for row in found:
        named = ", ".join(f"`{known[rule].id}`" for rule in row["rules"])
        lines.append(f"| {row['fault']} | {named} |")
    return "\n".join(lines) + "\n"


def page(of_planted: Sequence[Answer], of_laws: Sequence[Answer]) -> str:
    """The page."""
    every = len(of_planted) + len(of_laws)
    return "".join(
        [
            HEAD,
            f"{len(of_planted)} broken routines for {len(rules())} rules, "
            f"{len(of_laws)} reports of built-in laws; "
            f"{sum(bool(a.fault) for a in (*of_planted, *of_laws))} of {every} not as they should "
            "be.\n\n",
            PLANTED_HEAD,
            planted_table(of_planted),
            "\n",
            LAWS_HEAD,
            laws_table(of_laws),
            "\n",
            FAULTS_HEAD,
            faults_table(),
        ]
    )


def answers(
    look: Callable[[Any], Answer],
    things: Sequence[Any],
    processes: int,
    kept: Path | None = None,
    until: float = math.inf,
) -> list[Answer]:
    """Looks at all of them, and says on stderr how far it is.

    Args:
        kept: file with the answers of a run that was interrupted; new ones are added to it.
        until: time by `time.monotonic` after which no more are looked at.
    """
    known = dict[str, str]()
    if kept is not None and kept.is_file():
        known = dict(json.loads(line) for line in kept.read_text(encoding="utf-8").splitlines())
    found = dict(known)
    missing = [thing for thing in things if thing.id not in known]
    for count, answer in enumerate(_looked_at(look, missing, processes, until), 1):
        found[answer.key.id] = answer.fault
        told = f"{count}/{len(missing)} {answer.key.id} {answer.fault}".rstrip()
        print(told, file=sys.stderr, flush=True)
        if kept is not None:
            with kept.open("a", encoding="utf-8") as stream:
                stream.write(json.dumps([answer.key.id, answer.fault]) + "\n")
    return [Answer(thing, found[thing.id]) for thing in things if thing.id in found]


def _looked_at(
    look: Callable[[Any], Answer], things: Sequence[Any], processes: int, until: float
) -> Iterator[Answer]:
    """The answers as they come. Processes are not kept for long, and have those in Python last:
    what these import and compile makes every child process of theirs slower."""
    size = _TASKS * processes
    for first in range(0, len(things), size):
        batch = sorted(things[first : first + size], key=lambda t: t.language == "python")
        with ProcessPoolExecutor(processes, multiprocessing.get_context("spawn")) as pool:
            for done in as_completed([pool.submit(look, thing) for thing in batch]):
                yield done.result()
                if time.monotonic() > until:
                    pool.shutdown(cancel_futures=True)
                    return


def _part(text: str) -> tuple[int, int]:
    number, _, of = text.partition("/")
    if not (number.isdigit() and of.isdigit() and 1 <= int(number) <= int(of)):
        raise argparse.ArgumentTypeError(f"'{text}'; expected a part of several, such as 2/6")
    return int(number), int(of)


def _some(things: Sequence[Any], part: tuple[int, int], begin: int = 0) -> Sequence[Any]:
    """A part, those first at which a run with this number begins."""
    number, of = part
    some = things[number - 1 :: of]
    first = begin * _STEP % len(some)
    return [*some[first:], *some[:first]]


def main(arguments: Sequence[str] | None = None) -> int:
    """Writes the page, or compares it; 1 if something is not as it should be."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare the page instead")
    parser.add_argument("--own", action="store_true", help="planted files by their own rule only")
    parser.add_argument("--part", type=_part, default=(1, 1), metavar="I/N",
                        help="of everything, with --check: the others count as well")  # fmt: skip
    parser.add_argument("--minutes", type=float, default=math.inf, metavar="M",
                        help="as many as can be looked at in this time, with --check")  # fmt: skip
    parser.add_argument("--from", dest="begin", type=int, default=0, metavar="N",
                        help="number of the run, which says where it begins")  # fmt: skip
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--keep", type=Path, help="file of answers, to go on where a run ended")
    given = parser.parse_args(arguments)
    if (given.part != (1, 1) or given.minutes < math.inf) and not given.check:
        parser.error("--part and --minutes are for --check: the page tells of everything")
    until = time.monotonic() + 60.0 * given.minutes
    of_planted, of_laws = planting.files("planted"), law_matrix.combinations()
    with tempfile.TemporaryDirectory() as folder:
        os.environ.setdefault("USERSUB_CACHE", folder)
        look = look_at_own if given.own else look_at_planted
        found = []
        for way, things in ((look, of_planted), (look_at_law, of_laws)):
            some = _some(things, given.part, given.begin)
            found += answers(way, some, given.processes, given.keep, until)
    print(f"looked at {len(found)} of {len(of_planted) + len(of_laws)}")
    faults = [a for a in found if a.fault]
    said = {a.key.id: a.fault for a in faults}
    text = page(
        [Answer(planted, said.get(planted.id, "")) for planted in of_planted],
        [Answer(combination, said.get(combination.id, "")) for combination in of_laws],
    )
    for answer in faults:
        print(f"{answer.key.id}: {answer.fault}", file=sys.stderr)
    if given.check:
        same = PAGE.is_file() and PAGE.read_text(encoding="utf-8") == text
        if not same:
            print(f"{PAGE} differs; `make conformance` writes it", file=sys.stderr)
        return int(bool(faults) or not same)
    PAGE.write_text(text, encoding="utf-8")
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main())
