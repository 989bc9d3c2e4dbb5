//! Alpha that keeps, in smaller copies of a picture, how much of it is covered.
//!
//! Programs that draw a cut-out surface show what has an alpha of a half and more, and take it from smaller copies of the picture the
//! farther the surface is away. In these each pixel is the mean of many, so that of thin leaves and needles less and less is shown.
//! Castaño (2010, "Computing Alpha Mipmaps") multiplies the alpha of each copy until as many of its pixels are shown as of the
//! picture. A file has only the picture itself. So a share of the mean of each block of it is added to the alpha of all its pixels: in the
//! copy where a block is one pixel its alpha is multiplied just so. Clear pixels stay below a half, so that the picture itself
//! shows what it showed, and have the mean colour of what their block shows.
//!
//! Small cards are seen aslant, where still smaller copies are taken, and hide one another. So as many blocks are shown as have
//! twice the area that is covered: with less, an oak, an ash and a spruce in pictures of 200 pixels lost more, with more they grew
//! beyond their leaves. The picture of a whole plant is not hidden; the larger a share of it a card shows, the less.
//!
//! Limits: one factor for all copies, found for that of blocks; in those before it a little too much is shown of what is very thin,
//! in those beyond it too little.

use glam::{USizeVec2, Vec4};

/// Width and height of blocks, pixels: six halvings, as a card of 256 pixels that is seen on four.
const BLOCK: usize = 64;
/// Area of the blocks that are to be shown, share of what is covered: of a picture of a small shoot, and of one of the whole plant.
const WANTED: (f32, f32) = (2.0, 1.0);
/// Most that is added, share of a block's mean.
const MOST: f32 = 4.0;
/// Alpha of clear pixels at most.
const BELOW_HALF: f32 = 0.45;
/// Halvings of the interval that is searched.
const HALVINGS: u32 = 8;

/// Adds to the alpha of a picture that shows such a share of a plant: rows from the top, straight alpha. Blocks begin in its left
/// lower corner.
pub(super) fn keep(pixels: &mut [Vec4], size: USizeVec2, share: f32) {
    let blocks = Blocks::of(pixels, size);
    let wanted = (WANTED.0 + share * (WANTED.1 - WANTED.0)) * pixels.iter().map(|pixel| pixel.w).sum::<f32>();
    let (mut low, mut high) = (0.0, MOST);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *(if blocks.shown(1.0 + middle) < wanted { &mut low } else { &mut high }) = middle;
    }
    for (i, pixel) in pixels.iter_mut().enumerate() {
        let of_block = blocks.sums[blocks.place(i)];
        if of_block.w <= 0.0 {
            continue;
        }
        let most = if pixel.w < 0.5 { pixel.w.max(BELOW_HALF) } else { 1.0 };
        let colour = if pixel.w > 0.0 { pixel.truncate() } else { of_block.truncate() / of_block.w };
        *pixel = colour.extend((pixel.w + low * of_block.w / AREA).min(most));
    }
}

/// Pixels of a block.
const AREA: f32 = (BLOCK * BLOCK) as f32;

struct Blocks {
    size: USizeVec2,
    columns: usize,
    /// Alpha, and colours times alpha.
    sums: Vec<Vec4>,
}

impl Blocks {
    fn of(pixels: &[Vec4], size: USizeVec2) -> Self {
        let columns = size.x.div_ceil(BLOCK);
        let mut blocks = Self { size, columns, sums: vec![Vec4::ZERO; columns * size.y.div_ceil(BLOCK)] };
        for (i, pixel) in pixels.iter().enumerate() {
            let place = blocks.place(i);
            blocks.sums[place] += (pixel.truncate() * pixel.w).extend(pixel.w);
        }
        blocks
    }

    fn place(&self, pixel: usize) -> usize {
        let (right, up) = (pixel % self.size.x, self.size.y - 1 - pixel / self.size.x);
        up / BLOCK * self.columns + right / BLOCK
    }

    /// How many pixels are in blocks that are shown, if their alpha is multiplied by this.
    fn shown(&self, factor: f32) -> f32 {
        AREA * self.sums.iter().filter(|sum| factor * sum.w >= 0.5 * AREA).count() as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Shares of a picture that are shown in it and in copies that are half as large each.
    fn shown(pixels: &[Vec4], size: USizeVec2) -> Vec<f32> {
        let (mut pixels, mut size, mut shown) = (pixels.to_vec(), size, Vec::new());
        for _ in 0..7 {
            shown.push(pixels.iter().filter(|pixel| pixel.w >= 0.5).count() as f32 / pixels.len() as f32);
            let half = size / 2;
            let mean = |i: usize| {
                let at = (i / half.x * 2) * size.x + i % half.x * 2;
                [0, 1, size.x, size.x + 1].map(|by| pixels[at + by]).into_iter().sum::<Vec4>() / 4.0
            };
            (pixels, size) = ((0..half.element_product()).map(mean).collect(), half);
        }
        shown
    }

    /// Needles as wide as a pixel, some steps apart; nothing in the right half.
    fn needles(size: USizeVec2, apart: impl Fn(usize) -> usize) -> Vec<Vec4> {
        let pixel = |i: usize| {
            let (x, y) = (i % size.x, i / size.x);
            let is_needle = x < size.x / 2 && (x + y) % apart(y) == 0;
            if is_needle { Vec4::new(0.2, 0.5, 0.1, 1.0) } else { Vec4::ZERO }
        };
        (0..size.element_product()).map(pixel).collect()
    }

    #[test]
    fn thin_things_are_shown_in_small_copies_and_no_more_of_them_in_the_picture() {
        let size = USizeVec2::new(512, 256);
        let before = needles(size, |y| 2 + y / 48);
        let mut after = before.clone();
        keep(&mut after, size, 0.06);
        let (old, new) = (shown(&before, size), shown(&after, size));
        assert_eq!(old[0], new[0]);
        assert!(old[6] < 0.6 * old[0] && new[6] > new[0], "{old:?} {new:?}");
        let clear = after.iter().filter(|pixel| pixel.w > 0.0 && pixel.w < 0.5);
        assert!(
            clear.clone().count() > 0
                && clear
                    .clone()
                    .all(|pixel| pixel.truncate().distance(glam::Vec3::new(0.2, 0.5, 0.1)) < 1e-3)
        );
        assert!((0..size.element_product()).filter(|i| i % 512 >= 256).all(|i| after[i] == Vec4::ZERO));
    }

    #[test]
    fn what_is_dense_stays_as_it_is() {
        let size = USizeVec2::new(96, 40);
        let dense = vec![Vec4::new(0.1, 0.2, 0.1, 1.0); size.element_product()];
        let mut after = dense.clone();
        keep(&mut after, size, 0.06);
        assert_eq!(after, dense);
        keep(&mut [], USizeVec2::ZERO, 1.0);
    }
}
