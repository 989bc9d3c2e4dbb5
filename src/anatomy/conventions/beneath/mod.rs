//! What plants stand in, on or beside: pots, ground lines, fences and windows. It is set apart before all else is looked at.
//!
//! | file | what |
//! | --- | --- |
//! | `pot` | what a plant stands in |
//! | `pot_rows` | the two sides of a pot, row by row |
//! | `ground` | ground lines |
//! | `frame` | windows, frames, fences |

pub(crate) mod frame;
pub(crate) mod ground;
pub(crate) mod pot;
pub(crate) mod pot_rows;
