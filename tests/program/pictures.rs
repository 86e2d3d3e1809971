//! Pictures and reports from outside: what is drawn is the data, nothing comes from the net, and
//! files appear whole or not at all.
//!
//! A picture is read back as XML: its marks, points and attributes must be the numbers it was made
//! from, inside the paper. A mark too many, a curve of other data or a word that leaves the paper
//! fails.
#![cfg(feature = "cli")]

use crate::common::{exit_code, exits, exits_with_json, names_in, read, refused};
use crate::program::Folder;
use mceip::picture::{
    BodyDrawing, BodyMode, BodyUnderLoad, Branches, ChartPoint, CostSeries, Mark, PathDrawing,
    Picture, Presence, PresenceChart, PresenceRange, Threshold, ThresholdColumn, body_picture,
    body_vtu, branch_picture, cost_picture, path_picture, presence_picture, table1_picture,
    threshold_picture,
};
use mceip_exact::{to_f64, whole};
use mceip_model::file::read_problem;
use mceip_model::{ContactState, Particle, Problem};
use mceip_paper::{Block, BlockModel, Loading};
use mceip_path::LoadingPath;
use mceip_testkit::system_of;
use roxmltree::{Document, Node};
use serde_json::Value;
use std::ops::ControlFlow;

fn small() -> BlockModel {
    BlockModel::of_the_paper().with_cells(6, 3)
}

fn path() -> LoadingPath {
    let block = Block::new(&small()).unwrap();
    let contact = block.contact_side().unwrap();
    let steps = Loading::of_the_paper().steps(&contact).unwrap();

    LoadingPath::follow(&contact, &steps, &|_| ControlFlow::Continue(())).unwrap()
}

/// The elements that have this class, perhaps among others.
fn of_class<'a>(tree: &'a Document<'_>, class: &str) -> Vec<Node<'a, 'a>> {
    let mut nodes = Vec::new();
    for node in tree.descendants() {
        let classes = node.attribute("class").unwrap_or_default();
        if classes.split(' ').any(|word| word == class) {
            nodes.push(node);
        }
    }
    nodes
}

/// How many elements have this class.
fn count(tree: &Document<'_>, class: &str) -> usize {
    of_class(tree, class).len()
}

/// An attribute of each element, as a number.
fn data(nodes: &[Node<'_, '_>], name: &str) -> Vec<f64> {
    let values = nodes.iter().map(|node| node.attribute(name).unwrap());
    values.map(|value| value.parse().unwrap()).collect()
}

/// An attribute as a number, if there is one.
fn number(node: &Node<'_, '_>, name: &str) -> Option<f64> {
    let value = node.attribute(name)?;
    value.parse().ok()
}

/// Well-formed, inside its paper, and (with the feature) drawn as PNG of twice the size.
#[track_caller]
fn sound(picture: &Picture) -> String {
    let text = picture.to_svg();
    let tree = Document::parse(&text).unwrap();

    for node in tree.descendants() {
        if node.attribute("transform").is_some() {
            continue;
        }

        is_inside_its_paper(&node, picture.size());
        if node.has_tag_name("text") {
            word_fits(&node, picture.size());
        }
    }

    #[cfg(feature = "png")]
    assert_png_of_twice_the_size(picture);
    text
}

/// The coordinates of an element lie on the paper.
#[track_caller]
fn is_inside_its_paper(node: &Node<'_, '_>, (width, height): (f64, f64)) {
    for (name, limit) in [
        ("x", width),
        ("cx", width),
        ("x1", width),
        ("x2", width),
        ("y", height),
        ("cy", height),
        ("y1", height),
    ] {
        let is_inside = number(node, name).is_none_or(|value| (0.0..=limit).contains(&value));
        assert!(
            is_inside,
            "{name} of {:?} leaves the paper",
            node.tag_name()
        );
    }
}

/// A word does not leave the paper, where a letter takes 0.65 of its height: that is wide for the
/// font.
#[track_caller]
fn word_fits(node: &Node<'_, '_>, (width, _): (f64, f64)) {
    let x = number(node, "x").unwrap();
    let size = number(node, "font-size").unwrap_or(13.0);
    let letters = node.text().unwrap_or_default().chars().count();
    let length = 0.65 * size * letters as f64;

    let from = match node.attribute("text-anchor") {
        Some("middle") => x - length / 2.0,
        Some("end") => x - length,
        _ => x,
    };
    let to = from + length;

    assert!(
        from > -1.0 && to < width + 1.0,
        "{:?} from {from} to {to} of {width}",
        node.text()
    );
}

#[cfg(feature = "png")]
fn assert_png_of_twice_the_size(picture: &Picture) {
    let (width, height) = picture.size();
    let png = picture.to_png(2.0).unwrap();

    // The header of a PNG has its width and its height from bytes 16 and 20 on.
    let png_width = u32::from_be_bytes(png[16..20].try_into().unwrap());
    let png_height = u32::from_be_bytes(png[20..24].try_into().unwrap());
    assert!(png.starts_with(b"\x89PNG"));
    assert_eq!(png_width, (2.0 * width).ceil() as u32);
    assert_eq!(png_height, (2.0 * height).ceil() as u32);
}

