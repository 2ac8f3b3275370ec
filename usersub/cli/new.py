# SPDX-License-Identifier: MIT
"""`usersub new`: a routine or a law, a test and a scene that run at once."""

from __future__ import annotations

import keyword
import re
import sys
from pathlib import Path

import click

from usersub import abi
from usersub.cli.abi import interface_name, modern_shape
from usersub.cli.command import Examples, common
from usersub.cli.output import print_json, relative
from usersub.errors import Error

_TEMPLATES = Path(__file__).parent / "templates"
_SUFFIX = {"python": ".py", "c": ".c", "fortran": ".f90"}
#: Kinds of law: what the function of a contact point gives.
KINDS = ("coefficient", "strength", "traction", "bristle")
_IMPORTS = "from pathlib import Path\n\nimport numpy as np\nimport pytest\nimport usersub"
_IMPORTS_FORTRAN = "import shutil\n" + _IMPORTS
_SKIP_FORTRAN = """
pytestmark = pytest.mark.skipif(
    shutil.which("gfortran") is None,
    reason="gfortran is missing: install it to compile @FILE@",
)
"""
_WIDTH = 72
#: Modules that routines and tests import, directly or not, beside those of Python itself.
_MODULES = ("usersub", "numpy", "numba", "llvmlite", "cffi", "scipy", "pytest", "click", "rich")


def _name(ctx: click.Context, parameter: click.Parameter, value: str) -> str:
    """A name that can be that of a file and of a function."""
    fits = re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", value) and not keyword.iskeyword(value)
    if not fits or len(value) > _WIDTH - 10:
        raise click.BadParameter(
            f"'{value}' must be letters, digits and underscores, begin with a letter, be no "
            "Python keyword and not be too long"
        )
    if value in _MODULES or value in sys.stdlib_module_names:
        raise click.BadParameter(f"'{value}' would hide the Python module of that name")
    return value


@click.command(
    "new",
    cls=Examples,
    examples=(
        "usersub new my_friction --interface vfric --language python",
        "usersub new decay -i fric_coef -l fortran --dir laws",
        "usersub new my_law --law coefficient --language python",
    ),
)
@click.argument("name", callback=_name)
@click.option(
    "--interface",
    "-i",
    callback=interface_name,
    help=f"Make a routine behind one of {', '.join(abi.NAMES)}.",
)
@click.option(
    "--law",
    type=click.Choice(KINDS, case_sensitive=False),
    help="Make a law: one function of a contact point, behind every interface that can carry it. "
    "It gives a friction coefficient, the stress at which the point slips, the stress along the "
    "slip (viscous), or the traction of a motion, with memory (bristle).",
)
@click.option(
    "--language",
    "-l",
    required=True,
    type=click.Choice(list(_SUFFIX), case_sensitive=False),
    help="Language of the routine or law.",
)
@click.option(
    "--dir",
    "-d",
    "folder",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("."),
    help="Folder of the files; made if it is not there.",
)
@common("new")
def command(
    name: str,
    interface: str | None,
    law: str | None,
    language: str,
    folder: Path,
    as_json: bool,
) -> None:
    """Make NAME.py, NAME.c or NAME.f90 (a small friction law), test_NAME.py and NAME.toml.

    With --interface the file is a routine behind one interface, with --law one function behind
    every interface that can carry it. The test passes and the scene runs at once; change the law
    from there. Existing files are never overwritten.
    """
    if (interface is None) == (law is None):
        raise click.UsageError("give one of --interface (a routine) and --law (a law)")
    texts = (
        contents(name, interface, language)
        if interface is not None
        else law_contents(name, str(law), language)
    )
    files = {folder / file: text for file, text in texts.items()}
    for path in files:
        if path.exists():
            raise Error(f"{path} exists already and is not overwritten; choose another name")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Error(f"the folder {folder} cannot be made: {error.strerror}") from error
    for path, text in files.items():
        try:
            with path.open("x", encoding="utf-8") as stream:
                stream.write(text)
        except OSError as error:
            raise Error(f"{path} cannot be written: {error.strerror}") from error
    source, test, scene = (relative(p) for p in files)
    if as_json:
        first = "routine" if law is None else "law"
        kinds = zip((first, "test", "scene"), (source, test, scene), strict=True)
        print_json("new", [{"kind": k, "path": p} for k, p in kinds])
        return
    click.echo(f"made {source}, {test}, {scene}\n")
    click.echo(f"  usersub run {scene}\n  pytest {test}\n  usersub info {source}")


def contents(name: str, interface: str, language: str) -> dict[str, str]:
    """File name -> text of a routine behind one interface, its test and its scene."""
    face = abi.interface(interface)
    values = _values(name, language)
    values["HEADER"] = fortran_header(face) if language == "fortran" else ""
    values["PARAMETERS"] = f"USUB_{face.key.upper()}_PARAMETERS"
    return {
        values["FILE"]: _filled(face.name + _SUFFIX[language], values),
        f"test_{name}.py": _filled(f"test_{face.name}.py", values),
        name + ".toml": _filled(face.name + ".toml", values),
    }


def law_contents(name: str, kind: str, language: str) -> dict[str, str]:
    """File name -> text of a law of one of KINDS, its test and its scene."""
    values = _values(name, language)
    values["EXACT"] = _filled(f"exact_{kind}.py", {})
    return {
        values["FILE"]: _filled(f"law_{kind}{_SUFFIX[language]}", values),
        f"test_{name}.py": _filled("test_law.py", values),
        name + ".toml": _filled(f"law_{kind}.toml", values),
    }


def _values(name: str, language: str) -> dict[str, str]:
    """What the places of all templates are filled with; SKIP and IMPORTS hold a FILE."""
    fortran = language == "fortran"
    return {
        "IMPORTS": _IMPORTS_FORTRAN if fortran else _IMPORTS,
        "SKIP": _SKIP_FORTRAN if fortran else "",
        "FILE": name + _SUFFIX[language],
        "NAME": name,
    }


def _filled(template: str, values: dict[str, str]) -> str:
    """A template without its licence line, which is that of this project, and with its values."""
    text = (_TEMPLATES / (template + ".in")).read_text(encoding="utf-8").split("\n", 1)[1]
    for key, value in values.items():
        text = text.replace(f"@{key}@", value)
    return text


def fortran_header(face: abi.Interface) -> str:
    """The SUBROUTINE statement and the declarations of the arguments in free form."""
    include = "ABA_PARAM.INC" if face.solver == "standard" else "VABA_PARAM.INC"
    texts = [a.modern for a in face.args if a.kind == "char"]
    arrays = [f"{a.modern}({','.join(modern_shape(face, a))})" for a in face.args if a.shape]
    lines = [
        *_statement(f"subroutine {face.name}(", [a.modern for a in face.args], ")", indent=4),
        f"      INCLUDE '{include}'",
        *_statement(f"      character*{abi.NAME_LENGTH} ", texts, "", indent=8),
        *_statement("      dimension ", arrays, "", indent=8),
    ]
    return "\n".join(lines)


def _statement(head: str, items: list[str], tail: str, indent: int) -> list[str]:
    """A statement over as many continued lines as it needs."""
    lines, line = [], head
    for place, item in enumerate(items):
        piece = item + (tail if place == len(items) - 1 else ", ")
        if len(line) + len(piece) > _WIDTH and line != head:
            lines.append(line.rstrip() + " &")
            line = " " * indent
        line += piece
    return [*lines, line]
