//! A session of an artist that can be played again, step by step.

use glam::Vec2;
use penstemon::sketch::document::Document;
use penstemon::sketch::garden::for_garden;
use penstemon::sketch::{
    Change, GardenPlant, GardenPoint, GardenStroke, GardenTool, Picture, Reference, Sketch, Step, Stroke,
    StrokeChange, TextureChoice, Textures,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::{Map, Value};
use std::path::Path;
use std::sync::Arc;

const PICTURE: &[u8] = include_bytes!("../fixtures/reference/small.jpg");

/// A session of an artist: real strokes, and now and then undo, redo, a slider, erasing, moving, a reference
/// picture, pictures as textures, a bed of the garden.
pub(crate) struct Artist {
    pub(crate) document: Document,
    strokes: Vec<Arc<Stroke>>,
    pub(crate) rng: Pcg64Mcg,
}

impl Artist {
    pub(crate) fn new(seed: u64) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches/daisy.penstemon");
        let strokes = penstemon::sketch::read(&path).unwrap().0.strokes;
        Self { document: Document::empty(), strokes, rng: Pcg64Mcg::seed_from_u64(seed) }
    }

    /// Does one thing that changes the drawing.
    pub(crate) fn act(&mut self) -> Arc<Step> {
        loop {
            if let Some(step) = self.try_act() {
                return step;
            }
        }
    }

    fn try_act(&mut self) -> Option<Arc<Step>> {
        let drawn = self.document.sketch().strokes.clone();
        match self.rng.random_range(0..20) {
            0 => self.document.undo(),
            1 => self.document.redo(),
            2 => {
                let value = Value::from(self.rng.random_range(0.0..1.0));
                let params = Map::from_iter([("depth.spread".to_owned(), value)]);
                self.document.apply_merging(Change::params(params), "depth.spread").unwrap()
            }
            3 if !drawn.is_empty() => {
                let gone = drawn[self.rng.random_range(0..drawn.len())].id;
                self.document.apply(Change::remove([gone])).unwrap()
            }
            4 if drawn.len() > 1 => {
                let moved = drawn[..2].iter().map(|stroke| {
                    let mut stroke = (**stroke).clone();
                    stroke.points.iter_mut().for_each(|point| point.position.x += 3.5);
                    StrokeChange::Put(stroke.into())
                });
                self.document.apply_merging(Change::strokes(moved.collect()), "move").unwrap()
            }
            5 => {
                let at = self.rng.random_range(0.0..500.0);
                let picture = Picture::new(PICTURE).unwrap();
                self.document
                    .apply(Change::reference(Some(Reference::new(picture, [at, 9.0].into(), 300.0))))
                    .unwrap()
            }
            6 => {
                let number = self.rng.random::<u8>();
                let own = TextureChoice::Own(Picture::new([PICTURE, &[number % 3]].concat()).unwrap());
                let textures = Textures::from([
                    ("leaf".to_owned(), TextureChoice::Named(format!("oak {number}"))),
                    ("petal".to_owned(), own.clone()),
                    ("sepal".to_owned(), own),
                ]);
                self.document.apply(Change::textures(textures)).unwrap()
            }
            7 => {
                let at = Vec2::new(self.rng.random_range(-9.0..9.0), 2.5);
                let drawn = || Sketch { seed: self.document.sketch().seed, ..Sketch::empty() };
                let plant = match at.x {
                    ..-3.0 => GardenPlant::Drawn,
                    ..3.0 => GardenPlant::species("rose"),
                    _ => {
                        let garden = &self.document.sketch().garden;
                        GardenPlant::Drawing(for_garden(garden, "herb", &drawn()).unwrap())
                    }
                };
                let tool = GardenTool::Plants(plant);
                let points = vec![GardenPoint { at, pressure: 0.3 }];
                let bed = Arc::new(GardenStroke { tool, radius: 0.5, density: 1.5, points });
                let garden = self.document.sketch().garden.iter().cloned().chain([bed]).collect();
                self.document.apply(Change::garden(garden)).unwrap()
            }
            _ => {
                let like = self.strokes[self.rng.random_range(0..self.strokes.len())].clone();
                let stroke = Stroke { id: self.document.next_id(), ..(*like).clone() };
                self.document.apply(Change::put(stroke)).unwrap()
            }
        }
    }
}