#[test]
fn a_mesh_is_drawn_deformed_with_the_mark_of_every_candidate() {
    let loads = small().loads(&Loading::of_the_paper()).unwrap();
    let slip = ContactState::Slip { sign: 1 };
    let states = [
        ContactState::Stick,
        slip,
        slip,
        ContactState::Slip { sign: -1 },
        slip,
        ContactState::Free,
        ContactState::Zero,
    ];
    let system = loads.body.system().with_states(&states, None).unwrap();
    let coordinates = loads.coordinates.as_ref().unwrap();

    let moved = system.particles()[4].tangential;
    let picture = |motion: f64| {
        let mut v = vec![0.0; system.dofs()];
        v[moved] = motion;
        body_picture(
            "a < b & c",
            &BodyDrawing {
                coordinates,
                particles: system.particles(),
                mode: Some(BodyMode {
                    v: &v,
                    slipping: &[1, 3, 4],
                }),
                load: None,
            },
        )
    };
    let text = sound(&picture(-1.0));

    // Those that slip are turned into their direction.
    let tree = Document::parse(&text).unwrap();
    let counts = Mark::ALL.map(|mark| count(&tree, mark.class()));
    assert_eq!(
        counts,
        [1, 0, 3, 1, 1, 1],
        "stick, against, along, caught, free, zero"
    );
    assert_eq!(count(&tree, "mark"), states.len());
    assert_eq!(count(&tree, "held"), 7, "the glued side");
    assert_eq!(count(&tree, "obstacle"), 6, "of all but the free one");
    let bar = of_class(&tree, "bar")[0];
    let words = bar.descendants().find_map(|node| node.text());
    let expected = "10 in the unit of the coordinates";
    assert_eq!(words, Some(expected), "mm, of the 80 of the block");

    for class in ["deformed", "edges"] {
        let edges = of_class(&tree, class)[0].attribute("d").unwrap();
        assert_eq!(edges.matches('M').count(), coordinates.edges().len());
    }
    assert!(text.contains("a &lt; b &amp; c"));
    assert_eq!(count(&tree, "arrow"), 0, "46 nodes are too many for arrows");

    // A mode turned round is drawn on the other side; one that is zero or not finite is drawn at
    // rest.
    let deformed = |motion: f64| {
        let svg = picture(motion).to_svg();
        let tree = Document::parse(&svg).unwrap();
        let deformed = of_class(&tree, "deformed")[0];
        deformed.attribute("d").unwrap().to_string()
    };
    assert_eq!(deformed(-2.0), deformed(-1.0), "only the direction matters");
    assert_ne!(deformed(1.0), deformed(-1.0));
    assert_eq!(deformed(f64::NAN), deformed(0.0));
}

