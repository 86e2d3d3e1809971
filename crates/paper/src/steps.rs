//! Loads of a model of one's own, as a CSV table or as the `*CLOAD` lines of a CalculiX input file:
//! what `mceip convert --loads` reads.
//!
//! The header of the table names the columns, in any order. Needed are `step` (a name; a step is
//! all lines of one name, in the order in which the names first appear) and `dof`. One of the
//! optional columns `force` and `displacement` holds a number; a displaced degree of freedom is
//! held in all steps.
//!
//! Of a file of CalculiX every `*STEP` with `*STATIC` whose `*CLOAD` lines change something is a
//! step, named after its number among all steps. CalculiX states what acts at the end of a step (a
//! degree of freedom named twice in a step: the sum), and a [`LoadStep`] what comes on top, so that
//! the loads before are subtracted. What would make these forces mean something else is refused by
//! name: other keywords in a step, parameters of `*CLOAD`, displacements of `*BOUNDARY` other than
//! 0 (the matrices that CalculiX writes have no degree of freedom for them), turned axes, other
//! files.

use crate::calculix::CalculixError;
use crate::lines::lines_with_content;
use crate::table::{Layout, TableError};
use mceip_exact::{Rational, parse};
use mceip_model::LoadStep;
use num_traits::Zero;
use std::collections::BTreeMap;

/// Why loads are refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum StepsError {
    /// A table that is not read.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A file of CalculiX that is not read.
    #[error("loads {0}")]
    Calculix(#[from] CalculixError),
    /// No load at all.
    #[error(
        "loads: expected at least one line with a force or a displacement (in a file of CalculiX: \
         *CLOAD in a *STEP), got none"
    )]
    Empty,
}

const LAYOUT: Layout<4> = Layout {
    table: "loads",
    columns: ["step", "dof", "force", "displacement"],
    needed: 2,
    in_words: "step, dof, and force or displacement or both",
};
const STEP: usize = 0;
const DOF: usize = 1;
const FORCE: usize = 2;
const DISPLACEMENT: usize = 3;

/// Reads loads. `dof` finds the 0-based degree of freedom that a cell names (an index, or a node
/// and direction of a `.dof` file).
///
/// # Errors
/// [`StepsError`] with its line.
pub fn read_steps(
    text: &str,
    dof: &dyn Fn(&str) -> Option<usize>,
) -> Result<Vec<LoadStep>, StepsError> {
    let first = lines_with_content(text).into_iter().next();
    let is_calculix = first.is_some_and(|line| line.text.starts_with('*'));
    let steps = if is_calculix {
        calculix_steps(text, dof)?
    } else {
        table_steps(text, dof)?
    };

    if steps.is_empty() {
        return Err(StepsError::Empty);
    }
    Ok(steps)
}

fn table_steps(
    text: &str,
    dof: &dyn Fn(&str) -> Option<usize>,
) -> Result<Vec<LoadStep>, TableError> {
    let mut steps: Vec<LoadStep> = Vec::new();
    let table = LAYOUT.read(text)?;
    let given = if table.has[FORCE] {
        FORCE
    } else {
        DISPLACEMENT
    };
    for row in table.rows {
        let name = row.cells[STEP];
        if name.is_empty() {
            return Err(row.unexpected(STEP, "a name"));
        }
        let place = steps.iter().position(|step| step.name == name);
        let place = place.unwrap_or_else(|| {
            steps.push(named(name));
            steps.len() - 1
        });

        let expected = "a degree of freedom: a number from 0, with --dof node.direction";
        let index = row.dof(DOF, expected, dof)?;
        let index = index.ok_or_else(|| row.unexpected(DOF, expected))?;
        match (
            row.cells[FORCE].is_empty(),
            row.cells[DISPLACEMENT].is_empty(),
        ) {
            (false, true) => steps[place].forces.push((index, row.number(FORCE)?)),
            (true, false) => {
                let value = row.number(DISPLACEMENT)?;
                steps[place].displacements.push((index, value));
            }
            (true, true) => return Err(row.unexpected(given, "a force or a displacement")),
            (false, false) => {
                return Err(row.unexpected(DISPLACEMENT, "nothing beside a force"));
            }
        }
    }

    Ok(steps)
}

fn named(name: &str) -> LoadStep {
    LoadStep {
        name: name.into(),
        forces: Vec::new(),
        displacements: Vec::new(),
        is_endless: false,
    }
}

/// What the lines below a keyword of CalculiX are.
enum CardBlock {
    Cload,
    /// Inside of a step, so that it may prescribe displacements.
    Boundary,
    Other,
}

