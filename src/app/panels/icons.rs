//! Icons, drawn by the program: no icon font knows petals, leaves and outlines.
//!
//! Each icon is a few SVG paths on a grid of 24 × 24, stroked with round joins by egui's painter, so that it is sharp at
//! any scale and takes any colour. A path that begins with `*` is filled; filled paths must be convex.

use egui::epaint::{PathShape, PathStroke};
use egui::{Color32, Painter, Pos2, Rect, Stroke, pos2};
use kurbo::{BezPath, PathEl};
use std::sync::OnceLock;

/// Side of the grid that icons are drawn on.
const GRID: f32 = 24.0;
/// Width of lines on the grid.
const LINE: f32 = 1.7;
/// Farthest that a drawn curve may leave the true one, on the grid.
const TOLERANCE: f64 = 0.05;

macro_rules! icons {
    ($($(#[doc = $about:literal])+ $icon:ident: [$($path:literal),+];)*) => {
        /// An icon.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Icon { $($(#[doc = $about])+ $icon,)* }

        impl Icon {
            /// Every icon.
            pub const ALL: &'static [Icon] = &[$(Icon::$icon),*];

            fn paths(self) -> &'static [&'static str] {
                match self { $(Icon::$icon => &[$($path),+]),* }
            }
        }
    };
}

icons! {
    /// The pen that draws anything.
    Pen: ["M4 20 L5.5 14.5 L16 4 L20 8 L9.5 18.5 Z", "M13.5 6.5 L17.5 10.5", "M5.5 14.5 L9.5 18.5"];
    /// One petal.
    Petal: ["M12 21 C6 16 4 9.5 7.5 5 C9 3 11 3.4 12 5 C13 3.4 15 3 16.5 5 C20 9.5 18 16 12 21 Z", "M12 20 L12 12", "M12 17 L9.5 13", "M12 17 L14.5 13"];
    /// A petal with points to move.
    Petals: ["M12 19 C7 15.5 5.5 11 8.2 7.6 C9.6 6 11 6.3 12 7.6 C13 6.3 14.4 6 15.8 7.6 C18.5 11 17 15.5 12 19 Z", "M2.5 2.5 L6 2.5 L6 6 L2.5 6 Z", "M18 2.5 L21.5 2.5 L21.5 6 L18 6 Z", "M10.2 19 L13.8 19 L13.8 22.5 L10.2 22.5 Z", "M6 4.2 L18 4.2"];
    /// One leaf.
    Leaf: ["M5 19 C4 10 9 4 20 4 C20.5 14 15 20 6 18.5", "M3.5 21 C7 15 11 11.5 15.5 8.5", "M9 14.3 L9 10.5", "M10.5 12.8 L15 13.5"];
    /// A branch that forks.
    Branch: ["M12 22 C12 17 11.5 14 12 10 C12.2 7 13 5 14.5 2.5", "M11.8 15 C9 13.5 7 11 5.5 7.5", "M12 11.5 C14.5 11 17.5 9.5 19.5 7"];
    /// A branch in a box.
    SpaceBranch: ["M3 8 L12 3 L21 8 L21 17 L12 22 L3 17 Z", "M3 8 L12 13 L21 8", "M12 13 L12 22", "M12 18 C13 14.5 15 12 18.5 11.5", "M14 14.4 C13.6 11 11.5 8.5 9 7.5"];
    /// A brush with a leaf at its tip.
    GrowthBrush: ["M21 3 L13 11", "M13 11 L15 13 L10.5 16 L9 14.5 Z", "M9 15.5 C4 14.5 2.5 17.5 3 21.5 C7 22 9.8 20 9.3 15.8", "M3 21.5 L6.5 18"];
    /// A brush beside a twig with leaves.
    LeafBrush: ["M21 3 L14 10", "M14 10 L16 12 L11.5 15 L10 13.5 Z", "M3 22 C5 19.5 6.5 17 8.5 15.5", "M5 19.5 C2 18.5 1.8 15.5 3 13 C5.5 14.5 6.3 17 5 19.5 Z", "M6 18.3 C8.5 21 11 20.8 13 19 C11 17 8.5 16.8 6 18.3 Z"];
    /// A brush beside a flower.
    FlowerBrush: ["M21 3 L14 10", "M14 10 L16 12 L11.5 15 L10 13.5 Z", "M7.5 17 C7.5 15.9 6.6 15 5.5 15 C4.4 15 3.5 15.9 3.5 17 C3.5 18.1 4.4 19 5.5 19 C6.6 19 7.5 18.1 7.5 17 Z", "M4 15 C2.5 12.5 4 11 5.5 11 C7 11 8.5 12.5 7 15", "M7.5 16 C10 15.5 11 17.5 10.5 19 C9.8 20.5 8 20.3 6.8 19", "M4.2 19 C3 20.3 1.2 20.5 0.6 19 C0 17.5 1 15.5 3.5 16"];
    /// A brush over a twig that is cut.
    PruningBrush: ["M21 3 L13 11", "M13 11 L15 13 L10.5 16 L9 14.5 Z", "M3 21 L7 17", "M4.5 13.5 L10 20", "M14 21 L20 17.5", "M17 19.3 L17.5 16"];
    /// A brush with rays at its tip.
    LightBrush: ["M21 3 L14 10", "M14 10 L16 12 L11.5 15 L10 13.5 Z", "M7.2 20 C7.2 18.8 6.2 17.8 5 17.8 C3.8 17.8 2.8 18.8 2.8 20 C2.8 21.2 3.8 22.2 5 22.2 C6.2 22.2 7.2 21.2 7.2 20 Z", "M5 15.5 L5 13.5", "M9.5 20 L11.5 20", "M8.1 16.9 L9.4 15.6", "M1.9 16.9 L1.2 16.2"];
    /// Three plants on the ground.
    Garden: ["M2 20 L22 20", "M6 20 L6 13", "M6 16 C3.5 16 2.8 13.5 2.8 12 C5 12 6 14 6 16", "M12 20 L12 9", "M12 13 C9.5 13 8.5 10.5 8.5 8.5 C11 8.5 12 10.5 12 13", "M12 12 C14.5 12 15.5 9.5 15.5 7.5 C13 7.5 12 9.5 12 12", "M18 20 L18 13", "M18 16 C20.5 16 21.2 13.5 21.2 12 C19 12 18 14 18 16"];
    /// A bed with plants.
    GardenPlants: ["M3 17 C6 14 18 14 21 17 C18 21 6 21 3 17 Z", "M8 16.5 L8 9", "M8 12 C6 12 5 10 5 8.5 C7 8.5 8 10 8 12", "M15 16.5 L15 7", "M15 11 C17 11 18.5 9 18.5 7 C16.5 7 15 9 15 11"];
    /// A path that narrows toward the horizon.
    GardenPath: ["M4 21 C8 15 5 11 10.5 6", "M16 21 C17 15 12 11 13 6", "M3 6 L21 6"];
    /// Ground with a cross.
    GardenClear: ["M3 17 C6 14 18 14 21 17 C18 21 6 21 3 17 Z", "M9 5 L15 11", "M15 5 L9 11"];
    /// Somebody who walks.
    Walk: ["M13.6 4 C13.6 5 12.9 5.7 12 5.7 C11.1 5.7 10.4 5 10.4 4 C10.4 3 11.1 2.3 12 2.3 C12.9 2.3 13.6 3 13.6 4 Z", "M12 7.5 L11.2 14 L14.5 17 L15.8 22", "M11.2 14 L9.5 18 L6.5 21.5", "M7 12.5 L8.5 9.5 L12 7.5 L14 11 L17.5 12"];
    /// An upright pane that faces the viewer.
    FacingSurface: ["M5 4 L19 4 L19 20 L5 20 Z", "M8 16.5 C9 12 12 9 16 7.5"];
    /// A level pane.
    LevelSurface: ["M7.5 8 L22 8 L16.5 17 L2 17 Z", "M6.5 14.8 C9 11.5 13 10 17.5 10.2"];
    /// A pane that stands on a bent line.
    LiftedSurface: ["M3 20 C8 15.5 14 22 21 17.5", "M3 20 L3 9 C8 4.5 14 11 21 6.5 L21 17.5", "M5.5 15.5 C10 12.5 13.5 14.5 18.5 9.5"];
    /// A branch that is turned about its foot.
    TurnBranch: ["M5 21 L5 4", "M5 21 L18 9", "M8.5 6 C13 5.5 16.5 7 18.5 8.5", "M15.2 4.6 L18.7 8.7 L13.6 9.6"];
    /// A part of the plant taken by the hand: a leaf on a stem, and a pointer.
    PoseParts: ["M6 22 L6 3", "M6 15 C9 15 10 10 14.5 9 C13 13.5 10 15.5 6 15", "M13.5 13.5 L21 16.5 L17.7 17.7 L16.5 21 Z"];
    /// A leaf that slides along its stem.
    SlideLeaf: ["M6 22 L6 3", "M6 17 C9 17 10 12 14.5 11 C13 15.5 10 17.5 6 17", "M19 20 L19 5", "M16.6 7.6 L19 5 L21.4 7.6", "M16.6 17.4 L19 20 L21.4 17.4"];
    /// A twig that is set on another stem.
    GraftBranch: ["M5 22 L5 3", "M5 9 L8.5 5.5", "M19 22 L19 3", "M19 14 L13.5 8.5", "M16.2 11.2 L13 12.5", "M7.5 15.5 L14.5 15.5", "M12 13 L14.5 15.5 L12 18"];
    /// A leaf that becomes a flower.
    ReplaceOrgan: ["M3 20 C2.6 14.5 5.5 11.5 11 12 C11.4 17.5 8.5 20.5 3 20 Z", "M3 20 L8 15", "M17.5 9.2 C18.6 9.2 19.5 8.3 19.5 7.2 C19.5 6.1 18.6 5.2 17.5 5.2 C16.4 5.2 15.5 6.1 15.5 7.2 C15.5 8.3 16.4 9.2 17.5 9.2 Z", "M17.5 5.2 C15.8 3 19.2 3 17.5 5.2 M19.5 7.2 C21.8 5.5 21.8 8.9 19.5 7.2 M17.5 9.2 C19.2 11.4 15.8 11.4 17.5 9.2 M15.5 7.2 C13.2 8.9 13.2 5.5 15.5 7.2", "M13.5 19.5 C17 19.5 18.5 18 18.5 14.5 M16 16.5 L18.5 14 L21 16.5"];
    /// A branch that stops at another.
    StopAtWood: ["M17 22 L17 2.5", "M3.5 19 L12.5 10.5", "M13.5 5.5 L13.5 14.5", "M4 9 C5.5 6.5 7.5 5 10 4.5"];
    /// A branch that slides along another.
    SlideAlongWood: ["M17 22 L17 2.5", "M3.5 19 L13.5 9.5", "M11 7.5 L11 2.8 M8.6 5 L11 2.6 L13.4 5"];
    /// A branch that is bent.
    BendBranch: ["M5 21 L5 4", "M5 21 C5 13 9 8 18.5 7", "M8 3.5 C11 2.8 14 3.6 16.5 6", "M12.8 6.8 L17 6.4 L16.4 2.4"];
    /// Twigs inside an outline.
    BranchOutline: ["M9 3.2 L11 2.5", "M14 2.6 L16.2 3.8", "M18.8 6 L20 8.5", "M20.3 11.5 L19.4 14", "M17.4 16 L15 17", "M4.6 6.2 L3.8 8.8", "M3.8 11.6 L4.9 14", "M6.9 16 L9.2 17", "M6.2 4.8 L7.2 4.1", "M12 22 L12 8", "M12 14 L8.2 9.5", "M12 12 L15.8 8"];
    /// Leaves inside an outline.
    LeafOutline: ["M9 3.2 L11 2.5", "M14 2.6 L16.2 3.8", "M18.8 6 L20.3 8.5", "M20.8 11.5 L20 14.5", "M18.4 17 L16 19.3", "M13.4 20.8 L10.4 20.8", "M7.8 19.6 L5.6 17.4", "M3.9 14.6 L3.2 11.8", "M3.6 8.8 L4.8 6.2", "M8 15.5 C7.4 10.5 10.5 7.8 16 8 C16.4 13 13.5 16 8 15.5 Z", "M8 15.5 L12.5 11.3"];
    /// A round crown on a trunk.
    Crown: ["M12 2.5 C17.5 2.5 20 6 19.5 9.5 C19 13.5 16 15.5 12 15.5 C8 15.5 5 13.5 4.5 9.5 C4 6 6.5 2.5 12 2.5 Z", "M12 22 L12 10", "M12 13.5 L9 10", "M12 11.5 L14.5 8.5"];
    /// Play.
    Play: ["*M7.5 4.5 L19.5 12 L7.5 19.5 Z"];
    /// Pause.
    Pause: ["*M6.5 5 L10 5 L10 19 L6.5 19 Z", "*M14 5 L17.5 5 L17.5 19 L14 19 Z"];
    /// The eraser.
    Eraser: ["M4 15.5 L13.5 5 C14.2 4.2 15.3 4.2 16 5 L19.8 8.8 C20.5 9.5 20.5 10.6 19.8 11.3 L11.5 20 L8.5 20 Z", "M9 10 L15.5 16", "M7 20 L20 20"];
    /// The eraser that cuts.
    PartialEraser: ["M3 7 C6 3.5 8.5 3.5 10 5.5", "M17.5 14 C19.5 15.5 21 15 22 13", "M8 15.5 L13.5 9.5 C14.1 8.9 15 8.9 15.6 9.5 L17.8 11.7 C18.4 12.3 18.4 13.2 17.8 13.8 L12.5 19.5 L10.2 19.5 Z", "M11 12.3 L15 16.2", "M9 20.5 L19 20.5"];
    /// The lasso.
    Lasso: ["M8 16 C4.5 15 3 12.5 3 10.3 C3 6.5 7 3.8 12 3.8 C17 3.8 21 6.5 21 10.3 C21 14 17 16.8 12 16.8 C10.8 16.8 9.6 16.6 8.6 16.3", "M8.3 13.8 C9.8 13.8 10.6 15 10.2 16.3 C9.8 17.6 8.4 18.2 7.3 17.5 C6.2 16.8 6.3 14.5 8.3 13.8 Z", "M7.6 17.6 C8 19.2 7.4 20.4 5.8 21.3"];
    /// The hand.
    Hand: ["M8 12.5 L8 6.2 C8 4.4 10.4 4.4 10.4 6.2 L10.4 11 M10.4 10.5 L10.4 4.6 C10.4 2.8 12.9 2.8 12.9 4.6 L12.9 10.5 M12.9 5.8 C12.9 4 15.3 4 15.3 5.8 L15.3 11 M15.3 8.2 C15.3 6.5 17.7 6.5 17.7 8.2 L17.7 14.5 C17.7 18.5 15.5 21 12.2 21 C9.2 21 7.8 19.6 6.4 17.2 L3.8 12.9 C3 11.4 4.9 10.2 6 11.6 L8 14"];
    /// Undo.
    Undo: ["M9 5 L4.5 9.5 L9 14", "M5 9.5 L14 9.5 C17.5 9.5 19.5 11.8 19.5 14.5 C19.5 17.3 17.5 19.5 14 19.5 L10 19.5"];
    /// Redo.
    Redo: ["M15 5 L19.5 9.5 L15 14", "M19 9.5 L10 9.5 C6.5 9.5 4.5 11.8 4.5 14.5 C4.5 17.3 6.5 19.5 10 19.5 L14 19.5"];
    /// A die.
    Dice: ["M6.5 4 L17.5 4 C19 4 20 5 20 6.5 L20 17.5 C20 19 19 20 17.5 20 L6.5 20 C5 20 4 19 4 17.5 L4 6.5 C4 5 5 4 6.5 4 Z", "*M9.6 8.3 C9.6 9.9 7 9.9 7 8.3 C7 6.7 9.6 6.7 9.6 8.3 Z", "*M13.3 12 C13.3 13.6 10.7 13.6 10.7 12 C10.7 10.4 13.3 10.4 13.3 12 Z", "*M17 15.7 C17 17.3 14.4 17.3 14.4 15.7 C14.4 14.1 17 14.1 17 15.7 Z"];
    /// An empty sheet.
    New: ["M6 3 L14 3 L19 8 L19 21 L6 21 Z", "M14 3 L14 8 L19 8", "M12.5 11.5 L12.5 17.5", "M9.5 14.5 L15.5 14.5"];
    /// A folder.
    Open: ["M3 19 L3 6 C3 5.4 3.4 5 4 5 L9 5 L11 7.5 L19 7.5 C19.6 7.5 20 7.9 20 8.5 L20 10.5", "M3 19 L6 10.5 L22 10.5 L19 19 Z"];
    /// A folder that is made.
    NewFolder: ["M3 19 L3 6 C3 5.4 3.4 5 4 5 L9 5 L11 7.5 L20 7.5 C20.6 7.5 21 7.9 21 8.5 L21 19 Z", "M12 10 L12 16.5", "M8.8 13.2 L15.2 13.2"];
    /// Down into a box.
    Save: ["M12 3.5 L12 14.5", "M7.5 10.5 L12 15 L16.5 10.5", "M4 15 L4 20 L20 20 L20 15"];
    /// Up out of a box.
    Export: ["M12 15 L12 3.5", "M7.5 8 L12 3.5 L16.5 8", "M8 11 L5 11 L5 20.5 L19 20.5 L19 11 L16 11"];
    /// Corners.
    Fit: ["M4 9 L4 4 L9 4", "M15 4 L20 4 L20 9", "M20 15 L20 20 L15 20", "M9 20 L4 20 L4 15", "M9 9 L15 9 L15 15 L9 15 Z"];
    /// A picture.
    Picture: ["M4 5 L20 5 L20 19 L4 19 Z", "M4 16 L9.5 10.5 L14 15 L16 13 L20 17", "M15.5 10 C15.5 8.7 17.5 8.7 17.5 10 C17.5 11.3 15.5 11.3 15.5 10 Z"];
    /// A gear, simplified to sliders.
    Settings: ["M4 7 L12 7", "M17 7 L20 7", "M14.5 4.7 C17.5 4.7 17.5 9.3 14.5 9.3 C11.5 9.3 11.5 4.7 14.5 4.7 Z", "M4 17 L7 17", "M12 17 L20 17", "M9.5 14.7 C12.5 14.7 12.5 19.3 9.5 19.3 C6.5 19.3 6.5 14.7 9.5 14.7 Z"];
    /// A question mark.
    Help: ["M12 3 C24 3 24 21 12 21 C0 21 0 3 12 3 Z", "M9.3 9.5 C9.3 6.2 14.7 6.2 14.7 9.5 C14.7 11.8 12 11.8 12 14", "*M12.9 17 C12.9 18.2 11.1 18.2 11.1 17 C11.1 15.8 12.9 15.8 12.9 17 Z"];
    /// A cross.
    Close: ["M6 6 L18 18", "M18 6 L6 18"];
    /// A dustbin.
    Delete: ["M4 7 L20 7", "M9 7 L9.5 4 L14.5 4 L15 7", "M6 7 L7 20.5 L17 20.5 L18 7", "M10 11 L10.4 16.8", "M14 11 L13.6 16.8"];
    /// Two sheets.
    Duplicate: ["M9 8.5 L20 8.5 L20 20.5 L9 20.5 Z", "M15.5 8.5 L15.5 3.5 L4 3.5 L4 15.5 L9 15.5"];
    /// A sheet that is taken along.
    Copy: ["M8 8.5 L18.5 8.5 L18.5 20.5 L8 20.5 Z", "M5 16 L5 4 L15 4", "M11 12.5 L15.5 12.5", "M11 16 L15.5 16"];
    /// Scissors.
    Cut: ["M7 3.5 L15.2 15.6", "M17 3.5 L8.8 15.6", "M7.2 15.3 C10.4 15.3 10.4 20.5 7.2 20.5 C4 20.5 4 15.3 7.2 15.3 Z", "M16.8 15.3 C20 15.3 20 20.5 16.8 20.5 C13.6 20.5 13.6 15.3 16.8 15.3 Z"];
    /// A clipboard.
    Paste: ["M9 5 L6 5 L6 20.5 L18 20.5 L18 5 L15 5", "M9 3.5 L15 3.5 L15 7 L9 7 Z", "M9.5 12 L14.5 12", "M9.5 15.5 L14.5 15.5"];
    /// Left and right of a line.
    MirrorLeftRight: ["M12 3 L12 6", "M12 9 L12 12", "M12 15 L12 18", "M12 21 L12 21.5", "M9 6 L9 18 L3 18 Z", "*M15 6 L15 18 L21 18 Z"];
    /// Above and below a line.
    MirrorTopBottom: ["M3 12 L6 12", "M9 12 L12 12", "M15 12 L18 12", "M21 12 L21.5 12", "M6 9 L18 9 L18 3 Z", "*M6 15 L18 15 L18 21 Z"];
    /// A magnifying glass.
    Search: ["M10.5 4 C19 4 19 17 10.5 17 C2 17 2 4 10.5 4 Z", "M15.3 15.3 L20.5 20.5"];
    /// Back to what it was.
    Reset: ["M5.5 9 C7.5 4.5 14 3 17.5 7 C21 11 19.5 17.5 14.5 19.2 C11 20.3 7.3 18.8 5.5 15.8", "M5 4 L5.3 9.3 L10.4 8.6"];
    /// A chevron to the right.
    Right: ["M9 5 L16 12 L9 19"];
    /// A chevron to the left.
    Left: ["M15 5 L8 12 L15 19"];
    /// A chevron down.
    Down: ["M5 9 L12 16 L19 9"];
    /// An arrow up.
    Up: ["M12 20 L12 5", "M6 11 L12 5 L18 11"];
    /// A house.
    Home: ["M3.5 11.5 L12 4 L20.5 11.5", "M6 9.5 L6 20 L18 20 L18 9.5", "M10 20 L10 14.5 L14 14.5 L14 20"];
    /// A sheet with lines.
    File: ["M6 3 L14 3 L19 8 L19 21 L6 21 Z", "M14 3 L14 8 L19 8"];
    /// A tick.
    Check: ["M5 12.5 L10 17.5 L19.5 7"];
    /// A minus sign.
    Minus: ["M5.5 12 L18.5 12"];
    /// A plus sign.
    Plus: ["M5.5 12 L18.5 12", "M12 5.5 L12 18.5"];
    /// A right hand with a pen.
    RightHand: ["M4 20 L6 20", "M9 20 L20 20", "M14 16 L7 9 L8 4 L17 13 Z", "M15.5 14.5 L20 19"];
    /// A left hand with a pen.
    LeftHand: ["M20 20 L18 20", "M15 20 L4 20", "M10 16 L17 9 L16 4 L7 13 Z", "M8.5 14.5 L4 19"];
    /// The sun.
    Sun: ["M12 7.5 C18 7.5 18 16.5 12 16.5 C6 16.5 6 7.5 12 7.5 Z", "M12 2 L12 4.3", "M12 19.7 L12 22", "M2 12 L4.3 12", "M19.7 12 L22 12", "M5 5 L6.6 6.6", "M17.4 17.4 L19 19", "M5 19 L6.6 17.4", "M17.4 6.6 L19 5"];
    /// The moon.
    Moon: ["M19.5 14.5 C12 17.5 6.5 11 9.8 4.2 C3 6.5 2.8 16 8.8 19.3 C13 21.5 17.8 19 19.5 14.5 Z"];
    /// Waves that become calm.
    Stabiliser: ["M3 15 L5 9 L7 15 L9 9 L11 14", "M11 14 C13 17 15 8 21 9"];
    /// Three lines.
    Menu: ["M4 6.5 L20 6.5", "M4 12 L20 12", "M4 17.5 L20 17.5"];
    /// A globe.
    Language: ["M12 3 C24 3 24 21 12 21 C0 21 0 3 12 3 Z", "M12 3 C7 8 7 16 12 21", "M12 3 C17 8 17 16 12 21", "M3.2 12 L20.8 12"];
    /// The side panel.
    Side: ["M4 5 L20 5 L20 19 L4 19 Z", "M14 5 L14 19", "M16.5 9 L17.5 9", "M16.5 12 L17.5 12"];
    /// An exclamation mark in a triangle.
    Warning: ["M12 4 L21.5 20 L2.5 20 Z", "M12 10 L12 14.5", "*M12.9 17.2 C12.9 18.4 11.1 18.4 11.1 17.2 C11.1 16 12.9 16 12.9 17.2 Z"];
    /// A lock.
    Lock: ["M6 11 L18 11 L18 20.5 L6 20.5 Z", "M8.5 11 L8.5 8 C8.5 2.8 15.5 2.8 15.5 8 L15.5 11"];
    /// A plant: the program's emblem.
    Plant: ["M12 21.5 L12 11", "M12 17.5 C8.5 17.5 6.5 15.8 5.8 13 C9 12.8 11.4 14.4 12 17.5 Z", "M12 15.5 C15.5 15.5 17.5 13.8 18.2 11 C15 10.8 12.6 12.4 12 15.5 Z", "M12 10.5 C9 9.5 8.2 6.5 9 3 L12 5.5 L15 3 C15.8 6.5 15 9.5 12 10.5 Z"];
}

/// Draws an icon into the middle of a rectangle, as large as its smaller side.
pub fn paint(painter: &Painter, rect: Rect, icon: Icon, colour: Color32) {
    let side = rect.width().min(rect.height());
    let square = Rect::from_center_size(rect.center(), egui::Vec2::splat(side));
    let scale = side / GRID;
    for Line { points, closed, filled } in lines(icon) {
        let points: Vec<Pos2> = points.iter().map(|p| square.min + p.to_vec2() * scale).collect();
        let stroke = Stroke::new(LINE * scale, colour);
        if *filled {
            painter.add(PathShape::convex_polygon(points, colour, PathStroke::NONE));
        } else if *closed {
            painter.add(PathShape::closed_line(points, stroke));
        } else {
            for end in [points.first(), points.last()].into_iter().flatten() {
                painter.circle_filled(*end, LINE * scale * 0.5, colour);
            }
            painter.line(points, stroke);
        }
    }
}

/// A line of an icon, flattened, on the grid.
struct Line {
    points: Vec<Pos2>,
    closed: bool,
    filled: bool,
}

/// The lines of an icon, read from its paths only once: many icons are shown in every frame.
fn lines(icon: Icon) -> &'static [Line] {
    static LINES: OnceLock<Vec<Vec<Line>>> = OnceLock::new();
    let all = LINES.get_or_init(|| Icon::ALL.iter().map(|icon| read(icon.paths())).collect());
    all.get(icon as usize).map(Vec::as_slice).unwrap_or_default()
}

