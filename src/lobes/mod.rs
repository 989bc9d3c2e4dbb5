//! Lobes: bodies that a crown fills, lofted from strokes in space (001 ch. 5).
//!
//! ```text
//! text ──► Crown ──► Lobe: strokes ──► Line ──► order ──► strips, caps ──► untangled ──► remeshed ──► deformed, posed: Shaped
//!  JSON              what the artist has         closed, even              closed surface  no crossing   even triangles
//! ```
//!
//! | file | what |
//! | --- | --- |
//! | `lobe` | strokes, poses and offsets as the artist has them |
//! | `text` | all of it as a file |
//! | `stroke` | strokes closed, smoothed and sampled evenly |
//! | `order` | where a stroke belongs along its lobe |
//! | `pairing`, `strip` | two loops joined |
//! | `between` | loops between drawn ones |
//! | `cap` | ends closed, by an open stroke or round |
//! | `turned`, `sheet`, `outline` | lobes from profiles, from open strokes, from one outline |
//! | `loft` | which of these a lobe is |
//! | `surface`, `corner_table` | surfaces, and questions to them |
//! | `grid`, `untangle` | surfaces that crossed themselves |
//! | `remesh` | even triangles |
//! | `edit_stroke`, `drag` | strokes and surfaces changed by hand |
//! | `deform` | what was changed of a surface, kept |
//! | `shape` | all stages in a row |
//! | `remark` | what is said of a lobe |
//!
//! Everything is pure and knows no plant; how a crown of lobes is grown into: `growth/volume/lobes.rs`.
//! How files are written, and what was measured: `docs/lobes.md`.

mod between;
mod cap;
mod corner_table;
pub mod deform;
pub mod drag;
pub mod edit_stroke;
mod grid;
pub mod lobe;
mod loft;
mod order;
mod outline;
pub mod pairing;
pub mod remark;
pub mod remesh;
mod shape;
mod sheet;
mod strip;
mod stroke;
mod surface;
pub mod text;
mod turned;
mod untangle;

pub use lobe::{Crown, Form, Lobe, Offset, Pose, SpaceStroke, Trunk};
pub use remark::{Fault, Remark};
pub use remesh::Remesh;
pub use shape::{MOST_STROKES, Shaped, lofted, shape, shape_all, undeformed};
pub use surface::Surface;
