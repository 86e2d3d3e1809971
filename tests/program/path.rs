//! `mceip path` from outside: the problem files of its states, and the own critical friction (texts
//! are in `tests/transcripts`).
#![cfg(feature = "cli")]

use crate::common::{
    decimal, example, exits, exits_with_json, names_in, read, read_json, refused, repository, run,
};
use crate::program::Folder;
use mceip::FrictionGrid;
use serde_json::{Value, json};
use std::cell::RefCell;

/// Files of an earlier path would be taken for states of this one; what has another name stays.
#[test]
fn states_of_an_earlier_path_are_removed_and_nothing_else() {
    let loads = repository("spec/examples/loads.json");
    let folder = Folder::new();
    let states = folder.path("states");
    exits(0, &format!("path {loads} --states {states}"));
    let first = names_in(&states);
    assert!(!first.is_empty());

    for name in ["stretch-777.json", "stretch-x.json", "notes.txt"] {
        folder.write(&format!("states/{name}"), "of an earlier path");
    }
    exits(0, &format!("path {loads} --states {states}"));

    let mut kept = first;
    kept.extend(["stretch-x.json", "notes.txt"].map(String::from));
    assert_eq!(names_in(&states), kept);
}

/// A point between a floor and two oblique springs, K* = 2 - 3/2 mu where it slips along its
/// tangent: it is pressed down, and then pulled off.
fn pulled_point(friction: &str) -> Value {
    json!({
        "format": "mceip-loads/1",
        "system": {
            "stiffness": [["2", "1.5"], ["1.5", "2"]],
            "mass": [[1, 0], [0, 1]],
            "friction": friction,
            "candidates": [{"tangential": 0, "normal": 1}],
        },
        "steps": [
            {"name": "press", "forces": [[1, 4]]},
            {"name": "pull", "forces": [[0, "70/9"]]},
        ],
    })
}

/// By hand: pressed with 4 and then pulled with f, the point (mu = 1) sticks with r = (-f, -4)
/// until f = 4. Then u_T = 2 (f - 4) with r_T = r_N = 3 (f - 4) - 4, until f = 16/3 pulls it off
/// the floor.
#[test]
fn the_table_of_reactions_is_that_by_hand() {
    let folder = Folder::new();
    let mut point = pulled_point("1");
    point["system"]["candidates"][0]["name"] = json!("heel, \"left\"");
    let file = folder.write("point.json", &point.to_string());
    let table = folder.path("reactions.csv");
    exits(0, &format!("path {file} --reactions {table}"));

    let csv = read(&table);
    let mut lines = csv.lines();
    let heading = "stretch,step,amount,number,candidate,state,u_T,u_N,r_T,r_N";
    assert_eq!(lines.next(), Some(heading));
    let rows = [
        r#"0,press,0,1,"heel, ""left""",zero,0,0,0,0"#,
        r#"0,press,1,1,"heel, ""left""",stick,0,0,0,-4"#,
        r#"1,pull,0,1,"heel, ""left""",stick,0,0,0,-4"#,
        r#"1,pull,0.5142857142857142,1,"heel, ""left""",slip+,0,0,-4,-4"#,
        r#"2,pull,0.5142857142857142,1,"heel, ""left""",slip+,0,0,-4,-4"#,
        r#"2,pull,0.6857142857142857,1,"heel, ""left""",zero,2.6666666666666665,0,0,0"#,
        r#"3,pull,0.6857142857142857,1,"heel, ""left""",zero,2.6666666666666665,0,0,0"#,
        r#"3,pull,1,1,"heel, ""left""",free,5.4603174603174605,-2.0952380952380953,0,0"#,
    ];
    assert_eq!(lines.collect::<Vec<_>>(), rows);

    refused(
        &format!("path {file} --reactions {file}"),
        &["--reactions", "another file than the input"],
    );
}

