# SPDX-License-Identifier: MIT
"""The cdef text for cffi: the tagged region of `usersub.h` and the numbers that Python needs.

Reads the header as text; needs no compiler and no preprocessor.
"""

from __future__ import annotations

import re
from pathlib import Path

HEADER = Path(__file__).resolve().parents[2] / "csrc/include/usersub/usersub.h"

_REGION = re.compile(r"^/\* tag::cdef\[\] \*/$(.*?)^/\* end::cdef\[\] \*/$", re.M | re.S)


def tagged_region(header: Path = HEADER) -> str:
    """The declarations between the tags, as they stand in the header.

    Raises:
        ValueError: the header has no such region.
    """
    found = _REGION.search(header.read_text(encoding="utf-8"))
    if found is None:
        raise ValueError(f"{header} has no region tagged 'cdef'")
    return found.group(1).strip() + "\n"


def cdef_text(header: Path = HEADER) -> str:
    """What `FFI.cdef` gets: enums by their fixed numbers, then the declarations."""
    from usersub import abi
    from usersub.statuses import STATUSES

    statuses = ", ".join(f"USUB_{s.name} = {s.value}" for s in STATUSES)
    faces = ", ".join(f"USUB_INTERFACE_{f.key.upper()} = {i}" for i, f in enumerate(abi.INTERFACES))
    return (
        f"enum {{ {statuses} }};\nenum {{ {faces} }};\n"
        "#define USUB_ABI_VERSION ...\n#define USUB_NAME_LENGTH ...\n"
        "#define USUB_STYLE_FULL ...\n#define USUB_STYLE_BLOCK ...\n#define USUB_STYLE_POINTS ...\n"
        f"{tagged_region(header)}"
    )
