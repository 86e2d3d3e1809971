//! What `mceip convert` shows of a model: the figures of a block, and the warnings of its spoilt
//! copies.
//!
//! The block is assembled in doubles. Its equilibrium is one under given reactions: u = K^-1 r, so
//! that K u is the reaction at every contact. Each spoilt copy has one fault.
#![cfg(feature = "cli")]

use crate::common::{exits, refused};
use crate::program::Folder;
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

        for (name, text) in [
            ("K.mtx", matrix_market(&model.block.stiffness, 17)),
            ("M.mtx", matrix_market(&model.block.mass, 17)),
            ("contacts.csv", model.contacts(0, PRESSURE)),
            ("u.txt", model.displacements()),
        ] {
            model.folder.write(name, &text);
        }
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

    /// The places of the nodes, and an edge to none.
    fn nodes(&self) -> String {
        let mut text = String::from("x,y,dof_x,dof_y\n");
        for (dof, [x, y]) in self.block.points.iter().enumerate().step_by(2) {
            writeln!(text, "{x},{y},{dof},{}", dof + 1).unwrap();
        }

        text
    }

    /// u = K^-1 r, a number a line.
    fn displacements(&self) -> String {
        self.displacements_under(&[])
    }

    /// u = K^-1 (r + f); f is given as forces at degrees of freedom.
    fn displacements_under(&self, loads: &[(usize, f64)]) -> String {
        let order = self.block.stiffness.order;
        let mut solution = vec![0.0; order];
        for node in &self.block.contact {
            solution[2 * node] = MU * PRESSURE;
            solution[2 * node + 1] = PRESSURE;
        }

        for (dof, load) in loads {
            solution[*dof] += load;
        }

        let factors = SparseLu::new(order, self.block.stiffness.entries.iter().copied()).unwrap();
        let mut columns = [solution];
        factors.solve(&mut columns);

        let lines: Vec<String> = columns[0].iter().map(|u| format!("{u:e}\n")).collect();
        lines.concat()
    }

    /// What a conversion of these files prints.
    #[track_caller]
    fn convert(&self, files: [&str; 3], displacements: &str) -> String {
        exits(0, &self.command(files, displacements))
    }

    /// The same with the places of the nodes.
    #[track_caller]
    fn convert_with_places(&self, files: [&str; 3], displacements: &str) -> String {
        let nodes = self.folder.write("nodes.csv", &self.nodes());
        let command = self.command(files, displacements);
        exits(0, &format!("{command} --coordinates {nodes}"))
    }

    fn command(&self, files: [&str; 3], displacements: &str) -> String {
        let command = convert(&self.folder, files);
        match displacements {
            "" => command,
            file => format!("{command} --displacements {}", self.folder.path(file)),
        }
    }
}

/// The conversion of these files: stiffness, mass, contacts.
fn convert(folder: &Folder, files: [&str; 3]) -> String {
    let [stiffness, mass, contacts] = files.map(|file| folder.path(file));
    let matrices = format!("--stiffness {stiffness} --mass {mass}");
    let out = folder.path("out.json");
    format!("convert --friction {MU} {matrices} --contacts {contacts} --out {out}")
}

const FILES: [&str; 3] = ["K.mtx", "M.mtx", "contacts.csv"];

#[track_caller]
fn warns_only_of(text: &str, words: &str) {
    warns_of(text, &[words]);
}

/// The warnings are these, in this order.
#[track_caller]
fn warns_of(text: &str, expected: &[&str]) {
    let warnings: Vec<&str> = text.lines().filter(|l| l.starts_with("WARNING")).collect();
    assert_eq!(warnings.len(), expected.len(), "{expected:?} in\n{text}");
    for (warning, words) in warnings.iter().zip(expected) {
        assert!(warning.contains(words), "expected {words:?}, got {warning}");
    }
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
        "    reactions, slip: |r_T| is mu |r_N|, but for at most 0 of it",
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
    let of_bending = element([12.0, 6.0, -12.0, 6.0, 4.0, -6.0, 2.0, 12.0, -6.0, 4.0]);
    let of_mass = element([156.0, 22.0, 54.0, -13.0, 4.0, 13.0, -3.0, 156.0, -22.0, 4.0]);

    let folder = Folder::new();
    folder.write("K.mtx", &beam(&of_bending));
    folder.write("M.mtx", &beam(&of_mass));
    folder.write("contacts.csv", "tangential,normal,state\n7,6,slip-\n");

    let text = exits(0, &convert(&folder, FILES));
    assert!(!text.contains("exchanged"), "{text}");
}

