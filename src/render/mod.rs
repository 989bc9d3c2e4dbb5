//! Pictures: a [`Model`](crate::model::Model) or a drawing seen by a camera, drawn by wgpu into memory.
//!
//! A [`Renderer`] owns the GPU and its pipelines, [`ModelDrawData`] is one uploaded model, and a target is what is
//! drawn into, so far a [`RenderedImage`]. Each kind of thing that is drawn is a trio of draw data, renderer and a WGSL file
//! of one name:
//!
//! | file | shader | draws |
//! | --- | --- | --- |
//! | `surface` | `surface.wgsl` | the plant: Blinn-Phong (000 §6.1), two-sided, with light shining through |
//! | `shadow` | `shadow.wgsl` | the plant's depth as each lamp sees it |
//! | `ground` | `ground.wgsl` | backdrop, and the shadow on it |
//! | `ink` | `ink.wgsl` | a drawing's strokes on paper |
//! | `mipmap` | `mipmap.wgsl` | the smaller levels of a texture |
//! | `canvas` | `paper.wgsl`, `reference.wgsl`, `stroke.wgsl` | the living drawing, into the window |
//! | `debug` | `debug.wgsl` | part colours and edges instead of materials |
//! | `overlay` | `overlay.wgsl` | spots and lines over the plant |
//! | `present` | `present.wgsl` | a finished picture into the texture that the window shows |
//!
//! `copies` are the shapes of which there are many, drawn with `placement.wgsl`; `crowd` are the plants of a garden, each as fine as its
//! size in the picture asks for (`crowd_choice`, `sight`), `shape` is what both have on the GPU. `full_screen` is what passes over all of a texture have in common, `uniform` a block of numbers for one pass.
//!
//! [`camera`], [`orbit`] and `light` are the mathematics of view and light and know no GPU; `studio` holds every number that
//! decides the look. [`viewport`] is a live view for the window: `resident` keeps a changing model on the GPU, in `pool`s
//! whose places an `arena` hands out. The same picture drawn twice on one machine is the same bytes.
//!
//! Variables that change space say so: `clip_from_world` takes world points to clip space.

pub mod camera;
pub mod canvas;
pub mod error;
pub mod orbit;
pub mod rendered_image;
pub mod viewport;
pub mod walk;

mod arena;
mod copies;
mod corner;
mod crowd;
mod crowd_choice;
mod debug;
mod drawn;
mod frame;
mod full_screen;
mod gpu;
mod ground;
mod ink;
mod light;
mod look;
mod material;
mod mipmap;
mod overlay;
mod pipeline;
mod pool;
mod present;
mod renderer;
mod resident;
mod scene;
mod shaders;
mod shadow;
mod shape;
mod sight;
mod studio;
mod surface;
mod target;
mod uniform;

pub use crate::picture::decode;
pub use camera::{Direction, Projection, View};
pub use canvas::{CanvasLayer, CanvasView};
pub use crowd_choice::CrowdChoice;
pub use error::RenderError;
pub use gpu::Gpu;
pub(crate) use gpu::{MEMORY_HINTS, limits as device_limits};
pub use light::LightParams;
pub use look::{Background, Look, Mode, Quality};
pub use material::TextureSource;
pub use orbit::OrbitCamera;
pub use overlay::Spot;
pub use rendered_image::RenderedImage;
pub use renderer::{ModelDrawData, PictureOptions, Renderer};
pub use resident::UploadStats;
pub use sight::Sight;
pub use viewport::{ShownPicture, Viewport};
