//! Textures from photographs: of a file that the artist chooses, and of the picture under a traced stroke.
//!
//! Cutting out takes up to a second, so it is done on a thread of its own and comes back as [`Action::TextureCut`].

use super::Editor;
use crate::anatomy::FlatBlade;
use crate::app::action::Action;
use crate::app::messages::Localize as _;
use crate::app::panels::snapshot::{MenuOf, Notice, PathPurpose};
use crate::app::texture_cut::{CutError, TextureCut};
use crate::geom::simple_loop;
use crate::photo::{BarkPhoto, BladePhoto, PhotoParams, Traced, picture_of};
use crate::picture::Picture;
use crate::picture::decode::Rgba;
use crate::pipeline::Built;
use crate::plant::{OrganKind, Shape};
use crate::sketch::{Reference, StrokeId, TextureChoice};
use glam::Vec2;
use std::path::PathBuf;
use std::sync::Arc;

impl Editor {
    /// The stroke whose part can have the picture under it as its texture: that of the menu, or else the only one selected.
    pub(super) fn over_picture(&self) -> Option<StrokeId> {
        let asked = self.dialogs.part_menu().map(|menu| menu.of);
        let stroke = match asked {
            Some(MenuOf::Stroke(stroke)) => stroke,
            Some(_) => return None,
            None => {
                let selected = self.canvas.selection().ids();
                let mut selected = selected.iter();
                *selected.next().filter(|_| selected.next().is_none())?
            }
        };
        self.sketch().reference.as_ref().filter(|reference| reference.visible)?;
        blade_of(self.built()?, stroke).map(|_| stroke)
    }

    /// Gives the part that a stroke draws the picture under it as its texture.
    pub(super) fn take_picture_under(&mut self, stroke: StrokeId) {
        self.dialogs.close_part_menu();
        let Some(reference) = self.sketch().reference.clone() else { return };
        let Some((organ, flat)) = self.built().and_then(|built| blade_of(built, stroke)) else { return };
        let from_behind = self.built().is_some_and(|built| is_from_behind(built, stroke));
        let outline: Vec<Vec2> =
            flat.outline.iter().map(|sample| on_picture(&reference, sample.position)).collect();
        let [base, tip] = [flat.root, flat.tip].map(|place| on_picture(&reference, place));
        let params = params_of(Some(organ));
        let cut = move || {
            let pixels = reference.picture.pixels()?;
            let traced = Traced { outline: &outline, base, tip, from_behind };
            finished(BladePhoto::under_outline(&pixels, &traced, &params)?)
        };
        self.cut_texture(Some(organ), String::new(), cut);
    }

    /// Cuts a texture out of the file of a photograph.
    pub(super) fn read_photograph(&mut self, organ: Option<OrganKind>, path: PathBuf) {
        let params = params_of(organ);
        let name = path.display().to_string();
        let cut = move || {
            let (_, pixels) = Picture::read_with_pixels(&path)?;
            of_photograph(organ, &pixels, &params)
        };
        self.cut_texture(organ, name, cut);
    }

    fn cut_texture(
        &mut self,
        organ: Option<OrganKind>,
        name: String,
        cut: impl FnOnce() -> Result<TextureCut, CutError> + Send + 'static,
    ) {
        let (answers, wake) = (self.background.sender().clone(), Arc::clone(self.background.wake()));
        let work = move || {
            // A window that closed does not listen any more.
            let _ = answers.send(Action::TextureCut { organ, name, cut: cut() });
            wake();
        };
        if let Err(error) = std::thread::Builder::new().name("photograph".into()).spawn(work) {
            self.notify_error(&error);
        }
    }

