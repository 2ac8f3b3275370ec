# SPDX-License-Identifier: MIT
"""The page of what the rules find, made from answers; the runs behind it are `make conformance`."""

import tomllib

import pytest

from tests.conformance import law_matrix
from tests.meta import planting, table
from tests.meta.table import Answer
from usersub.check import all_rules as rules


def well(things):
    return [Answer(thing, "") for thing in things]


def test_the_page_is_that_of_a_run_without_faults():
    planted, of_laws = planting.files("planted"), law_matrix.combinations()
    assert table.PAGE.read_text(encoding="utf-8") == table.page(well(planted), well(of_laws))


def test_a_fault_would_be_seen():
    planted, of_laws = planting.files("planted"), law_matrix.combinations()
    good = table.page(well(planted), well(of_laws))
    for i, answers in enumerate((well(planted), well(of_laws))):
        answers[7] = Answer(answers[7].key, "not found")
        both = (answers, well(of_laws)) if i == 0 else (well(planted), answers)
        assert table.page(*both) != good


def test_parts_make_the_whole():
    every = law_matrix.combinations()
    parts = [table._some(every, (k, 5)) for k in range(1, 6)]
    assert sorted(c.id for part in parts for c in part) == sorted(c.id for c in every)
    assert all({c.language for c in part} == set(table.LANGUAGES) for part in parts)


def test_a_part_finds_what_a_page_does_not_tell(monkeypatch, capsys):
    """A fault in the part of a check is told, and ends it with 1."""
    monkeypatch.setattr(table, "answers", lambda look, things, *more: well(things))
    assert table.main(["--check", "--own", "--part", "2/5"]) == 0

    def one_fault(look, things, *more):
        return [Answer(things[0], "not found"), *well(things[1:])]

    monkeypatch.setattr(table, "answers", one_fault)
    assert table.main(["--check", "--own", "--part", "2/5"]) == 1
    assert "not found" in capsys.readouterr().err


@pytest.mark.parametrize("part", ["0/5", "6/5", "1", "a/b"])
def test_parts_that_there_are_not(part):
    with pytest.raises(SystemExit):
        table.main(["--check", "--part", part])


def test_every_fault_of_the_field_names_rules_that_exist():
    with (planting.HERE / "faults.toml").open("rb") as stream:
        found = tomllib.load(stream)["fault"]
    assert len(found) == 21
    assert {rule for row in found for rule in row["rules"]} <= set(rules())


@pytest.mark.parametrize("rule", sorted(rules()))
def test_rules_have_words_for_people(rule):
    made = rules()[rule]
    assert made.requirement.endswith(".")
    assert made.reference
