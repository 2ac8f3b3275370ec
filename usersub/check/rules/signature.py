# SPDX-License-Identifier: MIT
"""The argument list as it is written: nothing is called."""

from __future__ import annotations

import difflib
from collections.abc import Iterator

from usersub import abi
from usersub.check.rule import CannotCheck, Finding, NotApplicable, rule
from usersub.check.source import arguments
from usersub.check.subject import Subject
from usersub.errors import AbiError, LoadError
from usersub.routine import signature
from usersub.routine.debuginfo import Signature

_MANUAL = "manual page of the interface"

#: Values that an integer argument can have; (), if any.
_LEGAL = {
    "NFDIR": (1, 2),
    "nFricDir": (1, 2),
    "MCRD": (2, 3),
    "nDir": (2, 3),
    "nFacNod": (2, 4),
    "nNodState": (1, 4),
    "nNodSlv": (1, 2),
    "nNodMst": (1, 2, 4),
}
#: Sizes that the user of the routine chooses, so that a number may be right.
_CHOSEN = ("NSTATV", "NPRED", "NPROPS", "nStateVar", "nStates", "nPred", "nFields", "nProps")


def _language(found: Signature) -> str:
    return "fortran" if found.fortran else "c"


def _where(found: Signature, position: int | None = None) -> str:
    line = found.line
    if position is not None and found.parameters[position].line:
        line = found.parameters[position].line
    return f"{found.file}:{line}"


def _counts(face: abi.Interface, found: Signature) -> tuple[int, ...]:
    """Numbers of arguments that are right; C may have the hidden lengths."""
    count, texts = len(face.args), sum(a.kind == "char" for a in face.args)
    return (count,) if found.fortran else (count, count + texts)


def _whole(subject: Subject) -> Signature:
    """The argument list, if its length is right."""
    found = arguments.signature_of(subject)
    if len(found.parameters) not in _counts(subject.interface, found):
        raise CannotCheck("the number of arguments is wrong; see signature.count")
    return found


@rule(
    "signature.count",
    "The routine has exactly the arguments of its interface.",
    reference=f"{_MANUAL}; files with invented lists link under the right name and write through "
    "wrong pointers",
)
def count(subject: Subject) -> Iterator[Finding]:
    face, found = subject.interface, arguments.signature_of(subject)
    present, right = len(found.parameters), _counts(face, found)
    if present in right:
        return
    allowed = f" (or {right[1]} with the lengths of the names)" if len(right) > 1 else ""
    yield Finding(
        f"{face.name.upper()} has {present} arguments, expected {right[0]}{allowed}"
        f"{_missing(face, found)}",
        where=_where(found),
        hint=f"The list is {', '.join(a.modern for a in face.args)}.",
    )


def _missing(face: abi.Interface, found: Signature) -> str:
    """Which arguments are not there, and which are not known, where the names tell."""
    names = [a.modern for a in face.args]
    own = [
        names[face.positions[p.name.lower()]] if p.name.lower() in face.positions else p.name
        for p in found.parameters
    ]
    if 2 * sum(name in names for name in own) < len(names):
        return ""
    parts = []
    steps = difflib.SequenceMatcher(None, names, own, autojunk=False).get_opcodes()
    for kind, i, j, k, m in steps:
        gone, more = j - i, m - k
        if kind == "replace" and gone == more:
            continue
        before = f" after {names[i - 1]}" if i else ""
        if gone > more:
            said = ", ".join(names[i:j])
            of = "" if gone - more == gone else f"{gone - more} of "
            parts.append(f"{of}{said} {'are' if gone > 1 else 'is'} missing{before}")
        elif more > gone:
            said = ", ".join(f"'{n or 'unnamed'}'" for n in own[k:m])
            instead = f"instead of {', '.join(names[i:j])}" if gone else "too many"
            parts.append(f"{said}{before} {'are' if more > 1 else 'is'} {instead}")
    return "; " + "; ".join(parts) if parts else ""


