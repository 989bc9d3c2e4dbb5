//! Figures for `docs/classifier.md`: confusion on strokes the model has not seen.

use crate::confusion::Confusion;
use crate::real_strokes::{self, RealStroke};
use crate::synthetic::{self, HELD_OUT_SEED, LabelledStroke};
use penstemon::anatomy::classify::Classifier;
use penstemon::anatomy::features::stroke_features;
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::time::{Duration, Instant};

const PER_CLASS: usize = 1430;

/// Prints every figure on standard output.
pub(crate) fn evaluate() -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "support vectors: {}\n", Classifier::built_in().svm().vector_count())?;
    let strokes = synthetic::strokes(PER_CLASS, HELD_OUT_SEED);
    time(&mut out, &strokes)?;
    synthetic_strokes(&mut out, &strokes)?;
    let strokes = real_strokes::load()?;
    for half in ["development", "held_out"] {
        real_half(&mut out, half, strokes.iter().filter(|s| s.half == half))?;
    }
    Ok(())
}

fn time(out: &mut impl Write, strokes: &[LabelledStroke]) -> io::Result<()> {
    let begin = Instant::now();
    let features: Vec<_> = strokes.iter().map(|s| stroke_features(&s.points).as_array()).collect();
    let measured = begin.elapsed();
    let blades = features.iter().filter(|&&f| Classifier::built_in().svm().probability(f) >= 0.5).count();
    let judged = begin.elapsed() - measured;
    let each = |time: Duration| time.as_nanos() / strokes.len() as u128;
    writeln!(out, "features {} ns a stroke, verdict {} ns ({blades} blades)\n", each(measured), each(judged))
}

fn synthetic_strokes(out: &mut impl Write, strokes: &[LabelledStroke]) -> io::Result<()> {
    let mut all = Confusion::default();
    let mut families: BTreeMap<&str, Confusion> = BTreeMap::new();
    for stroke in strokes {
        let verdict = Classifier::built_in().classify(&stroke.points);
        all.add(stroke.blade, verdict.blade);
        families.entry(stroke.family).or_default().add(stroke.blade, verdict.blade);
    }
    writeln!(out, "synthetic strokes, seed {HELD_OUT_SEED}\n{all}")?;
    for (family, confusion) in families {
        writeln!(
            out,
            "{family:<24} wrong {:>3} of {}",
            confusion.wrong(),
            confusion.right() + confusion.wrong()
        )?;
    }
    Ok(())
}

fn real_half<'a>(
    out: &mut impl Write,
    half: &str,
    strokes: impl Iterator<Item = &'a RealStroke>,
) -> io::Result<()> {
    let mut all = Confusion::default();
    let mut kinds: BTreeMap<(&str, &str), [usize; 2]> = BTreeMap::new();
    let mut wrong = Vec::new();
    for stroke in strokes {
        let verdict = Classifier::built_in().classify(&stroke.points);
        kinds.entry((&stroke.label, &stroke.kind)).or_default()[usize::from(!verdict.blade)] += 1;
        if stroke.label != "neither" {
            let is_blade = stroke.label == "blade";
            all.add(is_blade, verdict.blade);
            if is_blade != verdict.blade {
                wrong.push(format!("{} {} {:.2}", stroke.name, stroke.kind, verdict.confidence));
            }
        }
    }
    writeln!(out, "\npeople's strokes, {half} half\n{all}")?;
    for ((label, kind), [blade, branch]) in kinds {
        writeln!(out, "{label:<8} {kind:<14} taken for blade {blade:>3}, for branch {branch:>3}")?;
    }
    writeln!(out, "wrong: {}", wrong.join("; "))
}
