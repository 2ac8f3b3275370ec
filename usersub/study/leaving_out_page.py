# SPDX-License-Identifier: MIT
"""The part of the chapter on cost about leaving out: prose from a template, numbers from runs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from usersub.study.tables import markdown

if TYPE_CHECKING:
    from usersub.study.leaving_out import Saving

_TEMPLATE = Path(__file__).with_name("leaving_out.md.in")
_SCENES = {
    "general": "three dimensions, temperatures, fields, state, derivatives",
    "two-dimensional": "two dimensions",
    "isothermal": "no temperatures and fields",
    "stateless": "no state variables",
    "derivative-free": "no tangents",
    "node-to-facet": "nodes against facets, not edges",
    "least": "nothing of all this",
    "half open": "half of the points are open",
}


def page(savings: Sequence[Saving]) -> str:
    """Markdown from `leaving_out.measure`: tables, what they mean, and targets."""
    text = _TEMPLATE.read_text(encoding="utf-8")
    fields = {
        "plan": plan_table(savings),
        "scenes": scene_table(savings),
        "verified": _verified(savings),
        "target": _target(savings),
    }
    for name, words in fields.items():
        text = text.replace(f"{{{name}}}", words)
    return text


def plan_table(savings: Iterable[Saving]) -> str:
    """What the plan saves in the same scene."""
    head = (
        "interface", "scene", "ns with the plan", "everything", "ratio", "bytes with the plan",
        "everything", "ratio", "memory with the plan", "everything",
    )  # fmt: skip
    return markdown(
        head,
        (
            (
                s.interface.upper(), _SCENES[s.scene], f"{s.ns_needed:.3g}", f"{s.ns_full:.3g}",
                f"{s.time_ratio:.2f}", s.bytes_needed, s.bytes_full, f"{s.bytes_ratio:.1f}",
                _bytes(s.memory_needed), _bytes(s.memory_full),
            )
            for s in savings
        ),
    )  # fmt: skip


def scene_table(savings: Iterable[Saving]) -> str:
    """What a scene saves that is told to be less than the general one."""
    head = (
        "interface", "scene", "ns, everything", "in the general scene", "saved", "bytes",
        "in the general scene", "memory", "in the general scene",
    )  # fmt: skip
    return markdown(
        head,
        (
            (
                s.interface.upper(), _SCENES[s.scene], f"{s.ns_full:.3g}", f"{s.ns_general:.3g}",
                f"{1 - s.ns_full / s.ns_general:.0%}", s.bytes_full, s.bytes_general,
                _bytes(s.memory_full), _bytes(s.memory_general),
            )
            for s in savings
            if s.scene not in ("general", "half open")
        ),
    )  # fmt: skip


def _bytes(memory: float) -> str:
    return "-" if math.isnan(memory) else f"{memory:.0f}"


def _verified(savings: Sequence[Saving]) -> str:
    bad = [s for s in savings if not (s.same_bits and s.untouched)]
    if not bad:
        return (
            f"In all {len(savings)} rows the answers are the same to the bit with the plan and "
            "with everything passed, and the routine runs with every left-out argument in a page "
            "that can neither be read nor written."
        )
    names = ", ".join(f"{s.interface.upper()} ({_SCENES[s.scene]})" for s in bad)
    return f"**Not so in {len(bad)} of {len(savings)} rows: {names}.**"


def _target(savings: Iterable[Saving]) -> str:
    """Whether VFRICTION has what was asked: 2.2 in time, 6 in bytes."""
    rows = [s for s in savings if s.interface == "vfriction" and s.scene == "node-to-facet"]
    if not rows:
        return "VFRICTION was not measured."
    one = rows[0]
    met = one.time_ratio >= 2.2 and one.bytes_ratio >= 6.0
    return (
        f"VFRICTION between nodes and facets: {one.time_ratio:.2f} times the time and "
        f"{one.bytes_ratio:.1f} times the bytes if everything is passed; asked for were at least "
        f"2.2 and 6: {'met' if met else '**not met**'}."
    )
