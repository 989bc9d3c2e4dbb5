//! What a drawing looks like as a whole, where its lines by themselves leave it open.
//!
//! The ways of drawing in the other folders ask for much: an outline that is closed, a trunk with two sides. The network of
//! [`habit_classifier`](crate::anatomy::habit_classifier) looks at all lines at once and asks for nothing. It is used twice:
//! readings that make another plant of most of the drawing than it looks like lose some of what speaks for them ([`Looks::weigh`]),
//! and where the drawing clearly looks like a plant, it is also read in the plainest way for that plant ([`Looks::propose`]): its
//! head is what its lines enclose, its stalk what stands below. A reading that knows its lines wins over a plain one.
//!
//! | file | what |
//! | --- | --- |
//! | `looks` | how readings agree with what the drawing looks like |
//! | `plain` | what a plain reading says |
//! | `view` | the lines of a drawing, divided into a head and a stalk |
//! | `wood` | plain trees, bushes and palms |
//! | `fleshy` | plain mushrooms and cacti |
//! | `soft` | plain flowers, leaves and grass |
//! | `vessel` | plain pots |
//!
//! Limits: the network knows the ten kinds of drawings that it was trained on; gardens are not read plainly.

mod fleshy;
mod looks;
mod plain;
mod soft;
mod vessel;
mod view;
mod wood;

pub(super) use looks::Looks;
