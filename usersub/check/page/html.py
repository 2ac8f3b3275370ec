# SPDX-License-Identifier: MIT
"""Pieces of HTML. Text becomes HTML in `element` alone, where it is escaped."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence


class Html(str):
    """Text that is HTML already; all other text is escaped when it gets into an element."""

    __slots__ = ()


Content = str | Html

_EMPTY = ("meta", "br", "hr")
#: What HTML cannot hold even when escaped, besides tabs and ends of lines.
_CONTROL = dict.fromkeys((*range(9), 11, 12, *range(14, 32), 127), "\ufffd")


def escaped(content: Content) -> Html:
    """The content as HTML."""
    if isinstance(content, Html):
        return content
    readable = content.encode("utf-8", "replace").decode("utf-8").translate(_CONTROL)
    return Html(html.escape(readable, quote=True))


def join(parts: Iterable[Content], between: str = "\n") -> Html:
    """Parts one after the other."""
    return Html(between.join(escaped(p) for p in parts if p))


def element(tag: str, *content: Content, **attributes: str | None) -> Html:
    """An element; attributes that are None are left out, `class_` is `class`, `a_b` is `a-b`."""
    shown = "".join(
        f' {name.rstrip("_").replace("_", "-")}="{escaped(value)}"'
        for name, value in attributes.items()
        if value is not None
    )
    if tag in _EMPTY:
        return Html(f"<{tag}{shown}>")
    return Html(f"<{tag}{shown}>{join(content, '')}</{tag}>")


def paragraph(*content: Content, class_: str | None = None) -> Html:
    """A paragraph."""
    return element("p", *content, class_=class_)


def code(text: str) -> Html:
    """Code within a sentence."""
    return element("code", text)


def listing(text: str, label: str, class_: str | None = None) -> Html:
    """Lines of code as they are; `label` says what they are to those who do not see them."""
    inside = element("code", text)
    return element("pre", inside, class_=class_, tabindex="0", role="region", aria_label=label)


def facts(pairs: Iterable[tuple[str, Content]]) -> Html:
    """Names with what belongs to them."""
    parts = [(element("dt", name), element("dd", value)) for name, value in pairs]
    return element("dl", *(piece for part in parts for piece in part))


def table(
    caption: str, head: Sequence[str], rows: Iterable[Sequence[Content]], class_: str | None = None
) -> Html:
    """A table; the first cell of every row is its header."""
    top = element("tr", *(element("th", name, scope="col") for name in head))
    body = [
        element("tr", element("th", row[0], scope="row"), *(element("td", c) for c in row[1:]))
        for row in rows
    ]
    whole = element(
        "table", element("caption", caption), element("thead", top), element("tbody", *body)
    )
    return element("div", whole, class_=join(["wide", class_ or ""], " ").strip())


def section(title: str, *content: Content, level: int = 2, id: str | None = None) -> Html:
    """A section with its heading."""
    return element("section", element(f"h{level}", title), join(content), id=id)
