//! Bodies that are neither wood nor blades: cacti and mushrooms.
//!
//! | file | what |
//! | --- | --- |
//! | `body` | the body of a cactus, a column with arms |
//! | `limbs` | the column and the arms of a body |
//! | `half_outline` | an outline that was not finished |
//! | `mushroom` | a cap on a stalk |

pub(crate) mod body;
pub(crate) mod half_outline;
pub(crate) mod limbs;
pub(crate) mod mushroom;
