//! Bodies that are neither wood nor blades: cacti, mushrooms, fruits.
//!
//! | file | what |
//! | --- | --- |
//! | `body` | the body of a cactus, a column with arms |
//! | `body_area` | what its lines enclose |
//! | `spines` | strokes across its outline and on it |
//! | `limbs` | the column and the arms of a body |
//! | `half_outline` | an outline that was not finished |
//! | `mushroom` | a cap on a stalk |
//! | `fruits` | balls on stalks, and in crowns |

pub(crate) mod body;
mod body_area;
pub(crate) mod fruits;
pub(crate) mod half_outline;
pub(crate) mod limbs;
pub(crate) mod mushroom;
mod spines;
