//! Contact sheets of the drawings by people: each drawing beside the plant that is made of it, from the front and turned.
//!
//! ```text
//! cargo run --example draw_contact_sheets -- FOLDER [development] [opened] [added] [icons] [icons_added] [held_back] [added_held_back] [icons_held_back] [CLASS]... [CLASS/INDEX,...]...
//! ```
//!
//! A class, such as `tree`, is that class' drawings but those held back; `tree/5,leaf/29` are these drawings of them, in this
//! order, on the sheet `picked`; `tree/+5` is one of those that were added later.
//! Without a choice, the development half and the icons. The held-back drawings are there to judge by, not to look at on the way.
//! The sheets are FOLDER/NAME-01.png and so on, twelve drawings each. A plant that cannot be built leaves its place empty and
//! is told.

mod letters;
#[path = "../../tests/common/people.rs"]
mod people;

use penstemon::cli::common::built_in_texture;
use penstemon::formats::textures::fetch;
use penstemon::pipeline;
use penstemon::plant::Texture;
use penstemon::render::{Background, Direction, PictureOptions, Projection, RenderedImage, Renderer, View};
use people::{Drawing, Share};
use std::error::Error;
use std::fs;
use std::io;
use std::path::Path;

/// Sides of a picture in pixels.
const SIDE: usize = 230;
/// Height of the names in pixels.
const NAME: usize = 24;
/// Drawings beside each other, and below.
const COLUMNS: usize = 2;
const ROWS: usize = 6;
/// Pictures of a drawing: itself, from the front, turned.
const PICTURES: usize = 3;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let folder = words.next().ok_or("name a folder")?;
    let mut chosen: Vec<String> = words.collect();
    if chosen.is_empty() {
        chosen = ["development", "icons"].map(str::to_owned).to_vec();
    }
    fs::create_dir_all(&folder)?;
    let mut renderer = Renderer::new()?;
    for name in chosen {
        let drawings = match name.as_str() {
            "development" => people::drawings(Share::Development)?,
            "opened" => people::drawings(Share::Opened)?,
            "added" => people::drawings(Share::Added)?,
            "held_back" => people::drawings(Share::HeldBack)?,
            "added_held_back" => people::drawings(Share::AddedHeldBack)?,
            "icons" => people::icons()?,
            "icons_added" => people::icons_added(false)?,
            "icons_held_back" => people::icons_added(true)?,
            class if people::CLASSES.contains(&class) => {
                let mut drawings = known()?;
                drawings.retain(|drawing| drawing.class == class);
                drawings
            }
            list if list.contains('/') => picked(list)?,
            _ => {
                return Err(format!(
                    "`{name}` is none of development, opened, added, icons, icons_added, held_back, added_held_back, icons_held_back and the classes"
                )
                .into());
            }
        };
        for (number, drawings) in drawings.chunks(COLUMNS * ROWS).enumerate() {
            let mut sheet = Sheet::blank();
            for (place, drawing) in drawings.iter().enumerate() {
                sheet.add(place, drawing, &mut renderer)?;
            }
            let sheet_name = if name.contains('/') { "picked" } else { &name };
            let path = Path::new(&folder).join(format!("{sheet_name}-{:02}.png", number + 1));
            fs::write(path, sheet.to_png()?)?;
        }
    }
    Ok(())
}

/// The drawings that are looked at while the program is made.
fn known() -> io::Result<Vec<Drawing>> {
    let mut drawings = people::drawings(Share::Development)?;
    drawings.extend(people::drawings(Share::Opened)?);
    drawings.extend(people::drawings(Share::Added)?);
    drawings.extend(people::icons()?);
    drawings.extend(people::icons_added(false)?);
    Ok(drawings)
}

/// The drawings of a list, `CLASS/INDEX,...`, none of them held back.
fn picked(list: &str) -> Result<Vec<Drawing>, Box<dyn Error>> {
    let mut drawings = known()?;
    let mut pick = |wanted: &str| {
        let is_it = |d: &Drawing| format!("{}/{}", d.class, d.name) == wanted;
        let place = drawings.iter().position(is_it).ok_or_else(|| format!("there is no `{wanted}`"))?;
        Ok(drawings.remove(place))
    };
    list.split(',').map(&mut pick).collect()
}

/// A picture in rows of red, green and blue.
struct Sheet(Vec<u8>);

impl Sheet {
    const WIDTH: usize = COLUMNS * PICTURES * SIDE;
    const HEIGHT: usize = ROWS * (SIDE + NAME);

    fn blank() -> Self {
        Self(vec![255; 3 * Self::WIDTH * Self::HEIGHT])
    }

    fn dot(&mut self, x: usize, y: usize, colour: [u8; 3]) {
        let at = 3 * (y * Self::WIDTH + x);
        self.0[at..at + 3].copy_from_slice(&colour);
    }

    fn put(&mut self, left: usize, top: usize, picture: &RenderedImage) {
        for (i, pixel) in picture.pixels().chunks_exact(4).enumerate() {
            let (x, y) = (i % picture.width() as usize, i / picture.width() as usize);
            self.dot(left + x, top + y, [pixel[0], pixel[1], pixel[2]]);
        }
    }

    fn add(
        &mut self,
        place: usize,
        drawing: &Drawing,
        renderer: &mut Renderer,
    ) -> Result<(), Box<dyn Error>> {
        let (left, top) = (place % COLUMNS * PICTURES * SIDE, place / COLUMNS * (SIDE + NAME));
        let options =
            PictureOptions { width: SIDE as u32, height: SIDE as u32, background: Background::Paper };
        self.put(left, top, &renderer.drawing(&drawing.sketch, &options)?);
        let (species, _) = pipeline::species_or_usual(&drawing.sketch, Path::new(""))?;
        let params = pipeline::params_of(&drawing.sketch, &species, &[])?;
        let built = pipeline::build(&drawing.sketch, &species, &params);
        let textures = |texture: &Texture| Ok(fetch(texture, &built_in_texture)?);
        for (column, direction) in [Direction::Front, Direction::ThreeQuarter].into_iter().enumerate() {
            let view = View { direction, projection: Projection::Perspective, turn_deg: 0.0 };
            match renderer.picture(&built.model, &textures, &view, &options) {
                Ok(picture) => self.put(left + (column + 1) * SIDE, top, &picture),
                Err(error) => eprintln!("{} {}: {error}", drawing.class, drawing.name),
            }
        }
        for (x, y) in letters::dots(&format!("{} {}", drawing.class, drawing.name)) {
            let (x, y) = (left + 8 + 2 * x, top + SIDE + 4 + 2 * y);
            [(0, 0), (1, 0), (0, 1), (1, 1)]
                .into_iter()
                .for_each(|(dx, dy)| self.dot(x + dx, y + dy, [0; 3]));
        }
        Ok(())
    }

    fn to_png(&self) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, Self::WIDTH as u32, Self::HEIGHT as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header()?.write_image_data(&self.0)?;
        Ok(bytes)
    }
}
