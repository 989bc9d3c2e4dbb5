//! Why a garden's text gives no garden: what is wrong, in which file or of which plant, and what to do.

use super::grey_map::MapError;
use super::ground_mesh::GroundMeshError;
use super::plan::PlanError;
use super::walls::WallError;
use crate::budget::GardenBudget;
use glam::Vec2;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// A garden that cannot be laid out.
#[derive(Debug, Error)]
pub enum GardenError {
    /// The file cannot be read.
    #[error("cannot read the garden {}: {source}", .file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// Not TOML, an unknown key, a wrong type or a number out of range.
    #[error("{file}, line {line}, `{text}`: {reason}")]
    Invalid {
        /// The file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// What stands in that line.
        text: String,
        /// What is wrong with it.
        reason: String,
    },
    /// Nothing says where the garden is.
    #[error("the garden has no area; write area = \"40x25\" in its file, or give --area 40x25: metres")]
    NoArea,
    /// The area is none.
    #[error("the garden's area: {0}")]
    Area(String),
    /// Nothing says what grows.
    #[error("nothing grows in the garden; name species or drawings, or add sections [[plants]] to its file")]
    NoPlants,
    /// A density map or a picture of heights cannot be used.
    #[error("{whose}: {}: {fault}", .file.display())]
    Map {
        /// Whose it is.
        whose: String,
        /// The picture.
        file: PathBuf,
        /// What is wrong with it.
        fault: MapError,
    },
    /// A map keeps everything away.
    #[error("{whose}: {}: the density map is black everywhere, so nothing grows; white is the full density", .file.display())]
    Black {
        /// Whose it is.
        whose: String,
        /// The picture.
        file: PathBuf,
    },
    /// A file of the ground's surface cannot be used.
    #[error("the ground: {}: {fault}", .file.display())]
    GroundMesh {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        fault: GroundMeshError,
    },
    /// Two files say how high the ground is.
    #[error("the ground has a picture and a mesh; give one of `map` and `mesh`")]
    TwoGrounds,
    /// Two beds have one name.
    #[error("two beds are called `{0}`; give each a name of its own")]
    TwoBeds(String),
    /// A wall cannot be built.
    #[error("the wall {name}: {fault}")]
    Wall {
        /// What it is called.
        name: String,
        /// What is wrong with it.
        fault: WallError,
    },
    /// Plants climb on a wall that there is not.
    #[error("{whose}: there is no wall `{wall}`{known}")]
    NoWall {
        /// Whose wall it should be.
        whose: String,
        /// What it is called.
        wall: String,
        /// Which ones there are.
        known: String,
    },
    /// More plants climb on a wall than are grown each by itself.
    #[error(
        "{whose}: about {plants:.0} plants would climb on the wall, each grown by itself; a garden has at most {} of them; choose a larger \
         spacing", GardenBudget::GARDEN.variants
    )]
    TooManyClimbers {
        /// Whose plants.
        whose: String,
        /// How many.
        plants: f32,
    },
    /// It is not clear where plants climb on a wall.
    #[error("{whose}: the wall `{wall}` is from a file; say where its plants stand with `lines` or `at`")]
    NoFeet {
        /// Whose plants.
        whose: String,
        /// Their wall.
        wall: String,
    },
    /// Plants grow in a bed that there is not.
    #[error("{whose}: there is no bed `{bed}`{known}")]
    NoBed {
        /// Whose bed it should be.
        whose: String,
        /// What it is called.
        bed: String,
        /// Which ones there are.
        known: String,
    },
    /// A plant stands beside the garden.
    #[error("{whose}: the plant at [{}, {}] stands outside of the area; move it, or make the area larger", .at.x, .at.y)]
    Outside {
        /// Whose plant it is.
        whose: String,
        /// Where.
        at: Vec2,
    },
    /// The plants do not stand as they should.
    #[error(transparent)]
    Plan(#[from] PlanError),
}
