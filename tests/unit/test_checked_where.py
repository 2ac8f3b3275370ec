# SPDX-License-Identifier: MIT
"""Checked drivers name file and line of the fault, in every language."""

from __future__ import annotations

import textwrap
from pathlib import Path

import numpy as np
import pytest

import usersub
from tests.unit.checked_hosts import Host, source
from usersub.errors import ContractError, RoutineError
from usersub.routine.places import locate

_FORTRAN = """\
      SUBROUTINE VFRIC_COEF(fCoef, fCoefDeriv, nBlock, nProps, nTemp,
     * nFields, jFlags, rData, surfInt, surfSlv, surfMst, props,
     * slipRate, pressure, tempAvg, fieldAvg)
      INCLUDE 'VABA_PARAM.INC'
      DIMENSION fCoef(nBlock), fCoefDeriv(nBlock,3), jFlags(2),
     * rData(3), props(nProps), slipRate(nBlock), pressure(nBlock),
     * tempAvg(nBlock), fieldAvg(nBlock,nFields)
      CHARACTER*80 surfInt, surfSlv, surfMst
      DO k = 1, nBlock
        fCoef(k) = props(1)
      END DO
      {statement}
      RETURN
      END
"""


def line_of(path: Path, mark: str) -> str:
    lines = path.read_text(encoding="utf-8").splitlines()
    return f"{path}:{1 + next(i for i, line in enumerate(lines) if mark in line)}"


def fails(host: Host, routine, expected: str, error=ContractError):
    driver = host.driver(routine)
    driver.time_limit = 0.1
    with pytest.raises(error) as raised:
        host.run(driver)
    assert driver.observed().where == raised.value.where == expected
    assert expected in str(raised.value)
    return driver.observed()


@pytest.mark.parametrize("suffix", [".c", ".cpp"])
@pytest.mark.parametrize(
    ("body", "error"),
    [
        ("TAU[*NFDIR] = 1; // here", ContractError),
        ("TAU[-1] = 1; // here", ContractError),
        ("*(double *)PRESS = 1; // here", ContractError),
        ("SED[0] = PROPS[*NPROPS]; // here", ContractError),
        ("while (*(volatile int *)LM >= 0) ; // here", RoutineError),
        ("*(volatile int *)8 = 1; // here", RoutineError),
        ("__builtin_memset(TAU, 0, 100000 + *NFDIR); // here\nSED[0] = 1;", ContractError),
        ("xit_(); // here\nSED[0] = 1;", RoutineError),
    ],
)
def test_c(tmp_path, suffix, body, error):
    extern = 'extern "C" ' if suffix == ".cpp" else ""
    text = source("fric", body, head=f"{extern}void xit_(void);\n{extern}").replace(
        f"{extern}\nvoid fric_", f"{extern}void fric_"
    )
    path = tmp_path / f"law{suffix}"
    path.write_text(text)
    fails(Host("fric"), usersub.load(path).only(), line_of(path, "// here"), error)


@pytest.mark.needs_fortran
@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize(
    ("statement", "error"),
    [
        ("fCoef(nBlock + 1) = 1.", ContractError),
        ("fCoef(nProps - 2) = 1.", ContractError),
        ("pressure(2) = 0.", ContractError),
        ("fCoef(2) = props(nProps + 1)", ContractError),
        ("CALL XPLB_EXIT", RoutineError),
    ],
)
def test_fortran(tmp_path, statement, error, precision):
    path = tmp_path / "law.for"
    path.write_text(_FORTRAN.format(statement=statement + "\n      fCoef(1) = 0."))
    routine = usersub.load(path, precision=precision).only()
    fails(Host("vfric_coef", precision=precision), routine, line_of(path, statement), error)


@pytest.mark.needs_fortran
def test_line_of_an_include_file(tmp_path):
    """The line is where it stands, not where it is included."""
    (tmp_path / "sub.inc").write_text("      pressure(1) = 0.\n")
    path = tmp_path / "law.for"
    path.write_text(_FORTRAN.format(statement="INCLUDE 'sub.inc'"))
    driver = (host := Host("vfric_coef")).driver(usersub.load(path).only())
    with pytest.raises(ContractError):
        host.run(driver)
    assert driver.observed().where.endswith("sub.inc:1")


@pytest.mark.parametrize(
    ("compiled", "statement", "words"),
    [
        (True, "fCoef[0] = props[props.size + int(fCoef.size) - 3]", "IndexError"),
        (False, "fCoef[0] = props[props.size + int(fCoef.size) - 3]", "IndexError"),
        (False, "pressure[1] = 0.0", "read-only"),
    ],
)
def test_python(tmp_path, compiled, statement, words):
    """Python looks at indices and inputs itself, compiled too; its twin finds the line."""
    path = tmp_path / "law.py"
    path.write_text(
        textwrap.dedent(f"""\
        import usersub

        @usersub.vfric_coef(compiled={compiled})
        def law(fCoef, props, pressure):
            fCoef[:] = 0.5
            {statement}  # here
        """)
    )
    routine = usersub.load(path).only()
    host = Host("vfric_coef")
    driver = host.driver(routine)
    with pytest.raises(RoutineError, match=words) as raised:
        host.run(driver)
    assert line_of(path, "# here") in str(raised.value)
    assert raised.value.where == line_of(path, "# here")
    assert driver.observed().what == "nothing"  # Python itself has looked


def test_copy_of_a_file_names_the_copy(tmp_path):
    """The compilation comes out of the cache; the line is in the file that was loaded."""
    text = source("fric", "SED[0] = PROPS[*NPROPS]; // here")
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir()
        path = tmp_path / folder / "law.c"
        path.write_text(text)
        fails(Host("fric"), usersub.load(path).only(), line_of(path, "// here"))


def test_no_debug_information(c_routine):
    """The fault is named all the same."""
    host = Host("fric")
    driver = host.driver(c_routine("fric", source("fric", "SED[0] = PROPS[*NPROPS];")))
    with pytest.raises(ContractError, match=r"PROPS\(3\)"):
        host.run(driver)
    seen = driver.observed()
    assert seen.where == ""
    place = locate(seen.place)
    assert place is not None
    assert place.function == "fric_"
    assert place.library.endswith("routine.so")


def test_address_in_no_file():
    assert locate(8) is None
    buffer = np.zeros(1 << 20)
    assert locate(buffer.ctypes.data) is None
