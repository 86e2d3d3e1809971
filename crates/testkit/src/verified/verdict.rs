//! What the verified checker answers about one certificate.

/// A verdict of `mceip-verified`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum VerifiedVerdict {
    /// Accepted: the statement that is proved, one line for each sentence.
    Accepted(Vec<String>),
    /// The same where regions are left open: the proved statement names them.
    Undecided(Vec<String>),
    /// Rejected, with the reason.
    Rejected(String),
    /// No file of the format, with the reason.
    Malformed(String),
    /// No theorem for this evidence, or no witness found: what is missing.
    NotVerified(String),
    /// The program ended without a verdict: how.
    None(String),
}

impl VerifiedVerdict {
    /// Reads exit code and output. `None` if they are no verdict.
    pub fn read(code: Option<i32>, output: &str) -> Option<VerifiedVerdict> {
        let first_line = output.lines().next().unwrap_or_default();
        let (word, rest) = first_line.split_once(": ").unwrap_or((first_line, ""));
        let rest = rest.to_string();

        let statement = || {
            let others = output.lines().skip(1).map(String::from);
            std::iter::once(rest.clone()).chain(others).collect()
        };

        match (code?, word) {
            (0, "ACCEPTED, VERIFIED") => Some(VerifiedVerdict::Accepted(statement())),
            (3, "UNDECIDED, VERIFIED") => Some(VerifiedVerdict::Undecided(statement())),
            (1, "REJECTED") => Some(VerifiedVerdict::Rejected(rest)),
            (2, "MALFORMED") => Some(VerifiedVerdict::Malformed(rest)),
            (4, "NOT VERIFIED") => Some(VerifiedVerdict::NotVerified(rest)),
            _ => None,
        }
    }

    /// The statement that is proved, if one is.
    pub fn statement(&self) -> Option<&[String]> {
        match self {
            VerifiedVerdict::Accepted(lines) | VerifiedVerdict::Undecided(lines) => Some(lines),
            _ => None,
        }
    }

    /// Why the certificate is refused, if it is. "Not verified" is no refusal.
    pub fn refusal(&self) -> Option<String> {
        match self {
            VerifiedVerdict::Accepted(_)
            | VerifiedVerdict::Undecided(_)
            | VerifiedVerdict::NotVerified(_) => None,
            VerifiedVerdict::Rejected(reason) => Some(format!("rejected: {reason}")),
            VerifiedVerdict::Malformed(reason) => Some(format!("malformed: {reason}")),
            VerifiedVerdict::None(ending) => Some(format!("no verdict: {ending}")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::VerifiedVerdict as Verdict;

    #[test]
    fn code_and_word_must_agree() {
        let accepted = "ACCEPTED, VERIFIED: 1 solution in [0, 1], and no other\nsolution: mu in";
        let lines = accepted.trim_start_matches("ACCEPTED, VERIFIED: ").lines();
        let statement: Vec<String> = lines.map(String::from).collect();
        assert_eq!(
            Verdict::read(Some(0), accepted),
            Some(Verdict::Accepted(statement))
        );

        let rejected = Verdict::read(Some(1), "REJECTED: no claim\n").unwrap();
        assert_eq!(rejected, Verdict::Rejected("no claim".into()));
        assert!(rejected.refusal().is_some());

        let open = Verdict::read(Some(4), "NOT VERIFIED: open\n").unwrap();
        assert_eq!(open, Verdict::NotVerified("open".into()));
        assert_eq!(open.statement(), None);
        assert_eq!(open.refusal(), None);

        let undecided = "UNDECIDED, VERIFIED: no solution in [0, 1] outside 1 open region";
        let undecided = Verdict::read(Some(3), undecided).unwrap();
        assert_eq!(undecided.statement().map(<[String]>::len), Some(1));
        assert_eq!(undecided.refusal(), None);

        // A crash of an OCaml program has exit code 2 and nothing on stdout.
        assert_eq!(Verdict::read(Some(2), ""), None);
        assert_eq!(Verdict::read(Some(0), "REJECTED: no claim"), None);
        assert_eq!(Verdict::read(Some(0), ""), None);
        assert_eq!(Verdict::read(Some(1), accepted), None);
        assert_eq!(Verdict::read(Some(3), "NOT VERIFIED: open\n"), None);
        assert_eq!(Verdict::read(Some(4), "UNDECIDED, VERIFIED: "), None);
        assert_eq!(Verdict::read(None, accepted), None);
    }
}
