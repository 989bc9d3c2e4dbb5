//! How much a drawing file may hold.
//!
//! Generous for any hand that draws, tight enough that a hostile file can cost neither all memory nor minutes: size is
//! checked before parsing, counts while parsing. Past a limit there is an error that names it.

/// Largest file in bytes: room for [`MAX_POINTS`] samples with all that a tablet reports.
pub const MAX_FILE_BYTES: u64 = 512 << 20;

/// Most samples in one drawing, all strokes together (in SVG: after curves were turned into polylines).
pub const MAX_POINTS: usize = 10_000_000;

/// Most strokes in one drawing.
pub const MAX_STROKES: usize = 1_000_000;

/// Largest distance from the origin along x, y or toward the viewer, in canvas pixels; beyond it `f32` no longer resolves a pixel.
pub const MAX_COORDINATE: f32 = 1e7;

/// Longest side of the canvas in pixels: the widest that a drawing within [`MAX_COORDINATE`] can be.
pub const MAX_CANVAS_SIDE: f32 = 2.0 * MAX_COORDINATE;

/// Largest tilt of the pen from upright, in degrees, either way.
pub const MAX_TILT_DEG: f32 = 90.0;

/// Longest stroke in milliseconds (eleven days).
pub const MAX_TIME_MS: f32 = 1e9;

/// Largest picture in bytes, as the picture's own file has it: the reference picture, and each of the artist's textures.
pub const MAX_PICTURE_BYTES: usize = crate::picture::MAX_BYTES;

/// Most bytes of all pictures together that the artist chose as textures.
pub const MAX_TEXTURE_BYTES: usize = 64 << 20;

/// Largest turn of the reference picture in degrees, either way.
pub const MAX_REFERENCE_ROTATION_DEG: f32 = 360.0;

/// Longest name of a texture in bytes; in files of the first version also its path.
pub const MAX_TEXTURE_NAME_BYTES: usize = 4096;

/// Most parameters set by one drawing.
pub const MAX_PARAMS: usize = 4096;

/// Deepest nesting of parameter groups.
pub const MAX_PARAM_DEPTH: usize = 16;

/// Most plants that stand beside the drawn one.
pub const MAX_PLANTS: usize = 16;

/// Oldest age of such a plant in years.
pub const MAX_PLANT_AGE: f32 = 10_000.0;

/// Least height of such a plant in canvas pixels.
pub const MIN_PLANT_HEIGHT: f32 = 0.01;

/// Longest name of its species in bytes.
pub const MAX_SPECIES_NAME_BYTES: usize = 200;

/// Most corrections of how strokes are read together.
pub const MAX_CORRECTIONS: usize = 4096;

/// Most strokes that all corrections together name, one that two of them name counted twice.
pub const MAX_CORRECTED_STROKES: usize = 200_000;

/// Most flowers whose petals the artist shaped.
pub const MAX_PETAL_SHAPES: usize = 4096;

/// Most strokes that all shapes of petals together name, one that two of them name counted twice.
pub const MAX_SHAPED_STROKES: usize = MAX_CORRECTED_STROKES;

/// Farthest that a control point of a petal is moved along each of its directions, in shares of the petal's length.
pub const MAX_PETAL_OFFSET: f32 = 2.0;

/// Most branches and organs that the artist turned or moved.
pub const MAX_PART_POSES: usize = 4096;

/// Most strokes of a garden.
pub const MAX_GARDEN_STROKES: usize = 4096;

/// Most samples of all of them together.
pub const MAX_GARDEN_POINTS: usize = 50_000;

/// Most other drawings that are planted in a garden.
pub const MAX_GARDEN_DRAWINGS: usize = 64;

/// Farthest that a garden reaches from its drawn plant along each axis, metres.
pub const MAX_GARDEN_METRES: f32 = 5000.0;

/// Most remarks kept; the rest is counted.
pub const MAX_WARNINGS: usize = 100;

/// Most elements, texts and comments in an SVG, `<use>` copies included.
pub const MAX_SVG_NODES: usize = 2_000_000;

/// Most attributes in an SVG.
pub const MAX_SVG_ATTRIBUTES: usize = 8_000_000;

/// Most steps that the XML reader may spend on comparing names: it compares every two attributes of an element, and every
/// name with all namespaces in scope.
pub const MAX_SVG_COMPARISONS: u64 = 500_000_000;

/// Deepest chain of `<use>` elements that refer to each other.
pub const MAX_SVG_USE_DEPTH: usize = 16;

/// Most bytes of attributes that `<use>` may have read again.
pub const MAX_SVG_COPIED_BYTES: usize = 64 << 20;

/// Most bytes of all style sheets of an SVG together.
pub const MAX_SVG_STYLE_BYTES: usize = 4 << 20;

/// Most steps of finding the rules of style sheets that hold for elements, copies by `<use>` included.
pub const MAX_SVG_STYLE_STEPS: u64 = 20_000_000;
