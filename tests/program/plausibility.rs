//! What `mceip convert` shows of a model: the figures of a block, and the warnings of its spoilt
//! copies.
//!
//! The block is assembled in doubles. Its equilibrium is one under given reactions: u = K^-1 r, so
//! that K u is the reaction at every contact. Each spoilt copy has one fault.
#![cfg(feature = "cli")]

use crate::common::exits;
use crate::program::{Folder, refused};
use mceip_mcp::linear::SparseLu;
use mceip_paper::{BlockModel, DoubleBlock, DoubleMatrix};
use std::fmt::Write;

/// A block with its files: K.mtx, M.mtx, contacts.csv, u.txt.
struct Model {
    folder: Folder,
    block: DoubleBlock,
}

/// The lower triangle of a matrix as a Matrix Market file, its numbers with so many digits.
fn matrix_market(matrix: &DoubleMatrix, digits: usize) -> String {
    let lower: Vec<_> = matrix.entries.iter().filter(|(i, j, _)| j <= i).collect();

    let order = matrix.order;
    let mut text = String::from("%%MatrixMarket matrix coordinate real symmetric\n");
    writeln!(text, "{order} {order} {}", lower.len()).unwrap();
    for (row, column, value) in lower {
        let precision = digits - 1;
        writeln!(text, "{} {} {value:.precision$e}", row + 1, column + 1).unwrap();
    }

    text
}

/// Friction of the model.
const MU: f64 = 0.5;

/// The force that pushes each contact node off the obstacle, N.
const PRESSURE: f64 = 2.0;

impl Model {
    /// 8 x 4 cells; every contact node is about to slip to the left.
    fn new() -> Model {
        let block = DoubleBlock::new(&BlockModel::of_the_paper().with_cells(8, 4)).unwrap();
        let model = Model {
            folder: Folder::new(),
            block,
        };

        model
            .folder
            .write("K.mtx", &matrix_market(&model.block.stiffness, 17));
        model
            .folder
            .write("M.mtx", &matrix_market(&model.block.mass, 17));
        model
            .folder
            .write("contacts.csv", &model.contacts(0, PRESSURE));
        model.folder.write("u.txt", &model.displacements());
        model
    }

    /// The table of contacts, dofs counted from `first`.
    fn contacts(&self, first: usize, pressure: f64) -> String {
        let mut text = String::from(
            "tangential,normal,normal_direction,state,reaction_tangential,reaction_normal\n",
        );
        for node in &self.block.contact {
            let tangential = 2 * node + first;
            let normal = tangential + 1;
            let friction = MU * pressure;
            writeln!(text, "{tangential},{normal},-1,slip-,{friction},{pressure}").unwrap();
        }

        text
    }

    /// u = K^-1 r, a number a line.
    fn displacements(&self) -> String {
        let order = self.block.stiffness.order;
        let mut solution = vec![0.0; order];
        for node in &self.block.contact {
            solution[2 * node] = MU * PRESSURE;
            solution[2 * node + 1] = PRESSURE;
        }

        let factors = SparseLu::new(order, self.block.stiffness.entries.iter().copied()).unwrap();
        let mut columns = [solution];
        factors.solve(&mut columns);

        let lines: Vec<String> = columns[0].iter().map(|u| format!("{u:e}\n")).collect();
        lines.concat()
    }

    /// What a conversion of these files prints.
    #[track_caller]
    fn convert(&self, [stiffness, mass, contacts]: [&str; 3], displacements: &str) -> String {
        let args = self.args([stiffness, mass, contacts], displacements);
        let args: Vec<&str> = args.iter().map(String::as_str).collect();
        exits(0, &args)
    }

    fn args(&self, [stiffness, mass, contacts]: [&str; 3], displacements: &str) -> Vec<String> {
        let mut args = vec!["convert".to_owned(), "--friction".into(), MU.to_string()];
        for (option, file) in [
            ("--stiffness", stiffness),
            ("--mass", mass),
            ("--contacts", contacts),
            ("--displacements", displacements),
            ("--out", "out.json"),
        ] {
            if !file.is_empty() {
                args.extend([option.to_owned(), self.folder.path(file)]);
            }
        }

        args
    }
}

const FILES: [&str; 3] = ["K.mtx", "M.mtx", "contacts.csv"];

#[track_caller]
fn warns_only_of(text: &str, words: &str) {
    let warnings: Vec<&str> = text.lines().filter(|l| l.starts_with("WARNING")).collect();
    let [warning] = warnings[..] else {
        panic!("expected one warning, got {warnings:#?} in\n{text}");
    };
    assert!(warning.contains(words), "expected {words:?}, got {warning}");
}

