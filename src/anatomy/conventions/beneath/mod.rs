//! What plants stand in or on: pots and ground lines. It is set apart before all else is looked at.
//!
//! | file | what |
//! | --- | --- |
//! | `pot` | what a plant stands in |
//! | `pot_rows` | the two sides of a pot, row by row |
//! | `ground` | ground lines |

pub(crate) mod ground;
pub(crate) mod pot;
pub(crate) mod pot_rows;
