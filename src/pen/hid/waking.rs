//! Waking an open tablet, and reading it by what it then says of itself.
//!
//! Tablets of UC-Logic's protocols answer the strings that wake them with their ranges ([`super::uclogic`]). These hold
//! whatever a list says: a firmware knows its tablet best. Where a tablet is not listed, they are all that is known of it.

use super::choice::{Choice, Known, WakeUp};
use super::families::Spec;
use super::strings::DeviceStrings;
use super::uclogic::{Protocol, Ranges};
use super::until_woken::UntilWoken;
use super::wake::WakeIo;
use super::{ChooseError, Decode, DescriptorDecoder, Transport};
use std::io;
use std::time::Duration;

impl Choice {
    /// Wakes the tablet and reads what it says of itself.
    ///
    /// # Errors
    /// A tablet that is not listed and does not say its ranges. What fails in waking is a warning, since it may work all
    /// the same; of one that imitates a mouse until then it stands beside how it is read, too.
    pub fn wake(&mut self, transport: &mut dyn Transport) -> Result<(), ChooseError> {
        let Some(mut wake_up) = self.wake_up.take() else { return Ok(()) };
        let name = transport.info().name();
        let mut io = Waking { transport, strings: &mut *wake_up.strings };
        // Feature reports go as they are: the longest that a node declares says nothing of the others.
        let faults = wake_up.sequence.run(wake_up.lengths.output, 0, &mut io);
        faults.iter().for_each(|fault| tracing::warn!("{name}: {fault}"));
        // Where it imitates a mouse meanwhile, it is read all the same, but coarsely: that is worth knowing.
        if let (Some(fault), true) = (faults.first(), wake_up.imitation.is_some()) {
            self.way = format!("{} ({fault})", self.way);
        }
        self.learn(wake_up)
    }

    /// Reads what a tablet said of itself when it was recorded; it was woken then.
    ///
    /// # Errors
    /// As [`Self::wake`].
    pub fn recall(&mut self) -> Result<(), ChooseError> {
        self.wake_up.take().map_or(Ok(()), |wake_up| self.learn(wake_up))
    }

    fn learn(&mut self, mut wake_up: WakeUp) -> Result<(), ChooseError> {
        let protocol = |id| Protocol::ALL.into_iter().find(|known| known.report_id() == id);
        let Some(spec) = wake_up.spec else { return Ok(()) };
        let Some(protocol) = spec.report_id.and_then(protocol) else { return Ok(()) };
        let answer = wake_up.strings.read(protocol.string()).ok();
        let Some(ranges) = answer.and_then(|answer| Ranges::read(protocol, &answer)) else {
            return match wake_up.known {
                Known::Firmware(firmware) => Err(ChooseError::RangesUnread { firmware }),
                Known::Model | Known::Descriptor => Ok(()),
            };
        };
        let spec = Spec { steps: ranges.steps, pressure: ranges.pressure, ..spec };
        self.decoder = reader(&spec, wake_up.imitation);
        self.abilities.pressure_levels = u64::from(ranges.pressure) + 1;
        if wake_up.known != Known::Model {
            self.area_mm = ranges.area_mm.or(self.area_mm);
        }
        Ok(())
    }
}

/// What reads a tablet with this layout, and the mouse that it imitates as long as it is not woken.
pub(super) fn reader(spec: &Spec, imitation: Option<DescriptorDecoder>) -> Box<dyn Decode> {
    match imitation {
        Some(imitation) => Box::new(UntilWoken::new(imitation, spec.decoder())),
        None => spec.decoder(),
    }
}

/// An open device that is being woken.
struct Waking<'a> {
    transport: &'a mut dyn Transport,
    strings: &'a mut dyn DeviceStrings,
}

impl WakeIo for Waking<'_> {
    fn read_string(&mut self, index: u8) -> io::Result<()> {
        self.strings.read(index).map(drop)
    }

    fn send_feature(&mut self, report: &[u8]) -> io::Result<()> {
        self.transport.send_feature(report).map_err(io::Error::other)
    }

    fn write_output(&mut self, report: &[u8]) -> io::Result<()> {
        self.transport.write(report).map_err(io::Error::other)
    }

    fn sleep(&mut self, milliseconds: u64) {
        std::thread::sleep(Duration::from_millis(milliseconds));
    }
}
