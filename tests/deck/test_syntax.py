# SPDX-License-Identifier: MIT
"""Syntax of decks: case, blanks, abbreviations, continuation, comments, encodings, includes."""

import io
import math

import pytest

from usersub import DeckError, deck
from usersub.deck import ElasticSlip, Lagrange, Row, SlipTolerance, Table, User, procedures

HEAD = "*SURFACE INTERACTION, NAME=A\n"


def friction(text, **options):
    (one,) = deck.read(HEAD + text, **options)
    return one.friction


def refused(text, words, line=None, **options):
    with pytest.raises(DeckError) as caught:
        deck.read(text, **options)
    assert words in str(caught.value)
    if line is not None:
        assert caught.value.line == line
    return caught.value


@pytest.mark.parametrize(
    "text",
    [
        "*SURFACE INTERACTION,NAME=A\n*FRICTION\n0.3\n",
        "*surface interaction, name = A\n*friction\n 0.3,\n",
        "  * Surface  Interaction , Name =  A  \n *Friction \n .3 ,,\n",
        "*SurfaceInteraction,NAME=A\n*FRIC\n+3.D-1\n",
        "*SURFACE INTER, NA=A\n*FRI\n3d-1, , , \n",
        "** comment, 1\n*SURFACE INTERACTION,\n** between\n\nNAME=A\n\n*FRICTION\n** c\n\n0.30\n",
        '*SURFACE INTERACTION, NAME="A"\r\n*FRICTION\r\n0.3\r\n',
        "*SURFACE INTERACTION, NAME=A, \n*FRICTION,\n*SURFACE BEHAVIOR\n",
    ][:-1],
)
def test_ways_to_write_the_same(text):
    (one,) = deck.read(text)
    assert one.name == "A"
    assert one.friction.law == Table((Row((0.3,)),))


def test_paths_lines_bytes_and_open_files(tmp_path):
    text = HEAD + "*FRICTION\n0.25\n"
    path = tmp_path / "a.inp"
    path.write_text(text)
    first = deck.read(path)
    assert first.path == str(path)
    for source in (
        str(path), text, text.split("\n"), text.splitlines(keepends=True), iter([text]),
        text.encode().splitlines(), io.BytesIO(text.encode()), io.StringIO(text),
    ):  # fmt: skip
        assert deck.read(source) == first
    with path.open() as handle:
        assert deck.read(handle) == first


def test_lines_that_are_no_text():
    assert refused([HEAD, 3], "int is no line").line == 2
    refused(3, "expected a path or lines")
    with pytest.raises(ValueError, match="solver"):
        deck.read("a\n", solver="both")
    with pytest.raises(ValueError, match="dialect"):
        deck.read("a\n", dialect="other")


def test_latin_1_and_byte_order_mark(tmp_path):
    path = tmp_path / "a.inp"
    path.write_bytes(
        "** Größe\n*SURFACE INTERACTION, NAME=Größe\n*FRICTION\n0.3\n".encode("latin-1")
    )
    assert deck.read(path)["GRÖSSE".replace("SS", "ß")].friction is not None
    path.write_bytes(b"\xef\xbb\xbf" + HEAD.encode())
    assert deck.read(path)["a"].friction is None
    path.write_bytes(HEAD.encode("utf-16"))
    refused(path, "UTF-16", 1)


def test_a_text_file_of_another_encoding(tmp_path):
    path = tmp_path / "a.inp"
    path.write_bytes(HEAD.encode() + b"** \xff\n")
    with path.open(encoding="utf-8") as handle:
        refused(handle, "cannot be read")


