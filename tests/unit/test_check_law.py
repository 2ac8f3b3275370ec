# SPDX-License-Identifier: MIT
"""The rule law.agrees: the shipped laws pass, laws with one wrong sign, constant or branch fail.

What passes everything is tested for all laws in tests/conformance.
"""

from __future__ import annotations

import itertools
import re
from dataclasses import replace
from pathlib import Path

import pytest

import usersub
from usersub import laws
from usersub.check.agreement import refusals
from usersub.check.agreement import samples as law_samples
from usersub.check.agreement import truth as law_truth
from usersub.check.case import one
from usersub.check.rule import CannotCheck, NotApplicable
from usersub.check.rules import law as rule
from usersub.check.subject import Scales, Subject
from usersub.check.subjects import law_subject
from usersub.errors import MissingTool


def subject_of(path: Path, name: str, interface: str, precision: str = "double") -> Subject:
    """A file as a subject that claims to be the law `name`."""
    file = usersub.load(path, precision=precision)
    routine = file[interface]
    subject = Subject(
        name, routine.interface, precision, routine, path=path, file=file, law=name,
        scales=Scales(slip=0.05, stick=0.0025),
    )  # fmt: skip
    return law_subject.with_example(subject, name, set())


def changed(folder: Path, name: str, language: str, old: str, new: str) -> Path:
    """The file of a law in which a piece of text is another."""
    source = laws.path(name, language)
    text = source.read_text()
    assert text.count(old) >= 1
    path = folder / source.name
    path.write_text(text.replace(old, new, 1))
    return path


def first(subject: Subject, most: int = 10_000):
    """The first finding over the cases of the rule."""
    for case in itertools.islice(rule._cases(subject), most):
        found = rule.agrees(subject, case)
        if found is not None:
            return found
    return None


@pytest.mark.parametrize(
    ("name", "language", "interface", "precision"),
    [
        ("exponential_decay", "c", "fric_coef", "double"),
        ("dahl", "c", "fric", "double"),
        ("iwan", "c", "vfriction", "single"),
        ("rate_state_slip", "python", "vfric", "double"),
        pytest.param("slip_weakening", "fortran", "fric", "double",
                     marks=pytest.mark.needs_fortran),
    ],
)  # fmt: skip
def test_shipped_laws_agree(name, language, interface, precision):
    assert first(subject_of(laws.path(name, language), name, interface, precision)) is None


@pytest.mark.parametrize(
    ("name", "interface", "old", "new", "words"),
    [
        ("exponential_decay", "vfric_coef", "-props[2] * rate", "props[2] * rate",
         r"fCoef of point 1 is \S+ in step 1; the built-in law exponential_decay gives"),
        ("exponential_decay", "vfric", "expm1(-props", "expm1(props", "friction in direction 1"),
        ("exponential_decay", "fric", "derivative[0] = -props[2]", "derivative[0] = props[2]",
         r"DDTDDG\(\d,\d\)"),
        ("exponential_decay", "fric_coef", "* transition", "* 1.0001 * transition", "derivative 1"),
        ("shear_limit", "fric", "derivative[1] = -", "derivative[1] = ", r"DDTDDP\(\d\)"),
        ("shear_limit", "vfric", "props[0] < limited", "props[0] > limited", "friction"),
        ("stribeck", "vfric_coef", "usub_real", "float", "fCoef"),
        ("slip_weakening", "fric_coef", "return", "state[0] *= 1.001; return",
         "state variable 1|fCoef|friction"),
        ("norton_hoff", "fric", "derivative[0] = props[0];", "derivative[0] = 2 * props[0];",
         r"DDTDDG\(1,1\)"),  # at rest, with n = 1 and v0 = 0
        ("elasto_plastic", "fric", "for (int b = 0; b < 2 && tangent; ++b)",
         "for (int b = 1; b < 2 && tangent; ++b)", r"DDTDDG\(1,1\)"),
        ("iwan", "vfric", "if (count < 4)", "if (count >= 4)",
         "takes the 7 properties .* the built-in law iwan refuses as too few"),
        ("maxwell_slip", "fric", "props[6] >= 1 &&", "props[6] >= 1 ||",
         "takes the 13 properties .* the built-in law maxwell_slip refuses as too few"),
        ("lugre", "vfriction", "z[a] = kept * z[a] + gone", "z[a] = kept * z[a] - gone",
         "state variable|friction"),
    ],
)  # fmt: skip
def test_one_wrong_place_is_seen(tmp_path, name, interface, old, new, words):
    found = first(subject_of(changed(tmp_path, name, "c", old, new), name, interface))
    assert found is not None
    assert re.search(words, found.detail), found.detail


