//! Pose of a flower from the projection of its cone (000 §4.1, 002 §5.1).
//!
//! The petals of a flower stand on a cone whose apex is the flower's centre, their tips on its rim. In the drawing the
//! apex is where the petals come together and the rim an ellipse through the tips: its flatness gives the angle between
//! axis and drawing, its centre's distance from the apex the height.
//!
//! How. Tips are first estimated without the cone; the cone's start comes from the ellipse through them (direct least
//! squares) and from their mean and covariance; a robust fit (`cone_fit`) improves it, and since the true tip
//! of a round petal depends on the cone, tips and cone are improved in turn. Tips of flat petals, tangent to the cone,
//! are best found without it, so the unrefined fit competes too: the least misfit wins. A last fit
//! weighs the tips by how well they lie on any ellipse, and lets priors speak where the drawing is silent:
//! an opening angle for flowers seen face-on, the stem's direction for the axis, evenly spread petals for half flowers
//! without a stem and for fewer than five petals. So a petal more or less turns a flower by a few degrees only.
//!
//! Departs from the papers: h = l / cos θ where both print l / sin θ; the free ellipse is only a start, as it has one
//! unknown more than the cone and needs five tips. Petals of several whorls are sorted to them (`whorls`) and get a cone for
//! each, with apex and axis in common (`whorl_fit`). Limits: a front view cannot tell a flower that faces the viewer from one
//! that faces away: [`ConeParams::flip`] chooses.

use super::cone_fit::{ConeFit, Moments, Rim, StemPrior, Trust, improve};
use super::petal_tip::Petal;
pub use super::petal_tip::PetalOutline;
use super::whorl_fit::{WhorlTips, improve_together};
use super::whorls::{self, Sorted};
use crate::geom::ellipse::{Ellipse, fit_ellipse};
use glam::{DVec2, Vec2, Vec3};

crate::parameters! {
    /// How a flower's cone is understood from its petals.
    pub struct ConeParams {
        /// Angle between axis and petals of a flower drawn face-on, which does not show it.
        opening_prior: f32 = 65.0, 10.0..=85.0, "degrees";
        /// How far openings are from that in the mean; a species whose flowers open alike says less.
        opening_spread: f32 = 28.0, 2.0..=60.0, "degrees";
        /// Sine of the angle between axis and drawing from which the opening prior gains weight, fully at 1.
        face_on: f32 = 0.985, 0.5..=0.999, "";
        /// Whether flowers face away from the viewer.
        flip: bool = false, 0..=1, "";
        /// Whether flowers of several whorls get copies of petals that others hide in the drawing.
        fill_hidden: bool = true, 0..=1, "";
        /// Most rounds of finding the tips on the cone and the cone through the tips.
        rounds: u32 = 5, 0..=50, "";
    }
}

/// The cone of a flower; lengths in canvas pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct FlowerPose {
    /// Unit axis from the flower's centre outward, world directions: x right, y up, z toward the viewer.
    pub axis: Vec3,
    /// The rings in which its petals stand, outermost first; at least one.
    pub whorls: Vec<Whorl>,
    /// Number of each petal's whorl, in the order of the petals.
    pub whorl_of: Vec<usize>,
    /// The cone's apex on the canvas: where the petals come together.
    pub center: Vec2,
    /// Tip of each petal on the canvas, in the order of the petals.
    pub tips: Vec<Vec2>,
    /// Depth of each tip toward the viewer, counted from the centre: tells which of the cone's two sides a petal is on.
    pub tip_depths: Vec<f32>,
    /// Whether the drawing alone determines the pose; otherwise priors had a large part in it.
    pub determined: bool,
    /// Root mean square distance of the tips from the projected rim, as a share of the slant.
    pub residual: f32,
}

/// One ring of petals: a cone whose apex and axis are its flower's; lengths in canvas pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whorl {
    /// Angle between axis and petals, radians, 8° to 85°.
    pub opening_rad: f32,
    /// Distance from the centre to the middle of the rim.
    pub height_px: f32,
    /// Distance from the centre to the tips.
    pub slant_px: f32,
}

impl FlowerPose {
    /// The outermost whorl.
    pub fn outermost(&self) -> Whorl {
        const NONE: Whorl = Whorl { opening_rad: 1.0, height_px: 0.0, slant_px: 0.0 };
        self.whorls.first().copied().unwrap_or(NONE)
    }

