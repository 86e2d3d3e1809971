//! Pictures and reports from outside: what is drawn is the data, nothing comes from the net, and
//! files appear whole or not at all.
#![cfg(feature = "cli")]

use mceip::picture::{
    BranchPoint, Branches, CostSeries, Mark, Mode, Picture, Threshold, ThresholdColumn,
    branch_picture, cost_picture, mode_picture, path_picture, table1_picture, threshold_picture,
};
use mceip_exact::to_f64;
use mceip_model::ContactState;
use mceip_paper::path::{Contact, Loading, LoadingPath};
use mceip_paper::{Block, BlockModel};
use roxmltree::{Document, Node};
use serde_json::Value;
use std::ops::ControlFlow;
use std::path::Path;
use std::process::{Command, Output};

fn small() -> BlockModel {
    BlockModel::of_the_paper().with_cells(6, 3)
}

fn path() -> LoadingPath {
    let contact = Contact::of(&Block::new(&small()).unwrap()).unwrap();
    LoadingPath::follow(&contact, &Loading::of_the_paper(), &|_, _| {
        ControlFlow::Continue(())
    })
    .unwrap()
}

fn of_class<'a>(tree: &'a Document<'_>, class: &str) -> Vec<Node<'a, 'a>> {
    let has = |n: &Node<'_, '_>| {
        n.attribute("class")
            .is_some_and(|c| c.split(' ').any(|c| c == class))
    };
    tree.descendants().filter(has).collect()
}

fn data(nodes: &[Node<'_, '_>], name: &str) -> Vec<f64> {
    nodes
        .iter()
        .map(|n| n.attribute(name).unwrap().parse().unwrap())
        .collect()
}

/// Well-formed, inside its paper, and (with the feature) drawn as PNG of twice the size.
#[track_caller]
fn sound(picture: &Picture) -> String {
    let text = picture.to_svg();
    let tree = Document::parse(&text).unwrap();
    let (width, height) = picture.size();
    let number =
        |n: &Node<'_, '_>, name: &str| n.attribute(name).and_then(|v| v.parse::<f64>().ok());
    for node in tree
        .descendants()
        .filter(|n| n.attribute("transform").is_none())
    {
        for (name, limit) in [
            ("x", width),
            ("cx", width),
            ("x1", width),
            ("x2", width),
            ("y", height),
            ("cy", height),
            ("y1", height),
        ] {
            assert!(
                number(&node, name).is_none_or(|v| (0.0..=limit).contains(&v)),
                "{name} of {:?} leaves the paper",
                node.tag_name()
            );
        }
    }
    // Every word fits: at most 0.65 of its height a letter, which is wide for the font.
    for node in tree
        .descendants()
        .filter(|n| n.has_tag_name("text") && n.attribute("transform").is_none())
    {
        let (x, size) = (
            number(&node, "x").unwrap(),
            number(&node, "font-size").unwrap_or(13.0),
        );
        let length = 0.65 * size * node.text().unwrap_or_default().chars().count() as f64;
        let (from, to) = match node.attribute("text-anchor") {
            Some("middle") => (x - length / 2.0, x + length / 2.0),
            Some("end") => (x - length, x),
            _ => (x, x + length),
        };
        assert!(
            from > -1.0 && to < width + 1.0,
            "{:?} from {from} to {to} of {width}",
            node.text()
        );
    }
    #[cfg(feature = "png")]
    assert_png_of_twice_the_size(picture);
    text
}

#[cfg(feature = "png")]
fn assert_png_of_twice_the_size(picture: &Picture) {
    let (width, height) = picture.size();
    let png = picture.to_png(2.0).unwrap();
    let side = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());

    assert!(png.starts_with(b"\x89PNG"));
    assert_eq!(
        (side(16), side(20)),
        ((2.0 * width).ceil() as u32, (2.0 * height).ceil() as u32)
    );
}

