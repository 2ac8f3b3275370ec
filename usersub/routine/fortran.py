# SPDX-License-Identifier: MIT
"""Published Fortran files, unchanged, through gfortran."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from usersub.errors import CompileError
from usersub.routine import (
    build,
    cache,
    compilers,
    debuginfo,
    fortran_text,
    needs,
    objects,
)
from usersub.routine.build import Build
from usersub.routine.fortran_attempts import first_that_works, flags
from usersub.routine.fortran_source import Prepared, prepare
from usersub.routine.support import Support, support

SUFFIXES = (".f", ".for", ".ftn", ".f77", ".f90", ".f95", ".f03", ".f08")


def compile_file(source: Path, precision: str) -> Build:
    """Compiles a Fortran file in one precision, or finds it in the cache.

    Raises:
        MissingTool: no gfortran. CompileError: its words. LoadError: missing symbols, no access.
    """
    compiler = compilers.find("fortran")
    base = support()
    own = base.include_folders(precision)
    prepared = prepare(source, own)
    digest = cache.key(
        "fortran",
        build.RECORD,
        compiler.version,
        *flags(prepared.free, precision),
        *base.link_flags,
        source.name,
        *(part for name, data in sorted(prepared.files.items()) for part in (name, data)),
    )
    target = cache.path(source.stem, digest, ".so")
    known = build.recall(target, source)
    if known is not None:
        return known

    def other_form() -> Prepared:
        return prepare(source, own, free=not prepared.free)

    return _compile(compiler, source, prepared, other_form, precision, base, target)


def _compile(
    compiler: compilers.Compiler,
    source: Path,
    prepared: Prepared,
    other_form: Callable[[], Prepared],
    precision: str,
    base: Support,
    target: Path,
) -> Build:
    with cache.build_folder() as folder:
        places = (
            f"-J{folder}",
            *(f"-I{p}" for p in (*base.include_folders(precision), source.parent)),
        )
        prepared, chosen, outcome = first_that_works(
            compiler, prepared, other_form, precision, places, folder
        )
        if outcome.code:
            raise _refusal(compiler, source, prepared, outcome)
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
            absent=build.link(compiler, source, [part], base.link_flags, target),
        )
        build.remember(result)
        return result


def _refusal(
    compiler: compilers.Compiler, source: Path, prepared: Prepared, outcome: compilers.Outcome
) -> CompileError:
    """The compiler's words, with the file that the user knows."""
    text = outcome.text.replace(prepared.main, source.name)
    if "Unexpected end of file" in text and compilers.has_no_place(text):
        return CompileError(
            f"{compiler.name} refused {source.name}: the file ends before the END of its last unit"
        )
    return compilers.refusal(compiler, source, compilers.Outcome(outcome.code, text))


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
