//! Leaves: outlines of blades in any number of strokes, with their midribs, veins and stalks.
//!
//! | file | what |
//! | --- | --- |
//! | `leaf` | a blade of several strokes, its midrib and veins, blade and stalk in one stroke |
//! | `leaf_area` | the blade that a group of lines encloses together: several strokes, halves, lobes |
//! | `open_ends` | what closes an outline whose arcs do not meet |
//! | `leaf_parts` | midrib, veins and stalk of a blade |
//! | `lobed_leaf` | a blade with pointed lobes on its stalk |
//! | `leaf_loops` | several leaves in one stroke |
//! | `above_pot` | leaves over a pot, without a stem |
//! | `clover` | notched leaflets about one place |
//! | `leafy_stem` | a twig: outlines of leaves along a line |
//! | `pinnate` | a frond of single lines, as a fern's |
//! | `leafy_branches` | a branched stem of lines with leaves at their ends and along them |
//! | `stem_loops` | leaves that are loops in the stroke of their stem |
//! | `double_stem` | a stem by its two sides |
//! | `strap` | long leaves of two edges from the foot of a stem |
//! | `stem_arcs` | leaves whose one edge is the stem |
//! | `potted_stem` | stems that rise from a pot, with what grows along them |
//! | `spurs` | where a stroke goes out and back over itself |
//! | `blade` | outlines of blades, of one stroke or two, and what they leave over |

pub(crate) mod above_pot;
pub(crate) mod blade;
pub(crate) mod clover;
pub(crate) mod double_stem;
pub(crate) mod leaf;
pub(crate) mod leaf_area;
pub(crate) mod leaf_loops;
pub(crate) mod leaf_parts;
pub(crate) mod leafy_branches;
pub(crate) mod leafy_stem;
pub(crate) mod lobed_leaf;
mod open_ends;
pub(crate) mod pinnate;
pub(crate) mod potted_stem;
pub(crate) mod spurs;
pub(crate) mod stem_arcs;
pub(crate) mod stem_loops;
pub(crate) mod strap;
