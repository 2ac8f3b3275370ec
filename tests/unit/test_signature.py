# SPDX-License-Identifier: MIT
"""Argument lists of user code against the tables, before the first call."""

from __future__ import annotations

from pathlib import Path

import pytest

import usersub
from usersub import abi
from usersub.routine import signature
from usersub.routine.debuginfo import Parameter, Signature
from usersub.routine.info import info

_PLANTED = Path(__file__).resolve().parents[1] / "field" / "planted"
_SIZES = {"real": 8, "int": 4, "char": 80}


def _signature(face: abi.Interface, **changes: dict) -> Signature:
    """The list as gfortran would describe it, with changes by position (`a3={"kind": "int"}`)."""
    parameters = []
    for i, a in enumerate(face.args):
        values = {
            "name": a.name.lower(),
            "kind": a.kind,
            "size": _SIZES[a.kind],
            "rank": len(a.shape),
            "passing": "address",
            "line": 1,
            "column": 0,
        }
        parameters.append(Parameter(**(values | changes.get(f"a{i}", {}))))
    return Signature(face.symbol, "law.f", 1, True, tuple(parameters))


@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda face: face.key)
def test_the_published_list_fits(face):
    signature.check(_signature(face), face, "double", "fortran")


@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda face: face.key)
@pytest.mark.parametrize("change", [-1, 1])
def test_every_other_count_is_refused(face, change):
    found = _signature(face)
    listed = found.parameters[:-1] if change < 0 else (*found.parameters, found.parameters[0])
    found = Signature(found.symbol, found.file, found.line, True, listed)
    count, right = len(face.args) + change, len(face.args)
    sentence = rf"law\.f:1: .* has {count} arguments, expected {right};"
    with pytest.raises(usersub.AbiError, match=sentence):
        signature.check(found, face, "double", "fortran")


@pytest.mark.parametrize("face", abi.INTERFACES, ids=lambda face: face.key)
def test_every_wrong_kind_is_refused_at_its_place(face):
    other = {"real": ("int", 4), "int": ("real", 8), "char": ("real", 8)}
    for i, argument in enumerate(face.args):
        kind, size = other[argument.kind]
        found = _signature(face, **{f"a{i}": {"kind": kind, "size": size}})
        place = rf"argument {i + 1} \(.*in the place of {argument.modern}\)"
        with pytest.raises(usersub.AbiError, match=place):
            signature.check(found, face, "double", "fortran")


def test_names_decide_nothing():
    face = abi.interface("vfric")
    renamed = {f"a{i}": {"name": f"x{i}"} for i in range(len(face.args))}
    signature.check(_signature(face, **renamed), face, "double", "fortran")


def test_single_precision_expects_real4_and_integer4():
    face = abi.interface("vfriction")
    single = {f"a{i}": {"size": 4} for i, a in enumerate(face.args) if a.kind == "real"}
    signature.check(_signature(face, **single), face, "single", "fortran")
    with pytest.raises(usersub.AbiError, match=r"is real\*8, expected real\*4 in single precision"):
        signature.check(_signature(face), face, "single", "fortran")
    with pytest.raises(usersub.AbiError, match=r"is real\*4, expected real\*8 in double precision"):
        signature.check(_signature(face, **single), face, "double", "fortran")


def test_undeclared_unused_name_is_harmless_but_an_unused_number_is_not():
    face = abi.interface("fric")
    name = face.position("CINAME")
    found = _signature(face, **{f"a{name}": {"kind": "real", "size": 8}})
    signature.check(found, face, "double", "fortran", unused=frozenset({name}))
    number = face.position("NOEL")
    found = _signature(face, **{f"a{number}": {"kind": "real", "size": 8}})
    with pytest.raises(usersub.AbiError, match=r"is real\*8, expected integer\*4"):
        signature.check(found, face, "double", "fortran", unused=frozenset({number}))


def test_assumed_shape_and_values_are_refused():
    face = abi.interface("vfric_coef")
    found = _signature(face, a0={"passing": "descriptor"})
    with pytest.raises(usersub.AbiError, match="assumed shape"):
        signature.check(found, face, "double", "fortran")
    found = _signature(face, a2={"passing": "value"})
    with pytest.raises(usersub.AbiError, match=r"passed by value, expected the address 'int \*'"):
        signature.check(found, face, "double", "c")


