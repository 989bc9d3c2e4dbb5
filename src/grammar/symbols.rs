//! The symbols that the turtle knows, and how many parameters each of them has.

use super::limits;
use std::ops::RangeInclusive;

/// What the turtle does at a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// Nothing: a symbol that only rules know.
    Nothing,
    /// Goes ahead and draws a stem.
    Draw,
    /// Goes ahead.
    Move,
    Turn(Turn),
    /// Turns back.
    TurnBack,
    /// Rolls until left is level.
    Level,
    /// Sets the radius.
    Radius,
    /// Scales what follows.
    Scale,
    /// Bends up or down.
    Tropism,
    /// Opens a bracket.
    Push,
    /// Closes a bracket.
    Pop,
    /// Places an organ, by its place in the grammar's list.
    Organ(u32),
    /// Places a ball.
    Ball,
    /// Places a cylinder and goes to its end.
    Cylinder,
}

/// A turn by an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    Left,
    Right,
    Down,
    Up,
    RollLeft,
    RollRight,
}

/// The turtle's symbols that are marks.
const MARKS: [(&str, Meaning); 13] = [
    ("+", Meaning::Turn(Turn::Left)),
    ("-", Meaning::Turn(Turn::Right)),
    ("&", Meaning::Turn(Turn::Down)),
    ("^", Meaning::Turn(Turn::Up)),
    ("\\", Meaning::Turn(Turn::RollLeft)),
    ("/", Meaning::Turn(Turn::RollRight)),
    ("|", Meaning::TurnBack),
    ("$", Meaning::Level),
    ("!", Meaning::Radius),
    ("\"", Meaning::Scale),
    ("~", Meaning::Tropism),
    ("[", Meaning::Push),
    ("]", Meaning::Pop),
];
/// Those that are letters.
pub(super) const LETTERS: [(&str, Meaning); 2] = [("F", Meaning::Draw), ("f", Meaning::Move)];
/// Solids, behind `@`.
pub(super) const SOLIDS: [(&str, Meaning); 2] = [("ball", Meaning::Ball), ("cylinder", Meaning::Cylinder)];

fn find(list: &[(&str, Meaning)], text: &str) -> Option<Meaning> {
    list.iter().find(|(name, _)| *name == text).map(|(_, meaning)| *meaning)
}

/// What a mark means.
pub(super) fn mark(text: &str) -> Option<Meaning> {
    find(&MARKS, text)
}

/// What a word means.
pub(super) fn letter(text: &str) -> Option<Meaning> {
    find(&LETTERS, text)
}

/// What a word behind `@` means.
pub(super) fn solid(text: &str) -> Option<Meaning> {
    find(&SOLIDS, text)
}

impl Meaning {
    /// How many parameters it may have.
    pub(super) fn parameters(self) -> RangeInclusive<usize> {
        match self {
            Self::TurnBack | Self::Level | Self::Push | Self::Pop => 0..=0,
            Self::Move | Self::Radius | Self::Scale | Self::Tropism | Self::Ball | Self::Turn(_) => 1..=1,
            Self::Cylinder => 2..=2,
            Self::Draw => 1..=3,
            Self::Organ(_) | Self::Nothing => 0..=limits::PARAMETERS,
        }
    }

    /// How it is written, for messages.
    pub(super) fn usage(self) -> &'static str {
        match self {
            Self::Draw => "write `F(length)`, `F(length, radius)` or `F(length, radius, end radius)`",
            Self::Move => "write `f(length)`",
            Self::Turn(_) => {
                "write the angle in degrees, as in `+(30)`, or declare `angle = 30` for all turns without one"
            }
            Self::TurnBack | Self::Level | Self::Push | Self::Pop => "it takes no parameters",
            Self::Radius => "write `!(radius)`",
            Self::Scale => "write `\"(factor)`",
            Self::Tropism => "write `~(strength)`, above 0 for up and below for down",
            Self::Ball => "write `@ball(radius)`",
            Self::Cylinder => "write `@cylinder(radius, length)`",
            Self::Organ(_) | Self::Nothing => "give it fewer",
        }
    }
}
