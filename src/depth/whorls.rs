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

use super::cone_fit::{ConeFit, Rim, azimuth};
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
/// Root mean square distance of tips from one rim, in units of the petals' length, below which they are one whorl whatever else:
/// whorls as near as they may be lie farther from any rim between them.
const ONE: f64 = 0.04;
/// Most petals that may be hidden between those of a whorl.
pub(super) const HIDDEN: usize = 3;

/// Petals sorted to whorls.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sorted {
    /// Number of each petal's whorl.
    pub(super) of: Vec<usize>,
    /// The whorls' cones, whose axis is one.
    pub(super) cones: Vec<ConeFit>,
}

impl Sorted {
    /// All of so many petals in one whorl.
    pub(super) fn one(petals: usize, cone: ConeFit) -> Self {
        Self { of: vec![0; petals], cones: vec![cone] }
    }

    /// The tips of one whorl.
    pub(super) fn own<'a>(&'a self, tips: &'a [DVec2], whorl: usize) -> impl Iterator<Item = DVec2> + 'a {
        tips.iter().zip(&self.of).filter(move |(_, of)| **of == whorl).map(|(tip, _)| *tip)
    }

    /// The rim of each whorl.
    fn rims(&self) -> Vec<Rim> {
        self.cones.iter().map(ConeFit::rim).collect()
    }

    /// Mean square distance of tips from the rims of their whorls.
    fn spread(&self, tips: &[DVec2], rims: &[Rim]) -> f64 {
        let square = |(tip, whorl): (&DVec2, &usize)| rims[*whorl].distance(*tip).powi(2);
        tips.iter().zip(&self.of).map(square).sum::<f64>() / tips.len() as f64
    }

    /// Azimuths of the petals of one whorl with this rim.
    fn azimuths(&self, tips: &[DVec2], whorl: usize, rim: &Rim) -> Vec<f64> {
        self.own(tips, whorl).map(|tip| rim.azimuth(tip)).collect()
    }

    /// Whether petals of every whorl stand all around the axis.
    pub(super) fn surrounds(&self, tips: &[DVec2]) -> bool {
        let rims = self.rims();
        (0..rims.len()).all(|whorl| {
            let own: Vec<DVec2> = self.own(tips, whorl).collect();
            rims[whorl].turns(&own).largest < FAN
        })
    }

    /// What these tips so sorted cost: the less, the likelier.
    pub(super) fn price(&self, tips: &[DVec2]) -> f64 {
        let rims = self.rims();
        let uneven = |(whorl, rim): (usize, &Rim)| Equal::of(&self.azimuths(tips, whorl, rim)).uneven();
        let uneven = rims.iter().enumerate().map(uneven).sum();
        price(tips.len(), self.spread(tips, &rims), uneven, rims.len())
    }

