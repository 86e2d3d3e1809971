//! What the verified checker answers about one certificate.

/// A verdict of `mceip-verified`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum VerifiedVerdict {
    /// Accepted: the statement that is proved, one line for each sentence.
    Accepted(Vec<String>),
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

        match (code?, word) {
            (0, "ACCEPTED, VERIFIED") => {
                let mut statement = vec![rest];
                statement.extend(output.lines().skip(1).map(String::from));
                Some(VerifiedVerdict::Accepted(statement))
            }
            (1, "REJECTED") => Some(VerifiedVerdict::Rejected(rest)),
            (2, "MALFORMED") => Some(VerifiedVerdict::Malformed(rest)),
            (3, "NOT VERIFIED") => Some(VerifiedVerdict::NotVerified(rest)),
            _ => None,
        }
    }

    /// Is the statement proved?
    pub fn is_accepted(&self) -> bool {
        matches!(self, VerifiedVerdict::Accepted(_))
    }

    /// Why the certificate is refused, if it is. "Not verified" is no refusal.
    pub fn refusal(&self) -> Option<String> {
        match self {
            VerifiedVerdict::Accepted(_) | VerifiedVerdict::NotVerified(_) => None,
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
        let accepted = "ACCEPTED, VERIFIED: exactly one solution in [0, 1]\nsolution: value in";
        let lines = accepted.trim_start_matches("ACCEPTED, VERIFIED: ").lines();
        let statement: Vec<String> = lines.map(String::from).collect();
        assert_eq!(
            Verdict::read(Some(0), accepted),
            Some(Verdict::Accepted(statement))
        );

        let rejected = Verdict::read(Some(1), "REJECTED: no claim\n").unwrap();
        assert_eq!(rejected, Verdict::Rejected("no claim".into()));
        assert!(rejected.refusal().is_some());

        let open = Verdict::read(Some(3), "NOT VERIFIED: open\n").unwrap();
        assert_eq!(open, Verdict::NotVerified("open".into()));
        assert!(!open.is_accepted());
        assert_eq!(open.refusal(), None);

        // A crash of an OCaml program has exit code 2 and nothing on stdout.
        assert_eq!(Verdict::read(Some(2), ""), None);
        assert_eq!(Verdict::read(Some(0), "REJECTED: no claim"), None);
        assert_eq!(Verdict::read(Some(0), ""), None);
        assert_eq!(Verdict::read(Some(1), accepted), None);
        assert_eq!(Verdict::read(None, accepted), None);
    }
}
