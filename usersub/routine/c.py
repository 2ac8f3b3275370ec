# SPDX-License-Identifier: MIT
"""C and C++ files through the C compiler of the machine, or through the `zig` extra."""

from __future__ import annotations

import re
from pathlib import Path

from usersub import abi
from usersub.errors import CompileError
from usersub.routine import build, cache, compilers, debuginfo, dual, needs, objects
from usersub.routine.build import Build
from usersub.routine.support import Support, support
from usersub.statuses import STATUSES

C_SUFFIXES = (".c",)
CXX_SUFFIXES = (".cpp", ".cc", ".cxx", ".c++")

_FLAGS = (
    "-O2", "-g", "-fPIC", "-ffp-contract=off", "-fno-math-errno", "-fno-semantic-interposition",
    "-ffunction-sections",
)  # fmt: skip
_OF_LANGUAGE = {
    "c": ("-std=gnu11", "-Werror=implicit-function-declaration"),
    "c++": ("-std=gnu++17",),
}
_WARNINGS = ("-Wunused-parameter",)
# The headers of laws keep these warnings to themselves otherwise.
_REPORT = "-DUSUB_REPORT_UNUSED"


#: For calls without a declaration of these, which return nothing or an `int`, as C assumes.
_PERMIT_UNDECLARED = "-Wno-error=implicit-function-declaration"
_UTILITIES = frozenset(
    """
    xit_ xplb_exit_ stdb_abqerr_ xplb_abqerr_ getpartinfo_ vgetpartinfo_ getjobname_ getoutdir_
    vgetjobname_ vgetoutdir_ getrank_ vgetrank_ getnumcpus_ vgetnumcpus_ get_thread_id
    get_thread_id_ getNumThreads getnumthreads_ MutexInit MutexLock MutexUnlock mutexinit_
    mutexlock_ mutexunlock_
    """.split()
)
_UNDECLARED = re.compile(r"error: implicit declaration of function '(\w+)'")


def _only_undeclared_utilities(words: str) -> bool:
    """Whether all errors are calls of utility routines that the file does not declare."""
    names = _UNDECLARED.findall(words)
    return words.count(" error: ") == len(names) and _UTILITIES.issuperset(names)


def flags(language: str, precision: str) -> tuple[str, ...]:
    """Flags that decide about the code."""
    single = ("-DUSUB_SINGLE",) if precision == "single" else ()
    return (*_FLAGS, *_OF_LANGUAGE[language], *single)


def compile_file(source: Path, language: str, precision: str) -> Build:
    """Compiles a C or C++ file in one precision, or finds it in the cache.

    Raises:
        MissingTool: no compiler. CompileError: its words. LoadError: missing symbols.
    """
    compiler = compilers.find(language)
    base = support()
    chosen = flags(language, precision)
    folders = (*base.include_folders(precision), source.parent)
    command = [*compiler.command, *chosen, _REPORT, *(f"-I{p}" for p in folders)]
    with cache.build_folder() as folder:
        # The preprocessed text covers every include file; names in it are relative to the source.
        # It is compiled itself, because arguments that come out of one macro share a place.
        plain = folder / ("plain.i" if language == "c" else "plain.ii")
        # Without -g, which would put the working folder into the text and so into the key.
        expand = [word for word in command if word != "-g"]
        outcome = compilers.run([*expand, "-E", source.name, "-o", str(plain)], source.parent)
        if outcome.code:
            raise compilers.refusal(compiler, source, outcome)
        text = plain.read_bytes()
        second = dual.read(source, text, _FLAGS, list(folders), folder)
        parts = (language, build.RECORD, compiler.version, *chosen, *base.link_flags, source.name)
        more = second.parts if second else ()
        target = cache.path(source.stem, cache.key(*parts, text, *more), ".so")
        known = build.recall(target, source)
        if known is not None:
            return known
        part = folder / "main.o"
        to_object = [*command, *_WARNINGS, "-c", str(plain), "-o", str(part)]
        outcome = compilers.run(to_object, source.parent)
        if outcome.code and _only_undeclared_utilities(outcome.text):
            outcome = compilers.run([*to_object, _PERMIT_UNDECLARED], source.parent)
        if outcome.code:
            # Once more from the source, for columns that the user finds there.
            outcome = compilers.run(
                [*command, *_WARNINGS, "-fsyntax-only", source.name], source.parent
            )
            raise compilers.refusal(compiler, source, outcome)
        made = [part, second.compile()] if second else [part]
        result = _finish(compiler, source, precision, chosen, made, outcome.text, base, target)
        build.remember(result)
        return result