/// Two particles on a wedge and a node above them: the markers point where the
/// particles are about to slip, arrows are the mode, one factor for all.
#[test]
fn a_body_has_its_nodes_states_and_arrows() {
    let problem = body_on_a_wedge();
    let system = system_of(&problem);
    let mut drawing = BodyDrawing {
        coordinates: problem.coordinates.as_ref().unwrap(),
        particles: system.particles(),
        mode: None,
        load: None,
    };

    let text = sound(&body_picture("body", &drawing));

    let tree = Document::parse(&text).unwrap();
    assert_eq!(count(&tree, "node"), 3);
    assert_eq!(count(&tree, "arrow"), 0);
    let edges = of_class(&tree, "edges")[0].attribute("d").unwrap();
    assert_eq!(edges.matches('M').count(), 2);
    let names = |tree: &Document<'_>| -> Vec<String> {
        let names = of_class(tree, "name").into_iter();
        names.filter_map(|n| Some(n.text()?.into())).collect()
    };
    assert_eq!(names(&tree), ["foot", "1"]);
    // Beyond the obstacle, which lies at the upper left of the first particle, above the second.
    let drawn = of_class(&tree, "name");
    let particles = of_class(&tree, "node");
    let right_of =
        |k: usize| number(&drawn[k], "x").unwrap() - number(&particles[k], "cx").unwrap();
    let below = |k: usize| number(&drawn[k], "y").unwrap() - number(&particles[k], "cy").unwrap();
    assert!(right_of(0) < -10.0 && below(0) < -10.0);
    assert!(right_of(1) == 0.0 && below(1) < -10.0);

    // S = 1: the first particle is about to slip against its tangent, which points to the upper
    // right at 36.87 degrees; clockwise from the right that is 143.13. The second one slips to the
    // right.
    let turned = of_class(&tree, "slip-along");
    let angle = |node: &Node<'_, '_>| {
        let turn = node.attribute("transform").unwrap();
        let degrees = turn.trim_start_matches("rotate(").split(' ').next();
        degrees.unwrap().parse::<f64>().unwrap()
    };
    let angles: Vec<f64> = turned.iter().map(angle).collect();
    assert_eq!(angles, [143.13, 0.0]);

    // The normals point into the obstacle: (-3/5, 4/5), and (0, 1). On paper y points down.
    let nodes = of_class(&tree, "node");
    let obstacles = of_class(&tree, "obstacle");
    assert_eq!(obstacles.len(), 2);
    for (k, normal) in [[-0.6, -0.8], [0.0, -1.0]].into_iter().enumerate() {
        let surface = obstacles[k].first_element_child().unwrap();
        let middle =
            |from, to| (number(&surface, from).unwrap() + number(&surface, to).unwrap()) / 2.0;
        let right = middle("x1", "x2") - number(&nodes[k], "cx").unwrap();
        let down = middle("y1", "y2") - number(&nodes[k], "cy").unwrap();
        let distance = right.hypot(down);
        assert!(distance > 7.0, "{distance}");
        assert!(
            (right / distance - normal[0]).abs() < 0.01,
            "{right} {down}"
        );
        assert!((down / distance - normal[1]).abs() < 0.01, "{right} {down}");
    }

    let v = [0.5, -0.25, 0.0, 0.0, f64::NAN, 0.0];
    drawing.mode = Some(BodyMode {
        v: &v,
        slipping: &[0],
    });
    let text = sound(&body_picture("mode", &drawing));
    let tree = Document::parse(&text).unwrap();
    assert_eq!(count(&tree, "arrow"), 1);
    assert_eq!(count(&tree, "caught"), 1);

    // v points to the right and down; on paper down is positive.
    let arrow = of_class(&tree, "arrow")[0];
    let shaft = arrow.children().find(|n| n.has_tag_name("line")).unwrap();
    let along = |from, to| number(&shaft, to).unwrap() - number(&shaft, from).unwrap();
    assert!(along("x1", "x2") > 0.0);
    assert!((along("y1", "y2") / along("x1", "x2") - 0.5).abs() < 0.01);
    let scale = of_class(&tree, "scale")[0].text().unwrap();
    assert!(scale.contains("the largest |v| is 0.559."), "{scale}");

    // Nothing moves, all nodes at one place, places at the end of what is read.
    drawing.mode = Some(BodyMode {
        v: &[],
        slipping: &[],
    });
    assert!(sound(&body_picture("rest", &drawing)).contains("No node moves"));
    let close = with_second_node_at("0");
    drawing.coordinates = close.coordinates.as_ref().unwrap();
    let text = body_picture("at one place", &drawing).to_svg();
    assert_eq!(
        names(&Document::parse(&text).unwrap()),
        ["foot"],
        "the other would cover it"
    );
    for place in ["0", "1e-300", "1e154"] {
        let problem = with_second_node_at(place);
        let elsewhere = BodyDrawing {
            coordinates: problem.coordinates.as_ref().unwrap(),
            particles: system.particles(),
            mode: None,
            load: None,
        };
        let text = sound(&body_picture("body", &elsewhere));
        assert!(!text.contains("NaN") && !text.contains("inf"), "{place}");
    }
}

/// The same body for ParaView: places, edges, states and the mode, node by node.
#[test]
fn a_body_is_a_vtu_file() {
    let problem = body_on_a_wedge();
    let v = [0.5, -0.25, 0.0, 0.0, f64::NAN, 0.0];
    let mut drawing = BodyDrawing {
        coordinates: problem.coordinates.as_ref().unwrap(),
        particles: system_of(&problem).particles(),
        mode: Some(BodyMode {
            v: &v,
            slipping: &[0],
        }),
        load: None,
    };

    let text = body_vtu(&drawing);
    let tree = Document::parse(&text).unwrap();
    let array = |name: &str| {
        let mut arrays = tree.descendants().filter(|n| n.has_tag_name("DataArray"));
        let found = arrays.find(|n| n.attribute("Name") == Some(name));
        found.unwrap().text().unwrap().to_string()
    };
    let piece = tree.descendants().find(|n| n.has_tag_name("Piece"));
    assert_eq!(piece.unwrap().attribute("NumberOfPoints"), Some("3"));
    assert_eq!(piece.unwrap().attribute("NumberOfCells"), Some("2"));
    assert_eq!(array("places"), "0e0 0e0 0 2e0 0e0 0 0e0 0e0 0");
    assert_eq!(array("connectivity"), "0 2 1 2");
    assert_eq!(array("offsets"), "2 4");
    assert_eq!(array("types"), "3 3", "lines");
    assert_eq!(array("contact"), "3 3 0", "impending slip, no particle");
    assert_eq!(array("slips"), "1 0 0");
    assert_eq!(array("mode"), "5e-1 -2.5e-1 0 0e0 0e0 0 0e0 0e0 0");

    drawing.mode = None;
    let text = body_vtu(&drawing);
    assert!(text.contains("\"contact\"") && !text.contains("\"mode\""));
    assert!(!text.contains("\"displacement\"") && !text.contains("\"reaction\""));

    // The tangent of the first particle is (4/5, 3/5), that of the second one (1, 0).
    drawing.load = Some(BodyUnderLoad {
        displacement: &[0.25, 0.5, f64::INFINITY, 0.0, 1.0],
        prescribed: &[(0.0, 0.0), (0.0, 0.0), (0.0, -0.5)],
        reactions: &[(5.0, -10.0), (0.0, 0.0)],
    });
    let text = body_vtu(&drawing);
    let tree = Document::parse(&text).unwrap();
    let array = |name: &str| {
        let mut arrays = tree.descendants().filter(|n| n.has_tag_name("DataArray"));
        let found = arrays.find(|n| n.attribute("Name") == Some(name));
        found.unwrap().text().unwrap().to_string()
    };
    assert_eq!(array("displacement"), "2.5e-1 5e-1 0 0e0 0e0 0 1e0 -5e-1 0");
    assert_eq!(array("held"), "0 0 1");
    assert_eq!(array("reaction"), "1e1 -5e0 0 0e0 0e0 0 0e0 0e0 0");
    assert_eq!(array("normal_reaction"), "1e1 0e0 0");
    assert_eq!(array("places"), "0e0 0e0 0 2e0 0e0 0 0e0 0e0 0", "at rest");
}

