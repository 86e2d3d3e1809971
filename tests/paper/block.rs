//! The mesh of the polyurethane block.
//!
//! The truth is the printed 60.81: the eight combinations of mesh and plane are condensed in
//! doubles, by code of this file alone, and one of them gives that number. Both published states
//! are found, certified and accepted in `tests/campaign/verify.rs`.
#![cfg(feature = "testkit")]

use mceip_mcp::linear::solve;
use mceip_model::ContactState;
use mceip_paper::{BlockModel, DoubleBlock, MeshKind, Plane, PublishedState};
use nalgebra::DMatrix;

type Matrix = Vec<Vec<f64>>;

/// A and B of (A + mu B) x = y in doubles.
struct DoublePencil {
    a: Matrix,
    b: Matrix,
}

/// The condensed MCEIP-mu pencil for slip to the left.
///
/// With S = 1 the signs of (16) cancel in A, and B takes the one of the normal (y points away from
/// the obstacle).
fn condensed(block: &DoubleBlock, states: &[ContactState]) -> DoublePencil {
    let n = block.stiffness.order;
    let mut k = vec![vec![0.0; n]; n];

    for &(i, j, value) in &block.stiffness.entries {
        k[i][j] = value;
    }

    let mut touching = Vec::new();
    let mut slip = Vec::new();

    for (&node, state) in block.contact.iter().zip(states) {
        if *state != ContactState::Free {
            touching.push(node);
        }

        if matches!(state, ContactState::Slip { .. }) {
            slip.push(node);
        }
    }

    let free: Vec<usize> = (0..n)
        .filter(|dof| !touching.contains(&(dof / 2)))
        .collect();

    // What the free degrees of freedom do when one slip node moves by 1 along the obstacle.
    let k_ff = submatrix(&k, &free, &free);
    let mut columns = Vec::new();

    for &node in &slip {
        columns.push(column(&k, &free, 2 * node));
    }

    let responses = solve(&k_ff, &columns).unwrap();

    let mut pencil = DoublePencil {
        a: Vec::new(),
        b: Vec::new(),
    };

    for &row_node in &slip {
        let mut tangential = Vec::new();
        let mut normal = Vec::new();

        for (q, &node) in slip.iter().enumerate() {
            let column = 2 * node;
            let response = &responses[q];
            tangential.push(schur_entry(&k, 2 * row_node, column, &free, response));
            normal.push(-schur_entry(&k, 2 * row_node + 1, column, &free, response));
        }

        pencil.a.push(tangential);
        pencil.b.push(normal);
    }
    pencil
}

/// K[row][column] - K[row][free] K_ff^-1 K[free][column], the product with the inverse given.
fn schur_entry(k: &Matrix, row: usize, column: usize, free: &[usize], response: &[f64]) -> f64 {
    let mut carried = 0.0;
    for (&i, moved) in free.iter().zip(response) {
        carried += k[row][i] * moved;
    }
    k[row][column] - carried
}

fn column(m: &Matrix, rows: &[usize], column: usize) -> Vec<f64> {
    rows.iter().map(|&i| m[i][column]).collect()
}

fn submatrix(m: &Matrix, rows: &[usize], columns: &[usize]) -> Matrix {
    let mut part = Vec::new();
    for &i in rows {
        part.push(columns.iter().map(|&j| m[i][j]).collect());
    }
    part
}

/// mu > 0 of the positive modes on a support: (A + mu B) x = 0 is -A^-1 B x = x / mu, and a
/// positive x belongs to the largest real 1 / mu as a rule.
fn positive_modes(pencil: &DoublePencil, support: &[usize]) -> Vec<f64> {
    let n = support.len();
    let a = submatrix(&pencil.a, support, support);
    let b = submatrix(&pencil.b, support, support);

    let mut negative_columns = Vec::new();
    for j in 0..n {
        negative_columns.push((0..n).map(|i| -b[i][j]).collect());
    }

    let columns = solve(&a, &negative_columns).unwrap();
    let matrix = DMatrix::from_fn(n, n, |i, j| columns[j][i]);

    let mut found = Vec::new();
    for theta in matrix.complex_eigenvalues().iter() {
        let is_positive = theta.im == 0.0 && theta.re > 0.0;
        if is_positive && has_a_positive_eigenvector(&matrix, theta.re) {
            found.push(1.0 / theta.re);
        }
    }
    found
}

/// Inverse iteration from (1, ..., 1), with a shift a little off the eigenvalue.
fn has_a_positive_eigenvector(matrix: &DMatrix<f64>, eigenvalue: f64) -> bool {
    let n = matrix.nrows();
    let shift = eigenvalue * (1.0 + 1e-9);
    let mut shifted = vec![vec![0.0; n]; n];

    for i in 0..n {
        for j in 0..n {
            shifted[i][j] = matrix[(i, j)];
        }
        shifted[i][i] -= shift;
    }

    let mut x = vec![1.0; n];
    for _ in 0..4 {
        x = solve(&shifted, &[x]).unwrap().remove(0);

        let mut largest: f64 = 0.0;
        for value in &x {
            if value.abs() > largest.abs() {
                largest = *value;
            }
        }

        for value in &mut x {
            *value /= largest;
        }
    }
    x.iter().all(|value| *value > 0.0)
}

/// Which mesh the paper used, by elimination: of four triangulations into 800 elements with 21
/// contact nodes, in plane stress and plane strain, one gives 60.81 (the fourth node stuck).
#[test]
fn only_the_crossed_mesh_in_plane_stress_gives_the_printed_60_81() {
    let mut matches = Vec::new();

    for mesh in MeshKind::ALL {
        for plane in Plane::ALL {
            let rows = if mesh == MeshKind::Crossed { 10 } else { 20 };
            let model = BlockModel {
                mesh,
                plane,
                ..BlockModel::of_the_paper().with_cells(20, rows)
            };
            let block = DoubleBlock::new(&model).unwrap();

            // Two stuck nodes come before the slip nodes, so the fourth node is slip node 1.
            let fifteen = condensed(&block, &PublishedState::FifteenSlip.states());
            let support: Vec<usize> = (0..15).filter(|&i| i != 1).collect();
            let modes = positive_modes(&fifteen, &support);

            if !modes.iter().any(|mu| format!("{mu:.2}") == "60.81") {
                continue;
            }

            let seventeen = condensed(&block, &PublishedState::SeventeenSlip.states());
            let all_slip: Vec<usize> = (0..17).collect();
            matches.push((mesh, plane, positive_modes(&seventeen, &all_slip)));
        }
    }

    assert_eq!(matches.len(), 1, "{matches:?}");

    let (mesh, plane, all_slip) = &matches[0];
    assert_eq!(*mesh, MeshKind::Crossed);
    assert_eq!(*plane, Plane::Stress);
    assert_eq!(all_slip.len(), 1, "{all_slip:?}");
    assert!(
        (all_slip[0] - 1.7048043).abs() < 1e-6,
        "the certified value: {all_slip:?}"
    );
}
