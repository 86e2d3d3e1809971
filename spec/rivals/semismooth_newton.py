#!/usr/bin/env python3
"""A rival for `mceip conform`: semismooth Newton on the Fischer-Burmeister function, with numpy.

    mceip conform --as-pencil --lines --except eigenvalue -- python3 spec/rivals/semismooth_newton.py

phi(a, b) = sqrt(a^2 + b^2) - a - b vanishes exactly where a, b >= 0 and ab = 0. The equations are
F_f = 0 and phi(z_i, F_i) = 0; a step solves with an element of their generalised Jacobian (De Luca,
Facchinei and Kanzow 1996) and is halved until the merit |Phi|^2 / 2 has decreased (Armijo). Where
the Newton direction does not descend, the gradient is followed.
"""
import numpy as np
from eigenproblem import run

TOLERANCE = 1e-10  # of the largest |Phi_i|
STEPS = 50
HALVINGS = 12
DECREASE = 1e-4


def fischer(problem, z):
    """Phi(z), and an element of its generalised Jacobian."""
    f, jacobian = problem.function(z), problem.jacobian(z)
    bounded = np.arange(problem.size) >= problem.equations
    norm = np.hypot(z, f)

    # At z_i = F_i = 0 the direction (1, 1) / sqrt(2) stands for (z_i, F_i) / norm.
    at_zero = norm == 0
    by_z = np.where(at_zero, np.sqrt(0.5), z / np.where(at_zero, 1, norm)) - 1
    by_f = np.where(at_zero, np.sqrt(0.5), f / np.where(at_zero, 1, norm)) - 1

    phi = np.where(bounded, norm - z - f, f)
    weight_z, weight_f = np.where(bounded, by_z, 0), np.where(bounded, by_f, 1)
    return phi, np.diag(weight_z) + weight_f[:, None] * jacobian


def solve(problem, z):
    """A zero of Phi to the tolerance, or None."""
    phi, element = fischer(problem, z)
    for _ in range(STEPS):
        if np.abs(phi).max() <= TOLERANCE:
            return z
        gradient = element.T @ phi
        try:
            step = np.linalg.solve(element, -phi)
        except np.linalg.LinAlgError:
            step = -gradient
        if not gradient @ step < -1e-12 * (step @ step):
            step = -gradient

        length = 1.0
        for _ in range(HALVINGS):
            next_phi, next_element = fischer(problem, z + length * step)
            if next_phi @ next_phi <= phi @ phi + 2 * DECREASE * length * (gradient @ step):
                break
            length /= 2
        else:
            return None
        z, phi, element = z + length * step, next_phi, next_element
    return None


if __name__ == "__main__":
    run(solve)