def test_frictionless_and_several_interactions():
    found = deck.read(
        "*SURFACE INTERACTION, NAME=1a\n*SURFACE BEHAVIOR\n1.,2.\n"
        '*SURFACE INTERACTION, NAME="two words"\n*FRICTION, ROUGH\n*NODE\n1, 0., 0.\n'
    )
    assert found["1A"].friction is None
    assert found["Two Words"].friction.law == deck.Rough()
    with pytest.raises(KeyError, match="interactions: 1a, two words"):
        found["3"]
    assert deck.read(found.write()) == found


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("user", "FRIC"), ("USER=FRIC", "FRIC"), ("user = friction", "FRICTION"),
        ("user=Coefficient", "COEFFICIENT"), ("USER=COEF", "COEFFICIENT"), ("us=frict", "FRICTION"),
    ],
)  # fmt: skip
def test_user_in_every_form(text, kind):
    assert friction(f"*Friction, {text}\n").law == User(kind)


def test_properties_over_lines():
    data = "\n".join(", ".join(str(i + k) for i in range(8)) + "," for k in (1, 9)) + "\n17, 18"
    found = friction(f"*FRICTION, USER, DEPVAR=3, PROP=18\n{data}\n")
    assert found.law == User("FRIC", tuple(range(1, 19)), depvar=3)


def test_blank_properties_are_zero_and_told():
    found = deck.read(HEAD + "*FRICTION, USER, PROPERTIES=3\n1.,,3.\n")
    assert found["a"].friction.law.properties == (1.0, 0.0, 3.0)
    assert "property 2 is blank" in str(found.warnings[0])


def test_table_with_fields_over_lines():
    text = "*FRICTION, DEPENDENCIES=6\n0.3, 0., 1., 2., 3., 4., 5., 6.\n7., 8.\n"
    text += "0.2, 9., 1., 2., 3., 4., 5., 6.\n7., 8.\n"
    found = friction(text)
    fields = (3.0, 4.0, 5.0, 6.0, 7.0, 8.0)
    rows = (Row((0.3,), 0.0, 1.0, 2.0, fields), Row((0.2,), 9.0, 1.0, 2.0, fields))
    assert found.law == Table(rows, 6)


def test_anisotropic_table():
    found = friction("*FRICTION, ANISO, DEPENDENCIES=4\n.3,.2,0.,1.,2.,3.,4.,5.\n6.\n")
    assert found.anisotropic
    assert found.law.rows == (Row((0.3, 0.2), 0.0, 1.0, 2.0, (3.0, 4.0, 5.0, 6.0)),)


def test_columns_that_are_left_out():
    found = friction("*FRICTION\n0.3,,,20.\n0.2,,,100.\n")
    assert found.law.rows == (Row((0.3,), temperature=20.0), Row((0.2,), temperature=100.0))
    mixed = deck.read(HEAD + "*FRICTION\n0.3\n0.2, 100.\n")
    assert mixed["A"].friction.law.rows[0].slip_rate == 0.0
    assert "taken as 0" in mixed.warnings[0].text


def test_trailing_zeros_are_no_extra_data():
    found = friction("*FRICTION\n0.3, 0., 0., 0., 0., 0.\n")
    assert found.law.rows == (Row((0.3,), 0.0, 0.0, 0.0),)


def test_methods_and_limits():
    found = friction("*FRICTION, ELASTIC SLIP=1e-3, TAUMAX=50\n0.3\n")
    assert (found.method, found.taumax) == (ElasticSlip(1e-3), 50.0)
    assert friction("*FRICTION, LAG\n0.3\n").method == Lagrange()
    assert friction("*FRICTION, SLIPTOL=.01\n0.3\n").method == SlipTolerance(0.01)
    found = friction("*FRICTION, ROUGH, SHEAR=1e5\n", solver="explicit")
    assert found.shear_traction_slope == 1e5 and found.law == deck.Rough()


def test_decay_and_test_data():
    law = friction("*FRICTION, EXP\n0.3, 0.2, 0.5\n").law
    assert (law.mus, law.muk, law.dc, law.test_data) == (0.3, 0.2, 0.5, None)
    law = friction("*FRICTION, EXPONENTIAL DECAY, TEST DATA\n0.3\n0.22, 10.\n").law
    # 20/19 and 1/19 by exact fractions of the two doubles, rounded once
    assert law.muk == float((20 * _exact(0.22) - _exact(0.3)) / 19)
    assert law.dc == pytest.approx(math.log(20.0) / 10.0, rel=2e-16)
    law = friction("*FRICTION, EXPONENTIAL DECAY, TEST DATA\n0.3\n0.22, 10.\n0.2,\n").law
    assert (law.mus, law.muk) == (0.3, 0.2)
    assert law.dc == pytest.approx(math.log(5.0) / 10.0, rel=1e-15)


