//! A drawn mallow between a birch and a hazel that grow from seeds.

use super::super::sheet::{Grown, Sheet};

/// Width of the sheet.
const WIDTH: u32 = 1536;
/// Where the roots of the mallow are.
const GROUND: u32 = 1000;

/// What grows beside the mallow.
const PLANTS: [Grown; 2] = [
    Grown { species: "birch", seed: 3, age: 7, foot: [215, GROUND], height: 960 },
    Grown { species: "hazel", seed: 5, age: 4, foot: [1330, GROUND], height: 560 },
];

/// The drawing.
pub fn draw() -> Sheet {
    let mallow = super::mallow::draw();
    let aside = f64::from(WIDTH - mallow.size[0]) / 2.0;
    let mut sheet = Sheet { size: [WIDTH, mallow.size[1]], plants: &PLANTS, ..mallow };
    let points = sheet.strokes.iter_mut().flat_map(|stroke| &mut stroke.points);
    points.for_each(|[x, _, _]| *x += aside);
    sheet
}