/// The symmetric matrix of an element of length 100 with these entries on the diagonal and to the
/// right of it; entries at rotations, 1 and 3, are lengths or squares of them.
fn element(upper: [f64; 10]) -> [[f64; 4]; 4] {
    let mut matrix = [[0.0; 4]; 4];
    let places = (0..4).flat_map(|i| (i..4).map(move |j| (i, j)));
    for ((i, j), value) in places.zip(upper) {
        let rotations = i % 2 + j % 2;
        matrix[i][j] = value * 100.0_f64.powi(rotations as i32);
        matrix[j][i] = matrix[i][j];
    }
    matrix
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

/// What is warned of where the table gives no reactions.
const NO_REACTION: &str = "4 more: no reaction is given (reaction_tangential, reaction_normal)";

/// One fault in each model.
#[test]
fn each_fault_is_named() {
    let model = Model::new();
    let without_reactions = |normal_direction: i8, state: &str| {
        let mut table = String::from("tangential,normal,normal_direction,state\n");
        for node in &model.block.contact {
            let dofs = [2 * node, 2 * node + 1]
                .map(|dof| dof.to_string())
                .join(",");
            writeln!(table, "{dofs},{normal_direction},{state}").unwrap();
        }
        table
    };
    for (name, text) in [
        ("short.mtx", matrix_market(&model.block.stiffness, 4)),
        ("from-1.csv", model.contacts(1, PRESSURE)),
        ("later.csv", model.contacts(0, 1.25 * PRESSURE)),
        ("bare.csv", without_reactions(-1, "slip-")),
        ("turned.csv", without_reactions(-1, "slip+")),
        ("inward.csv", without_reactions(1, "slip-")),
    ] {
        model.folder.write(name, &text);
    }

    let of_k_u = "the reactions are those of K u where every number is one less";
    for (files, displacements, warnings) in [
        (["M.mtx", "K.mtx", "contacts.csv"], "", &["exchanged"][..]),
        (["short.mtx", "M.mtx", "contacts.csv"], "", &["few digits"]),
        // By the masses alone, and by the reactions where displacements are given.
        (["K.mtx", "M.mtx", "from-1.csv"], "", &["different masses"]),
        (
            ["K.mtx", "M.mtx", "from-1.csv"],
            "u.txt",
            &["different masses", of_k_u],
        ),
        (
            ["K.mtx", "M.mtx", "later.csv"],
            "u.txt",
            &["differ from K u by 2e-1 of the largest"],
        ),
        (["K.mtx", "K.mtx", "contacts.csv"], "", &["K and M are one"]),
        // Without reactions displacements show a wrong state, and without those nothing does.
        (["K.mtx", "M.mtx", "bare.csv"], "", &[NO_REACTION]),
        (["K.mtx", "M.mtx", "bare.csv"], "u.txt", &[]),
        (
            ["K.mtx", "M.mtx", "turned.csv"],
            "u.txt",
            &["expected r_T against the impending slip (slip+ and slip- exchanged?), got from K u"],
        ),
        (
            ["K.mtx", "M.mtx", "inward.csv"],
            "u.txt",
            &["expected r_N < 0, which presses"],
        ),
    ] {
        warns_of(&model.convert(files, displacements), warnings);
    }
}

/// A chain of springs that no support holds, in place of the K of the block.
#[test]
fn a_body_without_supports_is_named() {
    let model = Model::new();
    let order = model.block.stiffness.order;
    let mut entries = Vec::new();
    for i in 1..order {
        entries.extend([
            (i - 1, i - 1, 1.0),
            (i, i, 1.0),
            (i, i - 1, -1.0),
            (i - 1, i, -1.0),
        ]);
    }
    let mut sums = vec![vec![0.0; order]; order];
    for (i, j, value) in entries {
        sums[i][j] += value;
    }
    let mut chain = Vec::new();
    for (i, row) in sums.iter().enumerate() {
        for (j, value) in row.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            chain.push((i, j, *value));
        }
    }
    let chain = DoubleMatrix {
        order,
        entries: chain,
    };
    model.folder.write("chain.mtx", &matrix_market(&chain, 17));

    let is_named = |contacts: &str| {
        let text = model.convert(["chain.mtx", "M.mtx", contacts], "");
        text.contains("WARNING: every row of K sums to zero, as for a body without supports")
    };
    assert!(is_named("contacts.csv"));

    let sticks = model.contacts(0, PRESSURE).replacen("slip-", "stick", 1);
    model.folder.write("sticks.csv", &sticks);
    assert!(!is_named("sticks.csv"));
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
        refused(&model.command(FILES, file), &words);
    }
}