/// Keywords, without blanks, that may stand in a step.
const IN_STEP: [&str; 14] = [
    "*STATIC",
    "*FREQUENCY",
    "*CLOAD",
    "*BOUNDARY",
    "*ENDSTEP",
    "*NODEFILE",
    "*ELFILE",
    "*CONTACTFILE",
    "*NODEOUTPUT",
    "*ELEMENTOUTPUT",
    "*NODEPRINT",
    "*ELPRINT",
    "*CONTROLS",
    "*OUTPUT",
];

/// The steps of an input file of CalculiX, read line by line.
#[derive(Default)]
struct Calculix {
    steps: Vec<LoadStep>,
    /// Number of the step that is read, from 1.
    number: usize,
    is_in_step: bool,
    /// Has the step that is read begun with `*STATIC`?
    is_static: bool,
    /// What acts at the end of the step before.
    before: BTreeMap<usize, Rational>,
    /// What the step that is read says.
    named: BTreeMap<usize, Rational>,
}

fn calculix_steps(
    text: &str,
    dof: &dyn Fn(&str) -> Option<usize>,
) -> Result<Vec<LoadStep>, CalculixError> {
    let mut read = Calculix::default();
    let mut block = CardBlock::Other;
    let mut last = 1;
    for line in lines_with_content(text) {
        last = line.number;
        let refuse = |expected: &'static str| CalculixError::at(line.number, expected, line.text);
        if line.text.starts_with("**") {
            continue;
        }
        if line.text.starts_with('*') {
            block = read.keyword(line.text).map_err(refuse)?;
            continue;
        }

        let cells: Vec<&str> = line.text.split(',').map(str::trim).collect();
        match block {
            CardBlock::Other => {}
            CardBlock::Cload => read.force(&cells, dof).map_err(refuse)?,
            CardBlock::Boundary => {
                let value = cells
                    .get(3)
                    .map_or(Ok(Rational::zero()), |value| parse(value));
                if !value.is_ok_and(|value| value.is_zero()) {
                    return Err(refuse(
                        "a held degree of freedom (the matrices of CalculiX know no displaced one)",
                    ));
                }
            }
        }
    }

    if read.is_in_step {
        return Err(CalculixError::at(last, "*END STEP", "the end of the file"));
    }
    Ok(read.steps)
}

impl Calculix {
    /// What the lines below a keyword line are.
    ///
    /// # Errors
    /// What was expected in its place.
    fn keyword(&mut self, line: &str) -> Result<CardBlock, &'static str> {
        let mut words = line.to_ascii_uppercase();
        words.retain(|c| !c.is_whitespace());
        let (keyword, parameters) = words.split_once(',').unwrap_or((&words, ""));

        match keyword {
            "*INCLUDE" => return Err("one file, without *INCLUDE"),
            "*TRANSFORM" => return Err("forces along x, y and z, without *TRANSFORM"),
            "*CLOAD" if !self.is_static => return Err("*CLOAD in a *STEP, after *STATIC"),
            _ if self.is_in_step && !IN_STEP.contains(&keyword) => {
                return Err("forces at nodes, *CLOAD, in steps of *STATIC, as the only loads");
            }
            _ => {}
        }

        Ok(match keyword {
            "*STEP" => {
                self.is_in_step = true;
                self.is_static = false;
                self.number += 1;
                CardBlock::Other
            }
            "*STATIC" => {
                self.is_static = self.is_in_step;
                CardBlock::Other
            }
            "*ENDSTEP" => {
                self.is_in_step = false;
                self.is_static = false;
                self.end_step();
                CardBlock::Other
            }
            "*CLOAD" if parameters.is_empty() || parameters == "OP=MOD" => CardBlock::Cload,
            "*CLOAD" => return Err("*CLOAD without parameters, or with OP=MOD"),
            "*BOUNDARY" if self.is_in_step => CardBlock::Boundary,
            _ => CardBlock::Other,
        })
    }

    /// A line of `*CLOAD`: a degree of freedom named again in the same step gets the sum.
    ///
    /// # Errors
    /// What was expected.
    fn force(
        &mut self,
        cells: &[&str],
        dof: &dyn Fn(&str) -> Option<usize>,
    ) -> Result<(), &'static str> {
        let expected = "node, direction, force; node.direction a line of the .dof file (--dof)";
        let [node, direction, force] = cells else {
            return Err(expected);
        };
        let index = dof(&format!("{node}.{direction}")).ok_or(expected)?;
        *self.named.entry(index).or_default() += parse(force).map_err(|_| expected)?;
        Ok(())
    }

    /// Takes down what comes on top of the loads before.
    fn end_step(&mut self) {
        let mut acting = self.before.clone();
        acting.extend(std::mem::take(&mut self.named));
        let name = format!("step {}", self.number);
        self.steps.extend(increment(&name, &self.before, &acting));
        self.before = acting;
    }
}

