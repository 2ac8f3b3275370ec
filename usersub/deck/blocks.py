# SPDX-License-Identifier: MIT
"""One *FRICTION block: its parameters and data lines to a `Friction`."""

from __future__ import annotations

from collections.abc import Callable

from usersub.deck import rules
from usersub.deck.friction import (
    ExponentialDecay,
    Friction,
    Law,
    Rough,
    Row,
    Table,
    User,
    decay_from_test_data,
)
from usersub.deck.lines import Lines
from usersub.deck.words import Note, Parameters, Where, entries, real, refuse, show

Warn = Callable[[Note], None]
_PER_LINE = 8
_VARIABLES = ("slip rate", "pressure", "temperature")


def friction(given: Parameters, lines: Lines, dialect: str, warn: Warn) -> Friction:
    """Reads the data lines and checks the block, but for what depends on the solver.

    Raises:
        DeckError: at the line that is wrong.
    """
    where = given.where
    if dialect == "calculix":
        return _calculix(lines, where)
    rules.check_parameters(given)
    anisotropic = "ANISOTROPIC" in given
    dependencies = given.get("DEPENDENCIES", 0)
    law: Law
    if "USER" in given:
        law = _user(given, lines, warn)
    elif "ROUGH" in given:
        _no_data(lines, "ROUGH has no data lines")
        law = Rough()
    elif "EXPONENTIAL DECAY" in given:
        law = _test_data(lines, where) if "TEST DATA" in given else _decay(lines, where)
    else:
        law = _table(lines, where, 1 + anisotropic, dependencies, warn)
        _tell_slope(law, where, anisotropic, warn)
    return Friction(
        law=law,
        method=rules.method_of(given),
        taumax=given.get("TAUMAX"),
        anisotropic=anisotropic,
        shear_traction_slope=given.get("SHEAR TRACTION SLOPE"),
        where=where,
    )


def _no_data(lines: Lines, reason: str) -> None:
    for text, where in lines.data():
        refuse(where, f"the data line {show(text)} is too many: {reason}")


def _coefficient(word: str, where: Where, what: str) -> float:
    if not word:
        refuse(where, f"{what} is missing")
    value = real(word, where, what)
    if value < 0.0:
        refuse(where, f"{what} is {value:g}, expected 0 or more")
    return value


def _user(given: Parameters, lines: Lines, warn: Warn) -> User:
    wanted = given.get("PROPERTIES", 0)
    values: list[float] = []
    short = None
    for text, where in lines.data():
        words = entries(text)
        if short is not None:
            refuse(short, f"{_PER_LINE} properties are expected on each line but the last")
        room = min(_PER_LINE, wanted - len(values))
        if len(words) > room:
            of = f"PROPERTIES = {wanted}" if wanted else "without PROPERTIES"
            refuse(where, f"*FRICTION, USER: {len(values) + len(words)} properties, {of}")
        for number, word in enumerate(words, len(values) + 1):
            if not word:
                warn(Note(where, f"property {number} is blank and taken as 0"))
            values.append(real(word or "0", where, f"property {number}"))
        if len(words) < room and len(values) < wanted:
            short = where
    if len(values) < wanted:
        refuse(given.where, f"*FRICTION: {len(values)} properties, PROPERTIES = {wanted}")
    return User(
        kind=rules.routine_kind(given),
        properties=tuple(values),
        depvar=given.get("DEPVAR", 0),
        dependencies=given.get("DEPENDENCIES", 0),
    )


def _words(text: str, where: Where, columns: int, what: str) -> list[str]:
    """Entries of a line of `columns`, filled up; more are refused unless they are zeros."""
    words = entries(text)
    for extra in words[columns:]:
        if extra and real(extra, where, "an entry") != 0.0:
            refuse(where, f"{len(words)} entries, expected at most {columns}: {what}")
    return [*words[:columns], *[""] * (columns - len(words))]


def _decay(lines: Lines, where: Where) -> ExponentialDecay:
    data = list(_few(lines, 1, "EXPONENTIAL DECAY has one data line"))
    if not data:
        refuse(where, "*FRICTION, EXPONENTIAL DECAY: the data line is missing")
    text, line = data[0]
    words = _words(text, line, 3, "static and kinetic coefficient, decay coefficient")
    names = ("the static coefficient", "the kinetic coefficient", "the decay coefficient")
    mus, muk, dc = (_coefficient(w, line, n) for w, n in zip(words, names, strict=True))
    return ExponentialDecay(mus, muk, dc)


