//! What goes wrong, in the language of the interface.
//!
//! Errors say in English what was wrong, where, and what to do. Those that an artist meets have texts in the message files
//! too, chosen by their kind; the English ones are word for word what the errors say. What has no text there stays
//! English: the system's own words, what is wrong inside a damaged file, failures of drivers.

use super::{Messages, Msg};
use crate::app::worker::BuildError;
use crate::atomic::WriteError;
use crate::formats::write::ExportError;
use crate::input::Overwrites;
use crate::params::ParamError;
use crate::pen::hid::remedy::{INSTALL_RULES, RULES_FILE, RULES_FOLDER, Remedy};
use crate::pen::hid::{ChooseError, Refusal, Refused, StringsKept, TransportError};
use crate::picture::PictureError;
use crate::pipeline::SetupError;
use crate::render::RenderError;
use crate::sketch::document::ChangeError;
use crate::sketch::error::{Fault, Place};
use crate::sketch::journal::{Gap, JournalError};
use crate::sketch::reference::ReferenceError;
use crate::sketch::save::SaveError;
use crate::sketch::{PlantFault, PlantsError, SketchError, limits};
use crate::species::SpeciesError;
use crate::species::file::MAX_BYTES as MAX_SPECIES_BYTES;
use std::fmt::Display;

/// Something that went wrong, in words for the artist.
pub trait Localize: Display {
    /// What happened and what to do, in the language of `messages` where there are words for it.
    fn localize(&self, _messages: &Messages) -> String {
        self.to_string()
    }
}

impl Localize for String {}
impl Localize for std::io::Error {}
impl Localize for RenderError {}
impl Localize for crate::app::presets::PresetError {}

impl Localize for WriteError {
    fn localize(&self, messages: &Messages) -> String {
        let file = |path: &std::path::Path| path.display().to_string();
        match self {
            Self::NoFolder { path, folder } => {
                messages.fill(Msg::ErrorNoFolder, &[("file", &file(path)), ("folder", &file(folder))])
            }
            Self::Denied { path, folder } => {
                messages.fill(Msg::ErrorDenied, &[("file", &file(path)), ("folder", &file(folder))])
            }
            Self::DiskFull { path } => messages.fill(Msg::ErrorDiskFull, &[("file", &file(path))]),
            Self::Io { path, source } => {
                messages.fill(Msg::ErrorWrite, &[("file", &file(path)), ("reason", source)])
            }
            Self::Occupied { .. } => self.to_string(),
        }
    }
}

impl Localize for SaveError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::ChangedByOthers { path } => messages.fill(Msg::ErrorChanged, &[("file", &path.display())]),
            Self::NewerVersion { path, version } => {
                messages.fill(Msg::ErrorNewer, &[("file", &path.display()), ("version", version)])
            }
            Self::ReadOnly { path } => messages.fill(Msg::ErrorReadOnly, &[("file", &path.display())]),
            Self::TooLarge { bytes } => messages.fill(
                Msg::ErrorTooLarge,
                &[("size", &(bytes >> 20)), ("limit", &(limits::MAX_FILE_BYTES >> 20))],
            ),
            Self::Write(error) => messages.fill(Msg::ErrorElsewhere, &[("error", &error.localize(messages))]),
        }
    }
}

impl Localize for SketchError {
    fn localize(&self, messages: &Messages) -> String {
        let fault = match &self.fault {
            Fault::Io(error) => messages.fill(Msg::ErrorUnreadable, &[("reason", error)]),
            Fault::FileTooLarge => {
                messages.fill(Msg::ErrorFileTooLarge, &[("limit", &(limits::MAX_FILE_BYTES >> 20))])
            }
            Fault::Empty => messages.get(Msg::ErrorEmpty).to_owned(),
            Fault::NotADrawing { found } => messages.fill(Msg::ErrorNotADrawing, &[("found", found)]),
            Fault::Truncated => messages.get(Msg::ErrorTruncated).to_owned(),
            Fault::Picture(error) => error.localize(messages),
            Fault::Reference(error) => error.localize(messages),
            other => other.to_string(),
        };
        let place = place(&self.place, messages);
        format!("{}: {place}{fault}", self.file)
    }
}

/// Where in a file; a line is enough for whoever opens the file to look.
fn place(place: &Place, messages: &Messages) -> String {
    match place {
        Place { line_column: Some((line, column)), stroke: None, id: None, point: None } => {
            let at = messages.fill(Msg::ErrorPlace, &[("line", line), ("column", column)]);
            format!("{at}: ")
        }
        other => other.to_string(),
    }
}

