# SPDX-License-Identifier: MIT
"""Scores and the page of a mutation run."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Sequence

from tests.meta import mutation
from tests.meta.mutants import OPERATORS, Mutant
from tests.meta.mutation import KILLED, SAME, STILLBORN, SURVIVED, Fate

HEAD = """\
% SPDX-License-Identifier: MIT

# Mutation score of the rules

How good are the rules of `usersub check`? Every built-in law in C and Fortran is broken in many \
small ways, and each broken copy is checked as a file that claims to be that law \
(`usersub check law.c --law NAME`): for agreement with the law as it is shipped, and by all \
other rules. `make mutation` does it and writes this page.

A mutant is *killed* if a rule of severity "error" fails. *Stillborn* ones do not compile or are \
refused when they are loaded; *the same* are those whose machine code is that of the law; \
*equivalent* are those that nobody can tell from the law by its results, each with its reason \
below. The score is the share of the killed among the rest.

"""


def score(fates: Sequence[Fate]) -> float:
    """Per cent of those killed among those that could be."""
    killed, alive = sum(f.end == KILLED for f in fates), len(survivors(fates))
    return 100.0 * killed / (killed + alive) if killed + alive else 100.0


def survivors(fates: Sequence[Fate]) -> list[Fate]:
    """Those that survived and are not equivalent."""
    return _in_order(f for f in fates if f.end == SURVIVED and not mutation.equivalent(f.mutant))


def equivalent(fates: Sequence[Fate]) -> list[Fate]:
    """Those that survived and are equivalent."""
    return _in_order(f for f in fates if f.end == SURVIVED and mutation.equivalent(f.mutant))


def _in_order(fates) -> list[Fate]:
    return sorted(fates, key=lambda f: (f.mutant.file, f.mutant.language, f.mutant.line))


def table(fates: Sequence[Fate]) -> str:
    """One row an operator and language, and one for all."""
    rows = [
        "| operator | language | mutants | stillborn | the same | equivalent | killed | survived "
        "| score |",
        "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |",
    ]
    for operator in OPERATORS:
        for language in mutation.FILES:
            some = [
                f for f in fates if (f.mutant.operator, f.mutant.language) == (operator, language)
            ]
            if some:
                rows.append(_row(operator, language, some))
    rows.append(_row("all", "both", fates))
    return "\n".join(rows) + "\n"


def _row(operator: str, language: str, fates: Sequence[Fate]) -> str:
    ends = Counter(f.end for f in fates)
    cells = [len(fates), ends[STILLBORN], ends[SAME], len(equivalent(fates)), ends[KILLED],
             len(survivors(fates))]  # fmt: skip
    name = {"c": "C", "fortran": "Fortran"}.get(language, language)
    return f"| {operator} | {name} | {' | '.join(map(str, cells))} | {score(fates):.1f} % |"


def page(fates: Sequence[Fate], made: Sequence[Mutant], given: argparse.Namespace) -> str:
    """The page."""
    seconds = sum(f.seconds for f in fates)
    parts = [
        HEAD,
        f"This run looked at {len(fates)} of {len(made)} mutants of {len({m.file for m in made})} "
        f"laws, chosen and ordered at random (seed {given.seed}), in {seconds / 60:.0f} minutes of "
        "one processor core.\n\n",
        table(fates),
        "\n## Which rule killed\n\n| rule | mutants |\n| --- | ---: |\n",
        *(f"| `{rule}` | {n} |\n" for rule, n in _killers(fates).most_common()),
        "\n## Survivors\n\n",
        _list(survivors(fates)) or "None.\n",
        "\n## Equivalent mutants\n\n",
        _list(equivalent(fates)) or "None.\n",
    ]
    return "".join(parts)


def _killers(fates: Sequence[Fate]) -> Counter:
    return Counter(f.rule for f in fates if f.end == KILLED)


def _list(fates: Sequence[Fate]) -> str:
    rows = []
    for found in fates:
        m = found.mutant
        why = mutation.equivalent(m) or mutation.explanation(m)
        where = f"{m.file}/{mutation.FILES[m.language]}:{m.line}"
        rows.append(f"- {where}, {m.operator}: `{m.before}` became `{m.after}`. {why}".rstrip())
    return "".join(f"{row}\n" for row in rows)
