# SPDX-License-Identifier: MIT
"""What `usersub study` is given: problems, laws, or the file of a routine."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Iterator, Mapping
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from usersub.check.subject import Subject
    from usersub.study import Result
    from usersub.study.result import Plain

#: Seconds that a routine may take until it is known what it needs.
_SECONDS = 30.0

#: Laws whose savings are measured one by one.
_SAVED = 2

#: Names in the default folder's name, at most.
_NAMED = 4


@dataclass(frozen=True)
class Targets:
    """What is studied.

    Attributes:
        problems, laws: names; `laws` are what the routine claims to be, if there is one.
        routine: file of a routine, or "".
        settings: by interface, what the routine needs.
    """

    problems: tuple[str, ...] = ()
    laws: tuple[str, ...] = ()
    routine: str = ""
    settings: Mapping[str, Mapping[str, Plain]] = field(default_factory=dict)

    def for_stability(self, options: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
        """Arguments of `usersub.study.stability.matrix`, for each call of it."""
        asked: dict[str, Any] = {n: options[n] for n in ("languages", "precisions") if options[n]}
        if not self.routine:
            yield {**asked, "laws": self.laws or None}
            return
        import usersub
        from usersub.study.motions import numbers
        from usersub.study.stability.subjects import Scales

        asked.pop("languages", None)
        file = usersub.load(self.routine)
        for name, needs in self.settings.items():
            slip, dt = float(needs["slip"]), float(needs["dt"])
            sizes = Scales(slip, slip / dt, float(needs["load"]), float(needs["temperature"]))
            yield {
                **asked, "routine": file[name], "props": numbers(needs["props"]),
                "states": int(needs["states"]), "scales": sizes,
            }  # fmt: skip

    def for_savings(self, results: list[Result]) -> Iterator[dict[str, Any]]:
        """Arguments of `usersub.study.leaving_out.measure`: for the user's routines, or for laws
        behind the interfaces that ran; of many laws the one that is the measure's own."""
        if self.routine:
            import usersub
            from usersub.study.motions import numbers

            file = usersub.load(self.routine)
            for name, needs in self.settings.items():
                yield {"routine": file[name], "props": numbers(needs["props"]),
                       "states": int(needs["states"])}  # fmt: skip
            return
        from usersub import laws

        ran = [r for r in results if r.ran and r.law in laws.LAWS]
        interfaces = tuple(dict.fromkeys(r.interface for r in ran))
        names = list(dict.fromkeys(r.law for r in ran))
        if len(names) > _SAVED:
            yield {"interfaces": interfaces}
            return
        for name in names:
            law = laws.law(name)
            yield {"routine": law(**law.example), "interfaces": interfaces}


def read(targets: tuple[str, ...], *, stability: bool, **options: Any) -> Targets:
    """What is meant by the words of the command line.

    Raises:
        UsageError: a word is no problem, law or file, or words do not go together.
        Error: the routine cannot be loaded.
    """
    from usersub.laws import LAWS
    from usersub.problems import PROBLEMS
    from usersub.study.motions import MOTIONS

    known = {**{n.lower(): n for n in PROBLEMS}, **{n: n for n in MOTIONS}}
    problems, laws, files = [], [], []
    for word in targets:
        if word.lower() in known:
            problems.append(known[word.lower()])
        elif word in LAWS and not Path(word).is_file():
            laws.append(word)
        elif Path(word).suffix or "/" in word:
            files.append(word)
        else:
            raise click.UsageError(_unknown(word, [*PROBLEMS, *MOTIONS, *LAWS]))
    if len(files) > 1:
        raise click.UsageError(f"{' '.join(files)}: expected one file")
    if files and laws:
        raise click.UsageError(f"say with --law {laws[0]} what {files[0]} claims to be")
    given = [f"--{n}" for n in ("law", "props", "states", "fields", "temperatures")
             if options[n] is not None]  # fmt: skip
    if given and not files:
        raise click.UsageError(f"{given[0]} is for the routine of a FILE, and there is none")
    if stability and problems:
        raise click.UsageError(f"--stability takes laws or a FILE, not the problem {problems[0]}")
    if not files:
        return Targets(tuple(problems), tuple(laws))
    return _of_file(files[0], tuple(problems), options)


def _unknown(word: str, names: list[str]) -> str:
    near = difflib.get_close_matches(word.lower(), [n.lower() for n in names], n=1, cutoff=0.4)
    right = next((n for n in names if near and n.lower() == near[0]), "")
    hint = f"; did you mean '{right}'?" if right else "."
    return f"there is no problem, law or file '{word}'{hint} See `usersub laws` for laws"


def _of_file(file: str, problems: tuple[str, ...], options: Mapping[str, Any]) -> Targets:
    """A routine: what was not given is found out by running it, as `usersub check` does."""
    from usersub.check.numbers import numbers
    from usersub.check.subjects.prepare import prepared
    from usersub.check.subjects.targets import subjects, wishes

    if not Path(file).is_file():
        from usersub.errors import LoadError

        raise LoadError(f"there is no file {file}")
    said = {n: options[n] for n in ("states", "fields", "temperatures") if options[n] is not None}
    wish = wishes(
        precision="double", law=options["law"], props=numbers("--props", options["props"]), **said
    )
    settings, laws = {}, []
    with redirect_stdout(sys.stderr):
        for subject in subjects(file, wish):
            name = subject.interface.name
            if options["interfaces"] and name not in options["interfaces"]:
                continue
            if subject.failure is not None:
                raise subject.failure
            subject = prepared(subject, _SECONDS)
            settings[name] = _settings(subject)
            laws += [subject.law] * bool(subject.law)
    return Targets(problems, tuple(dict.fromkeys(laws)), str(Path(file)), settings)


def _settings(subject: Subject) -> dict[str, Plain]:
    """What the motions need of it."""
    scales = subject.scales
    values = scales.fields or (0.0,) * subject.fields
    return {
        "props": " ".join(map(repr, subject.props)), "states": subject.states,
        "fields": " ".join(map(repr, values[: subject.fields])),
        "temperatures": subject.temperatures, "anisotropic": subject.anisotropic,
        "temperature": scales.temperature, "slip": scales.slip, "load": scales.load,
        "dt": scales.dt,
    }  # fmt: skip


def folder_name(chosen: Targets, stability: bool, quick: bool) -> str:
    """The folder of a study that was given none."""
    names = [Path(chosen.routine).stem] if chosen.routine else []
    names += chosen.problems
    names += () if chosen.routine else chosen.laws
    if len(names) > _NAMED:
        names = [*names[:_NAMED], "and-more"]
    words = ["study", *(name.replace(" ", "-") for name in names)]
    return "-".join([*words, *(["stability"] * stability), *(["quick"] * quick)])
