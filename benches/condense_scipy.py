"""Condensation of the refined block: SciPy's SuperLU with n_s right-hand sides beside
`mceip block --scale`.

    python3 -m venv venv && venv/bin/pip install numpy scipy
    cargo build --release
    venv/bin/python benches/condense_scipy.py target/release/mceip 320x160

The mesh (crossed P1 triangles, plane stress, top glued) is assembled here anew, in numpy; SuperLU
with minimum degree in symmetric mode factors K_ff and solves for the n_s columns K_fT. Then the
program condenses the same mesh in the same run. Printed: seconds, peak resident memory of each
process, and the largest difference of A, B (relative to the largest entry) and of the all-slip mu
(largest real 1/mu of A^-1 (-B) with x > 0).
"""

import json
import multiprocessing
import os
import resource
import subprocess
import sys
import tempfile
import time
from fractions import Fraction
from pathlib import Path

# The paper's block: MPa, mm.
YOUNG = 5.0
POISSON = 12 / 25
THICKNESS = 9.6
LENGTH = 80.0
HEIGHT = 40.0


def mesh(nx, ny):
    """Points, triangles, and the points of the contact side, left to right."""
    import numpy as np

    corners = np.arange((nx + 1) * (ny + 1)).reshape(nx + 1, ny + 1)
    centres = (nx + 1) * (ny + 1) + np.arange(nx * ny).reshape(nx, ny)
    width = LENGTH / nx
    height = HEIGHT / ny

    points = np.zeros((corners.size + centres.size, 2))
    i, j = np.meshgrid(np.arange(nx + 1), np.arange(ny + 1), indexing="ij")
    points[corners.ravel()] = np.column_stack([i.ravel() * width, j.ravel() * height])
    i, j = np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij")
    points[centres.ravel()] = np.column_stack(
        [(i.ravel() + 0.5) * width, (j.ravel() + 0.5) * height]
    )

    # The corners of each cell counter-clockwise, and its centre.
    a = corners[:-1, :-1].ravel()
    b = corners[1:, :-1].ravel()
    c = corners[1:, 1:].ravel()
    d = corners[:-1, 1:].ravel()
    m = centres.ravel()
    sides = ((a, b, m), (b, c, m), (c, d, m), (d, a, m))
    triangles = np.concatenate([np.column_stack(side) for side in sides])
    return points, triangles, corners[:, 0]


def element_stiffness(points, triangles):
    """t A B'DB of every triangle, 6 x 6."""
    import numpy as np

    x = points[triangles][:, :, 0]
    y = points[triangles][:, :, 1]

    # 2A times the gradients of the shape functions, and 2A.
    gx = np.column_stack([y[:, 1] - y[:, 2], y[:, 2] - y[:, 0], y[:, 0] - y[:, 1]])
    gy = np.column_stack([x[:, 2] - x[:, 1], x[:, 0] - x[:, 2], x[:, 1] - x[:, 0]])
    first = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0])
    second = (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])
    twice_area = first - second

    strain = np.zeros((len(triangles), 3, 6))
    strain[:, 0, 0::2] = gx
    strain[:, 1, 1::2] = gy
    strain[:, 2, 0::2] = gy
    strain[:, 2, 1::2] = gx

    hooke = np.array([[1, POISSON, 0], [POISSON, 1, 0], [0, 0, (1 - POISSON) / 2]])
    elasticity = YOUNG / (1 - POISSON**2) * hooke
    work = np.einsum("eki,kl,elj->eij", strain, elasticity, strain)
    return work * (THICKNESS / 2 / twice_area)[:, None, None]


def assemble(nx, ny):
    """K over the dofs below the glued top, and the contact nodes, left to right."""
    import numpy as np
    import scipy.sparse as sp

    points, triangles, contact = mesh(nx, ny)
    elements = element_stiffness(points, triangles)

    order = 2 * len(points)
    dofs = np.stack([2 * triangles, 2 * triangles + 1], axis=2).reshape(len(triangles), 6)
    rows = np.repeat(dofs, 6, axis=1).ravel()
    columns = np.tile(dofs, (1, 6)).ravel()
    k = sp.csc_matrix((elements.ravel(), (rows, columns)), shape=(order, order))

    below_top = points[:, 1] < HEIGHT - HEIGHT / ny / 4
    kept = np.flatnonzero(np.repeat(below_top, 2))
    place = np.full(order, -1)
    place[kept] = np.arange(len(kept))
    return k[kept][:, kept], place[2 * contact] // 2


