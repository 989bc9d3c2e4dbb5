//! The forms of blades: the right-hand margin of a petal or leaf from root to tip, in units of its length.
//!
//! A point is (along, across): `along` runs from 0 at the root to about 1 at the tip, `across` away from the midrib. A
//! margin is made of smooth runs that meet in corners. The left side is the mirror image, each side with its own small
//! irregularities, because no blade is symmetric.

use super::hand::Hand;
use super::spline;
use glam::DVec2;

/// What the margin does on top of its form.
#[derive(Clone, Copy)]
pub enum Margin {
    /// Smooth.
    Entire,
    /// Teeth that point to the tip.
    Serrate(Teeth),
    /// Rounded teeth.
    Crenate(Teeth),
}

/// Teeth along one side.
#[derive(Clone, Copy)]
pub struct Teeth {
    /// How many would stand on the whole side.
    pub count: u32,
    /// Height in lengths of the blade.
    pub depth: f64,
    /// Share of the margin, from the root, that stays smooth.
    pub from: f64,
}

/// How the two sides meet at the tip.
#[derive(Clone, Copy, PartialEq)]
pub enum Tip {
    /// One smooth curve.
    Round,
    /// A point or a notch.
    Sharp,
}

/// A kind of blade.
pub struct Form {
    /// Smooth runs of the right-hand side, root to tip; each begins where the one before it ends.
    pub runs: &'static [&'static [(f64, f64)]],
    /// How the sides meet.
    pub tip: Tip,
    /// Teeth.
    pub margin: Margin,
}

impl Form {
    /// One blade of this kind: the closed-ish outline from the root up the right side, round the tip and back down,
    /// densely sampled, `across` scaled by `width`.
    pub fn blade(&self, hand: &mut Hand, width: f64) -> Vec<DVec2> {
        let (right, left) = (self.side(hand, width), self.side(hand, width));
        let mut runs = right;
        let mut back: Vec<Vec<DVec2>> = left.into_iter().rev().map(mirrored).collect();
        let tip = runs.last().and_then(|run| run.last()).copied().unwrap_or(DVec2::X);
        if let Some(first) = back.first_mut() {
            first[0] = tip;
        }
        if self.tip == Tip::Round
            && let (Some(up), false) = (runs.last_mut(), back.is_empty())
        {
            up.extend(back.remove(0).into_iter().skip(1));
        }
        runs.extend(back);
        let outline: Vec<DVec2> = runs.iter().flat_map(|run| spline::through(run)).collect();
        self.toothed(&spline::even(&outline, 0.004), tip)
    }

    /// The right side with the irregularities of one individual.
    fn side(&self, hand: &mut Hand, width: f64) -> Vec<Vec<DVec2>> {
        let breadth = width * (1.0 + hand.vary(0.07));
        let mut runs: Vec<Vec<DVec2>> = Vec::new();
        for run in self.runs {
            let mut points: Vec<DVec2> = run
                .iter()
                .map(|&(along, across)| {
                    let loose = across.abs().min(0.2);
                    DVec2::new(along + hand.vary(0.06 * loose), across * breadth + hand.vary(0.07 * loose))
                })
                .collect();
            if let Some(corner) = runs.last().and_then(|r| r.last()) {
                points[0] = *corner;
            }
            runs.push(points);
        }
        runs
    }

    fn toothed(&self, outline: &[DVec2], tip: DVec2) -> Vec<DVec2> {
        let (teeth, tooth): (Teeth, fn(f64) -> f64) = match self.margin {
            Margin::Entire => return outline.to_vec(),
            Margin::Serrate(teeth) => (teeth, |x| if x < 0.78 { x / 0.78 } else { (1.0 - x) / 0.22 }),
            Margin::Crenate(teeth) => (teeth, |x| (std::f64::consts::PI * x).sin().sqrt()),
        };
        let nearest = |a: &usize, b: &usize| outline[*a].distance(tip).total_cmp(&outline[*b].distance(tip));
        let middle = (0..outline.len()).min_by(nearest).unwrap_or(0);
        let last = outline.len() - 1;
        let share = |i: usize| {
            let side = if i <= middle { (i, middle) } else { (last - i, last - middle) };
            side.0 as f64 / side.1.max(1) as f64
        };
        let lifted = |i: usize| {
            let (x, along) = (share(i), outline[(i + 1).min(last)] - outline[i.saturating_sub(1)]);
            let fade = smooth(x, teeth.from, teeth.from + 0.12) * (1.0 - smooth(x, 0.94, 1.0));
            let outward = -along.perp().normalize_or_zero();
            outline[i] + outward * teeth.depth * fade * (tooth((x * f64::from(teeth.count)).fract()) - 0.4)
        };
        (0..outline.len()).map(lifted).collect()
    }
}

fn mirrored(run: Vec<DVec2>) -> Vec<DVec2> {
    run.into_iter().rev().map(|p| DVec2::new(p.x, -p.y)).collect()
}

/// 0 below `from`, 1 above `to`, smooth between.
fn smooth(x: f64, from: f64, to: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
