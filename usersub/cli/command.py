# SPDX-License-Identifier: MIT
"""What all commands share: --json, --debug, nearest matches, errors as one sentence."""

from __future__ import annotations

import difflib
import functools
import sys
import traceback
from collections.abc import Callable
from typing import Any, NoReturn

import click

from usersub.errors import Error, RoutineError

#: Exit codes: all is well; it is not; the command was mistyped.
OK, FAILED, USAGE = 0, 1, 2


class Examples(click.Command):
    """A command whose help ends in examples, printed as they are typed."""

    def __init__(self, *args: Any, examples: tuple[str, ...] = (), **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.examples = examples

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Writes the examples."""
        super().format_epilog(ctx, formatter)
        if self.examples:
            with formatter.section("Examples"):
                for example in self.examples:
                    formatter.write(f"{'':>{formatter.current_indent}}{example}\n")


class Commands(click.Group):
    """The group of all commands: loads a command's module when it is asked for.

    Attributes:
        lazy: name of the command -> (module, one line of help).
    """

    def __init__(self, *args: Any, lazy: dict[str, tuple[str, str]], **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.lazy = lazy

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names in the order in which a new user wants them."""
        return list(self.lazy)

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        """Imports the command `name`, or None."""
        if name not in self.lazy:
            return None
        import importlib

        return importlib.import_module(self.lazy[name][0]).command

    def resolve_command(self, ctx: click.Context, args: list[str]) -> Any:
        """Finds the command; an unknown one is a usage error with the nearest match."""
        name = args[0]
        if name in self.lazy or name.startswith("-"):
            return super().resolve_command(ctx, args)
        near = difflib.get_close_matches(name, self.lazy, n=1, cutoff=0.4)
        hint = f" Did you mean '{near[0]}'?" if near else ""
        ctx.fail(f"No such command '{name}'.{hint} Commands: {', '.join(self.lazy)}.")

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Writes the list of commands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, text) for name, (_, text) in self.lazy.items()])


def common(name: str) -> Callable[[Callable[..., int | None]], Callable[..., None]]:
    """Decorates a command function: adds `--json` (passed as `as_json`) and `--debug`, turns its
    return value into the exit code and errors of usersub into one sentence on stderr."""

    def decorate(function: Callable[..., int | None]) -> Callable[..., None]:
        @click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
        @click.option("--debug", is_flag=True, help="Show the traceback of an error.")
        @functools.wraps(function)
        def run(*args: Any, debug: bool, as_json: bool, **kwargs: Any) -> None:
            try:
                code = function(*args, as_json=as_json, **kwargs)
            except Error as error:
                _fail(name, error, as_json, debug)
            except BrokenPipeError:
                raise
            except (OSError, MemoryError) as error:
                _fail(name, error, as_json, debug)
            sys.exit(code or OK)

        return run

    return decorate


def _fail(name: str, error: Exception, as_json: bool, debug: bool) -> NoReturn:
    from usersub.cli.output import print_json

    text = _sentence(error)
    if debug:
        traceback.print_exception(error, file=sys.stderr)
    else:
        click.echo(f"usersub {name}: {text}", err=True)
    if as_json:
        print_json(name, [], error={"kind": type(error).__name__, "message": text})
    sys.exit(FAILED)


def _sentence(error: Exception) -> str:
    if isinstance(error, OSError) and not isinstance(error, Error):
        place = f"{error.filename}: " if error.filename else ""
        return f"{place}{error.strerror or error}"
    if isinstance(error, MemoryError):
        return f"not enough memory: {error or 'the scene is too large for this machine'}"
    text = str(error) or type(error).__name__
    cause = error.__cause__
    if isinstance(error, RoutineError) and cause is not None and str(cause) not in text:
        text += f": {type(cause).__name__}: {cause}"
    return " ".join(text.split("\n"))