    /// Uses a texture that has been cut out; what it is called is empty for the picture under the drawing.
    pub(super) fn use_cut(
        &mut self,
        organ: Option<OrganKind>,
        name: &str,
        cut: Result<TextureCut, CutError>,
    ) {
        let of = |what: String| if name.is_empty() { what } else { format!("{name}: {what}") };
        match cut {
            Ok(TextureCut { picture, remarks }) => {
                let texture = Some(TextureChoice::Own(picture));
                self.perform(Action::SetTexture { organ, texture });
                for remark in remarks {
                    self.notify(Notice::warning(of(remark.localize(self.prefs.messages())), ""));
                }
            }
            Err(error) => {
                let what = of(error.localize(self.prefs.messages()));
                let find = (!name.is_empty()).then_some(PathPurpose::Photograph(organ));
                self.notify(Notice { find, ..Notice::error(what, "") });
            }
        }
    }
}

/// How photographs of a kind of part are used; `None` is bark.
fn params_of(organ: Option<OrganKind>) -> PhotoParams {
    if organ == Some(OrganKind::Leaf) { PhotoParams::for_leaves() } else { PhotoParams::default() }
}

fn of_photograph(
    organ: Option<OrganKind>,
    pixels: &Rgba,
    params: &PhotoParams,
) -> Result<TextureCut, CutError> {
    if organ.is_none() {
        let bark = BarkPhoto::of_photograph(pixels, params)?;
        return Ok(TextureCut { picture: picture_of(&bark.texture)?, remarks: Vec::new() });
    }
    finished(BladePhoto::of_photograph(pixels, None, params)?)
}

fn finished(photo: BladePhoto) -> Result<TextureCut, CutError> {
    Ok(TextureCut { picture: picture_of(&photo.texture)?, remarks: photo.remarks })
}

/// The petal or leaf that a stroke draws, the largest of several.
fn blade_of(built: &Built, stroke: StrokeId) -> Option<(OrganKind, &FlatBlade)> {
    let area = |flat: &FlatBlade| simple_loop::signed_area(flat.outline.iter().map(|s| s.position)).abs();
    let largest = |blades: &'_ [FlatBlade]| -> Option<usize> {
        let own =
            (0..blades.len()).filter(|i| blades[*i].stroke == Some(stroke) && blades[*i].copy_of.is_none());
        own.max_by(|a, b| area(&blades[*a]).total_cmp(&area(&blades[*b])))
    };
    let anatomy = &built.anatomy;
    let petal = largest(&anatomy.petals).map(|i| (OrganKind::Petal, &anatomy.petals[i]));
    petal.or_else(|| largest(&anatomy.leaves).map(|i| (OrganKind::Leaf, &anatomy.leaves[i])))
}

/// Whether the drawing shows the back of the petal that a stroke draws.
fn is_from_behind(built: &Built, stroke: StrokeId) -> bool {
    let own = |organ: &&crate::plant::Organ| {
        organ.kind() == OrganKind::Petal && built.provenance.stroke(organ.origin) == Some(stroke)
    };
    built.plant.organs.iter().find(own).is_some_and(|organ| match &organ.shape {
        Shape::Blade(blade) => blade.u.truncate().dot(-blade.v.truncate().perp()) < 0.0,
        _ => false,
    })
}

/// Where a place of the canvas lies on the picture under it, in the picture's pixels.
pub(super) fn on_picture(reference: &Reference, canvas: Vec2) -> Vec2 {
    let size = reference.picture.size_px().as_vec2();
    let upright = Vec2::from_angle(-reference.rotation_deg.to_radians()).rotate(canvas - reference.center);
    0.5 * size + upright * (size.x / reference.width)
}

/// Where a place of the picture under the drawing, in its pixels, lies on the canvas.
pub(super) fn on_canvas(reference: &Reference, picture: Vec2) -> Vec2 {
    let size = reference.picture.size_px().as_vec2();
    let off = (picture - 0.5 * size) * (reference.width / size.x);
    reference.center + Vec2::from_angle(reference.rotation_deg.to_radians()).rotate(off)
}

#[cfg(test)]
#[path = "photographs_tests.rs"]
mod tests;