#[test]
fn a_mode_has_the_mark_of_every_node_and_every_edge() {
    let mesh = small().triangulation().unwrap();
    let slip = ContactState::Slip { sign: 1 };
    let states = [
        ContactState::Stick,
        slip,
        slip,
        ContactState::Slip { sign: -1 },
        slip,
        ContactState::Free,
        ContactState::Free,
    ];
    let marks = Mark::of_mode(&states, &[0, 2, 3]);
    let mut displacement = vec![0.0; 2 * mesh.nodes.iter().flatten().count()];
    let third = mesh.nodes[mesh.contact[4]].unwrap();
    displacement[2 * third] = -1.0;
    let picture = mode_picture(
        "a < b & c",
        &Mode {
            mesh: &mesh,
            displacement: &displacement,
            marks: &marks,
        },
    );
    let text = sound(&picture);
    let tree = Document::parse(&text).unwrap();
    let counts = Mark::ALL.map(|m| of_class(&tree, m.class()).len());
    assert_eq!(counts, [1, 2, 1, 1, 2], "stick, left, right, caught, free");
    assert_eq!(of_class(&tree, "mark").len(), states.len());
    // Euler: points + triangles - 1 edges, each once.
    let edges = of_class(&tree, "deformed")[0]
        .attribute("d")
        .unwrap()
        .matches('M')
        .count();
    assert_eq!(edges, mesh.points.len() + mesh.triangles.len() - 1);
    assert!(text.contains("a &lt; b &amp; c"));
    // A mode turned round is drawn on the other side; one that is zero or not finite is drawn at
    // rest.
    let of = |v: f64| {
        let mut d = displacement.clone();
        d[2 * third] = v;
        mode_picture(
            "a < b & c",
            &Mode {
                mesh: &mesh,
                displacement: &d,
                marks: &marks,
            },
        )
        .to_svg()
    };
    assert_eq!(of(-2.0), text, "only the direction matters");
    assert_ne!(of(1.0), text);
    assert_eq!(of(f64::NAN), of(0.0));
}

#[test]
fn the_path_is_drawn_as_it_is() {
    let path = path();
    let text = sound(&path_picture("path", &path));
    let tree = Document::parse(&text).unwrap();
    let states = || path.intervals.iter().flat_map(|i| &i.states);
    for mark in Mark::ALL {
        assert_eq!(
            of_class(&tree, mark.class()).len(),
            states().filter(|s| Mark::of(**s) == mark).count(),
            "{mark:?}"
        );
    }
    let points = of_class(&tree, "point");
    let expected: Vec<f64> = path
        .intervals
        .iter()
        .map(|i| to_f64(i.start.motion()))
        .collect();
    assert_eq!(data(&points, "data-x"), expected);
    let tangential: Vec<f64> = path
        .intervals
        .iter()
        .map(|i| to_f64(&i.start.resultants().0))
        .collect();
    assert_eq!(data(&points, "data-y"), tangential);
    let places = data(&points, "cx");
    assert!(places.windows(2).all(|p| p[0] <= p[1]) && places[0] < places[places.len() - 1]);
    assert_eq!(of_class(&tree, "curve").len(), 3);
}

#[test]
fn thresholds_and_branches_are_the_numbers_given() {
    let column = |stretch, slip, mu: &[f64]| ThresholdColumn {
        stretch,
        slip,
        solutions: mu
            .iter()
            .map(|&mu| Threshold {
                mu,
                moving: slip - usize::from(mu > 5.0),
            })
            .collect(),
        necessary: Some(0.25),
    };
    let columns = [
        column(1, 3, &[]),
        column(2, 4, &[60.8]),
        column(3, 5, &[1.7, 7000.0]),
    ];
    let text = sound(&threshold_picture("t", &columns, 1.1));
    let tree = Document::parse(&text).unwrap();
    assert_eq!(
        data(&of_class(&tree, "threshold"), "data-mu"),
        [60.8, 1.7, 7000.0]
    );
    assert_eq!(
        (
            of_class(&tree, "all-slip").len(),
            of_class(&tree, "some-stick").len()
        ),
        (1, 2)
    );
    assert_eq!(
        data(&of_class(&tree, "necessary"), "data-stretch"),
        [1.0, 2.0, 3.0]
    );

    let point = |mu, lambda2, support: &[usize]| BranchPoint {
        mu,
        lambda2,
        support: support.to_vec(),
    };
    let levels = vec![
        vec![point(1.7, 0.0, &[0, 1]), point(9.0, 0.0, &[0])],
        vec![point(1.8, 1e5, &[0, 1]), point(9.5, 1e5, &[1])],
        vec![point(2.0, 1e6, &[0, 1])],
    ];
    let text = sound(&branch_picture(
        "b",
        &Branches {
            levels,
            certified: vec![point(1.9, 5e5, &[0, 1])],
        },
    ));
    let tree = Document::parse(&text).unwrap();
    assert_eq!(
        data(&of_class(&tree, "point"), "data-x"),
        [1.7, 9.0, 1.8, 9.5, 2.0]
    );
    assert_eq!(
        (
            of_class(&tree, "branch").len(),
            of_class(&tree, "change").len(),
            of_class(&tree, "certified").len()
        ),
        (2, 1, 1)
    );
    for empty in [
        branch_picture("e", &Branches::default()),
        threshold_picture("e", &[], 1.1),
    ] {
        sound(&empty); // nothing to draw is drawn as nothing
    }
}

