//! `mceip analyze --report`: the answers, their evidence and the modes on one page.

use crate::picture::{Content, Report, Section};
use mceip_engine::analysis::{Analysis, Evidence, Mode};
use mceip_exact::to_f64;

/// The page; `paths` of the certificates as they were written.
pub(super) fn page(analysis: &Analysis, paths: &[String]) -> String {
    let name = analysis.name.as_deref().unwrap_or("mechanical system");
    let report = Report {
        title: format!("Divergence of {name}"),
        sections: vec![system(analysis), answers(analysis, paths), modes(analysis)],
    };

    report.to_html()
}

/// The sizes of the system.
fn system(analysis: &Analysis) -> Section {
    let [dofs, free, slip, stick] = analysis.sizes;
    let mut rows = vec![
        row(["degrees of freedom", &dofs.to_string()]),
        row(["of them free", &free.to_string()]),
        row(["particles in impending slip", &slip.to_string()]),
        row(["particles that stick", &stick.to_string()]),
        row(["coefficient of friction", &analysis.friction.to_string()]),
    ];
    if analysis.zero > 0 {
        let count = analysis.zero.to_string();
        rows.insert(4, row(["particles with zero reaction", &count]));
    }

    let table = Content::Table {
        caption: "The system, in the units of its file".into(),
        header: row(["", ""]),
        rows,
    };

    Section {
        title: "System".into(),
        content: vec![table],
    }
}

/// Every sentence with what stands behind it; what is only measured is said to be so.
fn answers(analysis: &Analysis, paths: &[String]) -> Section {
    let mut content = vec![Content::Paragraph(analysis.summary())];
    if analysis.interrupted {
        let warning = "Interrupted: what was not done is undecided.";
        content.push(Content::Warning(warning.into()));
    }

    let mut rows = Vec::new();
    for sentence in analysis.sentences() {
        let standing = match &sentence.evidence {
            Evidence::Certificate(_) => "proved",
            Evidence::Exact(_) => "exact",
            Evidence::Measured(_) => "measured",
        };

        let evidence = analysis.evidence_text(&sentence.evidence, paths);
        rows.push(row([standing, &sentence.text, &evidence]));
    }

    content.push(Content::Table {
        caption: "Answers; \"stable\" is never one of them".into(),
        header: row(["standing", "answer", "evidence"]),
        rows,
    });

    Section {
        title: "Answers".into(),
        content,
    }
}

/// The diverging modes: a table of all of them, then the components of each.
fn modes(analysis: &Analysis) -> Section {
    let modes = &analysis.divergence.modes;
    let mut content = Vec::new();
    if modes.is_empty() {
        let none = "None was found at this friction.";
        content.push(Content::Paragraph(none.into()));
    } else {
        content.push(summary(modes));
    }

    for (k, mode) in modes.iter().enumerate() {
        content.push(shape(k + 1, mode));
    }

    Section {
        title: "Modes".into(),
        content,
    }
}

fn summary(modes: &[Mode]) -> Content {
    let header = [
        "mode",
        "lambda^2 (1/s^2)",
        "lambda (1/s)",
        "slipping particles",
        "particles that do not move",
        "particles with zero reaction",
    ];
    let has_zero = modes.iter().any(|mode| !mode.zero.is_empty());
    let columns = if has_zero { 6 } else { 5 };
    let mut rows = Vec::new();
    for (k, mode) in modes.iter().enumerate() {
        let lambda2 = to_f64(&mode.lambda2.mid());
        let mut cells = vec![
            (k + 1).to_string(),
            format!("{lambda2:.10e}"),
            format!("{:.6e}", mode.growth_rate),
            listed(&mode.slipping),
            listed(&mode.sticking),
        ];
        if has_zero {
            cells.push(zero_modes(mode));
        }
        rows.push(cells);
    }

    Content::Table {
        caption: "Diverging modes".into(),
        header: header[..columns].iter().map(ToString::to_string).collect(),
        rows,
    }
}

/// The number and the mode of each particle with zero reaction, such as "3 open, 4 right".
fn zero_modes(mode: &Mode) -> String {
    let mut words = Vec::new();
    for (particle, what) in &mode.zero {
        words.push(format!("{particle} {}", what.word()));
    }

    words.join(", ")
}

/// The components of a mode that are not zero.
fn shape(number: usize, mode: &Mode) -> Content {
    let mut rows = Vec::new();
    for (dof, v) in mode.v.iter().enumerate() {
        if *v != 0.0 {
            rows.push(vec![dof.to_string(), format!("{v:.9}")]);
        }
    }

    Content::Table {
        caption: format!(
            "Mode {number}: v over the degrees of freedom that move; the slip rates sum to one"
        ),
        header: row(["dof", "v"]),
        rows,
    }
}

fn listed(particles: &[usize]) -> String {
    let numbers: Vec<String> = particles.iter().map(usize::to_string).collect();
    numbers.join(" ")
}

fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(String::from).to_vec()
}
