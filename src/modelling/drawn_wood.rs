//! What is known of drawn wood after it was modelled: where branches can begin, and what poses moved.

use super::poses::Posed;
use crate::plant::{Branch, Plant};

/// Drawn wood as it was modelled.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawnWood {
    /// The branches before they grew on; none of a plant that did not grow, whose branches they are themselves.
    pub before_growth: Option<Vec<Branch>>,
    /// What poses moved.
    pub posed: Posed,
}

impl DrawnWood {
    /// The branches that somebody drew, each with its place, of the plant that they are a part of.
    pub fn branches<'a>(&'a self, plant: &'a Plant) -> impl Iterator<Item = (usize, &'a Branch)> {
        self.all(plant).iter().enumerate().filter(|(_, branch)| branch.origin.is_drawn())
    }

    /// The branch of a place among them.
    pub fn at<'a>(&'a self, plant: &'a Plant, index: usize) -> Option<&'a Branch> {
        self.all(plant).get(index)
    }

    fn all<'a>(&'a self, plant: &'a Plant) -> &'a [Branch] {
        self.before_growth.as_deref().unwrap_or(&plant.branches)
    }
}
