//! Why a device that is there is not read, and what the artist can do.
//!
//! Messages here are English; the window has them in its own language (`app/messages/faults.rs`).

use super::DescriptorError;
use super::device::DeviceInfo;
use super::remedy::{INSTALL_RULES, RULES_FILE, StringsKept};
use super::transport::TransportError;
use thiserror::Error;

/// A device that is there and is not read.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{}: {why}", device.name())]
pub struct Refused {
    /// Which.
    pub device: DeviceInfo,
    /// Why.
    #[source]
    pub why: Refusal,
}

/// Why a device is not read.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum Refusal {
    /// It cannot be opened.
    #[error(transparent)]
    Transport(#[from] TransportError),
    /// Nothing can be made of it.
    #[error(transparent)]
    Choose(#[from] ChooseError),
    /// So many are read that there is no room for one more.
    #[error("{limit} tablets are read already; unplug one")]
    TooMany {
        /// Most that are read.
        limit: usize,
    },
}

impl Refusal {
    /// It may be another answer next time, though the device stays plugged in.
    pub fn may_pass(&self) -> bool {
        match self {
            Self::Transport(_) | Self::TooMany { .. } => true,
            Self::Choose(ChooseError::StringsUnread { reason, .. }) => *reason == StringsKept::Forbidden,
            Self::Choose(ChooseError::UnlistedForbidden) => true,
            Self::Choose(ChooseError::Descriptor(_) | ChooseError::RangesUnread { .. }) => false,
        }
    }

    /// Models that the device may be, of which the artist can choose one.
    pub fn models(&self) -> &[String] {
        match self {
            Self::Choose(ChooseError::StringsUnread { models, .. }) => models,
            _ => &[],
        }
    }
}

/// Why no decoder was found for what may be a pen.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ChooseError {
    /// Its descriptor cannot be understood.
    #[error(transparent)]
    Descriptor(#[from] DescriptorError),
    /// It is a tablet of the table, and only its USB strings would tell which.
    #[error(
        "it may be {} (models that fit: {}), which only its USB strings tell, {}, or choose its model under \
         “Pen and tablet”",
        models.first().map_or("a known tablet", String::as_str),
        models.len(),
        reason.message()
    )]
    StringsUnread {
        /// Models that it may be, the first of the table first.
        models: Vec<String>,
        /// Why the strings are not known.
        reason: StringsKept,
    },
    /// It is not of the table, and the strings in which such tablets say their ranges may not be read.
    #[error(
        "it is not among the tablets that Penstemon knows, and what it says of itself may not be read: install the rule \
         file {RULES_FILE} with the command {INSTALL_RULES}, then plug the tablet in again"
    )]
    UnlistedForbidden,
    /// It is not of the table and did not say its ranges.
    #[error(
        "its firmware {firmware} is not among those that Penstemon knows, and it did not say how large it is; a recording \
         helps to add it: penstemon pen record FILE --strings"
    )]
    RangesUnread {
        /// The firmware's name.
        firmware: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_reason_says_what_to_do() {
        let message = |reason| {
            let models = vec!["Huion H640P".to_owned(), "Huion H950P".to_owned()];
            let why = ChooseError::StringsUnread { models, reason }.into();
            let device = DeviceInfo { product: "HUION Tablet".into(), ..DeviceInfo::default() };
            Refused { device, why }.to_string()
        };
        let forbidden = message(StringsKept::Forbidden);
        for part in ["HUION Tablet: ", "Huion H640P", ": 2)", RULES_FILE, INSTALL_RULES, "“Pen and tablet”"]
        {
            assert!(forbidden.contains(part), "{part} is missing: {forbidden}");
        }
        assert!(message(StringsKept::Wireless).contains("by cable"));
        assert!(message(StringsKept::Unanswered).contains("plug it in again"));
        assert!(message(StringsKept::NotRecorded).contains("--strings"));
    }

    #[test]
    fn only_what_may_change_is_tried_again() {
        let unread = |reason| Refusal::from(ChooseError::StringsUnread { models: vec!["A".into()], reason });
        assert!(unread(StringsKept::Forbidden).may_pass() && !unread(StringsKept::Unanswered).may_pass());
        assert!(Refusal::from(TransportError::forbidden(&DeviceInfo::default())).may_pass());
        assert!(Refusal::from(ChooseError::UnlistedForbidden).may_pass());
        assert!(!Refusal::from(ChooseError::RangesUnread { firmware: "T1".into() }).may_pass());
        assert!(!Refusal::from(ChooseError::from(DescriptorError::Empty)).may_pass());
        assert_eq!(unread(StringsKept::Wireless).models(), ["A"]);
    }
}
