//! Small pictures of species and textures, decoded when they are first seen and kept by egui.
//!
//! Only one picture is decoded per frame, so that opening a panel never makes the window wait.

use crate::picture::Picture;
use crate::picture::decode::{Rgba, decode};
use crate::species::builtin_texture;
use egui::{ColorImage, Context, Id, TextureHandle, TextureOptions};
use include_dir::{Dir, include_dir};

static SPECIES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/species-thumbnails");
/// Longest side of a thumbnail in physical pixels.
const SIDE: u32 = 160;

/// The picture of a built-in species, `None` where there is none or it is not decoded yet.
pub(super) fn of_species(ctx: &Context, name: &str) -> Option<TextureHandle> {
    cached(ctx, Id::unique(("species thumbnail", name)), || {
        SPECIES.get_file(format!("{name}.png")).map(|file| file.contents())
    })
}

/// The picture of a built-in texture, `None` where there is none or it is not decoded yet.
pub(super) fn of_texture(ctx: &Context, name: &str) -> Option<TextureHandle> {
    cached(ctx, Id::unique(("texture thumbnail", name)), || builtin_texture(name))
}

/// A picture of the artist's own, `None` where it cannot be decoded or is not yet.
pub(super) fn of_picture(ctx: &Context, picture: &Picture) -> Option<TextureHandle> {
    cached(ctx, Id::unique(("own picture", picture.hash())), || Some(picture.bytes()))
}

fn cached<'a>(ctx: &Context, id: Id, bytes: impl FnOnce() -> Option<&'a [u8]>) -> Option<TextureHandle> {
    if let Some(known) = ctx.data(|data| data.get_temp::<Option<TextureHandle>>(id)) {
        return known;
    }
    let now = ctx.cumulative_pass_nr();
    let last = Id::unique("thumbnail decoded in pass");
    if ctx.data(|data| data.get_temp::<u64>(last)) == Some(now) {
        ctx.request_repaint();
        return None;
    }
    ctx.data_mut(|data| data.insert_temp(last, now));
    let picture = bytes().and_then(|bytes| decode(bytes).ok());
    let handle =
        picture.map(|picture| ctx.load_texture(format!("{id:?}"), smaller(&picture), TextureOptions::LINEAR));
    ctx.data_mut(|data| data.insert_temp(id, handle.clone()));
    handle
}

/// Means over square blocks of pixels until the picture is small enough.
fn smaller(picture: &Rgba) -> ColorImage {
    let block = picture.width.max(picture.height).div_ceil(SIDE).max(1) as usize;
    let (width, height) = (picture.width as usize, picture.height as usize);
    let (w, h) = ((width / block).max(1), (height / block).max(1));
    let mut pixels = Vec::with_capacity(w * h * 4);
    for y in 0..h {
        for x in 0..w {
            let mut sum = [0_u32; 4];
            let mut count = 0;
            for row in (y * block)..((y + 1) * block).min(height) {
                let from = (row * width + x * block) * 4;
                let to = (row * width + ((x + 1) * block).min(width)) * 4;
                for pixel in picture.pixels.get(from..to).unwrap_or_default().as_chunks::<4>().0 {
                    count += 1;
                    (0..4).for_each(|c| sum[c] += u32::from(pixel[c]));
                }
            }
            pixels.extend(sum.map(|s| (s / count.max(1)) as u8));
        }
    }
    ColorImage::from_rgba_unmultiplied([w, h], &pixels)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::species::Species;

    #[test]
    fn every_species_has_a_picture() {
        for name in Species::names() {
            let file = SPECIES.get_file(format!("{name}.png"));
            let picture = decode(file.unwrap_or_else(|| panic!("no picture of {name}")).contents()).unwrap();
            assert_eq!((picture.width, picture.height), (160, 160), "{name}");
        }
    }

    #[test]
    fn large_pictures_become_small() {
        let picture = Rgba { width: 400, height: 200, pixels: [10, 20, 30, 255].repeat(400 * 200) };
        let image = smaller(&picture);
        assert_eq!(image.size, [133, 66]);
        assert_eq!(image.pixels[700].to_array(), [10, 20, 30, 255]);
    }
}
