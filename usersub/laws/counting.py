# SPDX-License-Identifier: MIT
"""Numbers of entries, as expressions of earlier properties: "nr", "2*n + 1", "sum(sizes)"."""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Mapping
from functools import cache

_OPERATIONS: dict[type, Callable] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
}
_FUNCTIONS: dict[str, Callable] = {"sum": sum, "product": math.prod}


@cache
def _parsed(expression: str) -> ast.expr:
    return ast.parse(expression or "1", mode="eval").body


def names(expression: str) -> set[str]:
    """Names of properties that an expression uses.

    Raises:
        SyntaxError: it is no expression.
    """
    found = {node.id for node in ast.walk(_parsed(expression)) if isinstance(node, ast.Name)}
    return found - set(_FUNCTIONS)


def evaluate(expression: str, known: Mapping[str, object]) -> int:
    """The whole number that `expression` of the values `known` is."""
    return int(_value(_parsed(expression), known))


def _value(node: ast.expr, known: Mapping[str, object]):
    if isinstance(node, ast.Constant) and isinstance(node.value, int):
        return node.value
    if isinstance(node, ast.Name):
        return known[node.id]
    if isinstance(node, ast.BinOp) and type(node.op) in _OPERATIONS:
        return _OPERATIONS[type(node.op)](_value(node.left, known), _value(node.right, known))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and len(node.args) == 1:
        return _FUNCTIONS[node.func.id](_value(node.args[0], known))
    raise ValueError(f"'{ast.unparse(node)}' is no sum or product of properties")
