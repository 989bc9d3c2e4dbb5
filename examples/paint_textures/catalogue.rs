//! Every texture of the program: its name, its size and how it is painted.

use super::bark;
use super::color::{Lab, hex};
use super::disc::Disc;
use super::flesh;
use super::indexed_image::IndexedImage;
use super::leaf::{Leaf, Marking, Venation};
use super::leafy_shoot::LeafyShoot;
use super::needles::Shoot;
use super::petals;
use super::tree_bark;
use glam::Vec2;

/// A texture that can be painted.
pub(crate) struct Texture {
    /// File name without extension.
    pub(crate) name: &'static str,
    size: (u32, u32),
    /// Nothing where it is clear.
    paint: Box<dyn Fn(Vec2) -> Option<Lab>>,
}

impl Texture {
    /// Paints it.
    pub(crate) fn picture(&self) -> IndexedImage {
        IndexedImage::new(self.size.0, self.size.1, &self.paint)
    }
}

/// All textures.
pub(crate) fn all() -> Vec<Texture> {
    let petals = petals::ALL.iter().map(|(name, petal)| blade(name, |p| petal.paint(p)));
    let leaves = leaves().into_iter().map(|(name, leaf)| blade(name, move |p| leaf.paint(p)));
    let needles = needles().into_iter().map(|(name, shoot)| Texture {
        name,
        size: (256, 512),
        paint: Box::new(shoot.painter()),
    });
    let shoots = leafy_shoots().into_iter().map(|(name, shoot)| Texture {
        name,
        size: (512, 512),
        paint: Box::new(shoot.painter()),
    });
    petals.chain(leaves).chain(needles).chain(shoots).chain(surfaces()).chain(discs()).collect()
}

fn blade(name: &'static str, paint: impl Fn(Vec2) -> Lab + 'static) -> Texture {
    opaque(name, (256, 512), paint)
}

fn square(name: &'static str, paint: impl Fn(Vec2) -> Lab + 'static) -> Texture {
    opaque(name, (256, 256), paint)
}

/// What is looked at on thick bodies, too.
fn trunk(name: &'static str, paint: impl Fn(Vec2) -> Lab + 'static) -> Texture {
    opaque(name, (512, 512), paint)
}

fn opaque(name: &'static str, size: (u32, u32), paint: impl Fn(Vec2) -> Lab + 'static) -> Texture {
    Texture { name, size, paint: Box::new(move |p| Some(paint(p))) }
}

/// Shoots of broad-leaved trees.
fn leafy_shoots() -> Vec<(&'static str, LeafyShoot)> {
    let linden = LeafyShoot {
        width: 0.8,
        leaves: 6,
        length: 0.27,
        angle: 62.0,
        opposite: false,
        stalk: 0.3,
        half_width: 0.42,
        taper: (0.32, 0.95),
        leaf: pinnate(0x6c9a48, 0x486f34, 0xaec888, 5.0, 0.42, 601),
        bark: 0x8a7a50,
        seed: 603,
    };
    let beech = LeafyShoot {
        width: 0.64,
        leaves: 8,
        length: 0.25,
        angle: 58.0,
        opposite: false,
        stalk: 0.08,
        half_width: 0.3,
        taper: (0.6, 0.8),
        leaf: pinnate(0x5c9344, 0x3e6e30, 0xa2c480, 8.0, 0.3, 607),
        bark: 0x7a6448,
        seed: 611,
    };
    let poplar = LeafyShoot {
        width: 0.8,
        leaves: 8,
        length: 0.22,
        angle: 56.0,
        opposite: false,
        stalk: 0.5,
        half_width: 0.44,
        taper: (0.42, 0.9),
        leaf: pinnate(0x6a9c46, 0x4a7434, 0xb8cc80, 5.0, 0.5, 641),
        bark: 0x9a8a58,
        seed: 643,
    };
    let olive = LeafyShoot {
        width: 0.5,
        leaves: 10,
        length: 0.27,
        angle: 48.0,
        opposite: true,
        stalk: 0.06,
        half_width: 0.095,
        taper: (0.6, 0.75),
        leaf: pinnate(0x74885c, 0x566a46, 0xb4c0a0, 5.0, 0.6, 683),
        bark: 0x9c9480,
        seed: 691,
    };
    vec![("shoot_linden", linden), ("shoot_beech", beech), ("shoot_poplar", poplar), ("shoot_olive", olive)]
}

/// Shoots of conifers.
fn needles() -> Vec<(&'static str, Shoot)> {
    let spruce = Shoot {
        width: 0.4,
        twigs: 9,
        angle: 40.0,
        middle: (0.0, 0.96),
        needle: 0.056,
        thin: 0.0038,
        apart: 0.0085,
        spread: (38.0, 66.0),
        tufts: None,
        colours: [0x2c5230, 0x54824a, 0x98bb74, 0x6d5238],
        seed: 511,
    };
    let pine = Shoot {
        width: 0.8,
        twigs: 0,
        middle: (0.14, 0.56),
        needle: 0.44,
        thin: 0.0075,
        apart: 0.034,
        spread: (4.0, 78.0),
        colours: [0x35593f, 0x66906a, 0x86a872, 0x8a6a48],
        seed: 521,
        ..spruce
    };
    let larch = Shoot {
        width: 0.4,
        twigs: 5,
        angle: 40.0,
        needle: 0.055,
        thin: 0.0042,
        apart: 0.0055,
        spread: (0.0, 150.0),
        tufts: Some(0.09),
        colours: [0x5d8a3e, 0x8db45a, 0xb4cf7c, 0x9a7a52],
        seed: 541,
        ..spruce
    };
    let cypress = Shoot {
        width: 0.5,
        twigs: 13,
        angle: 30.0,
        needle: 0.04,
        thin: 0.0065,
        apart: 0.013,
        spread: (14.0, 26.0),
        colours: [0x2d5232, 0x5a8450, 0x7fa468, 0x6d5238],
        seed: 557,
        ..spruce
    };
    vec![("shoot_spruce", spruce), ("shoot_pine", pine), ("shoot_larch", larch), ("shoot_cypress", cypress)]
}

fn pinnate(field: u32, shade: u32, vein: u32, pairs: f32, rise: f32, seed: u32) -> Leaf {
    Leaf {
        field,
        shade,
        vein,
        seed,
        margin: (shade, 0.2),
        tip: (field, 0.0),
        venation: Venation::Pinnate { pairs, rise },
        marking: (Marking::Plain, 0),
        swell: 0.06,
    }
}

fn palmate(field: u32, shade: u32, vein: u32, angles: &'static [f32], seed: u32) -> Leaf {
    Leaf { venation: Venation::Palmate(angles), ..pinnate(field, shade, vein, 1.0, 0.0, seed) }
}

fn parallel(field: u32, shade: u32, vein: u32, lines: f32, seed: u32) -> Leaf {
    Leaf { venation: Venation::Parallel(lines), swell: 0.03, ..pinnate(field, shade, vein, 1.0, 0.0, seed) }
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
        trunk("bark_grey", tree_bark::smooth_grey),
        trunk("bark_cherry", tree_bark::cherry),
        trunk("bark_birch", tree_bark::birch),
        trunk("bark_palm", tree_bark::palm),
        trunk("cactus", flesh::cactus),
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
