//! The window: draw on the left, the plant grows on the right.
//!
//! | file | what |
//! | --- | --- |
//! | `window` | receives events of the system and hands each to its owner |
//! | [`editor`] | the open drawing with everything around it, without window or graphics card |
//! | [`action`] | everything that the artist can ask for |
//! | [`canvas_tool`], [`dialog`], [`export_choice`], [`notice`], [`pen_uses`], [`stabiliser`], [`view_state`] | plain data that actions and settings are made of |
//! | [`canvas`] | what pens, fingers and keys do to the drawing |
//! | [`worker`] | the thread that builds the plant while the pen moves |
//! | [`paper`] | what must change on the canvas to show the drawing |
//! | [`sheet`] | the strokes as ink, in step with the drawing |
//! | [`plant_view`] | camera and light of the plant |
//! | [`tool`] | what a tool of a view is; [`plant_tools`]: those of the plant |
//! | [`tablet_actions`] | actions of keys of tablets |
//! | `plant_painter` | the thread that paints it, on a graphics device of its own |
//! | [`panels`] | bars, side panel, menus and dialogs |
//! | `layout` | where all of these are in a frame |
//! | `graphics` | the same frame on the graphics card; `revival`: when the card is lost |

mod accessibility;
pub mod action;
mod brush_settings;
mod build_threads;
pub mod canvas;
pub mod canvas_tool;
mod composition;
mod cut_meshes;
mod cut_strokes;
mod damage;
#[cfg_attr(not(target_os = "linux"), path = "desktop_of_system.rs")]
mod desktop;
pub mod dialog;
mod display_loss;
pub mod editor;
pub mod egui_input;
mod ending;
pub mod export_choice;
mod file_dialog;
pub mod fonts;
mod frame;
mod free_memory;
pub mod garden_brush;
mod graphics;
pub mod growth_spots;
mod invitation;
mod layout;
pub mod messages;
pub mod notice;
pub mod panels;
pub mod paper;
pub mod pen_settings;
pub mod pen_uses;
mod plant_painter;
pub mod plant_search;
mod plant_texture;
pub mod plant_tools;
pub mod plant_view;
mod pointers;
pub mod pose_drag;
pub mod presets;
mod priority;
mod revival;
pub mod settings;
pub mod sheet;
mod sides;
pub mod stabiliser;
mod stroke_colours;
mod surface;
mod system_theme;
pub mod tablet_actions;
pub mod tablet_keys;
mod tablets;
pub mod texture_cut;
pub mod texture_files;
pub mod theme;
mod thumbnail;
pub mod tool;
mod transfer;
pub mod view_state;
pub mod ways_to_read;
mod window;
pub mod window_size;
mod work_surface;
pub mod worker;
#[cfg(target_os = "linux")]
mod x11_desktop;

pub use action::Action;
pub use window::{replay, run};
