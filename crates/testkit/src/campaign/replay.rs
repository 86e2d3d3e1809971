//! A disagreement as a file that needs nothing else: the shrunk problem, where it came from, what
//! it says.
//!
//! Written by `mceip campaign` for each disagreement, read by `mceip campaign --replay`, which
//! judges the case again. The format is `mceip-replay/1`.

use super::engine::Finding;
use super::expected::Expected;
use super::family::{CampaignCase, Id, case};
use crate::error::TestkitError;
use crate::families::Instance;
use mceip_exact::parse;
use mceip_model::file::{
    from_json_of_with_unique_keys, read_problem, to_pretty_json_of, write_problem,
};
use mceip_oracle::TwoParticles;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The format of a replay file.
pub const REPLAY_FORMAT: &str = "mceip-replay/1";

/// What the file holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Replay {
    /// The family the instance was drawn from.
    pub family: String,
    /// The campaign's seed.
    pub seed: u64,
    /// Its index in the family.
    pub index: u64,
    /// The engine that disagrees with the enumerator.
    pub engine: String,
    /// The kind of disagreement.
    pub kind: String,
    /// What was said of the shrunk problem.
    pub disagreement: String,
    /// What was said of the problem as drawn.
    pub as_drawn: String,
    /// The shrunk problem, `mceip-problem/1`.
    pub problem: serde_json::Value,
    /// Table 1's data, where the closed form takes part.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub closed_form: Option<ClosedForm>,
    /// The shrunk problem is not the one drawn: what is known by construction does not apply to it.
    pub shrunk: bool,
}

/// [`TwoParticles`] as text.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClosedForm {
    c: String,
    s: String,
    k: String,
    m: String,
    mu: String,
    signs: (i8, i8),
}

impl Replay {
    /// The file for a finding: the case as drawn with what it said, and the shrunk one with what
    /// that says.
    pub fn new(drawn: (&CampaignCase, &Finding), shrunk: (&CampaignCase, &Finding)) -> Replay {
        let (case, finding) = shrunk;
        let (drawn_case, drawn_finding) = drawn;
        let closed_form = case.instance.closed_form.as_ref().map(ClosedForm::of);

        // Our own writer's JSON is read without error.
        let problem = write_problem(&case.instance.problem);
        let problem = serde_json::from_str(&problem).unwrap_or_default();

        Replay {
            family: case.id.family.clone(),
            seed: case.id.seed,
            index: case.id.index,
            engine: finding.engine.clone(),
            kind: finding.disagreement.kind().into(),
            disagreement: finding.disagreement.to_string(),
            as_drawn: drawn_finding.disagreement.to_string(),
            problem,
            closed_form,
            shrunk: drawn_case.instance.problem != case.instance.problem,
        }
    }

    /// A name for the file that says where the instance came from.
    pub fn file_name(&self) -> String {
        format!(
            "{}-{}-{}-{}-{}.json",
            self.family,
            self.seed,
            self.index,
            self.engine.replace(' ', "-"),
            self.kind
        )
    }

    /// The file's text.
    pub fn to_json(&self) -> String {
        to_pretty_json_of(REPLAY_FORMAT, self)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`TestkitError`] for what is not one.
    pub fn from_json(text: &str) -> Result<Replay, TestkitError> {
        Ok(from_json_of_with_unique_keys(REPLAY_FORMAT, text)?)
    }

    /// The case to judge again. Where the instance is as drawn, what is known by construction comes
    /// with it.
    ///
    /// # Errors
    /// [`TestkitError`] for a problem or data that are refused.
    pub fn case(&self) -> Result<CampaignCase, TestkitError> {
        let id = Id {
            family: self.family.clone(),
            seed: self.seed,
            index: self.index,
        };

        let problem = read_problem(&self.problem.to_string(), Path::new("."))?;
        let closed_form = match &self.closed_form {
            Some(text) => Some(text.data()?),
            None => None,
        };

        let drawn = if self.shrunk {
            None
        } else {
            case(&id).ok().and_then(Result::ok)
        };
        let expected = match drawn {
            Some(drawn) if drawn.instance.problem == problem => drawn.expected,
            _ => Expected::default(),
        };

        let instance = Instance {
            label: format!("{id} (replay)"),
            problem,
            closed_form,
            corners: Vec::new(),
        };

        Ok(CampaignCase {
            id,
            instance,
            expected,
        })
    }
}

impl ClosedForm {
    fn of(data: &TwoParticles) -> ClosedForm {
        ClosedForm {
            c: data.c.to_string(),
            s: data.s.to_string(),
            k: data.k.to_string(),
            m: data.m.to_string(),
            mu: data.mu.to_string(),
            signs: data.signs,
        }
    }

    fn data(&self) -> Result<TwoParticles, TestkitError> {
        Ok(TwoParticles {
            c: parse(&self.c)?,
            s: parse(&self.s)?,
            k: parse(&self.k)?,
            m: parse(&self.m)?,
            mu: parse(&self.mu)?,
            signs: self.signs,
        })
    }
}