fn body_on_a_wedge() -> Problem {
    with_second_node_at("2")
}

/// Three nodes: (0, 0), (x, 0), and (0, 0) again, where nothing moves along y.
fn with_second_node_at(x: &str) -> Problem {
    let text = format!(
        r#"{{"format": "mceip-problem/1", "unknown": "mu",
            "coordinates": {{"nodes": [[0, 1, 0, 0], [2, 3, "{x}", 0], [4, null, 0, 0]],
                             "edges": [[0, 2], [1, 2]], "particles": ["foot", ""]}},
            "system": {{"stiffness": {{"rows": 5, "cols": 5, "symmetric": true,
                                       "entries": [[0, 0, 1], [1, 1, 1], [2, 2, 1], [3, 3, 1],
                                                   [4, 4, 1]]}},
                        "particles": [{{"tangential": 0, "normal": 1, "state": "slip", "sign": 1,
                                        "frame": [["4/5", "3/5"], ["-3/5", "4/5"]]}},
                                      {{"tangential": 2, "normal": 3, "state": "slip",
                                        "sign": -1}}]}}}}"#
    );
    read_problem(&text, std::path::Path::new(".")).unwrap()
}

#[test]
fn the_path_is_drawn_as_it_is() {
    let path = path();
    let count_of_candidates = path.stretches[0].states.len();
    let mut candidates = vec![Particle::plain(0, 1, ContactState::Stick); count_of_candidates];
    candidates[0].name = Some("trailing edge".into());
    candidates[1].name = Some("trailing edge two".into());
    let drawing = PathDrawing {
        path: &path,
        steps: &["press", "push"],
        candidates: &candidates,
        coordinates: None,
    };
    let text = sound(&path_picture("path", &drawing));
    let tree = Document::parse(&text).unwrap();

    for mark in Mark::ALL {
        let states = path.stretches.iter().flat_map(|stretch| &stretch.states);
        let expected = states.filter(|state| Mark::of(**state) == mark).count();
        assert_eq!(count(&tree, mark.class()), expected, "{mark:?}");
    }

    let points = of_class(&tree, "point");
    let depth = path.steps.amounts[0].as_ref().unwrap();
    let mut loads = Vec::new();
    let mut tangential_forces = Vec::new();

    for stretch in &path.stretches {
        let (tangential, _) = stretch.start.resultants();
        let before = if stretch.step == 0 {
            0.0
        } else {
            to_f64(depth)
        };
        loads.push(before + to_f64(stretch.start.amount()));
        tangential_forces.push(to_f64(&tangential));
    }

    assert_eq!(data(&points, "data-x"), loads);
    assert_eq!(data(&points, "data-y"), tangential_forces);

    let places = data(&points, "cx");
    assert!(places.windows(2).all(|pair| pair[0] <= pair[1]));
    assert!(places[0] < places[places.len() - 1]);
    assert_eq!(count(&tree, "curve"), 3);
    assert!(text.contains("resultants (unit of the forces)") && text.contains("a stretch begins"));

    let steps = of_class(&tree, "step");
    let steps: Vec<_> = steps.iter().filter_map(|step| step.text()).collect();
    assert_eq!(steps, ["press", "push"]);
    let rows = of_class(&tree, "candidate");
    assert_eq!(rows.len(), count_of_candidates);
    assert_eq!(rows[0].text(), Some("trail\u{2026}e"));
    assert_eq!(rows[1].text(), Some("trail\u{2026}o"));
    assert_eq!(rows[2].text(), Some("3"));
}

