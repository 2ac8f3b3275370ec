# SPDX-License-Identifier: MIT
"""Makes `csrc/probe/entries.inc`: the entries of the probe, from arguments to a list of them."""

from __future__ import annotations

from usersub import abi
from usersub.emit import text

PATH = "csrc/probe/entries.inc"


def artefacts() -> dict[str, str]:
    """One external function for each interface; two generations share theirs."""
    names = dict.fromkeys(face.name for face in abi.INTERFACES)
    head = (
        "/* <interface>_: hands the addresses of its arguments and the hidden lengths to\n"
        " * usub_probe_enter. Reals are `void *` here: the precision is found in the call. */\n"
    )
    entries = [_entry(abi.interface(name, abi.LEGACY)) for name in names]
    return {PATH: "\n".join([text.banner(__name__) + head, *entries])}


def _entry(face: abi.Interface) -> str:
    count, hidden = len(face.args), len(text.texts(face))
    pointers = [f"a{i}" for i in range(count)]
    lengths = [f"l{i}" for i in range(hidden)]
    parameters = [f"void *{p}" for p in pointers] + [f"size_t {x}" for x in lengths]
    # The declaration in front is for compilers that want one for every external function.
    return "\n".join(
        [
            f"USUB_PROBE_EXPORT void {face.symbol}(",
            *text.wrapped(parameters, 4),
            ");",
            f"void {face.symbol}(",
            *text.wrapped(parameters, 4),
            ") {",
            f"  void *const argv[{count}] = {{",
            *text.wrapped(pointers, 6),
            "  };",
            f"  const size_t lengths[{hidden}] = {{{', '.join(lengths)}}};",
            f"  usub_probe_enter({_number(face)}, argv, lengths);",
            "}\n",
        ]
    )


def _number(face: abi.Interface) -> str:
    return f"USUB_INTERFACE_{face.key.upper()}"
