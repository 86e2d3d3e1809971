"""A rubber block on a table: from scikit-fem to the certified critical friction.

Run: pip install scikit-fem; python block.py. Writes block.svg. Units: N, mm, t, s.
The block (80 mm x 40 mm, 1 mm thick, plane strain) is glued to a plate at its upper side; all nodes
of its lower side are about to slip to the left.
"""

import numpy as np
import skfem
from skfem.helpers import dot
from skfem.models.elasticity import lame_parameters, linear_elasticity

import mceip

# What users of scikit-fem have: K and M.
mesh = skfem.MeshTri.init_tensor(np.linspace(0, 80, 5), np.linspace(0, 40, 3))
basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTriP1()))
K = linear_elasticity(*lame_parameters(5.0, 0.4)).assemble(basis)
M = skfem.BilinearForm(lambda u, v, w: 1.2e-9 * dot(u, v)).assemble(basis)

# 1-2. The glued side leaves the model; the table names rows of what stays.
kept = basis.complement_dofs(basis.get_dofs(lambda x: x[1] == 40))
K, M = ((A + A.T)[kept][:, kept] / 2 for A in (K, M))  # symmetric to the last bit

# 3-5. Contact states as a table; a column of one value is the same in each row.
bottom = np.flatnonzero(mesh.p[1] == 0)
tangential, normal = np.searchsorted(kept, basis.nodal_dofs[:, bottom])
table = {"tangential": tangential, "normal": normal, "normal_direction": -1, "state": "slip-"}

# 6-8. The critical friction, with proofs. No reactions: that all slip to the left is assumed.
problem = mceip.Problem.from_matrices(K, M, "3", table, accept_warnings=True)
answer = problem.analyze(progress=True)
print(answer, answer.critical_friction, sep="\n")

# 9-11. The mode at friction 3.
u, mode = np.zeros(basis.N), answer.modes[0]
u[kept] = mode.v
mceip.draw_mode(
    mesh.p.T, mesh.t.T, u[basis.nodal_dofs].T, contacts=bottom, slipping=mode.slipping,
    title=f"lambda = {mode.growth_rate:.1f} 1/s at mu = 3",
).save("block.svg")  # a notebook shows it without `save`
