//! Everything the artist can ask for, whichever button, key, gesture or menu says it.
//!
//! Panels and keys produce [`Action`]s and change nothing themselves; the application carries them out in one place.
//! So a panel is tested without a window, and a key and a button cannot drift apart.

use super::brush_settings::BrushSettings;
use super::canvas_tool::{CanvasTool, Mirror};
use super::dialog::{Dialog, PathPurpose};
use super::export_choice::ExportChoice;
use super::garden_brush::GardenBrush;
use super::messages::Language;
use super::pen_settings::PenSettings;
use super::plant_search::PlantMark;
use super::pose_drag::PoseDrag;
use super::settings::{Handedness, ThemeChoice};
use super::stabiliser::Stabiliser;
use super::texture_cut::{CutError, TextureCut};
use super::view_state::{LightChoice, Shading, Stride};
use super::ways_to_read::WayToRead;
use super::work_surface::WorkSurface;
use crate::growth::overlay::Wanted;
use crate::modelling::OnContact;
use crate::pen::PenSource;
use crate::picture::{Picture, PictureError};
use crate::pipeline::LevelSet;
use crate::plant::OrganKind;
use crate::sketch::{Correction, PlacedPlant, StrokeId, TextureChoice, Tool};
use glam::Vec3;
use serde_json::Value;
use std::path::PathBuf;

