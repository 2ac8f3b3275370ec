# SPDX-License-Identifier: MIT
"""Coefficients from tables over slip rate, pressure, temperature and any number of field variables:
linear between the points of each variable, constant outside them. Calculated in pairs, since a
coefficient may be small next to those that it lies between.

props: numbers of slip rates, pressures, temperatures, field variables; number of points of each
field variable; the points of each variable, ascending; one table after the other, in which the
slip rate runs fastest, then the pressure, the temperature, the field variables.

The counterpart for C is `law_table.h`, for Fortran `law_table.fi`.
"""

from __future__ import annotations

from usersub.lift import pairs


def needed_props(props, tables):
    """Properties that `tables` tables take; those of the least one, or one more than there are, if
    the numbers of points make no sense."""
    count = len(props)
    least = 4 + 3 + tables
    if count < least:
        return least
    if not 0 <= props[3] < count - 4:
        return count + 1
    head = 4 + int(props[3])
    points, values = 0.0, 1.0 * tables
    for i in range(head):
        if i != 3:
            if not 1 <= props[i] <= count:
                return count + 1
            points += int(props[i])
            values *= int(props[i])
    return int(head + points + values) if head + points + values <= count else count + 1


def _interval(props, start, count, x):
    """Both ends of the interval in which x lies; outside, the outermost point twice."""
    last = start + count - 1
    if count < 2 or x < props[start]:
        return 0, 0
    if x >= props[last]:
        return count - 1, count - 1
    low, high = 0, count - 1
    while high - low > 1:
        middle = (low + high) // 2
        if x < props[start + middle]:
            high = middle
        else:
            low = middle
    return low, high


def _share(props, start, low, high, x):
    """How far x lies from one end to the other; 0 where both are one point."""
    x_low, x_high = props[start + low] * 1.0, props[start + high] * 1.0
    inside = 1.0 if high > low else 0.0
    distance = pairs.times(pairs.add(pairs.pair(x), (-x_low, 0.0)), (inside, 0.0))
    width = (1.0, 0.0)
    if high > low:
        width = pairs.add((x_high, 0.0), (-x_low, 0.0))
    return pairs.over(distance, width)


def _between(low, high, share):
    return pairs.add(low, pairs.times(pairs.less(high, low), share))


def _along_rate(props, row, rate):
    low, high, share = rate
    return _between((props[row + low] * 1.0, 0.0), (props[row + high] * 1.0, 0.0), share)


def _along_pressure(props, plane, rates, rate, pressure):
    low, high, share = pressure
    first = _along_rate(props, plane + rates * low, rate)
    return _between(first, _along_rate(props, plane + rates * high, rate), share)


def _field(fields, i):
    """Field variable number i; 0 where the scene has fewer."""
    return fields[i] if i < fields.shape[0] else 0.0


def value(slip_rate, pressure, temperature, fields, props, number):
    """Value of table number `number`, from 0."""
    rates, pressures, temperatures = int(props[0]), int(props[1]), int(props[2])
    field_count = int(props[3])
    rate_points = 4 + field_count
    pressure_points = rate_points + rates
    temperature_points = pressure_points + pressures
    field_points = temperature_points + temperatures

    low, high = _interval(props, rate_points, rates, slip_rate)
    rate = low, high, _share(props, rate_points, low, high, slip_rate)
    low, high = _interval(props, pressure_points, pressures, pressure)
    at_pressure = low, high, _share(props, pressure_points, low, high, pressure)
    cold, warm = _interval(props, temperature_points, temperatures, temperature)
    warmth = _share(props, temperature_points, cold, warm, temperature)

    plane = rates * pressures
    block = plane * temperatures
    table, size = field_points, block
    for i in range(field_count):
        table += int(props[4 + i])
        size *= int(props[4 + i])
    table += size * number

    total, rest = 0.0, 0.0
    for corner in range(2**field_count):
        weight = (1.0, 0.0)
        place, step, start = table, block, field_points
        for i in range(field_count):
            count = int(props[4 + i])
            x = _field(fields, i)
            low, high = _interval(props, start, count, x)
            share = _share(props, start, low, high, x)
            if (corner >> i) & 1:
                place += step * high
                weight = pairs.times(weight, share)
            else:
                place += step * low
                weight = pairs.times(weight, pairs.less((1.0, 0.0), share))
            start += count
            step *= count
        if weight[0] != 0.0:
            first = _along_pressure(props, place + plane * cold, rates, rate, at_pressure)
            second = _along_pressure(props, place + plane * warm, rates, rate, at_pressure)
            part = pairs.times(_between(first, second, warmth), weight)
            total, rest = pairs.add((total, rest), part)
    return total + rest
