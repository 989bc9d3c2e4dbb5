//! One file per plant: where everything lies on the sheet.

pub mod balloon_flower;
pub mod bamboo;
pub mod bouquet;
pub mod daisy;
pub mod freehand;
pub mod garden;
pub mod hepatica;
pub mod jasmine;
pub mod mallow;
pub mod oxalis;
pub mod plumeria;
pub mod potted_plant;
pub mod sample;
pub mod topiary;
pub mod tree_round;
pub mod tree_willow;
pub mod trials;
