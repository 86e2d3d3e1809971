//! A body and a mode as a file of VTK's unstructured grids (VTU, in text), which ParaView opens.
//!
//! Points are the nodes, cells the edges; where the body has no edges each node is a cell. Each
//! point has its contact state; of a mode its displacement v and whether its particle slips; under
//! load its displacement and the reaction of its particle.
//! The file is a tree of [`Element`]s like a picture; it rests on nothing but the format's
//! description (VTK User's Guide, "XML file formats").

use super::body::{BodyDrawing, BodyMode, BodyUnderLoad, component};
use super::markup::Element;
use mceip_exact::to_f64;
use mceip_model::ContactState;
use std::fmt::Display;

/// Types of cells, as VTK numbers them.
const VERTEX: usize = 1;
const LINE: usize = 3;

/// The file of a body: point data `contact`; with a mode, `mode` and `slips`; under load,
/// `displacement`, `held`, `reaction` and `normal_reaction`.
///
/// `contact` is 0 where a node belongs to no particle, else 1 out of contact, 2 stick, 3 impending
/// slip, 4 in contact with zero reaction. `mode` is v, in the length of the coordinates, up to a
/// factor; `slips` is 1 where the particle slips in the mode. The points lie where the body is at
/// rest; where a degree of freedom is held `displacement` is what the steps prescribe, and `held`
/// is 1 at such nodes. `reaction` is the force on the body along x and y at nodes of particles,
/// `normal_reaction` its part -r_N >= 0 that presses.
pub fn body_vtu(body: &BodyDrawing<'_>) -> String {
    let nodes = body.coordinates.nodes();
    let mut places = Vec::with_capacity(nodes.len());
    for node in nodes {
        let [x, y] = &node.place;
        places.push((to_f64(x), to_f64(y)));
    }

    let cells = cells(body);
    let piece = Element::new("Piece")
        .with("NumberOfPoints", places.len())
        .with("NumberOfCells", cells.len())
        .child(point_data(body))
        .child(Element::new("Points").child(vectors("places", &places)))
        .child(cell_arrays(&cells));
    let file = Element::new("VTKFile")
        .with("type", "UnstructuredGrid")
        .with("version", "0.1")
        .with("byte_order", "LittleEndian")
        .child(Element::new("UnstructuredGrid").child(piece));

    format!("<?xml version=\"1.0\"?>\n{file}\n")
}

/// The nodes of each cell.
fn cells(body: &BodyDrawing<'_>) -> Vec<Vec<usize>> {
    let edges = body.coordinates.edges();
    if edges.is_empty() {
        return (0..body.coordinates.nodes().len())
            .map(|node| vec![node])
            .collect();
    }

    edges.iter().map(|edge| edge.to_vec()).collect()
}

fn cell_arrays(cells: &[Vec<usize>]) -> Element {
    let mut ends = Vec::with_capacity(cells.len());
    let mut types = Vec::with_capacity(cells.len());
    let mut seen = 0;
    for cell in cells {
        seen += cell.len();
        ends.push(seen);
        types.push(if cell.len() == 1 { VERTEX } else { LINE });
    }

    let nodes: Vec<usize> = cells.concat();
    Element::new("Cells")
        .child(array("connectivity", "Int64", &nodes))
        .child(array("offsets", "Int64", &ends))
        .child(array("types", "UInt8", &types))
}

/// What is known of each node.
fn point_data(body: &BodyDrawing<'_>) -> Element {
    let nodes = body.coordinates.nodes().len();
    let mut contact = vec![0; nodes];
    let mut slips = vec![0; nodes];
    for (index, particle) in body.particles.iter().enumerate() {
        let Some(node) = body.coordinates.node_of(particle.tangential) else {
            continue;
        };
        contact[node] = code(particle.state);
        if let Some(mode) = &body.mode {
            slips[node] = i32::from(mode.slipping.contains(&index));
        }
    }

    let data = Element::new("PointData").child(array("contact", "Int32", &contact));
    let data = match &body.mode {
        None => data,
        Some(mode) => data
            .child(vectors("mode", &displacements(body, mode)))
            .child(array("slips", "Int32", &slips)),
    };
    match &body.load {
        None => data,
        Some(load) => with_load(data, body, load),
    }
}

/// With the displacements and the reactions under load.
fn with_load(data: Element, body: &BodyDrawing<'_>, load: &BodyUnderLoad<'_>) -> Element {
    let mut displacements = Vec::new();
    let mut held = Vec::new();
    for (node, prescribed) in body.coordinates.nodes().iter().zip(load.prescribed) {
        let [x, y] = node.dofs.map(|dof| component(load.displacement, dof));
        displacements.push((x + prescribed.0, y + prescribed.1));
        held.push(i32::from(node.dofs.contains(&None)));
    }

    let nodes = displacements.len();
    let mut reactions = vec![(0.0, 0.0); nodes];
    let mut pressing = vec![String::from("0"); nodes];
    for (particle, (r_t, r_n)) in body.particles.iter().zip(load.reactions) {
        let Some(node) = body.coordinates.node_of(particle.tangential) else {
            continue;
        };
        let tangent = body.along_axes(&particle.tangent(), node);
        let normal = body.along_axes(&particle.into_obstacle(), node);
        let x = r_t * tangent.0 + r_n * normal.0;
        let y = r_t * tangent.1 + r_n * normal.1;
        reactions[node] = (x, y);
        pressing[node] = format!("{:e}", 0.0 - r_n);
    }

    data.child(vectors("displacement", &displacements))
        .child(array("held", "Int32", &held))
        .child(vectors("reaction", &reactions))
        .child(array("normal_reaction", "Float64", &pressing))
}

fn displacements(body: &BodyDrawing<'_>, mode: &BodyMode<'_>) -> Vec<(f64, f64)> {
    let nodes = 0..body.coordinates.nodes().len();
    nodes.map(|node| body.displacement(node, mode)).collect()
}

/// The number of a contact state.
fn code(state: ContactState) -> i32 {
    match state {
        ContactState::Free => 1,
        ContactState::Stick => 2,
        ContactState::Slip { .. } => 3,
        ContactState::Zero => 4,
    }
}

/// An array with one number for each point or cell.
fn array(name: &str, kind: &str, values: &[impl Display]) -> Element {
    let mut text = String::new();
    for value in values {
        text += &format!("{value} ");
    }

    Element::new("DataArray")
        .with("Name", name)
        .with("type", kind)
        .with("format", "ascii")
        .text(text.trim_end())
}

/// An array of vectors in the plane; VTK has them in space. The shortest decimals that give the
/// doubles back.
fn vectors(name: &str, values: &[(f64, f64)]) -> Element {
    let mut flat = Vec::with_capacity(values.len());
    for (x, y) in values {
        flat.push(format!("{x:e} {y:e} 0"));
    }

    array(name, "Float64", &flat).with("NumberOfComponents", 3)
}
