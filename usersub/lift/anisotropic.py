# SPDX-License-Identifier: MIT
"""FRIC of two coefficients: the isotropic return mapping on scaled slip and stress.

With m = (mu1 + mu2)/2, a_i = mu_i/m, elastic predictor g, g~_i = a_i g_i and the allowable elastic
slip c, the stress is tau_i = m p a_i g~_i/|g~| beyond |g~| = c, and (m p/c) a_i² g_i below it. The
coefficients depend on the plastic slip, which depends on them: one equation for the excess
e = |g~| - c. As a_1 + a_2 = 2, |g~| is at most twice the larger |g_i|, so that the solution is
bracketed before the first trial. A direction whose coefficient alone is zero is frictionless: all
its motion is plastic slip. The driver's own enforcement of FRIC_COEF (`penalty.h`) is the same.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from numpy import empty

from usersub.lift.fric import TOLERANCE, turn
from usersub.lift.kernels import Parts, clear, mean_fields, ratio

#: More trials than a bisection of all numbers takes.
_TRIALS = 240
#: Trials that only step towards the other end, before it is asked itself.
_STEPS = 8
_ROUNDING = 4.0 * 2.0**-52


def middle(c, low, high):
    """Middle of a bracket of excesses; geometric in c + e while its ends are far apart."""
    if c + high > 4.0 * (c + low):
        return min(max(math.sqrt(c + low) * math.sqrt(c + high) - c, low), high)
    return low + 0.5 * (high - low)


def scales(first, second):
    """The coefficients over their mean, and the mean."""
    mean = 0.5 * first + 0.5 * second
    larger = max(first, second)
    if larger <= 0.0:
        return 1.0, 1.0, mean
    share = min(first, second) / larger
    most = 2.0 / (1.0 + share)
    return (most, share * most, mean) if first >= second else (share * most, most, mean)


def scale_derivative(a, mean, by_first, by_second):
    """Derivative of a_1 = 2 - a_2 where the coefficients change by these two."""
    return 0.5 * (a[1] * by_first - a[0] * by_second) / mean if mean > 0.0 else 0.0


def _solver(parts: Parts) -> tuple[Callable, Callable]:
    """Functions that ask for the coefficients at an excess, and that find the excess."""
    evaluate, law = parts.evaluate, parts.law
    stateful = law.reads("state")
    negative = f"{law.name} behind FRIC returns a coefficient below zero, or no number"

    def attempt(e, c, g, free, point):
        """Trial of an excess: plastic slip, its length, the law's answer, scales, |g~|."""
        dt, p, temperature, field, committed, state, props = point
        share = e / (c + e)
        plastic = (g[0] if free[0] else share * g[0], g[1] if free[1] else share * g[1])
        length = math.hypot(plastic[0], plastic[1])
        if stateful:
            for j in range(committed.shape[0]):
                state[j] = committed[j]
        found = evaluate(
            ratio(length, dt), p, temperature, field, length, dt, state, props
        )  # fmt: skip
        if not (found[0] >= 0.0 and found[1] >= 0.0):
            raise ValueError(negative)
        a = scales(found[0], found[1])
        return plastic, length, found, a, math.hypot(a[0] * g[0], a[1] * g[1])

    def excess(c, g, free, point):
        """The excess e = max(0, |g~(e)| - c) and its trial; sticking where both are solutions."""
        low, high = 0.0, 2.0 * max(abs(g[0]), abs(g[1])) - c
        f_low, f_high, growth, side, e = 0.0, 0.0, 1.0, 0, 0.0
        trial = attempt(e, c, g, free, point)
        for step in range(_TRIALS):
            f = max(0.0, trial[4] - c) - e
            rounding = _ROUNDING * (c + e)
            if abs(f) <= rounding:  # an elastic slip that was left at its limit is rounded
                break
            if f > 0.0:
                f_high *= 0.5 if side > 0 else 1.0
                low, f_low, side = e, f, 1
            else:
                f_low *= 0.5 if side < 0 else 1.0
                high, f_high, side = e, f, -1
            if high - low <= rounding:
                break
            if f_high == 0.0:
                e = min(low + growth * f_low, high) if step < _STEPS else high
                growth *= 2.0
            else:
                e = low + (high - low) * (f_low / (f_low - f_high))
                if step % 3 == 2 or not low < e < high:
                    e = middle(c, low, high)
            trial = attempt(e, c, g, free, point)
        return e, trial

    return attempt, excess


def _solution(parts: Parts) -> Callable:
    """Function that finds the excess, its trial, and which directions are frictionless."""
    attempt, excess = _solver(parts)

    def solution(n, c, g, point):
        free = (False, False)
        if n == 1:
            e = abs(g[0]) - c
            e = e if e > _ROUNDING * c else 0.0
            plastic, length, found, a, scaled = attempt(e, c, g, free, point)
            return e, (plastic, length, found, (1.0, 1.0, found[0]), abs(g[0])), free
        e, trial = excess(c, g, free, point)
        mu = (trial[2][0], trial[2][1])
        i = 0 if mu[0] == 0.0 else 1
        if mu[i] == 0.0 and mu[1 - i] > 0.0 and g[i] != 0.0:
            alone = (i == 0, i == 1)
            e_alone, trial_alone = excess(c, g, alone, point)
            mu = (trial_alone[2][0], trial_alone[2][1])
            if mu[i] == 0.0 and mu[1 - i] > 0.0:
                return e_alone, trial_alone, alone
            # Zero only while this direction does not slide: then it does not.
            e, trial = excess(c, g, free, point)
        return e, trial, free

    return solution