/// The divergence and the states at each mu, by `path` at this mu alone and by hand: below 4/3 the
/// point slips off the floor, above it the path ends where the cone is reached.
#[test]
fn the_own_critical_friction_of_a_point_is_that_of_its_path() {
    let folder = Folder::new();
    let file = folder.write("point.json", &pulled_point("1").to_string());
    let proofs = folder.path("proofs");
    let range = "--own-critical 0.5,4 --end-alone --width 1e-6";

    // Of an earlier run in which something slipped at 0.5, and the path reached its end at 1.5.
    std::fs::create_dir(&proofs).unwrap();
    for stale in ["mu-0.5.problem", "mu-0.5.certificate", "mu-1.5.equilibrium"] {
        std::fs::write(format!("{proofs}/{stale}.json"), "{}").unwrap();
    }

    let command = format!("path {file} {range} --json --certificates {proofs}");
    let answer = exits_with_json(0, &command);

    let bracket = &answer["own_critical"]["bracket"];
    let [lo, hi] = ["absent", "critical"].map(|k| decimal(&bracket[k]));
    assert!(lo < 4.0 / 3.0 && 4.0 / 3.0 < hi, "{bracket}");
    assert!((hi - lo) / hi <= 1e-6, "{bracket}");
    // Nothing slips in the state it ends in: no certificate of divergence, and no frozen critical
    // friction.
    assert!(answer["own_critical"]["frozen"]["absent_below"].is_null());
    let written = names_in(&proofs);
    assert!(
        written
            .iter()
            .all(|name| name.ends_with(".equilibrium.json"))
    );
    assert!(written.len() > 10, "{written:?}");

    let mut ends = 0;
    for point in answer["own_critical"]["points"].as_array().unwrap() {
        let mu = point["mu"].as_str().unwrap();
        let alone = exits_with_json(0, &format!("path {file} --mu {mu} --json"));
        if decimal(&point["mu"]) < 4.0 / 3.0 {
            assert_eq!(point["states"], json!(["free"]));
        }

        if alone["end"] == "all loads are applied" {
            let last = alone["intervals"].as_array().unwrap().last().unwrap();
            assert_eq!(point["states"], last["stop"]["states"]);
            assert_eq!(point["states_certified"], true);
            assert_eq!(point["divergence"], "absent");
            let certificate = format!("{proofs}/mu-{}.equilibrium.json", mu.replace('/', "over"));
            exits(0, &format!("check {file} {certificate}"));
        } else {
            let end = alone["end"].as_str().unwrap();
            assert!(end.contains("the quasi-static path ends"), "{end}");
            assert_eq!(point["no_path"]["why"], end);
            assert_eq!(point["no_path"]["all_tried"], true);
            assert!(!written.contains(&format!("mu-{mu}.equilibrium.json")));
            ends += 1;
        }
    }
    assert!(ends > 3, "{ends}");
    assert!(
        answer["own_critical"]["points"]
            .to_string()
            .contains("\"1.2\"")
    );
}

/// At mu = 3/4 the pull 3 just reaches the cone, at the end of the loads: the point sticks before,
/// and is in impending slip in the equilibrium that is asked about.
#[test]
fn the_equilibrium_asked_about_is_that_at_the_very_end_of_the_loads() {
    let folder = Folder::new();
    let mut loads = pulled_point("1");
    loads["steps"][1]["forces"] = json!([[0, 3]]);
    let file = folder.write("point.json", &loads.to_string());

    let range = "--own-critical 0.75,0.8 --end-alone --grid 1";
    let answer = exits_with_json(0, &format!("path {file} {range} --json"));

    let points = answer["own_critical"]["points"].as_array().unwrap();
    assert_eq!(points[0]["states"], json!(["slip+"]));
    assert_eq!(points[1]["states"], json!(["stick"]));
}

