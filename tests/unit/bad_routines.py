# SPDX-License-Identifier: MIT
"""Routines that do what no routine should, in C, and the sessions that look at them."""

from __future__ import annotations

from pathlib import Path

from usersub.check.rule import Rule
from usersub.check.running.session import Session
from usersub.check.subject import Scales
from usersub.check.subjects.targets import subjects, wishes

_HEAD = """\
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <usersub/abi.h>
void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {
  for (int k = 0; k < *nBlock; ++k)
    fCoef[k] = 0.3;
"""

#: What the routine does, by name.
BODIES = {
    "healthy": "",
    "exits": "  syscall(SYS_exit_group, 0);",
    "loops": '  if (slipRate[0] > 0.0)\n    for (;;)\n      __asm__ volatile("");',
    "prints": '  printf("rate %g\\n", (double)slipRate[0]);',
    "leaves_child": "  if (fork() == 0)\n    for (;;)\n      pause();",
}


def source(what: str, head: str = _HEAD) -> str:
    """C source of a VFRIC_COEF routine."""
    return f"{head}{BODIES[what]}\n}}\n"


def write(folder: Path, what: str) -> Path:
    """The source in a file of its own."""
    file = folder / f"{what}.c"
    file.write_text(source(what))
    return file


def session(file: Path, **options) -> Session:
    """A session in which nothing has to be found out."""
    wish = wishes(
        "vfric_coef", props=[0.3], states=0, fields=0, temperatures=False, scales=Scales()
    )
    made = Session(next(iter(subjects(file, wish))), **options)
    made._prepared = True  # what would be found out stands here
    return made


def rule(id: str, look=None, judge=None, *, severity="error", seconds=10.0, **more) -> Rule:
    """A rule that is in no list."""
    from usersub import abi

    words = {"requirement": f"{id} holds.", "reference": "the tests"}
    interfaces = more.pop("interfaces", abi.NAMES)
    languages = more.pop("languages", ())
    return Rule(
        id, words["requirement"], words["reference"], severity, interfaces, languages, look, judge,
        seconds,
    )  # fmt: skip
