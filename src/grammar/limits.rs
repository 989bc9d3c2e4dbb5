//! What the text of a grammar and the drawing by it may cost: counted, never timed, so that the same text ends in the same
//! way on every machine.

/// Longest text of a grammar, bytes.
pub(super) const TEXT: usize = 64 << 10;
/// Most parameters of one module.
pub(super) const PARAMETERS: usize = 16;
/// Most levels of brackets and signs in one expression.
pub(super) const NESTING: u32 = 60;
/// Greatest distance of the turtle from where it starts, metres.
pub(super) const REACH: f64 = 1000.0;
/// Least radius of a stem, metres: what ends in a point ends in this.
pub(super) const LEAST_RADIUS: f32 = 1e-6;
/// Least and greatest scale.
pub(super) const SCALES: (f64, f64) = (1e-4, 1e4);

/// Most of what one drawing by a grammar may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Modules that are ever made, replaced ones counted.
    pub modules: u32,
    /// Levels of brackets in one another.
    pub brackets: usize,
    /// Derivation steps.
    pub steps: u32,
    /// Elementary steps of expressions, some nanoseconds each.
    pub operations: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { modules: 1_000_000, brackets: 60, steps: 100_000, operations: 60_000_000 }
    }
}