/// Every answer with a certificate is accepted by `check` as it stands on the disk, and `analyze`
/// says the same of the state that `path` finds at this mu alone.
#[test]
fn each_answer_of_the_own_critical_friction_stands_on_its_certificate() {
    let folder = Folder::new();
    let file = example("own-critical");
    let proofs = folder.path("proofs");

    let options = format!("--own-critical 0.5,3.9 --end-alone --json --certificates {proofs}");
    let answer = exits_with_json(0, &format!("path {file} {options}"));

    let own = &answer["own_critical"];
    assert_eq!(
        own["bracket"],
        json!({"absent": "1.78", "critical": "1.79"})
    );
    assert_eq!(own["found"], "between");
    let frozen = decimal(&own["frozen"]["absent_below"]);
    assert!((frozen - 1.11803).abs() < 1e-4, "{frozen}");

    let problems = names_in(&proofs);
    let of_frozen = problems.iter().filter(|name| name.starts_with("frozen-"));
    let of_frozen: Vec<&str> = of_frozen
        .filter_map(|name| name.strip_suffix(".problem.json"))
        .collect();
    assert!(of_frozen.len() >= 2, "{problems:?}");
    for name in of_frozen {
        let [problem, certificate] =
            ["problem", "certificate"].map(|kind| format!("{proofs}/{name}.{kind}.json"));
        exits(0, &format!("check {problem} {certificate}"));
    }

    // With the same answers a page and pictures.
    let [page, figures] = ["own.html", "figures"].map(|name| folder.path(name));
    let drawn = format!("--own-critical 0.5,3.9 --end-alone --report {page} --pictures {figures}");
    let said = exits(0, &format!("path {file} {drawn}"));
    let html = std::fs::read_to_string(&page).unwrap();
    let headline = said.lines().next().unwrap();
    assert!(html.contains(headline), "{headline}");
    assert_eq!(html.matches("<svg").count(), 3);
    for name in ["own-critical", "own-critical-growth", "path"] {
        let figure = std::fs::read_to_string(format!("{figures}/{name}.svg")).unwrap();
        let (_, drawn) = figure.split_once('>').unwrap();
        assert!(
            html.contains(drawn.trim_end()),
            "{name} is that of the page"
        );
    }
    let strip = std::fs::read_to_string(format!("{figures}/own-critical.svg")).unwrap();
    let count = own["points"].as_array().unwrap().len();
    assert_eq!(strip.matches("class=\"sample\"").count(), count);

    let mut seen = [0, 0];
    for point in own["points"].as_array().unwrap() {
        let mu = point["mu"].as_str().unwrap();
        let [problem, certificate] =
            ["problem", "certificate"].map(|kind| format!("{proofs}/mu-{mu}.{kind}.json"));
        if !std::path::Path::new(&problem).exists() {
            assert_eq!(point["states"], json!(["stick", "stick"]), "a theorem");
            continue;
        }

        let said = exits(0, &format!("check {problem} {certificate}"));
        let is_absent = said.contains("ABSENT in [0, infinity)");
        assert!(is_absent || said.contains("and no other"), "{said}");
        assert_eq!(point["divergence"] == "absent", is_absent, "{said}");
        assert_eq!(point["lambda2"] == json!([]), is_absent, "{said}");
        seen[usize::from(is_absent)] += 1;

        // The states are those of an equilibrium, and the certificate is about these states.
        let equilibrium = format!("{proofs}/mu-{mu}.equilibrium.json");
        let equilibrium = exits(0, &format!("check {file} {equilibrium}"));
        let (_, digest) = equilibrium.split_once("lambda2 problem ").unwrap();
        let digest = &digest[..64];
        assert!(said.contains(digest), "{equilibrium} {said}");

        let states = folder.path(&format!("states-{mu}"));
        exits(0, &format!("path {file} --mu {mu} --states {states}"));
        let state = format!("{states}/{}", names_in(&states).pop_last().unwrap());
        let analysis = exits_with_json(0, &format!("analyze {state} --samples 0 --json"));
        assert_eq!(analysis["divergence"]["verdict"], point["divergence"]);
    }
    assert!(seen[0] >= 10 && seen[1] >= 10, "{seen:?}");
}

