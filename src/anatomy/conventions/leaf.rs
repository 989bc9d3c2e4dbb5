//! Not written yet.

use super::{Hypothesis, page::Page};

pub(super) fn propose(_: &Page, _: &mut Vec<Hypothesis>) {}