#[test]
fn resultants_below_zero_are_drawn_below_zero() {
    let loads = mceip::Loads::read("spec/examples/loads.json").unwrap();
    let followed = loads.path().run().unwrap().unwrap();
    let drawing = PathDrawing {
        path: followed.as_path(),
        steps: &loads.step_names(),
        candidates: loads.candidates(),
        coordinates: None,
    };
    let text = sound(&path_picture("path", &drawing));
    let tree = Document::parse(&text).unwrap();
    let points = of_class(&tree, "point");

    let tangential = data(&points, "data-y");
    assert_eq!(tangential[..2], [0.0, -0.3]);
    let heights = data(&points, "cy");
    assert!(heights[1] > heights[0]);
}

/// Where the places of the nodes are known, triangles point the way of impending slip, as on the
/// body: to the left along -x, and down where the tangent points up.
#[test]
fn triangles_of_a_path_point_where_the_candidates_slip() {
    let loads = mceip::Loads::read("spec/examples/loads.json").unwrap();
    let followed = loads.path().run().unwrap().unwrap();
    let states = followed.as_path().stretches.iter();
    let slips = states.flat_map(|stretch| stretch.equilibrium_states());
    let slips = slips.filter(|state| Mark::of(**state) == Mark::SlipAgainst);
    let slips = slips.count();
    assert!(slips > 3);

    let up = [[0, 1], [-1, 0]].map(|row| row.map(whole));
    for (frame, turn) in [(None, "180 "), (Some(up), "rotate(90 ")] {
        let mut candidates = loads.candidates().to_vec();
        for candidate in &mut candidates {
            candidate.frame = frame.clone();
        }
        let drawing = PathDrawing {
            path: followed.as_path(),
            steps: &loads.step_names(),
            candidates: &candidates,
            coordinates: loads.as_file().coordinates.as_ref(),
        };
        let text = sound(&path_picture("path", &drawing));
        let tree = Document::parse(&text).unwrap();

        assert_eq!(count(&tree, Mark::SlipAgainst.class()), 0);
        let drawn = of_class(&tree, Mark::SlipAlong.class());
        assert_eq!(drawn.len(), slips);
        for mark in drawn {
            let transform = mark.attribute("transform").unwrap();
            assert!(transform.contains(turn), "{transform}");
        }
        assert!(text.contains("the way it points") && !text.contains("against tangent"));
    }
}

/// The solutions of one stretch of the path. Where mu > 5 one slip node does not move.
fn column(stretch: usize, slip: usize, mu: &[f64]) -> ThresholdColumn {
    let mut solutions = Vec::new();
    for &mu in mu {
        let stuck = usize::from(mu > 5.0);
        solutions.push(Threshold {
            mu,
            moving: slip - stuck,
        });
    }

    ThresholdColumn {
        stretch,
        slip,
        solutions,
        necessary: Some(0.25),
    }
}

fn branch_point(mu: f64, lambda2: f64, support: &[usize]) -> ChartPoint {
    ChartPoint {
        mu,
        lambda2,
        support: support.to_vec(),
    }
}

#[test]
fn thresholds_and_branches_are_the_numbers_given() {
    let columns = [
        column(1, 3, &[]),
        column(2, 4, &[60.8]),
        column(3, 5, &[1.7, 7000.0]),
    ];
    let text = sound(&threshold_picture("t", &columns, 1.1));
    let tree = Document::parse(&text).unwrap();
    let drawn = of_class(&tree, "threshold");
    let necessary = of_class(&tree, "necessary");

    assert_eq!(data(&drawn, "data-mu"), [60.8, 1.7, 7000.0]);
    assert_eq!(count(&tree, "all-slip"), 1);
    assert_eq!(count(&tree, "some-stick"), 2);
    assert_eq!(data(&necessary, "data-stretch"), [1.0, 2.0, 3.0]);

    let branches = Branches {
        levels: vec![
            vec![
                branch_point(1.7, 0.0, &[0, 1]),
                branch_point(9.0, 0.0, &[0]),
            ],
            vec![
                branch_point(1.8, 1e5, &[0, 1]),
                branch_point(9.5, 1e5, &[1]),
            ],
            vec![branch_point(2.0, 1e6, &[0, 1])],
        ],
        certified: vec![branch_point(1.9, 5e5, &[0, 1])],
        absent_below: Some(1.69),
    };
    let text = sound(&branch_picture("b", &branches));
    let tree = Document::parse(&text).unwrap();
    let points = of_class(&tree, "point");

    assert_eq!(data(&points, "data-x"), [1.7, 9.0, 1.8, 9.5, 2.0]);
    assert_eq!(count(&tree, "branch"), 2);
    assert_eq!(count(&tree, "change"), 1);
    assert_eq!(count(&tree, "certified"), 1);
    assert_eq!(data(&of_class(&tree, "absent"), "data-x"), [1.69]);

    // A branch goes to the nearest point with its support, not to the first one.
    let branches = Branches {
        levels: vec![
            vec![
                branch_point(6.0, 4.0, &[0, 1]),
                branch_point(1.7, 4.0, &[0]),
            ],
            vec![
                branch_point(2.0, 9.0, &[0, 1]),
                branch_point(8.5, 9.0, &[0, 1]),
            ],
        ],
        ..Branches::default()
    };
    let text = sound(&branch_picture("n", &branches));
    let tree = Document::parse(&text).unwrap();
    let ends = |class: &str| -> Vec<String> {
        let points = of_class(&tree, class)[0].attribute("points").unwrap();
        points
            .split(' ')
            .map(|place| place.split(',').next().unwrap().into())
            .collect()
    };
    let places = |mu: [f64; 2]| {
        mu.map(|mu| {
            let points = of_class(&tree, "point").into_iter();
            let point = points.into_iter().find(|p| number(p, "data-x") == Some(mu));
            point.unwrap().attribute("cx").unwrap().to_string()
        })
    };
    assert_eq!(ends("branch"), places([6.0, 8.5]));
    assert_eq!(ends("change"), places([1.7, 2.0]));

    // Pictures without data.
    sound(&branch_picture("e", &Branches::default()));
    sound(&threshold_picture("e", &[], 1.1));
}

