# SPDX-License-Identifier: MIT
"""Checked drivers: every argument of every interface has exactly its documented size."""

from __future__ import annotations

import numpy as np
import pytest

from tests.unit.checked_hosts import HOSTS, Controls, Host, acting, name_of
from usersub import abi
from usersub.errors import ContractError

_EVERYWHERE = pytest.mark.parametrize("host", HOSTS, ids=name_of)


def size_of(arg: abi.Arg, precision: str) -> int:
    return {"char": 1, "int": 4, "real": 4 if precision == "single" else 8}[arg.kind]


def indices(shape: tuple[int, ...], element: int) -> tuple[int, ...]:
    """Fortran's indices of an element that may lie outside: only the last leaves its range."""
    found = []
    for extent in shape[:-1]:
        if extent == 0:
            found.append(1)
            continue
        element, rest = divmod(element, extent)
        found.append(rest + 1)
    return (*found, element + 1) if shape else ()


@pytest.fixture
def acted(c_routine):
    """Driver and controls of a routine that touches one byte."""

    def make(host: Host, **settings):
        made = c_routine(
            host.interface, acting(host), generation=host.generation, precision=host.precision
        )
        controls = Controls(made, host.precision)
        controls.set(-1, 0, False)  # the library may be that of another test
        return host.driver(made, **settings), controls

    return make


@_EVERYWHERE
@pytest.mark.parametrize("write", [False, True], ids=["read", "written"])
def test_one_element_too_far(acted, host, write):
    """The element before the first and the one behind the last, of every argument."""
    driver, controls = acted(host)
    face = abi.interface(host.interface, host.generation)
    for position, arg in enumerate(face.args):
        shape = host.shape(arg, host.points_a_call())
        count, size = int(np.prod(shape, dtype=int)), size_of(arg, host.precision)
        for element in (-1, count):
            controls.set(position, element * size, write)
            with pytest.raises(ContractError) as raised:
                host.run(driver)
            seen = driver.observed()
            assert (seen.what, seen.argument) == ("outside", arg.modern), (arg, element, seen)
            assert seen.element == raised.value.element == element
            assert seen.index == indices(shape, element)
            assert seen.access == ("written" if write else "read")
            spelled = ",".join(map(str, seen.index)) if shape else str(element + 1)
            assert f"{arg.modern}({spelled})" in str(raised.value)
    controls.set(-1, 0, False)
    host.run(driver)
    assert driver.observed().what == "nothing"


@_EVERYWHERE
def test_first_and_last_elements_are_there(acted, host):
    """Inputs may be read and not written, outputs both, up to their last byte."""
    driver, controls = acted(host)
    face = abi.interface(host.interface, host.generation)
    for position, arg in enumerate(face.args):
        count = int(np.prod(host.shape(arg, host.points_a_call()), dtype=int))
        size = size_of(arg, host.precision)
        for element in {0, count - 1} if count else ():
            controls.set(position, element * size, False)
            if arg.intent != "write":
                host.run(driver)
                assert driver.observed().what == "nothing", (arg, driver.observed())
            if arg.intent != "read":
                continue
            controls.set(position, element * size + size - 1, True)
            with pytest.raises(ContractError, match=f"wrote {arg.modern}.*which is an input"):
                host.run(driver)
            seen = driver.observed()
            assert (seen.what, seen.element) == ("input written", element)


@pytest.mark.parametrize("host", HOSTS[:4], ids=name_of)
def test_far_outside(acted, host):
    """An index that is wrong by thousands still belongs to its argument."""
    driver, controls = acted(host)
    face = abi.interface(host.interface, host.generation)
    for position, arg in enumerate(face.args):
        size = size_of(arg, host.precision)
        for element in (-100_000, 100_000):
            controls.set(position, element * size, False)
            with pytest.raises(ContractError):
                host.run(driver)
            assert driver.observed().argument == arg.modern
            assert driver.observed().element == element


@pytest.mark.parametrize("host", [h for h in HOSTS if h.interface.startswith("v")], ids=name_of)
def test_last_block_is_shorter(acted, host):
    """Three points in blocks of two: the sizes are those of each call."""
    driver, controls = acted(host, block=2)
    face = abi.interface(host.interface, host.generation)
    for position, arg in enumerate(face.args):
        count = {n: int(np.prod(host.shape(arg, n), dtype=int)) for n in (1, 2)}
        if count[1] == count[2] or arg.intent == "write":
            continue
        size = size_of(arg, host.precision)
        controls.set(position, count[1] * size, False)  # there in the first block
        with pytest.raises(ContractError, match=r"of which there|but .* is one"):
            host.run(driver)
        assert driver.observed().element == count[1]
        assert driver.observed().argument == arg.modern
    controls.set(-1, 0, False)
    host.run(driver)


@pytest.mark.parametrize("host", [h for h in HOSTS if h.interface.startswith("v")], ids=name_of)
def test_empty_block(acted, host):
    """Arrays of the points have no element at all; the others are as ever."""
    driver, controls = acted(host)
    driver.call_empty_block()
    assert driver.observed().what == "nothing"
    face = abi.interface(host.interface, host.generation)
    for position, arg in enumerate(face.args):
        count = int(np.prod(host.shape(arg, 0), dtype=int))
        controls.set(position, 0, False)
        if count and arg.intent != "write":
            driver.call_empty_block()
        elif count == 0:
            with pytest.raises(ContractError, match="of which there are none.*without points"):
                driver.call_empty_block()
            assert driver.observed().argument == arg.modern
