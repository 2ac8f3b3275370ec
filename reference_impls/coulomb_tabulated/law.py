# SPDX-License-Identifier: MIT
"""Coefficient from a table over slip rate, pressure, temperature: linear inside, constant outside.

props: numbers of rates, pressures, temperatures; these points, ascending; the coefficients, the
rate running fastest.
"""

from usersub.laws.lift import coefficient_law, jitable


def needed_props(props):
    """Properties that the table takes; one more than there are, if the sizes make no sense."""
    if len(props) < 7:
        return 7
    points, values = 3.0, 1.0
    for i in range(3):
        if not 1 <= props[i] <= len(props):
            return len(props) + 1
        points += int(props[i])
        values *= int(props[i])
    return int(points + values) if points + values <= len(props) else len(props) + 1


@jitable
def find(props, start, count, x):
    """Where x lies among ascending points: both ends, share of the upper one, 1/width or 0."""
    if count < 2 or x < props[start]:
        return 0, 0, 0.0, 0.0
    if x >= props[start + count - 1]:
        return count - 1, count - 1, 0.0, 0.0
    low, high = 0, count - 1
    while high - low > 1:
        middle = (low + high) // 2
        if x < props[start + middle]:
            high = middle
        else:
            low = middle
    width = props[start + high] - props[start + low]
    return low, high, (x - props[start + low]) / width, 1.0 / width


@jitable
def between(low, high, share):
    return low + (high - low) * share


@jitable
def along_rate(props, row, rate):
    """Value and derivative by slip rate on one row of the table."""
    low, high, share, slope = rate
    first, last = props[row + low], props[row + high]
    return between(first, last, share), (last - first) * slope


def coulomb_tabulated(slip_rate, pressure, temperature, props):
    rates, pressures, temperatures = int(props[0]), int(props[1]), int(props[2])
    table = 3 + rates + pressures + temperatures
    rate = find(props, 3, rates, slip_rate)
    p_low, p_high, p_share, p_slope = find(props, 3 + rates, pressures, pressure)
    t_low, t_high, t_share, t_slope = find(props, 3 + rates + pressures, temperatures, temperature)
    cold, warm = table + rates * pressures * t_low, table + rates * pressures * t_high
    cold_low, cold_low_rate = along_rate(props, cold + rates * p_low, rate)
    cold_high, cold_high_rate = along_rate(props, cold + rates * p_high, rate)
    warm_low, warm_low_rate = along_rate(props, warm + rates * p_low, rate)
    warm_high, warm_high_rate = along_rate(props, warm + rates * p_high, rate)
    mu_cold = between(cold_low, cold_high, p_share)
    mu_warm = between(warm_low, warm_high, p_share)
    return (
        between(mu_cold, mu_warm, t_share),
        between(
            between(cold_low_rate, cold_high_rate, p_share),
            between(warm_low_rate, warm_high_rate, p_share),
            t_share,
        ),
        between((cold_high - cold_low) * p_slope, (warm_high - warm_low) * p_slope, t_share),
        (mu_warm - mu_cold) * t_slope,
    )


fric, fric_coef, vfric, vfriction, vfric_coef = coefficient_law(
    coulomb_tabulated, props=needed_props
)
