//! `mceip convert`: Matrix Market, CalculiX and tables of contacts to problem files; refusals leave
//! no file.
//!
//! One problem is written in every format; each way must give the same digest. Each bad file has
//! one fault, whose place the refusal must name.
#![cfg(feature = "cli")]

use crate::common::{exits, read, refused, run};
use crate::program::Folder;
use mceip_exact::rational;
use mceip_model::ContactState;
use mceip_model::file::read_problem_file;
use mceip_testkit::system_of;
use serde_json::{Value, json};
use std::path::Path;

// The stiffness and the mass as CalculiX writes them, with its list of degrees of freedom.
const STI: &str = "\
1 1  4.0e+00
1 2 -1.0e+00
2 2  3.0e+00
3 3  2.5e+00
2 3  1.5e+00
4 4 3.0e0
";
const MAS: &str = "\
1 1  2.0e-09
2 2  2.0e-09
3 3  1.0e-09
4 4 1.0e-09
";
const DOF: &str = "7.1\n7.2\n9.1\n9.2\n";

// The same as Matrix Market files; the stiffness also without its symmetry.
const K: &str = "\
%%MatrixMarket matrix coordinate real symmetric
4 4 6
1 1 4
2 1 -1
2 2 3
3 3 2.5
3 2 1.5
4 4 3
";
const GENERAL: &str = "\
%%MatrixMarket matrix coordinate real general
4 4 8
1 1 4
2 1 -1
1 2 -1
2 2 3
3 3 2.5
3 2 1.5
2 3 1.5
4 4 3
";
const M: &str = "\
%%MatrixMarket matrix coordinate real symmetric
4 4 4
1 1 2e-9
2 2 2e-9
3 3 1e-9
4 4 1e-9
";

// One particle as a table and as JSON.
const CSV: &str = concat!(
    "particle,tangential,normal,state,normal_direction,reaction_tangential,reaction_normal\n",
    "left,2,3,slip-,-1,0.5000001,1\n",
);
const JSON: &str = r#"[{"tangential":2,"normal":3,"state":"slip","sign":1,"normal_direction":-1}]"#;

/// A folder with the inputs of these tests.
fn inputs() -> Folder {
    let folder = Folder::new();
    for (name, text) in [
        ("k.sti", STI),
        ("m.mas", MAS),
        ("k.dof", DOF),
        ("K.mtx", K),
        ("G.mtx", GENERAL),
        ("M.mtx", M),
        ("c.csv", CSV),
        ("c.json", JSON),
    ] {
        folder.write(name, text);
    }

    write_changed(&folder, "c.csv", "named.csv", "2,3,", "9.1,9.2,");
    folder
}

/// Writes a copy of a file with every `from` replaced.
#[track_caller]
fn write_changed(folder: &Folder, file: &str, copy: &str, from: &str, to: &str) {
    let text = read(&folder.path(file));
    assert!(text.contains(from), "{from}");
    folder.write(copy, &text.replace(from, to));
}

/// The files of a conversion.
struct Conversion<'a> {
    stiffness: &'a str,
    mass: &'a str,
    contacts: &'a str,
    /// The list of degrees of freedom that CalculiX writes.
    dof: Option<&'a str>,
}

/// A conversion of Matrix Market files.
fn matrix_market<'a>(stiffness: &'a str, mass: &'a str, contacts: &'a str) -> Conversion<'a> {
    Conversion {
        stiffness,
        mass,
        contacts,
        dof: None,
    }
}

/// A conversion of files of CalculiX.
fn calculix<'a>(stiffness: &'a str, contacts: &'a str) -> Conversion<'a> {
    Conversion {
        stiffness,
        mass: "m.mas",
        contacts,
        dof: Some("k.dof"),
    }
}

