//! What the artist says of how strokes are read together: it holds, it leaves the rest alone, and it is kept.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::people::{Share, drawings};
use penstemon::anatomy::conventions::alternatives::alternatives;
use penstemon::anatomy::conventions::{self, ConventionParams, Interpretation, Memory, ReadStrokes};
use penstemon::anatomy::{self, AnatomyParams, Part};
use penstemon::sketch::corrections::{corrected, shares_most};
use penstemon::sketch::{Correction, Reading, Sketch, StrokeId, Verdict, from_bytes, json};
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::sync::{Arc, LazyLock};

/// The drawings by people that may be looked at.
static DRAWINGS: LazyLock<Vec<Sketch>> = LazyLock::new(|| {
    let known = [Share::Development, Share::Opened, Share::Added];
    known.iter().flat_map(|share| drawings(*share).unwrap()).map(|drawing| drawing.sketch).collect()
});

fn read_with(memory: &mut Memory, sketch: &Sketch) -> Arc<Interpretation> {
    conventions::interpret_with(memory, &sketch.strokes, &sketch.corrections, &ConventionParams::default())
}

fn read(sketch: &Sketch) -> Arc<Interpretation> {
    read_with(&mut Memory::for_one_build(), sketch)
}

/// The drawing with one more correction.
fn with(sketch: &Sketch, strokes: &[StrokeId], verdict: Verdict) -> Sketch {
    let correction = Correction::new(strokes.iter().copied(), verdict);
    let corrections = corrected(&sketch.corrections, correction, sketch.strokes.iter().map(|s| s.id));
    Sketch { corrections, ..sketch.clone() }
}

/// Whether a reading is about these strokes.
fn is_about(read: &ReadStrokes, strokes: &[StrokeId]) -> bool {
    let shared = read.strokes.iter().filter(|stroke| strokes.contains(stroke)).count();
    shares_most(shared, read.strokes.len(), strokes.len())
}

#[test]
fn a_reading_that_is_refused_is_gone_and_the_rest_stays() {
    let mut seen = BTreeSet::new();
    for sketch in DRAWINGS.iter() {
        let before = read(sketch);
        for refused in &before.readings {
            seen.insert(refused.reading);
            let after = read(&with(sketch, &refused.strokes, Verdict::Not(refused.reading)));
            let still = |r: &&ReadStrokes| r.reading == refused.reading && is_about(r, &refused.strokes);
            assert_eq!(after.readings.iter().find(still), None);
            // What was set free may join others, which are then read with it; what stood on it or beside it is looked at anew.
            let joined = |r: &ReadStrokes| r.strokes.iter().any(|stroke| refused.strokes.contains(stroke));
            let is_beneath = matches!(refused.reading, Reading::Pot | Reading::Ground | Reading::Frame);
            if after.readings.iter().any(joined) || is_beneath {
                continue;
            }
            let others = before.readings.iter().filter(|other| *other != refused);
            assert!(others.clone().all(|other| after.readings.contains(other)), "{before:?}\n{after:?}");
            assert_eq!(after.readings.len(), others.count());
        }
    }
    assert!(seen.len() > 7, "{seen:?}");
}

#[test]
fn strokes_that_are_separate_are_read_one_by_one() {
    for sketch in DRAWINGS.iter() {
        for apart in &read(sketch).readings {
            let after = read(&with(sketch, &apart.strokes, Verdict::Separate));
            let read = after.readings.iter().flat_map(|r| &r.strokes).chain(after.pieces.keys());
            assert!(read.into_iter().all(|stroke| !apart.strokes.contains(stroke)));
            let drawn = |id| sketch.strokes.iter().find(|s| s.id == id);
            assert!(apart.strokes.iter().all(|id| after.strokes.iter().any(|s| Some(s) == drawn(*id))));
        }
    }
}

