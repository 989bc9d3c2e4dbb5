//! Pieces of organs, and which of them are one part.

use crate::plant::{Organ, OrganPart, Role, Shape};

/// What of an organ goes into a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Piece {
    /// A blade or a solid; the filament itself.
    Body,
    /// The swollen end of a filament.
    Head,
}

/// Which organs of one kind are one part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Scope {
    /// Those of a specimen.
    Specimen(usize),
    /// Those of a flower.
    Flower(usize),
    /// The organ of this index alone.
    Organ(usize),
}

/// The pieces of an organ with their roles.
pub(super) fn pieces(organ: &Organ) -> impl Iterator<Item = (Piece, Role<OrganPart>)> {
    let has_head = matches!(&organ.shape, Shape::Filament { head, .. } if head.min_element() > 0.0);
    let head = has_head.then(|| (Piece::Head, organ.role.of_head()));
    std::iter::once((Piece::Body, organ.role)).chain(head)
}
