# SPDX-License-Identifier: MIT
"""Sphinx configuration: `python -m sphinx -W -b html docs docs/_build/html`."""

import importlib.util
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

with (ROOT / "pyproject.toml").open("rb") as file:
    _project = tomllib.load(file)["project"]

project = _project["name"]
author = _project["authors"][0]["name"]
copyright = f"2026, {author}"  # noqa: A001 - the name is Sphinx's
release = version = _project["version"]

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.mathjax",
]
exclude_patterns = ["_build", "examples"]
html_theme = "furo"
html_title = f"usersub {release}"

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

# The pages can be built where the compiled part is not there.
if importlib.util.find_spec("usersub._core") is None:
    autodoc_mock_imports = ["usersub.core"]
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_class_signature = "separated"
napoleon_google_docstring = True
napoleon_numpy_docstring = False
nitpicky = False


def _command_help() -> str:
    """Help texts of all commands, from the commands themselves."""
    import click

    from usersub.cli.main import cli

    top = click.Context(cli, info_name="usersub", max_content_width=90)
    parts = [f"```text\n{cli.get_help(top)}\n```"]
    for name in cli.list_commands(top):
        command = cli.get_command(top, name)
        context = click.Context(command, info_name=name, parent=top, max_content_width=90)
        parts.append(f"## usersub {name}\n\n```text\n{command.get_help(context)}\n```")
    return "\n\n".join(parts)


def _insert_commands(app, name: str, source: list[str]) -> None:
    if name == "reference/command-line":
        source[0] = source[0].replace("@COMMANDS@", _command_help())


def setup(app) -> None:
    """Called by Sphinx."""
    app.connect("source-read", _insert_commands)
