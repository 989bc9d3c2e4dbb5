//! Flowers from above and from the side.
//!
//! | file | what |
//! | --- | --- |
//! | `around` | which lines around a centre are its petals |
//! | `bell` | an outline that hangs from the end of a stem or pedicel |
//! | `bud` | a head without drawn petals on a stem: round, or a cup with few teeth |
//! | `corolla` | a corolla around a flower's centre |
//! | `corolla_on_stem` | a lobed outline at the end of a stem, without a centre |
//! | `cup` | petals that stand close together, seen from the side |
//! | `gathered` | petals that gather at one place, without a centre |
//! | `lotus` | pointed petals that stand on one foot without a stem |
//! | `rays` | single lines around a centre: thin petals, or a sun |
//! | `rings` | further rings of petals around a corolla |
//! | `rose` | a spiral, or arcs in a disc, on a stem |
//! | `row` | heads of any kind on stems side by side |
//! | `upright` | stems side by side, and what is drawn at their upper ends |

pub(crate) mod around;
pub(crate) mod bell;
pub(crate) mod bud;
pub(crate) mod corolla;
pub(crate) mod corolla_on_stem;
pub(crate) mod cup;
pub(crate) mod gathered;
pub(crate) mod lotus;
pub(crate) mod rays;
pub(crate) mod rings;
pub(crate) mod rose;
pub(crate) mod row;
pub(crate) mod upright;