def derivatives(n, c, e, g, free, trial, slips, direction, dt):
    """Total derivatives of both coefficients and of a_1 by motion 1 and 2, pressure, temperature.

    The excess depends on the coefficients, which depend on the excess: one linear equation.
    """
    plastic, length, found, a, _ = trial
    whole = c + e
    by_first = ratio(found[2][0], dt) + found[2][3]
    by_second = ratio(found[3][0], dt) + found[3][3]
    unit = (ratio(plastic[0], length), ratio(plastic[1], length))
    moves = 0.0
    for j in range(2):
        if not free[j]:
            moves += unit[j] * (g[j] / whole) * (c / whole)
    reacts = (by_first * moves, by_second * moves)
    by_a = direction[0] * g[0] - direction[1] * g[1]
    two = n > 1
    own = by_a * scale_derivative(a, a[2], reacts[0], reacts[1]) if two else 0.0
    # On a fold the excess has no derivative: its reaction on itself is left out.
    divisor = 1.0 - own if own < 1.0 else 1.0
    result = empty((3, 4))
    for x in range(4):
        if x < 2:
            share = unit[x] * (1.0 if free[x] else e / whole)
            first, second = by_first * share, by_second * share
        else:
            first, second = found[2][x - 1], found[3][x - 1]
        if slips:
            change = by_a * scale_derivative(a, a[2], first, second) if two else 0.0
            if x < 2:
                change += direction[x] * a[x]
            first += reacts[0] * (change / divisor)
            second += reacts[1] * (change / divisor)
        result[0, x] = first
        result[1, x] = second
        result[2, x] = scale_derivative(a, a[2], first, second) if two else 0.0
    return result


def tangent(n, p, pressed, g, a, size, slips, by, ddtddg, ddtddp, ddtddt):
    """Derivatives of tau_i = m p a_i n_i, n the scaled predictor over its size."""
    unit = (a[0] * g[0] / size, a[1] * g[1] / size)
    limit = a[2] * p
    for x in range(4):
        mean = 0.5 * by[0, x] + 0.5 * by[1, x] if n > 1 else by[0, x]
        d_limit = p * mean
        if x == 2:
            d_limit = d_limit + a[2] if pressed else 0.0
        scaled_1 = (a[0] if x == 0 else 0.0) + g[0] * by[2, x]
        scaled_2 = (a[1] if x == 1 else 0.0) - g[1] * by[2, x]
        # In slip only the part across the direction turns it: then nothing cancels.
        turns = unit[0] * scaled_2 - unit[1] * scaled_1
        d_1 = -unit[1] * turns if slips else scaled_1
        d_2 = unit[0] * turns if slips else scaled_2
        for i in range(n):
            d_unit = d_1 if i == 0 else d_2
            d_a = by[2, x] if i == 0 else -by[2, x]
            slope = a[i] * limit * (d_unit / size) + limit * d_a * unit[i]
            slope += a[i] * unit[i] * d_limit
            if x < n:
                ddtddg[i, x] = slope
            elif x == 2:
                ddtddp[i] = slope
            elif x == 3:
                ddtddt[i, 0] = ddtddt[i, 1] = 0.5 * slope


def penalty(parts: Parts) -> Callable:
    """FRIC of an anisotropic coefficient; with one friction direction the first one counts."""
    solution, needed, scalars = _solution(parts), parts.needed, parts.scalars
    law, few = parts.law, parts.too_few("FRIC")
    no_state = f"{law.name} behind FRIC keeps its elastic slip in one state variable a direction"
    no_length = f"{law.name} behind FRIC needs a characteristic length above zero"
    temperatures, fields = law.reads("temperature"), law.reads("fields")

    def routine(LM, TAU, DDTDDG, DDTDDP, DDTDDT, DSLIP, SED, SFD, STATEV, DGAM, DROT, PRESS, DTIME,
                CHRLNGTH, TEMP, PREDEF, PROPS):  # fmt: skip
        n = DGAM.shape[0]
        if LM[0] == 2:  # open so far: no friction in the increment that closes the point
            clear(STATEV)
            return
        c = TOLERANCE * CHRLNGTH
        if PROPS.shape[0] < needed(PROPS):
            raise ValueError(few)
        if STATEV.shape[0] < n + scalars(PROPS):
            raise ValueError(no_state)
        if not c > 0:
            raise ValueError(no_length)
        LM[0] = 0

        turn(STATEV, DROT, DGAM)
        g = (STATEV[0], STATEV[1] if n > 1 else 0.0)
        state = STATEV[n : n + scalars(PROPS)]
        committed = empty(state.shape[0])
        committed[:] = state
        p = max(PRESS, 0.0)
        temperature = 0.5 * (TEMP[0] + TEMP[1]) if temperatures else 0.0
        field = mean_fields(PREDEF) if fields else PROPS
        point = (DTIME, p, temperature, field, committed, state, PROPS)
        e, trial, free = solution(n, c, g, point)
        plastic, _, _, a, scaled = trial

        slips = e > 0.0 and scaled > 0.0
        size = scaled if slips else min(max(scaled, c), c + _ROUNDING * c)
        limit = a[2] * p
        direction = (a[0] * g[0] / size, a[1] * g[1] / size)
        by = derivatives(n, c, e, g, free, trial, slips, direction, DTIME)
        SED[0] = SFD[0] = 0.0
        for i in range(n):
            TAU[i] = limit * a[i] * direction[i]
            DSLIP[i] = plastic[i]
            STATEV[i] = 0.0 if free[i] else c / (c + e) * g[i]
            SED[0] += 0.5 * TAU[i] * STATEV[i]
            SFD[0] += TAU[i] * DSLIP[i]
        tangent(n, p, PRESS >= 0, g, a, size, slips, by, DDTDDG, DDTDDP, DDTDDT)

    return routine
