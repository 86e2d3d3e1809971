"""Condensation of the refined block: SciPy's SuperLU with n_s right-hand sides beside `mceip block --scale`.

    python3 -m venv venv && venv/bin/pip install numpy scipy
    cargo build --release
    venv/bin/python benches/condense_scipy.py target/release/mceip 320x160

The mesh (crossed P1 triangles, plane stress, top glued) is assembled here anew, in numpy; SuperLU with minimum
degree in symmetric mode factors K_ff and solves for the n_s columns K_fT. Then the program condenses the same
mesh in the same run. Printed: seconds, peak resident memory of each process, and the largest difference of
A, B (relative to the largest entry) and of the all-slip mu (largest real 1/mu of A^-1 (-B) with x > 0).
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


def assemble(nx, ny):
    """K over the dofs below the glued top and the contact nodes, left to right."""
    import numpy as np
    import scipy.sparse as sp

    young, nu, thickness, length, height = 5.0, 12 / 25, 9.6, 80.0, 40.0  # MPa, mm
    corners = np.arange((nx + 1) * (ny + 1)).reshape(nx + 1, ny + 1)
    centres = (nx + 1) * (ny + 1) + np.arange(nx * ny).reshape(nx, ny)
    hx, hy = length / nx, height / ny
    xy = np.zeros(((nx + 1) * (ny + 1) + nx * ny, 2))
    i, j = np.meshgrid(np.arange(nx + 1), np.arange(ny + 1), indexing="ij")
    xy[corners.ravel()] = np.column_stack([i.ravel() * hx, j.ravel() * hy])
    i, j = np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij")
    xy[centres.ravel()] = np.column_stack([(i.ravel() + 0.5) * hx, (j.ravel() + 0.5) * hy])
    a, b, c, d = (m.ravel() for m in (corners[:-1, :-1], corners[1:, :-1], corners[1:, 1:], corners[:-1, 1:]))
    m = centres.ravel()
    triangles = np.concatenate([np.column_stack(t) for t in ((a, b, m), (b, c, m), (c, d, m), (d, a, m))])
    p = xy[triangles]
    x, y = p[:, :, 0], p[:, :, 1]
    gx = np.column_stack([y[:, 1] - y[:, 2], y[:, 2] - y[:, 0], y[:, 0] - y[:, 1]])
    gy = np.column_stack([x[:, 2] - x[:, 1], x[:, 0] - x[:, 2], x[:, 1] - x[:, 0]])
    twice = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])
    strain = np.zeros((len(triangles), 3, 6))
    strain[:, 0, 0::2], strain[:, 1, 1::2], strain[:, 2, 0::2], strain[:, 2, 1::2] = gx, gy, gy, gx
    elasticity = young / (1 - nu**2) * np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]])
    ke = np.einsum("eki,kl,elj->eij", strain, elasticity, strain) * (thickness / 2 / twice)[:, None, None]
    dofs = np.stack([2 * triangles, 2 * triangles + 1], axis=2).reshape(len(triangles), 6)
    rows, cols = np.repeat(dofs, 6, axis=1).ravel(), np.tile(dofs, (1, 6)).ravel()
    k = sp.csc_matrix((ke.ravel(), (rows, cols)), shape=(2 * len(xy),) * 2)
    below = np.flatnonzero(np.repeat(xy[:, 1] < height - hy / 4, 2))
    place = np.full(2 * len(xy), -1)
    place[below] = np.arange(len(below))
    return k[below][:, below], place[2 * corners[:, 0]] // 2


def condense(nx, ny, send):
    """In a process of its own, so that its peak memory is its own; one thread: SuperLU's small BLAS calls
    are slower by far on several."""
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[name] = "1"
    import numpy as np
    import scipy.sparse.linalg as sla

    clock = time.perf_counter()
    k, contact = assemble(nx, ny)
    assembled = time.perf_counter()
    slip = contact[: 17 * nx // 20]
    t, n = 2 * slip, 2 * slip + 1
    free = np.setdiff1d(np.arange(k.shape[0]), np.concatenate([t, n]))
    k_ff, k_ft, k_tt = k[free][:, free].tocsc(), k[free][:, t].tocsc(), k[t][:, t].toarray()
    k_nf, k_nt = k[n][:, free].tocsr(), k[n][:, t].toarray()
    ready = time.perf_counter()
    lu = sla.splu(k_ff, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    factored = time.perf_counter()
    w = lu.solve(k_ft.toarray())
    a = k_tt - k_ft.T @ w
    b = -(k_nt - k_nf @ w)  # the y dof points away from the obstacle
    solved = time.perf_counter()
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    values, vectors = np.linalg.eig(np.linalg.solve(a, -b))
    mu = [
        float(1 / v.real)
        for v, x in zip(values, vectors.T)
        if abs(v.imag) < 1e-12 and v.real > 1e-12 and (x.real * np.sign(x.real.sum()) > 0).all()
    ]
    send.send((k.shape[0], a, b, mu, [assembled - clock, factored - ready, solved - factored], memory))


def exact(entries, n):
    import numpy as np

    out = np.zeros((n, n))
    for i, j, v in entries:
        out[i, j] = float(Fraction(v))
    return out


def main():
    import numpy as np

    program, scale = Path(sys.argv[1]).resolve(), sys.argv[2]
    nx, ny = (int(v) for v in scale.split("x"))
    receive, send = multiprocessing.Pipe(False)
    process = multiprocessing.get_context("spawn").Process(target=condense, args=(nx, ny, send))
    process.start()
    send.close()
    dofs, a, b, mu, seconds, memory = receive.recv()
    process.join()
    print(f"{dofs} dofs, n_s = {len(a)}")
    print(f"scipy  assembly {seconds[0]:.2f} s, factor {seconds[1]:.2f} s, {len(a)} solves and products {seconds[2]:.2f} s, peak {memory / 1024:.0f} MiB")
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "block", "--scale", scale, "--json", "--write", folder]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as child:
            out = child.stdout.read()
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode:
            sys.exit(f"{command[0]}: exit code {child.returncode}")
        ours = json.loads(out)["scale"][0]
        pencil = json.loads((Path(folder) / f"block-{scale}.json").read_text())["pencil"]
    s = ours["seconds"]
    print(f"mceip  assembly {s['assembly']:.2f} s, ordering {s['ordering']:.2f} s, factor with Schur complement {s['factor']:.2f} s, peak {usage.ru_maxrss / 1024:.0f} MiB")
    for name, theirs in (("a", a), ("b", b)):
        mine = exact(pencil[name]["entries"], len(a))
        print(f"{name.upper()}: largest difference {abs(mine - theirs).max() / abs(theirs).max():.1e} of the largest entry")
    found = [v["mu"] for v in ours["all_slip"]]
    print(f"mu: scipy {mu}, mceip {found}, relative difference {[abs(p - q) / q for p, q in zip(found, mu)]}")
    print(f"speed: {(seconds[1] + seconds[2]) / (s['ordering'] + s['factor']):.2f} times SuperLU's factor and solves")
    same = np.allclose(found, mu, rtol=1e-9) and len(found) == len(mu)
    sys.exit(0 if same else 1)


if __name__ == "__main__":
    main()