impl Localize for PictureError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::Unreadable(reason) => messages.fill(Msg::ErrorPictureUnreadable, &[("reason", reason)]),
            Self::NotAPicture => messages.get(Msg::ErrorNotAPicture).to_owned(),
            Self::Damaged(reason) => messages.fill(Msg::ErrorPictureDamaged, &[("reason", reason)]),
            Self::TooLarge => {
                let limit = limits::MAX_PICTURE_BYTES >> 20;
                messages.fill(Msg::ErrorPictureTooLarge, &[("limit", &limit)])
            }
            Self::NotBase64 { .. } => self.to_string(),
        }
    }
}

impl Localize for ReferenceError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::Picture(error) => error.localize(messages),
            Self::OutOfRange { .. } => self.to_string(),
        }
    }
}

impl Localize for ChangeError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::Full { what: "strokes", limit } => {
                messages.fill(Msg::ErrorTooManyStrokes, &[("limit", limit)])
            }
            Self::Full { what: "points", limit } => {
                messages.fill(Msg::ErrorTooManyPoints, &[("limit", limit)])
            }
            Self::Reference(error) => error.localize(messages),
            Self::Plants(error) => error.localize(messages),
            other => other.to_string(),
        }
    }
}

impl Localize for PlantsError {
    fn localize(&self, messages: &Messages) -> String {
        let (place, fault) = match self {
            Self::TooMany => {
                return messages.fill(Msg::ErrorTooManyPlants, &[("limit", &limits::MAX_PLANTS)]);
            }
            Self::Of { place, fault } => (place, fault),
        };
        let power = |number: f32| format!("{number:e}");
        let fault = match fault {
            PlantFault::Species { name } => messages.fill(Msg::ErrorPlantSpecies, &[("name", name)]),
            PlantFault::Foot => {
                messages.fill(Msg::ErrorPlantFoot, &[("most", &power(limits::MAX_COORDINATE))])
            }
            PlantFault::Age => messages.fill(Msg::ErrorPlantAge, &[("most", &limits::MAX_PLANT_AGE)]),
            PlantFault::Height => {
                let (least, most) = (limits::MIN_PLANT_HEIGHT, power(limits::MAX_CANVAS_SIDE));
                messages.fill(Msg::ErrorPlantHeight, &[("least", &least), ("most", &most)])
            }
        };
        messages.fill(Msg::ErrorOfPlant, &[("place", place), ("fault", &fault)])
    }
}

impl Localize for JournalError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::Write(error) => messages.fill(Msg::ErrorJournal, &[("error", &error.localize(messages))]),
            Self::NoThread(reason) => messages.fill(Msg::ErrorNoJournalThread, &[("reason", reason)]),
            Self::Read { path, source } => {
                messages.fill(Msg::ErrorRecoveryUnreadable, &[("file", &path.display()), ("reason", source)])
            }
            Self::NewerVersion { path, version } => {
                messages.fill(Msg::ErrorRecoveryNewer, &[("file", &path.display()), ("version", version)])
            }
            Self::Damaged { path, what } => {
                messages.fill(Msg::ErrorRecoveryDamaged, &[("file", &path.display()), ("reason", what)])
            }
            Self::Remove { path, source } => {
                messages.fill(Msg::ErrorRecoveryRemove, &[("file", &path.display()), ("reason", source)])
            }
        }
    }
}

impl Localize for Gap {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::OlderCopy(error) => {
                messages.fill(Msg::ErrorOlderCopy, &[("error", &error.localize(messages))])
            }
            Self::StepsOnly { path } => messages.fill(Msg::ErrorStepsOnly, &[("file", &path.display())]),
            Self::LeftOut { path, record, count, what } => messages.fill(
                Msg::ErrorLeftOut,
                &[("file", &path.display()), ("record", record), ("count", count), ("reason", what)],
            ),
        }
    }
}

impl Localize for ExportError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::Empty => messages.get(Msg::ErrorNothingToExport).to_owned(),
            Self::Overwrites(Overwrites { output, source_file }) => messages.fill(
                Msg::ErrorOverwrites,
                &[("file", &output.display()), ("source", &source_file.display())],
            ),
            Self::Write(error) => error.localize(messages),
            other => other.to_string(),
        }
    }
}

impl Localize for BuildError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::Setup(SetupError::Species(error)) => error.localize(messages),
            Self::Setup(SetupError::OfSpecies { file, line, fault }) => {
                let fault = fault.localize(messages);
                messages.fill(Msg::ErrorOfSpecies, &[("file", file), ("line", line), ("fault", &fault)])
            }
            Self::Setup(SetupError::Param { whose: "the sketch", fault }) => {
                messages.fill(Msg::ErrorOfSketch, &[("fault", &fault.localize(messages))])
            }
            Self::Setup(other) => other.to_string(),
            Self::Defect => messages.get(Msg::ErrorDefect).to_owned(),
        }
    }
}