/// Stable up to 0.5, absent below 1, present at the samples 1.2 and 2, undecided from 2.5 on.
fn presence_of_every_kind() -> PresenceChart {
    PresenceChart {
        ranges: vec![
            PresenceRange {
                presence: Presence::Stable,
                from: 0.0,
                is_from_included: false,
                to: Some(0.5),
                is_proved: true,
            },
            PresenceRange {
                presence: Presence::Absent,
                from: 0.5,
                is_from_included: true,
                to: Some(1.0),
                is_proved: true,
            },
            PresenceRange {
                presence: Presence::Present,
                from: 1.2,
                is_from_included: true,
                to: Some(2.0),
                is_proved: false,
            },
            PresenceRange {
                presence: Presence::Undecided,
                from: 2.5,
                is_from_included: true,
                to: None,
                is_proved: false,
            },
        ],
        samples: vec![
            (1.2, Presence::Present),
            (2.0, Presence::Present),
            (2.5, Presence::Undecided),
        ],
        friction: 3.0,
        critical: Some(1.0625),
        words: ["asked for", "critical"],
        members: Some([1.0, 1.25]),
    }
}

#[test]
fn presence_is_drawn_at_its_values_of_mu() {
    let presence = presence_of_every_kind();
    let text = sound(&presence_picture("presence", &presence));
    assert!(text.contains("\u{3bc} examined"), "the dots on the axis");
    let tree = Document::parse(&text).unwrap();

    let ranges = of_class(&tree, "range");
    assert_eq!(data(&ranges, "data-from"), [0.0, 0.5, 1.2, 2.5]);
    let classes: Vec<&str> = ranges.iter().filter_map(|r| r.attribute("class")).collect();
    let expected = [
        "range stable proved",
        "range absent proved",
        "range present sampled",
        "range undecided sampled",
    ];
    assert_eq!(classes, expected);

    // Stability for 0 < mu says nothing of mu = 0.
    for tip in [
        "mu above 0 to 0.5: stable, proved",
        "mu from 0.5 to 1: no divergence, proved",
    ] {
        assert!(text.contains(tip), "{text}");
    }
    assert!(
        text.contains("mu from 1.2 to 2: divergence, sampled"),
        "{text}"
    );

    // A proof has a full outline, samples a dashed one; the stable and the undecided are hatched.
    let mut dashes = Vec::new();
    let mut lefts = Vec::new();
    let mut strokes = Vec::new();
    for range in &ranges {
        let outline = range.first_element_child().unwrap();
        dashes.push(outline.attribute("stroke-dasharray"));
        lefts.push(number(&outline, "x").unwrap());
        strokes.push(range.children().filter(|n| n.has_tag_name("line")).count());
    }
    assert_eq!(dashes, [None, None, Some("4 3"), Some("4 3")]);
    assert_eq!(strokes[1..3], [0, 0]);
    assert!(strokes[0] > 3 && strokes[3] > 3, "{strokes:?}");

    // Places grow with mu in one proportion.
    let proportion = (lefts[3] - lefts[0]) / (lefts[2] - lefts[0]);
    assert!((proportion - 2.5 / 1.2).abs() < 0.01, "{proportion}");

    assert_eq!(data(&of_class(&tree, "sample"), "data-mu"), [1.2, 2.0, 2.5]);
    assert_eq!(data(&of_class(&tree, "friction"), "data-mu"), [3.0]);
    assert_eq!(data(&of_class(&tree, "critical"), "data-mu"), [1.0625]);
    assert!(text.contains("1.0625"));

    // The bar of members, and its key.
    assert_eq!(of_class(&tree, "members").len(), 2);
    assert!(text.contains("radii of the data: 1 to 1.25"), "{text}");

    // Without anything known there is an axis and the friction of the system.
    let nothing = PresenceChart {
        ranges: Vec::new(),
        samples: Vec::new(),
        friction: 0.0,
        critical: None,
        words: ["asked for", "critical"],
        members: None,
    };
    let text = sound(&presence_picture("nothing", &nothing));
    assert!(!text.contains("NaN") && !text.contains("inf"));
    assert!(!text.contains("examined"));
}

