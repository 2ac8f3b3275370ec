# SPDX-License-Identifier: MIT
"""`usersub info`: what a routine file holds."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from usersub import abi
from usersub.cli.abi import interface_name, modern_shape
from usersub.cli.command import Examples, common
from usersub.cli.output import print_facts, print_json, print_table, relative
from usersub.errors import Error

#: The scene of the plan that is printed: isothermal, stateless, three-dimensional.
_POINTS = 64
_CORNERS = 4
_PER_INTERFACE: dict[str, dict[str, Any]] = {
    "fric_coef": {"elastic_slip": 1.0},
    "vfric": {"secondary_nodes": _POINTS, "main_nodes": _CORNERS},
    "vfriction": {"nodes": _POINTS + _CORNERS},
    "vfric_coef": {"nodes": _POINTS + _CORNERS},
}


@click.command(
    "info",
    cls=Examples,
    examples=("usersub info my_friction.f90", "usersub info my_friction.f90 --interface vfric"),
)
@click.argument("routine", type=click.Path(path_type=Path))
@click.option("--interface", "-i", callback=interface_name, help="Only this interface of the file.")
@click.option(
    "--precision",
    type=click.Choice(["double", "single"]),
    default="double",
    show_default=True,
    help="Precision in which the file is compiled.",
)
@common("info")
def command(routine: Path, interface: str | None, precision: str, as_json: bool) -> None:
    """Tell what the file ROUTINE (Python, C, C++, Fortran, library, or a built-in law) holds.

    Prints its interfaces, compiler and flags, the arguments that are used and written, data that
    outlives a call, other entries, and the plan of a driver. A file whose argument list is not that
    of its interface is refused, with the reason.
    """
    import usersub
    from usersub.routine.info import info

    routine = _file(routine)
    file = usersub.load(routine, precision=precision, interface=interface)
    found = info(file)
    plans = {name: _plan(file[name], precision) for name in file}
    if as_json:
        whole = found.as_dict()
        routines = whole.pop("routines")
        for row in routines:
            plan = plans[row["interface"]]
            row["plan"] = plan if isinstance(plan, str) else [vars(r) for r in plan.rows]
        print_json("info", routines, file=whole)
        return
    _print_file(found)
    for one in found.routines:
        _print_routine(one, plans[one.interface])


def _file(given: Path) -> Path:
    """The file to tell of; the name of a built-in law stands for its routine in Python."""
    from usersub import laws

    if given.is_dir():
        raise Error(f"{given} is a folder, expected a routine file")
    if given.name == str(given) in laws.LAWS and not given.exists():
        return laws.path(given.name, "python")
    return given


def _plan(routine: Any, precision: str) -> Any:
    """The plan of a driver in the default scene, or why there is none."""
    import usersub
    from usersub.scenefile.sample import bind_sample

    interface = routine.interface.name
    settings: dict[str, Any] = {"points": _POINTS, "dimension": 3, "precision": precision}
    settings |= _PER_INTERFACE.get(interface, {})
    try:
        driver = usersub.driver(routine, usersub.Scene(**settings))
        bind_sample(driver, interface, settings)
        return driver.plan
    except Error as error:
        return str(error)


def _print_file(found: Any) -> None:
    facts = [("file", relative(Path(found.path))), ("language", found.language)]
    if found.precision:
        facts.append(("precision", found.precision))
    if found.compiler:
        facts += [("compiler", found.compiler), ("flags", " ".join(found.flags))]
    if found.library and found.library != found.path:
        facts.append(("compiled", found.library))
    facts.append(("interfaces", ", ".join(r.interface.upper() for r in found.routines)))
    for name, words in (
        ("other entries", found.entries),
        ("functions", found.functions),
        ("shared state", found.shared_state),
        ("not defined", found.absent),
    ):
        if words:
            facts.append((name, ", ".join(words)))
    if found.writes_units:
        facts.append(("output", "writes to Fortran units"))
    print_facts(facts)


def _print_routine(one: Any, plan: Any) -> None:
    face = abi.interface(one.interface, one.generation)
    click.echo()
    title = one.interface.upper()
    if one.interface == "fric_coef":
        title += f", generation {one.generation}"
    facts = [
        ("interface", f"{title} ({face.solver})"),
        ("routine", one.name),
        (
            "argument list",
            f"{len(face.args)} arguments, "
            + ("compared with the table" if one.checked else "not checked"),
        ),
        ("threads", "may run in several" if one.thread_safe else "one only"),
    ]
    if one.interface == "fric_coef":
        facts.append(("points a call", "any number" if one.block_safe else "one"))
    facts += [("note", note) for note in one.notes]
    print_facts(facts)
    rows = [
        (
            a.name,
            a.declared if a.declared.lower() != a.name.lower() else "",
            a.kind,
            ",".join(modern_shape(face, arg)) or "scalar",
            a.does,
        )
        for a, arg in zip(one.arguments, face.args, strict=True)
        if a.does != "unused"
    ]
    title = f"{len(rows)} of {len(one.arguments)} arguments are used"
    print_table(f"\n{title}", ("argument", "called", "type", "dimension", "routine"), rows)
    if isinstance(plan, str):
        click.echo(f"no plan: {plan}")
        return
    click.echo(
        f"plan for {_POINTS} points in three dimensions, without temperatures, fields and state:"
    )
    click.echo(plan.explain().split("\n", 1)[1])
