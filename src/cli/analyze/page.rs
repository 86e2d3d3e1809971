//! `mceip analyze --report`: the answers, their evidence and the modes on one page.

use crate::picture::{Content, Report, Section};
use mceip_engine::analysis::{Analysis, Evidence, Mode};

/// The page; `paths` of the certificates as they were written.
pub(super) fn page(analysis: &Analysis, paths: &[String]) -> String {
    let name = analysis
        .name
        .clone()
        .unwrap_or_else(|| "mechanical system".into());
    let sections = vec![model(analysis), answers(analysis, paths), modes(analysis)];
    Report {
        title: format!("Divergence of {name}"),
        sections,
    }
    .to_html()
}

fn model(analysis: &Analysis) -> Section {
    let [dofs, free, slip, stick] = analysis.sizes;
    let rows = [
        ("degrees of freedom", dofs),
        ("of them free", free),
        ("particles in impending slip", slip),
        ("particles that stick", stick),
    ];
    let mut rows: Vec<Vec<String>> = rows
        .iter()
        .map(|(what, n)| vec![(*what).to_string(), n.to_string()])
        .collect();
    rows.push(vec![
        "coefficient of friction".into(),
        analysis.friction.to_string(),
    ]);
    let table = Content::Table {
        caption: "The system, in the units of its file".into(),
        header: vec!["".into(), "".into()],
        rows,
    };
    Section {
        title: "System".into(),
        content: vec![table],
    }
}

/// Every sentence with what stands behind it; what is only measured is said to be so.
fn answers(analysis: &Analysis, paths: &[String]) -> Section {
    let row = |s: mceip_engine::analysis::Sentence| {
        let kind = match &s.evidence {
            Evidence::Certificate(_) => "proved",
            Evidence::Exact(_) => "exact",
            Evidence::Measured(_) => "measured",
        };
        vec![
            kind.to_string(),
            s.text,
            analysis.evidence_text(&s.evidence, paths),
        ]
    };
    let table = Content::Table {
        caption: "Answers; \"stable\" is never one of them".into(),
        header: ["standing", "answer", "evidence"]
            .map(String::from)
            .to_vec(),
        rows: analysis.sentences().into_iter().map(row).collect(),
    };
    let warning = "Interrupted: what was not done is undecided.";
    let content = if analysis.interrupted {
        vec![Content::Warning(warning.into()), table]
    } else {
        vec![table]
    };
    Section {
        title: "Answers".into(),
        content,
    }
}

fn modes(analysis: &Analysis) -> Section {
    let list = |particles: &[usize]| {
        particles
            .iter()
            .map(usize::to_string)
            .collect::<Vec<_>>()
            .join(" ")
    };
    let row = |(k, m): (usize, &Mode)| {
        let value = mceip_exact::to_f64(&m.lambda2.mid());
        vec![
            (k + 1).to_string(),
            format!("{value:.10e}"),
            format!("{:.6e}", m.growth_rate),
            list(&m.slipping),
            list(&m.sticking),
        ]
    };
    let rows: Vec<Vec<String>> = analysis
        .divergence
        .modes
        .iter()
        .enumerate()
        .map(row)
        .collect();
    if rows.is_empty() {
        return Section {
            title: "Modes".into(),
            content: vec![Content::Paragraph(
                "None was found at this friction.".into(),
            )],
        };
    }
    let header = [
        "mode",
        "lambda^2 (1/s^2)",
        "lambda (1/s)",
        "slipping particles",
        "particles that do not move",
    ];
    let summary = Content::Table {
        caption: "Diverging modes".into(),
        header: header.map(String::from).to_vec(),
        rows,
    };
    let shapes = analysis
        .divergence
        .modes
        .iter()
        .enumerate()
        .map(|(k, m)| Content::Table {
            caption: format!(
                "Mode {}: v over the degrees of freedom that move; the slip rates sum to one",
                k + 1
            ),
            header: ["dof", "v"].map(String::from).to_vec(),
            rows: m
                .v
                .iter()
                .enumerate()
                .filter(|(_, v)| **v != 0.0)
                .map(|(i, v)| vec![i.to_string(), format!("{v:.9}")])
                .collect(),
        });
    Section {
        title: "Modes".into(),
        content: std::iter::once(summary).chain(shapes).collect(),
    }
}
