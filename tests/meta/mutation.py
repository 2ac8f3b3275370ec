# SPDX-License-Identifier: MIT
"""`python -m tests.meta.mutation`: how many small faults in the built-in laws the rules see.

Each mutant (`mutants.py`) of a law in C or Fortran is compiled and checked as a file that claims to
be that law: first for agreement with the law as it is shipped (rule law.agrees), then by all other
rules. It is *killed* if a rule of severity "error" fails; *stillborn* if it does not compile or is
refused when it is loaded; *the same* if its machine code is that of the law. What is left has
survived, and is equivalent if `mutation.toml` says why nobody could tell it from the law.

The page docs/explanation/mutation.md is written by `make mutation`.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import sys
import tempfile
import time
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from tests.meta import mutants
from tests.meta.mutants import Mutant
from usersub import abi, laws
from usersub.errors import CompileError, Error, LoadError

HERE = Path(__file__).resolve().parent
PAGE = HERE.parents[1] / "docs/explanation/mutation.md"
FILES = {"c": "law.c", "fortran": "law.f90"}
KILLED, SURVIVED, STILLBORN, SAME = "killed", "survived", "stillborn", "the same"
#: Order of the stages: a mutant is out at the first that kills it.
STAGES = (("law.agrees",), None)
#: Time for one report, seconds.
SECONDS = 300.0
_SECTIONS = (".text", ".rodata", ".data", ".data.rel.ro")


@dataclass(frozen=True)
class Fate:
    """What became of a mutant: KILLED by a rule, with its words, or another of the four."""

    mutant: Mutant
    end: str
    rule: str = ""
    words: str = ""
    seconds: float = 0.0


def all_mutants(names: Iterable[str] = (), languages: Iterable[str] = tuple(FILES)) -> list[Mutant]:
    """Every mutant of the built-in laws."""
    return [
        mutant
        for name in names or laws.LAWS
        for language in languages
        for mutant in mutants.mutants(name, language, source(name, language))
    ]


def source(name: str, language: str) -> str:
    """Text of a built-in law."""
    return (laws.law(name).folder / FILES[language]).read_text(encoding="utf-8")


def sample(made: Sequence[Mutant], most: int, seed: int) -> list[Mutant]:
    """At most so many of each law, language and operator, in random order; 0 for all."""
    order = list(made)
    random.Random(seed).shuffle(order)
    if not most:
        return order
    counts: dict[tuple[str, str, str], int] = {}
    chosen = []
    for mutant in order:
        key = (mutant.file, mutant.language, mutant.operator)
        counts[key] = counts.get(key, 0) + 1
        if counts[key] <= most:
            chosen.append(mutant)
    return chosen


def code_of(path: Path, language: str, precision: str) -> tuple[bytes, ...]:
    """Machine code and constants of a compiled file, without debug information.

    Raises:
        CompileError, LoadError: it cannot be made.
    """
    from elftools.elf.elffile import ELFFile

    from usersub.routine import c, fortran

    if language == "c":
        library = c.compile_file(path, "c", precision).library
    else:
        library = fortran.compile_file(path, precision).library
    with Path(library).open("rb") as stream:
        elf = ELFFile(stream)
        found = [elf.get_section_by_name(name) for name in _SECTIONS]
        return tuple(b"" if section is None else section.data() for section in found)


@cache
def _code_of_law(name: str, language: str) -> tuple[tuple[bytes, ...], ...]:
    with tempfile.TemporaryDirectory() as folder:
        return _codes(Path(folder), language, source(name, language))


def _codes(folder: Path, language: str, text: str) -> tuple[tuple[bytes, ...], ...]:
    path = folder / FILES[language]
    path.write_text(text, encoding="utf-8")
    return tuple(code_of(path, language, precision) for precision in ("double", "single"))


def fate(mutant: Mutant) -> Fate:
    """Compiles and checks one mutant."""
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        end, rule, words = _end_of(mutant, Path(folder))
    return Fate(mutant, end, rule, words, time.monotonic() - start)


def _end_of(mutant: Mutant, folder: Path) -> tuple[str, str, str]:
    from usersub.check import check

    law, language = mutant.file, mutant.language
    try:
        if _codes(folder, language, mutant.text) == _code_of_law(law, language):
            return SAME, "", ""
    except (CompileError, LoadError) as error:
        return STILLBORN, "", str(error).splitlines()[0]
    for rules in STAGES:
        for interface, precision in _combinations(law):
            try:
                (report,) = check(
                    folder / FILES[language], law=law, rules=rules, interface=interface,
                    precision=precision, jobs=1, seconds=SECONDS,
                )  # fmt: skip
            except Error as error:
                return STILLBORN, "", str(error).splitlines()[0]
            for failure in report.failures:
                if failure.severity == "error":
                    return KILLED, failure.rule, failure.detail
    return SURVIVED, "", ""


def _combinations(law: str) -> list[tuple[str, str]]:
    """Interfaces and precisions of a law, those first that show most."""
    faces = sorted(laws.law(law).interfaces, key=lambda i: (i != "fric", i != "vfriction"))
    return sorted(
        ((i, p) for i in faces for p in abi.interface(i).precisions), key=lambda c: c[1] != "double"
    )


def kept(file: Path | None, chosen: Sequence[Mutant]) -> list[Fate]:
    """The fates of a run that was interrupted."""
    if file is None or not file.is_file():
        return []
    by_id = {f"{m.language} {m.id}": m for m in chosen}
    lines = [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
    return [Fate(by_id[line[0]], *line[1:]) for line in lines if line[0] in by_id]


def keep(file: Path | None, found: Fate) -> None:
    """Adds a fate to the file from which an interrupted run goes on."""
    if file is not None:
        m = found.mutant
        line = [f"{m.language} {m.id}", found.end, found.rule, found.words, found.seconds]
        with file.open("a", encoding="utf-8") as stream:
            stream.write(json.dumps(line) + "\n")


def run(chosen: Sequence[Mutant], processes: int, minutes: float) -> Iterator[Fate]:
    """The fates of the mutants as they become known, until the time is over."""
    until = time.monotonic() + 60 * minutes
    with ProcessPoolExecutor(processes) as pool:
        waiting = iter(chosen)
        under_way = {pool.submit(fate, m) for m, _ in zip(waiting, range(2 * processes))}  # noqa: B905
        while under_way:
            done = next(as_completed(under_way))
            under_way.remove(done)
            yield done.result()
            if time.monotonic() < until and (another := next(waiting, None)) is not None:
                under_way.add(pool.submit(fate, another))


@cache
def _reasons() -> dict[str, dict[str, str]]:
    with (HERE / "mutation.toml").open("rb") as stream:
        return tomllib.load(stream)


def equivalent(mutant: Mutant) -> str:
    """Why nobody can tell a mutant from the law by its results, or ""."""
    return _reasons()["equivalent"].get(f"{mutant.language} {mutant.id}", "")


def explanation(mutant: Mutant) -> str:
    """Why no rule sees a mutant that is not equivalent, or ""."""
    return _reasons()["survives"].get(f"{mutant.language} {mutant.id}", "")


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs mutants and prints what became of them; 1 if the score is below what is asked."""
    from tests.meta import mutation_page

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("laws", nargs="*", help="names of laws; all without")
    parser.add_argument("--language", choices=list(FILES), action="append")
    parser.add_argument("--most", type=int, default=0, help="of each law, language and operator")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=45.0)
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--keep", type=Path, help="file of fates, to go on where a run ended")
    parser.add_argument("--at-least", type=float, default=95.0, help="score in per cent")
    parser.add_argument("--write", action="store_true", help=f"write {PAGE.name}")
    given = parser.parse_args(arguments)
    made = all_mutants(given.laws, given.language or tuple(FILES))
    chosen = sample(made, given.most, given.seed)
    fates = kept(given.keep, chosen)
    known = {f.mutant.text for f in fates}
    with tempfile.TemporaryDirectory() as folder:
        os.environ.setdefault("USERSUB_CACHE", folder)
        left = [m for m in chosen if m.text not in known]
        for found in run(left, given.processes, given.minutes):
            fates.append(found)
            keep(given.keep, found)
            _tell(found, len(fates), len(chosen))
    print(mutation_page.table(fates))
    for found in mutation_page.survivors(fates):
        print(f"survived: {found.mutant.language} {found.mutant.id}")
    if given.write:
        PAGE.write_text(mutation_page.page(fates, made, given), encoding="utf-8")
    return 0 if mutation_page.score(fates) >= given.at_least else 1


def _tell(found: Fate, count: int, of: int) -> None:
    words = f"{found.end} {found.rule}".strip()
    print(f"{count}/{of} {words}: {found.mutant.language} {found.mutant.id}", file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
