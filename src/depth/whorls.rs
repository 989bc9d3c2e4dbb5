//! The whorls of a drawn flower: which of its petals stand in one ring (003, layers; 000 §4.1 for one cone).
//!
//! Whorls have the apex and the axis in common; each has its opening and its length. Seen along an axis with projection t,
//! `s² = 1 − |t|²`, the tips q of a whorl of height h and radius R, counted from the apex, obey
//!
//! ```text
//! |q|² + (t·q)²/s²  =  h · 2 (t·q)/s²  +  R² − h² |t|²/s²
//! ```
//!
//! so that whorls are straight lines in the plane of `2 (t·q)/s²` and the left side. For axes on a grid, and for 2 to
//! [`MOST`] lines, tips are sorted to the lines in turn with fitting these. The likeliest is taken: least squares, a price for
//! each whorl, and a price for petals that do not turn alike from one to the next, as those of a whorl do.
//!
//! One whorl stays one unless the lines are far apart beside how far tips lie off them: petals of which some are longer
//! are no two whorls.
//!
//! Limits: whorls of fewer than [`FEWEST`] petals are not seen, nor such whose tips project onto each other all around.

use super::cone_fit::{ConeFit, Rim};
use glam::DVec2;
use std::f64::consts::TAU;

/// Most whorls of a flower.
pub(super) const MOST: usize = 6;
/// Fewest petals of a whorl.
const FEWEST: usize = 3;
/// Directions of axes on the grid, and their angles from the drawing, degrees.
const DIRECTIONS: usize = 16;
const RISES: [f64; 6] = [80.0, 68.0, 56.0, 44.0, 33.0, 24.0];
/// Steepness, height by radius, of the cones with which sorting starts.
const STEEPNESS: [f64; 3] = [0.2, 0.7, 1.5];
/// The likely one, and how little a line knows of its own: in units of a tip's weight.
const LIKELY: (f64, f64) = (0.6, 0.02);
/// Rounds of sorting and fitting.
const ROUNDS: u32 = 4;
/// Distance of tips from their whorl that a pen's shaking alone makes, in units of the petals' length.
const SHAKING: f64 = 0.03;
/// Price of each whorl for each of its two unknowns, and of a petal whose turn says nothing.
const PRICES: (f64, f64) = (8.0, 5.0);
/// Least distance of neighbouring whorls, in units of the petals' length, and of how far tips lie off them.
const APART: (f64, f64) = (0.16, 3.0);
/// How far petals stand from where a whorl of equal turns has them, in units of the turn, and most that this counts.
const TURN: (f64, f64) = (0.12, 3.0);
/// Largest turn without petals in a whorl, radians: others are fans, as flowers seen from the side are.
const FAN: f64 = 3.4;
/// Most petals that may be hidden between those of a whorl.
const HIDDEN: usize = 3;

/// Petals sorted to whorls.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sorted {
    /// Number of each petal's whorl.
    pub(super) of: Vec<usize>,
    /// The whorls' cones, whose axis is one.
    pub(super) cones: Vec<ConeFit>,
}

impl Sorted {
    /// The same with the widest open whorl first.
    pub(super) fn outermost_first(self) -> Self {
        let mut order: Vec<usize> = (0..self.cones.len()).collect();
        order.sort_by(|a, b| self.cones[*b].opening.total_cmp(&self.cones[*a].opening));
        let rank = |whorl: &usize| order.iter().position(|w| w == whorl).unwrap_or(0);
        Self {
            of: self.of.iter().map(rank).collect(),
            cones: order.iter().map(|whorl| self.cones[*whorl]).collect(),
        }
    }
}

/// The ways in which petals with these tips, counted from the apex in units of the petals' mean length, may be several whorls:
/// for each number of whorls the likeliest. `single` is the cone that fits all of them best. None if they are rather one whorl.
pub(super) fn ways(tips: &[DVec2], single: &ConeFit) -> Vec<Sorted> {
    if tips.len() < 2 * FEWEST {
        return Vec::new();
    }
    let axes: Vec<View> = views(single).collect();
    let of_one = axes.iter().filter_map(|view| Lines::around(view, tips, &vec![0; tips.len()], 1));
    let one = of_one.map(|lines| lines.price).fold(f64::INFINITY, f64::min);
    let likeliest = |count: usize| {
        let tried = axes.iter().flat_map(|view| STEEPNESS.map(|steepness| (view, steepness)));
        let found = tried.filter_map(|(view, steepness)| Lines::sorted(view, tips, count, steepness));
        let less = |a: &Lines, b: &Lines| a.price.total_cmp(&b.price);
        found.filter(|lines| lines.price < one && lines.are_apart(tips)).min_by(less)
    };
    (2..=MOST.min(tips.len() / FEWEST)).filter_map(likeliest).map(Lines::sorted_to_cones).collect()
}

