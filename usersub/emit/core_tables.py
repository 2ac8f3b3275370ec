# SPDX-License-Identifier: MIT
"""Makes the C core's own tables in `csrc/driver/`: arrays, settings, arguments of interfaces.

The `.inc` files are lists of macro calls; the C file that includes them defines the macros.
"""

from __future__ import annotations

from usersub import abi, ports
from usersub.emit import text
from usersub.emit.field_files import LONGEST_BLOCK

FOLDER = "csrc/driver/"

KINDS = {"real": "USUB_KIND_REAL", "int": "USUB_KIND_INT", "char": "USUB_KIND_CHAR"}
ROLES = ("in", "out", "add", "state")
#: As `usersub.routine.routine`: bit 0 read, bit 1 written.
INTENTS = {"read": 1, "write": 2, "readwrite": 3}

_COLUMNS = """\
/* PORT(name, drivers, kind, role, shape, unbound, unit, meaning)
 * drivers: bits USUB_FOR_...; shape: symbols separated by commas, first index fastest;
 * unbound: what the routine sees if the host binds nothing, "" if it has to be bound whenever the
 * routine reads it, "required" if it has to be bound always. */
"""


def artefacts() -> dict[str, str]:
    """`tables.h` with the numbers, and the lists."""
    return {
        FOLDER + "tables.h": _numbers(),
        FOLDER + "ports.inc": _ports(),
        FOLDER + "port_names.inc": _port_names(),
        FOLDER + "settings.inc": _settings(),
        FOLDER + "interfaces.inc": _interfaces(),
    }


def _enum(comment: str, rows: list[tuple[str, int]]) -> str:
    joined = ",\n".join(f"  {name} = {value}" for name, value in rows)
    return f"/* {comment} */\nenum {{\n{joined}\n}};\n"


def _numbers() -> str:
    drivers = [*abi.NAMES, "coefficient"]
    parts = [
        text.banner(__name__) + "#ifndef USUB_DRIVER_TABLES_H\n#define USUB_DRIVER_TABLES_H\n",
        _enum(
            "Whose driver has an array, as bits.",
            [(f"USUB_FOR_{name.upper()}", 1 << i) for i, name in enumerate(drivers)],
        ),
        _enum("Kind of an argument or array.", [(k, i) for i, k in enumerate(KINDS.values())]),
        _enum(
            "Role of an array: read, written, added to if bound, kept by the driver.",
            [(f"USUB_ROLE_{role.upper()}", i) for i, role in enumerate(ROLES)],
        ),
        _enum(
            "What a routine may do with an argument; the numbers of usub_routine_set_uses.",
            [(f"USUB_INTENT_{name.upper()}", value) for name, value in INTENTS.items()],
        ),
        "/* maxblk of the include files: routines have local arrays of this length. */\n"
        f"#define USUB_LONGEST_BLOCK {LONGEST_BLOCK}\n",
        "#endif\n",
    ]
    return "\n".join(parts)


def _ports() -> str:
    rows = []
    for port in ports.PORTS:
        drivers = " | ".join(f"USUB_FOR_{name.upper()}" for name in port.drivers)
        values = [
            text.c_string(port.name), drivers, KINDS[port.kind], f"USUB_ROLE_{port.role.upper()}",
            text.c_string(",".join(port.shape)), text.c_string(port.unbound),
            text.c_string(port.unit), text.c_string(port.meaning),
        ]  # fmt: skip
        rows.append("PORT(" + "\n".join(text.wrapped(values, 5)).lstrip() + ")")
    return text.banner(__name__) + _COLUMNS + "\n".join(rows) + "\n"


def _port_names() -> str:
    names = dict.fromkeys(port.name for port in ports.PORTS)
    return (
        text.banner(__name__)
        + "/* PORT_NAME(name) for every name of an array, each once. */\n"
        + "\n".join(f"PORT_NAME({name})" for name in names)
        + "\n"
    )


def _settings() -> str:
    rows = []
    for setting in ports.SETTINGS:
        values = [setting.key, repr(setting.default), text.c_string(setting.meaning)]
        if setting.kind == "text":
            values[1:2] = map(text.c_string, (str(setting.default), "|".join(setting.choices)))
        joined = "\n".join(text.wrapped(values, 13)).lstrip()
        rows.append(f"SETTING_{setting.kind.upper()}({joined})")
    return (
        text.banner(__name__)
        + "/* SETTING_INT(key, default, meaning), SETTING_REAL(key, default, meaning),\n"
        + " * SETTING_TEXT(key, default, choices separated by bars, meaning); key is a C name. */\n"
        + "\n".join(rows)
        + "\n"
    )


def _interfaces() -> str:
    lines = [
        text.banner(__name__)
        + "/* INTERFACE_BEGIN(key, name, generation, solver, driver bit, number of arguments)\n"
        + " * ARG(older name, newer name, kind, shape, intent) for each argument\n"
        + " * INTERFACE_END(key); key is a C name, in the order of USUB_INTERFACE_... */"
    ]
    for face in abi.INTERFACES:
        lines.append(
            f'INTERFACE_BEGIN({face.key}, "{face.name}", "{face.generation}", "{face.solver}", '
            f"USUB_FOR_{face.name.upper()}, {len(face.args)})"
        )
        lines += [
            f'ARG("{a.name}", "{a.modern}", {KINDS[a.kind]}, "{",".join(a.shape)}", '
            f"USUB_INTENT_{a.intent.upper()})"
            for a in face.args
        ]
        lines.append(f"INTERFACE_END({face.key})")
    return "\n".join(lines) + "\n"
