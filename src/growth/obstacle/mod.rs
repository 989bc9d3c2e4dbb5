//! What stands beside a plant: walls, frames, trellises. Wood grows around them, keeps a distance and stays out of their
//! shadow; climbing species go to them and hold on.
//!
//! | file | what |
//! | --- | --- |
//! | `obstacles` | triangles, and questions to them |
//! | `shapes` | walls and trellises from sizes |
//! | `params` | one behind a plant, from parameters |

mod obstacles;
mod params;
mod shapes;

pub use obstacles::{Contact, Obstacles};
pub use params::{KeptObstacles, ObstacleKind, ObstacleParams};
