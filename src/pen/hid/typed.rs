//! Which reports of a device carry what is typed.
//!
//! A recording must not hold passwords. Nodes of tablets and receivers often are keyboards as well: a report counts as
//! typed if it stands in a collection that is a keyboard or keypad, wherever in the descriptor that is, or if one of its
//! fields is of the page of keys. Source: HID 1.11, section 6.2.2; usage tables, pages 0x01 and 0x07.

use super::descriptor_items::{Items, tag};

/// Keyboard and keypad on the desktop's page.
pub const KEYBOARDS: [(u16, u16); 2] = [(0x01, 0x06), (0x01, 0x07)];
/// The page of keys.
const KEYS: u32 = 0x07;

/// Ids of the reports that carry what is typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TypedReports {
    ids: [bool; 256],
}

impl TypedReports {
    /// Reads a descriptor as far as it is whole; of an empty one nothing is known.
    pub fn of(descriptor: &[u8]) -> Self {
        let mut ids = [false; 256];
        // Page and report id; usages with their pages; the depth, and whether the outermost collection is a keyboard.
        let (mut state, mut saved, mut usages) = ((0, 0), Vec::new(), Vec::new());
        let (mut depth, mut is_keyboard) = (0u32, false);
        for item in Items::new(descriptor).map_while(Result::ok) {
            let page_of = |usage: u32| if usage >> 16 == 0 { state.0 } else { usage >> 16 };
            match item.tag {
                tag::USAGE_PAGE => state.0 = item.unsigned(),
                tag::REPORT_ID => state.1 = item.unsigned(),
                tag::PUSH => saved.push(state),
                tag::POP => state = saved.pop().unwrap_or(state),
                tag::USAGE | tag::USAGE_MINIMUM | tag::USAGE_MAXIMUM => usages.push(item.unsigned()),
                tag::COLLECTION => {
                    let is_one = |usage: &u32| {
                        let is = |(page, id): &(u16, u16)| {
                            (page_of(*usage), usage & 0xFFFF) == ((*page).into(), (*id).into())
                        };
                        KEYBOARDS.iter().any(is)
                    };
                    is_keyboard = usages.iter().any(is_one) || (is_keyboard && depth > 0);
                    depth = depth.saturating_add(1);
                    usages.clear();
                }
                tag::END_COLLECTION => {
                    depth = depth.saturating_sub(1);
                    usages.clear();
                }
                tag::INPUT => {
                    let has_keys = state.0 == KEYS || usages.iter().any(|usage| page_of(*usage) == KEYS);
                    if let Some(is_typed) = ids.get_mut(state.1 as usize) {
                        *is_typed |= has_keys || (is_keyboard && depth > 0);
                    }
                    usages.clear();
                }
                tag::OUTPUT | tag::FEATURE => usages.clear(),
                _ => {}
            }
        }
        Self { ids }
    }

    /// Whether a report carries what is typed; it begins with its id, 0 for devices without.
    pub fn holds(&self, report: &[u8]) -> bool {
        report.first().and_then(|id| self.ids.get(usize::from(*id))).is_some_and(|is_typed| *is_typed)
    }

    /// Whether all that a device without report ids sends is typed.
    pub fn is_everything(&self) -> bool {
        self.ids[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::hid::made_up as tablets;
    use proptest::prelude::*;

    fn ids(descriptor: &[u8]) -> Vec<usize> {
        TypedReports::of(descriptor)
            .ids
            .iter()
            .enumerate()
            .filter(|(_, typed)| **typed)
            .map(|(id, _)| id)
            .collect()
    }

    #[test]
    fn keyboards_are_found_wherever_they_stand() {
        assert_eq!(ids(tablets::KEYBOARD), [0]);
        assert!(TypedReports::of(tablets::KEYBOARD).is_everything());
        for quiet in [tablets::MOUSE, tablets::PEN_DISPLAY, tablets::DESK_TABLET, tablets::WACOM_PAGE, &[]] {
            assert_eq!(ids(quiet), [0; 0]);
        }
        let both = tablets::pen_with_keyboard();
        assert_eq!(ids(&both), [9]);
        let typed = TypedReports::of(&both);
        assert!(
            typed.holds(&[9, 0, 4])
                && !typed.holds(&[2, 0, 4])
                && !typed.holds(&[])
                && !typed.is_everything()
        );
    }

    #[test]
    fn keys_outside_of_keyboards_are_typed_too() {
        // A collection of the maker's own, report 3 with a key as an array of page 7, report 4 without.
        let own = [
            0x06, 0x00, 0xFF, 0x09, 0x01, 0xA1, 0x01, 0x85, 0x03, 0x05, 0x07, 0x19, 0x00, 0x29, 0x65, 0x75,
            0x08, 0x95, 0x01, 0x81, 0x00, 0x06, 0x00, 0xFF, 0x85, 0x04, 0x09, 0x02, 0x81, 0x02, 0xC0,
        ];
        assert_eq!(ids(&own), [3]);
        // The page stands in the usage: 0007:0004.
        let extended = [0x05, 0x01, 0x09, 0x02, 0xA1, 0x01, 0x0B, 0x04, 0x00, 0x07, 0x00, 0x81, 0x02, 0xC0];
        assert_eq!(ids(&extended), [0]);
    }

    proptest! {
        #[test]
        fn any_bytes_are_read(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
            TypedReports::of(&bytes);
        }
    }
}