#[test]
fn table1_has_its_regions() {
    let text = sound(&table1_picture());
    let tree = Document::parse(&text).unwrap();
    let panels = of_class(&tree, "panel");
    let regions = |signs: &str| -> Vec<&str> {
        let panel = panels
            .iter()
            .find(|p| p.attribute("data-signs") == Some(signs))
            .unwrap();
        panel
            .descendants()
            .filter(|n| n.attribute("class") == Some("count"))
            .map(|n| n.text().unwrap())
            .collect()
    };
    assert_eq!(regions("+1 +1"), ["0", "1"]);
    assert_eq!(regions("-1 -1"), ["0", "1"]);
    assert_eq!(regions("+1 -1"), ["0", "2", "3"]);
    assert_eq!(regions("-1 +1"), ["0"]);
}

fn mceip(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mceip"))
        .args(args)
        .output()
        .unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn a_report_is_one_page_that_needs_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (page, pictures) = (file("out.html"), file("pictures"));
    let run = mceip(&[
        "block",
        "--cells",
        "6x3",
        "--at-mu",
        "3",
        "--report",
        &page,
        "--pictures",
        &pictures,
        "--json",
    ]);
    assert_eq!(
        run.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    assert_eq!(names(folder.path()), ["out.html", "pictures"]);
    let text = std::fs::read_to_string(&page).unwrap();
    assert!(!text.contains("http:") && !text.contains("https:") && !text.contains("src="));
    let tree = Document::parse(text.strip_prefix("<!DOCTYPE html>\n").unwrap()).unwrap();
    assert!(tree.descendants().all(|n| {
        !["script", "link", "img", "iframe", "image", "use"].contains(&n.tag_name().name())
    }));
    let json: Value = serde_json::from_slice(&run.stdout).unwrap();
    let states = json["complete_sets"].as_array().unwrap();
    let sections = tree
        .descendants()
        .filter(|n| n.has_tag_name("section"))
        .count();
    assert!(states.len() > 3);
    assert_eq!(
        sections,
        3 + states.len(),
        "model, path, instability, and every state"
    );
    let modes: usize = states
        .iter()
        .map(|s| {
            s["solutions"].as_array().unwrap().len()
                + s["lambda2"][0]["solutions"].as_array().unwrap().len()
        })
        .sum();
    assert_eq!(
        tree.descendants().filter(|n| n.has_tag_name("svg")).count(),
        3 + modes
    );
    let files = names(Path::new(&pictures));
    let formats = if cfg!(feature = "png") { 2 } else { 1 };
    assert_eq!(files.len(), formats * (3 + modes), "{files:?}");
    for name in files.iter().filter(|n| n.ends_with(".svg")) {
        Document::parse(&std::fs::read_to_string(Path::new(&pictures).join(name)).unwrap())
            .unwrap();
        assert_eq!(
            files.contains(&name.replace(".svg", ".png")),
            cfg!(feature = "png")
        );
    }
}

#[test]
fn every_state_is_listed_with_its_evidence() {
    let base = ["block", "--path", "--complete", "--cells", "4x2", "--json"];
    let of = |more: &[&str]| -> Value {
        let run = mceip(&[&base[..], more].concat());
        assert_eq!(
            run.status.code(),
            Some(0),
            "{}",
            String::from_utf8_lossy(&run.stderr)
        );
        serde_json::from_slice(&run.stdout).unwrap()
    };
    let (condensed, whole) = (
        of(&["--conditions", "--modes", "--at-mu", "2,3"]),
        of(&["--uncondensed"]),
    );
    let (states, same) = (
        condensed["complete_sets"].as_array().unwrap(),
        whole["complete_sets"].as_array().unwrap(),
    );
    assert_eq!(states.len(), same.len());
    let mut growing = 0;
    for (state, other) in states.iter().zip(same) {
        let (a, b) = (
            state["solutions"].as_array().unwrap(),
            other["solutions"].as_array().unwrap(),
        );
        assert_eq!(a.len(), b.len());
        for (a, b) in a.iter().zip(b) {
            approx::assert_relative_eq!(
                a["mu"].as_f64().unwrap(),
                b["mu"].as_f64().unwrap(),
                max_relative = 1e-6
            );
            assert_eq!(a["moving"], b["moving"]);
            assert_eq!(
                a["mode"].as_array().unwrap().len(),
                2 * condensed["nodes_mm"].as_array().unwrap().len()
            );
            assert!(b.get("mode").is_none());
            // The necessary condition (19) comes no later than any solution.
            assert!(
                state["necessary"]["holds_from"].as_f64().unwrap() <= a["mu"].as_f64().unwrap()
            );
        }
        assert!(other.get("necessary").is_none());
        assert!(state["from_mm"].is_number() && state["nodes"].as_str().unwrap().len() == 5);
        assert_eq!(
            state["lambda2"]
                .as_array()
                .unwrap()
                .iter()
                .map(|l| l["mu"].as_str().unwrap())
                .collect::<Vec<_>>(),
            ["2", "3"]
        );
        for s in state["lambda2"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|l| l["solutions"].as_array().unwrap())
        {
            let (rate, value) = (
                s["growth_rate_per_s"].as_f64().unwrap(),
                s["lambda2"].as_f64().unwrap(),
            );
            approx::assert_relative_eq!(rate * rate, value, max_relative = 1e-12);
            growing += 1;
        }
    }
    assert!(growing > 0);
}

/// Exit 2, one line, and no file where there was none.
#[test]
fn refusals_leave_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    std::fs::write(file("taken"), "x").unwrap();
    let (missing, page, taken) = (file("missing/out.html"), file("out.html"), file("taken"));
    let refused: [(&[&str], &str); 9] = [
        (&["block", "--report", &missing], "missing/out.html"),
        (
            &["block", "--report", &folder.path().display().to_string()],
            "cannot write",
        ),
        (&["block", "--pictures", &taken], "taken"),
        (&["block", "--report", &page, "--at-mu", "2,-1"], "--at-mu"),
        (&["block", "--report", &page, "--at-mu", "nan"], "--at-mu"),
        (&["block", "--report", &page, "--cells", "0x3"], "cells"),
        (&["block", "--state", "15", "--report", &page], "--state"),
        (
            &["table1", "--chart", &file("chart.pdf")],
            "a name ending in .svg",
        ),
        (
            &["table1", "--chart", &file("missing/chart.svg")],
            "missing/chart.svg",
        ),
    ];
    for (args, word) in refused {
        let run = mceip(args);
        let err = String::from_utf8_lossy(&run.stderr);
        assert_eq!(
            (run.status.code(), err.lines().count()),
            (Some(2), 1),
            "{args:?}: {err}"
        );
        assert!(err.contains(word) && run.stdout.is_empty(), "{word}: {err}");
        assert_eq!(names(folder.path()), ["taken"], "{args:?}");
    }
    assert_eq!(std::fs::read_to_string(file("taken")).unwrap(), "x");
    for (name, is_drawn) in [("chart.svg", true), ("chart.png", cfg!(feature = "png"))] {
        let expected = if is_drawn { 0 } else { 2 };
        assert_eq!(
            mceip(&["table1", "--chart", &file(name)]).status.code(),
            Some(expected)
        );
        assert_eq!(
            std::fs::metadata(file(name)).is_ok_and(|data| data.len() > 5000),
            is_drawn,
            "{name}"
        );
    }
}

#[test]
fn cost_series_are_the_numbers_given() {
    let series = |name: &str, points: &[(f64, f64)]| CostSeries {
        name: name.into(),
        points: points.to_vec(),
    };
    let list = [
        series("search", &[(10.0, 0.01), (80.0, 5.5)]),
        series("check", &[(10.0, 0.002), (80.0, 2.0), (150.0, 31.0)]),
    ];
    let text = sound(&cost_picture("cost", "slip nodes", &list));
    let tree = Document::parse(&text).unwrap();
    let points = of_class(&tree, "point");
    assert_eq!(data(&points, "data-x"), [10.0, 80.0, 10.0, 80.0, 150.0]);
    assert_eq!(data(&points, "data-y"), [0.01, 5.5, 0.002, 2.0, 31.0]);
    assert_eq!(of_class(&tree, "series").len(), 2);
    // Dearer is higher, larger is further to the right.
    assert!(
        data(&points, "cy").windows(2).take(1).all(|p| p[0] > p[1])
            && data(&points, "cx")[0] < data(&points, "cx")[1]
    );
    sound(&cost_picture("nothing", "slip nodes", &[]));
}
