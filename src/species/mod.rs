//! What the drawing does not say: a species' parameters, materials, blade forms and the heart of its flowers.
//!
//! A [`Species`] is read from a TOML file ([`mod@file`]); those in `assets/species` are part of the program
//! ([`builtin`]). [`dress()`] lays it over a [`Plant`](crate::plant::Plant): every branch and blade gets its material
//! and form, and what makes a flower alive is added: disc, stamens, pistil, sepals, the cup behind the petals, thorns
//! and pot. Thesis 000 names hearts of flowers among what is missing (conclusion) and has a library of materials and
//! textures without saying how it is kept (§6.1.1); 003 §3.3 places stamens in a ring by rule. Here all of it is data.
//!
//! Limits: a species never moves what was drawn. It adds parts and bends blades within their form.

pub mod blossom;
pub mod builtin;
pub mod dress;
pub mod file;
pub mod form;
mod ground;
pub mod heart;
pub mod looks;
pub mod palette;
pub mod part;
mod places;
pub mod pot;
pub mod seat;
pub mod sepals;
pub mod textures;
pub mod thorns;
pub mod threads;

pub use builtin::builtin_texture;
pub use dress::dress;
pub use file::SpeciesError;
pub use looks::Species;
pub use part::Part;
