//! How far the parser has come: serde knows line and column of an error, this knows stroke, point and our own fault.

use crate::sketch::StrokeId;
use crate::sketch::error::{Fault, Place};
use serde::de::Error;
use std::cell::{Cell, RefCell};

/// Shared by all visitors of one parse.
#[derive(Default)]
pub(super) struct Progress {
    /// The stroke being read, from 1; 0 outside of strokes.
    pub(super) stroke: Cell<usize>,
    /// Its id, once seen.
    pub(super) id: Cell<Option<StrokeId>>,
    /// The point being read, from 1; 0 outside of points.
    pub(super) point: Cell<usize>,
    /// The plant being read, from 1; 0 outside of plants.
    pub(super) plant: Cell<usize>,
    /// The shape of petals being read, from 1; 0 outside of shapes.
    pub(super) petal_shape: Cell<usize>,
    /// Points of all strokes before this one.
    pub(super) points_before: Cell<usize>,
    fault: RefCell<Option<Fault>>,
}

impl Progress {
    /// Stops the parse with `fault`; serde only gets to see that there was one.
    pub(super) fn refuse<E: Error>(&self, fault: Fault) -> E {
        self.fault.replace(Some(fault));
        E::custom("refused")
    }

    /// Stops the parse with a message of our own.
    pub(super) fn malformed<E: Error>(&self, message: impl Into<String>) -> E {
        self.refuse(Fault::Malformed(message.into()))
    }

    /// The fault that stopped the parse, if it was ours.
    pub(super) fn take_fault(&self) -> Option<Fault> {
        self.fault.take()
    }

    /// The fault, with the plant or the shape of petals in which it is.
    pub(super) fn in_item(&self, fault: Fault) -> Fault {
        match (self.plant.get(), self.petal_shape.get(), fault) {
            (plant @ 1.., _, Fault::Malformed(what)) => Fault::Malformed(format!("plant {plant}: {what}")),
            // An offset too few, and one too many, as serde says it.
            (_, shape @ 1.., Fault::Malformed(what))
                if what.starts_with("invalid length") || what.starts_with("trailing characters") =>
            {
                let remedy = "write 4 rows of 4 offsets of 3 numbers";
                Fault::Malformed(format!("petal shape {shape}: {what}; {remedy}"))
            }
            (_, shape @ 1.., Fault::Malformed(what)) => {
                Fault::Malformed(format!("petal shape {shape}: {what}"))
            }
            (_, _, fault) => fault,
        }
    }

    /// Where the parse is now.
    pub(super) fn place(&self, line: usize, column: usize) -> Place {
        let known = |n: usize| (n > 0).then_some(n);
        Place {
            stroke: known(self.stroke.get()),
            id: self.id.get().map(|id| id.to_string()),
            point: known(self.point.get()),
            ..Place::at(line, column)
        }
    }
}

/// Fills `slot`, unless the field came before.
pub(super) fn set_once<T, E: Error>(slot: &mut Option<T>, value: T, field: &'static str) -> Result<(), E> {
    match slot.replace(value) {
        None => Ok(()),
        Some(_) => Err(E::duplicate_field(field)),
    }
}
