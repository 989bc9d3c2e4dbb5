//! A drawing of another plant that the artist planted in a garden: a copy of it inside the drawing that has the garden, so that it is
//! there wherever that drawing goes.
//!
//! The copy has the plant alone: no plants beside it, no garden of its own, no picture under it. In a file the copies stand apart from the strokes
//! that name them, each once ([`super::garden::named`]); in the journal too, by their hash.
//!
//! Limits: a species file of the artist's own stays where it is, so such a plant is built as one of any species.

use super::species_file::is_file;
use super::{Sketch, limits};
use crate::picture::content_hash;
use std::fmt;
use std::sync::Arc;

/// A drawing in a garden. Copies share it.
#[derive(Clone)]
pub struct GardenDrawing(Arc<Inside>);

struct Inside {
    name: String,
    sketch: Sketch,
    hash: u64,
}

impl GardenDrawing {
    /// Takes the plant of a drawing, under a name for the artist; a longer name is cut off.
    ///
    /// # Errors
    /// A name without letters, in words.
    pub fn new(name: &str, sketch: Sketch) -> Result<Self, String> {
        let name = name.trim();
        let name = &name[..name.floor_char_boundary(limits::MAX_SPECIES_NAME_BYTES)];
        if name.is_empty() {
            return Err("a drawing in a garden needs a name".to_owned());
        }
        let species = sketch.species.filter(|species| !is_file(species));
        let sketch =
            Sketch { garden: Default::default(), plants: Vec::new(), reference: None, species, ..sketch };
        let pictures: Vec<u64> = sketch.pictures().map(|picture| picture.hash()).collect();
        let hash = content_hash(format!("{name}\n{pictures:?}\n{sketch:?}").as_bytes());
        Ok(Self(Arc::new(Inside { name: name.to_owned(), sketch, hash })))
    }

    /// What it is called.
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// The plant that is drawn.
    pub fn sketch(&self) -> &Sketch {
        &self.0.sketch
    }

    /// Tells it from other drawings, and from the same one under another name.
    pub fn hash(&self) -> u64 {
        self.0.hash
    }
}

impl PartialEq for GardenDrawing {
    // A garden asks it of every stroke, so the strokes of the drawing are looked at only where all else is the same.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
            || (self.0.hash == other.0.hash && self.0.name == other.0.name && self.0.sketch == other.0.sketch)
    }
}

impl fmt::Debug for GardenDrawing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "GardenDrawing({:?}, {:016x})", self.0.name, self.0.hash)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::garden::{for_garden, named};
    use crate::sketch::{
        GardenPlant, GardenPoint, GardenStroke, GardenStrokes, GardenTool, Stroke, StrokePoint, Tool,
    };
    use glam::Vec2;

    fn drawing(name: &str, x: f32) -> GardenDrawing {
        let points = [[0.0, 0.0], [x, 90.0]].map(|p| StrokePoint::at(p.into())).to_vec();
        let stroke = Stroke { id: 1, tool: Tool::Auto, points, brush: None };
        let garden: GardenStrokes = [bed(GardenPlant::Drawn)].into();
        GardenDrawing::new(name, Sketch { strokes: vec![Arc::new(stroke)], garden, ..Sketch::empty() })
            .unwrap()
    }

    fn bed(plant: GardenPlant) -> Arc<GardenStroke> {
        let points = vec![GardenPoint { at: Vec2::ZERO, pressure: 0.5 }];
        Arc::new(GardenStroke { tool: GardenTool::Plants(plant), radius: 0.5, density: 1.0, points })
    }

    #[test]
    fn a_drawing_is_known_by_what_is_drawn_and_brings_no_garden_along() {
        let pine = drawing("pine", 3.0);
        assert!(
            pine == drawing(" pine ", 3.0) && pine != drawing("pine", 4.0) && pine != drawing("fir", 3.0)
        );
        assert!(pine.sketch().garden.is_empty() && pine.hash() == drawing("pine", 3.0).hash());
        assert!(GardenDrawing::new(" ", Sketch::empty()).is_err());
        let long = GardenDrawing::new(&"ä".repeat(500), Sketch::empty()).unwrap();
        assert!(long.name().len() <= limits::MAX_SPECIES_NAME_BYTES);
        let own = Sketch { species: Some("/home/ann/weed.toml".into()), ..Sketch::empty() };
        assert_eq!(GardenDrawing::new("weed", own).unwrap().sketch().species, None);
    }

    #[test]
    fn each_drawing_of_a_garden_has_a_name_of_its_own() {
        let (pine, other) = (drawing("pine", 3.0), drawing("pine", 4.0));
        let mut beds = [&pine, &pine].map(|drawing| bed(GardenPlant::Drawing(drawing.clone()))).to_vec();
        assert_eq!(for_garden(&beds, "pine", pine.sketch()), Ok(pine.clone()));
        let renamed = for_garden(&beds, "pine", other.sketch()).unwrap();
        assert_eq!(renamed.name(), "pine 2");
        beds.push(bed(GardenPlant::Drawing(renamed)));
        assert!(named(&beds).unwrap().into_keys().eq(["pine", "pine 2"]));
        beds.push(bed(GardenPlant::Drawing(other)));
        assert_eq!(named(&beds), Err("pine"));
        let long = "ä".repeat(500);
        let beds = [bed(GardenPlant::Drawing(drawing(&long, 3.0)))];
        let apart = for_garden(&beds, &long, drawing("pine", 4.0).sketch()).unwrap();
        assert!(apart.name().ends_with(" 2"), "{}", apart.name());
    }
}
