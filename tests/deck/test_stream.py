# SPDX-License-Identifier: MIT
"""A large deck is read in the memory of its friction, whether a file or a stream."""

import itertools
import tracemalloc

from usersub import deck

NODE = "123456, 1.2345678901234567e-01, -3.2345678901234567e-01, 1.2345678901234567e-01\n"
ELEMENT = "1234567, " + ", ".join(str(1234567 + k) for k in range(15)) + "\n"
PART = ["*NODE, NSET=all\n", *[NODE] * 10000, "*ELEMENT, TYPE=C3D20\n", *[ELEMENT] * 10000]
FRICTION = ["*SURFACE INTERACTION, NAME=last\n", "*FRICTION\n", "0.3\n"]
SIZE = 50_000_000
#: Read buffer, the interpreter's own allocations and the result; 1/50 of the stream.
BOUND = 1_000_000


def peak(source):
    tracemalloc.start()
    try:
        found = deck.read(source)
        return found, tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_fifty_megabytes_of_lines():
    times = SIZE // sum(map(len, PART)) + 1
    lines = itertools.chain(*itertools.repeat(PART, times), FRICTION)
    found, memory = peak(lines)
    assert found["last"].where.line == times * len(PART) + 1
    assert memory < BOUND


def test_fifty_megabytes_in_a_file(tmp_path):
    path = tmp_path / "large.inp"
    times = SIZE // sum(map(len, PART)) + 1
    part = "".join(PART)
    with path.open("w") as file:
        for _ in range(times):
            file.write(part)
        file.writelines(FRICTION)
    found, memory = peak(path)
    assert found["last"].where.line == times * len(PART) + 1
    assert memory < BOUND


def test_a_line_of_twenty_megabytes(tmp_path):
    path = tmp_path / "line.inp"
    path.write_text("*NODE\n" + "1, " * 7_000_000 + "\n" + "".join(FRICTION))
    found, memory = peak(path)
    assert found["last"].where.line == 3
    assert memory < BOUND
