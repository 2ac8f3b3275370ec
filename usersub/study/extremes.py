# SPDX-License-Identifier: MIT
"""`extremes.json` in the folder of a study: stiff and extreme cases, limits, what is left out."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, is_dataclass
from pathlib import Path
from typing import Any

NAME = "extremes.json"


def write(folder: Path, parts: Mapping[str, Sequence[Any]]) -> Path:
    """Writes the parts by name, each a list of dataclasses; the file.

    Raises:
        OSError: it cannot be written.
    """
    told = {name: [_plain(asdict(row)) for row in rows if is_dataclass(row)  # type: ignore[arg-type]
                   ] for name, rows in parts.items()}  # fmt: skip
    path = folder / NAME
    path.write_text(json.dumps(told, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    return path


def read(folder: Path) -> dict[str, list[dict[str, Any]]]:
    """The parts of a study; none if it looked at none.

    Raises:
        ValueError: the file is not one of these.
    """
    path = folder / NAME
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def _plain(row: Mapping[str, Any]) -> dict[str, Any]:
    """What is not finite is null."""
    return {
        name: None if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in row.items()
    }