def test_the_finding_names_values(tmp_path):
    path = changed(tmp_path, "coulomb", "c", "return props[0]", "return 2 * props[0]")
    found = first(subject_of(path, "coulomb", "vfric_coef"))
    assert found.detail == (
        "fCoef of point 1 is 0.6 in step 1; the built-in law coulomb gives 0.3"
    ) or found.figures["found"] == pytest.approx(2 * found.figures["expected"])
    assert found.figures["step"] == 0


def test_without_a_name_it_does_not_apply():
    subject = subject_of(laws.path("coulomb", "c"), "coulomb", "fric")
    with pytest.raises(NotApplicable, match="--law"):
        next(iter(rule._cases(subject.but(law=""))))
    with pytest.raises(CannotCheck, match="no law is called"):
        next(iter(rule._cases(subject.but(law="columb"))))
    with pytest.raises(CannotCheck, match="properties are not those of coulomb"):
        next(iter(rule._cases(subject.but(props=(0.3, 0.2)))))


def test_rounding_is_no_difference(tmp_path):
    """The same law with its sums in another order, through the bends of all branches."""
    path = changed(
        tmp_path, "exponential_decay", "c", "return props[1] + transition;",
        "return props[0] * exp(-props[2] * rate) + props[1] * (1 - exp(-props[2] * rate));",
    )  # fmt: skip
    assert first(subject_of(path, "exponential_decay", "fric")) is None


def test_other_state_variables_are_not_compared(tmp_path):
    """State in other units is the routine's own affair, as long as friction agrees."""
    path = tmp_path / "mine.c"
    path.write_text(
        "#include <math.h>\n#include <usersub/abi.h>\n#include <omi_for_c.h>\n"
        "void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {\n"
        "  for (int k = 0; k < *nContact; ++k) {\n"
        "    double *s = statev + *nStateVar * (jConSecid[k] - 1);\n"
        "    if (!(fNormal[k] > 0)) continue;\n"
        "    const double way = fabs(dSlipFric[*nDir * k]) + s[0] / 1000;\n"
        "    const double mu = way < props[2] ? props[0] + (props[1] - props[0]) * way / props[2]"
        " : props[1];\n"
        "    s[0] = 1000 * way;\n"
        "    fTangential[*nFricDir * k] = -fmin(mu * fNormal[k], fStickForce[k]);\n"
        "  }\n}\n"
    )
    subject = subject_of(path, "slip_weakening", "vfric")
    case = one((0.1, 0.0), (0.1, 0.2), (-0.1, 0.0))
    assert rule.agrees(subject, case) is None
    assert not rule._same_layout(subject, laws.law("slip_weakening"))


def test_a_subroutine_may_take_what_it_likes(tmp_path):
    """Only law functions have to refuse too few properties: here the second has a default."""
    path = tmp_path / "mine.c"
    path.write_text(
        "#include <math.h>\n#include <usersub/abi.h>\n#include <omi_for_c.h>\n"
        "void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {\n"
        "  for (int k = 0; k < *nBlock; ++k)\n"
        "    fCoef[k] = *nProps > 0 ? props[0] : 0.1;\n"
        "}\n"
    )
    subject = subject_of(path, "coulomb", "vfric_coef")
    few = list(refusals.too_few(subject, laws.law("coulomb")))
    assert [case.props for case in few] == [()]
    assert [rule.agrees(subject, case) for case in few] == [None]


