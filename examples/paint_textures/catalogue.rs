//! Every texture of the program: its name, its size and how it is painted.

use super::bark;
use super::color::{Lab, hex};
use super::disc::Disc;
use super::flesh;
use super::fruit;
use super::indexed_image::IndexedImage;
use super::leaf::{Leaf, Marking, palmate, parallel, pinnate};
use super::petals;
use super::shoots;
use super::tree_bark;
use glam::Vec2;

/// A texture that can be painted.
pub(crate) struct Texture {
    /// File name without extension.
    pub(crate) name: &'static str,
    size: (u32, u32),
    colours: usize,
    /// Nothing where it is clear.
    paint: Box<dyn Fn(Vec2) -> Option<Lab>>,
}

impl Texture {
    /// Paints it.
    pub(crate) fn picture(&self) -> IndexedImage {
        IndexedImage::new(self.size, self.colours, &self.paint)
    }
}

/// All textures.
pub(crate) fn all() -> Vec<Texture> {
    let petals = petals::ALL.iter().map(|(name, petal)| blade(name, |p| petal.paint(p)));
    let leaves = leaves().into_iter().map(|(name, leaf)| blade(name, move |p| leaf.paint(p)));
    let needles =
        shoots::needles().into_iter().map(|(name, shoot)| cut_out(name, (256, 512), shoot.painter()));
    let leafy = shoots::leafy().into_iter().map(|(name, shoot)| cut_out(name, (512, 512), shoot.painter()));
    petals.chain(leaves).chain(needles).chain(leafy).chain(surfaces()).chain(discs()).collect()
}

fn blade(name: &'static str, paint: impl Fn(Vec2) -> Lab + 'static) -> Texture {
    opaque(name, (256, 512), paint)
}

fn square(name: &'static str, paint: impl Fn(Vec2) -> Lab + 'static) -> Texture {
    opaque(name, (256, 256), paint)
}

/// What is looked at on thick bodies, too.
fn trunk(name: &'static str, paint: impl Fn(Vec2) -> Lab + 'static) -> Texture {
    opaque(name, (1024, 1024), paint)
}

/// The skin of a fruit, which is seen small.
fn fruit(name: &'static str, paint: impl Fn(Vec2) -> Lab + 'static) -> Texture {
    Texture { name, size: (128, 128), colours: 64, paint: Box::new(move |p| Some(paint(p))) }
}

fn opaque(name: &'static str, size: (u32, u32), paint: impl Fn(Vec2) -> Lab + 'static) -> Texture {
    Texture { name, size, colours: 256, paint: Box::new(move |p| Some(paint(p))) }
}

/// A shoot, seen small: fewer colours make a smaller file.
fn cut_out(name: &'static str, size: (u32, u32), paint: impl Fn(Vec2) -> Option<Lab> + 'static) -> Texture {
    Texture { name, size, colours: 64, paint: Box::new(paint) }
}

