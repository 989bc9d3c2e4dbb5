//! Outlines of twigs and leaves keep within a budget, say so, and give a plant of few parts.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use crate::drawings;
use penstemon::pipeline;
use penstemon::sketch::Remark;
use std::path::Path;

#[test]
fn an_outline_that_asks_for_too_much_is_filled_more_thinly_and_says_so() {
    let mut tree = drawings::leafy_tree(60_000);
    tree.params.remove("anatomy.leaf_fill.max_leaves");
    tree.params.insert("anatomy.twigs.spacing".into(), 0.008.into());
    let species = pipeline::species_of(&tree, Path::new("")).unwrap();
    let params = pipeline::params_of(&tree, &species, &[]).unwrap();
    let built = pipeline::build(&tree, &species, &params);
    let parts = built.model.parts.len();
    assert!(parts <= 4, "{parts} parts: {:?}", built.model.parts.iter().map(|p| &p.name).collect::<Vec<_>>());
    let triangles = built.model.triangle_count();
    assert!(triangles <= 1_000_000, "{triangles} triangles");
    let remarks: Vec<&Remark> = built.remarks.iter().map(|warning| &warning.remark).collect();
    assert!(remarks.contains(&&Remark::FilledThinly), "{remarks:?}");
}
