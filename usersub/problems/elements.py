# SPDX-License-Identifier: MIT
"""Linear elastic meshes of the block: two plane-strain triangles, or one-point hexahedra.

Small strains; stiffness assembled once, lumped masses.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from usersub.problems.block import Block


@dataclass(frozen=True)
class Mesh:
    """A meshed block that stands on y = 0.

    Attributes:
        coordinates: shape (nodes, dimension).
        stiffness: shape (nodes * dimension, nodes * dimension), node by node.
        mass: lumped, shape (nodes,).
        bottom: nodes on the plane. area: of each of them.
        top_load: share of the load on the top face that each node carries, shape (nodes,).
    """

    coordinates: np.ndarray
    stiffness: np.ndarray
    mass: np.ndarray
    bottom: np.ndarray
    area: np.ndarray
    top_load: np.ndarray


def _elasticity(block: Block, strains: int, normal: int) -> np.ndarray:
    """Elasticity matrix with `normal` normal and `strains - normal` shear strains."""
    lame = block.young * block.poisson / ((1 + block.poisson) * (1 - 2 * block.poisson))
    shear = block.young / (2 * (1 + block.poisson))
    matrix = np.zeros((strains, strains))
    matrix[:normal, :normal] = lame
    diagonal = np.arange(strains)
    matrix[diagonal, diagonal] += np.where(diagonal < normal, 2 * shear, shear)
    return matrix


def _assemble(stiffness: np.ndarray, element: np.ndarray, nodes: np.ndarray) -> None:
    d = len(element) // len(nodes)
    dof = (d * nodes[:, None] + np.arange(d)).ravel()
    stiffness[np.ix_(dof, dof)] += element


def triangles(block: Block) -> Mesh:
    """Two constant-strain triangles in plane strain, of the block's width (CPE3)."""
    length, height = block.length, block.height
    x = np.array([[0.0, 0.0], [length, 0.0], [length, height], [0.0, height]])
    elasticity = _elasticity(block, 3, 2)
    stiffness, mass = np.zeros((8, 8)), np.zeros(4)
    for nodes in (np.array([0, 1, 2]), np.array([0, 2, 3])):
        edges = np.vstack([x[nodes].T, np.ones(3)])
        gradient = np.linalg.inv(edges)[:, :2].T  # d shape / d x, shape (2, 3)
        volume = 0.5 * abs(np.linalg.det(edges)) * block.width
        strain = np.zeros((3, 6))
        strain[0, 0::2] = strain[2, 1::2] = gradient[0]
        strain[1, 1::2] = strain[2, 0::2] = gradient[1]
        _assemble(stiffness, volume * strain.T @ elasticity @ strain, nodes)
        mass[nodes] += block.density * volume / 3
    half = np.full(2, 0.5)
    return Mesh(x, stiffness, mass, np.array([0, 1]), block.area * half, np.array([0, 0, 0.5, 0.5]))


#: Corners of the reference hexahedron, shape (8, 3).
_CORNERS = np.array(
    [
        [-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1],
        [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1],
    ],
    float,
)  # fmt: skip

#: Stiffness of hourglass control, as a share of the element's.
_HOURGLASS = 0.05


def _hexahedron(block: Block, corners: np.ndarray) -> tuple[np.ndarray, float]:
    """Stiffness and volume of a hexahedron with one integration point.

    The four hourglass modes get a stiffness that leaves linear fields alone (Flanagan and
    Belytschko 1981, equations 55 to 57).
    """
    jacobian = _CORNERS.T @ corners / 8
    volume = 8 * np.linalg.det(jacobian)
    gradient = np.linalg.solve(jacobian, _CORNERS.T / 8)  # shape (3, 8)
    strain = np.zeros((6, 24))
    for row, (i, j) in enumerate([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]):
        strain[row, i::3] += gradient[j]
        if i != j:
            strain[row, j::3] += gradient[i]
    elasticity = _elasticity(block, 6, 3)
    stiffness = volume * strain.T @ elasticity @ strain
    xi, eta, zeta = _CORNERS.T
    modes = np.array([eta * zeta, zeta * xi, xi * eta, xi * eta * zeta])
    modes -= modes @ corners @ gradient
    size = _HOURGLASS * elasticity[0, 0] * (gradient**2).sum() * volume / 8
    control = size * modes.T @ modes
    for i in range(3):
        stiffness[i::3, i::3] += control
    return stiffness, volume


def hexahedra(block: Block) -> Mesh:
    """Two one-point hexahedra along the block, with hourglass control (C3D8R)."""
    count = 2
    along = np.linspace(0.0, block.length, count + 1)
    sides = [(y, z) for y in (0.0, block.height) for z in (0.0, block.width)]
    x = np.array([[a, y, z] for y, z in sides for a in along])

    def node(i: int, j: int, k: int) -> int:
        return (2 * j + k) * (count + 1) + i

    stiffness, mass = np.zeros((3 * len(x), 3 * len(x))), np.zeros(len(x))
    share = np.zeros(len(x))
    for e in range(count):
        nodes = np.array(
            [node(e + (a > 0), int(b > 0), int(c > 0)) for a, b, c in _CORNERS.tolist()]
        )
        element, volume = _hexahedron(block, x[nodes])
        _assemble(stiffness, element, nodes)
        mass[nodes] += block.density * volume / 8
        share[nodes] += 0.25 / count
    on_plane = x[:, 1] == 0.0
    bottom = np.flatnonzero(on_plane)
    return Mesh(
        x, stiffness, mass, bottom, block.area * share[bottom], np.where(on_plane, 0.0, share)
    )
