//! Rings and strips of tablets: from where a finger lies to how far it turned.
//!
//! A ring or strip says places, a dial says notches; all become notches here, so that nobody after it needs to know which
//! one a tablet has. A place of a strip is a notch. A turn of a ring is twelve notches. A jump over more than half of it goes the shorter way round, over its
//! beginning; the first place after the finger was gone is no turn.

/// Notches of a whole turn.
const NOTCHES: i32 = 12;

/// Follows the finger on one ring.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ring {
    place: Option<i32>,
    /// What was turned and is not a whole notch yet, in places times [`NOTCHES`].
    rest: i32,
}

impl Ring {
    /// Takes where the finger lies on a ring of so many places, `None` when it is gone, and gives the notches it turned.
    pub fn turn(&mut self, place: Option<u8>, places: u8) -> i32 {
        let (before, places) = (self.place, i32::from(places.max(1)));
        self.place = place.map(i32::from);
        let (Some(before), Some(now)) = (before, self.place) else {
            self.rest = 0;
            return 0;
        };
        let half = places / 2;
        let way = (now - before + half).rem_euclid(places) - half;
        self.rest += way * NOTCHES;
        let notches = self.rest / places;
        self.rest -= notches * places;
        notches
    }
}

/// Follows the finger on one strip.
#[derive(Clone, Copy, Debug, Default)]
pub struct Strip {
    place: Option<u8>,
}

impl Strip {
    /// Takes where the finger lies, `None` when it is gone, and gives the notches it slid away from the first place.
    pub fn slide(&mut self, place: Option<u8>) -> i32 {
        let before = std::mem::replace(&mut self.place, place);
        before.zip(place).map_or(0, |(before, now)| i32::from(now) - i32::from(before))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finger_turns_from_where_it_was_laid_down() {
        let mut ring = Ring::default();
        let mut turn = |place| ring.turn(place, 72);
        assert_eq!([Some(40), Some(46), Some(48), Some(52)].map(&mut turn), [0, 1, 0, 1]);
        assert_eq!([None, Some(10), Some(4), None].map(turn), [0, 0, -1, 0]);
    }

    #[test]
    fn the_shorter_way_round_is_taken() {
        let mut ring = Ring::default();
        assert_eq!([11, 0, 1, 11, 5].map(|place| ring.turn(Some(place), 12)), [0, 1, 1, -2, -6]);
        assert_eq!(Ring::default().turn(Some(3), 0), 0);
    }

    #[test]
    fn a_strip_has_ends() {
        let mut strip = Strip::default();
        assert_eq!(
            [Some(0), Some(12), Some(11), None, Some(3)].map(|place| strip.slide(place)),
            [0, 12, -1, 0, 0]
        );
    }
}