/// Whether petals of every whorl stand all around the axis.
pub(super) fn surround(tips: &[DVec2], Sorted { of, cones }: &Sorted) -> bool {
    cones.iter().enumerate().all(|(whorl, cone)| {
        let own = tips.iter().zip(of).filter(|(_, w)| **w == whorl).map(|(tip, _)| *tip);
        cone.rim().turns(&own.collect::<Vec<_>>()).largest < FAN
    })
}

/// What tips that are sorted to cones cost: the less, the likelier.
pub(super) fn price(tips: &[DVec2], Sorted { of, cones }: &Sorted) -> f64 {
    let rims: Vec<Rim> = cones.iter().map(ConeFit::rim).collect();
    let view = View::new(rims[0].t);
    let square: f64 = tips.iter().zip(of).map(|(tip, whorl)| rims[*whorl].distance(*tip).powi(2)).sum();
    let uneven = (0..cones.len()).map(|whorl| unevenness(&view, tips, of, whorl, rims[whorl].height)).sum();
    price_of(tips.len(), square / tips.len() as f64, uneven, cones.len())
}

/// The price of so many petals, with their mean square distance from their rims, that turn so unevenly.
fn price_of(petals: usize, spread: f64, uneven: f64, whorls: usize) -> f64 {
    let ((each, turn), petals) = (PRICES, petals as f64);
    petals * (spread + SHAKING * SHAKING).ln() + each * petals.ln() * whorls as f64 + turn * uneven
}

/// An axis as the drawing sees it.
#[derive(Clone, Copy, Debug)]
struct View {
    /// Projection of the unit axis.
    t: DVec2,
    /// Square of the sine of its angle from the drawing.
    sin2: f64,
}

impl View {
    fn new(t: DVec2) -> Self {
        Self { t, sin2: (1.0 - t.length_squared()).max(1e-3) }
    }

    /// Where a tip lies in the plane in which whorls are lines.
    fn place(&self, q: DVec2) -> DVec2 {
        let along = self.t.dot(q) / self.sin2;
        DVec2::new(2.0 * along, q.length_squared() + along * along * self.sin2)
    }

    /// Azimuth of a tip about the axis, for a rim of this height.
    fn azimuth(&self, q: DVec2, height: f64) -> f64 {
        let minor = self.t.try_normalize().unwrap_or(DVec2::Y);
        let d = q - height * self.t;
        d.perp_dot(minor).atan2(d.dot(minor) / self.sin2.sqrt())
    }
}

fn views(single: &ConeFit) -> impl Iterator<Item = View> {
    let on_grid = RISES.into_iter().flat_map(|rise| {
        let at = move |k: usize| DVec2::from_angle(TAU * k as f64 / DIRECTIONS as f64);
        (0..DIRECTIONS).map(move |k| View::new(at(k) * rise.to_radians().cos()))
    });
    [View::new(single.axis().truncate()), View::new(DVec2::ZERO)].into_iter().chain(on_grid)
}

/// One whorl as a line.
#[derive(Clone, Copy, Debug)]
struct Line {
    height: f64,
    radius: f64,
    /// Where it begins.
    offset: f64,
}

impl Line {
    /// The line through places that knows a little of how steep it is; nothing if it is no cone.
    fn through(view: &View, places: &[DVec2]) -> Option<Self> {
        let count = places.len() as f64;
        let mean = places.iter().sum::<DVec2>() / count;
        let likely = LIKELY.0 * mean.y.max(0.0).sqrt();
        let (mut both, mut spread) = (0.0, 0.0);
        for d in places.iter().map(|place| *place - mean) {
            both += d.x * d.y;
            spread += d.x * d.x;
        }
        let little = LIKELY.1 * count;
        let height = ((both + little * likely) / (spread + little)).max(0.0);
        let offset = mean.y - height * mean.x;
        let radius2 = offset + height * height * view.t.length_squared() / view.sin2;
        (radius2 > 0.0).then(|| Self { height, radius: radius2.sqrt(), offset })
    }

