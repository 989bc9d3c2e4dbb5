//! A drawing that shows what came of a photograph: petals around a flower, leaves on a stem, or a trunk.
//!
//! The strokes are the outline itself. Where a drawn petal or leaf begins and ends is found anew by whoever reads the drawing, and
//! the blade's UV with it; so the texture in the drawing is painted for the blade that the drawing is read as.

use super::PhotoParams;
use super::bark::BarkPhoto;
use super::blade_photo::{BladePhoto, Traced};
use super::error::PhotoError;
use crate::anatomy::{AnatomyParams, FlatBlade, analyse};
use crate::picture::Picture;
use crate::picture::decode::Rgba;
use crate::sketch::{Canvas, Sketch, Stroke, StrokeId, StrokePoint, TextureChoice, Tool};
use glam::Vec2;
use std::f32::consts::TAU;
use std::sync::Arc;

/// The sheet: its side and the foot of the stem, canvas pixels.
const SIDE: f32 = 1024.0;
const FOOT: Vec2 = Vec2::new(512.0, 980.0);
/// The stroke of the first petal or leaf.
const FIRST: StrokeId = 2;
/// Where petals come together; how long they are, and how far from there they begin.
const FLOWER: Vec2 = Vec2::new(512.0, 400.0);
const PETAL: f32 = 300.0;
const RING: f32 = 24.0;
/// Where the stem of leaves ends, and how long a single leaf is and one of many.
const SHOOT: Vec2 = Vec2::new(512.0, 560.0);
const LEAF: (f32, f32) = (480.0, 260.0);
/// Angle between the stem and leaves along it.
const ASIDE_DEG: f32 = 55.0;

/// What the artist photographed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BladeKind {
    /// A petal.
    Petal,
    /// A leaf.
    Leaf,
}

impl BladeKind {
    /// The tool that draws one.
    pub fn tool(self) -> Tool {
        match self {
            Self::Petal => Tool::Petal,
            Self::Leaf => Tool::Leaf,
        }
    }
}

/// A texture as the file of a picture.
///
/// # Errors
/// The encoder's.
pub fn picture_of(texture: &Rgba) -> Result<Picture, PhotoError> {
    let bytes = texture.to_png().map_err(|error| PhotoError::Encoding(error.to_string()))?;
    Picture::new(bytes).map_err(|error| PhotoError::Encoding(error.to_string()))
}

impl BladePhoto {
    /// A drawing of a flower with so many of these petals, or of a stem with so many of these leaves; at least one. The photograph
    /// is that of which this was made, with the same parameters.
    ///
    /// # Errors
    /// A texture that cannot be encoded.
    pub fn drawing(
        &self,
        (photograph, params): (&Rgba, &PhotoParams),
        kind: BladeKind,
        copies: u32,
    ) -> Result<Sketch, PhotoError> {
        let copies = copies.max(1);
        let mut lines = match kind {
            BladeKind::Petal => vec![(Tool::Branch, vec![FOOT, FLOWER])],
            BladeKind::Leaf => vec![(Tool::Branch, vec![FOOT, SHOOT])],
        };
        lines.extend((0..copies).map(|k| {
            let (base, along) = place(kind, k, copies);
            (kind.tool(), self.line(base, along))
        }));
        let sketch = sheet(lines, kind.tool().name(), &self.texture)?;
        let anatomy = analyse(&sketch, &AnatomyParams::default());
        let blades = if kind == BladeKind::Petal { &anatomy.petals } else { &anatomy.leaves };
        let Some(read) = blades.iter().find(|blade| blade.stroke == Some(FIRST)) else { return Ok(sketch) };
        let texture = self.repainted(photograph, params, read, place(kind, 0, copies))?;
        let textures = [(kind.tool().name().to_owned(), TextureChoice::Own(picture_of(&texture)?))].into();
        Ok(Sketch { textures, ..sketch })
    }

    /// The texture for the blade that a stroke is read as, whose base and way to the tip on the canvas are these.
    fn repainted(
        &self,
        photograph: &Rgba,
        params: &PhotoParams,
        read: &FlatBlade,
        (base, along): (Vec2, Vec2),
    ) -> Result<Rgba, PhotoError> {
        let up = self.tip - self.base;
        let on_photograph = |canvas: Vec2| {
            let off = (canvas - base) / along.length_squared();
            self.base + up.perp() * off.dot(along.perp()) + up * off.dot(along)
        };
        let outline: Vec<Vec2> = read.outline.iter().map(|sample| on_photograph(sample.position)).collect();
        let [base, tip] = [read.root, read.tip].map(on_photograph);
        let mut params = params.clone();
        params.texture.traced_inset = params.texture.inset;
        let traced = Traced { outline: &outline, base, tip, from_behind: false };
        Ok(Self::under_outline(photograph, &traced, &params)?.texture)
    }

    /// The outline on a canvas, from its base on and back to it.
    fn line(&self, base: Vec2, along: Vec2) -> Vec<Vec2> {
        let outline = self.template.outline();
        let away = |i: &usize| outline[*i].length_squared();
        let first = (0..outline.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0);
        let on_canvas = |p: &Vec2| base + along.perp() * p.x + along * p.y;
        outline[first..].iter().chain(&outline[..=first]).map(on_canvas).collect()
    }
}

/// Base of a blade among so many, and the way to its tip.
fn place(kind: BladeKind, k: u32, copies: u32) -> (Vec2, Vec2) {
    let share = k as f32 / copies as f32;
    match kind {
        BladeKind::Petal => {
            let out = Vec2::from_angle(TAU * share).rotate(Vec2::NEG_Y);
            (FLOWER + RING * out, PETAL * out)
        }
        // The last leaf ends the stem, the others stand beside it by turns.
        BladeKind::Leaf if k + 1 == copies => {
            (SHOOT, if copies == 1 { LEAF.0 } else { LEAF.1 } * Vec2::NEG_Y)
        }
        BladeKind::Leaf => {
            let side = if k.is_multiple_of(2) { ASIDE_DEG } else { -ASIDE_DEG };
            let out = Vec2::from_angle(side.to_radians()).rotate(Vec2::NEG_Y);
            (FOOT.lerp(SHOOT, 0.3 + 0.7 * share), LEAF.1 * out)
        }
    }
}

impl BarkPhoto {
    /// A drawing of a trunk with this bark.
    ///
    /// # Errors
    /// A texture that cannot be encoded.
    pub fn drawing(&self) -> Result<Sketch, PhotoError> {
        let top = Vec2::new(FOOT.x, 60.0);
        let mut sketch = sheet(vec![(Tool::Branch, vec![FOOT, top])], "branch", &self.texture)?;
        for stroke in &mut sketch.strokes {
            Arc::make_mut(stroke).points.iter_mut().for_each(|point| point.pressure = 1.0);
        }
        Ok(sketch)
    }
}

/// A drawing of these lines, in which a kind of part has this texture.
fn sheet(lines: Vec<(Tool, Vec<Vec2>)>, part: &str, texture: &Rgba) -> Result<Sketch, PhotoError> {
    let stroke = |(i, (tool, line)): (usize, (Tool, Vec<Vec2>))| {
        let points = line.into_iter().map(StrokePoint::at).collect();
        Arc::new(Stroke { id: i as u64 + 1, tool, points, brush: None })
    };
    Ok(Sketch {
        canvas: Canvas { width: SIDE, height: SIDE },
        textures: [(part.to_owned(), TextureChoice::Own(picture_of(texture)?))].into(),
        strokes: lines.into_iter().enumerate().map(stroke).collect(),
        ..Sketch::empty()
    })
}