#[test]
fn a_sound_model_has_figures_and_no_warning() {
    let model = Model::new();

    let text = model.convert(FILES, "u.txt");

    for figure in [
        "    K: diagonal ",
        "    rows of K: sum to zero to ",
        "    M: diagonal ",
        "    lowest frequencies: ",
        "    reactions, slip: |r_T| is mu |r_N|, but for at most 0e0 of it",
        "    reactions against K u: differ by ",
    ] {
        assert!(text.contains(figure), "{figure:?} in\n{text}");
    }
    assert!(!text.contains("WARNING"), "{text}");

    let without_displacements = model.convert(FILES, "");
    assert!(
        !without_displacements.contains("K u"),
        "{without_displacements}"
    );
    assert!(
        !without_displacements.contains("WARNING"),
        "{without_displacements}"
    );
}

/// The sum of M is the mass in both directions: area 80 mm x 40 mm, with the nodes of the glued
/// side taken away.
#[test]
fn the_lowest_frequency_and_the_mass_are_those_of_the_block() {
    let model = Model::new();

    let text = model.convert(FILES, "");
    let figure = |name: &str, before: &str| -> f64 {
        let (_, rest) = text.split_once(name).unwrap();
        let (_, number) = rest.split_once(before).unwrap();
        let end = number.find([',', '\n']).unwrap();
        number[..end].parse().unwrap()
    };

    let sum: f64 = model.block.mass.entries.iter().map(|(_, _, m)| m).sum();
    assert!(
        (figure("M: ", "sum of all entries ") / sum - 1.0).abs() < 1e-4,
        "{text}"
    );

    // Rayleigh's quotient of any field that vanishes at the contacts is no less than the square
    // of the lowest circular frequency. The field: all nodes in the middle rows move as one.
    let order = model.block.stiffness.order;
    let mut field = vec![1.0; order];
    for node in &model.block.contact {
        field[2 * node] = 0.0;
        field[2 * node + 1] = 0.0;
    }
    let form = |matrix: &DoubleMatrix| -> f64 {
        let terms = matrix
            .entries
            .iter()
            .map(|(i, j, value)| field[*i] * value * field[*j]);
        terms.sum()
    };
    let bound = (form(&model.block.stiffness) / form(&model.block.mass)).sqrt();

    let lowest = figure("lowest frequencies", ": ") * std::f64::consts::TAU;
    assert!(lowest <= bound && lowest > bound / 20.0, "{lowest} {bound}");
}

/// A cantilever of beams: the entries of K at rotations add up and those of M cancel; K and M are
/// in their places all the same. Four elements of length 100, the contact below the free end.
#[test]
fn rotations_are_not_taken_for_exchanged_files() {
    let length = 100.0_f64;
    let of_bending = [
        [12.0, 6.0 * length, -12.0, 6.0 * length],
        [
            6.0 * length,
            4.0 * length * length,
            -6.0 * length,
            2.0 * length * length,
        ],
        [-12.0, -6.0 * length, 12.0, -6.0 * length],
        [
            6.0 * length,
            2.0 * length * length,
            -6.0 * length,
            4.0 * length * length,
        ],
    ];
    let of_mass = [
        [156.0, 22.0 * length, 54.0, -13.0 * length],
        [
            22.0 * length,
            4.0 * length * length,
            13.0 * length,
            -3.0 * length * length,
        ],
        [54.0, 13.0 * length, 156.0, -22.0 * length],
        [
            -13.0 * length,
            -3.0 * length * length,
            -22.0 * length,
            4.0 * length * length,
        ],
    ];

    let folder = Folder::new();
    folder.write("K.mtx", &beam(&of_bending));
    folder.write("M.mtx", &beam(&of_mass));
    folder.write("contacts.csv", "tangential,normal,state\n7,6,slip-\n");

    let mut args = vec!["convert".to_owned(), "--friction".into(), "0.5".into()];
    for (option, file) in [
        ("--stiffness", "K.mtx"),
        ("--mass", "M.mtx"),
        ("--contacts", "contacts.csv"),
        ("--out", "out.json"),
    ] {
        args.extend([option.to_owned(), folder.path(file)]);
    }
    let args: Vec<&str> = args.iter().map(String::as_str).collect();

    let text = exits(0, &args);
    assert!(!text.contains("exchanged"), "{text}");
}

