# SPDX-License-Identifier: MIT
"""Makes `csrc/include/usersub/status.h`: status codes as an enum and as an X-macro list."""

from __future__ import annotations

from usersub.emit import text
from usersub.statuses import STATUSES

PATH = "csrc/include/usersub/status.h"

_HEAD = """\
/** @file status.h
 * Status codes. Zero is success, a positive number asks the host to act and leaves valid outputs,
 * a negative number means that nothing has changed. The numbers are fixed for ever.
 */
#ifndef USERSUB_STATUS_H
#define USERSUB_STATUS_H
"""


def artefacts() -> dict[str, str]:
    """The header."""
    rows = [
        f"  /* {s.text}; outputs: {s.outputs}; next: {s.next} */\n"
        f"  USUB_{s.name} = {s.value}{',' if s is not STATUSES[-1] else ''}"
        for s in STATUSES
    ]
    listed = " \\\n".join(f"  X({s.name}, {s.value}, {text.c_string(s.text)})" for s in STATUSES)
    return {
        PATH: text.banner(__name__)
        + _HEAD
        + "\nenum {\n"
        + "\n".join(rows)
        + "\n};\n\n"
        + "/** Every status as X(name, value, text), for tables. */\n"
        + f"#define USUB_STATUSES(X) \\\n{listed}\n\n#endif\n"
    }
