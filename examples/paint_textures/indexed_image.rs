//! From a painted function to a PNG of at most 256 colours.
//!
//! Each pixel is the mean of four samples. Colours are reduced by median cut: pigments of one petal lie close
//! together, so 256 of them are enough and the files stay small. Where most samples are clear, so is the pixel; it has the
//! mean colour of all others, for what is shown between pixels, and some alpha: in smaller copies, of which programs show what is at least
//! half covered, as much is shown then as in the picture itself (Castaño, "Computing Alpha Mipmaps", 2010).

use super::color::{Lab, srgb8};
use glam::Vec2;
use std::collections::BTreeMap;

const SAMPLES: [Vec2; 4] =
    [Vec2::new(0.25, 0.25), Vec2::new(0.75, 0.25), Vec2::new(0.25, 0.75), Vec2::new(0.75, 0.75)];

/// A picture with its own palette.
#[derive(Debug, PartialEq)]
pub(crate) struct IndexedImage {
    /// Width in pixels.
    pub(crate) width: u32,
    /// Height in pixels.
    pub(crate) height: u32,
    /// Colours.
    pub(crate) palette: Vec<[u8; 3]>,
    /// Index into the palette for each pixel, top row first.
    pub(crate) pixels: Vec<u8>,
    /// The alpha of the last colour of the palette, if that is clear: less than a half.
    clear: Option<u8>,
}

/// Sides of the blocks that are pixels of smaller copies which show as much as the picture.
const BLOCKS: [usize; 4] = [16, 32, 64, 128];

impl IndexedImage {
    /// Paints `paint(u, v)`, u to the right and v upward, both 0 to 1, with at most so many colours, 256 at most.
    pub(crate) fn new((width, height): (u32, u32), most: usize, paint: impl Fn(Vec2) -> Option<Lab>) -> Self {
        let pixel = |i: u32| {
            let corner = Vec2::new((i % width) as f32, (i / width) as f32);
            let sample = |s: &Vec2| {
                let p = (corner + s) / Vec2::new(width as f32, height as f32);
                paint(Vec2::new(p.x, 1.0 - p.y))
            };
            let painted: Vec<Lab> = SAMPLES.iter().filter_map(sample).collect();
            let is_clear = 2 * painted.len() < SAMPLES.len();
            (!is_clear).then(|| srgb8(painted.iter().sum::<Lab>() / painted.len() as f32))
        };
        let pixels: Vec<Option<[u8; 3]>> = (0..width * height).map(pixel).collect();
        let colours: Vec<[u8; 3]> = pixels.iter().copied().flatten().collect();
        let has_clear = colours.len() < pixels.len();
        let (mut palette, index) = reduce(&colours, most - usize::from(has_clear));
        if has_clear {
            palette.push(mean(&colours));
        }
        let clear = has_clear
            .then(|| BLOCKS.map(|block| clear_alpha(&pixels, width as usize, block)))
            .and_then(|alphas| alphas.into_iter().max());
        let last = palette.len().saturating_sub(1) as u8;
        let pixels = pixels.iter().map(|colour| colour.map_or(last, |c| index[&coarse(c)])).collect();
        Self { width, height, palette, pixels, clear }
    }

    /// The picture as a PNG file.
    pub(crate) fn to_png(&self) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(self.palette.concat());
        if let Some(clear) = self.clear {
            let mut alphas = vec![u8::MAX; self.palette.len() - 1];
            alphas.push(clear);
            encoder.set_trns(alphas);
        }
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_compression(png::Compression::High);
        encoder.set_filter(png::Filter::NoFilter);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.pixels)?;
        writer.finish()?;
        Ok(bytes)
    }
}

/// Colours that differ by less than this are one when the palette is made.
fn coarse(c: [u8; 3]) -> [u8; 3] {
    c.map(|x| x >> 2)
}

struct Bin {
    key: [u8; 3],
    sum: [u32; 3],
    count: u32,
}

/// The alpha of clear pixels with which as large a share of all blocks of this side is at least half covered as of all pixels is not clear.
fn clear_alpha(pixels: &[Option<[u8; 3]>], width: usize, block: usize) -> u8 {
    let across = width.div_ceil(block);
    let mut painted = vec![0_usize; across * (pixels.len() / width).div_ceil(block)];
    for (i, _) in pixels.iter().enumerate().filter(|(_, pixel)| pixel.is_some()) {
        painted[i / width / block * across + i % width / block] += 1;
    }
    let shown = painted.iter().sum::<usize>() * painted.len() / pixels.len();
    painted.sort_unstable_by(|a, b| b.cmp(a));
    let least = painted[shown.min(painted.len() - 1)] as f32 / (block * block) as f32;
    // Where a block of which so much is painted is half covered.
    let alpha = (0.5 - least) / (1.0 - least).max(f32::MIN_POSITIVE);
    (alpha.clamp(0.0, 0.45) * 255.0) as u8
}

fn mean(colours: &[[u8; 3]]) -> [u8; 3] {
    let sum = |k: usize| colours.iter().map(|c| u64::from(c[k])).sum::<u64>();
    [0, 1, 2].map(|k| (sum(k) / colours.len().max(1) as u64) as u8)
}

/// Median cut: the palette of at most so many colours, and the palette index of each coarse colour.
fn reduce(colours: &[[u8; 3]], most: usize) -> (Vec<[u8; 3]>, BTreeMap<[u8; 3], u8>) {
    let mut bins: BTreeMap<[u8; 3], Bin> = BTreeMap::new();
    for c in colours {
        let key = coarse(*c);
        let bin = bins.entry(key).or_insert(Bin { key, sum: [0; 3], count: 0 });
        (0..3).for_each(|k| bin.sum[k] += u32::from(c[k]));
        bin.count += 1;
    }
    let mut boxes = vec![bins.into_values().collect::<Vec<_>>()];
    while boxes.len() < most {
        let weight =
            |b: &Vec<Bin>| widest(b).1 as u64 * b.iter().map(|bin| u64::from(bin.count)).sum::<u64>().isqrt();
        let Some(at) = (0..boxes.len()).max_by_key(|i| weight(&boxes[*i])) else { break };
        if boxes[at].len() < 2 {
            break;
        }
        let mut low = boxes.swap_remove(at);
        let axis = widest(&low).0;
        low.sort_by_key(|bin| (bin.key[axis], bin.key));
        let high = low.split_off(low.len() / 2);
        boxes.extend([low, high]);
    }
    let mut index = BTreeMap::new();
    let mut palette = Vec::new();
    for (i, members) in boxes.iter().enumerate() {
        let count: u32 = members.iter().map(|bin| bin.count).sum();
        let sum = |k: usize| members.iter().map(|bin| bin.sum[k]).sum::<u32>();
        palette.push([0, 1, 2].map(|k| ((sum(k) + count / 2) / count) as u8));
        index.extend(members.iter().map(|bin| (bin.key, i as u8)));
    }
    (palette, index)
}

/// Channel in which a box is widest, and how wide.
fn widest(members: &[Bin]) -> (usize, u8) {
    let span = |k: usize| {
        let values = || members.iter().map(|bin| bin.key[k]);
        values().max().unwrap_or(0) - values().min().unwrap_or(0)
    };
    (0..3).map(|k| (k, span(k))).max_by_key(|(_, span)| *span).unwrap_or((0, 0))
}
