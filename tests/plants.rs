//! Plants, from drawings and by themselves: what is understood, what grows, and what must always hold of it.
//!
//! One program of tests out of many files: each would be linked by itself, with all libraries, otherwise.

mod blooms;
mod brushes;
mod budgets;
mod classifier;
mod cone_accuracy;
#[path = "common/cone_flowers.rs"]
mod cone_flowers;
mod corrections;
mod crowns;
#[path = "common/drawings.rs"]
mod drawings;
mod drawn_petals;
mod flower_points;
mod flower_poses;
mod flower_table;
mod flower_whorls;
mod ground;
mod grown;
mod grown_poses;
#[path = "common/in_space.rs"]
mod in_space;
mod inflorescences;
mod learned_depth;
mod live;
mod lobes;
mod obstacles;
mod organ_poses;
mod other_hands;
mod outlines;
#[path = "common/people.rs"]
mod people;
mod people_drawings;
mod people_silhouettes;
mod petal_shapes;
mod properties;
mod proposed_species;
mod seasons;
mod several;
mod sketches;
mod space;
mod textures;
mod wood;
