//! Petals and leaves of the species drawn here; see [`Form`] for how to read the numbers.

use super::form::{Form, Margin, Teeth, Tip};

/// Ray floret of a daisy: a long strap.
pub const DAISY_PETAL: Form = Form {
    runs: &[&[(0.08, 0.022), (0.3, 0.055), (0.6, 0.083), (0.85, 0.083), (0.96, 0.052), (1.0, 0.0)]],
    tip: Tip::Round,
    margin: Margin::Entire,
};

/// Sepal-petal of a hepatica: an oval.
pub const HEPATICA_PETAL: Form = Form {
    runs: &[&[
        (0.07, 0.025),
        (0.2, 0.11),
        (0.45, 0.225),
        (0.68, 0.25),
        (0.87, 0.165),
        (0.965, 0.07),
        (1.0, 0.0),
    ]],
    tip: Tip::Round,
    margin: Margin::Entire,
};

/// Corolla lobe of a jasmine: oblong, acute, narrow at the throat.
pub const JASMINE_PETAL: Form = Form {
    runs: &[&[
        (0.07, 0.022),
        (0.22, 0.075),
        (0.45, 0.185),
        (0.66, 0.215),
        (0.85, 0.12),
        (0.95, 0.045),
        (1.0, 0.0),
    ]],
    tip: Tip::Sharp,
    margin: Margin::Entire,
};

/// Petal of a mallow: narrow claw, broad notched end.
pub const MALLOW_PETAL: Form = Form {
    runs: &[&[
        (0.06, 0.022),
        (0.22, 0.075),
        (0.45, 0.2),
        (0.7, 0.345),
        (0.87, 0.385),
        (0.98, 0.31),
        (1.005, 0.18),
        (0.96, 0.06),
        (0.885, 0.0),
    ]],
    tip: Tip::Sharp,
    margin: Margin::Entire,
};

/// Corolla lobe of a balloon flower: broad, with a drawn-out point.
pub const BALLOON_PETAL: Form = Form {
    runs: &[&[
        (0.05, 0.04),
        (0.15, 0.13),
        (0.34, 0.27),
        (0.54, 0.325),
        (0.73, 0.24),
        (0.88, 0.1),
        (0.96, 0.03),
        (1.0, 0.0),
    ]],
    tip: Tip::Sharp,
    margin: Margin::Entire,
};

/// Petal of a plumeria: obovate, broadest near the rounded end.
pub const PLUMERIA_PETAL: Form = Form {
    runs: &[&[
        (0.05, 0.03),
        (0.18, 0.12),
        (0.4, 0.27),
        (0.64, 0.385),
        (0.83, 0.35),
        (0.95, 0.215),
        (0.995, 0.075),
        (1.0, 0.0),
    ]],
    tip: Tip::Round,
    margin: Margin::Entire,
};

/// Petal of an oxalis: a wedge with an almost straight end.
pub const OXALIS_PETAL: Form = Form {
    runs: &[&[
        (0.06, 0.022),
        (0.28, 0.1),
        (0.55, 0.22),
        (0.8, 0.29),
        (0.94, 0.22),
        (0.99, 0.1),
        (0.985, 0.0),
    ]],
    tip: Tip::Round,
    margin: Margin::Entire,
};

/// Petal of a rose: broad, with a small point where the margin rolls back.
pub const ROSE_PETAL: Form = Form {
    runs: &[&[(0.06, 0.05), (0.2, 0.2), (0.45, 0.36), (0.7, 0.4), (0.88, 0.3), (0.97, 0.13), (1.0, 0.0)]],
    tip: Tip::Sharp,
    margin: Margin::Entire,
};

/// Spoon-shaped leaf of a daisy.
pub const DAISY_LEAF: Form = Form {
    runs: &[&[
        (0.0, 0.022),
        (0.25, 0.036),
        (0.42, 0.07),
        (0.58, 0.145),
        (0.75, 0.2),
        (0.9, 0.155),
        (0.98, 0.065),
        (1.0, 0.0),
    ]],
    tip: Tip::Round,
    margin: Margin::Crenate(Teeth { count: 11, depth: 0.016, from: 0.42 }),
};

/// Three-lobed leaf of a hepatica.
pub const HEPATICA_LEAF: Form = Form {
    runs: &[
        &[(0.0, 0.02), (-0.1, 0.1), (-0.16, 0.25), (-0.08, 0.43), (0.1, 0.56), (0.3, 0.6), (0.5, 0.545)],
        &[(0.5, 0.545), (0.53, 0.4), (0.44, 0.2)],
        &[(0.44, 0.2), (0.6, 0.3), (0.76, 0.28), (0.9, 0.15), (1.0, 0.0)],
    ],
    tip: Tip::Sharp,
    margin: Margin::Entire,
};

