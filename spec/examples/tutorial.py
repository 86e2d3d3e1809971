"""A rubber block slides on a table: K, M and contact states for mceip, with scikit-fem.

Usage: python tutorial.py FOLDER [CELLS_X CELLS_Y MU]

Writes K.mtx, M.mtx, contacts.csv and nodes.csv into FOLDER. Units: N, mm, t, s.
The block (80 mm x 40 mm, 1 mm thick, plane stress) is glued to a plate at its upper side; the plate has been
pressed down by 1 mm and moved to the left until every node in contact slips.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.io import mmwrite
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve
from skfem import Basis, BilinearForm, ElementTriP1, ElementVector, MeshTri
from skfem.helpers import dot
from skfem.models.elasticity import lame_parameters, linear_elasticity

folder = Path(sys.argv[1])
cells_x, cells_y = (int(a) for a in sys.argv[2:4]) if len(sys.argv) > 3 else (4, 2)
mu = float(sys.argv[4]) if len(sys.argv) > 4 else 1.5
young, poisson, density, depth = 5.0, 0.48, 1.2e-9, 1.0  # N/mm^2, -, t/mm^3, mm

mesh = MeshTri.init_tensor(np.linspace(0, 80, cells_x + 1), np.linspace(0, 40, cells_y + 1))
basis = Basis(mesh, ElementVector(ElementTriP1()))
lam, shear = lame_parameters(young, poisson)
lam = 2 * lam * shear / (lam + 2 * shear)  # plane stress
K = linear_elasticity(lam, shear).assemble(basis)
M = BilinearForm(lambda u, v, w: density * dot(u, v)).assemble(basis)

# Degrees of freedom: the upper side is prescribed and leaves the model, all others stay.
x, y = mesh.p
glued = basis.nodal_dofs[:, y == 40].ravel()
kept = np.setdiff1d(np.arange(K.shape[0]), glued)
place = np.full(K.shape[0], -1)
place[kept] = np.arange(len(kept))
nodes = np.flatnonzero(y == 0)
nodes = nodes[np.argsort(x[nodes])]
tangential, normal = basis.nodal_dofs[0, nodes], basis.nodal_dofs[1, nodes]


def equilibrium(contact):
    """Sliding to the left: u_y = 0 and r_x = mu r_y on the contact nodes (r_y > 0 pushes the block up)."""
    u = np.zeros(K.shape[0])
    u[basis.nodal_dofs[1, y == 40]] = -depth
    t, n = tangential[contact], normal[contact]
    unknown = np.setdiff1d(kept, n)
    rows = K.tocsr().copy()
    rows = rows - mu * coo_matrix((np.ones(len(t)), (t, n)), K.shape) @ rows  # rows t: r_x - mu r_y
    rows = rows.tocsr()
    u[unknown] = spsolve(rows[unknown][:, unknown], -(rows @ u)[unknown])
    return u, K @ u


contact = np.ones(len(nodes), bool)
while True:
    u, r = equilibrium(contact)
    wanted = np.where(contact, r[normal] > 0, u[normal] < 0)  # pushed stays, penetrating comes back
    if (wanted == contact).all():
        break
    contact = wanted

folder.mkdir(parents=True, exist_ok=True)
for name, matrix in (("K", K), ("M", M)):
    symmetric = matrix.tocsr()[kept][:, kept]
    mmwrite(folder / f"{name}.mtx", (symmetric + symmetric.T) / 2, symmetry="symmetric", precision=17)
with open(folder / "contacts.csv", "w") as out:
    print("particle,tangential,normal,normal_direction,state,reaction_tangential,reaction_normal", file=out)
    for k, (t, n) in enumerate(zip(tangential, normal)):
        state, r_t, r_n = ("slip-", r[t], r[n]) if contact[k] else ("free", 0.0, 0.0)
        print(f"node {k},{place[t]},{place[n]},-1,{state},{r_t:.17g},{r_n:.17g}", file=out)
with open(folder / "nodes.csv", "w") as out:
    print("node,x,y,dof_x,dof_y,edges_to", file=out)
    for k, dofs in enumerate(basis.nodal_dofs.T):
        names = ",".join(str(place[dof]) if place[dof] >= 0 else "" for dof in dofs)
        ends = " ".join(str(b) for a, b in mesh.facets.T if a == k)
        print(f"{k},{x[k]},{y[k]},{names},{ends}", file=out)
print(f"{len(kept)} degrees of freedom, {contact.sum()} of {len(nodes)} nodes slide, mu = {mu}")