def _exact(value):
    from fractions import Fraction

    return Fraction(value)


STEPS = """\
*AMPLITUDE, NAME=up, DEF=SMOOTH STEP
0., 0., 0.5, 0.25, 1., 1.
*SURFACE INTERACTION, NAME=A
*FRICTION
0.3
*STEP, NAME=first, AMPLITUDE=RAMP, NLGEOM=YES
*STATIC
0.1, 1.
*CHANGE FRICTION, INTERACTION=a, AMPLITUDE=UP
*FRICTION, TAUMAX=5.
0.2
*END STEP
*STEP
*STATIC, RIKS
*CHANGE FRICTION, ELSET=gaps
*FRICTION
0.1
*CHANGE FRICTION, INTERACTION=A, RESET
*END STEP
"""


def test_steps_changes_and_amplitudes():
    found = deck.read(STEPS)
    assert found.solver == "standard"
    assert [(s.number, s.name, s.amplitude, s.procedure) for s in found.steps] == [
        (1, "first", "RAMP", "STATIC"), (2, "", None, "STATIC, RIKS"),
    ]  # fmt: skip
    first, second, third = found.changes
    assert (first.step, first.interaction, first.amplitude) == (1, "A", "UP")
    assert (second.step, second.elset, third.step, third.reset) == (2, "gaps", 2, True)
    assert found.friction("a").law.rows[0].mu == (0.3,)
    assert found.friction("a", 1).law.rows[0].mu == (0.2,)
    assert found.friction("a", 2).law.rows[0].mu == (0.3,)
    assert found.amplitude("Up").points == ((0.0, 0.0), (0.5, 0.25), (1.0, 1.0))
    assert found.warnings == ()
    assert deck.read(found.write()) == found


def test_amplitudes_between_their_points():
    found = deck.read(STEPS).amplitude("up")
    assert found.value(-1.0) == 0.0 and found.value(2.0) == 1.0 and found.value(0.5) == 0.25
    assert found.value(0.75) == 0.625  # a smooth step is half way up half way along
    assert found.value(0.5 + 0.25 * 0.5) == pytest.approx(0.25 + 0.75 * 0.103515625, rel=1e-15)
    linear = deck.read("*AMPLITUDE, NAME=b\n0., 1.,\n2., 3.\n").amplitude("B")
    assert linear.value(0.5) == 1.5


def test_a_new_interaction_in_an_explicit_step():
    text = HEAD + "*FRICTION\n0.3\n*STEP\n*DYNAMIC, EXPLICIT\n, 1.\n" + HEAD
    text += "*FRICTION, SHEAR TRACTION SLOPE=2.\n0.1\n*END STEP\n"
    found = deck.read(text)
    assert found.solver == "explicit" and len(found) == 1
    assert found.friction("A", 1).law.rows[0].mu == (0.1,)
    assert found.friction("A").solver == "explicit"
    assert deck.read(found.write()) == found
    refused(text.replace("DYNAMIC, EXPLICIT", "STATIC").replace(", SHEAR TRACTION SLOPE=2.", ""),
            "defined anew in a step")  # fmt: skip


def test_friction_of_gaps_and_connectors():
    found = deck.read("*GAP, ELSET=g\n0.1\n*FRICTION\n0.3\n*CONNECTOR FRICTION\n*FRICTION\n0.2\n")
    assert [(o.owner, o.elset) for o in found.others] == [("GAP", "g"), ("CONNECTOR FRICTION", "")]
    assert len(found) == 0
    assert deck.read(found.write()) == found


