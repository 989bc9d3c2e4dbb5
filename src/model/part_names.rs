//! Names of parts, each different from all others of its plant.
//!
//! `wood`, `wood_1` and `branch_3` for wood; `leaf_12` and `petal_0_4` (flower, then number within the flower) for organs
//! that are parts of their own; `stamens_0` and `anthers_0` for what is gathered in a flower, `leaves`, `petals_1` for what is
//! gathered over a plant.

use super::piece::{Piece, Scope};
use crate::plant::{Organ, OrganKind, Shape};
use std::collections::{BTreeMap, BTreeSet};

/// Counts what has been named so far.
#[derive(Default)]
pub(super) struct PartNames {
    singles: BTreeMap<(Option<usize>, OrganKind), usize>,
    gathered: BTreeMap<(OrganKind, Piece), usize>,
    lone_filaments: BTreeMap<(OrganKind, Piece), usize>,
    /// Names in the plural: flowers and plants may have the same numbers.
    plurals: BTreeSet<String>,
}

impl PartNames {
    /// The name of a part that begins with this organ.
    pub(super) fn organs(&mut self, organ: &Organ, scope: Scope, piece: Piece) -> String {
        let name = match scope {
            Scope::Organ(_) if !matches!(organ.shape, Shape::Filament { .. }) => return self.single(organ),
            Scope::Organ(_) => {
                let number = next(self.lone_filaments.entry((organ.kind(), piece)).or_default());
                format!("{}_lone_{number}", plural(organ.kind(), piece))
            }
            Scope::Flower(flower) => format!("{}_{flower}", plural(organ.kind(), piece)),
            Scope::Specimen(_) => numbered(
                plural(organ.kind(), piece),
                next(self.gathered.entry((organ.kind(), piece)).or_default()),
            ),
        };
        self.unused(name)
    }

    fn single(&mut self, organ: &Organ) -> String {
        let number = next(self.singles.entry((organ.flower, organ.kind())).or_default());
        let kind = organ.kind().name();
        organ.flower.map_or_else(|| format!("{kind}_{number}"), |flower| format!("{kind}_{flower}_{number}"))
    }

    /// The name, with a number behind it if it is taken.
    fn unused(&mut self, name: String) -> String {
        let mut candidate = name.clone();
        let mut twin = 1;
        while !self.plurals.insert(candidate.clone()) {
            candidate = format!("{name}_{twin}");
            twin += 1;
        }
        candidate
    }
}

/// A name for the first of its kind, and with numbers for those after it.
pub(super) fn numbered(name: &str, number: usize) -> String {
    if number == 0 { name.to_owned() } else { format!("{name}_{number}") }
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