    /// Distance of a tip, by its place, to first order.
    fn off(&self, place: DVec2) -> f64 {
        (place.y - self.height * place.x - self.offset) / (2.0 * self.radius)
    }
}

/// Tips sorted to lines.
#[derive(Clone, Debug)]
struct Lines {
    view: View,
    of: Vec<usize>,
    lines: Vec<Line>,
    /// Mean square distance of tips from their lines.
    spread: f64,
    price: f64,
}

impl Lines {
    /// Sorts tips to so many lines, at first by gaps between cones of one steepness.
    fn sorted(view: &View, tips: &[DVec2], count: usize, steepness: f64) -> Option<Self> {
        let places: Vec<DVec2> = tips.iter().map(|q| view.place(*q)).collect();
        let radius = |place: &DVec2| (place.y - steepness * place.x).max(0.0).sqrt();
        let mut order: Vec<usize> = (0..tips.len()).collect();
        let radii: Vec<f64> = places.iter().map(radius).collect();
        order.sort_by(|a, b| radii[*a].total_cmp(&radii[*b]));
        let cuts = widest_gaps(&order.iter().map(|i| radii[*i]).collect::<Vec<_>>(), count)?;
        let mut of = vec![0; tips.len()];
        for (rank, tip) in order.into_iter().enumerate() {
            of[tip] = cuts.partition_point(|cut| *cut <= rank);
        }
        for _ in 0..ROUNDS {
            let lines = fitted(view, &places, &of, count)?;
            let nearest = |place: &DVec2| {
                let off = |line: &Line| line.off(*place).abs();
                (0..count).fold(0, |a, b| if off(&lines[b]) < off(&lines[a]) { b } else { a })
            };
            let again: Vec<usize> = places.iter().map(nearest).collect();
            if again == of {
                break;
            }
            of = again;
        }
        Self::around(view, tips, &of, count)
    }

    /// The lines of tips that are sorted already, and their price.
    fn around(view: &View, tips: &[DVec2], of: &[usize], count: usize) -> Option<Self> {
        let places: Vec<DVec2> = tips.iter().map(|q| view.place(*q)).collect();
        let lines = fitted(view, &places, of, count)?;
        let square = |(place, whorl): (&DVec2, &usize)| lines[*whorl].off(*place).powi(2);
        let spread = places.iter().zip(of).map(square).sum::<f64>() / tips.len() as f64;
        let uneven: f64 =
            (0..count).map(|whorl| unevenness(view, tips, of, whorl, lines[whorl].height)).sum();
        let price = price_of(tips.len(), spread, uneven, count);
        Some(Self { view: *view, of: of.to_vec(), lines, spread, price })
    }

    /// Whether the tips of each whorl lie far from every other beside how far they lie off their own.
    fn are_apart(&self, tips: &[DVec2]) -> bool {
        let least = APART.0.max(APART.1 * self.spread.sqrt());
        let places: Vec<DVec2> = tips.iter().map(|q| self.view.place(*q)).collect();
        let off = |whorl: usize, other: &Line| {
            let own = places.iter().zip(&self.of).filter(|(_, w)| **w == whorl);
            let (sum, count) =
                own.fold((0.0, 0.0), |(s, n), (place, _)| (s + other.off(*place).abs(), n + 1.0));
            sum / count
        };
        let others = |whorl: usize| self.lines.iter().enumerate().filter(move |(other, _)| *other != whorl);
        (0..self.lines.len()).all(|whorl| others(whorl).all(|(_, other)| off(whorl, other) > least))
    }

    fn sorted_to_cones(self) -> Sorted {
        let cone = |line: &Line| ConeFit::from_rim(self.view.t * line.height, line.radius, self.view.t);
        Sorted { cones: self.lines.iter().map(cone).collect(), of: self.of }
    }
}

/// Where a sorted list falls apart into so many pieces of at least [`FEWEST`], at its widest gaps.
fn widest_gaps(sorted: &[f64], pieces: usize) -> Option<Vec<usize>> {
    let mut gaps: Vec<usize> = (FEWEST..=sorted.len().checked_sub(FEWEST)?).collect();
    gaps.sort_by(|a, b| (sorted[*b] - sorted[*b - 1]).total_cmp(&(sorted[*a] - sorted[*a - 1])));
    let mut cuts: Vec<usize> = Vec::new();
    for gap in gaps {
        if cuts.len() + 1 < pieces && cuts.iter().all(|cut| cut.abs_diff(gap) >= FEWEST) {
            cuts.push(gap);
        }
    }
    cuts.sort_unstable();
    (cuts.len() + 1 == pieces).then_some(cuts)
}

