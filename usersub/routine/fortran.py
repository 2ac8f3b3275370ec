# SPDX-License-Identifier: MIT
"""Published Fortran files, unchanged, through gfortran."""

from __future__ import annotations

from pathlib import Path

from usersub.routine import build, cache, compilers, debuginfo, fortran_text, needs, objects
from usersub.routine.build import Build
from usersub.routine.fortran_source import Prepared, prepare
from usersub.routine.support import Support, support

SUFFIXES = (".f", ".for", ".ftn", ".f77", ".f90", ".f95", ".f03", ".f08")

_FLAGS = (
    "-O2", "-g", "-fPIC", "-ffp-contract=off", "-fno-semantic-interposition", "-ffunction-sections",
    "-cpp", "-std=legacy", "-fcray-pointer", "-fallow-argument-mismatch", "-frecursive",
)  # fmt: skip
_WARNINGS = (
    "-Wunused-dummy-argument", "-fno-diagnostics-show-caret", "-fmax-errors=20",
    "-Wframe-larger-than=2000000",
)  # fmt: skip
#: Extensions of other compilers (STRUCTURE, STATIC, TYPE *, ...) that change nothing that compiles.
_VENDOR = ("-fdec", "-fallow-invalid-boz")
#: Instead of -frecursive, for local arrays that no stack holds: they become static, and the routine
#: is run in one thread like any other with static data.
_LARGE_ARRAYS_STATIC = "-fmax-stack-var-size=1000000"


def flags(free: bool, precision: str) -> tuple[str, ...]:
    """Flags that decide about the code, for the form of the source and the precision."""
    form = ("-ffree-form", "-ffree-line-length-none")
    if not free:
        form = ("-ffixed-form", "-ffixed-line-length-132")
    single = ("-DUSUB_SINGLE",) if precision == "single" else ()
    return (*_FLAGS, *form, *single)


def compile_file(source: Path, precision: str) -> Build:
    """Compiles a Fortran file in one precision, or finds it in the cache.

    Raises:
        MissingTool: no gfortran. CompileError: its words. LoadError: missing symbols, no access.
    """
    compiler = compilers.find("fortran")
    base = support()
    prepared = prepare(source, base.include_folders(precision))
    chosen = flags(prepared.free, precision)
    digest = cache.key(
        "fortran",
        build.RECORD,
        compiler.version,
        *chosen,
        *base.link_flags,
        source.name,
        *(part for name, data in sorted(prepared.files.items()) for part in (name, data)),
    )
    target = cache.path(source.stem, digest, ".so")
    known = build.recall(target, source)
    if known is not None:
        return known
    return _compile(compiler, source, prepared, chosen, precision, base, target)


def _compile(
    compiler: compilers.Compiler,
    source: Path,
    prepared: Prepared,
    chosen: tuple[str, ...],
    precision: str,
    base: Support,
    target: Path,
) -> Build:
    with cache.build_folder() as folder:
        for name, data in prepared.files.items():
            (folder / name).write_bytes(data)
        places = (
            f"-J{folder}",
            *(f"-I{p}" for p in (*base.include_folders(precision), source.parent)),
        )
        chosen, outcome = _first_that_works(compiler, prepared, chosen, places, folder)
        if outcome.code:
            raise compilers.refusal(compiler, source, outcome)
        command = [*compiler.command, *chosen, *places]
        part = folder / "main.o"
        contents = objects.read(part)
        found = debuginfo.signatures(part, build.interface_symbols())
        heads = _units(compiler, command, prepared, folder) if found else []
        if any(s.code.startswith("entry") for unit in heads for s in unit.statements):
            # gfortran describes the functions of a unit with ENTRY without their arguments.
            found = {symbol: s for symbol, s in found.items() if s.parameters}
        result = Build(
            library=target,
            source=source,
            language="fortran",
            precision=precision,
            compiler=compiler.version,
            flags=chosen,
            functions=contents.functions,
            signatures=found,
            unused=needs.unused_in_fortran(outcome.text, heads, found),
            shared=contents.shared,
            writes_units=contents.writes_units,
            absent=build.link(compiler, source, [part], base, target),
        )
        build.remember(result)
        return result


def _first_that_works(
    compiler: compilers.Compiler,
    prepared: Prepared,
    chosen: tuple[str, ...],
    places: tuple[str, ...],
    folder: Path,
) -> tuple[tuple[str, ...], compilers.Outcome]:
    """Compiles to `main.o`; the flags that did it, and the compiler's words.

    Other flags are tried only where the usual ones fail or make a frame that no stack holds; if
    nothing helps, the words are those of the usual flags.
    """

    def attempt(tried: tuple[str, ...]) -> compilers.Outcome:
        command = [*compiler.command, *tried, *places, *_WARNINGS]
        return compilers.run([*command, "-c", prepared.main, "-o", "main.o"], folder)

    outcome = attempt(chosen)
    if outcome.code:
        extended = (*chosen, *_VENDOR)
        second = attempt(extended)
        if second.code:
            return chosen, outcome
        chosen, outcome = extended, second
    if "-Wframe-larger-than" in outcome.text:
        chosen = (*(f for f in chosen if f != "-frecursive"), _LARGE_ARRAYS_STATIC)
        outcome = attempt(chosen)
    return chosen, outcome


def _units(
    compiler: compilers.Compiler, command: list[str], prepared: Prepared, folder: Path
) -> list[fortran_text.Unit]:
    """Program units of the preprocessed source and of what it includes."""
    outcome = compilers.run([*command, "-E", prepared.main, "-o", "main.i"], folder)
    names = [name for name in prepared.files if name != prepared.main]
    texts = [(folder / name).read_bytes() for name in names]
    if outcome.code == 0:
        texts.append((folder / "main.i").read_bytes())
    return [
        unit
        for text in texts
        for unit in fortran_text.units(text.decode("latin-1"), prepared.free, prepared.main)
    ]