/// One of the readings of a drawing, and what is said of it.
fn corrections() -> impl Strategy<Value = Vec<(usize, u8)>> {
    prop::collection::vec((any::<usize>(), 0..4_u8), 1..6)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn corrections_one_after_the_other_lose_nothing_and_are_kept(which in any::<usize>(), said in corrections()) {
        let mut sketch = DRAWINGS[which % DRAWINGS.len()].clone();
        let mut memory = Memory::default();
        for (place, verdict) in said {
            let read = read_with(&mut memory, &sketch);
            let Some(about) = read.readings.get(place % read.readings.len().max(1)) else { break };
            let verdict = match verdict {
                0 | 1 => Verdict::Not(about.reading),
                2 => Verdict::Separate,
                _ => Verdict::As(Reading::ALL[place % Reading::ALL.len()]),
            };
            sketch = with(&sketch, &about.strokes, verdict);
            sketch.check_invariants().unwrap();
            // Live as from scratch; saved and opened again as before.
            let live = read_with(&mut memory, &sketch);
            let (opened, _) = from_bytes(json::write(&sketch).as_bytes(), "drawing").unwrap();
            prop_assert_eq!(&opened, &sketch);
            prop_assert_eq!(&live, &self::read(&opened));
            if let Verdict::As(reading) = verdict {
                let other = |r: &&ReadStrokes| r.reading != reading && is_about(r, &about.strokes);
                prop_assert_eq!(live.readings.iter().find(other), None);
            }
        }
        let anatomy = anatomy::analyse(&sketch, &AnatomyParams::default());
        let remarked: BTreeSet<u64> = anatomy.warnings.iter().filter_map(|warning| warning.stroke).collect();
        let with_others = |stroke: u64| anatomy.readings.iter().any(|read| read.strokes.contains(&stroke));
        for mark in anatomy.marks.iter().filter(|mark| mark.part == Part::Ignored) {
            prop_assert!(remarked.contains(&mark.stroke) || with_others(mark.stroke), "{} is lost", mark.stroke);
        }
    }

    #[test]
    fn corrections_of_any_strokes_do_no_harm(
        which in any::<usize>(),
        said in prop::collection::vec((prop::collection::vec(0..70_u64, 1..9), any::<usize>(), 0..3_u8), 0..9),
    ) {
        let mut sketch = DRAWINGS[which % DRAWINGS.len()].clone();
        let correction = |(strokes, reading, verdict): (Vec<u64>, usize, u8)| {
            let reading = Reading::ALL[reading % Reading::ALL.len()];
            let verdict = [Verdict::Not(reading), Verdict::As(reading), Verdict::Separate][usize::from(verdict)];
            Correction::new(strokes, verdict)
        };
        sketch.corrections = said.into_iter().map(correction).collect();
        let read = read(&sketch);
        let mut used: Vec<StrokeId> = read.readings.iter().flat_map(|r| r.strokes.clone()).collect();
        used.sort_unstable();
        prop_assert!(used.windows(2).all(|pair| pair[0] != pair[1]));
        let kept = sketch.strokes.iter().filter(|s| read.strokes.contains(s)).count();
        prop_assert_eq!(kept + used.len(), sketch.strokes.len());
    }
}

#[test]
fn whatever_is_offered_can_be_chosen() {
    let mut others = 0;
    for sketch in DRAWINGS.iter().step_by(3) {
        let before = read(sketch);
        for about in &before.readings {
            let offered = alternatives(sketch, &ConventionParams::default(), &about.strokes);
            assert_eq!(offered.last().unwrap().verdict, Verdict::Separate);
            assert!(offered.iter().any(|offer| offer.verdict == Verdict::As(about.reading)), "{about:?}");
            others += offered.len() - 2;
            for offer in offered {
                let chosen = with(sketch, &offer.strokes, offer.verdict);
                let after = read(&chosen);
                let is_it =
                    |r: &ReadStrokes| Verdict::As(r.reading) == offer.verdict && r.strokes == offer.strokes;
                assert!(offer.verdict == Verdict::Separate || after.readings.iter().any(is_it), "{offer:?}");
                // Whatever was chosen, the same is offered again.
                let again = alternatives(&chosen, &ConventionParams::default(), &offer.strokes);
                assert!(again.len() > 1 || offer.strokes != about.strokes, "{offer:?}");
            }
        }
    }
    assert!(others > 7, "{others}");
}
