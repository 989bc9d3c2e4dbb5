//! What plants stand in, on or beside: pots, ground lines, fences and windows, what hangs in the air, and writing. It is set apart before all else is looked at.
//!
//! | file | what |
//! | --- | --- |
//! | `pot` | what a plant stands in |
//! | `pot_sides` | the sides of a pot that are lines of their own |
//! | `pot_rows` | the two sides of a pot, row by row |
//! | `trailing` | stems that trail over the edge of a pot |
//! | `ground` | ground lines |
//! | `frame` | windows, frames, fences |
//! | `aloft` | the sun, clouds, birds, what is written beside the plant |
//! | `writing` | words in capitals |

pub(crate) mod aloft;
pub(crate) mod frame;
pub(crate) mod ground;
pub(crate) mod pot;
pub(crate) mod pot_rows;
mod pot_sides;
mod trailing;
pub(crate) mod writing;
