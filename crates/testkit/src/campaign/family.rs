//! The families of the campaign by name, and their instances by number.
//!
//! Input: `family:seed:index`. Output: the instance, the same on every machine. The generators are
//! in `named`.

use super::expected::{Expected, Made};
use super::named;
use crate::error::TestkitError;
use crate::families::Instance;
use crate::generators::Seed;
use mceip_model::ModelError;
use std::fmt;

/// An instance of a family, and what is known of it.
#[derive(Debug, Clone)]
pub struct CampaignCase {
    /// Its three numbers.
    pub id: Id,
    /// The problem, with Table 1's data and the corners known by construction.
    pub instance: Instance,
    /// What else is known by construction.
    pub expected: Expected,
}

/// The name of an instance: `family:seed:index`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Id {
    /// Name of the family, from [`FAMILIES`].
    pub family: String,
    /// The campaign's seed.
    pub seed: u64,
    /// Index within the family.
    pub index: u64,
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.family, self.seed, self.index)
    }
}

/// The refusal of a family that does not exist, or of one named twice.
pub fn family_error(name: &str) -> TestkitError {
    let names: Vec<&str> = FAMILIES.iter().map(|f| f.0).collect();
    TestkitError::Family {
        families: names.join(", "),
        name: name.to_string(),
    }
}

/// How an instance of a family is made.
pub(super) type Make = fn(&Seed) -> Result<Made, ModelError>;

/// Name, what it holds, and how an instance is made.
#[rustfmt::skip]
pub const FAMILIES: [(&str, &str, Make); 21] = [
    ("table1", "the two particles of Fig. 1 at random rational angles, with the closed form",
        named::table1),
    ("table1-near",
        "the same with mu at a relative distance of 0 or 10^-3 to 10^-15 from a threshold",
        named::table1_near),
    ("elements", "random pencils as finite elements have them, free variables, windows",
        named::elements),
    ("states",
        "mechanical systems with every mixture of free, stick and slip, oblique, both normals",
        named::states),
    ("systems", "mechanical systems of up to four particles", named::systems),
    ("pencils", "the random pencils of verify", named::pencils),
    ("digits", "one-digit integers, raw", named::digits),
    ("integers", "six-digit integers, raw", named::integers),
    ("doubles", "doubles of 53 bits over six decades, raw", named::doubles),
    ("zeros", "three quarters zeros: singular supports, ties", named::zeros),
    ("identity", "B = I, small integers: repeated and zero eigenvalues", named::identity),
    ("graph", "adjacency matrices of random graphs: cones", named::graph),
    ("doubled", "a particle that is another's double: wide kernels", named::doubled),
    ("free-anywhere", "free variables anywhere: outside Propositions 1 and 2",
        named::free_anywhere),
    ("degenerate", "hand-made corners under row scaling and permutation", named::degenerate),
    ("known", "paths, cycles, stars, Jordan blocks, ...: the whole answer by theorem",
        named::known),
    ("pareto", "Pareto matrices with a known number of solutions, raw and as systems",
        named::pareto),
    ("planted", "a rational solution planted, biactive indices, windows that end beside it",
        named::planted),
    ("near", "planted biactive and repeated roots, moved by 10^-3 to 10^-15", named::near),
    ("scales", "Hilbert sections, bad scaling, 10^12 to 10^60 and their inverses", named::scales),
    ("eigenvalues", "eigenvalue problems, of pencils and of quadratic ones", named::eigenvalues),
];

/// The instance with this name.
///
/// # Errors
/// [`TestkitError::Family`]; [`ModelError`] as text cannot occur for the families as they are, and
/// is a disagreement of the campaign if it does.
pub fn case(id: &Id) -> Result<Result<CampaignCase, ModelError>, TestkitError> {
    let number = FAMILIES
        .iter()
        .position(|f| f.0 == id.family)
        .ok_or_else(|| family_error(&id.family))?;

    let (_, _, make) = FAMILIES[number];
    let made = make(&Seed {
        family: number as u64,
        seed: id.seed,
        index: id.index,
    });

    Ok(made.map(|made| CampaignCase {
        id: id.clone(),
        instance: Instance {
            label: id.to_string(),
            ..made.instance
        },
        expected: made.expected,
    }))
}
