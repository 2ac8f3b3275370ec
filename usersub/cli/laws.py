# SPDX-License-Identifier: MIT
"""`usersub laws`: the shipped laws."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import click

from usersub.cli.command import Examples, common
from usersub.cli.output import print_facts, print_json, print_table

if TYPE_CHECKING:
    from usersub.laws import Law


@click.command(
    "laws",
    cls=Examples,
    examples=("usersub laws", "usersub laws exponential_decay", "usersub laws --json"),
)
@click.argument("name", required=False)
@common("laws")
def command(name: str | None, as_json: bool) -> None:
    """List the shipped laws, or tell all of the law NAME.

    Equation, interfaces that can carry it, properties, state variables, limits and source.
    """
    from usersub import laws

    chosen = [laws.law(name)] if name is not None else list(laws.LAWS.values())
    if as_json:
        print_json("laws", [_row(law) for law in chosen])
    elif name is not None:
        _print_one(chosen[0])
    else:
        _print_all(chosen)


def example(law: Law) -> str:
    """How a law object is made, as it is typed."""
    given = ", ".join(f"{k}={json.dumps(v)}" for k, v in law.example.items())
    return f"usersub.laws.{law.name}({given})"


def _row(law: Law) -> dict[str, Any]:
    return {
        "name": law.name,
        "title": law.title,
        "kind": law.kind,
        "equation": law.equation,
        "reads": law.reads,
        "anisotropic": law.anisotropic,
        "interfaces": law.interfaces,
        "refused": {i: law.refusal(i) for i in _refused(law)},
        "props": [
            {
                "name": p.name, "unit": p.unit, "meaning": p.meaning, "values": str(p.range),
                "default": p.default, "shape": p.shape, "counted": not p.given,
            }
            for p in law.props
        ],
        "vectors": [vars(v) for v in law.vectors],
        "states": [vars(v) for v in law.states],
        "limits": [{"case": case, "what": what} for case, what in law.limits],
        "notes": law.notes,
        "source": law.source,
        "example": example(law),
        "folder": law.folder,
    }  # fmt: skip


def _refused(law: Law) -> list[str]:
    from usersub import abi

    return [name for name in abi.NAMES if name not in law.interfaces]


def _print_all(chosen: list[Law]) -> None:
    rows = [
        (
            law.name,
            law.equations[0],
            " ".join(i.upper() for i in law.interfaces),
            ", ".join(p.name for p in law.props),
            ", ".join(v.name for v in (*law.vectors, *law.states)),
        )
        for law in chosen
    ]
    columns = ("law", "equation", "interfaces", "props", "states")
    print_table("", columns, rows, wrap=columns[1:], optional=("interfaces",))
    click.echo("FRIC keeps the elastic slip of a coefficient or strength besides these states.")
    click.echo("`usersub laws NAME` tells more of one law.")


def _print_one(law: Law) -> None:
    facts: list[tuple[str, Any]] = [("law", law.name), ("about", law.title), ("kind", law.kind)]
    facts += [("equation" if not i else "", line) for i, line in enumerate(law.equations)]
    facts.append(("reads", ", ".join(law.reads).replace("_", " ") or "nothing"))
    facts.append(("interfaces", ", ".join(i.upper() for i in law.interfaces)))
    facts += [(f"not {name.upper()}", law.refusal(name)) for name in _refused(law)]
    facts.append(("in Python", example(law)))
    print_facts(facts)
    if law.props:
        rows = [(p.name, p.meaning, p.unit, _values(p)) for p in law.props]
        print_table("properties", ("name", "meaning", "unit", "values"), rows, wrap=("meaning",))
    if law.vectors or law.states:
        rows = [
            (v.name, kind, v.meaning, v.unit, v.count)
            for kind, group in (("vector", law.vectors), ("number", law.states))
            for v in group
        ]
        columns = ("name", "kind", "meaning", "unit", "count")
        print_table("state variables", columns, rows, wrap=("meaning",))
    needs = [f"{i.upper()} {_states(law, i)}" for i in law.interfaces if _states(law, i)]
    print_facts([("states", ", ".join(needs) or "none")])
    print_table("limits", ("case", "what holds"), law.limits, wrap=("what holds",))
    for note in law.notes:
        click.echo(f"note: {note}")
    print_facts([("source", law.source.strip()), ("files", law.folder)])


def _states(law: Law, interface: str) -> int:
    """State variables in three dimensions, with the properties of the example."""
    return law.state_count(interface, props=law(**law.example).props)


def _values(prop: Any) -> str:
    words = [str(prop.range)] if str(prop.range) else []
    if prop.shape:
        words.insert(0, " x ".join(prop.shape))
    if not prop.given:
        words.append("counted")
    if prop.default is not None:
        words.append(f"default {prop.default}")
    return ", ".join(words)
