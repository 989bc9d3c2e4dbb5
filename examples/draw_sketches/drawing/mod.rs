//! The reference drawings, drawn by rule: a hand, forms of blades, and one file per plant.
//!
//! | module | purpose |
//! | --- | --- |
//! | [`spline`] | smooth lines through chosen points |
//! | [`sheet`] | a finished drawing and its file |
//! | [`hand`] | wobble, pressure, sampling |
//! | [`form`], [`forms`] | what petals and leaves look like |
//! | [`leaf`], [`flower`] | blades placed on the sheet, flowers in perspective |
//! | [`plants`] | the drawings |
//!
//! The sheets hold what an artist would draw for the program: whole outlines of petals, also where others hide them,
//! and no hatching or hearts, which the program adds.

#![allow(unreachable_pub, reason = "shared by an example and a test, which export nothing")]

pub mod flower;
pub mod form;
pub mod forms;
pub mod hand;
pub mod leaf;
pub mod plants;
pub mod sheet;
pub mod spline;

use sheet::Sheet;

/// A drawing and where it belongs.
pub struct Drawing {
    /// File name without extension.
    pub name: &'static str,
    /// Folder from the root of the repository.
    pub folder: &'static str,
    /// What is on it.
    pub sheet: Sheet,
}

impl Drawing {
    /// Name of the sketch file.
    pub fn file_name(&self) -> String {
        format!("{}.penstemon", self.name)
    }
}

const ASSETS: &str = "assets/sketches";
const FIXTURES: &str = "tests/fixtures/sketches";

/// Every drawing, in the order of the documentation.
pub fn all() -> Vec<Drawing> {
    let asset = |name, sheet| Drawing { name, folder: ASSETS, sheet };
    let trial = |name, sheet| Drawing { name, folder: FIXTURES, sheet };
    vec![
        asset("daisy", plants::daisy::draw()),
        asset("hepatica_red", plants::hepatica::red()),
        asset("hepatica_blue", plants::hepatica::blue()),
        asset("jasmine", plants::jasmine::draw()),
        asset("mallow", plants::mallow::draw()),
        asset("balloon_flower", plants::balloon_flower::draw()),
        asset("plumeria", plants::plumeria::draw()),
        asset("oxalis", plants::oxalis::draw()),
        asset("potted_plant", plants::potted_plant::draw()),
        asset("tree_round", plants::tree_round::draw()),
        asset("tree_willow", plants::tree_willow::draw()),
        asset("bamboo", plants::bamboo::draw()),
        asset("bouquet", plants::bouquet::draw()),
        asset("sample", plants::sample::draw()),
        asset("topiary", plants::topiary::draw()),
        asset("garden", plants::garden::draw()),
        asset("freehand_tree", plants::freehand::trees::broadleaf()),
        asset("freehand_apple_tree", plants::freehand::trees::one_stroke()),
        asset("freehand_fir", plants::freehand::trees::fir()),
        asset("freehand_palm", plants::freehand::trees::palm()),
        asset("freehand_bush", plants::freehand::trees::bush()),
        asset("freehand_flower", plants::freehand::herbs::flower()),
        asset("freehand_tulip", plants::freehand::herbs::tulip()),
        asset("freehand_grass", plants::freehand::herbs::grass()),
        asset("freehand_leaf", plants::freehand::herbs::big_leaf()),
        asset("freehand_mushroom", plants::freehand::herbs::mushroom()),
        asset("freehand_house_plant", plants::freehand::pots::house_plant()),
        asset("freehand_cactus", plants::freehand::pots::cactus()),
        trial("two_plants", plants::trials::two_plants()),
        trial("crossing_branches", plants::trials::crossing_branches()),
        trial("many_scales", plants::trials::many_scales()),
    ]
}