def _finish(
    compiler: compilers.Compiler,
    source: Path,
    precision: str,
    chosen: tuple[str, ...],
    parts: list[Path],
    words: str,
    base: Support,
    target: Path,
) -> Build:
    part, guarded = parts[0], None
    contents = objects.read(part)
    found = debuginfo.signatures(part, build.interface_symbols())
    if compiler.language == "c++":
        present = [name for name in abi.NAMES if name + "_" in contents.functions]
        if present:
            guarded = {name: _guard_name(name) for name in present}
            parts = [*parts, _guards(compiler, present, part.parent)]
    return Build(
        library=target,
        source=source,
        language=compiler.language,
        precision=precision,
        compiler=compiler.version,
        flags=chosen,
        functions=contents.functions,
        signatures=found,
        unused=needs.unused_in_c(words, found),
        shared=contents.shared,
        writes_units=contents.writes_units,
        absent=build.link(compiler, source, parts, base.link_flags, target),
        guarded=guarded,
    )


def _guard_name(name: str) -> str:
    return f"usub_guarded_{name}"


_GUARD_HEAD = """\
#include <cstring>
#include <exception>
extern "C" void stdb_abqerr_(int *, char *, int *, double *, char *, long, long);
static int usub_raised(const char *name, const char *what) {
  char text[256] = "", blank[9] = "        ";
  int level = -2, none = 0;
  double zero = 0;
  std::strncat(text, name, 40);
  std::strncat(text, what, 200);
  for (char *c = text; *c; c++) if (*c == '%') *c = ' ';
  stdb_abqerr_(&level, text, &none, &zero, blank, (long)std::strlen(text), 8);
  return RAISED;
}
"""


def _guards(compiler: compilers.Compiler, names: list[str], folder: Path) -> Path:
    """Object with one function of block style per interface that turns exceptions into a status."""
    raised = next(s.value for s in STATUSES if s.name == "ROUTINE_RAISED")
    text = _GUARD_HEAD.replace("RAISED", str(raised))
    for name in names:
        arguments = abi.interface(name).args
        lengths = sum(a.kind == "char" for a in arguments)
        types = ", ".join(["void *"] * len(arguments) + ["unsigned long"] * lengths)
        values = ", ".join(
            [f"a[{i}]" for i in range(len(arguments))] + [str(abi.NAME_LENGTH)] * lengths
        )
        text += (
            f'extern "C" void {name}_({types});\n'
            f'extern "C" int {_guard_name(name)}(void **a) {{\n'
            f"  try {{ {name}_({values}); return 0; }}\n"
            f"  catch (const std::exception &e) {{\n"
            f'    return usub_raised("{name.upper()} raised: ", e.what());\n'
            f"  }} catch (...) {{\n"
            f'    return usub_raised("{name.upper()} raised", "");\n'
            f"  }}\n}}\n"
        )
    source = folder / "usub_guards.cpp"
    source.write_text(text, encoding="ascii")
    made = source.with_suffix(".o")
    command = [*compiler.command, "-O2", "-fPIC", "-c", source.name, "-o", made.name]
    outcome = compilers.run(command, folder)
    if outcome.code:
        raise CompileError(f"the exception guard could not be compiled: {outcome.text.strip()}")
    return made
