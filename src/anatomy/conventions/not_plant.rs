//! Not written yet.

use super::{Hypothesis, page::Page};

pub fn propose(_: &Page, _: &mut Vec<Hypothesis>) {}