/// The lines of tips that are sorted; nothing if one has too few.
fn fitted(view: &View, places: &[DVec2], of: &[usize], count: usize) -> Option<Vec<Line>> {
    let line = |whorl: usize| {
        let own: Vec<DVec2> =
            places.iter().zip(of).filter(|(_, w)| **w == whorl).map(|(place, _)| *place).collect();
        if own.len() < FEWEST { None } else { Line::through(view, &own) }
    };
    (0..count).map(line).collect()
}

/// Sorts tips anew to cones that fit better by now: by their distance from the rim, and where rims cross in the drawing by
/// where petals that turn alike would stand.
pub(super) fn resorted(tips: &[DVec2], sorted: Sorted) -> Sorted {
    let Sorted { of, cones } = &sorted;
    let rims: Vec<Rim> = cones.iter().map(ConeFit::rim).collect();
    let view = View::new(rims[0].t);
    let own = |whorl: usize| tips.iter().zip(of).filter(move |(_, w)| **w == whorl).map(|(tip, _)| *tip);
    let square: f64 = tips.iter().zip(of).map(|(tip, whorl)| rims[*whorl].distance(*tip).powi(2)).sum();
    let shaking = (square / tips.len() as f64).sqrt() + SHAKING;
    let rings: Vec<Equal> = (0..cones.len())
        .map(|whorl| Equal::of(own(whorl).map(|tip| view.azimuth(tip, rims[whorl].height)).collect()))
        .collect();
    let cost = |tip: DVec2, whorl: usize| {
        let turn = rings[whorl].off(view.azimuth(tip, rims[whorl].height)) / TURN.0;
        (rims[whorl].distance(tip) / shaking).powi(2) + turn.min(TURN.1).powi(2)
    };
    let nearest =
        |tip: &DVec2| (0..cones.len()).fold(0, |a, b| if cost(*tip, b) < cost(*tip, a) { b } else { a });
    let again: Vec<usize> = tips.iter().map(nearest).collect();
    let has_enough = |whorl: usize| again.iter().filter(|of| **of == whorl).count() >= FEWEST;
    if !(0..cones.len()).all(has_enough) {
        return sorted;
    }
    Sorted { of: again, ..sorted }
}

/// Equal turns about an axis that come nearest to the azimuths of a whorl, of which some may be hidden and one too many.
#[derive(Clone, Copy, Debug)]
struct Equal {
    turns: usize,
    /// Phase of the places, in turns' own angle.
    phase: f64,
    /// 1 where all azimuths are at such places, 0 where they are anywhere.
    coherence: f64,
}

impl Equal {
    fn of(azimuths: Vec<f64>) -> Self {
        let count = azimuths.len();
        let among = |turns: usize| {
            let sum: DVec2 = azimuths.iter().map(|a| DVec2::from_angle(turns as f64 * a)).sum();
            Self { turns, phase: sum.y.atan2(sum.x), coherence: sum.length() / count.max(1) as f64 }
        };
        let better = |a: Self, b: Self| if b.coherence > a.coherence { b } else { a };
        (count.max(FEWEST + 1) - 1..=count + HIDDEN).map(among).fold(among(count.max(1)), better)
    }

    /// How far an azimuth is from the nearest such place, in turns: at most a half.
    fn off(&self, azimuth: f64) -> f64 {
        let off = (self.turns as f64 * azimuth - self.phase) / TAU;
        (off - off.round()).abs()
    }
}

/// How many petals of a whorl turn as if the others were not there: none where all turn alike, with some hidden.
fn unevenness(view: &View, tips: &[DVec2], of: &[usize], whorl: usize, height: f64) -> f64 {
    let own = tips.iter().zip(of).filter(|(_, w)| **w == whorl);
    let azimuths: Vec<f64> = own.map(|(q, _)| view.azimuth(*q, height)).collect();
    let count = azimuths.len() as f64;
    count * (1.0 - Equal::of(azimuths).coherence)
}