fn leaves() -> Vec<(&'static str, Leaf)> {
    const LOBED: &[f32] = &[0.0, -40.0, 40.0, -78.0, 78.0];
    const THREE: &[f32] = &[0.0, -48.0, 48.0];
    const ROUND: &[f32] = &[0.0, -32.0, 32.0, -60.0, 60.0, -84.0, 84.0];
    vec![
        ("leaf_green", pinnate(0x5f8f3c, 0x3d6a2c, 0xa9c47c, 7.0, 0.30, 201)),
        (
            "leaf_dark",
            Leaf { margin: (0x6e3a34, 0.35), ..pinnate(0x3e6b3a, 0x274b2b, 0x86a86c, 8.0, 0.26, 207) },
        ),
        (
            "leaf_fresh",
            Leaf { tip: (0xa98a4a, 0.35), ..pinnate(0x86ad4d, 0x5f8c3b, 0xc7d796, 9.0, 0.24, 211) },
        ),
        ("leaf_willow", pinnate(0x8aa562, 0x67854b, 0xd4dca8, 16.0, 0.20, 223)),
        ("leaf_plumeria", Leaf { swell: 0.035, ..pinnate(0x3f7d3c, 0x2a5c30, 0xb3cf8c, 16.0, 0.07, 227) }),
        ("leaf_sunflower", pinnate(0x6b9440, 0x49702f, 0xbcca86, 5.0, 0.42, 229)),
        ("leaf_daisy", Leaf { swell: 0.03, ..pinnate(0x6e9d48, 0x4b7a34, 0xa8c47a, 4.0, 0.5, 233) }),
        (
            "leaf_hepatica",
            Leaf {
                marking: (Marking::Patches, 0x8fa66a),
                margin: (0x5b2f3c, 0.4),
                ..palmate(0x4a7440, 0x2f5230, 0x93ad70, THREE, 239)
            },
        ),
        ("leaf_mallow", palmate(0x6a9247, 0x4a7236, 0xb0c684, ROUND, 241)),
        (
            "leaf_geranium",
            Leaf {
                marking: (Marking::Zone, 0x4a3a22),
                swell: 0.07,
                ..palmate(0x7ba64c, 0x55863a, 0xb9cf8c, ROUND, 251)
            },
        ),
        (
            "leaf_maple",
            Leaf {
                tip: (0xa82a1c, 0.75),
                margin: (0x8f2418, 0.5),
                swell: 0.05,
                ..palmate(0xd9842c, 0xc0502a, 0xecc276, LOBED, 257)
            },
        ),
        (
            "leaf_oxalis",
            Leaf {
                marking: (Marking::Chevron, 0xb8cf92),
                swell: 0.03,
                ..pinnate(0x6fa248, 0x4c8038, 0xb4cc88, 6.0, 0.34, 263)
            },
        ),
        ("leaf_bamboo", Leaf { tip: (0xc4b46a, 0.4), ..parallel(0x76a044, 0x557f36, 0xb6c97e, 15.0, 269) }),
        ("sepal", Leaf { tip: (0x9a7a5c, 0.25), ..parallel(0x7fa554, 0x5c8440, 0xb4cc8a, 7.0, 271) }),
    ]
}

fn surfaces() -> Vec<Texture> {
    vec![
        square("stem_green", |p| bark::stem(p, 0x8db05c, 0x5f8a42)),
        square("twig", bark::twig),
        trunk("bark_fissured", tree_bark::fissured),
        trunk("bark_plated", tree_bark::plated),
        trunk("bark_cracked", tree_bark::cracked),
        trunk("bark_stringy", tree_bark::stringy),
        trunk("bark_grey", tree_bark::smooth_grey),
        trunk("bark_cherry", tree_bark::cherry),
        trunk("bark_birch", tree_bark::birch),
        trunk("bark_palm", tree_bark::palm),
        trunk("cactus", flesh::cactus),
        fruit("fruit_apple", fruit::apple),
        fruit("fruit_acorn", fruit::acorn),
        fruit("fruit_cone", fruit::cone),
        trunk("mushroom_cap", flesh::cap),
        trunk("mushroom_gills", flesh::gills),
        square("mushroom_stalk", flesh::stalk),
        square("bark_bamboo", bark::bamboo),
        square("terracotta", bark::terracotta),
        square("soil", bark::soil),
    ]
}

fn discs() -> Vec<Texture> {
    vec![
        square(
            "disc_daisy",
            Disc {
                florets: 210,
                colours: [0xc9b92c, 0xf0b81a, 0xe9a312],
                gap: 0x8a5a08,
                glint: 0xffe98a,
                size: 1.05,
                bud: 0.5,
                seed: 301,
            }
            .painter(),
        ),
        square(
            "disc_sunflower",
            Disc {
                florets: 420,
                colours: [0x6d6a2c, 0x3d2417, 0x7a4a16],
                gap: 0x1c0f0a,
                glint: 0xc98d2e,
                size: 1.05,
                bud: 0.35,
                seed: 307,
            }
            .painter(),
        ),
        square(
            "disc_green",
            Disc {
                florets: 46,
                colours: [0xa9bf5c, 0x8fae4c, 0x7c9c44],
                gap: 0x4c6a2c,
                glint: 0xd6e2a0,
                size: 0.98,
                bud: 2.0,
                seed: 311,
            }
            .painter(),
        ),
        square("disc_soft", |p| {
            let grain = super::noise::fractal(p * 9.0, super::noise::ENDLESS, 3, 313);
            super::color::lighter(hex(0xf0e6c8), 0.035 * grain - 0.10 * (p - 0.5).length())
        }),
    ]
}