def test_riks_and_rates():
    decay, riks = "*FRICTION, EXP\n0.3,0.2,1.\n", "*STEP\n*STATIC, RIKS\n*END STEP\n"
    static = "*STEP\n*STATIC\n*END STEP\n"
    change = "*CHANGE FRICTION, INTERACTION=A\n" + decay
    for text in (decay + riks, decay + static + riks, "*FRICTION\n0.3\n" + riks[:-10] + change):
        with pytest.raises(DeckError, match="A depends on the slip rate.* Riks step of deck:"):
            deck.read(HEAD + text)
    other = change.replace(decay, "*FRICTION\n0.3\n")
    deck.read(HEAD + decay + static + "*STEP\n*STATIC, RIKS\n" + other)
    deck.read(HEAD + "*FRICTION, EXP\n0.3,0.2,0.\n" + riks)


PROCEDURES = [
    ("Static", "standard", True),
    ("Static, riks", "standard", True),
    ("Dynamic", "standard", False),
    ("Dynamic, application=QUASI-STATIC", "standard", True),
    ("Dynamic, application=moderate dissipation", "standard", False),
    ("Dynamic, Explicit", "explicit", False),
    ("Dynamic Temperature-displacement, Explicit", "explicit", False),
    ("Coupled Temperature-displacement, creep=none, deltmx=10.", "standard", False),
    ("COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE", "standard", True),
    ("Visco, cetol=1e-3", "standard", False),
    ("Soils, consolidation", "standard", False),
    ("Soils", "standard", True),
    ("Steady State Transport", "standard", True),
    ("Heat Transfer", None, True),
]


@pytest.mark.parametrize(("line", "solver", "ramps"), PROCEDURES)
def test_procedures(line, solver, ramps):
    found = deck.read(HEAD + f"*FRICTION\n0.3\n*STEP\n*{line}\n1.,1.\n*END STEP\n")
    assert found.solver == solver
    assert procedures.ramps(found.steps[0].procedure) == ramps
    assert deck.read(found.write()) == found


def test_connectors_have_a_tolerance_of_their_own():
    text = "*CONNECTOR FRICTION\n*FRICTION{}\n0.3\n*GAP, ELSET=g\n0.1\n*FRICTION\n0.3\n"
    connector, gap = deck.read(text.format("")).others
    assert connector.friction.scene_settings()["slip_tolerance"] == 1e-4
    assert "slip_tolerance" not in gap.friction.scene_settings()
    given = deck.read(text.format(", SLIP TOLERANCE=0.002")).others[0]
    assert given.friction.scene_settings()["slip_tolerance"] == 0.002


def test_a_user_coefficient_may_be_anisotropic():
    friction = deck.read(HEAD + "*FRICTION, USER=COEFFICIENT, ANISOTROPIC\n")["A"].friction
    assert friction.scene_settings() == {"props": (), "anisotropic": 1}
    warning = deck.read(HEAD + "*FRICTION, USER, ANISOTROPIC\n").warnings[0]
    assert "ANISOTROPIC has no meaning" in warning.text


# Includes.


def write(folder, **texts):
    for name, text in texts.items():
        (folder / f"{name}.inp").write_text(text)


def test_includes_nest_and_continue_data(tmp_path):
    (tmp_path / "sub").mkdir()
    write(tmp_path, main=HEAD + "*FRICTION\n*INCLUDE, INPUT=sub/table.inp\n0.1, 20.\n*NODE\n")
    write(tmp_path / "sub", table="0.3, 0.\n*include,\n input = more.inp\n", more="0.2, 10.\n")
    found = deck.read(tmp_path / "main.inp")
    assert [row.mu for row in found["A"].friction.law.rows] == [(0.3,), (0.2,), (0.1,)]


def test_includes_in_skipped_data(tmp_path):
    write(tmp_path, main="*NODE\n*INCLUDE, INPUT=nodes.inp\n" + HEAD + "*FRICTION\n0.3\n")
    write(tmp_path, nodes="1, 0., 0.\n" * 10 + "** end\n*SURFACE INTERACTION, NAME=B\n")
    assert [i.name for i in deck.read(tmp_path / "main.inp")] == ["B", "A"]


