//! Which decoder reads a device.
//!
//! A device whose descriptor describes a pen is read by its descriptor; so are tablets whose reports a kernel driver has
//! rewritten, since it rewrites the descriptor as well.

use super::{Abilities, Decode, DescriptorDecoder, DescriptorError, DeviceInfo, Transport};
use glam::DVec2;

/// Wakes a device up: sends what makes it report its pen in full. Called once, on the reader's thread; what fails there
/// it tells by itself, since the device may be read all the same.
pub type WakeUp = Box<dyn FnOnce(&mut dyn Transport) + Send>;

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
    /// The device does not say when its pen leaves: silence says it.
    pub leaves_by_silence: bool,
    /// What the pen can say.
    pub abilities: Abilities,
}

/// The decoder for a device, `None` for a device that is no pen.
///
/// # Errors
/// A descriptor that cannot be understood.
pub fn choose_decoder(_device: &DeviceInfo, descriptor: &[u8]) -> Result<Option<Choice>, DescriptorError> {
    let Some(decoder) = DescriptorDecoder::new(descriptor)? else { return Ok(None) };
    let abilities = decoder.abilities();
    Ok(Some(Choice {
        wake_up: None,
        way: "its report descriptor".to_owned(),
        area_mm: decoder.area_mm(),
        leaves_by_silence: !abilities.leaves,
        abilities,
        decoder: Box::new(decoder),
    }))
}
