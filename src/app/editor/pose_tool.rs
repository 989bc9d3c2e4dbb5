//! The tool that turns, bends and moves parts of the plant: whether it is in hand, and what is held.

use crate::app::pose_drag::PoseDrag;
use crate::modelling::{OnContact, PartFrame, Surroundings};
use crate::sketch::{PartName, PartPose};
use glam::{DVec2, Quat, Vec3};

/// A part as it was when it was taken hold of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Held {
    /// Its pose, and what that starts from.
    pub(super) before: PartPose,
    pub(super) frame: PartFrame,
    /// Where it begins, metres.
    pub(super) base: Vec3,
    /// Whether it is a leaf, a flower or another organ, which does not bend.
    pub(super) is_stiff: bool,
}

/// A part that is held at a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct PartHold {
    /// What the drag does.
    pub(super) drag: PoseDrag,
    /// The part.
    pub(super) held: Held,
    /// Where it is held, metres.
    pub(super) grip: Vec3,
    /// How far along it that is, 0 to 1.
    pub(super) share: f32,
}

/// The ring around the base of a part, held.
#[derive(Clone, Copy, Debug)]
pub(super) struct RingHold {
    /// The part.
    pub(super) held: Held,
    /// From the eye to the base, of unit length.
    pub(super) sight: Vec3,
    /// Middle of the ring and where the pointer was last, physical pixels of the window.
    pub(super) centre: DVec2,
    pub(super) last: DVec2,
    /// By how much it has turned, radians, with the clock.
    pub(super) angle: f64,
}

/// The tool that turns, bends and moves parts of the plant.
#[derive(Debug, Default)]
pub(super) struct PoseTool {
    pub(super) is_on: bool,
    /// What a drag does.
    pub(super) drag: PoseDrag,
    pub(super) hold: Option<PartHold>,
    pub(super) ring: Option<RingHold>,
    /// What becomes of wood that meets other wood as it is turned.
    pub(super) on_contact: OnContact,
    /// The wood around the branch that is held, where that matters, and the last turn at which it is free.
    pub(super) around: Option<(Surroundings, Quat)>,
    /// The ring turns by an eighth of what the pointer does.
    pub(super) is_fine: bool,
    /// The part that was held or chosen last.
    pub(super) last: Option<PartName>,
    /// Others that are chosen with it.
    pub(super) others: Vec<PartName>,
    /// These as they were when one was taken hold of.
    pub(super) held_others: Vec<Held>,
    /// The loop that is drawn around parts, physical pixels of the window.
    pub(super) choosing: Option<Vec<DVec2>>,
}

impl PoseTool {
    /// Lets go of all parts.
    pub(super) fn let_go(&mut self) {
        self.release();
        (self.last, self.choosing) = (None, None);
        self.others.clear();
    }

    /// Chooses what is dragged: if it is among those that are chosen, they stay so.
    pub(super) fn take_up(&mut self, part: PartName) {
        if self.last == Some(part) {
            return;
        }
        match self.others.iter().position(|other| *other == part) {
            Some(place) => {
                self.others.remove(place);
                self.others.extend(self.last);
            }
            None => self.others.clear(),
        }
        self.last = Some(part);
    }

    /// The turn as far as the wood around what is held lets it go.
    pub(super) fn free_turn(&mut self, to: Quat) -> Quat {
        let Some((around, from)) = &mut self.around else { return to };
        *from = around.turn(*from, to, self.on_contact);
        *from
    }

    /// Takes the hand from what is held; it stays chosen.
    pub(super) fn release(&mut self) {
        (self.hold, self.ring, self.around) = (None, None, None);
        self.held_others.clear();
    }
}