#[test]
fn table1_has_its_regions() {
    let text = sound(&table1_picture());
    let tree = Document::parse(&text).unwrap();

    assert_eq!(regions(&tree, "+1 +1"), ["0", "1"]);
    assert_eq!(regions(&tree, "-1 -1"), ["0", "1"]);
    assert_eq!(regions(&tree, "+1 -1"), ["0", "2", "3"]);
    assert_eq!(regions(&tree, "-1 +1"), ["0"]);
}

/// The numbers of solutions in the regions of the panel for these signs.
fn regions(tree: &Document<'_>, signs: &str) -> Vec<String> {
    let panels = of_class(tree, "panel");
    let panel = panels
        .iter()
        .find(|panel| panel.attribute("data-signs") == Some(signs))
        .unwrap();

    let counts = panel
        .descendants()
        .filter(|node| node.attribute("class") == Some("count"));
    counts
        .map(|node| node.text().unwrap().to_string())
        .collect()
}

fn list<'a>(value: &'a Value, field: &str) -> &'a [Value] {
    value[field].as_array().unwrap()
}

/// A small block and its loading as a file.
fn block_of(folder: &Folder, cells: &str) -> String {
    let file = folder.path("block.json");
    exits(0, &format!("block --loads {file} --cells {cells}"));
    file
}

#[test]
fn a_report_is_one_page_that_needs_nothing_else() {
    let folder = Folder::new();
    let block = block_of(&folder, "6x3");
    let page = folder.path("out.html");
    let pictures = folder.path("pictures");

    let json = exits_with_json(
        0,
        &format!("path {block} --at-mu 3 --report {page} --pictures {pictures} --json"),
    );

    assert_eq!(
        Vec::from_iter(names_in(&folder.path(""))),
        ["block.json", "out.html", "pictures"]
    );

    let text = read(&page);
    for outside in ["http:", "https:", "src="] {
        assert!(!text.contains(outside), "{outside}");
    }

    let tree = Document::parse(text.strip_prefix("<!DOCTYPE html>\n").unwrap()).unwrap();
    for loading in ["script", "link", "img", "iframe", "image", "use"] {
        assert_eq!(count_tags(&tree, loading), 0, "{loading}");
    }

    // Sections for the model, the path, the instability, and every state.
    let states = list(&json, "complete_sets");
    assert!(states.len() > 3);
    assert_eq!(count_tags(&tree, "section"), 3 + states.len());

    let mut modes = 0;
    for state in states {
        modes += list(state, "solutions").len();
        modes += list(&state["lambda2"][0], "solutions").len();
    }

    // At rest, and at the end of each of the two steps.
    let bodies = 3;
    assert_eq!(count_tags(&tree, "svg"), 3 + bodies + modes);

    let first_step = read(&format!("{pictures}/step-01.svg"));
    assert!(first_step.contains("Contact states at 1 of step press"));

    let files = names_in(&pictures);
    let has_png = cfg!(feature = "png");
    let formats = if has_png { 2 } else { 1 };

    assert_eq!(files.len(), formats * (3 + bodies + modes), "{files:?}");
    for name in files.iter().filter(|name| name.ends_with(".svg")) {
        let svg = read(&format!("{pictures}/{name}"));
        assert!(Document::parse(&svg).is_ok(), "{name}");

        let png = name.replace(".svg", ".png");
        assert_eq!(files.contains(&png), has_png);
    }
}

/// Without stiffness along the obstacle K* is singular at mu = 0, so that the necessary condition
/// excludes nothing; a cold reading found that the report said the opposite.
#[test]
fn a_condition_that_holds_at_zero_excludes_nothing() {
    let folder = Folder::new();
    let body = r#"{"format": "mceip-loads/1", "system": {"stiffness": [[0, 0], [0, 1]],
                   "mass": [[1, 0], [0, 1]], "friction": "1/2",
                   "candidates": [{"tangential": 0, "normal": 1}]},
                   "steps": [{"forces": [[0, 1], [1, 2]]}]}"#;
    let body = folder.write("body.json", body);
    let page = folder.path("out.html");

    assert_eq!(exit_code(&format!("path {body} --report {page}")), Some(0));
    let text = read(&page);
    assert!(text.contains("holds from \u{3bc} = 0 on: it excludes nothing"));
    assert!(!text.contains("divergence is excluded for every"));
    assert!(text.contains("an all-slip mode exists") && text.contains("one solution at each"));
}

/// How many elements have this tag.
fn count_tags(tree: &Document<'_>, tag: &str) -> usize {
    let all = tree.descendants();
    all.filter(|node| node.tag_name().name() == tag).count()
}

