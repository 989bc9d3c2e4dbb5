//! Full flowers: many petals in layers, from a handful of numbers (003 §3).
//!
//! ```text
//! Layers, open ──► arrangement ──► profiles ──► petals
//! numbers          who stands       one curve    blades on the rings of the curves
//!                  where            a ring
//! ```
//!
//! A flower is a stack of surfaces of revolution about its axis, one inside of the other; the petals of a layer lie on its
//! surface ([`RingSheet`](crate::plant::RingSheet)), above or below their neighbours by their aestivation. So that no petal passes through another is a matter of
//! distances along one normal, whatever the opening, and not of searching for meetings.
//!
//! | file | what |
//! | --- | --- |
//! | [`layers`] | the numbers: layers, aestivation, how petals bend |
//! | [`outline`] | outlines of petals from numbers |
//! | [`arrangement`] | divergence, sizes, ranks: where each petal stands and whom it covers |
//! | [`profile`] | the curve of each ring in the plane through the axis, one inside of the other |
//! | [`bloom`] | all of these in a row |
//!
//! Lengths are shares of the flower's reach until [`bloom`] gives them metres. Where we depart from 003: `docs/papers.md`.

pub mod arrangement;
pub mod bloom;
pub mod layers;
pub mod outline;
pub mod profile;

pub use bloom::{FullFlower, FullPetal, Pose, full_flower};
pub use layers::{Aestivation, Layers};
pub use outline::PetalOutline;
