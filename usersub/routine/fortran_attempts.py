# SPDX-License-Identifier: MIT
"""gfortran's flags for published files, and what is tried where the usual ones fail."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from usersub.routine import compilers, fortran_mending
from usersub.routine.fortran_source import Prepared

_FLAGS = (
    "-O2", "-g", "-fPIC", "-ffp-contract=off", "-fno-semantic-interposition", "-ffunction-sections",
    "-cpp", "-std=legacy", "-fcray-pointer", "-fallow-argument-mismatch", "-frecursive",
)  # fmt: skip
_WARNINGS = (
    "-Wunused-dummy-argument", "-fno-diagnostics-show-caret", "-fmax-errors=20",
    "-Wframe-larger-than=2000000",
)  # fmt: skip
#: Extensions of other compilers (STRUCTURE, STATIC, TYPE *, A$B ...) that change nothing that
#: compiles.
_VENDOR = ("-fdec", "-fallow-invalid-boz", "-fdollar-ok")
#: Instead of -frecursive, for local arrays that no stack holds: they become static, and the routine
#: is run in one thread like any other with static data.
_LARGE_ARRAYS_STATIC = "-fmax-stack-var-size=1000000"
#: Rounds of mending; each may bring to light what the compiler had not come to.
_ROUNDS = 5


def flags(free: bool, precision: str) -> tuple[str, ...]:
    """Flags that decide about the code, for the form of the source and the precision."""
    form = ("-ffree-form", "-ffree-line-length-none")
    if not free:
        form = ("-ffixed-form", "-ffixed-line-length-132")
    single = ("-DUSUB_SINGLE",) if precision == "single" else ()
    return (*_FLAGS, *form, *single)


def first_that_works(
    compiler: compilers.Compiler,
    prepared: Prepared,
    other_form: Callable[[], Prepared],
    precision: str,
    places: tuple[str, ...],
    folder: Path,
) -> tuple[Prepared, tuple[str, ...], compilers.Outcome]:
    """Compiles to `main.o` in `folder`; the files and the flags that did it, the compiler's words.

    Flags of other compilers, mended files and the other form of the source are tried only where the
    usual ones fail; if nothing helps, the words are those of the usual ones.

    Args:
        other_form: makes the files as of the other form (a free-form `.for`).
        places: flags that name folders.
    """
    usual = flags(prepared.free, precision)
    found, chosen, outcome = _of_one_form(compiler, prepared, usual, places, folder)
    if not outcome.code:
        return found, chosen, outcome
    again = other_form()
    other = _of_one_form(compiler, again, flags(again.free, precision), places, folder)
    return (prepared, usual, outcome) if other[2].code else other


def _of_one_form(
    compiler: compilers.Compiler,
    prepared: Prepared,
    usual: tuple[str, ...],
    places: tuple[str, ...],
    folder: Path,
) -> tuple[Prepared, tuple[str, ...], compilers.Outcome]:
    def attempt(files: Prepared, tried: tuple[str, ...]) -> compilers.Outcome:
        for name, data in files.files.items():
            (folder / name).write_bytes(data)
        command = [*compiler.command, *tried, *places, *_WARNINGS]
        return compilers.run([*command, "-c", files.main, "-o", "main.o"], folder)

    chosen = usual
    outcome = first = attempt(prepared, usual)
    if outcome.code:
        chosen = (*usual, *_VENDOR)
        outcome = attempt(prepared, chosen)
    found = prepared
    for _ in range(_ROUNDS):
        if not outcome.code:
            break
        mended = fortran_mending.mended(found.files, outcome.text, found.free)
        if mended is None:
            break
        found = Prepared(mended, found.main, found.free)
        outcome = attempt(found, chosen)
    if outcome.code:
        return prepared, usual, first
    if "-Wframe-larger-than" in outcome.text:
        chosen = (*(f for f in chosen if f != "-frecursive"), _LARGE_ARRAYS_STATIC)
        outcome = attempt(found, chosen)
    return found, chosen, outcome
