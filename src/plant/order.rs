//! The branches of a plant in an order in which each stands behind its parent.

use super::{FlowerBuds, Plant};

impl Plant {
    /// Puts branches behind their parents, and leaves them as they are otherwise; says where each has come to. No branch may
    /// stand on itself or on what it carries.
    pub fn put_parents_first(&mut self, buds: &mut FlowerBuds) -> Vec<usize> {
        let places = self.places_behind_parents();
        if places.is_sorted() {
            return places;
        }
        let mut branches: Vec<_> = std::mem::take(&mut self.branches).into_iter().zip(&places).collect();
        branches.sort_by_key(|(_, place)| **place);
        self.branches = branches.into_iter().map(|(branch, _)| branch).collect();
        let of_branches = self.branches.iter_mut().map(|branch| &mut branch.parent);
        let of_organs = self.organs.iter_mut().map(|organ| &mut organ.branch);
        let of_flowers = self.flowers.iter_mut().map(|flower| &mut flower.branch);
        let of_buds = buds.buds.iter_mut().map(|bud| &mut bud.branch);
        for branch in of_branches.chain(of_organs).chain(of_flowers).chain(of_buds) {
            *branch = branch.map(|branch| places[branch]);
        }
        places
    }

    /// Where each branch comes to; one whose parent is behind it waits for that.
    fn places_behind_parents(&self) -> Vec<usize> {
        const NONE: usize = usize::MAX;
        let mut places = vec![NONE; self.branches.len()];
        let mut waiting: Vec<Vec<usize>> = vec![Vec::new(); self.branches.len()];
        let mut placed = 0;
        for (index, branch) in self.branches.iter().enumerate() {
            if let Some(parent) = branch.parent.filter(|parent| places[*parent] == NONE) {
                waiting[parent].push(index);
                continue;
            }
            let mut next = vec![index];
            while let Some(index) = next.pop() {
                places[index] = placed;
                placed += 1;
                next.extend(waiting[index].drain(..).rev());
            }
        }
        debug_assert_eq!(placed, places.len(), "every branch stands on the ground in the end");
        places
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Branch, Origin, Role, WoodPart};
    use glam::Vec3;

    #[test]
    fn what_waits_for_its_parent_comes_behind_it_and_the_rest_stays() {
        let branch = |parent: Option<usize>, height: f32| Branch {
            origin: Origin::Generated,
            parent,
            level: 0,
            points: vec![Vec3::ZERO, Vec3::Y * height],
            radii: vec![0.01; 2],
            role: Role::of(WoodPart::Stem),
        };
        // Two trunks; the first bough and its twig stand on the other trunk's bough.
        let parents = [None, Some(4), Some(1), None, Some(3)];
        let branches = parents.iter().zip(1..).map(|(parent, n)| branch(*parent, n as f32)).collect();
        let mut plant = Plant { branches, ..Plant::default() };
        assert_eq!(plant.put_parents_first(&mut FlowerBuds::default()), [0, 3, 4, 1, 2]);
        let found: Vec<(Option<usize>, f32)> =
            plant.branches.iter().map(|branch| (branch.parent, branch.points[1].y)).collect();
        let expected = [(None, 1.0), (None, 4.0), (Some(1), 5.0), (Some(2), 2.0), (Some(3), 3.0)];
        assert_eq!(found, expected);
        assert_eq!(plant.put_parents_first(&mut FlowerBuds::default()), [0, 1, 2, 3, 4]);
    }
}
