//! How a tablet is read: the decoder of its reports, what wakes it, and what is known of it.

use super::families::Spec;
use super::report_lengths::ReportLengths;
use super::strings::DeviceStrings;
use super::wake::Wake;
use super::{Abilities, Decode, DescriptorDecoder};
use crate::pen::machine::Silence;
use glam::DVec2;

/// A decoder for a device, and what is known of the device besides.
pub struct Choice {
    /// Turns its reports into events.
    pub decoder: Box<dyn Decode>,
    /// What must be sent before its first report is read.
    pub wake_up: Option<WakeUp>,
    /// How it is read, for people.
    pub way: String,
    /// Width and height of the active area in millimetres, if known.
    pub area_mm: Option<DVec2>,
    /// The silence that says that the pen left, where the device does not.
    pub silence: Option<Silence>,
    /// What the pen can say.
    pub abilities: Abilities,
    /// The models it may be, where that is not sure.
    pub doubt: Option<Doubt>,
}

/// A tablet of which it is not sure which model it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Doubt {
    /// Models that fit, the best guess first.
    pub models: Vec<String>,
    /// The one it is read as.
    pub taken: String,
    /// The artist chose it.
    pub is_chosen: bool,
}

/// What wakes a tablet, and how it is read then.
pub struct WakeUp {
    /// What is read and sent.
    pub sequence: Wake,
    /// Lengths of the node's reports.
    pub lengths: ReportLengths,
    /// Its USB strings.
    pub strings: Box<dyn DeviceStrings>,
    /// The layout of the woken tablet's reports, where its ranges may turn out to be others.
    pub spec: Option<Spec>,
    /// The mouse that it imitates until it is woken.
    pub imitation: Option<DescriptorDecoder>,
    /// What is known of its area and ranges.
    pub known: Known,
}

/// What is known of a tablet before it is woken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Known {
    /// Its model is listed.
    Model,
    /// Its descriptor gives ranges.
    Descriptor,
    /// The name of its firmware and nothing more.
    Firmware(String),
}
