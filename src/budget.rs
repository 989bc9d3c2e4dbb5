//! What one plant may cost, whatever its parameters ask for.
//!
//! All is counted in things that are made or compared, never in time, so that the same drawing gives the same plant on
//! every machine. Every stage looks before it makes: where more would be wanted than is left, it makes less of it, evenly,
//! and a remark says so. Together the numbers keep any drawing of a megabyte below two gigabytes.

/// Most of everything in one plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Places along branches at which something may sprout, of one outline in one generation.
    pub growth_points: usize,
    /// Samples of branches and places inside of outlines that are looked at for them, for all outlines of a drawing together,
    /// about ten nanoseconds each.
    pub outline_looks: usize,
    /// Twigs that outlines are filled with.
    pub twigs: usize,
    /// Samples of all these twigs together.
    pub twig_samples: usize,
    /// Leaves that nobody drew.
    pub leaves: usize,
    /// Buds of flowers on a plant that grew.
    pub flower_buds: usize,
    /// Flowers of a tree in blossom, those that open from buds among them.
    pub blossoms: usize,
    /// Internodes that ever grow, shed ones counted.
    pub internodes: usize,
    /// Markers of space.
    pub markers: usize,
    /// Voxels of the shadow grid.
    pub voxels: usize,
    /// Elementary steps of growth, about a nanosecond each.
    pub growth_steps: u64,
    /// Comparisons of internodes that may overlap: for any plant, and more for each of its internodes.
    pub overlaps: (u64, u64),
    /// Triangles of all surfaces together.
    pub triangles: u64,
}

impl Budget {
    /// Of a plant; a drawing that grows while it is drawn has less of some. The plants beside a drawn one share it once more,
    /// and of the triangles each side has half.
    pub const PLANT: Self = Self {
        growth_points: 2_000_000,
        outline_looks: 150_000_000,
        twigs: 60_000,
        twig_samples: 2_000_000,
        leaves: 400_000,
        flower_buds: 6_000,
        blossoms: 24_000,
        internodes: 300_000,
        markers: 1_000_000,
        voxels: 32 << 20,
        growth_steps: 4_000_000_000,
        overlaps: (20_000_000, 200),
        triangles: 10_000_000,
    };

    /// What each of several plants may cost, so that together they cost no more than this. The number goes in powers of
    /// two: so one plant more seldom changes what the others may cost, and with it what they look like.
    #[must_use]
    pub const fn shared_by(self, plants: usize) -> Self {
        let parts = if plants == 0 { 1 } else { plants.next_power_of_two() };
        let Self { growth_points, outline_looks, twigs, twig_samples, leaves, flower_buds, blossoms, .. } =
            self;
        let Self { internodes, markers, voxels, growth_steps, overlaps, triangles, .. } = self;
        Self {
            growth_points: growth_points / parts,
            outline_looks: outline_looks / parts,
            twigs: twigs / parts,
            twig_samples: twig_samples / parts,
            leaves: leaves / parts,
            flower_buds: flower_buds / parts,
            blossoms: blossoms / parts,
            internodes: internodes / parts,
            markers: markers / parts,
            voxels: voxels / parts,
            growth_steps: growth_steps / parts as u64,
            overlaps: (overlaps.0 / parts as u64, overlaps.1),
            triangles: triangles / parts as u64,
        }
    }
}

/// Most of everything in one garden, whose plants are copies of few.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GardenBudget {
    /// Places of plants.
    pub places: usize,
    /// Tiles of the lattice that are looked through for them.
    pub tiles: usize,
    /// Individuals of which the plants are copies, all kinds together.
    pub variants: usize,
    /// Triangles of all these.
    pub variant_triangles: usize,
    /// Nodes of a GLB file: one for each plant.
    pub nodes: usize,
    /// Triangles of all plants where every one is written by itself.
    pub flat_triangles: usize,
    /// Triangles of all plants in a picture.
    pub drawn_triangles: usize,
    /// Cells of the ground's surface.
    pub ground_cells: usize,
}

impl GardenBudget {
    /// Plants of a garden that is painted: it is laid out anew with every sample of the pen.
    pub const PAINTED_PLACES: usize = 50_000;
    /// Tiles of the box around its beds that are looked at for each of its kinds.
    pub const PAINTED_BOX: usize = 500_000;
    /// Tiles that are looked through for each of its kinds.
    pub const PAINTED_TILES: usize = 5_000;
    /// Distances of a spot from a piece of a stroke that are found for each of its kinds.
    pub const PAINTED_EFFORT: usize = 1_000_000_000;
    /// Triangles of all its plants.
    pub const PAINTED_TRIANGLES: usize = 3_000_000;
    /// Cells of its ground.
    pub const PAINTED_CELLS: usize = 16_000;

    /// Of any garden.
    pub const GARDEN: Self = Self {
        places: 5_000_000,
        tiles: 2_000_000,
        variants: 4096,
        variant_triangles: 20_000_000,
        nodes: 1_000_000,
        flat_triangles: 10_000_000,
        drawn_triangles: 60_000_000,
        ground_cells: 40_000,
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plants_that_share_a_budget_cost_no_more_than_one_together() {
        assert_eq!(Budget::PLANT.shared_by(0), Budget::PLANT);
        assert_eq!(Budget::PLANT.shared_by(1), Budget::PLANT);
        for plants in 2..40 {
            let each = Budget::PLANT.shared_by(plants);
            assert!(plants * each.leaves <= Budget::PLANT.leaves);
            assert!(plants as u64 * each.triangles <= Budget::PLANT.triangles);
            assert!(2 * plants * each.internodes > Budget::PLANT.internodes / 2, "{plants}");
        }
        assert_eq!(Budget::PLANT.shared_by(3), Budget::PLANT.shared_by(4));
    }
}