fn read(paths: &[&str]) -> Vec<Line> {
    let mut lines = Vec::new();
    for path in paths {
        let (filled, path) = path.strip_prefix('*').map_or((false, *path), |rest| (true, rest));
        let read = polylines(path).into_iter();
        lines.extend(read.map(|(points, closed)| Line { points, closed, filled }));
    }
    lines
}

/// The sub-paths of an SVG path as points on the grid, and whether each is closed.
fn polylines(path: &str) -> Vec<(Vec<Pos2>, bool)> {
    let Ok(path) = BezPath::from_svg(path) else { return Vec::new() };
    let mut out: Vec<(Vec<Pos2>, bool)> = Vec::new();
    kurbo::flatten(&path, TOLERANCE, |element| match element {
        PathEl::MoveTo(p) => out.push((vec![pos2(p.x as f32, p.y as f32)], false)),
        PathEl::LineTo(p) => {
            if let Some((points, _)) = out.last_mut() {
                points.push(pos2(p.x as f32, p.y as f32));
            }
        }
        PathEl::ClosePath => {
            if let Some((points, closed)) = out.last_mut() {
                if points.len() > 1 && points.first() == points.last() {
                    points.pop();
                }
                *closed = true;
            }
        }
        PathEl::QuadTo(..) | PathEl::CurveTo(..) => {}
    });
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_icon_is_a_readable_path_inside_its_grid() {
        for icon in Icon::ALL {
            for path in icon.paths() {
                let lines = polylines(path.trim_start_matches('*'));
                assert!(!lines.is_empty(), "{icon:?}: {path}");
                for (points, _) in lines {
                    assert!(points.len() >= 2, "{icon:?}: {path}");
                    let inside = |p: &Pos2| p.x >= 0.0 && p.y >= 0.0 && p.x <= GRID && p.y <= GRID;
                    assert!(points.iter().all(inside), "{icon:?}: {path}");
                }
            }
        }
    }

    #[test]
    fn every_icon_is_drawn_with_its_own_lines() {
        for (place, icon) in Icon::ALL.iter().enumerate() {
            assert_eq!(*icon as usize, place, "{icon:?}");
            let own: Vec<Pos2> = read(icon.paths()).into_iter().flat_map(|line| line.points).collect();
            let drawn: Vec<Pos2> = lines(*icon).iter().flat_map(|line| line.points.clone()).collect();
            assert_eq!(own, drawn, "{icon:?}");
        }
    }

    #[test]
    fn no_two_icons_are_the_same() {
        for (i, a) in Icon::ALL.iter().enumerate() {
            for b in &Icon::ALL[i + 1..] {
                assert_ne!(a.paths(), b.paths(), "{a:?} and {b:?}");
            }
        }
    }
}