/// What comes on top of the loads before; nothing where nothing does.
fn increment(
    name: &str,
    before: &BTreeMap<usize, Rational>,
    acting: &BTreeMap<usize, Rational>,
) -> Option<LoadStep> {
    let mut step = named(name);
    for (&dof, force) in acting {
        let more = match before.get(&dof) {
            Some(earlier) => force - earlier,
            None => force.clone(),
        };
        if !more.is_zero() {
            step.forces.push((dof, more));
        }
    }

    (!step.forces.is_empty()).then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    fn read(text: &str) -> Result<Vec<LoadStep>, StepsError> {
        read_steps(text, &|name| match name {
            "4.1" => Some(0),
            "4.2" => Some(1),
            index => index.parse().ok().filter(|dof| *dof < 4),
        })
    }

    #[test]
    fn a_table_has_a_step_for_each_name() {
        let table = "step,dof,force,displacement\npress,1,-5,\n# drag\npull,0,,1/2\npress,3,2e1,\n";
        let steps = read(table).unwrap();

        let names: Vec<&str> = steps.iter().map(|step| step.name.as_str()).collect();
        assert_eq!(names, ["press", "pull"]);
        assert_eq!(steps[0].forces, [(1, whole(-5)), (3, whole(20))]);
        assert_eq!(steps[1].displacements, [(0, parse("1/2").unwrap())]);
    }

    #[test]
    fn a_step_of_calculix_is_what_comes_on_top() {
        let file = "*NODE\n4,0.,1.\n*BOUNDARY\n1,1,2\n** loads\n*STEP\n*STATIC\n*CLOAD\n4,2,-3.\n\
                    *END STEP\n*STEP\n*STATIC\n*Cload\n4, 1, 2.5\n4,2,-4\n*END STEP\n*STEP\n\
                    *FREQUENCY\n*END STEP\n";
        let steps = read(file).unwrap();

        assert_eq!(steps.len(), 2);
        assert_eq!(steps[0].forces, [(1, whole(-3))]);
        assert_eq!(
            steps[1].forces,
            [(0, parse("2.5").unwrap()), (1, whole(-1))]
        );
    }

    #[test]
    fn loads_are_refused_with_their_line() {
        for (text, word) in [
            ("", "columns step, dof"),
            ("step,dof\n", "at least one line"),
            ("step,dof,force\na,9,1\n", "line 2, column dof"),
            ("step,dof,force\na,,1\n", "line 2, column dof"),
            ("step,dof,force\na,0,\n", "a force or a displacement"),
            (
                "step,dof,force,displacement\na,0,1,1\n",
                "nothing beside a force",
            ),
            ("step,dof,force\na,0,much\n", "a number"),
            ("*STEP\n*STATIC\n*CLOAD\nTOP,2,-1.\n", "line 4"),
            ("*STEP\n*FREQUENCY\n*CLOAD\n4,2,-1.\n", "after *STATIC"),
            ("*STEP\n*STATIC\n*CLOAD\n4,2,x\n", "line 4"),
            ("*STEP\n*STATIC\n*CLOAD, OP = NEW\n", "OP=MOD"),
            (
                "*STEP\n*STATIC\n*CLOAD, AMPLITUDE=A1\n",
                "without parameters",
            ),
            ("*CLOAD\n4,2,1.\n", "in a *STEP, after *STATIC"),
            ("*STEP\n*STATIC\n*CLOAD\n4,2,1.\n", "*END STEP"),
            ("*STEP\n*DYNAMIC\n", "steps of *STATIC"),
            ("*INCLUDE, INPUT=x\n", "without *INCLUDE"),
            ("*TRANSFORM, NSET=N\n", "without *TRANSFORM"),
            ("step,dof,force\n,0,1\n", "column step"),
            ("step,dof,displacement\na,0,\n", "column displacement"),
            ("*STEP\n*DLOAD\nEALL,P1,1.\n", "as the only loads"),
            ("*STEP\n*BOUNDARY\n4,1,1,0.5\n", "a held degree of freedom"),
            ("*NODE\n1,0.,0.\n", "at least one line"),
        ] {
            let error = read(text).unwrap_err().to_string();
            assert!(error.contains(word), "{text:?}: {error}");
        }
    }
}