/// The whole path decides: the first of its stretches whose state diverges, as `analyze` says of
/// each state that `path` writes at this mu alone; where none does, the equilibrium at its end.
#[test]
fn the_own_critical_friction_is_that_of_the_first_state_on_the_path_that_diverges() {
    let folder = Folder::new();
    let file = example("own-critical");
    let proofs = folder.path("proofs");
    let options = format!("--own-critical 0.5,3.9 --json --certificates {proofs}");
    // Of an earlier run: other stretches, and a path that reached its end.
    std::fs::create_dir(&proofs).unwrap();
    for stale in [
        "mu-1.12-stretch-007.problem",
        "mu-1.12-stretch-002.equilibrium",
        "mu-1.12.equilibrium",
    ] {
        std::fs::write(format!("{proofs}/{stale}.json"), "{}").unwrap();
    }

    let answer = exits_with_json(0, &format!("path {file} {options}"));

    let own = &answer["own_critical"];
    assert_eq!(
        own["bracket"],
        json!({"absent": "1.11", "critical": "1.12"})
    );
    assert_eq!(own["frozen"]["states_of"], "1.12");
    let mut seen = [0, 0];
    for point in own["points"].as_array().unwrap() {
        let mu = point["mu"].as_str().unwrap();
        let states = folder.path(&format!("states-{mu}"));
        exits(0, &format!("path {file} --mu {mu} --states {states}"));
        let diverges = |name: &&String| {
            let analysis =
                exits_with_json(0, &format!("analyze {states}/{name} --samples 0 --json"));
            analysis["divergence"]["verdict"] == "present"
        };
        let written = names_in(&states);
        let first = written.iter().find(diverges);

        // Several stretches with the same states are one question.
        let stretch = point["stretch"].as_u64();
        assert_eq!(point["divergence"] == "present", first.is_some(), "{mu}");
        let name = match (stretch, first) {
            (Some(stretch), Some(first)) => {
                assert_eq!(*first, format!("stretch-{stretch:03}.json"));
                format!("mu-{mu}-stretch-{stretch:03}")
            }
            _ => format!("mu-{mu}"),
        };
        seen[usize::from(stretch.is_some())] += 1;
        exits(0, &format!("check {file} {proofs}/{name}.equilibrium.json"));
        if first.is_some() {
            let said = exits(
                0,
                &format!("check {proofs}/{name}.problem.json {proofs}/{name}.certificate.json"),
            );
            assert!(said.contains("and no other"), "{said}");
        }
    }
    assert!(seen[0] >= 4 && seen[1] >= 4, "{seen:?}");

    let of_1_12 = names_in(&proofs)
        .into_iter()
        .filter(|name| name.starts_with("mu-1.12"));
    let of_1_12: Vec<String> = of_1_12.collect();
    let expected = ["certificate", "equilibrium", "problem"];
    let expected = expected.map(|kind| format!("mu-1.12-stretch-003.{kind}.json"));
    for kept in &expected {
        assert!(of_1_12.contains(kept), "{of_1_12:?}");
    }
    let stale = |name: &String| name.contains("007") || *name == "mu-1.12.equilibrium.json";
    assert!(!of_1_12.iter().any(stale), "{of_1_12:?}");
    assert!(
        !of_1_12.contains(&"mu-1.12-stretch-002.equilibrium.json".into()),
        "{of_1_12:?}"
    );
}

/// A run that is killed loses one state, not all those of the path at its mu.
#[test]
fn each_certificate_about_divergence_is_heard_when_it_is_found() {
    let loads = mceip::Loads::read(example("own-critical")).unwrap();
    let path = loads.path().run().unwrap().unwrap();
    let range = ["1.1", "1.12"].map(|mu| mu.parse().unwrap());
    let [least, greatest] = range;
    let grid = FrictionGrid::new(least, greatest).unwrap();
    let grid = grid.with_parts(1).unwrap();
    let heard = RefCell::new(Vec::new());

    let own = path.own_critical(grid);
    let own = own.on_proof(|mu, place, proof| {
        heard
            .borrow_mut()
            .push(format!("{mu} {place:?} {}", proof.is_some()));
    });
    let own = own.on_point(|point| heard.borrow_mut().push(format!("{} all", point.friction())));
    own.run().unwrap();

    let heard = heard.into_inner();
    let first = [
        "11/10 Inside(0) false",
        "11/10 Inside(2) true",
        "11/10 Inside(3) true",
        "11/10 End true",
        "11/10 all",
    ];
    assert_eq!(heard[..5], first);
    assert_eq!(
        heard[5..8],
        [
            "28/25 Inside(0) false",
            "28/25 Inside(2) true",
            "28/25 Inside(3) true"
        ]
    );
    assert_eq!(heard[8], "28/25 all");
}