def test_errors_name_the_included_file(tmp_path):
    write(tmp_path, main=HEAD + "*INCLUDE, INPUT=part.inp\n", part="*FRICTION\n0.3.0\n")
    error = refused(tmp_path / "main.inp", "expected a number", 2)
    assert error.file == "part.inp"


def test_circles_and_missing_files_are_refused(tmp_path):
    write(tmp_path, a="*INCLUDE, INPUT=b.inp\n", b="\n*INCLUDE, INPUT=./a.inp\n")
    assert refused(tmp_path / "a.inp", "circle", 2).file == "b.inp"
    refused("*INCLUDE, INPUT=/no/such/file\n", "cannot be read: No such file", 1)
    refused("*INCLUDE, INPUT=/dev/zero\n", "no regular file", 1)
    refused(f"*INCLUDE, INPUT={tmp_path}\n", "is a folder", 1)
    refused("*INCLUDE, INPUT=a, PASSWORD=b\n", "encrypted", 1)
    refused(["*INCLUDE, INPUT=/no/such/file,"], "cannot be read", 1)
    refused("*INCLUDE\n", "needs the parameter INPUT", 1)
    refused(tmp_path / "c.inp", "c.inp: the deck cannot be read")
    for k in range(20):
        write(tmp_path, **{f"n{k}": f"*INCLUDE, INPUT=n{k + 1}.inp\n"})
    refused(tmp_path / "n0.inp", "more than 16 files")


# Slips of the pen.


@pytest.mark.parametrize(
    ("text", "words", "line"),
    [
        ("*FRCTION\n0.3\n", "did you mean *FRICTION?", 2),
        ("*SURFACE INTERATCION, NAME=B\n", "did you mean *SURFACE INTERACTION?", 2),
        ("*SURFACE BEHAVIOR\nFRICTION\n0.3\n", "is a star missing", 3),
        ("FRICTION\n0.3\n", "expected a number", 2),
        ("*SURFACE I\n*NODE\n*FRICTION\n0.3", "needs the parameter NAME", 2),
        ("*NODE\n*FRICTION\n0.3", "follows no", 3),
        ("*S\n", "may stand for", 2),
        ("*\n", "a star without", 2),
        ("*FRICTION, TAUMX=3.\n0.3\n", "did you mean TAUMAX?", 2),
        ("*FRICTION,\n0.3\n", "ends in a comma goes on", 2),
        ("*FRICTION, S=3.\n0.3\n", "may stand for SHEAR TRACTION SLOPE or SLIP TOLERANCE", 2),
        ("*FRICTION, ROUGH=YES\n", "ROUGH takes no value", 2),
        ("*FRICTION, TAUMAX\n0.3", "TAUMAX needs a value", 2),
        ("*FRICTION, TAUMAX=1, TAU=2\n0.3", "TAUMAX is given twice", 2),
        ("*FRICTION, DEPENDENCIES=1.5\n0.3", "no whole number", 2),
        ('*FRICTION, "ROUGH\n', "quotation mark", 2),
        ("*FRICTION\n0.3 0.2\n", "expected a number", 3),
        ("*FRICTION\nnan\n", "expected a number", 3),
        ("*FRICTION\n1_0\n", "expected a number", 3),
        ("*FRICTION\n<mu>\n", "*PARAMETER are not put in", 3),
        ("*FRICTION\n1e999\n", "double precision does not hold", 3),
        ("*FRICTION\n1e-999\n", "double precision does not hold", 3),
        ("*FRICTION\n0.3" + "0" * 70000 + "\n", "longer than", 3),
    ],
)
def test_slips_of_the_pen(text, words, line):
    refused(HEAD + text, words, line)


def test_long_lines_of_skipped_data_do_not_matter():
    found = deck.read(io.BytesIO(b"*NODE\n1, " + b" " * 300000 + b"0.\n" + HEAD.encode()))
    assert [i.where.line for i in found] == [3]
