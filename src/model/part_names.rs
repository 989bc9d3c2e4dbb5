//! Names of parts, each different from all others of its plant.
//!
//! `wood`, `wood_1` and `branch_3` for wood; `leaf_12` and `petal_0_4` (flower, then number within the flower) for organs
//! that are parts of their own; `stamens_0` and `anthers_0` for what is gathered in a flower, `leaves`, `petals_1` for what is
//! gathered over a plant.

use super::piece::{Piece, Scope};
use crate::plant::{Organ, OrganKind, Shape};
use smol_str::{SmolStr, SmolStrBuilder, format_smolstr};
use std::collections::{BTreeMap, HashSet};

/// Counts what has been named so far.
#[derive(Default)]
pub(super) struct PartNames {
    singles: Singles,
    gathered: BTreeMap<(OrganKind, Piece), usize>,
    lone_filaments: BTreeMap<(OrganKind, Piece), usize>,
    /// Names in the plural: flowers and plants may have the same numbers.
    plurals: HashSet<SmolStr>,
}

/// How many single organs of each flower and kind there are. Those of one flower mostly come one after the other, so that
/// the last count is at hand.
#[derive(Default)]
struct Singles {
    last: Option<((Option<usize>, OrganKind), usize)>,
    others: BTreeMap<(Option<usize>, OrganKind), usize>,
}

impl Singles {
    /// The number of the next one.
    fn next(&mut self, of: (Option<usize>, OrganKind)) -> usize {
        if let Some((last, count)) = self.last.take_if(|(last, _)| *last != of) {
            self.others.insert(last, count);
        }
        let (_, count) = self.last.get_or_insert_with(|| (of, self.others.get(&of).copied().unwrap_or(0)));
        next(count)
    }
}

impl PartNames {
    /// The name of a part that begins with this organ.
    pub(super) fn organs(&mut self, organ: &Organ, scope: Scope, piece: Piece) -> SmolStr {
        let name = match scope {
            Scope::Organ(_) if !matches!(organ.shape, Shape::Filament { .. }) => return self.single(organ),
            Scope::Organ(_) => {
                let number = next(self.lone_filaments.entry((organ.kind(), piece)).or_default());
                with_numbers(plural(organ.kind(), piece), "_lone", [number])
            }
            Scope::Flower(flower) => with_numbers(plural(organ.kind(), piece), "", [flower]),
            Scope::Specimen(_) => numbered(
                plural(organ.kind(), piece),
                next(self.gathered.entry((organ.kind(), piece)).or_default()),
            ),
        };
        self.unused(name)
    }

    fn single(&mut self, organ: &Organ) -> SmolStr {
        let number = self.singles.next((organ.flower, organ.kind()));
        with_numbers(organ.kind().name(), "", organ.flower.into_iter().chain([number]))
    }

    /// The name, with a number behind it if it is taken.
    fn unused(&mut self, name: SmolStr) -> SmolStr {
        if self.plurals.insert(name.clone()) {
            return name;
        }
        let mut twins = (1..).map(|twin| format_smolstr!("{name}_{twin}"));
        twins.find(|twin| self.plurals.insert(twin.clone())).unwrap_or(name)
    }
}

/// A name for the first of its kind, and with numbers for those after it.
pub(super) fn numbered(name: &str, number: usize) -> SmolStr {
    with_numbers(name, "", (number > 0).then_some(number))
}

/// A name with what comes behind it and some numbers. It takes a part of the time of `format!`, and short names take no memory
/// of their own: large drawings have a name for every stroke.
fn with_numbers(name: &str, behind: &str, numbers: impl IntoIterator<Item = usize>) -> SmolStr {
    let mut whole = SmolStrBuilder::new();
    whole.push_str(name);
    whole.push_str(behind);
    numbers.into_iter().for_each(|number| push_number(&mut whole, number));
    whole.finish()
}

fn push_number(name: &mut SmolStrBuilder, number: usize) {
    let digits = number.checked_ilog10().unwrap_or(0);
    name.push('_');
    for place in (0..=digits).rev() {
        name.push(char::from(b'0' + (number / 10usize.pow(place) % 10) as u8));
    }
}

fn next(counter: &mut usize) -> usize {
    *counter += 1;
    *counter - 1
}

fn plural(kind: OrganKind, piece: Piece) -> &'static str {
    match piece {
        Piece::Body => kind.plural(),
        Piece::Head => kind.heads(),
    }
}