/// With `--resume` a proof in the folder is taken, checked again, in place of a search; one of
/// another problem, or a broken one, is not.
#[test]
fn the_own_critical_friction_goes_on_from_the_proofs_of_an_earlier_run() {
    let folder = Folder::new();
    let file = example("own-critical");
    let proofs = folder.path("proofs");
    let of = |name: &str, kind: &str| format!("{proofs}/{name}.{kind}.json");
    let own = format!(
        "path {file} --own-critical 1.77,1.8 --end-alone --grid 3 --json --certificates {proofs}"
    );
    let first = exits_with_json(0, &own);

    // A claim beside the complete set shows whose file it is.
    let [problem, certificate] = ["problem", "certificate"].map(|kind| of("mu-1.79", kind));
    let claimed = folder.path("claimed.json");
    exits(0, &format!("solve {problem} --certificate {claimed}"));
    let mut with_claim = read_json(&certificate);
    with_claim["claims"] = read_json(&claimed)["claims"].clone();
    exits(
        0,
        &format!(
            "check {problem} {}",
            folder.write("with.json", &with_claim.to_string())
        ),
    );

    let is_kept = || read_json(&certificate)["claims"] == with_claim["claims"];
    folder.write("proofs/mu-1.79.certificate.json", &with_claim.to_string());
    assert_eq!(exits_with_json(0, &format!("{own} --resume")), first);
    assert!(is_kept(), "searched again");

    std::fs::copy(of("mu-1.79", "certificate"), of("mu-1.78", "certificate")).unwrap();
    folder.write("proofs/mu-1.77.certificate.json", "{}");
    assert_eq!(exits_with_json(0, &format!("{own} --resume")), first);
    exits(
        0,
        &format!(
            "check {} {}",
            of("mu-1.78", "problem"),
            of("mu-1.78", "certificate")
        ),
    );

    assert_eq!(exits_with_json(0, &own), first);
    assert!(!is_kept(), "taken although --resume is not given");
    refused(&format!("path {file} --resume"), &["--own-critical"]);
}

#[test]
fn a_range_that_makes_no_sense_or_a_body_without_mass_is_refused() {
    let folder = Folder::new();
    let file = folder.write("point.json", &pulled_point("1").to_string());
    for (options, word) in [
        ("--own-critical 1", "MIN,MAX"),
        ("--own-critical 2,1", "0 < MIN < MAX"),
        ("--own-critical 0,1", "> 0"),
        ("--own-critical x,1", "x"),
        ("--grid 3", "--own-critical"),
        ("--own-critical 1,2 --grid 0", "--grid"),
    ] {
        refused(&format!("path {file} {options}"), &[word]);
    }

    let mut without_mass = pulled_point("1");
    without_mass["system"]
        .as_object_mut()
        .unwrap()
        .remove("mass");
    let file = folder.write("massless.json", &without_mass.to_string());
    refused(&format!("path {file} --own-critical 1,2"), &["mass"]);
}

/// The file of `path --vtk` with this point data.
fn point_data(path: &str, name: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(path).unwrap();
    let (_, array) = text.split_once(&format!("Name=\"{name}\"")).unwrap();
    let (_, array) = array.split_once('>').unwrap();
    let (numbers, _) = array.split_once('<').unwrap();
    let numbers = numbers.split_whitespace();
    numbers.map(|number| number.parse().unwrap()).collect()
}

