"""Bodies on a table, and what a user of scipy would compute of them.

All contacts are about to slip to the left. v is a displacement rate, w = (K + lambda^2 M) v the
reaction rate; x to the right, y up. On each contact, with x_i = -v_T and y_i = -(w_T - mu w_N),

    v_N = 0,   0 <= x_i  _|_  y_i >= 0
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np
import scipy.linalg
import scipy.sparse

import mceip


@dataclass(frozen=True)
class Body:
    """K and M over the degrees of freedom, and those of the contacts, left to right."""

    stiffness: scipy.sparse.csr_array
    mass: scipy.sparse.csr_array
    tangential: list[int]
    normal: list[int]

    def problem(self, friction):
        contacts = [
            mceip.Contact(t, n, "slip-", normal_direction=-1)
            for t, n in zip(self.tangential, self.normal)
        ]
        return mceip.Problem.from_matrices(self.stiffness, self.mass, friction, contacts)

    def slip_pencil(self, friction, slipping):
        """K and M over the free degrees of freedom and v_T of these contacts.

        The rows of v_T say w_T = mu w_N.
        """
        contact = set(self.tangential) | set(self.normal)
        free = [dof for dof in range(self.stiffness.shape[0]) if dof not in contact]
        columns = free + [self.tangential[i] for i in slipping]
        normal = [self.normal[i] for i in slipping]

        parts = []
        for matrix in (self.stiffness, self.mass):
            rows = matrix[columns].toarray()
            first_contact = len(free)
            rows[first_contact:] -= friction * matrix[normal].toarray()
            parts.append(rows[:, columns])
        return columns, *parts

    def solutions_by_trial(self, friction):
        """(lambda^2, contacts that slip) by eigenvalues for every choice of contacts."""
        dofs = self.stiffness.shape[0]
        solutions = []
        for count in range(1, len(self.tangential) + 1):
            for slipping in combinations(range(len(self.tangential)), count):
                columns, k, m = self.slip_pencil(friction, slipping)
                values, vectors = scipy.linalg.eig(-k, m)
                for value, vector in zip(values, vectors.T):
                    if abs(value.imag) > 1e-9 or value.real < 0:
                        continue

                    v = np.zeros(dofs)
                    v[columns] = vector.real
                    v /= -sum(v[self.tangential[i]] for i in slipping)
                    w = self.stiffness @ v + value.real * (self.mass @ v)

                    x = -v[self.tangential]
                    y = -(w[self.tangential] - friction * w[self.normal])
                    if all(x[list(slipping)] > 1e-9) and all(y > -1e-9):
                        solutions.append((value.real, list(slipping)))
        return sorted(solutions)


def lattice(length, height):
    """A lattice of `length` x `height` nodes with springs along sides and diagonals."""
    nodes = {}
    for row in range(height - 1):  # the uppermost row is glued
        for column in range(length):
            nodes[column, row] = len(nodes)

    rows, columns, values = [], [], []
    for (column, row), node in nodes.items():
        for step in ((1, 0), (0, 1), (1, 1), (-1, 1), (-1, 0), (0, -1), (-1, -1), (1, -1)):
            other_place = (column + step[0], row + step[1])
            is_on_body = 0 <= other_place[0] < length and 0 <= other_place[1] < height
            if not is_on_body:
                continue

            direction = np.array(step) / np.hypot(*step)
            spring = np.outer(direction, direction)
            other = nodes.get(other_place)
            for i in range(2):
                for j in range(2):
                    rows.append(2 * node + i)
                    columns.append(2 * node + j)
                    values.append(spring[i, j])
                    if other is not None:
                        rows.append(2 * node + i)
                        columns.append(2 * other + j)
                        values.append(-spring[i, j])

    order = 2 * len(nodes)
    stiffness = scipy.sparse.csr_array((values, (rows, columns)), shape=(order, order))
    stiffness = (stiffness + stiffness.T) / 2  # floats add up differently on both sides
    tangential = [2 * nodes[column, 0] for column in range(length)]
    normal = [dof + 1 for dof in tangential]
    return Body(stiffness, scipy.sparse.eye_array(order, format="csr"), tangential, normal)


def random_body(seed):
    """Three contacts and two more degrees of freedom; entries are short binary fractions."""
    rng = np.random.default_rng(seed)
    factor = rng.integers(-8, 9, (8, 8)) / 8
    stiffness = scipy.sparse.csr_array(factor @ factor.T + np.eye(8) / 4)
    mass = scipy.sparse.csr_array(np.diag(rng.integers(1, 5, 8).astype(float)))
    return Body(stiffness, mass, tangential=[0, 2, 4], normal=[1, 3, 5])
