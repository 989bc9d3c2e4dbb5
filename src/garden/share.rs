//! Shares of a garden that are made apart: runs of squares of its plan.
//!
//! The plan lies on squares of the lattice with the largest distance, numbered row by row from the far side to the near one. A garden's
//! plants are in the order of their squares, so what shares have one after the other is what the whole garden has.

use glam::{DVec2, Vec2};
use std::ops::Range;
use std::str::FromStr;

/// Most shares of a garden.
const MOST: u32 = 1_000_000;

/// One of so many shares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    number: u32,
    of: u32,
}

impl Share {
    /// All of it.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// How many shares there are.
    pub fn of(self) -> u32 {
        self.of
    }

    /// Which one it is, from 1.
    pub fn number(self) -> u32 {
        self.number
    }
}

impl FromStr for Share {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let share = text.split_once('/').and_then(|(number, of)| {
            Some(Self { number: number.trim().parse().ok()?, of: of.trim().parse().ok()? })
        });
        share.filter(|share| (1..=MOST).contains(&share.of) && (1..=share.of).contains(&share.number)).ok_or_else(
            || format!("a share is written as NUMBER/COUNT, as in 3/64 for the third of 64; there are at most {MOST}"),
        )
    }
}

/// The squares of a plan.
pub(super) struct Squares {
    side: f64,
    /// The first square's number along each axis.
    first: [i64; 2],
    /// How many there are along each axis.
    counts: [u64; 2],
}

impl Squares {
    /// Squares of this side over a box.
    pub(super) fn over((low, high): (Vec2, Vec2), side: f32) -> Self {
        let side = f64::from(side);
        let square = |at: Vec2| (at.as_dvec2() / side).floor().to_array().map(|k| k as i64);
        let (first, last) = (square(low), square(high));
        Self { side, first, counts: [0, 1].map(|axis| (last[axis] - first[axis]) as u64 + 1) }
    }

    /// The number of the square with a point; points outside of all belong to the nearest.
    pub(super) fn number(&self, at: Vec2) -> u64 {
        let at = (at.as_dvec2() / self.side).floor().to_array();
        let [x, z] = [0, 1]
            .map(|axis| (at[axis] as i64 - self.first[axis]).clamp(0, self.counts[axis] as i64 - 1) as u64);
        z * self.counts[0] + x
    }

    /// The squares of a share.
    pub(super) fn of(&self, share: Share) -> Range<u64> {
        let all = u128::from(self.counts[0] * self.counts[1]);
        let end = |number: u32| (all * u128::from(number) / u128::from(share.of)) as u64;
        end(share.number - 1)..end(share.number)
    }

    /// A box around some squares.
    pub(super) fn bounds(&self, squares: &Range<u64>) -> (Vec2, Vec2) {
        if squares.is_empty() {
            let corner = self.corner([0, 0]);
            return (corner, corner);
        }
        let [columns, _] = self.counts;
        let (top, bottom) = (squares.start / columns, (squares.end - 1) / columns);
        let across = if top == bottom {
            [squares.start % columns, (squares.end - 1) % columns]
        } else {
            [0, columns - 1]
        };
        (self.corner([across[0], top]), self.corner([across[1] + 1, bottom + 1]))
    }

    /// The corner of a square toward the origin of the numbers.
    fn corner(&self, place: [u64; 2]) -> Vec2 {
        let at = DVec2::from([0, 1].map(|axis| (self.first[axis] + place[axis] as i64) as f64));
        (at * self.side).as_vec2()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_have_each_square_once_and_lie_in_their_boxes() {
        let squares = Squares::over((Vec2::new(-7.0, -2.5), Vec2::new(5.5, 9.0)), 1.5);
        let all = squares.counts[0] * squares.counts[1];
        for of in [1, 2, 7, 64, 1000] {
            let mut next = 0;
            for number in 1..=of {
                let own = squares.of(Share { number, of });
                assert_eq!(own.start, next);
                next = own.end;
                let (low, high) = squares.bounds(&own);
                for square in own {
                    let place = [square % squares.counts[0], square / squares.counts[0]];
                    let middle = squares.corner(place) + 0.75;
                    assert!(middle.cmpgt(low).all() && middle.cmplt(high).all());
                    assert_eq!(squares.number(middle), square);
                }
            }
            assert_eq!(next, all);
        }
    }

    #[test]
    fn a_share_is_written_with_its_number() {
        assert_eq!("3/64".parse(), Ok(Share { number: 3, of: 64 }));
        for wrong in ["", "3", "0/4", "5/4", "1/0", "a/b", "1/2/3", "-1/4"] {
            assert!(wrong.parse::<Share>().is_err_and(|why| why.contains("3/64")), "{wrong}");
        }
    }
}
