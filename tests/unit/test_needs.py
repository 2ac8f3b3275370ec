# SPDX-License-Identifier: MIT
"""Which arguments compiled code uses."""

from __future__ import annotations

from pathlib import Path

import pytest

import usersub
from usersub import abi
from usersub.routine import needs
from usersub.routine.debuginfo import Parameter, Signature
from usersub.routine.fortran_text import Unit
from usersub.routine.routine import READS, READS_AND_WRITES, UNUSED, WRITES

_FIELD = Path(__file__).resolve().parents[1] / "field"


def _used(routine) -> dict[str, int]:
    return {
        a.modern: does for a, does in zip(routine.interface.args, routine.uses, strict=True) if does
    }


def test_c_law_uses_what_it_names():
    assert _used(usersub.load(_FIELD / "vfric_coef_table.c").only()) == {
        "fCoef": WRITES,
        "nBlock": READS,
        "props": READS,
        "slipRate": READS,
    }


def test_cxx_unnamed_parameters_are_unused():
    used = _used(usersub.load(_FIELD / "fric_coef_throws.cpp").only())
    assert used["rData"] == READS_AND_WRITES
    assert set(used) == {
        "fCoef", "fCoefDeriv", "nBlock", "iData", "rData", "surfInt", "props", "slipData",
        "pressure",
    }  # fmt: skip


def test_arguments_that_come_out_of_one_macro(tmp_path):
    source = tmp_path / "law.c"
    source.write_text(
        "#include <omi_for_c.h>\n#include <usersub/usersub.h>\n"
        "void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) { fTangential[0] = -fNormal[0]; }\n"
        "void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) { fCoef[0] = 1; }\n"
    )
    file = usersub.load(source)
    assert _used(file["vfric"]) == {"fTangential": WRITES, "fNormal": READS}
    assert _used(file["vfric_coef"]) == {"fCoef": WRITES}


@pytest.mark.needs_fortran
def test_dimensions_count_as_used_and_shadows_do_not():
    used = _used(usersub.load(_FIELD / "vfric_directive.for").only())
    assert set(used) == {
        "fTangential", "nContact", "nSecNod", "nFricDir", "nProps", "jConSecid", "fStickForce",
        "fNormal", "props", "areaSec",
    } - ({"nProps", "nSecNod"} - set(used))  # fmt: skip
    assert used["fTangential"] == WRITES and used["nFricDir"] == READS


@pytest.mark.needs_fortran
def test_each_unit_of_a_file_has_its_own_list():
    """FRIC does not use FIELDAVG of the VFRIC_COEF in the same file, nor PROPS of a UEL."""
    file = usersub.load(_FIELD / "fric_with_entries.f")
    assert {"fCoef", "nBlock", "props", "fieldAvg"} <= set(_used(file["vfric_coef"]))
    assert "slipRate" not in _used(file["vfric_coef"])
    assert {"LM", "TAU", "PRESS", "DGAM", "CHRLNGTH"} <= set(_used(file["fric"]))
    assert "TEMP" not in _used(file["fric"]) and "STATEV" not in _used(file["fric"])


@pytest.mark.needs_fortran
def test_an_argument_that_is_only_handed_on_counts_as_used(tmp_path):
    source = tmp_path / "law.f90"
    names = "fc,fd,nb,np,nt,nf,jf,rd,a,b,c,props,rate,p,t,f"
    source.write_text(
        f"subroutine vfric_coef({names})\n include 'vaba_param.inc'\n character*80 a,b,c\n"
        " dimension fc(*), p(*)\n call helper(p)\n fc(1) = 1\ncontains\n"
        "subroutine helper(rate)\n dimension rate(*)\nend subroutine\nend\n"
    )
    assert set(_used(usersub.load(source).only())) == {"fCoef", "pressure"}


def _signature(symbol: str, names: list[str]) -> Signature:
    listed = tuple(Parameter(n, "real", 8, 0, "address", 1, 3 + i) for i, n in enumerate(names))
    return Signature(symbol, "a.f", 1, True, listed)


def test_warnings_belong_to_the_innermost_unit_before_them():
    units = [
        Unit("subroutine", "fric", "a.f", 1),
        Unit("subroutine", "helper", "a.f", 10),
        Unit("subroutine", "fric", "b.inc", 1),
    ]
    text = (
        "a.f:1:5: Warning: Unused dummy argument 'x' at (1) [-Wunused-dummy-argument]\n"
        "a.f:11:5: Warning: Unused dummy argument 'y' at (1) [-Wunused-dummy-argument]\n"
        "a.f:3:5: Warning: Dummy argument 'z' at (1) was declared INTENT(OUT) but was not set\n"
    )
    found = needs.unused_in_fortran(text, units, {"fric_": _signature("fric_", ["x", "y", "z"])})
    assert found == {"fric_": (0,)}


def test_what_is_not_known_is_none():
    assert needs.uses(abi.interface("fric"), None) is None


def test_table_says_how_a_used_argument_is_used():
    face = abi.interface("fric")
    found = needs.uses(face, (face.position("TAULM"),))
    assert found[face.position("TAULM")] == UNUSED
    assert found[face.position("TAU")] == READS_AND_WRITES
    assert found[face.position("DDTDDG")] == WRITES
    assert found[face.position("PRESS")] == READS
