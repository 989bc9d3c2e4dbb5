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
    /// Of a plant; a drawing that grows while it is drawn has less of some.
    pub const PLANT: Self = Self {
        growth_points: 2_000_000,
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
}