impl Conversion<'_> {
    fn command(&self, folder: &Folder, out: &str) -> String {
        let files = [self.stiffness, self.mass, self.contacts, out];
        let [stiffness, mass, contacts, out] = files.map(|file| folder.path(file));
        let dof = self.dof.map(|dof| format!(" --dof {}", folder.path(dof)));
        let matrices = format!(
            "--stiffness {stiffness} --mass {mass}{}",
            dof.unwrap_or_default()
        );
        format!("convert {matrices} --contacts {contacts} --friction 0.5 --out {out}")
    }

    /// The digest of the problem that is written.
    #[track_caller]
    fn digest(&self, folder: &Folder) -> String {
        exits(0, &self.command(folder, "out.json"));

        let problem = read_problem_file(Path::new(&folder.path("out.json")));
        problem.unwrap().sha256()
    }

    #[track_caller]
    fn is_refused(&self, folder: &Folder, words: &[&str]) {
        refused(&self.command(folder, "never.json"), words);

        let is_written = Path::new(&folder.path("never.json")).exists();
        assert!(!is_written, "a half-written problem");
    }
}

#[test]
fn every_route_makes_the_same_problem() {
    let folder = inputs();

    let symmetric = matrix_market("K.mtx", "M.mtx", "c.csv").digest(&folder);
    let general = matrix_market("G.mtx", "M.mtx", "c.json").digest(&folder);
    let from_calculix = calculix("k.sti", "named.csv").digest(&folder);

    assert_eq!(general, symmetric);
    assert_eq!(from_calculix, symmetric);
    exits(
        0,
        &format!("analyze {} --samples 0", folder.path("out.json")),
    );
}