def condense(nx, ny, send):
    """In a process of its own, so that its peak memory is its own; one thread: SuperLU's small
    BLAS calls are slower by far on several."""
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[name] = "1"
    import numpy as np
    import scipy.sparse.linalg as sla

    clock = time.perf_counter()
    k, contact = assemble(nx, ny)
    assembled = time.perf_counter()

    # Tangential and normal dofs of the slip nodes; all others are free.
    slip = contact[: 17 * nx // 20]
    t = 2 * slip
    n = 2 * slip + 1
    free = np.setdiff1d(np.arange(k.shape[0]), np.concatenate([t, n]))
    k_ff = k[free][:, free].tocsc()
    k_ft = k[free][:, t].tocsc()
    k_tt = k[t][:, t].toarray()
    k_nf = k[n][:, free].tocsr()
    k_nt = k[n][:, t].toarray()

    ready = time.perf_counter()
    lu = sla.splu(
        k_ff,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    factored = time.perf_counter()
    w = lu.solve(k_ft.toarray())
    a = k_tt - k_ft.T @ w
    b = -(k_nt - k_nf @ w)  # the y dof points away from the obstacle
    solved = time.perf_counter()

    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    seconds = [assembled - clock, factored - ready, solved - factored]
    send.send((k.shape[0], a, b, all_slip_mu(a, b), seconds, memory))


def all_slip_mu(a, b):
    """The mu > 0 at which (A + mu B) x = 0 has a solution x > 0."""
    import numpy as np

    values, vectors = np.linalg.eig(np.linalg.solve(a, -b))
    mu = []
    for value, vector in zip(values, vectors.T):
        is_real = abs(value.imag) < 1e-12
        is_positive = value.real > 1e-12
        has_one_sign = (vector.real * np.sign(vector.real.sum()) > 0).all()
        if is_real and is_positive and has_one_sign:
            mu.append(float(1 / value.real))
    return mu


def run_mceip(program, scale):
    """The report of `mceip block --scale`, the pencil it wrote, and its peak memory in KiB."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "block", "--scale", scale, "--json", "--write", folder]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as child:
            out = child.stdout.read()
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode:
            sys.exit(f"{command[0]}: exit code {child.returncode}")

        report = json.loads(out)["scale"][0]
        problem = json.loads((Path(folder) / f"block-{scale}.json").read_text())
        return report, problem["pencil"], usage.ru_maxrss


def matrix(entries, n):
    """A matrix of doubles from entries (row, column, exact number)."""
    import numpy as np

    out = np.zeros((n, n))
    for i, j, value in entries:
        out[i, j] = float(Fraction(value))
    return out


def main():
    import numpy as np

    program = Path(sys.argv[1]).resolve()
    scale = sys.argv[2]
    nx, ny = (int(v) for v in scale.split("x"))

    receive, send = multiprocessing.Pipe(False)
    spawn = multiprocessing.get_context("spawn")
    process = spawn.Process(target=condense, args=(nx, ny, send))
    process.start()
    send.close()
    dofs, a, b, mu, seconds, memory = receive.recv()
    process.join()
    n_s = len(a)
    print(f"{dofs} dofs, n_s = {n_s}")
    print(
        f"scipy  assembly {seconds[0]:.2f} s, factor {seconds[1]:.2f} s, "
        f"{n_s} solves and products {seconds[2]:.2f} s, peak {memory / 1024:.0f} MiB"
    )

    ours, pencil, our_memory = run_mceip(program, scale)
    s = ours["seconds"]
    print(
        f"mceip  assembly {s['assembly']:.2f} s, ordering {s['ordering']:.2f} s, "
        f"factor with Schur complement {s['factor']:.2f} s, peak {our_memory / 1024:.0f} MiB"
    )

    for name, theirs in (("a", a), ("b", b)):
        mine = matrix(pencil[name]["entries"], n_s)
        difference = abs(mine - theirs).max() / abs(theirs).max()
        print(f"{name.upper()}: largest difference {difference:.1e} of the largest entry")

    found = [v["mu"] for v in ours["all_slip"]]
    differences = [abs(p - q) / q for p, q in zip(found, mu)]
    print(f"mu: scipy {mu}, mceip {found}, relative difference {differences}")
    ratio = (seconds[1] + seconds[2]) / (s["ordering"] + s["factor"])
    print(f"speed: {ratio:.2f} times SuperLU's factor and solves")

    same = np.allclose(found, mu, rtol=1e-9) and len(found) == len(mu)
    sys.exit(0 if same else 1)


if __name__ == "__main__":
    main()
