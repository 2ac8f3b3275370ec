# SPDX-License-Identifier: MIT
"""The hash of a function follows all that its machine code depends on."""

from __future__ import annotations

import types

from usersub import laws
from usersub.routine.fingerprint import fingerprint


def helper_module(factor):
    """A module of somebody's with a function, a constant and something that has no value."""
    module = types.ModuleType("helpers")
    text = f"FACTOR = {factor}\nOTHER = object()\ndef scaled(x):\n    return FACTOR * x"
    exec(text, vars(module))
    module.itself = module
    return module


def law(helpers, text="helpers.scaled(rate)"):
    space = {"helpers": helpers}
    exec(f"def law(rate):\n    return {text}", space)
    return space["law"]


def test_a_module_of_the_users_is_followed_as_far_as_it_is_named():
    first = fingerprint(law(helper_module(2.0)))
    assert first is not None and first == fingerprint(law(helper_module(2.0)))
    assert first != fingerprint(law(helper_module(3.0)))


def test_a_module_that_names_itself_ends():
    assert fingerprint(law(helper_module(2.0), "helpers.itself.scaled(rate)")) is not None


def test_what_cannot_be_told_is_not_cached():
    assert fingerprint(law(helper_module(2.0), "helpers.OTHER")) is None


def test_every_shipped_law_is_cached():
    """Compiling the tabulated laws takes seconds; a law without a hash is compiled every time."""
    for name, entry in laws.LAWS.items():
        if entry.kind == "stick":
            continue
        file = laws.load(name)
        for routine in file.values():
            assert fingerprint(routine.function) is not None, f"{name} {routine.interface.name}"
