# SPDX-License-Identifier: MIT
"""`usersub abi`: the argument lists as tables."""

from __future__ import annotations

import re
from typing import Any

import click

from usersub import abi
from usersub.cli.command import Examples, common
from usersub.cli.output import print_facts, print_json, print_table


def interface_name(ctx: click.Context, parameter: click.Parameter, value: str | None) -> str | None:
    """The name of an interface in lower case; a mistyped one is a usage error."""
    if value is None:
        return None
    try:
        return abi.interface(value).name
    except KeyError as error:
        raise click.BadParameter(error.args[0]) from error


def modern_shape(face: abi.Interface, arg: abi.Arg) -> tuple[str, ...]:
    """Dimensions of an argument in the newer spelling, in which the arguments are printed."""

    def newer(found: re.Match[str]) -> str:
        place = face.positions.get(found.group().lower())
        return found.group() if place is None else face.args[place].modern

    return tuple(re.sub(r"[A-Za-z]\w*", newer, size) for size in arg.shape)


@click.command(
    "abi",
    cls=Examples,
    examples=("usersub abi", "usersub abi vfric", "usersub abi fric_coef --generation legacy"),
)
@click.argument("interface", required=False, callback=interface_name)
@click.option(
    "--generation",
    type=click.Choice([abi.LEGACY, abi.RELEASE_2022]),
    help="Generation of FRIC_COEF.",
)
@common("abi")
def command(interface: str | None, generation: str | None, as_json: bool) -> None:
    """Print the argument list of INTERFACE, or what interfaces there are.

    Every line says whether a published source confirms it or what is assumed.
    """
    if generation is not None and interface not in (None, "fric_coef"):
        raise click.BadParameter(
            f"{interface.upper()} has one generation only", param_hint="--generation"
        )
    faces = [
        face
        for face in abi.INTERFACES
        if interface in (None, face.name) and generation in (None, face.generation)
    ]
    if as_json:
        tables = {"abi_version": abi.ABI_VERSION, "abi_hash": abi.abi_hash()}
        print_json("abi", map(_as_dict, faces), **tables)
        return
    if interface is None:
        _overview(faces)
    else:
        for face in faces:
            _arguments(face)
    print_facts([("ABI version", abi.ABI_VERSION), ("hash", abi.abi_hash())])


def _as_dict(face: abi.Interface) -> dict[str, Any]:
    return {
        "interface": face.name,
        "generation": face.generation,
        "solver": face.solver,
        "symbol": face.symbol,
        "precisions": face.precisions,
        "purpose": face.purpose,
        "source": face.source,
        "assumed": face.assumed,
        "arguments": [
            {
                "position": i,
                "name": a.modern,
                "older_name": a.name,
                "aliases": a.aliases,
                "kind": a.kind,
                "shape": modern_shape(face, a),
                "intent": a.intent,
                "unit": a.unit,
                "meaning": a.meaning,
                "confirmed": a.confirmed,
                "assumed": a.assumed,
            }
            for i, a in enumerate(face.args, 1)
        ],
    }


def _overview(faces: list[abi.Interface]) -> None:
    rows = [
        (
            face.name.upper(),
            face.generation if face.name == "fric_coef" else "",
            face.solver,
            len(face.args),
            " ".join(face.precisions),
            face.purpose,
            face.source,
        )
        for face in faces
    ]
    columns = ("interface", "generation", "solver", "arguments", "precision", "supplies", "source")
    print_table("", columns, rows, right=("arguments",), wrap=("precision", "supplies", "source"))


def _arguments(face: abi.Interface) -> None:
    title = f"{face.name.upper()} ({face.solver}"
    title += f", generation {face.generation})" if face.name == "fric_coef" else ")"
    rows = []
    for position, arg in enumerate(face.args, 1):
        older = "" if arg.name == arg.modern else f" / {arg.name}"
        shape = ",".join(modern_shape(face, arg)) or "scalar"
        fact = "confirmed" if arg.confirmed else f"assumed: {arg.assumed}"
        rows.append(
            (position, arg.modern + older, arg.kind, shape, arg.intent, arg.unit, arg.meaning, fact)
        )
    columns = ("#", "name", "type", "dimension", "intent", "unit", "meaning", "source")
    print_table(title, columns, rows, right=("#",), wrap=("dimension", "unit", "meaning", "source"))
    facts = [("supplies", face.purpose), ("list from", face.source)]
    if face.assumed:
        facts.append(("assumed", face.assumed))
    print_facts(facts)
