# SPDX-License-Identifier: MIT
"""The command line: `usersub demo | run | check | deck | laws | fit | info | new | ...`."""

from __future__ import annotations

import click

from usersub.cli.command import Commands
from usersub.cli.interrupt import end_when_interrupted

_LAZY = {
    "demo": ("usersub.cli.demo", "Run problems with known answers through every interface."),
    "run": ("usersub.cli.run", "Run a scene file: a routine through a history or a problem."),
    "check": ("usersub.cli.check", "Tell whether a routine keeps the contract of its interface."),
    "check-host": ("usersub.cli.check_host", "Tell whether a host calls routines as it should."),
    "study": ("usersub.cli.study", "Measure error against run time, and stability."),
    "deck": ("usersub.cli.deck", "Tell what an input deck says of friction, and what runs."),
    "laws": ("usersub.cli.laws", "List the shipped laws, or tell all of one."),
    "fit": ("usersub.cli.fit", "Find the properties of a law that fit measured coefficients."),
    "info": ("usersub.cli.info", "Tell what a routine file holds, uses and writes."),
    "new": ("usersub.cli.new", "Make a routine or a law, a test and a scene that run at once."),
    "abi": ("usersub.cli.abi", "Print the argument lists of the interfaces."),
    "paths": ("usersub.cli.paths", "Print the folders that hosts build against."),
}

_HELP = """Write friction user subroutines (FRIC, FRIC_COEF, VFRIC, VFRICTION, VFRIC_COEF) in
Python, C or Fortran and run them without the commercial solver.

\b
First steps:
  usersub demo
  usersub new my_friction --interface vfric --language fortran
  usersub run my_friction.toml

Exit code: 0 all is well, 1 it is not, 2 the command was mistyped."""


def _print_version(ctx: click.Context, parameter: click.Parameter, value: bool) -> None:
    if not value or ctx.resilient_parsing:
        return
    from usersub.cli.output import version

    click.echo(f"usersub {version()}")
    ctx.exit()


@click.group(
    cls=Commands, lazy=_LAZY, help=_HELP, context_settings={"help_option_names": ["-h", "--help"]}
)
@click.option(
    "--version",
    is_flag=True,
    expose_value=False,
    is_eager=True,
    callback=_print_version,
    help="Print the release.",
)
def cli() -> None:
    """All commands."""


def main() -> None:
    """Entry point of the script `usersub`."""
    end_when_interrupted()
    cli(prog_name="usersub")
