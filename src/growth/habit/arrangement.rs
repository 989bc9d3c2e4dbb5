//! Phyllotaxis: how buds and leaves stand around the axis that carries them.

crate::parameter_choice! {
    /// How the buds of an axis, or its leaves, are arranged.
    pub enum Arrangement {
        /// One per node, turned by the divergence angle.
        Spiral = "spiral",
        /// One per node, left and right in turn; branches are flat sprays.
        Alternate = "alternate",
        /// Pairs, each square to the one below.
        Opposite = "opposite",
        /// A ring at the end of each year's shoot.
        Whorl = "whorl",
    }
}
