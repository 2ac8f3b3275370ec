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


def test_a_fault_would_be_seen():
    planted, of_laws = planting.files("planted"), law_matrix.combinations()
    good = table.page(well(planted), well(of_laws))
    for i, answers in enumerate((well(planted), well(of_laws))):
        answers[7] = Answer(answers[7].key, "not found")
        both = (answers, well(of_laws)) if i == 0 else (well(planted), answers)
        assert table.page(*both) != good


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
