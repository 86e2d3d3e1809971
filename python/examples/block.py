"""A rubber block on a table, from scikit-fem to the certified critical friction.

Run: pip install scikit-fem; python block.py. Writes block.svg. Units: N, mm, t, s.
The block (80 mm x 40 mm, 1 mm thick, plane strain) is glued to a plate at its upper side; all nodes
of its lower side are about to slip to the left.
"""

import numpy as np
import skfem
from skfem.helpers import dot
from skfem.models.elasticity import lame_parameters, linear_elasticity

import mceip

# 1-4. K and M of scikit-fem without the glued side, symmetric to the last bit.
mesh = skfem.MeshTri.init_tensor(np.linspace(0, 80, 5), np.linspace(0, 40, 3))
basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTriP1()))
forms = linear_elasticity(*lame_parameters(5.0, 0.4)), skfem.BilinearForm(lambda u, v, w: 1.2e-9 * dot(u, v))
free = basis.complement_dofs(basis.get_dofs(lambda x: x[1] == 40))
K, M = ((A + A.T) / 2 for A in (form.assemble(basis)[free][:, free] for form in forms))

# 5-7. Contact states as a table: degrees of freedom of the nodes on the table.
bottom = np.flatnonzero(mesh.p[1] == 0)
tangential, normal = np.searchsorted(free, basis.nodal_dofs[:, bottom])
table = {"tangential": tangential, "normal": normal, "normal_direction": -1, "state": "slip-"}

# 8. The critical friction, with proofs.
answer = mceip.Problem.from_matrices(K, M, "3", table).analyze(samples=0, progress=True)
print(answer, answer.critical_friction, sep="\n")

# 9-10. The mode at friction 3.
u = np.zeros(basis.N)
u[free] = answer.modes[0].v
mceip.draw_mode(mesh.p.T, mesh.t.T, u[basis.nodal_dofs].T, contacts=bottom,
                slipping=answer.modes[0].slipping, title="mode").save("block.svg")
