//! Trees, firs and bushes: crowns and what they stand on.
//!
//! | file | what |
//! | --- | --- |
//! | `tree` | a trunk of two sides with a crown, in any number of strokes |
//! | `tree_on_line` | a crown on a trunk that is a single line |
//! | `poplar_row` | slender crowns on short lines, side by side |
//! | `cloud_pads` | several clouds of foliage on one trunk |
//! | `bare` | a bare tree: boughs and twigs of single lines |
//! | `conifer` | a fir: what narrows to a point in steps |
//! | `bush` | a crown without a trunk: outline, open outline, scribble |
//! | `trunk` | the narrow stretch with two sides below a crown |
//! | `trunk_sides` | a trunk of two sides that leans or bends, or of one line |
//! | `trunk_foot` | the width of a trunk without its roots, and how it rises |
//! | `stacked` | what stands above what without coming near it: an open crown over its trunk |
//! | `tilted` | what leans a little, read as if upright |
//! | `half_crown` | crowns of which one side was left out |
//! | `half_fir` | firs of which one side is hidden or was left out |
//! | `in_blossom` | flowers drawn in a crown |
//! | `evidence` | what speaks for and against outlines of crowns |

pub(crate) mod bare;
pub(crate) mod bush;
pub(crate) mod cloud_pads;
pub(crate) mod conifer;
pub(crate) mod evidence;
pub(crate) mod half_crown;
pub(crate) mod half_fir;
pub(crate) mod in_blossom;
pub(crate) mod poplar_row;
pub(crate) mod stacked;
pub(crate) mod tilted;
pub(crate) mod tree;
pub(crate) mod tree_on_line;
pub(crate) mod trunk;
pub(crate) mod trunk_foot;
pub(crate) mod trunk_sides;