/// The matrix of four elements in a row, the first node held.
fn beam(element: &[[f64; 4]; 4]) -> String {
    let mut sums = vec![vec![0.0; 10]; 10];
    for first in [0, 2, 4, 6] {
        for (i, row) in element.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                sums[first + i][first + j] += value;
            }
        }
    }

    let mut entries = Vec::new();
    for (i, row) in sums[2..].iter().enumerate() {
        for (j, value) in row[2..].iter().enumerate() {
            entries.push((i, j, *value));
        }
    }
    matrix_market(&DoubleMatrix { order: 8, entries }, 17)
}

#[test]
fn exchanged_matrices_are_named() {
    let model = Model::new();
    let text = model.convert(["M.mtx", "K.mtx", "contacts.csv"], "");
    warns_only_of(&text, "exchanged");
}

#[test]
fn few_digits_are_named() {
    let model = Model::new();
    model
        .folder
        .write("short.mtx", &matrix_market(&model.block.stiffness, 4));

    let text = model.convert(["short.mtx", "M.mtx", "contacts.csv"], "");
    warns_only_of(&text, "few digits");
}

/// By the masses alone, and by the reactions where displacements are given.
#[test]
fn numbers_from_one_are_named() {
    let model = Model::new();
    model
        .folder
        .write("from-1.csv", &model.contacts(1, PRESSURE));

    let text = model.convert(["K.mtx", "M.mtx", "from-1.csv"], "");
    warns_only_of(&text, "different masses");

    let text = model.convert(["K.mtx", "M.mtx", "from-1.csv"], "u.txt");
    assert!(
        text.contains("WARNING: the reactions are those of K u where every number is one less")
    );
}

#[test]
fn reactions_of_another_step_are_named() {
    let model = Model::new();
    model
        .folder
        .write("later.csv", &model.contacts(0, 1.25 * PRESSURE));

    let text = model.convert(["K.mtx", "M.mtx", "later.csv"], "u.txt");
    warns_only_of(&text, "differ from K u by 2e-1 of the largest");
}

/// A node on its friction cone is about to slip, whatever its state in the table.
#[test]
fn sticking_on_the_friction_cone_is_named() {
    let model = Model::new();
    let slipping = model.contacts(0, PRESSURE);
    for (tangential, warns) in [(MU * PRESSURE, true), (0.99 * MU * PRESSURE, false)] {
        let reaction = format!("slip-,{},{PRESSURE}", MU * PRESSURE);
        let sticking = slipping.replacen(&reaction, &format!("stick,{tangential},{PRESSURE}"), 1);
        assert_ne!(sticking, slipping);
        // Strictly inside the cone, as (7) demands of a particle that sticks.
        let sticking = sticking.replacen("stick,1,", "stick,0.99999999,", 1);
        model.folder.write("stick.csv", &sticking);

        let text = model.convert(["K.mtx", "M.mtx", "stick.csv"], "");
        if warns {
            warns_only_of(&text, "particle 0 sticks with |r_T| = mu |r_N| up to 1e-3");
        } else {
            assert!(!text.contains("WARNING"), "{text}");
        }
    }
}

/// Displacements show a wrong state only beside reactions.
#[test]
fn displacements_without_reactions_are_named() {
    let model = Model::new();
    let mut table = String::from("tangential,normal,normal_direction,state\n");
    for node in &model.block.contact {
        writeln!(table, "{},{},-1,slip-", 2 * node, 2 * node + 1).unwrap();
    }
    model.folder.write("bare.csv", &table);

    let text = model.convert(["K.mtx", "M.mtx", "bare.csv"], "u.txt");
    warns_only_of(&text, "not compared with K u");
}

#[test]
fn displacements_of_another_body_are_refused() {
    let model = Model::new();
    let order = model.block.stiffness.order;
    model.folder.write("short.txt", "1 2 3\n");
    model.folder.write("word.txt", "1 two 3\n");
    model.folder.write("huge.txt", &"1e999\n".repeat(order));
    model.folder.write(
        "wide.mtx",
        "%%MatrixMarket matrix array real general\n1 2\n1\n2\n",
    );

    for (file, words) in [
        ("short.txt", ["short.txt", "got 3 numbers"]),
        ("word.txt", ["word.txt", "got \"two\""]),
        ("huge.txt", ["huge.txt", "got \"1e999\""]),
        ("wide.mtx", ["wide.mtx", "got a matrix with 2 columns"]),
    ] {
        let args = model.args(FILES, file);
        let args: Vec<&str> = args.iter().map(String::as_str).collect();
        refused(&args, &words);
    }
}
