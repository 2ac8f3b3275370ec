# SPDX-License-Identifier: MIT
"""What routines read, found by running them; the truth is what their source says."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import usersub
from usersub import laws
from usersub.check.subject import Subject
from usersub.check.subjects import tracing, values, wants
from usersub.errors import RoutineError

_FIELD = Path(__file__).resolve().parents[1] / "field"

_C_HEAD = """\
#include <math.h>
#include <usersub/abi.h>
#include <omi_for_c.h>
extern void FOR_NAME(xit, XIT)(void);
extern void FOR_NAME(xplb_abqerr, XPLB_ABQERR)(int *, char *, int *, double *, char *, long, long);
"""
_VFRIC = (
    _C_HEAD
    + """
void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {{
  for (int k = 0; k < *nContact; ++k) {{
    const int n = jConSecid[k] - 1;
    (void)n;
    {body}
  }}
}}
"""
)


def subject_of(path: Path, interface: str = "", **more: object) -> Subject:
    """The routine of a file as a subject of which nothing is known."""
    file = usersub.load(path)
    routine = file[interface] if interface else file.only()
    return Subject(path.name, routine.interface, routine=routine, path=path, file=file, **more)  # type: ignore[arg-type]


def vfric(folder: Path, body: str) -> Subject:
    """VFRIC in C with a body for contact point k on node n."""
    path = folder / "vfric.c"
    path.write_text(_VFRIC.format(body=body))
    return subject_of(path)


def found(subject: Subject, **given: object) -> Subject:
    return tracing.find(subject.but(**given), given=set(given))


#: Body and what it reads: properties, states, fields, temperatures.
_BODIES = {
    "nothing": ("fTangential[*nFricDir * k] = -0.3 * fNormal[k];", (0, 0, 0, False)),
    "three": ("fTangential[*nFricDir * k] = -(props[0] + props[2]) * fNormal[k];",
              (3, 0, 0, False)),
    "in a branch": ("if (dSlipFric[*nDir * k] > 1) fTangential[*nFricDir * k] = -props[4];"
                    " else fTangential[*nFricDir * k] = -props[0] * fNormal[k];",
                    (5, 0, 0, False)),
    "state": ("statev[*nStateVar * n + 1] += 1; fTangential[*nFricDir * k] = -.3 * fNormal[k];",
              (0, 2, 0, False)),
    "optional state": ("if (*nStateVar > 2) statev[*nStateVar * n + 2] += 1;"
                       " fTangential[*nFricDir * k] = -.3 * fNormal[k];", (0, 3, 0, False)),
    "all of the state": ("for (int i = 0; i < *nStateVar; ++i) statev[*nStateVar * n + i] += 1;"
                         " fTangential[*nFricDir * k] = -.3 * fNormal[k];", (0, 2, 0, False)),
    "fields": ("fTangential[*nFricDir * k] = -(.3 + .1 * preDefSec[k + 2 * *nContact])"
               " * fNormal[k];", (0, 0, 3, False)),
    "temperature": ("fTangential[*nFricDir * k] = -(.3 + 1e-4 * (tempSec[k] - tempMain[k]))"
                    " * fNormal[k];", (0, 0, 0, True)),
    "temperature if there is one": (
        "fTangential[*nFricDir * k] = -.3 * fNormal[k] * (*nTemp > 0 ? exp(-1e-3 * tempSec[k])"
        " : 1);", (0, 0, 0, True)),
    "optional property": ("fTangential[*nFricDir * k] = -props[0] * fNormal[k]"
                          " / (*nProps > 1 ? 1 + props[1] : 1);", (2, 0, 0, False)),
}  # fmt: skip


@pytest.mark.parametrize("name", _BODIES)
def test_what_a_routine_reads(tmp_path, name):
    body, expected = _BODIES[name]
    subject = found(vfric(tmp_path, body))
    reads = len(subject.props), subject.states, subject.fields, subject.temperatures
    assert reads == expected
    assert set(subject.origin) >= {"props", "states", "fields", "temperatures"}


def test_how_it_was_found_is_told(tmp_path):
    origin = found(vfric(tmp_path, _BODIES["three"][0])).origin
    assert origin["props"].startswith("traced: the routine reads props(1) to props(3); values cho")
    assert origin["states"] == "traced: the routine reads no state variables"
    assert origin["temperatures"] == "traced: no reading of temperatures was seen"
    origin = found(vfric(tmp_path, _BODIES["optional state"][0])).origin
    assert "where there are any, and goes on with none" in origin["states"]
    origin = found(vfric(tmp_path, _BODIES["all of the state"][0])).origin
    assert "as many state variables as there are" in origin["states"]


def test_what_was_given_stays(tmp_path):
    subject = vfric(tmp_path, _BODIES["three"][0])
    one = found(subject, props=(0.5, 7.0, 0.25))
    assert one.props == (0.5, 7.0, 0.25)
    assert one.origin["props"] == "given"
    two = found(subject, states=4, temperatures=True)
    assert (two.states, two.temperatures, len(two.props)) == (4, True, 3)


@pytest.mark.parametrize(
    "body",
    [
        'if (*nProps != 4) FOR_NAME(xit, XIT)(); fTangential[*nFricDir * k] = -.1 * fNormal[k];',
        'if (*nProps < 4) { int level = -3; double none = 0; FOR_NAME(xplb_abqerr, XPLB_ABQERR)('
        '&level, "four material constants are needed", &level, &none, " ", 34, 1); }'
        " fTangential[*nFricDir * k] = -props[3] * fNormal[k];",
    ],
    ids=["exit", "message"],
)  # fmt: skip
def test_refusals_are_answered_with_more_properties(tmp_path, body):
    assert len(found(vfric(tmp_path, body)).props) == 4


def test_refusals_may_be_about_state(tmp_path):
    body = (
        "if (*nStateVar < 7) { int level = -3; double none = 0; FOR_NAME(xplb_abqerr, XPLB_ABQERR)("
        '&level, "seven state variables, please", &level, &none, " ", 29, 1); }'
        " fTangential[*nFricDir * k] = -props[0] * fNormal[k];"
    )
    subject = found(vfric(tmp_path, body))
    assert (subject.states, len(subject.props)) == (7, 1)


def test_values_that_are_refused_are_not_taken(tmp_path):
    """The second property has to be large; with 0.2 the routine stops."""
    body = (
        "if (props[1] < 50) FOR_NAME(xit, XIT)();"
        " fTangential[*nFricDir * k] = -props[0] * fNormal[k] * props[1] / (1 + props[1]) "
        "* (1 + props[2]);"
    )
    subject = found(vfric(tmp_path, body))
    assert len(subject.props) == 3
    assert subject.props[1] >= 50


def test_values_give_ordinary_friction(tmp_path):
    """As first tried the friction would point along the motion, or be far above the load."""
    body = "fTangential[*nFricDir * k] = -(props[0] - 20 * props[1]) * fNormal[k];"
    first, second = found(vfric(tmp_path, body)).props
    assert 0.02 <= first - 20 * second <= 1.2
    body = "fTangential[*nFricDir * k] = -fmin(1e5 * props[0], 40 * fNormal[k]);"
    assert 1e5 * found(vfric(tmp_path, body)).props[0] <= 12.0


def test_every_property_matters_where_it_can(tmp_path):
    """props(2) is a threshold of the force; at 0.2 every force would be beyond it."""
    body = "fTangential[*nFricDir * k] = -(fNormal[k] > 5 * props[1] ? .1 : props[0]) * fNormal[k];"
    subject = found(vfric(tmp_path, body))
    assert "changed nothing" not in subject.origin["props"]
    body = "fTangential[*nFricDir * k] = -(props[0] + 0 * props[1]) * fNormal[k];"
    assert "props(2) changed nothing" in found(vfric(tmp_path, body)).origin["props"]


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("volatile double x = props[0]; while (x > 0) x = x + 1e-9;",
         "the routine did not return within"),
        ("*(volatile int *)8 = 1;", "memory fault"),
        ("fTangential[*nFricDir * k] = NAN;", "fTangential"),
    ],
    ids=["endless", "crash", "nan"],
)  # fmt: skip
def test_routines_that_cannot_be_run(tmp_path, body, words):
    subject = found(vfric(tmp_path, body))
    assert words in subject.origin["props"]
    assert not subject.props or len(subject.props) == 1


def test_tables_that_count_their_points(tmp_path):
    """props: number of points, then rates, then coefficients: with 2 points there are 5."""
    body = """
    const int points = (int)props[0];
    const double rate = dTimCur[0] > 0 ? dSlipFric[*nDir * k] / dTimCur[0] : 0;
    double mu = 0;
    for (int i = 0; i + 1 < points; ++i)
      if (rate >= props[1 + i] || i == 0)
        mu = props[1 + points + i] + (props[2 + points + i] - props[1 + points + i])
             * fmin(fmax((rate - props[1 + i]) / (props[2 + i] - props[1 + i]), 0), 1);
    fTangential[*nFricDir * k] = -mu * fNormal[k];"""
    subject = found(vfric(tmp_path, body))
    assert len(subject.props) == 1 + 2 * int(subject.props[0])
    assert values.cost(subject) == 0.0


def test_properties_that_nobody_asks_for(tmp_path):
    """A sum over all properties is no friction without any."""
    body = (
        "double mu = 0; for (int i = 0; i < *nProps; ++i) mu += props[i];"
        " fTangential[*nFricDir * k] = -mu * fNormal[k];"
    )
    subject = found(vfric(tmp_path, body))
    assert subject.props
    assert "as many properties as there are" in subject.origin["props"]


def test_a_wrong_sign_is_told(tmp_path):
    """No value makes friction along the motion of a routine with the wrong sign."""
    subject = found(vfric(tmp_path, "fTangential[*nFricDir * k] = props[0] * fNormal[k];"))
    assert subject.props == (0.3,)
    assert "wrong sign" in subject.origin["props"]


def test_one_more_than_there_is(tmp_path):
    body = (
        "statev[*nStateVar * (n + 1)] += 1; if (k == 0) for (int m = 0; m < *nSecNod; ++m)"
        " statev[*nStateVar * (m + 1)] += 1; fTangential[*nFricDir * k] = -.3 * fNormal[k];"
    )
    subject = found(vfric(tmp_path, body))
    assert subject.states == 1
    assert "one more of the state variables than it gets" in subject.origin["states"]


def test_constants_of_the_first_call(tmp_path):
    """The search begins without properties, which this routine never forgets."""
    body = (
        "static double mu = -1; if (mu < 0) mu = *nProps > 1 ? props[1] : NAN;"
        " if (mu != mu) mu = NAN; fTangential[*nFricDir * k] = -(mu + 0 * props[1]) * fNormal[k];"
    )
    subject = found(vfric(tmp_path, body))
    assert len(subject.props) == 2
    assert "fails" not in subject.origin["props"]


_PYTHON = """\
import usersub