/// The obstacle is below the block: the right directions, and one that is turned by 5 degrees, are
/// not named. Of the wrong ones all particles have the same, or one alone.
#[test]
fn directions_are_held_against_the_places_of_the_nodes() {
    let model = Model::new();
    let all = "particles n0, n1, n2, n3, n4 and 4 more: ";
    let turned = "the tangent is turned by up to 20.0 degrees from the line through its neighbours";
    let a_quarter = "the tangent is turned by up to 90.0 degrees";
    let into_body = "the normal points into the body";

    for (columns, cells, expected) in [
        ("normal_direction", "-1", vec![]),
        ("normal_x,normal_y", "0,-1", vec![]),
        ("angle,normal_direction", "5,-1", vec![]),
        ("angle", "180", vec![]),
        (
            "angle,normal_direction",
            "20,-1",
            vec![format!("{all}{turned}")],
        ),
        // The coordinates of the normal are exchanged; at the end of the contact it points inside.
        (
            "normal_x,normal_y",
            "-1,0",
            vec![
                format!("{all}{a_quarter}"),
                format!("particle n8: {into_body}"),
            ],
        ),
        (
            "normal_x,normal_y",
            "0,1",
            vec![format!("{all}{into_body}")],
        ),
        ("normal_direction", "1", vec![format!("{all}{into_body}")]),
    ] {
        let table = directed(&model, columns, |_| cells);
        model.folder.write("directed.csv", &table);

        let text = model.convert_with_places(["K.mtx", "M.mtx", "directed.csv"], "");
        let mut all = vec![NO_REACTION];
        all.extend(expected.iter().map(String::as_str));
        warns_of(&text, &all);
    }

    let one_wrong = directed(&model, "angle,normal_direction", |k| match k {
        3 => "-30,-1",
        _ => "0,-1",
    });
    model.folder.write("directed.csv", &one_wrong);
    let text = model.convert_with_places(["K.mtx", "M.mtx", "directed.csv"], "");
    let turned = "particle n3: the tangent is turned by 30.0 degrees";
    warns_of(&text, &[NO_REACTION, turned]);
}

/// A table with names and these columns, without reactions.
fn directed(model: &Model, columns: &str, cells: impl Fn(usize) -> &'static str) -> String {
    let mut text = format!("particle,tangential,normal,state,{columns}\n");
    for (k, node) in model.block.contact.iter().enumerate() {
        let tangential = 2 * node;
        let normal = tangential + 1;
        writeln!(text, "n{k},{tangential},{normal},slip-,{}", cells(k)).unwrap();
    }

    text
}

#[test]
fn degrees_of_freedom_of_two_nodes_are_named() {
    let model = Model::new();
    let table = directed(&model, "normal_direction", |_| "-1");
    let [first, second] = [0, 1].map(|k| 2 * model.block.contact[k]);
    let crossed = table
        .replace(
            &format!("n0,{first},{}", first + 1),
            &format!("n0,{first},{}", second + 1),
        )
        .replace(
            &format!("n1,{second},{}", second + 1),
            &format!("n1,{second},{}", first + 1),
        );
    model.folder.write("crossed.csv", &crossed);

    let text = model.convert_with_places(["K.mtx", "M.mtx", "crossed.csv"], "");
    let crossed = "particles n0, n1: the tangential and the normal dof move two";
    warns_of(&text, &[NO_REACTION, crossed]);
}

/// A contact that is left out of the table bears a force beside the others. A load far from them is
/// a figure and no warning.
#[test]
fn a_force_beside_the_contacts_is_named() {
    let model = Model::new();
    let node = model.block.contact[4];
    let all = model.contacts(0, PRESSURE);
    let line = format!("{},{},-1,slip-,1,2\n", 2 * node, 2 * node + 1);
    assert!(all.contains(&line), "{line} in\n{all}");
    model.folder.write("eight.csv", &all.replace(&line, ""));
    let files = ["K.mtx", "M.mtx", "eight.csv"];
    let forces = [2 * node + 1, 2 * node].map(|dof| format!("at dof {dof}"));

    let text = model.convert(files, "u.txt");
    let [normal, tangential] = &forces;
    warns_only_of(
        &text,
        &format!("K u has 2.0000 {normal}, 1.00000 {tangential}, beside"),
    );

    let text = model.convert_with_places(files, "u.txt");
    let place = format!("{normal} (node {node} at x = ");
    let gap = format!("between particles 3 and 4, near x = 40.000, y = 0, where node {node} is");
    warns_of(&text, &[&place, &gap]);

    let far = model.block.stiffness.order - 1;
    let loaded = model.displacements_under(&[(far, -3.0)]);
    model.folder.write("loaded.txt", &loaded);
    let text = model.convert(FILES, "loaded.txt");
    warns_of(&text, &[]);
    let figure = format!("    K u elsewhere: -3.0000 at dof {far} (loads, supports)\n");
    assert!(text.contains(&figure), "{figure} in\n{text}");

    assert!(!model.convert(FILES, "u.txt").contains("K u elsewhere"));
}

/// The unit of density is wrong by 10^12: kg/m^3 in place of t/mm^3, and the other way round. A
/// thousandth, kg in place of t, makes frequencies that bodies have.
#[test]
fn masses_in_another_unit_are_named() {
    let model = Model::new();
    for (factor, expected) in [
        (
            1e12,
            vec!["cycles per unit of time, below 1e-2: K and M may be in units"],
        ),
        (
            1e-12,
            vec!["cycles per unit of time, above 1e6: K and M may be in units"],
        ),
        (1e3, vec![]),
    ] {
        let mut mass = model.block.mass.clone();
        for (_, _, value) in &mut mass.entries {
            *value *= factor;
        }
        model.folder.write("scaled.mtx", &matrix_market(&mass, 17));

        let text = model.convert(["K.mtx", "scaled.mtx", "contacts.csv"], "");
        warns_of(&text, &expected);
    }
}
