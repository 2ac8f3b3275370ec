# SPDX-License-Identifier: MIT
"""`usersub paths`: where headers, library and CMake package lie, for builds of hosts."""

from __future__ import annotations

import click

from usersub.cli.command import Examples, common
from usersub.cli.output import print_facts, print_json

_MEANING = {
    "prefix": "the folder with include/ and lib/",
    "include": "the folder to pass with -I",
    "library": "the shared library",
    "cmake": "the folder to pass as CMAKE_PREFIX_PATH or usersub_DIR",
    "pkgconfig": "the folder to put into PKG_CONFIG_PATH",
}


@click.command(
    "paths",
    cls=Examples,
    examples=(
        "usersub paths",
        "cmake -S . -B build -DCMAKE_PREFIX_PATH=$(usersub paths --prefix)",
        "cc host.c -I$(usersub paths --include) $(usersub paths --library)",
    ),
)
@click.option("--prefix", is_flag=True, help=f"Only {_MEANING['prefix']}.")
@click.option("--include", is_flag=True, help=f"Only {_MEANING['include']}.")
@click.option("--library", is_flag=True, help=f"Only {_MEANING['library']}.")
@click.option("--cmake", is_flag=True, help=f"Only {_MEANING['cmake']}.")
@click.option("--pkgconfig", is_flag=True, help=f"Only {_MEANING['pkgconfig']}.")
@common("paths")
def command(as_json: bool, **asked: bool) -> None:
    """Print the folders of the installed package that hosts in C, C++ and Fortran build against."""
    from usersub import paths

    wanted = [name for name, given in asked.items() if given]
    if len(wanted) > 1:
        raise click.UsageError(f"--{wanted[0]} and --{wanted[1]}: expected one of them")
    what = wanted[0] if wanted else None
    found = {
        "prefix": paths.prefix(),
        "include": paths.include_folder(),
        "library": paths.library_path(),
        "cmake": paths.cmake_folder(),
        "pkgconfig": paths.prefix() / "lib" / "pkgconfig",
    }
    if what is not None:
        found = {what: found[what]}
    if as_json:
        print_json("paths", [{"name": k, "path": str(v)} for k, v in found.items()])
    elif what is not None:
        click.echo(found[what])
    else:
        print_facts((k, v) for k, v in found.items())
