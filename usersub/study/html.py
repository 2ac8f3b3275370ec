# SPDX-License-Identifier: MIT
"""Pieces of HTML. Text becomes HTML in `escaped` alone."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence


class Html(str):
    """Text that is HTML already; all other text is escaped when it gets into an element."""

    __slots__ = ()


#: What HTML cannot hold even when escaped.
_CONTROL = dict.fromkeys((*range(9), 11, 12, *range(14, 32), 127), "\ufffd")


def escaped(content: str) -> Html:
    """The content as HTML."""
    if isinstance(content, Html):
        return content
    readable = content.encode("utf-8", "replace").decode("utf-8").translate(_CONTROL)
    return Html(html.escape(readable, quote=True))


def element(tag: str, *content: str, **attributes: str | None) -> Html:
    """An element; attributes that are None are left out, `class_` is `class`, `a_b` is `a-b`."""
    shown = "".join(
        f' {name.rstrip("_").replace("_", "-")}="{escaped(value)}"'
        for name, value in attributes.items()
        if value is not None
    )
    return Html(f"<{tag}{shown}>{''.join(map(escaped, content))}</{tag}>")


def lines(parts: Iterable[str]) -> Html:
    """Parts one below the other."""
    return Html("\n".join(escaped(part) for part in parts if part))


def facts(pairs: Iterable[tuple[str, str]]) -> Html:
    """Names with what belongs to them."""
    found = [Html(element("dt", name) + element("dd", value)) for name, value in pairs]
    return element("dl", *found)


def bullets(items: Iterable[str]) -> Html:
    """A list."""
    return element("ul", *(element("li", item) for item in items))


def table(caption: str, head: Sequence[str], rows: Iterable[Sequence[str]]) -> Html:
    """A table; columns whose head begins with `>` have numbers, aligned to the right."""
    kinds = ["number" if name.startswith(">") else None for name in head]
    top = [
        element("th", name.lstrip(">"), scope="col", class_=kind)
        for name, kind in zip(head, kinds, strict=True)
    ]
    body = [
        element("tr", *(element("td", c, class_=k) for c, k in zip(row, kinds, strict=True)))
        for row in rows
    ]
    whole = element(
        "table", element("caption", caption), element("thead", element("tr", *top)),
        element("tbody", lines(body)),
    )  # fmt: skip
    return element("div", whole, class_="wide")


def section(title: str, *content: str, level: int = 2, id: str | None = None) -> Html:
    """A section with its heading."""
    return element("section", element(f"h{level}", title), lines(["", *content]), id=id)


def folded(title: str, *content: str) -> Html:
    """What is shown when one asks for it; on paper the title alone."""
    return element("details", element("summary", title), lines(content))