@rule(
    "signature.types",
    "Every argument has the kind and size that the host passes, by address.",
    reference=f"{_MANUAL}; ABA_PARAM.INC and VABA_PARAM.INC set the kinds of reals",
)
def types(subject: Subject) -> Iterator[Finding]:
    face, found = subject.interface, _whole(subject)
    spoken, precision = _language(found), arguments.precision(subject)
    unused = arguments.unused_of(subject)
    groups: dict[str, list[int]] = {}
    for i, fault in signature.faults(found, face, precision, spoken, unused):
        groups.setdefault(fault, []).append(i)
    for fault, positions in groups.items():
        first = positions[0]
        listed = [
            f"{i + 1}, '{found.parameters[i].name or 'unnamed'}' in the place of "
            f"{face.args[i].modern}"
            for i in positions[:3]
        ]
        more = len(positions) - 3
        who = "; ".join(listed) + (f"; and {more} more" if more > 0 else "")
        yield Finding(
            f"argument{'s' if len(positions) > 1 else ''} {who}: "
            f"{'each ' if len(positions) > 1 else ''}{fault}",
            where=_declared(subject, found, found.parameters[first].name) or _where(found, first),
            hint=_type_hint(found, face.args[first], first, fault),
        )


def _type_hint(found: Signature, argument: abi.Arg, position: int, fault: str) -> str:
    if not found.fortran:
        kind = {"real": "double or float as the solver's precision", "int": "int"}
        return f"Declare it as a pointer to {kind.get(argument.kind, 'char')}."
    if argument.kind == "real" and found.parameters[position].kind == "real":
        return "Include ABA_PARAM.INC (FRIC, FRIC_COEF) or VABA_PARAM.INC behind the list."
    if argument.kind == "char":
        return "Declare the three names CHARACTER*80."
    return f"Declare '{found.parameters[position].name}' as the table of the interface says."


def _declared(subject: Subject, found: Signature, name: str) -> str:
    if not found.fortran or not name:
        return ""
    try:
        return arguments.line_of_declaration(subject, name)
    except (CannotCheck, NotApplicable):
        return ""


# Dimensions.


@rule(
    "signature.dimensions",
    "Arrays with several dimensions have those of the interface, in their order.",
    reference=f"{_MANUAL}; rows and columns exchanged are a fault of published code",
)
def dimensions(subject: Subject) -> Iterator[Finding]:
    unit, face = arguments.unit_of(subject), subject.interface
    if len(unit.dummies) != len(face.args):
        raise CannotCheck("the number of arguments is wrong; see signature.count")
    unused = arguments.unused_of(subject)
    positions = {name: i for i, name in enumerate(unit.dummies)}
    for i, (name, argument) in enumerate(zip(unit.dummies, face.args, strict=True)):
        variable = unit.variables.get(name)
        if variable is None or i in unused or len(argument.shape) < 2:
            continue
        extents = tuple(_named(e, positions, face) for e in variable.extents)
        if len(extents) < 2 or not _differs(extents, argument.shape, face):
            continue
        exchanged = sorted(map(str, extents)) == sorted(argument.shape)
        own = ",".join(str(e).upper() for e in variable.extents)
        yield Finding(
            f"{name.upper()} (argument {i + 1}, {argument.modern}) is declared ({own}), but the "
            f"host passes ({','.join(_modern(face, s) for s in argument.shape)})"
            + (": rows and columns are exchanged" if exchanged else _otherwise(extents, argument)),
            where=arguments.line_of_declaration(subject, name)
            or _where(arguments.signature_of(subject), i),
            hint=f"Declare {name.upper()}({','.join(_modern(face, s) for s in argument.shape)}).",
        )
    for outside in arguments.subscripts_outside(subject, unit):
        i = positions[outside.name]
        yield Finding(
            f"{outside.text} lies outside of {outside.name.upper()} (argument {i + 1}), of which "
            f"the {_ORDINALS[outside.dimension - 1]} subscript ends at {outside.most}: another "
            "element is taken",
            where=outside.where,
            hint=f"The subscripts are {face.args[i].modern}"
            f"({','.join(_modern(face, s) for s in face.args[i].shape)}), in this order.",
        )


def _otherwise(extents: tuple, argument: abi.Arg) -> str:
    for axis, (own, right) in enumerate(zip(extents[:-1], argument.shape, strict=False)):
        if str(own) != right:
            return f", so that elements with a {_ORDINALS[axis + 1]} index above 1 are elsewhere"
    return ""


