# SPDX-License-Identifier: MIT
"""pytest: `pytest --usersub-routine my_friction.f90` has one test for each rule.

Without the option the plugin does nothing and imports nothing of usersub.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from usersub.check.rule import Rule
    from usersub.check.running.session import Session
    from usersub.check.subject import Subject

_OPTIONS = (
    ("--usersub-routine", "append", "PATH", "check this routine file (or built-in law)"),
    ("--usersub-interface", "store", "NAME", "only this interface"),
    ("--usersub-precision", "store", "WHICH", "double (default), single or both"),
    ("--usersub-props", "store", "NUMBERS", "properties, separated by commas"),
    ("--usersub-states", "store", "N", "number of state variables"),
    ("--usersub-fields", "store", "N", "number of field variables"),
    ("--usersub-law", "store", "NAME", "built-in law that the routine claims to be"),
    ("--usersub-rule", "append", "PATTERN", "only these rules"),
    ("--usersub-skip-file", "append", "FILE", "rules to leave out, one a line"),
    ("--usersub-expect-file", "append", "FILE", "rules that are known to fail, one a line"),
)


def pytest_addoption(parser: pytest.Parser) -> None:
    """The options, in a group of their own."""
    group = parser.getgroup("usersub", "conformance of friction routines")
    for name, action, metavar, words in _OPTIONS:
        group.addoption(name, action=action, metavar=metavar, help=words, default=None)
    group.addoption(
        "--usersub-strict", action="store_true", help="a warning of usersub fails its test"
    )


def pytest_collection_modifyitems(
    session: pytest.Session, config: pytest.Config, items: list[pytest.Item]
) -> None:
    """Adds the tests of the routines behind those of the test suite."""
    if config.getoption("usersub_routine"):
        items.extend(_items(session, config))


# Before the plugins that choose among the tests (-k, -m).
pytest_collection_modifyitems = pytest.hookimpl(tryfirst=True)(pytest_collection_modifyitems)


def pytest_report_header(config: pytest.Config) -> list[str] | None:
    """What is checked."""
    routines = config.getoption("usersub_routine")
    if not routines:
        return None
    from usersub.check.reports.heads import versions

    words = ", ".join(f"{name} {version}" for name, version in versions().items())
    return [f"usersub checks {', '.join(routines)} ({words})"]


def _items(session: pytest.Session, config: pytest.Config) -> Iterator[pytest.Item]:
    from usersub.check.rules import all_rules
    from usersub.check.runner import selected
    from usersub.check.running import expectations
    from usersub.check.running.session import Session
    from usersub.check.subjects.targets import subjects, wishes
    from usersub.errors import Error

    try:
        wanted = selected(config.getoption("usersub_rule"))
        lists: dict[str, Any] = {
            name: _lists(config, f"usersub_{name}_file") for name in ("skip", "expect")
        }
        wish = wishes(
            config.getoption("usersub_interface"),
            config.getoption("usersub_precision"),
            config.getoption("usersub_law"),
            **_values(config),
        )
        for name, given in lists.items():
            for words in expectations.unknown(given, all_rules()):
                config.issue_config_time_warning(
                    pytest.PytestConfigWarning(f"--usersub-{name}-file: {words}"), stacklevel=2
                )
        for path in config.getoption("usersub_routine"):
            for subject in subjects(_target(config, path), wish):
                yield from _of_subject(session, Session(subject, **lists), wanted, subject, path)
    except Error as error:
        raise pytest.UsageError(str(error)) from error


def _target(config: pytest.Config, path: str) -> str:
    """The routine as the command line names it, which is relative to where pytest was called."""
    place = os.path.normpath(config.invocation_params.dir / path)
    return place if os.path.exists(place) else path


def _lists(config: pytest.Config, option: str) -> tuple:
    from usersub.check.running import expectations

    folder = config.invocation_params.dir
    files = config.getoption(option) or ()
    return tuple(line for file in files for line in expectations.read(folder / file))


def _values(config: pytest.Config) -> dict[str, Any]:
    from usersub.check.numbers import integer, numbers

    return {
        "props": numbers("--usersub-props", config.getoption("usersub_props")),
        "states": integer("--usersub-states", config.getoption("usersub_states")),
        "fields": integer("--usersub-fields", config.getoption("usersub_fields")),
    }


def _of_subject(
    session: pytest.Session, checks: Session, rules: list[Rule], subject: Subject, path: str
) -> Iterator[pytest.Item]:
    name = f"{path}[{subject.interface.name}-{subject.precision}]"
    parent = _Routine.from_parent(session, name=name, nodeid=name)
    for rule in rules:
        yield _RuleItem.from_parent(parent, name=rule.id, checks=checks, rule=rule)


class _Routine(pytest.Collector):
    """A routine behind one interface in one precision."""

    def collect(self) -> list[pytest.Item]:
        """Nothing: its items are made where the routine is."""
        return []


class _RuleFailed(Exception):  # noqa: N818 - an answer
    """A rule that failed; the message is the whole failure."""


class _RuleItem(pytest.Item):
    """One rule for one routine."""

    def __init__(self, *, checks: Session, rule: Rule, **more: Any) -> None:
        super().__init__(**more)
        self.checks, self.rule = checks, rule

    def runtest(self) -> None:
        """Looks at the rule in a child process."""
        from usersub.check.reports.text import failure_lines
        from usersub.check.rule import FAIL, PASS

        result = self.checks.one(self.rule)
        self.user_properties.append(("verdict", result.verdict))
        words = "\n".join(failure_lines(result)) if result.verdict == FAIL else result.detail
        grave = ("error", "warning") if self.config.getoption("usersub_strict") else ("error",)
        if result.verdict == PASS:
            if result.expected:
                raise _RuleFailed(
                    f"{result.rule} was expected to fail, but passed: take it off the list"
                )
        elif result.verdict != FAIL:
            pytest.skip(f"{result.verdict}: {result.detail}")
        elif result.expected:
            pytest.xfail(result.detail)
        elif result.severity in grave:
            raise _RuleFailed(words)
        else:
            file, _, line = result.where.rpartition(":")
            warnings.warn_explicit(
                pytest.PytestWarning(f"{result.rule}: {result.detail}"),
                category=pytest.PytestWarning,
                filename=file or str(self.reportinfo()[0]),
                lineno=int(line) if line.isdecimal() else 1,
            )

    def repr_failure(self, excinfo: pytest.ExceptionInfo, style: Any = None) -> Any:
        """The failure in the words of the report."""
        if isinstance(excinfo.value, _RuleFailed):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Any, int | None, str]:
        """File, line and title."""
        path = self.checks.subject.path or self.path
        return path, None, f"{self.parent.name if self.parent else ''} {self.rule.id}"
