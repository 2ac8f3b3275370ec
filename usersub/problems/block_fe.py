# SPDX-License-Identifier: MIT
"""The block as finite elements in an explicit host: central differences, penalty contact.

The block first rests on the plane under its pressure (a static solution) and then gets its velocity
at once, so that no vertical oscillation disturbs the contact pressure. Each increment:

1. nodal forces: pressure, elasticity, stiffness-proportional damping (a tenth of critical at the
   highest frequency; it has no resultant), penalty contact in the normal direction;
2. predicted velocities, and from them the slip and the stick force m |v_t|/dt of each contact
   node (kinematic enforcement);
3. friction from the driver, velocities, displacements.

The block has stopped when its mean velocity first reaches zero (linear between increments), and the
distance is the largest mean displacement: both belong to the whole block, not to one node, and the
elastic oscillation of the block after the stop does not enter.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from usersub import stick_force_kinematic
from usersub.problems.block import NOT_STOPPED, Block, Stop
from usersub.problems.elements import Mesh
from usersub.problems.explicit_contact import ExplicitContact, mean_slip

#: Damping at the highest frequency over critical damping.
_DAMPING = 0.1

#: Penalty stiffness of the normal contact over the node's own vertical stiffness.
_PENALTY = 1.0


@dataclass
class FiniteElementBlock:
    """The block on the plane.

    Args:
        share: time increment over the largest stable one.
    """

    block: Block
    mesh: Mesh
    contact: ExplicitContact
    share: float = 0.9

    def __post_init__(self) -> None:
        mesh, d = self.mesh, self.mesh.coordinates.shape[1]
        self.mass = np.repeat(mesh.mass, d)
        self.normal_dof = d * mesh.bottom + 1
        self.stiffness = mesh.stiffness
        own = np.diagonal(self.stiffness)[self.normal_dof]
        self.penalty = _PENALTY * own
        held = self.stiffness.copy()
        held[self.normal_dof, self.normal_dof] += self.penalty
        scaled = held / np.sqrt(np.outer(self.mass, self.mass))
        highest = float(np.sqrt(np.linalg.eigvalsh(scaled)[-1]))
        self.damping = 2.0 * _DAMPING / highest
        stable = 2.0 / highest * (np.sqrt(1.0 + _DAMPING**2) - _DAMPING)
        self.time_increment = float(self.share * stable)
        self.load = np.zeros(self.mass.size)
        self.load[1::d] = -self.block.pressure * self.block.area * mesh.top_load
        # The plane leaves rigid horizontal motion free: the least motion among the solutions.
        self.displacement = np.linalg.lstsq(held, self.load, rcond=1e-12)[0]

    def run(self, end: float, history: list | None = None) -> Stop:
        """Slides until the mean velocity is zero; NaN if it is not by the time `end`."""
        mesh, contact, dt = self.mesh, self.contact, self.time_increment
        d = mesh.coordinates.shape[1]
        bottom_mass = mesh.mass[mesh.bottom]
        normal = np.zeros((d, len(mesh.bottom)), order="F")
        normal[1] = 1.0
        mean = np.zeros_like(self.load)
        mean[0::d] = mesh.mass / mesh.mass.sum()
        friction = np.zeros_like(normal)
        u, v, t = self.displacement.copy(), np.zeros_like(self.load), 0.0
        v[0::d] = before = self.block.velocity
        start = float(mean @ u)
        while t < end:
            h = dt if t > 0.0 else 0.5 * dt  # velocities live in the middle of the increments
            pressed = self.penalty * np.maximum(0.0, -u[self.normal_dof])
            force = self.load - self.stiffness @ (u + self.damping * v)
            force[self.normal_dof] += pressed
            nodal = v.reshape(-1, d)
            last = nodal[mesh.bottom].T
            v += h * force / self.mass
            sliding = np.asfortranarray(nodal[mesh.bottom].T)
            last[1] = sliding[1] = 0.0
            stick = stick_force_kinematic(sliding, normal, bottom_mass, h)
            contact.move((mesh.coordinates + u.reshape(-1, d))[mesh.bottom].T, sliding)
            slip = mean_slip(last, sliding, friction, bottom_mass, h)
            friction = contact.force(slip, pressed, stick, h, t + 0.5 * dt)
            nodal[mesh.bottom] += (h * friction / bottom_mass).T
            now, here = float(mean @ v), float(mean @ u) - start
            if history is not None:
                history.append((t, here, 0.5 * (before + now), -friction[0].sum()))
            if now <= 0.0:
                middle = 0.5 * (before + now)
                rest = h * middle / (before - now)
                return Stop(t + rest, here + 0.5 * middle * rest)
            u += dt * v
            t, before = t + dt, now
        return NOT_STOPPED