@pytest.mark.parametrize(
    ("file", "sentence"),
    [
        ("vfric_coef_17.c", r"vfric_coef_17\.c:3: .* has 17 arguments, expected 16 \(or 19"),
        ("vfric_coef_kinds.c", r"argument 3 \('nBlock'.*by value.*argument 8 .*float \*, expected "
         r"double \*.*argument 12 .*'props'.* is long \*, expected double \*"),
    ],
)  # fmt: skip
def test_planted_c_faults(file, sentence):
    with pytest.raises(usersub.AbiError, match=sentence):
        usersub.load(_PLANTED / file)


@pytest.mark.needs_fortran
@pytest.mark.parametrize(
    ("file", "sentence"),
    [
        ("fric_38_arguments.f", r"fric_38_arguments\.f:3: FRIC has 38 arguments, expected 39;"),
        ("vfric_swapped.for", r"argument 26 \('fnormal', in the place of lContType\) is real\*8, "
         r"expected integer\*4; argument 30 \('lconttype', in the place of fNormal\)"),
        ("vfriction_real4.f", r"'ftangential'.* is real\*4, expected real\*8 in double precision"),
        ("fric_coef_names.f", r"argument 9 \('surfint'.* is real\*8, expected character"),
    ],
)  # fmt: skip
def test_planted_fortran_faults(file, sentence):
    with pytest.raises(usersub.AbiError, match=sentence):
        usersub.load(_PLANTED / file)


@pytest.mark.needs_fortran
def test_arguments_are_found_behind_includes_and_optimisation(tmp_path):
    """The whole routine stands in an include file; every argument counts all the same."""
    field = _PLANTED.parent
    (tmp_path / "body.inc").write_text((field / "vfriction_own_xit.f").read_text())
    (tmp_path / "my_limits.inc").write_text((field / "my_limits.inc").read_text())
    (tmp_path / "law.f").write_text("      INCLUDE 'BODY.INC'\n")
    found = info(usersub.load(tmp_path / "law.f"))
    used = [a.name for a in found.routines[0].arguments if a.does != "unused"]
    assert found.routines[0].checked
    assert {"fTangential", "fNormal", "fStickForce", "props", "surfInt", "nBlock"} <= set(used)
    assert "fTangPrev" not in used and "velSec" not in used


_GENERATIONS = [
    ("fCoef(nBlock)", "fCoef(1)", "x7", "y", "legacy"),
    ("fCoef(nBlock,2)", "fCoef(1,1)", "x7", "y", "2022"),
    ("fCoefDeriv(nBlock,20,2)", "fCoefDeriv(1,1,1)", "x7", "y", "2022"),
    ("y(nBlock,6)", "fCoef = y(1,4); p", "x7", "y", "2022"),
    ("idata(6)", "p", "iData", "slipData", "2022"),
    ("y", "fCoef", "jFlags", "slipRate", "legacy"),
    ("y", "p", "j7", "y", "2022"),
]


@pytest.mark.needs_fortran
@pytest.mark.parametrize(("declared", "set_", "seven", "thirteen", "expected"), _GENERATIONS)
def test_generation_of_fric_coef(tmp_path, declared, set_, seven, thirteen, expected):
    """Ranks decide, then names, then rank 1; unknown ones get the layout that has room for both."""
    source = tmp_path / "law.f90"
    source.write_text(
        f"subroutine fric_coef(fCoef,fCoefDeriv,nBlock,nProps,nTemp,nFields,{seven},r,a,b,c,props,"
        f"{thirteen},p,t,f)\n implicit real*8(a-h,o-z)\n integer x7\n dimension {declared}, z(1)\n"
        f" character*80 a, b, c\n {set_} = 1\n end\n".replace("dimension y, ", "dimension ")
    )
    assert usersub.load(source).only().interface.generation == expected
    if "(nBlock," in declared:
        with pytest.raises(usersub.AbiError, match="written for generation 2022"):
            usersub.load(source, generation="legacy")
    if expected == "legacy":
        assert usersub.load(source, generation="2022").only().interface.generation == "2022"
