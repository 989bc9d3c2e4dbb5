//! Tablets that imitate a mouse until they are woken.
//!
//! UC-Logic's older tablets, and KYE's, declare a pen and send a mouse instead: one that says where it is, not how far it
//! went, mostly with the pen's pressure. Woken they send the pen. It is not known whether waking has worked, so both are
//! read: the mouse's reports by the descriptor, all others by whatever reads the woken tablet.

use super::{Decode, DescriptorDecoder, HidEvent};

/// Reads a tablet whether it is woken or not.
pub(super) struct UntilWoken {
    imitation: DescriptorDecoder,
    woken: Box<dyn Decode>,
}

impl UntilWoken {
    /// A decoder for a tablet with this descriptor, which `woken` reads as soon as it is awake.
    pub(super) fn new(imitation: DescriptorDecoder, woken: Box<dyn Decode>) -> Self {
        Self { imitation, woken }
    }
}

impl Decode for UntilWoken {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        if report.first().is_some_and(|id| self.imitation.imitates(*id)) {
            self.imitation.decode(report, sink);
        } else {
            self.woken.decode(report, sink);
        }
    }
}