/// One action.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Start an empty drawing.
    New,
    /// Ask for a drawing and open it.
    Open,
    /// Open this drawing.
    OpenPath(PathBuf),
    /// Save under its name, asking for one where it has none.
    Save,
    /// Ask for a name and save.
    SaveAs,
    /// Show the export dialog.
    ShowExport,
    /// Take back the last change.
    Undo,
    /// Do again what was taken back.
    Redo,
    /// Take up a tool.
    SetTool(CanvasTool),
    /// Change what selected strokes are.
    SetPart(Tool),
    /// Change what one stroke is.
    SetStrokePart {
        /// The stroke.
        stroke: StrokeId,
        /// What it is.
        tool: Tool,
    },
    /// The strokes that this one was read with are not what they were read as.
    RefuseReading(StrokeId),
    /// Say how strokes are read.
    Correct(Correction),
    /// Show in which ways the strokes can be read that a stroke was read with.
    ShowWays {
        /// The stroke.
        stroke: StrokeId,
        /// Where, logical pixels of the window.
        at: [f32; 2],
    },
    /// The ways to read some strokes have been found.
    WaysFound {
        /// The strokes.
        about: Vec<StrokeId>,
        /// The ways.
        ways: Vec<WayToRead>,
    },
    /// Close the menu that asks what a stroke is.
    ClosePartMenu,
    /// Remove the selected strokes.
    DeleteSelected,
    /// Copy the selected strokes beside themselves.
    DuplicateSelected,
    /// Mirror the selected strokes about the middle of the selection.
    MirrorSelected(Mirror),
    /// Move the selected strokes by a small step on the screen.
    NudgeSelected {
        /// Steps to the right; negative to the left.
        right: i8,
        /// Steps down; negative up.
        down: i8,
        /// Whether the steps are larger ones.
        far: bool,
    },
    /// Put a grown plant of this species beside the drawn one.
    AddPlant(String),
    /// Select a plant beside the drawn one by its place in the list, or none of them.
    SelectPlant(Option<usize>),
    /// Change a plant beside the drawn one.
    SetPlant {
        /// Its place in the list.
        place: usize,
        /// What it becomes.
        plant: PlacedPlant,
    },
    /// Choose the seed of a plant beside the drawn one by chance.
    RollPlantSeed(usize),
    /// Take a plant beside the drawn one away.
    RemovePlant(usize),
    /// Take up the tool that shapes petals, or lay it down.
    ShapePetals(bool),
    /// Whether left and right of a petal are moved alike.
    MirrorPetals(bool),
    /// Move the control point that was touched last so far: across, along and toward the face, shares of the petal's length.
    SetPetalPoint(Vec3),
    /// Give the petals of the chosen flower back the form that they were drawn with.
    ResetPetals,
    /// Take up the tool that draws branches in the view of the plant, or lay it down.
    DrawInSpace(bool),
    /// Choose the surface that it draws on.
    SetWorkSurface(WorkSurface),
    /// Take up a brush in the view of the plant, or lay brushes down.
    TakeBrush(Option<Tool>),
    /// Set the brushes.
    SetBrush(BrushSettings),
    /// Take up the tool that paints a garden on the ground, or lay it down.
    PaintGarden(bool),
    /// Set its brush.
    SetGardenBrush(GardenBrush),
    /// Take up the tool that turns, bends and moves parts of the plant, or lay it down.
    PoseParts(bool),
    /// What a drag with it does.
    PoseBy(PoseDrag),
    /// What becomes of wood that meets other wood as it is turned.
    MeetWood(OnContact),
    /// Let the part that was held last stand as it was drawn or grew.
    ResetPose,
    /// Make it so many times as thick, an organ as large, as it was drawn or grew.
    SizePart(f32),
    /// Draws out the line of the branch that is chosen to be posed, 0 as it grew, 1 straight.
    StraightenPart(f32),
    /// Show it so many years younger than it is.
    MakePartYounger(u16),
    /// Take it away.
    TakeAwayPart,
    /// Put the selected strokes on the clipboard.
    CopySelected,
    /// The same, and remove them.
    CutSelected,
    /// Put what the clipboard holds into the drawing: strokes, or a reference picture.
    Paste,
    /// Select every stroke.
    SelectAll,
    /// Select a stroke.
    SelectStroke {
        /// The stroke.
        stroke: StrokeId,
        /// Whether those selected stay so.
        besides: bool,
    },
    /// Show the whole drawing.
    FitCanvas,
    /// Show the paper larger by so many steps, about its middle; smaller if negative.
    Zoom(i32),
    /// Look at the plant from the front, as it was drawn, all of it.
    FrontView,
    /// Choose a species by name or file.
    SetSpecies(String),
    /// Let the drawing decide its species.
    GuessSpecies,
    /// Ask for a file and use it for this.
    ChooseFile(PathPurpose),
    /// The path dialog's answer.
    PathChosen {
        /// What the dialog was for.
        purpose: PathPurpose,
        /// The chosen file.
        path: PathBuf,
    },
    /// Choose the seed.
    SetSeed(u64),
    /// Choose a seed by chance.
    RollSeed,
    /// Set one parameter by its path; `None` returns to the default.
    SetParam {
        /// Dotted path.
        path: String,
        /// The new value.
        value: Option<Value>,
    },
    /// Set every parameter of the drawing at once, as a preset does.
    SetParams(serde_json::Map<String, Value>),
    /// Let the plant grow from its beginning to the age that is shown, or go on with that, or pause.
    PlayGrowth(bool),
    /// The same for flowers that open from their buds.
    PlayOpening(bool),
    /// Choose the texture of a kind of part: `None` returns to the species' own.
    SetTexture {
        /// Which organs; `None` means branches.
        organ: Option<OrganKind>,
        /// The choice.
        texture: Option<TextureChoice>,
    },
    /// A picture that was chosen has been read.
    PictureRead {
        /// What it was chosen for.
        purpose: PathPurpose,
        /// What it is called in messages: its file, or that it was pasted.
        name: String,
        /// The picture, if it can be used.
        picture: Result<Picture, PictureError>,
    },
    /// Give the part that this stroke draws the picture under it as its texture.
    TakePictureUnder(StrokeId),
    /// A texture has been cut out of a photograph.
    TextureCut {
        /// For which organs; `None` means branches.
        organ: Option<OrganKind>,
        /// The file of the photograph; empty for the picture under the drawing.
        name: String,
        /// The texture, if there is one.
        cut: Result<TextureCut, CutError>,
    },
    /// Keep species, textures and parameters as a preset of this name.
    SavePreset(String),
    /// Use a preset.
    ApplyPreset(PathBuf),
    /// Remove a preset.
    DeletePreset(PathBuf),
    /// Ask for a reference picture and put it under the drawing.
    OpenReference,
    /// How visible the reference picture is, 0 to 1.
    SetReferenceOpacity(f32),
    /// Whether the reference picture stays where it is.
    LockReference(bool),
    /// Take the reference picture away.
    RemoveReference,
    /// Find the plant on the reference picture: the pen marks it in place of drawing, until this ends.
    FindPlant(bool),
    /// What lines of the pen say of the reference picture.
    MarkPlant(PlantMark),
    /// Forget all marks on the reference picture.
    ClearPlantMarks,
    /// Draw the plant that was found, as crowns and trunk.
    UseAsCrown,
    /// Move a branch onto the edges of the trunk under it.
    SnapToTrunk(StrokeId),
    /// Give leaves and bark the colours of the plant that was found.
    ColoursFromPicture,
    /// How the plant is lit.
    SetLight(LightChoice),
    /// How the plant is shown.
    SetShading(Shading),
    /// Without perspective.
    SetOrthographic(bool),
    /// Turn the plant slowly.
    SetTurntable(bool),
    /// Shows the plant on a lawn under the sky, or on paper.
    SetOutdoors(bool),
    /// Walks through the scene, or ends that.
    Walk(bool),
    /// Takes a step while walking.
    Stride(Stride),
    /// What is seen of growth over the plant.
    SetOverlay(Wanted),
    /// Shows the plant in levels of detail, as engines do, or as it is.
    ShowLevels(Option<LevelSet>),
    /// Shows one level at any distance, or each at its own.
    HoldLevel(Option<usize>),
    /// Goes so many metres away from the plant.
    SetDistance(f32),
    /// Copy the picture of the plant to the clipboard.
    CopyPicture,
    /// Remember what the export dialog says.
    SetExport(ExportChoice),
    /// Ask for a name and export.
    Export(ExportChoice),
    /// Stop what the progress bar shows.
    CancelTask,
    /// Show a dialog.
    ShowDialog(Dialog),
    /// Close the dialog without doing anything.
    CloseDialog,
    /// Save, then go on with what the question about unsaved changes held up.
    SaveAndContinue,
    /// Go on without saving.
    DiscardAndContinue,
    /// Open a drawing that was found again.
    Recover(PathBuf),
    /// Delete a drawing that was found again.
    DiscardRecovery(PathBuf),
    /// Take a notice away.
    DismissNotice(u64),
    /// Keep a notice while it is looked at.
    HoldNotice(u64),
    /// Choose the language of the interface.
    SetLanguage(Language),
    /// Choose dark or light.
    SetTheme(ThemeChoice),
    /// Choose the side of tools and panels.
    SetHandedness(Handedness),
    /// How much strokes are smoothed while they are drawn.
    SetStabiliser(Stabiliser),
    /// Choose how pens are read.
    SetPenSource(PenSource),
    /// Choose how the pen last used presses, what its buttons do and what its tablet covers.
    SetPen(PenSettings),
    /// Choose which model a tablet in doubt is.
    SetTabletModel {
        /// What the tablet is known by.
        device: String,
        /// The model's name.
        model: String,
    },
    /// Show or hide the side panel.
    ShowSide(bool),
    /// The side panel was made this wide, logical pixels.
    SetSideWidth(f32),
    /// Close the window, asking about unsaved changes.
    Quit,
}