/// Leaflet of a jasmine: ovate with a long point.
pub const JASMINE_LEAF: Form = Form {
    runs: &[&[
        (0.0, 0.015),
        (0.08, 0.09),
        (0.25, 0.185),
        (0.45, 0.2),
        (0.68, 0.125),
        (0.87, 0.04),
        (1.0, 0.0),
    ]],
    tip: Tip::Sharp,
    margin: Margin::Entire,
};

/// Round leaf of a mallow with five shallow lobes.
pub const MALLOW_LEAF: Form = Form {
    runs: &[
        &[(0.0, 0.02), (-0.1, 0.13), (-0.11, 0.29), (0.0, 0.43), (0.15, 0.5), (0.29, 0.49), (0.4, 0.435)],
        &[(0.4, 0.435), (0.53, 0.49), (0.66, 0.47), (0.76, 0.39), (0.79, 0.29), (0.775, 0.215)],
        &[(0.775, 0.215), (0.89, 0.205), (0.97, 0.12), (1.0, 0.0)],
    ],
    tip: Tip::Round,
    margin: Margin::Crenate(Teeth { count: 17, depth: 0.022, from: 0.14 }),
};

/// Leaf of a balloon flower: lance-shaped, sharply toothed.
pub const BALLOON_LEAF: Form = Form {
    runs: &[&[
        (0.0, 0.014),
        (0.09, 0.05),
        (0.22, 0.15),
        (0.38, 0.195),
        (0.54, 0.175),
        (0.7, 0.115),
        (0.88, 0.04),
        (1.0, 0.0),
    ]],
    tip: Tip::Sharp,
    margin: Margin::Serrate(Teeth { count: 10, depth: 0.022, from: 0.12 }),
};

/// Leaf of a plumeria: long, elliptical, with a short point.
pub const PLUMERIA_LEAF: Form = Form {
    runs: &[&[
        (0.0, 0.012),
        (0.1, 0.035),
        (0.27, 0.115),
        (0.5, 0.165),
        (0.72, 0.15),
        (0.89, 0.075),
        (0.96, 0.025),
        (1.0, 0.0),
    ]],
    tip: Tip::Sharp,
    margin: Margin::Entire,
};

/// Leaflet of an oxalis: an upside-down heart.
pub const OXALIS_LEAF: Form = Form {
    runs: &[&[
        (0.0, 0.015),
        (0.14, 0.09),
        (0.36, 0.26),
        (0.6, 0.43),
        (0.82, 0.5),
        (0.97, 0.4),
        (0.99, 0.22),
        (0.92, 0.08),
        (0.8, 0.0),
    ]],
    tip: Tip::Sharp,
    margin: Margin::Entire,
};

/// Leaf of the potted plant: glossy, ovate, pointed.
pub const POTTED_LEAF: Form = Form {
    runs: &[&[(0.0, 0.02), (0.1, 0.1), (0.3, 0.2), (0.52, 0.205), (0.75, 0.13), (0.9, 0.05), (1.0, 0.0)]],
    tip: Tip::Sharp,
    margin: Margin::Entire,
};

/// Five-lobed leaf of a maple.
pub const MAPLE_LEAF: Form = Form {
    runs: &[
        &[(0.0, 0.02), (-0.05, 0.12), (-0.12, 0.3)],
        &[(-0.12, 0.3), (0.02, 0.3), (0.12, 0.26)],
        &[(0.12, 0.26), (0.3, 0.42), (0.55, 0.56)],
        &[(0.55, 0.56), (0.54, 0.36), (0.5, 0.19)],
        &[(0.5, 0.19), (0.64, 0.23), (0.72, 0.22)],
        &[(0.72, 0.22), (0.84, 0.09), (1.0, 0.0)],
    ],
    tip: Tip::Sharp,
    margin: Margin::Entire,
};

/// Leaf of a willow: a narrow lance.
pub const WILLOW_LEAF: Form = Form {
    runs: &[&[(0.0, 0.012), (0.15, 0.055), (0.4, 0.085), (0.65, 0.065), (0.87, 0.022), (1.0, 0.0)]],
    tip: Tip::Sharp,
    margin: Margin::Entire,
};

/// Leaflet of a rose: ovate, finely toothed.
pub const ROSE_LEAF: Form = Form {
    runs: &[&[(0.0, 0.018), (0.08, 0.12), (0.28, 0.26), (0.5, 0.28), (0.75, 0.16), (0.9, 0.06), (1.0, 0.0)]],
    tip: Tip::Sharp,
    margin: Margin::Serrate(Teeth { count: 11, depth: 0.024, from: 0.1 }),
};
