# SPDX-License-Identifier: MIT
"""Names and their hidden lengths."""

from __future__ import annotations

from collections.abc import Iterator

from usersub import abi
from usersub.check.hosts.evidence import Evidence, place
from usersub.check.hosts.log import Call
from usersub.check.hosts.rule import host_rule


def _given(call: Call) -> Iterator[str]:
    for arg in call.face.args:
        if arg.kind == "char":
            yield arg.modern


@host_rule(
    "host.names",
    f"Names have {abi.NAME_LENGTH} characters, upper case, filled up with blanks.",
    reference="manual pages of the interfaces (CHARACTER*80); Fortran compares and pads text with "
    "blanks and knows no end mark",
    hint="Fill an array of 80 characters with blanks and put the name in upper case at its start, "
    "without a NUL character.",
)
def names(evidence: Evidence) -> Iterator[str]:
    """NUL characters, lower case, leading blanks, unprintable characters."""
    blank = True
    seen = set()
    for call in evidence.need_calls():
        for name in _given(call):
            text = call.text(name)
            if len(text) < abi.NAME_LENGTH or text in seen:
                continue  # what is too short is told by host.arrays
            seen.add(text)
            found = _fault(text)
            if found:
                yield f"{name} {found}; {place(call)}"
                return
            blank &= not text.strip()
    if blank:
        evidence.say("all names are blank, so that their case was not seen")


def _fault(text: bytes) -> str | None:
    shown = repr(text.rstrip(b" \0").decode("latin-1"))
    if b"\0" in text:
        at = text.index(b"\0")
        return f"= {shown} holds a NUL at character {at + 1}; expected blanks up to character 80"
    if any(not 32 <= c < 127 for c in text):
        at = next(i for i, c in enumerate(text) if not 32 <= c < 127)
        return f"holds the character number {text[at]} at character {at + 1}; expected a name"
    if text.upper() != text:
        return f"= {shown} is not in upper case; expected {shown.upper()}"
    if text.strip() and text[:1] == b" ":
        return f"= {shown} begins with a blank; expected the name at the first character"
    return None


@host_rule(
    "host.hidden-lengths",
    "The lengths of the names follow the last argument, as 8-byte integers by value.",
    reference="calling convention of Fortran compilers; a routine that declares CHARACTER*(*) "
    "reads them, one that declares CHARACTER*80 does not",
    hint="Add three arguments `size_t` of value 80 at the end of the prototype and of the call.",
    severity="warning",
)
def hidden_lengths(evidence: Evidence) -> Iterator[str]:
    """Lengths other than 80."""
    for call in evidence.need_calls():
        for name, length in zip(_given(call), call.lengths, strict=False):
            if length == abi.NAME_LENGTH:
                continue
            what = f"the hidden length of {name} is {length}"
            if length & 0xFFFFFFFF == abi.NAME_LENGTH:
                what = f"the hidden length of {name} is passed in 4 bytes"
            yield f"{what}; expected 80 in 8 bytes; {place(call)}"
            return