@usersub.vfric
def law(fTangential, fNormal, props, statev, jConSecid):
    for k in range(fNormal.shape[0]):
        statev[1, jConSecid[k] - 1] += 1.0
        fTangential[0, k] = -props[1] * fNormal[k]

@usersub.vfric_coef
def mu(fCoef, props):
    if props.size < 3:
        raise ValueError("three properties are needed")
    fCoef[:] = props[0]
"""


@pytest.mark.parametrize(("interface", "expected"), [("vfric", (2, 2)), ("vfric_coef", (3, 0))])
def test_python_routines(tmp_path, interface, expected):
    path = tmp_path / "laws.py"
    path.write_text(_PYTHON)
    subject = found(subject_of(path, interface))
    assert (len(subject.props), subject.states) == expected


def test_built_in_laws_are_known(tmp_path):
    """By their file or by the name that is given; a copy is a file like any other."""
    path = laws.path("maxwell_slip", "c")
    subject = found(subject_of(path, "fric"))
    assert subject.props == laws.LAWS["maxwell_slip"](**laws.LAWS["maxwell_slip"].example).props
    assert subject.states == 3 * 2 + 3
    assert subject.origin["props"].startswith("the example of the built-in law maxwell_slip")
    copy = tmp_path / "mine.c"
    shutil.copy(laws.path("stribeck", "c"), copy)
    assert len(found(subject_of(copy, "fric_coef")).props) == 5
    named = found(subject_of(copy, "fric_coef", law="stribeck"))
    assert named.props == (0.3, 0.2, 0.01, 2.0, 0.0)


def test_both_coefficients_are_seen(tmp_path):
    path = tmp_path / "two.c"
    path.write_text(
        _C_HEAD + "void FOR_NAME(fric_coef, FRIC_COEF)(USUB_FRIC_COEF_2022_PARAMETERS) {\n"
        "  fCoef[0] = props[0];\n  fCoef[*nBlock] = props[1];\n"
        "  for (int i = 0; i < iData[4]; ++i) rData[7 + i] += 1;\n}\n"
    )
    subject = found(subject_of(path))
    assert subject.anisotropic
    assert (len(subject.props), subject.states) == (2, 2)
    assert subject.origin["anisotropic"] == "traced: the routine sets both coefficients"


#: Published style: properties, states, fields, temperatures by reading the files.
_CORPUS = {
    ("authors/windows.for", "fric"): (2, 0, 0, False),
    ("authors/heat_state.f", "fric"): (2, 2, 2, True),
    ("authors/implicit_none.f", "fric"): (2, 0, 2, True),
    ("authors/plane.for", "vfric"): (3, 3, 0, False),
    ("authors/free_in_for.for", "vfric"): (2, 0, 2, True),
    ("authors/module_after.f90", "vfriction"): (2, 1, 2, True),
    ("authors/explicit_entries.f", "vfric_coef"): (3, 0, 2, False),
    ("authors/coef_template.for", "fric_coef"): (3, 2, 0, False),
    ("vfriction_threads.f", "vfriction"): (3, 2, 0, False),
    ("fric_char8.f", "fric"): (2, 0, 0, False),
    ("vfric_common.for", "vfric"): (1, 1, 0, False),
}


@pytest.mark.needs_fortran
@pytest.mark.parametrize(("file", "interface"), _CORPUS)
def test_files_of_many_authors(file, interface):
    subject = found(subject_of(_FIELD / file, interface))
    reads = len(subject.props), subject.states, subject.fields, subject.temperatures
    assert reads == _CORPUS[file, interface], subject.origin
    assert values.cost(subject) == 0.0


def test_words_of_failures(tmp_path):
    subject = vfric(tmp_path, _BODIES["nothing"][0]).but(props=(1.0,), states=2, fields=1)

    def counts(text: str) -> tuple:
        return wants.wanted(subject, RoutineError(text)).counts

    assert counts("the routine read props(7), of which there are 1, at point 0") == (("props", 7),)
    assert counts("read statev(5,1), of which there are 2 x 3") == (("states", 5),)
    assert counts("read statev(2,4), of which there are 2 x 3") == (("states", 3),)
    assert counts("read preDefMain(1,2), of which there are 1 x 1") == (("fields", 2),)
    assert counts("wrote dSlipFric(9,1), of which there are 3 x 1") == ()
    assert wants.wanted(subject, RoutineError("in tempSec, which is not there (x)")).temperatures
    assert wants.numbers_in("needs four constants, 12 values, not 1.5") == [4, 12]
    assert wants.about("the routine ended with XIT: too few state variables") == "states"