#[test]
fn every_state_is_listed_with_its_evidence() {
    let folder = Folder::new();
    let block = block_of(&folder, "4x2");
    let base = format!("path {block} --complete --json");
    let condensed = exits_with_json(0, &format!("{base} --conditions --modes --at-mu 2,3"));
    let whole = exits_with_json(0, &format!("{base} --uncondensed"));

    let states = list(&condensed, "complete_sets");
    let same_states = list(&whole, "complete_sets");
    let dofs = 36; // of 18 nodes that are not glued

    assert_eq!(states.len(), same_states.len());

    let mut growing = 0;
    for (state, uncondensed) in states.iter().zip(same_states) {
        solutions_are_those_of_the_uncondensed_block(state, uncondensed, dofs);
        assert!(state["from"].is_number());
        assert_eq!(state["nodes"].as_str().unwrap().len(), 5);

        let levels = list(state, "lambda2");
        assert_eq!(levels.len(), 2);
        assert_eq!(levels[0]["mu"], "2");
        assert_eq!(levels[1]["mu"], "3");

        for solution in levels.iter().flat_map(|level| list(level, "solutions")) {
            let rate = solution["growth_rate_per_s"].as_f64().unwrap();
            let value = solution["lambda2"].as_f64().unwrap();
            approx::assert_relative_eq!(rate * rate, value, max_relative = 1e-12);
            growing += 1;
        }
    }

    assert!(growing > 0);
}

/// The solutions of a state, with modes over so many dofs, against those of the uncondensed block,
/// which has no modes and no conditions.
#[track_caller]
fn solutions_are_those_of_the_uncondensed_block(state: &Value, uncondensed: &Value, dofs: usize) {
    let solutions = list(state, "solutions");
    let same_solutions = list(uncondensed, "solutions");
    assert_eq!(solutions.len(), same_solutions.len());
    assert!(uncondensed.get("necessary").is_none());

    for (solution, same) in solutions.iter().zip(same_solutions) {
        let mu = solution["mu"].as_f64().unwrap();
        let same_mu = same["mu"].as_f64().unwrap();
        approx::assert_relative_eq!(mu, same_mu, max_relative = 1e-6);
        assert_eq!(solution["moving"], same["moving"]);
        assert_eq!(list(solution, "mode").len(), dofs);
        assert!(same.get("mode").is_none());

        // The necessary condition (19) comes no later than any solution.
        assert!(state["necessary"]["holds_from"].as_f64().unwrap() <= mu);
    }
}

/// Exit 2, one line, and no file where there was none.
#[test]
fn refusals_leave_nothing_behind() {
    let folder = Folder::new();
    let taken = folder.write("taken", "x");
    let page = folder.path("out.html");
    let missing_page = folder.path("missing/out.html");
    let missing_chart = folder.path("missing/chart.svg");
    let pdf = folder.path("chart.pdf");
    let the_folder = folder.path("").trim_end_matches('/').to_string();
    let path = "path spec/examples/loads.json";

    for (command, word) in [
        (
            format!("{path} --report {missing_page}"),
            "missing/out.html",
        ),
        (format!("{path} --report {the_folder}"), "cannot write"),
        (format!("{path} --pictures {taken}"), "taken"),
        (format!("{path} --report {page} --at-mu 2,-1"), "--at-mu"),
        (format!("{path} --report {page} --at-mu nan"), "--at-mu"),
        (format!("block --loads {page} --cells 0x3"), "cells"),
        (format!("block --state 15 --loads {page}"), "--state"),
        (format!("table1 --chart {pdf}"), "a name ending in .svg"),
        (
            format!("table1 --chart {missing_chart}"),
            "missing/chart.svg",
        ),
    ] {
        refused(&command, &[word]);
        assert_eq!(
            Vec::from_iter(names_in(&the_folder)),
            ["taken"],
            "{command}"
        );
    }

    assert_eq!(read(&taken), "x");

    for (name, is_drawn) in [("chart.svg", true), ("chart.png", cfg!(feature = "png"))] {
        let chart = folder.path(name);
        let code = exit_code(&format!("table1 --chart {chart}"));
        assert_eq!(code, Some(if is_drawn { 0 } else { 2 }));

        let length = std::fs::metadata(&chart).map_or(0, |data| data.len());
        assert_eq!(length > 5000, is_drawn, "{name}");
    }
}

#[test]
fn cost_series_are_the_numbers_given() {
    let search = CostSeries {
        name: "search".into(),
        points: vec![(10.0, 0.01), (80.0, 5.5)],
    };
    let check = CostSeries {
        name: "check".into(),
        points: vec![(10.0, 0.002), (80.0, 2.0), (150.0, 31.0)],
    };

    let text = sound(&cost_picture("cost", "slip nodes", &[search, check]));

    let tree = Document::parse(&text).unwrap();
    let points = of_class(&tree, "point");
    assert_eq!(data(&points, "data-x"), [10.0, 80.0, 10.0, 80.0, 150.0]);
    assert_eq!(data(&points, "data-y"), [0.01, 5.5, 0.002, 2.0, 31.0]);
    assert_eq!(count(&tree, "series"), 2);

    // Dearer is higher, larger is further to the right.
    let heights = data(&points, "cy");
    let places = data(&points, "cx");
    assert!(heights[0] > heights[1]);
    assert!(places[0] < places[1]);

    sound(&cost_picture("nothing", "slip nodes", &[]));
}