/// The body at rest, and with displacements and reactions at the end of each step.
#[test]
fn the_body_under_load_is_written_for_paraview() {
    let folder = Folder::new();
    let vtk = folder.path("vtk");
    let file = example("loads");

    exits(0, &format!("path {file} --vtk {vtk}"));
    let json = exits_with_json(0, &format!("path {file} --json"));

    let written = names_in(&vtk);
    for name in ["body.vtu", "step-01.vtu", "step-02.vtu"] {
        assert!(written.contains(name), "{name} in {written:?}");
    }
    assert!(!written.contains("step-03.vtu"), "{written:?}");

    let at = |name: &str, array: &str| point_data(&format!("{vtk}/{name}"), array);
    assert_eq!(at("body.vtu", "contact"), [2.0, 2.0, 1.0, 0.0]);
    assert_eq!(at("step-01.vtu", "held"), [0.0, 0.0, 0.0, 1.0]);
    // The plate is held, and moved by the steps.
    assert_eq!(at("step-01.vtu", "displacement")[9..], [0.0, -0.2, 0.0]);
    assert_eq!(at("step-02.vtu", "displacement")[9..], [-1.0, -0.2, 0.0]);

    // So it is where the file has no degrees of freedom of the plate, as one of `convert`.
    let without_plate = mceip::Loads::read(&file).unwrap().to_json();
    let without_plate = folder.write("without-plate.json", &without_plate);
    let again = folder.path("again");
    exits(0, &format!("path {without_plate} --vtk {again}"));
    for name in ["step-01.vtu", "step-02.vtu"] {
        let moved = point_data(&format!("{again}/{name}"), "displacement");
        assert_eq!(moved, at(name, "displacement"), "{name}");
    }

    // Every obstacle is below: the reactions at the end of a step are those of its last stretch.
    for (name, last) in [("step-01.vtu", 1), ("step-02.vtu", 7)] {
        let stop = &json["intervals"][last]["stop"];
        let reactions = stop["reactions_T_N"].as_array().unwrap();
        let pressing = at(name, "normal_reaction");
        let along = at(name, "reaction");
        let displacement = at(name, "displacement");
        for (node, reaction) in reactions.iter().enumerate() {
            let [r_t, r_n] = [0_usize, 1].map(|k| reaction[k].as_f64().unwrap());
            assert_eq!(pressing[node], 0.0 - r_n, "{name}, node {node}");
            assert_eq!(along[3 * node], r_t, "{name}, node {node}");
            assert_eq!(along[3 * node + 1], 0.0 - r_n, "{name}, node {node}");

            let gap = if node == 2 { 0.05 } else { 0.0 };
            let down = -displacement[3 * node + 1];
            if r_n < 0.0 {
                assert!((down - gap).abs() < 1e-14, "{name}, node {node}: {down}");
            } else {
                assert!(down < gap, "{name}, node {node}: {down}");
            }
        }
    }
}

/// At mu = 2.7 the path ends before its loads, so that no equilibrium at their end decides. The
/// modes of --complete are bodies too.
#[test]
fn that_no_body_is_drawn_is_said_after_all_pictures() {
    let folder = Folder::new();
    let [without, with] = ["without", "with"].map(|name| folder.path(name));
    let file = example("loads");
    let own = "--own-critical 2.6,2.8 --grid 1 --width 0.05 --end-alone";
    let said = "no body and no mode is drawn here";

    let ends = run(&format!("path {file} {own} --vtk {without}"));
    assert_eq!(ends.code, Some(0), "{ends:?}");
    assert!(ends.stderr.contains(said), "{ends:?}");
    assert!(names_in(&without).is_empty());

    let modes = run(&format!("path {file} {own} --complete --vtk {with}"));
    assert_eq!(modes.code, Some(0), "{modes:?}");
    assert!(!modes.stderr.contains(said), "{modes:?}");
    let written = names_in(&with);
    let first = "mode-stretch-03-threshold-1.vtu";
    assert!(written.contains(first), "{written:?}");
}

/// The body in the equilibrium that decides, and a file without coordinates is refused.
#[test]
fn the_body_that_decides_on_the_own_critical_friction_is_written() {
    let folder = Folder::new();
    let vtk = folder.path("vtk");
    let mut loads = read_json(example("own-critical"));
    let plain = folder.write("plain.json", &loads.to_string());
    loads["coordinates"] = json!({ "nodes": [[0, 1, 0, 0], [2, 3, 1, 0]] });
    let placed = folder.write("placed.json", &loads.to_string());
    let own = "--own-critical 1.1,1.2 --grid 1 --width 0.1";

    refused(
        &format!("path {plain} {own} --vtk {vtk}"),
        &["--vtk", "expected a file with coordinates"],
    );
    exits(0, &format!("path {placed} {own} --vtk {vtk}"));

    let file = format!("{vtk}/own-critical-body.vtu");
    assert_eq!(point_data(&file, "contact"), [3.0, 3.0], "both slip at 1.2");
    assert!(
        point_data(&file, "normal_reaction")
            .iter()
            .all(|r| *r > 0.0)
    );
}
