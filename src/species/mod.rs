//! What the drawing does not say: a species' parameters, materials, blade forms and the centres of its flowers.
//!
//! A [`Species`] is read from a TOML file ([`mod@file`]); those in `assets/species` are part of the program
//! ([`builtin`], [`builtin_textures`]). [`apply()`] makes a [`FinishedPlant`](crate::plant::FinishedPlant) with it: every branch and organ gets its material
//! and form, and what nobody draws is added: disc, stamens, pistil, sepals, the cup behind the petals, thorns
//! and pot. Thesis 000 names the centres of flowers among what is missing (conclusion) and has a library of materials and
//! textures without saying how it is kept (§6.1.1); 003 §3.3 places stamens in a ring by rule. Here all of it is data.
//!
//! Limits: a species never moves what was drawn. It adds parts and bends blades within their form.

pub mod apply;
pub mod blossom;
pub mod builtin;
pub mod builtin_textures;
mod cap;
mod compound_leaves;
pub mod filaments;
pub mod file;
mod flat_fruits;
pub mod flower_params;
pub mod form;
pub mod fruit_look;
mod fruits;
mod full;
mod ground;
pub mod inflorescence;
pub mod looks;
mod materials;
mod places;
pub mod pot;
pub mod receptacle;
pub mod season;
pub mod seat;
pub mod sepals;
pub mod textures;
pub mod thorns;

pub use apply::{Applied, apply, apply_within};
pub use builtin_textures::builtin_texture;
pub use file::SpeciesError;
pub use flower_params::FlowerParams;
pub use inflorescence::Inflorescence;
pub use looks::Species;
pub use season::SeasonParams;
