//! Gardens: thousands of plants that are copies of a few.
//!
//! ```text
//! GardenSpec ──plan──► Plan ──places──► Vec<Place> ──┐
//!   TOML               area, maps, paths  tiles      ├──► Model or InstancedModel
//! Vec<Model> ──► Stock, the individuals ──────────────┘    shapes once, poses many times
//! ```
//!
//! | file | what |
//! | --- | --- |
//! | `tiles` | corner-coloured Poisson-disk tiles |
//! | `area`, `grey_map`, `ground`, `ground_mesh` | ground plan, density maps, heights, those of an OBJ file |
//! | `walls` | walls along lines or from OBJ files, and where what climbs on them stands |
//! | `plan` | the garden before anything grows: beds, paths, kinds; what a plant at a place is like |
//! | `rows` | plants that are put: one by one, along lines, in rows |
//! | `lattice`, `occupied` | the tiles over one bed; what stands there already |
//! | `share` | shares of a garden that are made apart |
//! | `places` | where plants stand: all of these |
//! | `painted` | the garden as strokes on the ground: places and ground |
//! | `spec`, `error` | the garden as text, and why it may not be one |
//! | `stock` | the individuals that are copied |
//! | `crowding` | trees whose crowns grow through each other |
//! | `surface` | the ground and the paths as a closed slab |
//! | `scene`, `list` | all of it as one model of copies, or as a list of places |
//! | `seen` | what is looked at: plants that stay copies, in levels of detail |
//!
//! Source: 004 §3.3. Which of its numbers hold is in `docs/gardens.md`. Limits: copies of a plant are alike in everything but place, turn,
//! lean and size; files have no levels of detail, pictures have.

pub mod area;
pub mod crowding;
pub mod error;
pub mod grey_map;
pub mod ground;
pub mod ground_mesh;
mod lattice;
mod list;
mod occupied;
pub mod painted;
pub mod places;
pub mod plan;
mod rows;
pub mod scene;
pub mod seen;
pub mod share;
pub mod spec;
pub mod stock;
pub mod surface;
pub mod tiles;
pub mod walls;

pub use area::{Area, Outline};
pub use error::GardenError;
pub use painted::GardenParams;
pub use plan::{Kind, Place, Plan, PlanError, Stands, Variation};
pub use scene::Garden;
pub use seen::{Crowd, Seen};
pub use share::Share;
pub use spec::{Cover, GardenSpec, KindSpec, Origin};
pub use stock::{Coarser, Grown, Stock, Views};
pub use tiles::{Spot, TileSet};
pub use walls::{BeforeWall, Wall, WallSpec};
