//! What a campaign has done so far: counts per family, as a file to go on from.
//!
//! Instances are taken in a fixed order, so the state holds how many are done and the counts. The
//! format is `mceip-campaign/1`. Written and read by `mceip campaign --state`; the counts are held
//! against the floors of `floors`.

use super::family::Id;
use crate::error::TestkitError;
use crate::floors::{Covered, Shortfall};
use crate::tally::Tally;
use mceip_model::file::{from_json_of_with_unique_keys, to_json_of, to_pretty_json_of};
use mceip_model::sha256;
use serde::{Deserialize, Serialize};

/// The format of a state file.
pub const STATE_FORMAT: &str = "mceip-campaign/1";

/// A campaign so far. Instances are taken in a fixed order, so one number says which are done.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct State {
    /// The campaign's seed.
    pub seed: u64,
    /// Part of so many, from 0.
    pub shard: (u64, u64),
    /// Families by name, in order.
    pub families: Vec<String>,
    /// Instances done, in the campaign's order.
    pub done: u64,
    /// Counts, one per family.
    pub tallies: Vec<Tally>,
    /// Digest of all the rest; absent in state files written before there was one, and in a state
    /// that is not read from a file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    sha256: Option<String>,
}

/// The most instances of each family in a campaign.
pub const MAX_INSTANCES: u64 = 1_000_000_000;

impl State {
    /// Nothing done yet.
    pub fn new(seed: u64, shard: (u64, u64), families: Vec<String>) -> State {
        let tallies = vec![Tally::default(); families.len()];
        State {
            seed,
            shard,
            families,
            done: 0,
            tallies,
            sha256: None,
        }
    }

    /// The `k`-th instance of this part: families in turn, every n-th index.
    pub fn id(&self, k: u64) -> Id {
        let count = self.families.len() as u64;
        let family = self.families[(k % count) as usize].clone();

        let (part, parts) = self.shard;
        Id {
            family,
            seed: self.seed,
            index: k / count * parts + part,
        }
    }

    /// Disagreements in all families, shortfalls among them.
    pub fn disagreements(&self) -> usize {
        let mut count = self.shortfalls().len();
        for tally in &self.tallies {
            count += tally.disagreements.len();
        }
        count
    }

    /// Coverage of each family and kind of start that was met.
    pub fn covered(&self) -> Vec<Covered> {
        let families = self.families.iter().zip(&self.tallies);
        families
            .flat_map(|(family, tally)| tally.covered(family))
            .collect()
    }

    /// Rates that are below their floors by more than chance explains: findings of a family, not of
    /// an instance.
    pub fn shortfalls(&self) -> Vec<Shortfall> {
        self.covered()
            .iter()
            .flat_map(Covered::shortfalls)
            .collect()
    }

    /// Instances judged in all families.
    pub fn instances(&self) -> u64 {
        self.tallies.iter().map(|t| t.instances).sum()
    }

    /// The file's text, with the digest of what it says.
    pub fn to_json(&self) -> String {
        let bound = State {
            sha256: Some(self.digest()),
            ..self.clone()
        };
        to_pretty_json_of(STATE_FORMAT, &bound)
    }

    /// The SHA-256 of the state without its digest, as JSON in one line. It holds seed, part and
    /// families, so that a state is bound to its run.
    fn digest(&self) -> String {
        let plain = State {
            sha256: None,
            ..self.clone()
        };
        sha256(&to_json_of(STATE_FORMAT, &plain))
    }

    /// Was it read with a digest that binds it to its run?
    pub fn is_bound(&self) -> bool {
        self.sha256.is_some()
    }

    /// Refuses a state whose digest is that of another one: edited, or cut short.
    fn require_own_digest(&self) -> Result<(), TestkitError> {
        let expected = self.digest();
        match &self.sha256 {
            Some(got) if *got != expected => Err(TestkitError::StateDigest {
                expected,
                got: got.chars().take(80).collect(),
            }),
            _ => Ok(()),
        }
    }

    /// Refuses counts of instances other than those that the number done tells: families are taken
    /// in turn.
    fn require_counts(&self) -> Result<(), TestkitError> {
        let families = self.families.len() as u64;
        let most = families.saturating_mul(MAX_INSTANCES);
        if self.done > most {
            return Err(TestkitError::StateCount {
                what: "instances done".into(),
                expected: format!("at most {most}"),
                got: self.done,
            });
        }

        for (k, (family, tally)) in self.families.iter().zip(&self.tallies).enumerate() {
            let is_one_ahead = (k as u64) < self.done % families;
            let expected = self.done / families + u64::from(is_one_ahead);
            if tally.instances != expected {
                return Err(TestkitError::StateCount {
                    what: format!("instances of {family}"),
                    expected: format!("{expected}, as {} are done in all", self.done),
                    got: tally.instances,
                });
            }
        }

        Ok(())
    }

    /// Reads a state and refuses one that was made with other settings than `self`, one whose
    /// digest is not its own, and one whose counts of instances do not fit together.
    ///
    /// # Errors
    /// [`TestkitError`].
    pub fn resumed(&self, text: &str) -> Result<State, TestkitError> {
        let state: State = from_json_of_with_unique_keys(STATE_FORMAT, text)?;
        state.require_own_digest()?;
        state.require_counts()?;

        for (expected, got) in self.settings().into_iter().zip(state.settings()) {
            if expected.value != got.value {
                return Err(TestkitError::OtherCampaign {
                    what: expected.what,
                    expected: expected.value,
                    got: got.value,
                });
            }
        }
        Ok(state)
    }

    /// What has to be the same in a state that is gone on from.
    fn settings(&self) -> [Setting; 4] {
        [
            Setting {
                what: "seed",
                value: self.seed.to_string(),
            },
            Setting {
                what: "shard",
                value: format!("{:?}", self.shard),
            },
            Setting {
                what: "families",
                value: self.families.join(" "),
            },
            Setting {
                what: "tallies",
                value: self.tallies.len().to_string(),
            },
        ]
    }
}

/// A setting of a campaign, as an error names it.
struct Setting {
    what: &'static str,
    value: String,
}
