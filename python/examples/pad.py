"""A brake pad under pressure and drag: from scikit-fem to contact states, and to what they mean.

Run: pip install scikit-fem; python pad.py. Units: N, mm, t, s.
The pad (40 mm x 10 mm, 1 mm thick, plane strain) lies on a disc. Its back plate is pressed down by
0.05 mm, and then the disc drags: the plate is moved by 0.1 mm to the left.
"""

import numpy as np
import skfem
from skfem.helpers import dot
from skfem.models.elasticity import lame_parameters, linear_elasticity

import mceip

# What users of scikit-fem have: K and M, and the sides of their model.
mesh = skfem.MeshTri.init_tensor(np.linspace(0, 40, 9), np.linspace(0, 10, 3))
basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTriP1()))
K = linear_elasticity(*lame_parameters(1000.0, 0.25)).assemble(basis)
M = skfem.BilinearForm(lambda u, v, w: 2.5e-9 * dot(u, v)).assemble(basis)
K, M = ((A + A.T) / 2 for A in (K, M))  # symmetric to the last bit
lower, plate = (basis.nodal_dofs[:, np.flatnonzero(mesh.p[1] == y)] for y in (0, 10))

# 1-3. Whatever may touch the disc; normals of the mesh point away from it. With the mesh, wrong
# directions are warned of.
contacts = [mceip.Candidate(int(t), int(n), normal_direction=-1) for t, n in lower.T]
nodes = mceip.Mesh(mesh.p.T, basis.nodal_dofs.T, mesh.t.T)
pad = mceip.Body(K, M, candidates=contacts, mesh=nodes)

# 4-6. The plate is pressed down, then moved.
press = mceip.Step("press", displacements={int(d): "-0.05" for d in plate[1]})
drag = mceip.Step("drag", displacements={int(d): "-0.1" for d in plate[0]})
path = pad.path([press, drag], friction="0.5", in_doubles=True)

# 7-10. Which points stick, slip and lift off, and whether the last state can diverge.
for stretch in path.stretches:
    print(stretch, stretch.reactions.sum(axis=0))
answer = path.stretches[-1].analyze(samples=0)
print(answer)