    /// Sorts tips anew to cones that fit better by now: by their distance from the rim, and where rims cross in the drawing by
    /// where petals that turn alike would stand.
    pub(super) fn resorted(self, tips: &[DVec2]) -> Self {
        let rims = self.rims();
        let shaking = self.spread(tips, &rims).sqrt() + SHAKING;
        let rings = rims.iter().enumerate().map(|(whorl, rim)| Equal::of(&self.azimuths(tips, whorl, rim)));
        let rings: Vec<Equal> = rings.collect();
        let cost = |tip: DVec2, whorl: usize| {
            let turn = rings[whorl].off(rims[whorl].azimuth(tip)) / TURN.0;
            (rims[whorl].distance(tip) / shaking).powi(2) + turn.min(TURN.1).powi(2)
        };
        let nearest =
            |tip: &DVec2| (0..rims.len()).fold(0, |a, b| if cost(*tip, b) < cost(*tip, a) { b } else { a });
        let of: Vec<usize> = tips.iter().map(nearest).collect();
        let has_enough = |whorl: usize| of.iter().filter(|of| **of == whorl).count() >= FEWEST;
        if (0..rims.len()).all(has_enough) { Self { of, ..self } } else { self }
    }

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
/// for each number of whorls the likeliest. `single` is the cone that fits all of them best, `on_it` the tips on that cone. None if
/// they are rather one whorl.
pub(super) fn ways(tips: &[DVec2], single: &ConeFit, on_it: &[DVec2]) -> Vec<Sorted> {
    let alone = Sorted::one(tips.len(), *single);
    if tips.len() < 2 * FEWEST || alone.spread(on_it, &alone.rims()) < ONE * ONE {
        return Vec::new();
    }
    let views: Vec<View> = axes(single).map(|axis| View::new(axis, tips)).collect();
    let of_one =
        views.iter().filter_map(|view| Lines::around(view, tips, alone.of.clone(), 1, f64::INFINITY));
    let one = of_one.map(|lines| lines.price).fold(f64::INFINITY, f64::min);
    let (mut ways, mut is_split) = (Vec::new(), false);
    for count in 2..=MOST.min(tips.len() / FEWEST) {
        // Where neither two nor three lines cost less than one, more do not either.
        if count > 3 && !is_split {
            break;
        }
        let mut best: Option<Lines> = None;
        for (view, order) in views.iter().flat_map(|view| view.orders.iter().map(move |order| (view, order)))
        {
            let limit = best.as_ref().map_or(one, |best| best.price);
            let found = Lines::sorted(view, tips, order, count, limit);
            is_split |= found.is_some();
            best = found.filter(|found| found.are_apart(view)).or(best);
        }
        ways.extend(best.map(Lines::sorted_to_cones));
    }
    ways
}

/// The price of so many petals, with their mean square distance from their rims, that turn so unevenly.
fn price(petals: usize, spread: f64, uneven: f64, whorls: usize) -> f64 {
    let ((each, turn), petals) = (PRICES, petals as f64);
    petals * (spread + SHAKING * SHAKING).ln() + each * petals.ln() * whorls as f64 + turn * uneven
}

/// Tips as they are along an axis.
#[derive(Clone, Debug)]
struct View {
    axis: Axis,
    /// Where each tip lies in the plane in which whorls are lines.
    places: Vec<DVec2>,
    /// For cones of several steepnesses, tips by the radius of the one through them: number and radius.
    orders: [Vec<(usize, f64)>; STEEPNESS.len()],
}

/// An axis as the drawing sees it.
#[derive(Clone, Copy, Debug)]
struct Axis {
    /// Projection of the unit axis.
    t: DVec2,
    /// Square of the sine of its angle from the drawing.
    sin2: f64,
}

impl Axis {
    fn new(t: DVec2) -> Self {
        Self { t, sin2: (1.0 - t.length_squared()).max(1e-3) }
    }
}

impl View {
    fn new(axis: Axis, tips: &[DVec2]) -> Self {
        let place = |q: &DVec2| {
            let along = axis.t.dot(*q) / axis.sin2;
            DVec2::new(2.0 * along, q.length_squared() + along * along * axis.sin2)
        };
        let places: Vec<DVec2> = tips.iter().map(place).collect();
        let orders = STEEPNESS.map(|steepness| {
            let radius = |place: &DVec2| (place.y - steepness * place.x).max(0.0).sqrt();
            let mut order: Vec<(usize, f64)> = places.iter().map(radius).enumerate().collect();
            order.sort_by(|a, b| a.1.total_cmp(&b.1));
            order
        });
        Self { axis, places, orders }
    }
}

fn axes(single: &ConeFit) -> impl Iterator<Item = Axis> {
    let on_grid = RISES.into_iter().flat_map(|rise| {
        let at = move |k: usize| DVec2::from_angle(TAU * k as f64 / DIRECTIONS as f64);
        (0..DIRECTIONS).map(move |k| Axis::new(at(k) * rise.to_radians().cos()))
    });
    [Axis::new(single.axis().truncate()), Axis::new(DVec2::ZERO)].into_iter().chain(on_grid)
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
    /// The line through places that knows a little of how steep it is; nothing if it is no cone, or they are too few.
    fn through(axis: &Axis, places: impl Iterator<Item = DVec2> + Clone) -> Option<Self> {
        let (sum, count) =
            places.clone().fold((DVec2::ZERO, 0), |(sum, count), place| (sum + place, count + 1));
        if count < FEWEST {
            return None;
        }
        let count = count as f64;
        let mean = sum / count;
        let likely = LIKELY.0 * mean.y.max(0.0).sqrt();
        let (mut both, mut spread) = (0.0, 0.0);
        for d in places.map(|place| place - mean) {
            both += d.x * d.y;
            spread += d.x * d.x;
        }
        let little = LIKELY.1 * count;
        let height = ((both + little * likely) / (spread + little)).max(0.0);
        let offset = mean.y - height * mean.x;
        let radius2 = offset + height * height * axis.t.length_squared() / axis.sin2;
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
    axis: Axis,
    of: Vec<usize>,
    lines: Vec<Line>,
    /// Mean square distance of tips from their lines.
    spread: f64,
    price: f64,
}

impl Lines {
    /// Sorts tips to so many lines, at first by gaps in their order for cones of one steepness; nothing that costs `limit` or more.
    fn sorted(view: &View, tips: &[DVec2], order: &[(usize, f64)], count: usize, limit: f64) -> Option<Self> {
        let cuts = widest_gaps(order, count)?;
        let mut of = vec![0; tips.len()];
        for (rank, (tip, _)) in order.iter().enumerate() {
            of[*tip] = cuts.partition_point(|cut| *cut <= rank);
        }
        for _ in 0..ROUNDS {
            let lines = fitted(view, &of, count)?;
            let nearest = |place: &DVec2| {
                let off = |line: &Line| line.off(*place).abs();
                (0..count).fold(0, |a, b| if off(&lines[b]) < off(&lines[a]) { b } else { a })
            };
            let again: Vec<usize> = view.places.iter().map(nearest).collect();
            if again == of {
                break;
            }
            of = again;
        }
        Self::around(view, tips, of, count, limit)
    }

    /// The lines of tips that are sorted already, and their price, if that is less than `limit`.
    fn around(view: &View, tips: &[DVec2], of: Vec<usize>, count: usize, limit: f64) -> Option<Self> {
        let (axis, lines) = (view.axis, fitted(view, &of, count)?);
        let square = |(place, whorl): (&DVec2, &usize)| lines[*whorl].off(*place).powi(2);
        let spread = view.places.iter().zip(&of).map(square).sum::<f64>() / tips.len() as f64;
        // Most cost too much without a look at their turns.
        if price(tips.len(), spread, 0.0, count) >= limit {
            return None;
        }
        let uneven = |(whorl, line): (usize, &Line)| {
            let own = tips.iter().zip(&of).filter(|(_, of)| **of == whorl);
            let around = |(q, _): (&DVec2, _)| azimuth(axis.t, axis.sin2, *q - line.height * axis.t);
            Equal::of(&own.map(around).collect::<Vec<_>>()).uneven()
        };
        let uneven = lines.iter().enumerate().map(uneven).sum();
        let price = price(tips.len(), spread, uneven, count);
        (price < limit).then_some(Self { axis, of, lines, spread, price })
    }

    /// Whether the tips of each whorl lie far from every other beside how far they lie off their own.
    fn are_apart(&self, view: &View) -> bool {
        let least = APART.0.max(APART.1 * self.spread.sqrt());
        let off = |whorl: usize, other: &Line| {
            let own = view.places.iter().zip(&self.of).filter(|(_, w)| **w == whorl);
            let (sum, count) =
                own.fold((0.0, 0.0), |(s, n), (place, _)| (s + other.off(*place).abs(), n + 1.0));
            sum / count
        };
        let others = |whorl: usize| self.lines.iter().enumerate().filter(move |(other, _)| *other != whorl);
        (0..self.lines.len()).all(|whorl| others(whorl).all(|(_, other)| off(whorl, other) > least))
    }

    fn sorted_to_cones(self) -> Sorted {
        let t = self.axis.t;
        let cone = |line: &Line| ConeFit::from_rim(t * line.height, line.radius, t);
        Sorted { cones: self.lines.iter().map(cone).collect(), of: self.of }
    }
}

/// Where a sorted list falls apart into so many pieces of at least [`FEWEST`], at its widest gaps.
fn widest_gaps(sorted: &[(usize, f64)], pieces: usize) -> Option<Vec<usize>> {
    let gap = |at: &usize| sorted[*at].1 - sorted[*at - 1].1;
    let mut gaps: Vec<usize> = (FEWEST..=sorted.len().checked_sub(FEWEST)?).collect();
    gaps.sort_by(|a, b| gap(b).total_cmp(&gap(a)));
    let mut cuts: Vec<usize> = Vec::new();
    for at in gaps {
        if cuts.len() + 1 < pieces && cuts.iter().all(|cut| cut.abs_diff(at) >= FEWEST) {
            cuts.push(at);
        }
    }
    cuts.sort_unstable();
    (cuts.len() + 1 == pieces).then_some(cuts)
}

/// The lines of tips that are sorted; nothing if one has too few.
fn fitted(view: &View, of: &[usize], count: usize) -> Option<Vec<Line>> {
    let own =
        |whorl: usize| view.places.iter().zip(of).filter(move |(_, w)| **w == whorl).map(|(place, _)| *place);
    (0..count).map(|whorl| Line::through(&view.axis, own(whorl))).collect()
}

/// Equal turns about an axis that come nearest to the azimuths of a whorl, of which some may be hidden and one too many.
#[derive(Clone, Copy, Debug)]
struct Equal {
    petals: usize,
    turns: usize,
    /// Phase of the places, in turns' own angle.
    phase: f64,
    /// 1 where all azimuths are at such places, 0 where they are anywhere.
    coherence: f64,
}

impl Equal {
    fn of(azimuths: &[f64]) -> Self {
        let petals = azimuths.len();
        let among = |turns: usize| {
            let sum: DVec2 = azimuths.iter().map(|a| DVec2::from_angle(turns as f64 * a)).sum();
            let coherence = sum.length() / petals.max(1) as f64;
            Self { petals, turns, phase: sum.y.atan2(sum.x), coherence }
        };
        let better = |a: Self, b: Self| if b.coherence > a.coherence { b } else { a };
        (petals.max(FEWEST + 1) - 1..=petals + HIDDEN).map(among).fold(among(petals.max(1)), better)
    }

    /// How far an azimuth is from the nearest such place, in turns: at most a half.
    fn off(&self, azimuth: f64) -> f64 {
        let off = (self.turns as f64 * azimuth - self.phase) / TAU;
        (off - off.round()).abs()
    }

    /// How many petals turn as if the others were not there: none where all turn alike, with some hidden.
    fn uneven(&self) -> f64 {
        self.petals as f64 * (1.0 - self.coherence)
    }
}
