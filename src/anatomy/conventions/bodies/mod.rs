//! Bodies that are neither wood nor blades: cacti, mushrooms, fruits.
//!
//! | file | what |
//! | --- | --- |
//! | `body` | the body of a cactus, a column with arms |
//! | `body_area` | what its lines enclose |
//! | `spines` | strokes across its outline and on it |
//! | `limbs` | the column and the arms of a body |
//! | `half_outline` | an outline that was not finished |
//! | `ball` | a ball cactus with ribs |
//! | `pads` | a prickly pear, pads on pads |
//! | `swollen` | an outline as one branch, as thick as that is wide |
//! | `mushroom` | a cap on a stalk |
//! | `fruits` | balls on stalks, and in crowns |

pub(crate) mod ball;
pub(crate) mod body;
mod body_area;
pub(crate) mod fruits;
pub(crate) mod half_outline;
pub(crate) mod limbs;
pub(crate) mod mushroom;
pub(crate) mod pads;
mod spines;
mod swollen;
