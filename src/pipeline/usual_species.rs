//! The species of drawings that name none: one that looks like what the drawing shows.

use crate::anatomy::conventions::Habit;

/// Species of a sketch that names none and shows none in particular.
pub const DEFAULT_SPECIES: &str = "plant";

/// The built-in species of drawings that name none but show such a plant.
pub fn species_of_habit(habit: Option<Habit>) -> &'static str {
    match habit {
        Some(Habit::Tree) => "oak",
        Some(Habit::Conifer) => "spruce",
        Some(Habit::Bush) => "hazel",
        Some(Habit::Palm) => "palm",
        Some(Habit::Grass) => "grass",
        Some(Habit::Succulent) => "cactus",
        Some(Habit::Mushroom) => "mushroom",
        _ => DEFAULT_SPECIES,
    }
}