    /// Distance from the centre to the farthest tips.
    pub fn reach_px(&self) -> f32 {
        self.whorls.iter().map(|whorl| whorl.slant_px).fold(0.0, f32::max)
    }
}

/// How well tips lie on a cone: standard deviation in units of the petals' length, and how many tips of the drawing that
/// is worth. Four tips always lie on some cone, so they alone say nothing of how well they do.
struct Hand {
    tip: f64,
    known: f64,
}

/// Where nothing but the tips tells the axis they are believed as a careful hand's.
const CAREFUL: Hand = Hand { tip: 0.015, known: 2.0 };
/// Beside a stem they count as what petals are, which are not all of one length.
const NATURAL: Hand = Hand { tip: 0.06, known: 4.0 };
/// Opening's standard deviation, radians: where the drawing shows it, and where it does not.
const FACE_ON_OPENING: f64 = 0.03;
/// Evenness's standard deviation: where petals stand all around, and where they stand on one side only.
const EVENNESS: [f64; 2] = [0.3, 0.02];
/// The same where petals are missing.
const MISSING_EVENNESS: f64 = 10.0;
/// Standard deviation of the turns from petal to petal, in units of the usual one: where petals are missing, and where they
/// are not, so that all of them tell more than how they follow each other.
const TURNS: [f64; 2] = [0.2, 20.0];
/// Largest turn, in usual ones, at which petals begin to be missing there, and are.
const MISSING: (f64, f64) = (3.8, 5.0);
/// How often it is asked which petals are missing.
const LOOKS: u32 = 3;
/// Fewest petals that show it.
const SHOWING: usize = 4;
/// Likely angle between a flower's axis and the drawing where only its stem tells, radians.
const STEM_RISE: f64 = 0.9;
/// How far axes leave that: across the plane of stem and viewer, and within it, as sines.
const STEM_SPREAD: (f64, f64) = (0.2, 0.35);
/// Turn without petals from which on, and at which, they are a fan that is seen from the side, radians.
const FAN: (f64, f64) = (3.4, 3.8);
/// Sine of the angle between axis and drawing from which on they may be such a fan.
const FACE_ON_FAN: (f64, f64) = (0.9, 0.97);
/// Gap between neighbouring petals around the axis at which a flower begins, and ceases, to be one-sided, radians.
const GAP: (f64, f64) = (2.3, 3.3);
/// Squared length, in units of the petals', by which petals must differ in direction to tell where they come together.
const APEX_RIDGE: f64 = 0.02;
/// Residual above which the tips lie on no ellipse.
const LOOSE: f64 = 0.08;
/// Most steps of a fit from a rough start, and of one between two looks at the tips.
const STEPS: (u32, u32) = (10, 2);

