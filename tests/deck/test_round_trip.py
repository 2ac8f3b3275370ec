# SPDX-License-Identifier: MIT
"""A friction that is written is read as the same friction."""

from hypothesis import given
from hypothesis import strategies as st

from usersub import deck
from usersub.deck import (
    ElasticSlip,
    ExponentialDecay,
    Friction,
    Lagrange,
    Rough,
    Row,
    SlipTolerance,
    Table,
    User,
    decay_from_test_data,
)

POSITIVE = st.floats(min_value=1e-300, max_value=1e300)
COEFFICIENT = st.floats(min_value=0.0, max_value=1e6)
ANY = st.floats(allow_nan=False, allow_infinity=False).map(lambda x: x + 0.0)


@st.composite
def tables(draw, count):
    fields = draw(st.integers(0, 13))
    used = draw(st.lists(st.booleans(), min_size=3 + fields, max_size=3 + fields))
    place = st.tuples(
        *(st.none() if not u else (COEFFICIENT if k == 0 else ANY) for k, u in enumerate(used))
    )
    most = 5 if any(used) else 1
    key = lambda p: tuple(v for v in reversed(p) if v is not None)  # noqa: E731
    places = draw(st.lists(place, min_size=1, max_size=most, unique_by=key))
    rows = []
    for p in sorted(places, key=key):
        mu = tuple(draw(COEFFICIENT) for _ in range(count))
        rows.append(Row(mu, *p[:3], p[3:]))
    return Table(tuple(rows), fields)


@st.composite
def decays(draw):
    if draw(st.booleans()):
        return ExponentialDecay(draw(COEFFICIENT), draw(COEFFICIENT), draw(COEFFICIENT))
    mu_inf = draw(st.floats(0.0, 0.2))
    mu1 = draw(st.floats(0.5, 0.8))
    mu2 = draw(st.floats(0.25, 0.45))
    last = mu_inf if draw(st.booleans()) else None
    return decay_from_test_data(mu1, mu2, draw(st.floats(1e-6, 1e6)), last)


METHODS = st.one_of(
    st.none(), st.just(Lagrange()), POSITIVE.map(ElasticSlip), POSITIVE.map(SlipTolerance)
)


@st.composite
def frictions(draw):
    kind = draw(st.sampled_from(["table", "anisotropic", "decay", "rough", "user", "softened"]))
    limit = draw(st.none() | COEFFICIENT)
    if kind == "user":
        routine = draw(st.sampled_from(["FRIC", "FRICTION", "COEFFICIENT"]))
        properties = tuple(draw(st.lists(ANY, max_size=20)))
        return Friction(User(routine, properties, draw(st.integers(0, 99))), taumax=limit)
    if kind == "decay":
        return Friction(draw(decays()), draw(METHODS))
    if kind == "rough":
        return Friction(Rough(), shear_traction_slope=draw(st.none() | POSITIVE))
    if kind == "softened":
        slope = draw(POSITIVE)
        return Friction(draw(tables(1)), taumax=limit, shear_traction_slope=slope)
    anisotropic = kind == "anisotropic"
    law = draw(tables(1 + anisotropic))
    return Friction(law, draw(METHODS), taumax=limit, anisotropic=anisotropic)


@given(frictions())
def test_friction(friction):
    text = f"*SURFACE INTERACTION, NAME=a\n{friction}\n"
    (one,) = deck.read(text)
    assert one.friction == friction
    assert str(one.friction) == str(friction)


@given(st.floats(0.0, 1e3), st.none() | POSITIVE)
def test_friction_of_calculix(mu, slope):
    friction = Friction(Table((Row((mu,)),)), stick_slope=slope, dialect="calculix")
    text = f"*SURFACE INTERACTION, NAME=a\n{friction}\n"
    assert deck.read(text, dialect="calculix")["a"].friction == friction


NAMES = st.text(
    st.characters(codec="utf-8", exclude_categories=("C", "Z"), exclude_characters='"'),
    min_size=1,
    max_size=12,
)


@given(
    st.lists(
        st.tuples(NAMES, st.none() | frictions()), max_size=4, unique_by=lambda x: x[0].upper()
    )
)
def test_deck(given_interactions):
    blocks = [str(deck.Interaction(name, friction)) for name, friction in given_interactions]
    found = deck.read([line for block in blocks for line in block.split("\n")])
    assert [(i.name, i.friction) for i in found] == given_interactions
    again = deck.read(found.write().encode().split(b"\n"))
    assert again == found
    assert again.write() == found.write()


def test_written_to_a_file(tmp_path):
    found = deck.read("*SURFACE INTERACTION, NAME=Größe\n1.\n*FRICTION\n0.3\n")
    text = found.write(tmp_path / "b.inp")
    assert text == "*SURFACE INTERACTION, NAME=Größe\n1.0,\n*FRICTION\n0.3,\n"
    assert deck.read(tmp_path / "b.inp") == found
