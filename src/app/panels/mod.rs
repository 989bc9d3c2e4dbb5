//! Everything around the canvas: bars, side panel, menus and dialogs.
//!
//! Every panel is a function over the same four things: where to show itself, the [`Snapshot`] of the application, the
//! [`Messages`](crate::app::messages::Messages) of the chosen language, and a list of
//! [`Action`](crate::app::Action)s to which it adds what the artist asks for. Panels change nothing themselves; only
//! what concerns a panel alone (a search text, a folder that is looked at) is kept in egui's memory.
//!
//! Everything that can be touched is 40 logical pixels wide and high at least, and nothing needs a keyboard.

pub mod beside;
mod brush;
mod calibration;
pub mod dialogs;
pub mod export;
mod focus;
pub mod frame;
mod garden;
pub mod growth;
pub mod icons;
pub mod legend;
pub mod materials;
pub mod notices;
pub mod opening;
pub mod parameters;
pub mod part_menu;
mod path_dialog;
pub mod pen;
pub mod petals;
mod plant_search;
mod plant_tools;
mod pose;
pub mod presets;
pub mod rail;
pub mod readings;
pub mod season;
pub mod seed;
pub mod snapshot;
mod space;
pub mod species;
mod species_grid;
pub mod status;
mod tablet_keys;
mod thumbnails;
mod tiles;
pub mod toolbar;
pub mod view;
mod widgets;

pub use snapshot::Snapshot;
