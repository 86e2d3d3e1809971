//! `mceip convert`: Matrix Market, CalculiX and tables of contacts to problem files; refusals leave
//! no file.
#![cfg(feature = "cli")]

use crate::program::{Folder, mceip, refused};
use mceip_model::file::read_problem_file;
use std::path::Path;

const STI: &str =
    "1 1  4.0e+00\n1 2 -1.0e+00\n2 2  3.0e+00\n3 3  2.5e+00\n2 3  1.5e+00\n4 4 3.0e0\n";
const MAS: &str = "1 1  2.0e-09\n2 2  2.0e-09\n3 3  1.0e-09\n4 4 1.0e-09\n";
const DOF: &str = "7.1\n7.2\n9.1\n9.2\n";
const K: &str = "%%MatrixMarket matrix coordinate real symmetric\n4 4 6\n1 1 4\n2 1 -1\n2 2 3\n3 3 \
                 2.5\n3 2 1.5\n4 4 3\n";
const GENERAL: &str = "%%MatrixMarket matrix coordinate real general\n4 4 8\n1 1 4\n2 1 -1\n1 2 \
                       -1\n2 2 3\n3 3 2.5\n3 2 1.5\n2 3 1.5\n4 4 3\n";
const M: &str = "%%MatrixMarket matrix coordinate real symmetric\n4 4 4\n1 1 2e-9\n2 2 2e-9\n3 3 \
                 1e-9\n4 4 1e-9\n";
const CSV: &str = "particle,tangential,normal,state,normal_direction,reaction_tangential,reaction_normal\nleft,2,3,slip-,-1,0.5000001,1\n";
const JSON: &str = r#"[{"tangential":2,"normal":3,"state":"slip","sign":1,"normal_direction":-1}]"#;

struct Bench(Folder);

impl Bench {
    fn new() -> Bench {
        let bench = Bench(Folder::new());
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
            bench.0.write(name, text);
        }
        bench.0.write("named.csv", &CSV.replace("2,3,", "9.1,9.2,"));
        bench
    }

    fn args(&self, files: [&str; 3], out: &str) -> Vec<String> {
        let [k, m, c] = files.map(|f| self.0.path(f));
        [
            "convert",
            "--stiffness",
            &k,
            "--mass",
            &m,
            "--contacts",
            &c,
            "--friction",
            "0.5",
            "--out",
            &self.0.path(out),
        ]
        .map(String::from)
        .to_vec()
    }

    /// The digest of the problem that is written.
    fn digest(&self, files: [&str; 3], more: &[&str]) -> String {
        let args = self.args(files, "out.json");
        let all: Vec<&str> = args
            .iter()
            .map(String::as_str)
            .chain(more.iter().copied())
            .collect();
        let o = mceip(&all);
        assert_eq!(
            o.status.code(),
            Some(0),
            "{}",
            String::from_utf8_lossy(&o.stderr)
        );
        read_problem_file(Path::new(&self.0.path("out.json")))
            .unwrap()
            .sha256()
    }

    #[track_caller]
    fn refuses(&self, files: [&str; 3], more: &[&str], words: &[&str]) {
        let args = self.args(files, "never.json");
        let all: Vec<&str> = args
            .iter()
            .map(String::as_str)
            .chain(more.iter().copied())
            .collect();
        refused(&all, words);
        assert!(
            !Path::new(&self.0.path("never.json")).exists(),
            "a half-written problem"
        );
    }
}

#[test]
fn every_route_makes_the_same_problem() {
    let bench = Bench::new();
    let dof = bench.0.path("k.dof");
    let digest = bench.digest(["K.mtx", "M.mtx", "c.csv"], &[]);
    assert_eq!(bench.digest(["G.mtx", "M.mtx", "c.json"], &[]), digest);
    assert_eq!(
        bench.digest(["k.sti", "m.mas", "named.csv"], &["--dof", &dof]),
        digest
    );
    let out = bench.0.path("out.json");
    assert_eq!(
        mceip(&["analyze", &out, "--samples", "0"]).status.code(),
        Some(0)
    );
}

#[test]
fn bad_files_are_one_line_and_no_output() {
    let bench = Bench::new();
    let dof = bench.0.path("k.dof");
    bench
        .0
        .write("skew.mtx", &GENERAL.replace("1 2 -1", "1 2 -2"));
    bench
        .0
        .write("indefinite.mtx", &K.replace("1 1 4", "1 1 -4"));
    bench
        .0
        .write("massless.mtx", &M.replace("3 3 1e-9", "3 3 0"));
    bench.0.write("wrong.csv", &CSV.replace("slip-", "slip+"));
    bench.0.write("off.csv", &CSV.replace("0.5000001", "0.8"));
    bench.0.write("unknown.csv", &CSV.replace("2,3,", "2,11,"));
    bench
        .0
        .write("unknown-name.csv", &CSV.replace("2,3,", "9.1,9.3,"));
    bench.0.write("broken.sti", "1 1 4.0\n5 5 1.0\n");
    bench.refuses(["nowhere.mtx", "M.mtx", "c.csv"], &[], &["nowhere.mtx"]);
    bench.refuses(["skew.mtx", "M.mtx", "c.csv"], &[], &["E3", "K symmetric"]);
    bench.refuses(
        ["indefinite.mtx", "M.mtx", "c.csv"],
        &[],
        &["K_ff", "positive definite"],
    );
    bench.refuses(
        ["K.mtx", "massless.mtx", "c.csv"],
        &[],
        &["M", "positive definite"],
    );
    bench.refuses(
        ["K.mtx", "M.mtx", "wrong.csv"],
        &[],
        &["wrong.csv", "E7", "line 2"],
    );
    bench.refuses(["K.mtx", "M.mtx", "off.csv"], &[], &["E7", "mu"]);
    bench.refuses(
        ["K.mtx", "M.mtx", "unknown.csv"],
        &[],
        &["line 2", "normal", "11"],
    );
    bench.refuses(
        ["k.sti", "m.mas", "unknown-name.csv"],
        &["--dof", &dof],
        &["9.3"],
    );
    bench.refuses(
        ["broken.sti", "m.mas", "named.csv"],
        &["--dof", &dof],
        &["broken.sti", "line 2"],
    );
    bench.refuses(
        ["k.sti", "m.mas", "named.csv"],
        &[],
        &["k.sti", "Matrix Market"],
    );
    let input = bench.0.path("K.mtx");
    let mut args = bench.args(["K.mtx", "M.mtx", "c.csv"], "never.json");
    *args.last_mut().unwrap() = input;
    refused(
        &args.iter().map(String::as_str).collect::<Vec<_>>(),
        &["--out", "input"],
    );
}
