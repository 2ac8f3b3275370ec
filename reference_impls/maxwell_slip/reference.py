# SPDX-License-Identifier: MIT
"""Generalised Maxwell slip in arbitrary precision, as complex numbers along the motion."""

from mpmath import conj, exp, mpc, mpf, sqrt


def _decayed(distance, attraction, time, strength):
    if strength <= 0 or attraction * time / strength > 10**6:  # smaller than any number
        return 0 * distance
    return distance * exp(-attraction * time / strength)


def _rest(start, limit, attraction, time, strength):
    """The end of an element where nothing moves."""
    if abs(start) <= limit:
        return start
    size = limit + _decayed(abs(start) - limit, attraction, time, strength)
    return size * start / abs(start)


def _move(start, slips, motion, time, stiffness, limit, attraction, strength):
    """The end of an element under motion, and whether it slips."""
    length = abs(motion)
    along = motion / length
    turned = start * conj(along)  # real: along the motion
    stick = mpf(0)
    if not (slips and turned.real > 0):
        # up to where |turned + stiffness stick| = limit on the way out
        inside = limit**2 - turned.imag**2
        out = sqrt(inside) if inside > 0 else mpf(0)
        stick = max((out - turned.real) / stiffness, mpf(0))
    if length < stick:
        return start + stiffness * motion, False
    begin = turned + stiffness * stick
    left = time * (1 - stick / length)
    return (limit + _decayed(begin - limit, attraction, left, strength)) * along, True


def update(q, props):
    """Traction, tractions of the elements, whether each slips."""
    mus, muk, vs, delta, attraction, viscosity = props[:6]
    n, dt, motion = int(props[6]), q.time_increment, mpc(*q.motion)
    rate = abs(motion) / dt if dt > 0 else mpf(0)
    strength = q.pressure * (muk + (mus - muk) * exp(-((rate / vs) ** delta)))
    total = viscosity * motion / dt if dt > 0 else mpc(0)
    ends, slip = [], []
    for i in range(n):
        start, limit = mpc(*q.vectors[i]), props[7 + n + i] * strength
        if motion == 0:
            end, slips = _rest(start, limit, attraction, dt, strength), False
        else:
            end, slips = _move(
                start, q.state[i] > 0, motion, dt, props[7 + i], limit, attraction, strength
            )
        ends.append((mpf(end.real), mpf(end.imag)))
        slip.append(mpf(int(slips)))
        total += end
    return (total.real, total.imag), tuple(ends), tuple(slip)


#: At rest the derivative depends on the direction of the motion that follows.
_REST = {"no_derivative": ["motion 1", "motion 2", "pressure"]}


def _path(*increments):
    return [
        {"motion": m, "pressure": p, "time_increment": dt} | (_REST if m == (0.0, 0.0) else {})
        for m, p, dt in increments
    ]


CASES = [
    {
        "props": [0.5, 0.3, 0.01, 2.0, 30.0, 0.5, 3, 4e3, 2e3, 1e3, 0.2, 0.3, 0.5],
        "path": _path(
            ((5e-5, 0.0), 4.0, 0.25), ((1e-4, -3e-5), 4.0, 0.25), ((4e-4, 1e-4), 4.0, 0.125),
            ((3e-3, 5e-4), 4.0, 0.25), ((8e-4, 3e-4), 4.0, 0.25), ((0.0, 0.0), 4.0, 0.25),
            ((-1.5e-4, 1e-5), 4.0, 0.125), ((2e-3, 3e-4), 3.0, 2.0**-6), ((-1e-3, 5e-4), 5.0, 0.25),
            ((1e-9, 2e-9), 5.0, 0.25), ((-40.0, 7.0), 5.0, 64.0), ((3e-5, 3e-5), 0.5, 2.0**-7),
            ((2e-3, 1e-5), 0.5, 0.25),
        ),
    },
    {  # one element; the pressure goes and comes back
        "props": [0.2, 0.6, 0.5, 1.0, 1e3, 0.0, 1, 2e5, 1.0],
        "path": _path(
            ((1e-5, 2e-5), 30.0, 0.25), ((5e-5, -1e-5), 30.0, 2.0**-7), ((0.0, 0.0), 2.0, 2.0**-9),
            ((1e-5, 0.0), 0.0, 0.25), ((0.0, 0.0), 0.0, 0.25), ((1e-6, 1e-6), 10.0, 0.25),
            ((1e6, 1e6), 10.0, 0.25),
        ),
    },
]  # fmt: skip
