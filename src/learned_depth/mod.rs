//! How deep a drawn tree is, learned from trees that this program grew (001 ch. 3).
//!
//! A drawing's crown and wood become a small picture; a network answers how deep the crown is, how far its middle strays from the
//! drawing's plane, and how far wood leaves it. Areas that are no crowns, such as letters, it knows as such, and then the depth of the
//! stages without it holds.
//!
//! | file | what |
//! | --- | --- |
//! | `picture` | the drawing as the network sees it |
//! | `layers` | convolutions |
//! | `network` | the weights' file, the answer |
//! | `field` | depth at any point of the drawing |
//!
//! The training set and its judgement: `examples/train_depth`; figures: `docs/depth.md`.
//!
//! Limits: trees and bushes with a drawn crown; forms of which nothing like them was grown in training look like what was.

mod field;
mod layers;
pub mod network;
pub mod picture;

pub use field::{DepthField, Memory, Question, WorldDepth};
pub use network::{Network, NetworkError};
pub use picture::Line;

/// The shipped weights.
#[cfg(feature = "learned")]
const WEIGHTS: Option<&[u8]> = Some(include_bytes!("../../assets/depth/plants.bin"));
/// A library without them.
#[cfg(not(feature = "learned"))]
const WEIGHTS: Option<&[u8]> = None;