def _test_data(lines: Lines, where: Where) -> ExponentialDecay:
    data = list(_few(lines, 3, "TEST DATA has two or three data lines"))
    if len(data) < 2:
        refuse(where, f"*FRICTION, TEST DATA: {len(data)} data lines, expected two or three")
    (first, line1), (second, line2) = data[:2]
    mu1 = _coefficient(_words(first, line1, 1, "the static coefficient")[0], line1, "mu1")
    words = _words(second, line2, 2, "a coefficient and its slip rate")
    mu2 = _coefficient(words[0], line2, "mu2")
    rate2 = _coefficient(words[1], line2, "the slip rate of mu2")
    mu_inf = None
    if len(data) == 3:
        third, line3 = data[2]
        word = _words(third, line3, 1, "the kinetic coefficient")[0]
        mu_inf = _coefficient(word, line3, "the kinetic coefficient")
    try:
        return decay_from_test_data(mu1, mu2, rate2, mu_inf)
    except ValueError as error:
        refuse(line2, f"*FRICTION, TEST DATA: {error}")


def _few(lines: Lines, most: int, reason: str):
    for count, (text, where) in enumerate(lines.data(), 1):
        if count > most:
            refuse(where, f"the data line {show(text)} is too many: {reason}")
        yield text, where


def _calculix(lines: Lines, where: Where) -> Friction:
    data = list(_few(lines, 1, "*FRICTION has one data line in this dialect"))
    if not data:
        refuse(where, "*FRICTION: the data line is missing")
    text, line = data[0]
    words = _words(text, line, 2, "coefficient and stick slope")
    mu = _coefficient(words[0], line, "the friction coefficient")
    slope = None
    if words[1]:
        slope = real(words[1], line, "the stick slope")
        if slope <= 0.0:
            refuse(line, f"the stick slope is {slope:g}, expected more than 0")
    return Friction(Table((Row((mu,)),)), stick_slope=slope, dialect="calculix", where=where)


def _table(lines: Lines, where: Where, count: int, dependencies: int, warn: Warn) -> Table:
    """A table of `count` coefficients over three variables and the fields."""
    columns = count + len(_VARIABLES) + dependencies
    found: list[tuple[list[float], list[str], Where]] = []
    names = ["the friction coefficient"] if count == 1 else ["mu1", "mu2"]
    pending: list[str] = []
    start = where
    for text, line in lines.data():
        if not pending:
            start = line
        width = min(_PER_LINE, columns - len(pending))
        what = ", ".join([*names, *_VARIABLES, f"{dependencies} fields"])
        pending += _words(text, line, width, what)
        if len(pending) == columns:
            mu = [_coefficient(w, start, n) for w, n in zip(pending[:count], names, strict=True)]
            found.append((mu, pending[count:], start))
            pending = []
    if pending:
        refuse(start, f"the row of {columns} entries breaks off after {len(pending)}")
    if not found:
        refuse(where, "*FRICTION: the data lines are missing")
    return Table(_rows(found, columns - count, dependencies, warn), dependencies)


def _rows(
    found: list[tuple[list[float], list[str], Where]], width: int, fields: int, warn: Warn
) -> tuple[Row, ...]:
    used = [any(words[k] for _, words, _ in found) for k in range(width)]
    names = [*_VARIABLES, *(f"field variable {i + 1}" for i in range(fields))]
    rows = []
    last: tuple[float, ...] | None = None
    for mu, words, where in found:
        place: list[float | None] = []
        for k, word in enumerate(words):
            if not used[k]:
                place.append(None)
                continue
            if not word:
                warn(Note(where, f"the {names[k]} is blank here but not in all rows: taken as 0"))
            value = real(word or "0", where, f"the {names[k]}")
            if k == 0 and value < 0.0:
                refuse(where, f"the slip rate is {value:g}, expected 0 or more")
            place.append(value)
        # the slip rate runs fastest, the last field slowest
        order = tuple(v for v in reversed(place) if v is not None)
        if last is not None and order <= last:
            _refuse_order(order, last, place, names, where)
        last = order
        rows.append(Row(tuple(mu), place[0], place[1], place[2], tuple(place[3:])))
    return tuple(rows)


def _refuse_order(order, last, place, names, where: Where) -> None:
    if not order:
        refuse(where, "a second row, but the rows name no slip rate, pressure or temperature")
    if order == last:
        refuse(where, "the row stands at the same slip rate, pressure and so on as the one before")
    slowest = [name for name, v in zip(names, place, strict=True) if v is not None][::-1]
    name, before, now = next(
        (n, b, v) for n, b, v in zip(slowest, last, order, strict=True) if b != v
    )
    refuse(
        where,
        f"the {name} falls from {before:g} to {now:g}; rows ascend, the slip rate fastest, "
        "the last variable slowest",
    )


def _tell_slope(law: Table, where: Where, anisotropic: bool, warn: Warn) -> None:
    """A lone row with a second column is what decks of another dialect look like."""
    row = law.rows[0]
    if len(law.rows) == 1 and not anisotropic and row.slip_rate:
        warn(
            Note(
                where,
                f"{row.slip_rate:g} beside the only coefficient is a slip rate without effect, "
                "or a stick slope if the deck is one of CalculiX (dialect='calculix')",
            )
        )