/// Coordinates are kept where they are given, names always; neither changes the digest. Tables that
/// do not fit are refused.
#[test]
fn coordinates_are_kept() {
    let folder = inputs();
    let conversion = matrix_market("K.mtx", "M.mtx", "c.csv");
    let digest = conversion.digest(&folder);
    let nodes = folder.path("nodes.csv");
    let command = conversion.command(&folder, "drawn.json");
    let command = format!("{command} --coordinates {nodes}");

    let table = "node,x,y,dof_x,dof_y,edges_to\na,0,0.5,2,3,b\nb,1,0.5,0,1,\nglued,0,1,,,a b\n";
    folder.write("nodes.csv", table);
    exits(0, &command);

    let path = folder.path("drawn.json");
    let problem = read_problem_file(Path::new(&path)).unwrap();
    let coordinates = problem.coordinates.as_ref().unwrap();
    assert_eq!(problem.sha256(), digest);
    assert_eq!(coordinates.nodes().len(), 3);
    assert_eq!(coordinates.edges(), [[0, 1], [0, 2], [1, 2]]);
    assert_eq!(
        system_of(&problem).particles()[0].name.as_deref(),
        Some("left")
    );
    let plain = read(&folder.path("out.json"));
    assert!(!plain.contains("coordinates") && plain.contains(r#""name":"left""#));

    std::fs::remove_file(&path).unwrap();
    for (from, to, words) in [
        ("2,3,b", "2,4,b", &["nodes.csv", "line 2", "dof_y"][..]),
        (
            "2,3,b",
            "2,3,c",
            &["line 2", "edges_to", "names of other nodes"],
        ),
        (
            "0,1,\n",
            "2,1,\n",
            &["nodes.csv", "each degree of freedom once"],
        ),
        ("dof_x", "dof", &["expected the columns", "dof_x"]),
    ] {
        folder.write("nodes.csv", &table.replace(from, to));
        refused(&command, words);
    }
    assert!(!Path::new(&path).exists());
}

/// An obstacle at an angle: as degrees, as its normal, and as a frame in doubles. The printed line
/// and the comment in the file say what the rotation is.
#[test]
fn oblique_obstacles_become_rational_rotations() {
    let folder = inputs();
    let header = "tangential,normal,state";
    let by_angle = format!("{header},angle\n2,3,slip-,36.86989764584402\n");
    let by_normal = format!("{header},normal_x,normal_y\n2,3,slip-,-0.6,0.8\n");
    let (s, c) = 36.86989764584402_f64.to_radians().sin_cos();
    let frame = format!(
        r#"[{{"tangential":2,"normal":3,"state":"slip","sign":1,"frame":[[{c},{s}],[-{s},{c}]]}}]"#
    );
    folder.write("angle.csv", &by_angle);
    folder.write("normal.csv", &by_normal);
    folder.write("frame.json", &frame);

    let digests = ["angle.csv", "normal.csv", "frame.json"]
        .map(|contacts| matrix_market("K.mtx", "M.mtx", contacts).digest(&folder));
    assert_eq!(digests[0], digests[1]);
    assert_eq!(digests[0], digests[2]);

    let file = read(&folder.path("out.json"));
    let sentence = "Tangent of particles 0: turned by 36.8698976458 degrees, (4/5, 3/5).";
    assert!(file.contains(sentence), "{file}");
    exits(
        0,
        &format!("analyze {} --samples 0", folder.path("out.json")),
    );
}

#[test]
fn rounded_matrices_are_made_symmetric_on_request_only() {
    let folder = inputs();
    write_changed(
        &folder,
        "G.mtx",
        "rounded.mtx",
        "1 2 -1",
        "1 2 -1.000000000001",
    );
    let rounded = matrix_market("rounded.mtx", "M.mtx", "c.csv");

    rounded.is_refused(&folder, &["E3", "K symmetric", "--symmetrize"]);

    let command = rounded.command(&folder, "out.json");
    exits(0, &format!("{command} --symmetrize"));
    let file = read(&folder.path("out.json"));
    assert!(file.contains("K is the mean of the given matrix and its transpose."));
    assert!(file.contains("-2000000000001/2000000000000"), "{file}");
}

/// States that not every command treats are written all the same, as are friction factors.
#[test]
fn zero_reaction_and_friction_factors_are_written() {
    let folder = inputs();
    let table = "tangential,normal,state,friction_factor\n2,3,slip-,3/2\n0,1,zero,\n";
    folder.write("zero.csv", table);

    matrix_market("K.mtx", "M.mtx", "zero.csv").digest(&folder);

    let problem = read_problem_file(Path::new(&folder.path("out.json"))).unwrap();
    let system = system_of(&problem);
    assert_eq!(system.particles()[0].friction_factor, rational(3, 2));
    assert_eq!(system.particles()[1].state, ContactState::Zero);
}

/// A body of a million tonnes: what `convert` warns of is in the file, and `analyze` repeats it as
/// text, as JSON and on the page, until it is accepted. No answer depends on it.
#[test]
fn warnings_travel_with_the_file_until_they_are_accepted() {
    let folder = inputs();
    write_changed(&folder, "M.mtx", "heavy.mtx", "e-9", "e9");
    let heavy = matrix_market("K.mtx", "heavy.mtx", "c.csv").command(&folder, "out.json");
    let accepted = format!("{heavy} --accept-warnings");
    let convert = |command: &str| {
        let text = exits(0, command);
        let problem = read_problem_file(Path::new(&folder.path("out.json"))).unwrap();
        (text, problem)
    };

    let page = folder.path("page.html");
    let out = folder.path("out.json");
    let analyze = format!("analyze {out} --samples 0 --boxes 100");
    let to_page = format!("{analyze} --report {page}");

    let (text, problem) = convert(&heavy);
    let [warning] = &problem.warnings[..] else {
        panic!("expected one warning, got {:?}", problem.warnings)
    };
    assert!(warning.contains("the lowest frequency is"), "{warning}");
    assert!(
        text.contains(&format!("WARNING: {warning}.\n1 warning written")),
        "{text}"
    );

    let answer = run(&to_page);
    let json = run(&format!("{analyze} --json"));
    let json: Value = serde_json::from_str(&json.stdout).unwrap();
    assert!(
        answer
            .stdout
            .contains(&format!("WARNING of convert: {warning}.")),
        "{answer:?}"
    );
    assert!(read(&page).contains(&format!("Warning of convert: {warning}.")));
    assert_eq!(json["warnings"], json!([warning]));

    let (text, silent) = convert(&accepted);
    assert!(silent.warnings.is_empty());
    assert_eq!(silent.sha256(), problem.sha256());
    assert!(text.contains("1 warning accepted"), "{text}");
    let without = run(&to_page);
    assert_eq!(without.code, answer.code);
    assert!(
        !without.stdout.contains("WARNING of convert"),
        "{without:?}"
    );
    assert!(!read(&page).contains("Warning of convert"));
}