_ORDINALS = ("first", "second", "third")


def _modern(face: abi.Interface, size: str) -> str:
    position = face.positions.get(size.lower())
    return face.args[position].modern if position is not None else size


def _named(extent: int | str, positions: dict[str, int], face: abi.Interface) -> int | str:
    """An extent in the table's words: the argument that stands where the routine's own does; "?"
    for variables of modules and COMMON."""
    if isinstance(extent, int) or extent in ("*", ":"):
        return extent
    return face.args[positions[extent]].name if extent in positions else "?"


def _differs(extents: tuple[int | str, ...], shape: tuple[str, ...], face: abi.Interface) -> bool:
    """Whether elements lie elsewhere: all extents but the last decide that. What cannot be told
    from the text counts as right."""
    if any(e in ("?", ":") for e in extents):
        return False
    if len(extents) == len(shape) and sorted(map(str, extents)) == sorted(shape):
        return tuple(map(str, extents)) != shape
    rank = min(len(extents), len(shape))
    leading = zip(extents[: rank - 1], shape, strict=False)
    return any(_wrong(own, right, face) for own, right in leading)


def _wrong(own: int | str, right: str, face: abi.Interface) -> bool:
    """Whether a leading extent can never be the documented one."""
    if str(own) == right:
        return False
    if right.isdigit():
        # NFDIR in the place of a 2 is right in three dimensions.
        return not (isinstance(own, str) and int(right) in _LEGAL.get(own, ()))
    if isinstance(own, int):
        if right in _CHOSEN:
            return False
        if right == "nBlock" and face.name == "fric_coef":
            return own != 1
        return own not in _LEGAL.get(right, ())
    return own not in _CHOSEN and {own, right} != {"nBlock", "nBlockAnal"}


# Names.


@rule(
    "signature.names",
    "Names of surfaces are texts of at most 80 characters; Python routines use known arguments.",
    reference=f"{_MANUAL}: CHARACTER*80; older code has CHARACTER*8",
)
def names(subject: Subject) -> Iterator[Finding]:
    if arguments.language(subject) == "python":
        if isinstance(subject.failure, LoadError):
            raise CannotCheck("the file has no routine; see symbols.entry")
        if isinstance(subject.failure, AbiError):
            yield Finding(str(subject.failure), hint="Name arguments as the interface does.")
            return
        raise NotApplicable("the decorator checked the names of the arguments when it was read")
    face, found = subject.interface, _whole(subject)
    if not found.fortran:
        raise NotApplicable("C gets the address of a name, and its length is 80")
    unused = arguments.unused_of(subject)
    for i, argument in enumerate(face.args):
        parameter = found.parameters[i]
        length = parameter.size
        if argument.kind != "char" or parameter.kind != "char" or parameter.rank > 0:
            continue
        if length <= abi.NAME_LENGTH or i in unused:
            continue
        yield Finding(
            f"{parameter.name.upper()} (argument {i + 1}, {argument.modern}) is declared with "
            f"{length} characters, but the host passes {abi.NAME_LENGTH}: the rest is read beyond "
            "the name",
            where=_declared(subject, found, parameter.name) or _where(found, i),
            hint="Declare it CHARACTER*80.",
        )


# Order.


@rule(
    "signature.order",
    "Arguments that have names of the interface stand in the places of these names.",
    reference=f"{_MANUAL}; VFRICTION has dircosN before dircosSl, VFRIC the other way round",
    languages=("c", "c++", "fortran", "library"),
)
def order(subject: Subject) -> Iterator[Finding]:
    face, found = subject.interface, _whole(subject)
    unused = arguments.unused_of(subject)
    for i, parameter in enumerate(found.parameters[: len(face.args)]):
        right = face.positions.get(parameter.name.lower())
        if right is None or right == i or i in unused:
            continue
        passed = face.args[i].modern
        yield Finding(
            f"argument {i + 1} of {face.name.upper()} is called '{parameter.name}', which is the "
            f"name of argument {right + 1}; the host passes {passed} there",
            where=_where(found, i),
            hint=f"Put {face.args[right].modern} into place {right + 1} and {passed} into place "
            f"{i + 1}; the order counts, not the names.",
        )
