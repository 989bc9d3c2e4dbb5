//! Messages that wait to be read.

use super::dialog::PathPurpose;

/// How serious a notice is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Severity {
    /// Something went well.
    #[default]
    Info,
    /// Something is odd.
    Warning,
    /// Something failed.
    Error,
}

/// A message: what happened and what the artist can do.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Notice {
    /// Names it when it is dismissed; the application counts.
    pub id: u64,
    /// How serious it is.
    pub severity: Severity,
    /// What happened.
    pub what: String,
    /// What the artist can do, empty where nothing is needed.
    pub remedy: String,
    /// What another file can be chosen for, where that mends it.
    pub find: Option<PathPurpose>,
}

impl Notice {
    /// Something went as it should.
    pub fn info(what: impl Into<String>) -> Self {
        Self { what: what.into(), ..Self::default() }
    }

    /// Something odd.
    pub fn warning(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, what: what.into(), remedy: remedy.into(), ..Self::default() }
    }

    /// Something failed.
    pub fn error(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { severity: Severity::Error, ..Self::warning(what, remedy) }
    }
}
