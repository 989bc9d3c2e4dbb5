//! Blade or branch? A support vector machine on three features (002 §4.1).
//!
//! A blade (petal or leaf) is drawn as its outline, a branch as its skeleton. The machine was trained on synthetic
//! strokes by `examples/train_classifier`; `docs/classifier.md` says how well it does on them and on people's drawings, and
//! what it gets wrong. Petals and leaves are told apart later, by where they stand.
//!
//! Departures from the paper: the verdict carries a calibrated confidence, and the features are scale-free (see
//! [`super::features`]).
//!
//! Limit: one stroke is seen on its own. The centre of a flower or the outline of a crown is a blade by its shape, one
//! side of a leaf is a branch; the artist's explicit tools are for those.

use super::features::stroke_features;
use super::svm::{ModelError, Svm};
use glam::Vec2;

/// What the classifier says of one stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Petal or leaf; otherwise branch.
    pub blade: bool,
    /// Probability that the verdict is right, 0.5 to 1.
    pub confidence: f32,
}

/// Tells blades from branches.
#[derive(Clone, Debug, PartialEq)]
pub struct Classifier {
    svm: Svm,
}

/// Read by the compiler: a model file that is broken or too large does not build.
static BUILT_IN: Classifier =
    match Classifier::parse(include_str!("../../assets/classifier/blade_or_branch.txt")) {
        Ok(classifier) => classifier,
        Err(_) => panic!("assets/classifier/blade_or_branch.txt is not a usable model"),
    };

impl Classifier {
    /// The classifier that ships with the program.
    pub fn built_in() -> &'static Self {
        &BUILT_IN
    }

    /// Reads a model written by the trainer.
    ///
    /// # Errors
    /// The first line that does not hold what it should.
    pub const fn parse(text: &str) -> Result<Self, ModelError> {
        match Svm::parse(text) {
            Ok(svm) => Ok(Self { svm }),
            Err(error) => Err(error),
        }
    }

    /// The machine behind the verdicts.
    pub fn svm(&self) -> &Svm {
        &self.svm
    }

    /// Judges the polyline through `points` (canvas pixels). A stroke without length is a branch.
    pub fn classify(&self, points: &[Vec2]) -> Verdict {
        let blade = self.svm.probability(stroke_features(points).as_array());
        Verdict { blade: blade >= 0.5, confidence: blade.max(1.0 - blade) }
    }
}
