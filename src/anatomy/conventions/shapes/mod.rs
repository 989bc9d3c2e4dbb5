//! What the shapes of lines and areas tell, whatever the plant.
//!
//! | file | what |
//! | --- | --- |
//! | `balls` | round outlines as fruits |
//! | `forks` | twigs in a crown on a single line, which veins are like |
//! | `cells` | sets of cells of a grid: what is near them, what hangs together |
//! | `silhouette` | the area that strokes enclose together, on a grid; its rows and its contour |
//! | `medial_axis` | the middle lines of an area, a trunk and its arms |
//! | `lobes` | an outline cut at its notches toward a centre |
//! | `loops` | loops in a stroke, taken out of its way |
//! | `outline` | how wide an outline is, and where it stands |
//! | `spikes` | lines cut into what tapers to a tip |
//! | `teeth` | lines that are zigzags above the ground |
//! | `folds` | spikes by the sharp folds of an outline |
//! | `stem_tail` | a stem in one stroke with what it carries |

pub(crate) mod balls;
mod cells;
pub(crate) mod folds;
pub(crate) mod forks;
pub(crate) mod lobes;
pub(crate) mod loops;
pub(crate) mod medial_axis;
pub(crate) mod outline;
pub(crate) mod silhouette;
pub(crate) mod spikes;
pub(crate) mod stem_tail;
pub(crate) mod teeth;
