# SPDX-License-Identifier: MIT
"""`usersub new`: a routine, a test and a scene that run at once."""

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
    ),
)
@click.argument("name", callback=_name)
@click.option(
    "--interface",
    "-i",
    required=True,
    callback=interface_name,
    help=f"One of {', '.join(abi.NAMES)}.",
)
@click.option(
    "--language",
    "-l",
    required=True,
    type=click.Choice(list(_SUFFIX), case_sensitive=False),
    help="Language of the routine.",
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
def command(name: str, interface: str, language: str, folder: Path, as_json: bool) -> None:
    """Make NAME.py, NAME.c or NAME.f90 (a small friction law), test_NAME.py and NAME.toml.

    The test passes and the scene runs at once; change the law from there. Existing files are never
    overwritten.
    """
    files = {folder / file: text for file, text in contents(name, interface, language).items()}
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
        kinds = zip(("routine", "test", "scene"), (source, test, scene), strict=True)
        print_json("new", [{"kind": k, "path": p} for k, p in kinds])
        return
    click.echo(f"made {source}, {test}, {scene}\n")
    click.echo(f"  usersub run {scene}\n  pytest {test}\n  usersub info {source}")


def contents(name: str, interface: str, language: str) -> dict[str, str]:
    """File name -> text of routine, test and scene."""
    face = abi.interface(interface)
    suffix = _SUFFIX[language]
    fortran = language == "fortran"
    values = {
        "IMPORTS": _IMPORTS_FORTRAN if fortran else _IMPORTS,
        "SKIP": _SKIP_FORTRAN if fortran else "",
        "HEADER": fortran_header(face) if fortran else "",
        "PARAMETERS": f"USUB_{face.key.upper()}_PARAMETERS",
        "FILE": name + suffix,
        "NAME": name,
    }
    return {
        name + suffix: _filled(face.name + suffix, values),
        f"test_{name}.py": _filled(f"test_{face.name}.py", values),
        name + ".toml": _filled(face.name + ".toml", values),
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
