//! What is wrong or odd with photographs, in the interface's language.

use super::{Localize, Messages, Msg};
use crate::app::texture_cut::CutError;
use crate::photo::{PhotoError, PhotoRemark};

impl Localize for CutError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::Picture(error) => error.localize(messages),
            Self::Photo(error) => error.localize(messages),
        }
    }
}

impl Localize for PhotoError {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::TooSmall { width, height, least } => messages
                .fill(Msg::ErrorPhotoTooSmall, &[("width", width), ("height", height), ("least", least)]),
            Self::OneColour { contrast, least } => {
                let [contrast, least] = [contrast, least].map(|number| format!("{number:.1}"));
                messages.fill(Msg::ErrorPhotoOneColour, &[("contrast", &contrast), ("least", &least)])
            }
            Self::NothingThere => messages.get(Msg::ErrorPhotoNothing).to_owned(),
            Self::CutOff { share } => {
                messages.fill(Msg::ErrorPhotoCutOff, &[("share", &format!("{share:.0}"))])
            }
            Self::NoPlant { share, least } => {
                let (share, least) = (format!("{share:.1}"), format!("{least:.0}"));
                messages.fill(Msg::ErrorPhotoNoPlant, &[("share", &share), ("least", &least)])
            }
            Self::AllPlant { share, most } => {
                let [share, most] = [share, most].map(|number| format!("{number:.0}"));
                messages.fill(Msg::ErrorPhotoAllPlant, &[("share", &share), ("most", &most)])
            }
            Self::SameColours => messages.get(Msg::ErrorPhotoSameColours).to_owned(),
            Self::NoOutline => messages.get(Msg::ErrorPhotoNoOutline).to_owned(),
            Self::BesidePicture => messages.get(Msg::ErrorPhotoBeside).to_owned(),
            // The window gives no ends, and textures are small.
            Self::BadEnds { .. } | Self::Encoding(_) => self.to_string(),
        }
    }
}

impl Localize for PhotoRemark {
    fn localize(&self, messages: &Messages) -> String {
        match self {
            Self::Several { count } => messages.fill(Msg::WarningPhotoSeveral, &[("number", count)]),
            Self::SeveralPlants { count } => {
                messages.fill(Msg::WarningPhotoSeveralPlants, &[("number", count)])
            }
            Self::TrunkAsDrawn => messages.get(Msg::WarningPhotoTrunkAsDrawn).to_owned(),
            Self::TouchesEdge => messages.get(Msg::WarningPhotoTouchesEdge).to_owned(),
            Self::PartlyBeside { share } => {
                messages.fill(Msg::WarningPhotoPartlyBeside, &[("share", &format!("{share:.0}"))])
            }
        }
    }
}
