# SPDX-License-Identifier: MIT
"""The declarations of `usersub.h`, understood by pycparser instead of by hand."""

from __future__ import annotations

import re
from dataclasses import dataclass

from pycparser import c_ast, c_parser

from usersub.emit import cdef

_PRELUDE = (
    "typedef int int32_t; typedef long int64_t; typedef unsigned long uint64_t; "
    "typedef unsigned long size_t;\n"
)
_COMMENT = re.compile(r"/\*.*?\*/", re.S)


@dataclass(frozen=True)
class Name:
    """A declared thing: `base` type, `const`, number of `pointers`, `length` of an array or 0."""

    name: str
    base: str
    const: bool
    pointers: int
    length: int = 0


@dataclass(frozen=True)
class Function:
    """A function: its name, what it returns and its parameters."""

    name: str
    result: Name
    parameters: tuple[Name, ...]


@dataclass(frozen=True)
class Declarations:
    """Handles (opaque types), structs with their members, callback types, functions, and the
    values of enumerations."""

    handles: tuple[str, ...]
    structs: dict[str, tuple[Name, ...]]
    callbacks: tuple[str, ...]
    functions: tuple[Function, ...]
    constants: dict[str, int]


def declarations() -> Declarations:
    """Parses the tagged region of the header."""
    region = _COMMENT.sub("", cdef.tagged_region())
    tree = c_parser.CParser().parse(_PRELUDE + region)
    handles, structs, callbacks, functions = [], {}, [], []
    constants: dict[str, int] = {}
    for node in tree.ext[4:]:
        if isinstance(node, c_ast.Typedef):
            if isinstance(node.type, c_ast.PtrDecl):
                callbacks.append(node.name)
            elif node.type.type.decls is None:
                handles.append(node.name)
            else:
                structs[node.name] = tuple(_name(d.name, d.type) for d in node.type.type.decls)
        elif isinstance(node, c_ast.Decl) and isinstance(node.type, c_ast.FuncDecl):
            functions.append(_function(node))
        elif isinstance(node, c_ast.Decl) and isinstance(node.type, c_ast.Enum):
            constants |= {e.name: int(e.value.value) for e in node.type.values.enumerators}
        else:
            raise ValueError(f"usersub.h declares something unexpected near {node.coord}")
    return Declarations(tuple(handles), structs, tuple(callbacks), tuple(functions), constants)


def _function(node: c_ast.Decl) -> Function:
    parameters = node.type.args.params if node.type.args else []
    named = [_name(p.name, p.type) for p in parameters]
    return Function(
        node.name,
        _name("", node.type.type),
        tuple(n for n in named if n.name),  # drops the lone `void`
    )


def _name(name: str | None, node: c_ast.Node) -> Name:
    pointers = length = 0
    while isinstance(node, c_ast.PtrDecl):
        node, pointers = node.type, pointers + 1
    if isinstance(node, c_ast.ArrayDecl):
        length, node = int(node.dim.value), node.type
    return Name(name or "", " ".join(node.type.names), "const" in node.quals, pointers, length)