impl Localize for SpeciesError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::Unknown { name, nearest, known } => {
                let hint = hint(nearest.as_deref(), messages);
                messages.fill(Msg::ErrorSpeciesUnknown, &[("name", name), ("hint", &hint), ("known", known)])
            }
            Self::Unreadable { file, source } => {
                messages.fill(Msg::ErrorSpeciesUnreadable, &[("file", &file.display()), ("reason", source)])
            }
            Self::TooLarge { file } => messages
                .fill(Msg::ErrorSpeciesTooLarge, &[("file", &file.display()), ("limit", &MAX_SPECIES_BYTES)]),
            other => other.to_string(),
        }
    }
}

impl Localize for ParamError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::Unknown { path, nearest } => {
                let hint = hint(nearest.as_deref(), messages);
                messages.fill(Msg::ErrorParamUnknown, &[("path", path), ("hint", &hint)])
            }
            Self::Range { path, value, min, max } => messages
                .fill(Msg::ErrorParamRange, &[("path", path), ("value", value), ("min", min), ("max", max)]),
            Self::Type { .. } => self.to_string(),
        }
    }
}

/// The name that was perhaps meant.
fn hint(nearest: Option<&str>, messages: &Messages) -> String {
    nearest.map_or_else(String::new, |nearest| messages.fill(Msg::ErrorDidYouMean, &[("nearest", &nearest)]))
}

impl Localize for TransportError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::Permission { path, remedy } => {
                let msg = match remedy {
                    Remedy::Rules => Msg::ErrorTabletForbidden,
                    Remedy::OwnRule(_) => Msg::ErrorTabletForbiddenUnlisted,
                    Remedy::System => Msg::ErrorTabletForbiddenBuiltIn,
                    Remedy::OtherProgram => Msg::ErrorTabletHeldElsewhere,
                    Remedy::InputMonitoring => Msg::ErrorTabletInputMonitoring,
                };
                let rule = if let Remedy::OwnRule(rule) = remedy { rule } else { "" };
                let of_rules: [(&str, &dyn Display); 4] = [
                    ("rules", &RULES_FILE),
                    ("command", &INSTALL_RULES),
                    ("rule", &rule),
                    ("folder", &RULES_FOLDER),
                ];
                messages.fill(msg, &[&[("path", path as &dyn Display)][..], &of_rules].concat())
            }
            Self::Gone { path } => messages.fill(Msg::ErrorTabletGone, &[("path", path)]),
            Self::System { path, message } => {
                messages.fill(Msg::ErrorTabletFailed, &[("path", path), ("reason", message)])
            }
        }
    }
}

impl Localize for Refused {
    fn localize(&self, messages: &Messages) -> String {
        let why = match &self.why {
            Refusal::Transport(error) => error.localize(messages),
            Refusal::TooMany { limit } => messages.fill(Msg::ErrorTabletTooMany, &[("limit", limit)]),
            Refusal::Choose(ChooseError::StringsUnread { models, reason }) => {
                let msg = match reason {
                    StringsKept::Forbidden => Msg::ErrorTabletStringsForbidden,
                    StringsKept::Wireless => Msg::ErrorTabletStringsWireless,
                    StringsKept::Unanswered => Msg::ErrorTabletStringsUnanswered,
                    StringsKept::NotRecorded => Msg::ErrorTabletStringsNotRecorded,
                };
                let model = models.first().map_or("", String::as_str);
                let of_tablet: [(&str, &dyn Display); 2] = [("model", &model), ("count", &models.len())];
                let of_rules: [(&str, &dyn Display); 2] =
                    [("rules", &RULES_FILE), ("command", &INSTALL_RULES)];
                messages.fill(msg, &[of_tablet, of_rules].concat())
            }
            Refusal::Choose(ChooseError::UnlistedForbidden) => messages.fill(
                Msg::ErrorTabletUnlistedForbidden,
                &[("rules", &RULES_FILE), ("command", &INSTALL_RULES)],
            ),
            Refusal::Choose(ChooseError::RangesUnread { firmware }) => {
                messages.fill(Msg::ErrorTabletRangesUnread, &[("firmware", firmware)])
            }
            Refusal::Choose(error @ ChooseError::Descriptor(_)) => error.to_string(),
        };
        format!("{}: {why}", self.device.name())
    }
}

#[cfg(test)]
#[path = "faults_tests.rs"]
mod tests;