/// Pose of the flower that `petals` draw; `stem` is the direction on the canvas in which its stem arrives. Any outlines give a finite pose; without a usable petal it is a face-on
/// flower of size 0.
pub fn flower_pose(petals: &[PetalOutline<'_>], stem: Option<Vec2>, params: &ConeParams) -> FlowerPose {
    let Some(flower) = Flower::new(petals) else {
        return without_petals(petals, params);
    };
    let prior = f64::from(params.opening_prior).to_radians();
    let stem = stem.and_then(|arrival| arrival.as_dvec2().try_normalize());
    let stem = stem.map(|arrival| StemPrior::new(arrival, STEM_RISE, STEM_SPREAD));
    let hand = if stem.is_some() { NATURAL } else { CAREFUL };
    let spread = f64::from(params.opening_spread).to_radians();
    let trust =
        Trust { tip: hand.tip, opening: (prior, spread), evenness: EVENNESS[0], turns: turns(0.0), stem };
    let mut best = flower.best_fit(&trust, params.rounds);
    for _ in 0..LOOKS {
        let missing = missing(&best);
        if missing == 0.0 {
            break;
        }
        let trust = Trust { evenness: evenness(0.0, missing), turns: turns(missing), ..trust };
        best = flower.best_fit(&trust, params.rounds);
    }
    if let Some(whorled) = flower.whorled(&best, &trust, params.rounds) {
        return flower.pose(&whorled, true, params, petals);
    }
    let (cone, trusted) = settled(&best, &trust, &hand, params);
    let determined = trusted && best.tips.len() >= 5;
    let alone = Whorled { sorted: Sorted::one(best.tips.len(), cone), tips: best.tips };
    flower.pose(&alone, determined, params, petals)
}

/// Petals counted from the flower's centre, in units of their mean length, y down.
struct Flower {
    petals: Vec<Petal>,
    /// For each petal of the input its place in `petals`, `None` for one without shape.
    place: Vec<Option<usize>>,
    center: DVec2,
    size: f64,
}

/// Tips and the cone through them.
struct Fitted {
    cone: ConeFit,
    cost: f64,
    tips: Vec<DVec2>,
}

/// Tips and the cones of the whorls that they stand in, one at least.
struct Whorled {
    sorted: Sorted,
    tips: Vec<DVec2>,
}

impl Whorled {
    /// The rim of a tip's whorl.
    fn rim_of(&self, tip: usize) -> Rim {
        self.sorted.cones[self.sorted.of[tip]].rim()
    }
}

impl Flower {
    fn new(outlines: &[PetalOutline<'_>]) -> Option<Self> {
        let usable: Vec<_> = outlines.iter().map(PetalOutline::is_usable).collect();
        let used = || outlines.iter().zip(&usable).filter(|(_, ok)| **ok).map(|(outline, _)| outline);
        let count = used().count();
        if count == 0 {
            return None;
        }
        let center = used().map(|p| p.root.as_dvec2()).sum::<DVec2>() / count as f64;
        let size = used().map(PetalOutline::reach).sum::<f64>() / count as f64;
        let mut petals: Vec<Petal> = used().map(|p| Petal::new(p, center, size)).collect();
        let apex = apex(&petals);
        petals.iter_mut().for_each(|petal| petal.shift(-apex));
        let center = center + apex * size;
        let mut places = 0..count;
        let place = usable.iter().map(|&ok| if ok { places.next() } else { None }).collect();
        Some(Self { petals, place, center, size })
    }

    fn best_fit(&self, trust: &Trust, rounds: u32) -> Fitted {
        let tips: Vec<DVec2> = self.petals.iter().map(|p| p.free_tip).collect();
        let moments = Moments::of(&tips);
        let free = |start| {
            let (cone, cost) = improve(start, &tips, &moments, trust, STEPS.0);
            Fitted { cone, cost, tips: tips.clone() }
        };
        let lesser = |a: Fitted, b: Fitted| if b.cost < a.cost { b } else { a };
        let mut start = free(start_from_moments(&tips, &moments, trust));
        if let Some(stem) = &trust.stem {
            start = lesser(start, free(stem.cone(trust.opening.0)));
        }
        if let Some(ellipse) = fit_ellipse(&tips) {
            start = lesser(start, free(from_ellipse(&ellipse)));
        }
        lesser(self.refined(&start, trust, rounds), start)
    }

    /// Finds the tips on the cone and the cone through the tips in turn.
    fn refined(&self, from: &Fitted, trust: &Trust, rounds: u32) -> Fitted {
        let (mut cone, mut cost, mut tips) = (from.cone, from.cost, from.tips.clone());
        for _ in 0..rounds {
            let rim = cone.rim();
            for (tip, petal) in tips.iter_mut().zip(&self.petals) {
                *tip = petal.tip_on(&rim, *tip);
            }
            let before = cone;
            (cone, cost) = improve(cone, &tips, &Moments::of(&tips), trust, STEPS.1);
            if cone.is_close_to(&before) {
                break;
            }
        }
        Fitted { cone, cost, tips }
    }

    /// The whorls that the petals stand in, if they are several.
    fn whorled(&self, single: &Fitted, trust: &Trust, rounds: u32) -> Option<Whorled> {
        let tips: Vec<DVec2> = self.petals.iter().map(|p| p.free_tip).collect();
        let ways = whorls::ways(&tips, &single.cone, &single.tips);
        let fitted = ways.into_iter().map(|sorted| self.fitted_whorls(sorted, tips.clone(), trust, rounds));
        let around = fitted.filter(|whorled| whorled.sorted.surrounds(&whorled.tips));
        let priced = around.map(|whorled| (whorled.sorted.price(&whorled.tips), whorled));
        let (price, best) = priced.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (price < Sorted::one(tips.len(), single.cone).price(&single.tips)).then_some(best)
    }

    /// Fits cones, finds tips on them and sorts the tips to them in turn.
    fn fitted_whorls(&self, sorted: Sorted, tips: Vec<DVec2>, trust: &Trust, rounds: u32) -> Whorled {
        let mut whorled = Whorled { sorted, tips };
        for _ in 0..rounds.max(1) {
            let own = |whorl| WhorlTips::new(whorled.sorted.own(&whorled.tips, whorl).collect());
            let whorls: Vec<WhorlTips> = (0..whorled.sorted.cones.len()).map(own).collect();
            whorled.sorted.cones = improve_together(whorled.sorted.cones, &whorls, trust, STEPS.0);
            for (k, petal) in self.petals.iter().enumerate() {
                whorled.tips[k] = petal.tip_on(&whorled.rim_of(k), whorled.tips[k]);
            }
            whorled.sorted = whorled.sorted.resorted(&whorled.tips);
        }
        whorled.sorted = whorled.sorted.outermost_first();
        whorled
    }

    fn pose(
        &self,
        whorled: &Whorled,
        determined: bool,
        params: &ConeParams,
        outlines: &[PetalOutline<'_>],
    ) -> FlowerPose {
        let Whorled { sorted: Sorted { of, cones }, tips } = whorled;
        let toward = if params.flip { -1.0 } else { 1.0 };
        let axis = cones[0].axis();
        let tip_of = |(place, outline): (&Option<usize>, &PetalOutline<'_>)| match place {
            Some(k) => (self.center + tips[*k] * self.size).as_vec2(),
            None if outline.root.is_finite() => outline.root,
            None => self.center.as_vec2(),
        };
        let depth_of = |place: &Option<usize>| match place {
            Some(k) => (toward * self.size * whorled.rim_of(*k).depth(tips[*k])) as f32,
            None => 0.0,
        };
        let whorl = |cone: &ConeFit| Whorl {
            opening_rad: cone.opening as f32,
            height_px: (cone.height() * self.size) as f32,
            slant_px: (cone.slant() * self.size) as f32,
        };
        let off = |k: usize| (whorled.rim_of(k).distance(tips[k]) / cones[of[k]].slant()).powi(2);
        let misfit = ((0..tips.len()).map(off).sum::<f64>() / tips.len().max(1) as f64).sqrt();
        FlowerPose {
            axis: Vec3::new(axis.x as f32, -axis.y as f32, (toward * axis.z) as f32),
            whorls: cones.iter().map(whorl).collect(),
            whorl_of: self.place.iter().map(|place| place.map_or(0, |k| of[k])).collect(),
            center: self.center.as_vec2(),
            tips: self.place.iter().zip(outlines).map(tip_of).collect(),
            tip_depths: self.place.iter().map(depth_of).collect(),
            determined,
            residual: misfit as f32,
        }
    }
}

/// Where the petals come together, counted as they are. Each root lies the same share of its petal's length before its
/// petal, which no straight projection changes: the share and the point are fitted by least squares. The mean of the
/// roots would move with every petal that is missing.
fn apex(petals: &[Petal]) -> DVec2 {
    let count = petals.len() as f64;
    let along = |petal: &Petal| petal.free_tip - petal.root;
    let (root, mean) = (
        petals.iter().map(|p| p.root).sum::<DVec2>() / count,
        petals.iter().map(along).sum::<DVec2>() / count,
    );
    let (mut both, mut spread) = (0.0, APEX_RIDGE * count);
    for petal in petals {
        let off = along(petal) - mean;
        both += (petal.root - root).dot(off);
        spread += off.length_squared();
    }
    root - mean * (both / spread).clamp(0.0, 1.0)
}

/// The last fit, with each kind of knowledge weighed by what the first fit showed; and whether the tips alone
/// determined it. All weights change smoothly with the drawing, so the pose does not jump while the pen moves.
fn settled(best: &Fitted, trust: &Trust, hand: &Hand, params: &ConeParams) -> (ConeFit, bool) {
    let rim = best.cone.rim();
    let tip = spread_of_tips(&rim, &best.tips, hand);
    let face_on = smooth_step(f64::from(params.face_on), 1.0, rim.sin2.sqrt());
    let missing = missing(best);
    let one_sided = smooth_step(GAP.0, GAP.1, rim.turns(&best.tips).largest) * (1.0 - missing);
    let spread = trust.opening.1;
    let trust = Trust {
        tip,
        opening: (trust.opening.0, spread * (FACE_ON_OPENING / spread).min(1.0).powf(face_on)),
        evenness: evenness(if trust.stem.is_some() { 0.0 } else { one_sided }, missing),
        turns: turns(missing),
        ..*trust
    };
    let moments = Moments::of(&best.tips);
    let mut last = improve(best.cone, &best.tips, &moments, &trust, STEPS.0);
    let from_stem = trust.stem.map(|stem| stem.cone(trust.opening.0));
    for start in [Some(start_from_moments(&best.tips, &moments, &trust)), from_stem].into_iter().flatten() {
        let anew = improve(start, &best.tips, &moments, &trust, STEPS.0);
        if anew.1 < last.1 {
            last = anew;
        }
    }
    (last.0, face_on < 0.5 && one_sided < 0.5 && tip < LOOSE)
}

/// Standard deviation of evenness where petals are one-sided, and where they are missing, each from 0 to 1.
fn evenness(one_sided: f64, missing: f64) -> f64 {
    let ([usual, strict], loose) = (EVENNESS, MISSING_EVENNESS);
    usual * (strict / usual).powf(one_sided) * (loose / usual).powf(missing)
}

/// Standard deviation of the turns where petals are missing, from 0 to 1.
fn turns(missing: f64) -> f64 {
    TURNS[1] * (TURNS[0] / TURNS[1]).powf(missing)
}

/// How sure it is that petals are missing on one side, 0 to 1: the others turn alike from one to the next there is a
/// turn of several. Petals all on one side, alike from the front, are a flower seen from the side.
fn missing(fit: &Fitted) -> f64 {
    let rim = fit.cone.rim();
    let turns = rim.turns(&fit.tips);
    if fit.tips.len() < SHOWING {
        return 0.0;
    }
    let face_on = smooth_step(FACE_ON_FAN.0, FACE_ON_FAN.1, rim.sin2.sqrt());
    let is_fan = smooth_step(FAN.0, FAN.1, turns.largest) * face_on;
    smooth_step(MISSING.0, MISSING.1, turns.largest / turns.usual()) * (1.0 - is_fan)
}

fn start_from_moments(tips: &[DVec2], moments: &Moments, trust: &Trust) -> ConeFit {
    if tips.len() >= 3 {
        return moments.cone();
    }
    // One or two petals: a flower of the likely opening that leans halfway toward them.
    let lean = moments.mean.normalize_or_zero() * 0.5f64.sqrt();
    let (sin, cos) = trust.opening.0.sin_cos();
    ConeFit::from_rim(lean * cos, sin, lean)
}

/// The cone whose rim an ellipse about the apex would be.
fn from_ellipse(e: &Ellipse) -> ConeFit {
    let minor = e.major.perp();
    let axis = if minor.dot(e.center) < 0.0 { -minor } else { minor };
    let cos = (1.0 - (e.semi_minor / e.semi_major).powi(2)).max(0.0).sqrt();
    ConeFit::from_rim(axis * axis.dot(e.center), e.semi_major, axis * cos)
}

/// Standard deviation of the tips about the ellipse, by the upper quartile of their distances, which a few odd petals
/// do not reach.
fn spread_of_tips(rim: &Rim, tips: &[DVec2], hand: &Hand) -> f64 {
    /// Upper quartile of the size of a standard normal variable.
    const QUARTILE: f64 = 1.15;
    let mut sizes: Vec<f64> = tips.iter().map(|&q| rim.distance(q).abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let quartile = sizes.get(tips.len() * 3 / 4).map_or(0.0, |d| d / QUARTILE);
    let count = tips.len() as f64;
    let Hand { tip, known } = *hand;
    ((known * tip * tip + count * quartile * quartile) / (known + (count - 4.0).max(0.0))).sqrt()
}

fn smooth_step(from: f64, to: f64, x: f64) -> f64 {
    let share = ((x - from) / (to - from)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

fn without_petals(outlines: &[PetalOutline<'_>], params: &ConeParams) -> FlowerPose {
    let sound = |p: Vec2| if p.is_finite() { p } else { Vec2::ZERO };
    let roots: Vec<Vec2> = outlines.iter().map(|p| sound(p.root)).collect();
    let mean = roots.iter().map(|r| r.as_dvec2()).sum::<DVec2>() / roots.len().max(1) as f64;
    FlowerPose {
        axis: if params.flip { Vec3::NEG_Z } else { Vec3::Z },
        whorls: vec![Whorl { opening_rad: params.opening_prior.to_radians(), height_px: 0.0, slant_px: 0.0 }],
        whorl_of: vec![0; roots.len()],
        center: mean.as_vec2(),
        tip_depths: vec![0.0; roots.len()],
        tips: roots,
        determined: false,
        residual: 0.0,
    }
}
