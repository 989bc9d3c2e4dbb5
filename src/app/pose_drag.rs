//! What a drag does with a part of the plant that is posed.

/// What a drag on a part in the view of the plant does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PoseDrag {
    /// Turns it about its base.
    #[default]
    Turn,
    /// Bends it from its base to its end.
    Bend,
    /// Moves its base along what it grows on, or over the ground.
    Move,
    /// Sets it on another branch.
    Graft,
    /// Makes it a copy of another leaf, flower or fruit.
    Replace,
    /// Draws a loop around parts that are chosen together.
    Choose,
}
