//! What grows in tufts: blades of grass, and fronds at the top of a trunk.
//!
//! | file | what |
//! | --- | --- |
//! | `grass` | a zigzag, or lines side by side: blades of grass |
//! | `lawn` | short lines at the foot of something else |
//! | `tuft` | blades from one place near the ground |
//! | `fronds` | lines or lobes that radiate from a trunk's top |
//! | `frond_crown` | what speaks for fronds about a place |
//! | `frond_details` | fruit among fronds, and the leaflets of fronds |

pub(crate) mod frond_crown;
pub(crate) mod frond_details;
pub(crate) mod fronds;
pub(crate) mod grass;
pub(crate) mod lawn;
pub(crate) mod tuft;
