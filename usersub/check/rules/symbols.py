# SPDX-License-Identifier: MIT
"""What a file defines and what it needs: nothing is called."""

from __future__ import annotations

import re
from collections.abc import Iterator

from usersub import abi
from usersub.check.rule import CannotCheck, Finding, NotApplicable, rule
from usersub.check.source import arguments
from usersub.check.subject import Subject
from usersub.errors import CompileError, Error, LoadError, MissingTool
from usersub.routine.build import Build

_COMPILED = ("c", "c++", "fortran", "library")

#: What the linker and the loader say of names that nobody defines.
_UNDEFINED = re.compile(r"calls (?P<names>.+?), which neither the file nor usersub defines")
_UNRESOLVED = re.compile(r"undefined symbol: (?P<names>\w+)")
_PLACE = re.compile(r"^\s+(?P<where>[^\s:][^:]*:\d+)(?::\d+)?: ", re.MULTILINE)


@rule(
    "symbols.entry",
    "The file compiles and defines the interface under the name that hosts look for.",
    reference="manual page of the interface; C and C++ name it by FOR_NAME of omi_for_c.h",
    languages=(*_COMPILED, "python"),
)
def entry(subject: Subject) -> Iterator[Finding]:
    face, failure = subject.interface, subject.failure
    if arguments.language(subject) == "python":
        if isinstance(failure, LoadError):
            yield Finding(str(failure), hint=f"Decorate the function with @usersub.{face.name}.")
        elif isinstance(failure, CompileError):
            yield _not_compiled(subject, failure)
        elif subject.routine is not None:
            try:
                subject.routine.entry(subject.precision)
            except CompileError as error:
                yield _not_compiled(subject, error)
        return
    if isinstance(failure, MissingTool):
        raise CannotCheck(str(failure))
    if isinstance(failure, CompileError):
        place = _PLACE.search(str(failure))
        yield Finding(
            f"the file does not compile: {failure}",
            where=place["where"] if place else "",
            hint="Correct what the compiler names.",
        )
        return
    try:
        build = arguments.build_of(subject)
    except CannotCheck as reason:
        if _undefined(failure):
            raise CannotCheck("the file does not link; see symbols.undefined") from reason
        if isinstance(failure, LoadError):
            yield Finding(str(failure), hint=_how(face, arguments.language(subject)))
            return
        raise
    if face.symbol not in build.functions:
        yield Finding(
            f"{build.source.name} has no function '{face.symbol}', under which a host looks for "
            f"{face.name.upper()}{_near(build, face)}",
            hint=_how(face, build.language),
        )


def _how(face: abi.Interface, language: str) -> str:
    upper = face.name.upper()
    if language in ("c", "c++"):
        behind = ' behind extern "C"' if language == "c++" else ""
        return f"Name the function FOR_NAME({face.name},{upper}) of omi_for_c.h{behind}."
    return f"Write SUBROUTINE {upper} outside of any MODULE and without BIND."


def _near(build: Build, face: abi.Interface) -> str:
    """The function that was probably meant."""
    for symbol in build.functions:
        module = re.match(rf"^__(\w+?)_MOD_{face.name}$", symbol)
        if module:
            return f"; '{face.name.upper()}' is inside of MODULE {module[1].upper()}"
        mangled = symbol.startswith(
            (f"_Z{len(face.name)}{face.name}", f"_Z{len(face.symbol)}{face.symbol}")
        )
        if mangled or symbol.lower().strip("_") == face.name:
            return f"; it has '{symbol}'"
    return ""


@rule(
    "symbols.undefined",
    "Everything that the routine calls is defined, in the file or by the solver.",
    reference="the solver links the file alone; one missing name stops the analysis",
    languages=_COMPILED,
)
def undefined(subject: Subject) -> Iterator[Finding]:
    failure = subject.failure
    if failure is None:
        try:
            arguments.build_of(subject)
        except CannotCheck as reason:
            failure = reason.__cause__ if isinstance(reason.__cause__, Error) else None
            if failure is None:
                raise
    if isinstance(failure, CompileError | MissingTool):
        raise CannotCheck("the file does not compile; see symbols.entry")
    found = _undefined(failure)
    if found:
        names = found["names"]
        yield Finding(
            f"{subject.interface.name.upper()} needs {names}, which neither the file nor usersub "
            "defines",
            where=_called(subject, names.split(",")[0].strip()),
            hint="Define it in the file, include the file that has it, or correct its name; an "
            "array that is not declared looks like a function.",
        )


def _not_compiled(subject: Subject, error: CompileError) -> Finding:
    """Why a Python function cannot be compiled."""
    return Finding(
        str(error),
        hint="Write what the compiler for Python understands, or run the function as it is: "
        f"@usersub.{subject.interface.name}(compiled=False).",
    )


def _undefined(failure: Error | None) -> re.Match | None:
    if not isinstance(failure, LoadError):
        return None
    return _UNDEFINED.search(str(failure)) or _UNRESOLVED.search(str(failure))


def _called(subject: Subject, name: str) -> str:
    """Where the source first mentions the name outside of comments, or ""."""
    try:
        source = arguments.source_of(subject)
    except (CannotCheck, NotApplicable):
        return ""
    try:
        lines = source.path.read_text(encoding="latin-1").splitlines()
    except OSError:
        return ""
    word = re.compile(rf"(?<!\w){re.escape(name)}\s*\(", re.IGNORECASE)
    for number, line in enumerate(lines, 1):
        comment = line[:1] in "cC*!" if source.language == "fortran" and not source.free else False
        code = re.split(r"!" if source.language == "fortran" else r"//|/\*", line)[0]
        if line and not comment and word.search(code):
            return f"{source.path.name}:{number}"
    return ""
