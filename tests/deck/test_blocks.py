# SPDX-License-Identifier: MIT
"""Keyword blocks as they stand in decks of several authors read as an engineer would."""

from pathlib import Path

import pytest

from usersub import deck
from usersub.deck import Row, SlipTolerance, Table, User

FOLDER = Path(__file__).parent / "blocks"


def read(name, **options):
    (path,) = FOLDER.glob(f"*{name}*")
    return deck.read(path, **options)


def constant(mu, rate=None):
    return Table((Row((mu,), rate),))


def test_every_block_reads_and_comes_back():
    names = sorted(FOLDER.glob("*.inp"))
    assert len(names) == 10
    for path in names:
        found = deck.read(path)
        assert found.interactions and deck.read(found.write()) == found


def test_user_routines_of_general_contact():
    found = read("user_routine")
    assert [i.name for i in found] == ["SheetTool", "SheetTool-2"]
    props = (4.0, 0.0518, -0.1391, -0.2107, 0.0933, -0.0712)
    assert found["sheettool-2"].friction.law == User("FRICTION", props, depvar=0)
    assert found["SheetTool"].friction.interface == "vfriction"
    assert found.warnings == ()


def test_number_under_the_interaction_and_slip_tolerance():
    found = read("area_and_tolerance")
    assert [(i.area, i.friction.law) for i in found] == [
        (1.0, constant(0.07)),
        (1.0, constant(0.12)),
    ]
    assert {i.friction.method for i in found} == {SlipTolerance(0.005)}


@pytest.mark.parametrize(("name", "mu"), [("plain", 0.35), ("linear", 0.15), ("hard", 0.25)])
def test_constant_coefficients(name, mu):
    found = read(name)
    (one,) = found
    assert one.friction.law == constant(mu) and one.friction.stick_slope is None
    assert found.warnings == ()


@pytest.mark.parametrize(
    ("name", "mu", "second"),
    [
        ("slope_change", 2e-4, 4e3),
        ("slope_two", 0.25, 60.0),
        ("slope_zeros", 0.15, 6e3),
        ("slope_comment", 0.45, 3e3),
    ],
)
def test_second_entry_by_dialect(name, mu, second):
    (one,) = read(name, dialect="calculix")
    assert one.friction.law == constant(mu) and one.friction.stick_slope == second
    commercial = read(name)
    rows = commercial.interactions[0].friction.law.rows
    assert (rows[0].mu, rows[0].slip_rate) == ((mu,), second)
    assert any("stick slope" in note.text for note in commercial.warnings)


def test_name_that_begins_with_a_digit():
    (one,) = read("slope_zeros")
    assert one.name == "2nd_interaction"


def test_changes_without_the_step_of_the_deck():
    found = read("slope_change", dialect="calculix")
    (change,) = found.changes
    assert (change.step, change.interaction) == (0, "FACE")
    assert change.friction.law == constant(0.3) and change.friction.stick_slope == 4e3
    assert [note.where.line for note in found.warnings] == [7]


def test_rough():
    (one,) = read("rough")
    assert one.name == "{}" and one.friction.law == deck.Rough()
    assert one.friction.interface in ("fric", "vfriction")
