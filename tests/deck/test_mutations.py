# SPDX-License-Identifier: MIT
"""10 000 damaged decks: a result that comes back from its text, or an error with a line."""

import math
import random
import time
from dataclasses import fields, is_dataclass
from pathlib import Path

import pytest

from usersub import DeckError, deck

BLOCKS = [p.read_text() for p in sorted((Path(__file__).parent / "blocks").glob("*.inp"))]
WHOLE = """\
*AMPLITUDE, NAME=up, DEFINITION=SMOOTH STEP
0., 0., 1., 1.
*SURFACE INTERACTION, NAME=one
1.,
*FRICTION, DEPENDENCIES=1, TAUMAX=50., SLIP TOLERANCE=.005
0.3, 0., 1., 20., 1.
0.2, 9., 1., 20., 1.
0.1, 0., 2., 20., 1.
*SURFACE INTERACTION, NAME="two"
*FRICTION, EXPONENTIAL DECAY, TEST DATA
0.3
0.22, 10.
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
*SURFACE INTERACTION, NAME=three
*FRICTION, USER=COEFFICIENT, PROPERTIES=9
1., 2., 3., 4., 5., 6., 7., 8.
9.
*STEP, NAME=first
*STATIC
*CHANGE FRICTION, INTERACTION=one, AMPLITUDE=up
*FRICTION, ELASTIC SLIP=1e-3
0.25
*END STEP
*STEP
*STATIC
*CHANGE FRICTION, INTERACTION=one, RESET
*END STEP
"""
DECKS = [*BLOCKS, WHOLE, WHOLE, WHOLE]
WORDS = [
    "*", "**", ",", "=", '"', "\n", "", " ", "*FRICTION\n", "ROUGH", "USER", "1e999", "-1", "nan",
    "0.", "1d5", "<a>", "TAUMAX=0", "DEPENDENCIES=3", "*INCLUDE, INPUT=x\n", "*STEP\n", "\t", "\0",
    "é", "*END STEP\n", "LAGRANGE", "NAME=", "9" * 30, ",,,,,,,,,,",
]  # fmt: skip


def mutated(text, random):
    """The deck after one to four slips of the pen."""
    for _ in range(random.randint(1, 4)):
        at = random.randrange(len(text) + 1)
        kind = random.randrange(6)
        if kind == 0:
            text = text[:at] + random.choice(WORDS) + text[at:]
        elif kind == 1:
            text = text[:at] + text[at + random.randint(1, 12) :]
        elif kind == 2:
            text = text[:at] + chr(random.randrange(256)) + text[at + 1 :]
        elif kind == 3:
            lines = text.split("\n")
            i, j = random.randrange(len(lines)), random.randrange(len(lines))
            lines[i], lines[j] = lines[j], lines[i]
            text = "\n".join(lines)
        elif kind == 4:
            lines = text.split("\n")
            lines.insert(random.randrange(len(lines)), random.choice(lines))
            text = "\n".join(lines)
        else:
            text = text[:at]
    return text


def numbers(value):
    """All real numbers in a result."""
    if isinstance(value, float):
        yield value
    elif is_dataclass(value):
        for each in fields(value):
            yield from numbers(getattr(value, each.name))
    elif isinstance(value, tuple):
        for each in value:
            yield from numbers(each)


@pytest.mark.parametrize("dialect", ["commercial", "calculix"])
def test_ten_thousand_damaged_decks(dialect):
    chance = random.Random(f"decks in {dialect}")
    read = slowest = 0
    for _ in range(5000):
        text = mutated(chance.choice(DECKS), chance)
        lines = text.split("\n")
        start = time.perf_counter()
        try:
            found = deck.read(lines, dialect=dialect)
        except DeckError as error:
            assert 1 <= error.line <= len(lines) and error.reason, (text, error)
        else:
            read += 1
            assert all(map(math.isfinite, numbers(found)))
            again = found.write().split("\n")
            assert deck.read(again, dialect=dialect, solver=found.solver) == kept(found), text
        slowest = max(slowest, time.perf_counter() - start)
    assert read > 500  # many slips change nothing that matters
    assert slowest < 1.0


def kept(found):
    """The deck with the amplitudes that are written."""
    from dataclasses import replace

    return replace(found, amplitudes=tuple(a for a in found.amplitudes if a.points))


def test_bytes_that_are_no_deck():
    chance = random.Random("bytes")
    for _ in range(300):
        raw = chance.randbytes(chance.randint(0, 400)).replace(b"\0\0", b"*\n")
        try:
            deck.read(raw.split(b"\n"))
        except DeckError as error:
            assert error.line >= 1


def numbers_by_hand(text):
    """Coefficients of plain *FRICTION blocks, by the simplest reading there is."""
    rows, on = [], False
    for line in text.split("\n"):
        if line.startswith("*"):
            on = line == "*FRICTION"
        elif on and line:
            rows.append(tuple(float(w) for w in line.split(",")))
    return rows


def test_numbers_are_those_of_the_text():
    chance = random.Random("numbers")
    for _ in range(300):
        text = ""
        for name in range(chance.randint(1, 4)):
            rows = sorted(chance.uniform(0.0, 9.0) for _ in range(chance.randint(1, 5)))
            data = "\n".join(f"{chance.random()!r}, {rate!r}" for rate in rows)
            text += f"*SURFACE INTERACTION, NAME=i{name}\n*FRICTION\n{data}\n"
        found = [(*r.mu, r.slip_rate) for i in deck.read(text) for r in i.friction.law.rows]
        assert found == numbers_by_hand(text)
