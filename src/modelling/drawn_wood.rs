//! What is known of drawn wood after it was modelled: where branches can begin, and what poses moved.

use super::poses::Posed;
use crate::plant::{Branch, Plant};

/// Drawn wood as it was modelled.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawnWood {
    /// The branches before they grew on; none of a plant that did not grow, whose branches they are themselves.
    pub before_growth: Option<Vec<Branch>>,
    /// What poses moved, by the places of these branches.
    pub posed: Posed,
}

impl DrawnWood {
    /// The branches that somebody drew, each with its place, of the plant that they are a part of.
    pub fn branches<'a>(&'a self, plant: &'a Plant) -> impl Iterator<Item = (usize, &'a Branch)> {
        let all = self.before_growth.as_deref().unwrap_or(&plant.branches);
        all.iter().enumerate().filter(|(_, branch)| branch.origin.is_drawn())
    }
}
