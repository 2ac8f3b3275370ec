# SPDX-License-Identifier: MIT
"""The figures of a page: what each is called, tells and shows, or why it is not there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from usersub.check.page import drawing, figures, history, tangents
from usersub.check.page.canvas import drawn
from usersub.check.page.figures import Data
from usersub.check.page.html import Html, element, join, paragraph
from usersub.check.rule import COEFFICIENT
from usersub.check.running import begin

if TYPE_CHECKING:
    from usersub.check.page.safely import Budget, Tried
    from usersub.check.reports.report import Result
    from usersub.check.subject import Subject


@dataclass(frozen=True)
class Kind:
    """A figure of a routine.

    Attributes:
        title: what it is called.
        compute: its numbers.
        draw: makes the drawing of them.
        caption: what it shows, one or two sentences.
        size: width and height, inches.
    """

    title: str
    compute: Callable[[Subject], Data]
    draw: Callable[[Data], drawing.Draw]
    caption: Callable[[Data], str]
    size: Callable[[Data], tuple[float, float]]


def _surface_size(data: Data) -> tuple[float, float]:
    return (9.0, 3.6) if data["by_rate"] and data["by_load"] else (5.4, 3.4)


def _surface_caption(data: Data) -> str:
    said = f"{data['ratio']} after a slide of {data['distance']:.3g} [length] at constant rate"
    what = data["load_name"].partition(" [")[0]
    if not data["by_load"]:
        said += f"; it does not depend on the {what}"
    elif not data["by_rate"]:
        said += "; it does not depend on the slip rate"
    if not np.isfinite(data["values"]).all():
        said += "; none where the point sticks"
    return f"{_range(data['values'])}: {said}."


def _loop_caption(data: Data) -> str:
    loads = " and ".join(f"{p:.3g}" for p in data["loads"])
    return (
        f"Response to a cycle of motion between {min(data['motion']):.3g} and "
        f"{max(data['motion']):.3g} at constant rate, at loads of {loads}; the thin line is the "
        "way from rest. "
        f"{_range(data['friction'])}."
    )


def _directions_caption(data: Data) -> str:
    sizes = np.hypot(*np.array(data["friction"]))
    return (
        f"The {data['ratio']} of points that slide in all directions; its size is between "
        f"{sizes.min():.4g} and {sizes.max():.4g}, and it is up to {data['angle']:.0f} degrees off "
        "the line of sliding. A law without preferred direction gives a circle and 0 degrees."
    )


def _dependence_caption(data: Data) -> str:
    said = "; ".join(f"along {c['name']}: {_range(c['y']).lower()}" for c in data["curves"])
    more = f" It does not depend on {' and '.join(data['without'])}." if data["without"] else ""
    return f"{drawing.capital(said)}.{more}"


def _stick_caption(data: Data) -> str:
    return (
        "Friction has to follow the stick force (dashed) as far as the force of a point that "
        f"slips, and to stay there. {_range(data['force'])}."
    )


def _tangent_caption(data: Data) -> str:
    worst = {e["name"]: _worst(e["error"]) for e in data["entries"]}
    name = max(worst, key=lambda n: worst[n])
    largest = f"the largest is {worst[name]:.2g}, in {name}"
    below = f"none is above {data['floor']:.0e}"
    return (
        "Error of every entry against differences of the routine's own stress, over the largest "
        "entry of its kind at the point, for points that slide from rest at about 30 degrees to "
        f"direction 1: {below if worst[name] <= data['floor'] else largest}."
    )


def _worst(error: list[list[float]]) -> float:
    values = np.array(error)
    return float(np.nanmax(values)) if np.isfinite(values).any() else 0.0


def _range(values: list) -> str:
    numbers = np.array(values, dtype=float)
    finite = numbers[np.isfinite(numbers)]
    if not finite.size:
        return "No values"
    for digits in (4, 9, 17):
        low, high = (f"{v:.{digits}g}" for v in (finite.min(), finite.max()))
        if low != high:
            break
    return f"Values from {low} to {high}"


def _fixed(width: float, height: float) -> Callable[[Data], tuple[float, float]]:
    return lambda data: (width, height)


_KINDS = {
    "surface": Kind(
        "Response surface", figures.surface, drawing.surface, _surface_caption, _surface_size
    ),
    "loop": Kind(
        "Hysteresis loop", figures.loop, drawing.loop, _loop_caption, _fixed(5.4, 3.6)
    ),
    "stick": Kind(
        "Friction force and stick force", figures.stick_force, drawing.stick_force,
        _stick_caption, _fixed(5.4, 3.6),
    ),
    "directions": Kind(
        "Friction in all directions", figures.directions, drawing.directions,
        _directions_caption, _fixed(4.6, 4.4),
    ),
    "dependence": Kind(
        "Temperature and field variables", figures.dependence, drawing.dependence,
        _dependence_caption, lambda d: (min(4.5 * len(d["curves"]), 13.5), 3.3),
    ),
    "tangent": Kind(
        "Error of the tangent, entry by entry", tangents.tangent, drawing.tangent,
        _tangent_caption, _fixed(9.0, 4.4),
    ),
}  # fmt: skip


def of_routine(subject: Subject, budget: Budget, name: str) -> Html:
    """All figures of a routine; `name` begins the identifiers in them."""
    interface = subject.interface.name
    kinds = dict(_KINDS)
    if interface not in ("vfric", "vfriction"):
        del kinds["stick"]
    if interface != "fric":
        del kinds["tangent"]
    if interface in COEFFICIENT:
        del kinds["directions"]
    if not subject.temperatures and not subject.fields:
        del kinds["dependence"]
    begin.use(subject)
    tried = budget.tried({key: partial(k.compute, subject) for key, k in kinds.items()})
    return join(_figure(kind, tried[key], f"{name}-{key}") for key, kind in kinds.items())


def _figure(kind: Kind, tried: Tried, name: str) -> Html:
    title, reason = element("h4", kind.title), tried.reason
    if tried.data:
        data = tried.data[0]
        try:
            svg = drawn(kind.draw(data), *kind.size(data), name)
            return element("div", title, framed(svg, kind.title, kind.caption(data)))
        except (ValueError, ArithmeticError) as error:  # numbers beyond what axes can hold
            reason = f"could not be drawn: {error}"
    return element("div", title, paragraph(drawing.capital(reason)), class_="instead")


def framed(svg: str, title: str, caption: str) -> Html:
    """A figure with its caption, which is its alternative text too."""
    picture = element("div", Html(svg), role="img", aria_label=f"{title}. {caption}")
    return element("figure", picture, element("figcaption", caption))


def of_case(subject: Subject, result: Result, budget: Budget, name: str) -> Html:
    """The failing case of a result drawn."""
    case = result.case
    assert case is not None
    begin.use(subject)
    tried = budget.tried({"case": partial(history.answers, subject, case)})["case"]
    mark = history.mark_of(case, result.figures)
    what = "what it is about" if result.severity == "note" else "the fault"
    said = [f"The case: motion, load and response; {mark.words(what)}."]
    if tried.reason:
        said.append(f"The response {tried.reason}.")
    if case.points > 1:
        said.append("Grey lines are other points.")
    svg = drawn(history.draw(subject, case, tried.data, mark), 9.6, 3.2, name)
    return framed(svg, f"Case that shows {result.rule}", " ".join(said))
