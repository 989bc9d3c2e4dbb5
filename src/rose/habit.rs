//! The numbers of a rose plant: the section `[rose]` of a species file, and the parameters `rose.…`.
//!
//! Defaults are those of 004 §2 and table 1 where they agree. Where they do not: branches tilt by 25–35° in the text and by
//! 47–66° in the table, so 45° ± 12° here; the sample of the table is higher than the text's range, so 55 to 80 cm here.

crate::parameters! {
    /// How a rose plant is built.
    pub struct RoseHabit {
        /// Height of the plant.
        height: f32 = 0.67, 0.05..=4.0, "metres";
        /// How much heights differ.
        height_vary: f32 = 0.18, 0.0..=0.9, "of the height";
        /// Main stems from the ground.
        stems: u32 = 1, 1..=12, "";
        /// Orders of branches.
        orders: u32 = 2, 0..=4, "";
        /// Branches of the first order on each main stem.
        branches: u32 = 3, 0..=12, "";
        /// Branches of each further order, on all of the order before together.
        twigs: u32 = 4, 0..=40, "";
        /// Length of a branch against what carries it.
        shorter: f32 = 0.52, 0.1..=1.0, "of the length";
        /// How far main stems lean.
        lean_deg: f32 = 5.0, 0.0..=60.0, "degrees";
        /// How far each unit of a stem turns from the one below.
        bow_deg: f32 = 4.0, 0.0..=30.0, "degrees";
        /// Angle between branches and what carries them.
        tilt_deg: f32 = 45.0, 0.0..=110.0, "degrees";
        /// How much that angle differs.
        tilt_vary_deg: f32 = 12.0, 0.0..=45.0, "degrees";
        /// Radius of a main stem at its foot.
        radius: f32 = 0.0055, 0.0005..=0.1, "metres";
        /// Radius at the end of a stem.
        taper: f32 = 0.45, 0.05..=1.0, "of the radius";
        /// Radius of a branch against what carries it there.
        thinner: f32 = 0.7, 0.2..=1.0, "of the radius";
        /// Least share of a stem's length at which branches leave it.
        place_from: f32 = 0.2, 0.0..=1.0, "of the length";
        /// Greatest share of a stem's length at which branches leave it.
        place_to: f32 = 0.6, 0.0..=1.0, "of the length";
        /// Weight of the lowest fifth of a stem for branches.
        weight_1: f32 = 5.0, 0.0..=100.0, "";
        /// Weight of the second fifth.
        weight_2: f32 = 30.0, 0.0..=100.0, "";
        /// Weight of the middle fifth.
        weight_3: f32 = 40.0, 0.0..=100.0, "";
        /// Weight of the fourth fifth.
        weight_4: f32 = 20.0, 0.0..=100.0, "";
        /// Weight of the highest fifth.
        weight_5: f32 = 5.0, 0.0..=100.0, "";
        /// Turn from one branch, or leaf, to the next.
        divergence_deg: f32 = 137.5, 0.0..=180.0, "degrees";
        /// How much that turn differs.
        divergence_vary_deg: f32 = 6.0, 0.0..=90.0, "degrees";
        /// Share of branches whose turn is any from 60° to 180°.
        outliers: f32 = 0.08, 0.0..=1.0, "";
        /// Distance of leaves along a stem.
        internode: f32 = 0.055, 0.005..=1.0, "metres";
        /// Length of a whole leaf.
        leaf: f32 = 0.125, 0.005..=1.0, "metres";
        /// Angle between leaves and stem at its foot.
        leaf_deg: f32 = 60.0, 0.0..=120.0, "degrees";
        /// The same near its tip.
        leaf_tip_deg: f32 = 40.0, 0.0..=120.0, "degrees";
        /// Share of a stem from its tip on where leaves are young and half as large.
        young: f32 = 0.15, 0.0..=1.0, "of the length";
        /// Distance from the centre of a flower to its tips.
        flower: f32 = 0.036, 0.002..=0.5, "metres";
        /// Share of flowers that are still buds in bloom.
        buds: f32 = 0.2, 0.0..=1.0, "";
        /// How steeply stems that climb rise along their support; 0 for those that stand.
        climb: f32 = 0.0, 0.0..=1.0, "";
    }
}

/// What a rose shows at a time of the year.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Season {
    /// Share of the leaves that are there, and their size.
    pub leaves: f32,
    /// How far flowers have opened; none outside of the time from buds to bloom.
    pub open: Option<f32>,
    /// Size of the hips; 0 for none.
    pub hips: f32,
    /// Share of the leaves that are coloured.
    pub coloured: f32,
    /// Share of the leaves that are young.
    pub young: f32,
}

impl Season {
    /// What is seen at a time of the year, which all species count alike: 0 leaves unfold, 1 buds, 2 bloom, 3 hips, 4 autumn, 5 bare.
    pub fn at(time: f32) -> Self {
        let ramp = |from: f32, to: f32| ((time - from) / (to - from)).clamp(0.0, 1.0);
        Self {
            leaves: (0.35 + 0.65 * ramp(0.0, 1.0)) * (1.0 - ramp(4.2, 5.0)),
            open: (0.6..2.8).contains(&time).then(|| ramp(1.0, 2.0)),
            hips: if time >= 2.6 { 0.5 + 0.5 * ramp(2.6, 3.2) } else { 0.0 },
            coloured: ramp(3.4, 4.0),
            young: 1.0 - ramp(0.0, 0.9),
        }
    }
}

impl RoseHabit {
    /// The weights of the fifths of a stem for branches; equal ones where none is more than 0.
    pub fn weights(&self) -> [f32; 5] {
        let weights = [self.weight_1, self.weight_2, self.weight_3, self.weight_4, self.weight_5];
        if weights.iter().sum::<f32>() > 0.0 { weights } else { [1.0; 5] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seasons_follow_each_other() {
        let at = Season::at;
        assert_eq!((at(2.0).open, at(2.0).hips, at(2.0).leaves), (Some(1.0), 0.0, 1.0));
        assert_eq!((at(1.0).open, at(0.0).open, at(3.5).open), (Some(0.0), None, None));
        assert!(at(3.5).hips == 1.0 && at(4.0).coloured == 1.0 && at(5.0).leaves == 0.0);
        assert!(at(0.0).young == 1.0 && at(0.0).leaves < at(1.0).leaves);
    }

    #[test]
    fn weights_that_are_all_nothing_are_equal() {
        let none = RoseHabit {
            weight_1: 0.0,
            weight_2: 0.0,
            weight_3: 0.0,
            weight_4: 0.0,
            weight_5: 0.0,
            ..RoseHabit::default()
        };
        assert_eq!(none.weights(), [1.0; 5]);
    }
}
