# SPDX-License-Identifier: MIT
"""Friction from input decks: interactions, steps and changes as typed values.

deck = usersub.deck.read("model.inp")
friction = deck["steel-on-steel"].friction
scene = usersub.Scene(points=100, **friction.scene_settings())
driver = usersub.driver(friction.routine(), scene)
"""

from usersub.deck.amplitude import Amplitude
from usersub.deck.friction import (
    ElasticSlip,
    ExponentialDecay,
    Friction,
    Lagrange,
    Rough,
    Row,
    SlipTolerance,
    Table,
    TestData,
    User,
    decay_from_test_data,
)
from usersub.deck.model import Change, Deck, Interaction, OtherFriction, Step
from usersub.deck.reader import read
from usersub.deck.words import Note, Where
from usersub.errors import DeckError

__all__ = [
    "Amplitude",
    "Change",
    "Deck",
    "DeckError",
    "ElasticSlip",
    "ExponentialDecay",
    "Friction",
    "Interaction",
    "Lagrange",
    "Note",
    "OtherFriction",
    "Rough",
    "Row",
    "SlipTolerance",
    "Step",
    "Table",
    "TestData",
    "User",
    "Where",
    "decay_from_test_data",
    "read",
]
