# SPDX-License-Identifier: MIT
"""Derivatives of C laws: a file that defines USUB_LAW_DUAL is compiled once more, as C++.

Its quantities are numbers with derivatives then (`law/dual.h`), and the object that comes out has
nothing but the point function, which the object of the first reading calls.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from usersub.errors import CompileError, MissingTool
from usersub.routine import compilers

#: What the first reading calls, if the law asks for derivatives.
_FUNCTION = b"usub_law_dual"
_FLAGS = ("-std=gnu++17", "-DUSUB_DUAL_PASS", "-fno-exceptions", "-fno-rtti")


@dataclass(frozen=True)
class Reading:
    """The second reading of a file, preprocessed: what makes it, and where it lies."""

    compiler: compilers.Compiler
    command: tuple[str, ...]
    source: Path
    plain: Path

    @property
    def parts(self) -> tuple[str | bytes, ...]:
        """Everything that decides about the code, for the key of the cache."""
        return (self.compiler.version, *_FLAGS, self.plain.read_bytes())

    def compile(self) -> Path:
        """The object.

        Raises:
            CompileError: the file is C, but not C++ at the same time.
        """
        made = self.plain.with_suffix(".o")
        outcome = compilers.run(
            [*self.command, "-c", str(self.plain), "-o", str(made)], self.source.parent
        )
        if outcome.code:
            raise _refusal(self.compiler, self.source, outcome)
        return made


def read(
    source: Path, text: bytes, flags: tuple[str, ...], folders: list[Path], folder: Path
) -> Reading | None:
    """Preprocesses `source` for its second reading into `folder`; None if it needs none.

    Args:
        source: the law's file.
        text: the preprocessed text of the first reading.
        flags: of the first reading, without those of its language.
        folders: include folders.
        folder: where the text goes.

    Raises:
        MissingTool: no C++ compiler. CompileError: the preprocessor's words.
    """
    if _FUNCTION not in text:
        return None
    try:
        compiler = compilers.find("c++")
    except MissingTool as error:
        raise MissingTool(
            f"{source.name} defines USUB_LAW_DUAL, so its derivatives take a C++ compiler, but "
            f"{error}"
        ) from error
    command = (*compiler.command, *flags, *_FLAGS, *(f"-I{path}" for path in folders))
    plain = folder / "dual.ii"
    expand = [word for word in command if word != "-g"]
    outcome = compilers.run(
        [*expand, "-x", "c++", "-E", source.name, "-o", str(plain)], source.parent
    )
    if outcome.code:
        raise _refusal(compiler, source, outcome)
    return Reading(compiler, command, source, plain)


def _refusal(
    compiler: compilers.Compiler, source: Path, outcome: compilers.Outcome
) -> CompileError:
    words = compilers.refusal(compiler, source, outcome)
    return CompileError(f"{words}\n  (it is read as C++ too, since it defines USUB_LAW_DUAL)")