@pytest.mark.parametrize("name", laws.LAWS)
def test_corners_are_special_and_allowed(name):
    law = laws.LAWS[name]
    found = list(law_samples.corners(law))
    assert bool(found) == bool(law.props)
    assert len(set(found)) == len(found)
    for props in found:
        law.of(props)


def test_every_second_increment_of_a_corner_is_at_rest():
    law = laws.LAWS["norton_hoff"]
    subject = subject_of(law.folder / "law.c", law.name, "fric")
    assert (1.0, 1.0, 0.0) in set(law_samples.corners(law))
    case = law_samples.with_rest(subject, law, (1.0, 1.0, 0.0), 15)
    assert [any(map(any, step.motion)) for step in case.steps] == 3 * [False, True]
    assert all(step.dt > 0 for step in case.steps)


@pytest.mark.parametrize("name", laws.LAWS)
def test_drawn_properties_are_allowed(name):
    law = laws.LAWS[name]
    drawn = list(law_samples.props(law))
    assert drawn == list(law_samples.props(law))
    for props in drawn:
        law.of(props)
    expected = 1 if not law.props else law_samples.DRAWS // 2
    assert len(set(drawn)) >= min(expected, len(drawn))
    if law.props:
        assert len(drawn) > law_samples.DRAWS // 2


def test_drawn_histories_reach_what_matters():
    """Zero and negative loads, rest, increments without time, one and two directions, tables at
    their points."""
    law = laws.LAWS["coulomb_tabulated"]
    subject = subject_of(law.folder / "law.c", law.name, "vfric")
    cases = [
        case
        for seed, props in enumerate(law_samples.props(law))
        for case in law_samples.histories(subject, law, props, seed)
    ]
    steps = [s for c in cases for s in c.steps]
    assert any(p == 0 for s in steps for p in s.load)
    assert any(p < 0 for s in steps for p in s.load)
    assert any(not any(m) for s in steps[1:] for m in s.motion)
    assert any(s.dt == 0 for s in steps)
    assert {c.directions for c in cases} == {1, 2}
    assert {c.contact for c in cases} == {"node-to-facet", "analytical-rigid"}
    at_points = [
        c for c in cases for s in c.steps if s.dt and abs(s.motion[0][0]) / s.dt in c.props
    ]
    assert len(at_points) > 5


def test_reference_values_are_used():
    """An error that both languages share is seen by the values of arbitrary precision."""
    law = laws.LAWS["stribeck"]
    subject = subject_of(law.folder / "law.c", law.name, "vfric_coef")
    known = next(law_truth.known(subject, law))
    assert rule._compare_known(subject.but(props=known.case.props), law, known.case,
                               known.values) is None  # fmt: skip
    wrong = tuple({n: v * (1 + 1e-9) for n, v in values.items()} for values in known.values)
    found = rule._compare_known(subject.but(props=known.case.props), law, known.case, wrong)
    assert found.detail.startswith("fCoef of point 1 is 0.3")


def test_the_truth_is_in_another_language(fortran, monkeypatch):
    law = laws.LAWS["coulomb"]
    python = subject_of(law.folder / "law.py", law.name, "fric")
    compiled = subject_of(law.folder / "law.c", law.name, "fric")
    assert law_truth.twin(python, law).routine.language == "c"
    assert law_truth.twin(compiled, law).routine.language == "fortran"

    def missing(name, interface, language, **more):
        if language != "python":
            raise MissingTool("no compiler")
        return usual(name, interface, language, **more)

    usual = laws.routine
    monkeypatch.setattr(laws, "routine", missing)
    law_truth._shipped.cache_clear()
    assert law_truth.twin(compiled, law).routine.language == "python"
    with pytest.raises(CannotCheck, match="no compiler"):
        law_truth.twin(python, law)
    law_truth._shipped.cache_clear()


def test_sizes_follow_the_case():
    law = laws.LAWS["iwan"]
    subject = subject_of(law.folder / "law.c", law.name, "fric")
    case = replace(one((1e-6,), load=2.0), props=(0.3, 2.0, 1e4, 2e4, 0.5, 0.5))
    sized = law_truth.sized(subject, law, case)
    assert (sized.states, sized.fields, sized.temperatures) == (2, 0, False)
