//! Flowers in a row: heads of any kind on stems side by side, however roughly they are drawn ([`upright`](super::upright)).
//!
//! A head on a stem says little by itself: it may be a crown or a leaf. Several stems with heads of their own are a garden, and there
//! each head speaks for the others: petals, teeth, windings, rays, stems that are long beside their heads, and ground under them
//! make flowers of those beside them as well, and so do bare stems on the ground. Against it speak the tip of a blade, heads
//! that touch, which may be halves of a crown, and other lines at the same height. Petals are as drawn where they can be seen, along the rays
//! where a head is made of rays, and else fill the head as those of a [`rose`](super::rose) do.
//!
//! In a pot, where leaves stand on stems as well, one head at least must show petals or windings. A head of two outlines, one on each side
//! of its stem, is the leaves of a sprout.
//!
//! Limits: heads on two lines, which are trunks; flowers one above the other; row upon row.

use super::corolla_on_stem::{is_seen_from_the_front, petals_on_stem};
use super::upright::{Flower, is_wound, points_away, stand_in_bed, tips_of_hull, upright};
use super::{cup, rays, rose};
use crate::anatomy::conventions::page::{Line, Page, even};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Fewest stems of a row.
const FEWEST: usize = 2;
/// Least chord of a ray over its length, how near it passes to the head's middle, as a share of the head's size, and fewest rays.
const RAY: (f32, f32, usize) = (0.9, 0.3, 2);
/// Lines that cross in the middle of a head which is a flower even if it is the only one; how far from there their middles are at most, and
/// their least length, as shares of its size.
const STAR: (usize, f32, f32) = (3, 0.2, 0.6);
/// How far above the middle of such a head its stem ends at most, as a share of the head's height.
const THROUGH: f32 = 0.25;
/// Points of a petal along a ray, where it begins, as a share of the ray, and half its width, as a share of the head's half size.
const THIN: (usize, f32, f32) = (10, 0.06, 0.2);
/// Log-odds of a head by itself, and most of one whose petals are not seen all around: conventions that know more of it come first.
const SCORE: f32 = 1.6;
const MOST: f32 = 4.1;
/// From how many flowers that show their petals on those beside them may be that much likelier: in a row of flowers is no tree on a line.
const CERTAIN: (usize, f32) = (2, 0.6);
/// What each flower beside it speaks for a head, and how much of what speaks for that one; the same of a bare stem on the ground;
/// how many are counted.
const BESIDE: (f32, f32, f32) = (0.3, 0.6, 0.3);
const COUNTED: usize = 3;
/// What speaks for a flower: petals, windings or many lines, a blade's tip, each e-fold of the visible stem over the head's height.
const PETALS: f32 = 1.2;
const MANY: f32 = 0.8;
const BLADE: f32 = -1.0;
const SLENDER: f32 = 0.8;
/// The same of ground under its foot, how near that is, as a share of the stem's length, and greatest height of ground, as a share
/// of its width.
const GROUND: (f32, f32, f32) = (0.8, 0.3, 0.25);
/// How near the upper corners of a pot are to the ends of its rim, and how high it is at least, as shares of the rim's width.
const RIM: (f32, f32) = (0.15, 0.3);
/// Least width of ground, as a share of the drawing's.
const WIDE: f32 = 0.35;
/// What speaks against it: as much of other lines at its height as it has itself; a head that touches it.
const CROWDED: f32 = 1.5;
const TOUCHING: f32 = 1.5;
/// Stretch and turn of the tip of a blade.
const TIP: (f32, f32) = (0.1, 1.6);
/// Most roundness of a leaf that leans, and least lean, as a slope.
const LEANING: (f32, f32) = (0.5, 0.6);
/// Of the two leaves of a sprout: how near to the stem's top they begin, in sizes of the leaf, and least size of one, as a share of the other's.
const SPROUT: (f32, f32) = (0.35, 0.45);

/// Outlines of petals.
type Petals = Vec<Vec<Vec2>>;

/// Proposes a flower for each head of a row.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let stems = upright(page);
    let ground = ground(page, &stems);
    let is_potted = ground.is_empty() && page.has_apart();
    let (flowers, bare) = flowers(page, stems, &ground);
    let is_star = |flower: &Flower| flower.crossing(page) >= STAR.0 && !flower.goes_through();
    if flowers.len() + bare < FEWEST && !flowers.iter().any(is_star) {
        return;
    }
    let touches =
        |i: usize| flowers.iter().enumerate().any(|(k, other)| k != i && flowers[i].is_beside(other));
    let apart = |i: usize| if touches(i) { TOUCHING } else { 0.0 };
    let of_flower =
        |flower: &Flower| flower.head.iter().copied().chain([flower.stem.number]).collect::<Vec<_>>();
    let mut row: Vec<usize> = flowers.iter().flat_map(of_flower).collect();
    row.sort_unstable();
    let against = |i: usize| apart(i) + CROWDED * flowers[i].crowded(page, &row).min(1.0);
    // In a pot leaves stand on stems as well.
    let are_leaves = flowers.iter().all(|flower| flower.points_away(page));
    if are_leaves || is_potted && !are_potted_flowers(page, &flowers) {
        return;
    }
    let petals: Vec<Option<Petals>> = flowers.iter().map(|flower| flower.drawn(page)).collect();
    let speaks =
        |(i, flower): (usize, &Flower)| flower.evidence(page, &ground, petals[i].is_some()) - against(i);
    let evidence: Vec<f32> = flowers.iter().enumerate().map(speaks).collect();
    let certain = petals.iter().flatten().count();
    for ((i, flower), petals) in flowers.iter().enumerate().zip(petals) {
        let others = evidence.iter().enumerate().filter(|(k, _)| *k != i);
        let mut beside: Vec<f32> = others.map(|(_, it)| (BESIDE.0 + BESIDE.1 * it).max(0.0)).collect();
        beside.sort_by(|a, b| b.total_cmp(a));
        beside.extend((0..bare).map(|_| BESIDE.2));
        let score = SCORE + evidence[i] + beside.iter().take(COUNTED).sum::<f32>();
        let most = if flower.shows_its_face(page) || is_star(flower) { f32::INFINITY } else { MOST };
        let most = if certain >= CERTAIN.0 { most + CERTAIN.1 } else { most };
        out.push(flower.hypothesis(petals, score.min(most)));
    }
}

/// Lines that are set apart and lie below stems as the ground or a bed does: a pot is narrower or holds all stems in its middle.
fn ground<'a>(page: &'a Page, stems: &[Flower]) -> Vec<&'a Line> {
    let width = page.bounds.1.x - page.bounds.0.x;
    let is_ground = |line: &&Line| {
        let size = line.size();
        let is_level = size.y < GROUND.2 * size.x;
        size.x > WIDE * width && (is_level || stand_in_bed(stems, line.bounds))
    };
    let apart = || (0..page.lines.len()).filter(|i| page.is_apart(*i)).map(|i| &page.lines[i]);
    apart().filter(is_ground).filter(|line| !apart().any(|other| is_rim(line, other))).collect()
}

/// Whether a line is the rim of a pot that another line draws: this hangs from it and is no wider.
fn is_rim(line: &Line, pot: &Line) -> bool {
    let (near, wide) = (Vec2::splat(RIM.0 * line.size().x), line.size().x);
    let (low, high) = (line.bounds.0 - near, line.bounds.1 + near);
    pot.bounds.0.cmpgt(low).all()
        && pot.bounds.1.x < high.x
        && pot.bounds.0.y < high.y
        && pot.bounds.1.y > line.bounds.1.y + RIM.1 * wide
}

/// Those of all stems of a page that are of the form of a flower, and how many other stems stand on the ground beside them.
fn flowers<'a>(page: &Page, all: Vec<Flower<'a>>, ground: &[&Line]) -> (Vec<Flower<'a>>, usize) {
    let on_ground = |flowers: &[Flower]| flowers.iter().filter(|flower| flower.is_on(ground)).count();
    let all: Vec<Flower> = all.into_iter().filter(|flower| !flower.is_sprout(page)).collect();
    let stems = on_ground(&all);
    let (bare, mut flowers): (Vec<_>, Vec<_>) = all.into_iter().partition(Flower::is_bare);
    flowers.retain(|flower| {
        let is_on_trunk = bare.iter().any(|bare| flower.stands_on(bare));
        flower.is_of_form(page) && !flower.is_inside(page) && !is_on_trunk
    });
    let others = stems - on_ground(&flowers);
    (flowers, others)
}

/// Whether heads on stems in a pot are flowers: one of them at least has petals or is wound, and none is a blade.
fn are_potted_flowers(page: &Page, flowers: &[Flower]) -> bool {
    let is_one = |flower: &Flower| flower.drawn(page).is_some() || flower.lines(page).any(is_wound);
    flowers.len() >= FEWEST
        && flowers.iter().any(is_one)
        && !flowers.iter().any(|flower| {
            let is_bare = flower.lines(page).count() > 2 && flower.drawn(page).is_none();
            flower.is_blade(page) || flower.leans(page) || is_bare
        })
}

impl Flower<'_> {
    /// Whether its foot is on the ground.
    fn is_on(&self, ground: &[&Line]) -> bool {
        let (foot, near) = (self.stem.foot(), GROUND.1 * self.stem.length);
        let is_near = |p: &Vec2| (p.x - foot.x).abs() < near && (p.y - foot.y).abs() < near;
        let is_in = |line: &Line| foot.cmpgt(line.bounds.0).all() && foot.cmplt(line.bounds.1).all();
        ground.iter().any(|line| is_in(line) || line.points.iter().any(is_near))
    }

    /// Whether its head is two leaves at the end of the stem, one to each side.
    fn is_sprout(&self, page: &Page) -> bool {
        let top = self.stem.top();
        let leaves: Vec<&Line> = self.lines(page).collect();
        let [a, b] = &leaves[..] else { return false };
        let size = |line: &Line| line.size().length();
        let begins_at_top = |line: &Line| {
            polyline::nearest(&line.points, top).is_some_and(|(gap, _)| gap < SPROUT.0 * size(line))
        };
        let aside = |line: &Line| line.middle().x - top.x;
        let is_even = size(a).min(size(b)) > SPROUT.1 * size(a).max(size(b));
        let is_leaf = |line: &Line| !is_wound(line) && !line.is_scribble() && begins_at_top(line);
        is_even && aside(a) * aside(b) < 0.0 && is_leaf(a) && is_leaf(b)
    }

    /// Whether its head is the outline of a leaf: one that has a tip.
    fn is_blade(&self, page: &Page) -> bool {
        self.only(page).is_some_and(|line| {
            let has_tip = || !tips_of_hull(line, TIP).is_empty();
            line.is_closed_and_solid() && has_tip() || self.points_away(page)
        })
    }

    /// Whether its head is narrow and stands aside of its stem.
    fn leans(&self, page: &Page) -> bool {
        self.only(page).is_some_and(|line| {
            let from_top = line.middle() - self.stem.top();
            line.roundness() < LEANING.0 && from_top.x.abs() > LEANING.1 * from_top.y.abs()
        })
    }

    /// Whether its head is the outline of a leaf whose point is away from the stem.
    fn points_away(&self, page: &Page) -> bool {
        self.only(page).is_some_and(|line| points_away(line, self.stem.top()))
    }

    /// How much longer than this flower is what else of its height touches it.
    fn crowded(&self, page: &Page, row: &[usize]) -> f32 {
        let group = page.groups.iter().find(|group| group.binary_search(&self.stem.number).is_ok());
        let is_high = |i: usize| page.lines[i].bounds.0.y < self.bounds.1.y;
        let others =
            group.into_iter().flatten().copied().filter(|i| row.binary_search(i).is_err() && is_high(*i));
        let own = self.stem.length + self.lines(page).map(|line| line.length).sum::<f32>();
        others.map(|i| page.lines[i].length).sum::<f32>() / own.max(f32::MIN_POSITIVE)
    }

    /// The one line of the head, if it is one.
    fn only<'a>(&'a self, page: &'a Page) -> Option<&'a Line> {
        let mut lines = self.lines(page);
        lines.next().filter(|_| lines.next().is_none())
    }

    /// Lines of the head that go straight through its middle or out from there.
    fn rays<'a>(&'a self, page: &'a Page) -> Vec<&'a Line> {
        let (middle, size) = (self.bounds.0.midpoint(self.bounds.1), self.size().max_element());
        let is_ray = |line: &&Line| {
            let (a, b) = line.ends();
            let is_straight = a.distance(b) > RAY.0 * line.length;
            is_straight && polyline::nearest(&line.points, middle).is_some_and(|(gap, _)| gap < RAY.1 * size)
        };
        self.lines(page).filter(is_ray).collect()
    }

    /// How many lines of the head cross in its middle.
    fn crossing(&self, page: &Page) -> usize {
        let (middle, size) = (self.bounds.0.midpoint(self.bounds.1), self.size().max_element());
        let is_across =
            |ray: &&&Line| ray.middle().distance(middle) < STAR.1 * size && ray.length > STAR.2 * size;
        self.rays(page).iter().filter(is_across).count()
    }

    /// Whether its stem goes on far beyond the middle of the head: that of leaflets along a rachis does.
    fn goes_through(&self) -> bool {
        let beyond = self.bounds.0.midpoint(self.bounds.1).y - self.stem.top().y;
        beyond > THROUGH * self.size().y
    }

    /// Petals that can be seen in the drawing.
    fn drawn(&self, page: &Page) -> Option<Petals> {
        let rays = self.rays(page);
        if rays.len() >= RAY.2 && 2 * rays.len() >= self.lines(page).count() {
            return Some(self.along(&rays));
        }
        let line = self.only(page).filter(|line| !is_wound(line))?;
        let foot = Vec2::new(self.stem.top().x.clamp(self.bounds.0.x, self.bounds.1.x), self.bounds.1.y);
        petals_on_stem(line, self.stem.top()).or_else(|| cup::petals_of_teeth(line, foot))
    }

    /// Whether its petals are drawn in one line all around its middle.
    fn shows_its_face(&self, page: &Page) -> bool {
        self.only(page).is_some_and(|line| !is_wound(line) && is_seen_from_the_front(line))
    }

    /// A thin petal along each ray out from the middle of the head.
    fn along(&self, rays: &[&Line]) -> Petals {
        let (middle, reach) = (self.bounds.0.midpoint(self.bounds.1), 0.5 * self.size().max_element());
        let tips = rays.iter().flat_map(|ray| [ray.ends().0, ray.ends().1]);
        let far = tips.filter(|tip| tip.distance(middle) > 0.5 * reach);
        far.map(|tip| rays::blade(&even(&[middle + THIN.1 * (tip - middle), tip], THIN.0), THIN.2 * reach))
            .collect()
    }

    /// What speaks for a flower in the drawing of this one: petals, windings, a long stem.
    fn evidence(&self, page: &Page, ground: &[&Line], shows_petals: bool) -> f32 {
        let head = if self.is_blade(page) {
            BLADE
        } else if shows_petals {
            PETALS
        } else if self.lines(page).any(is_wound) || self.lines(page).count() > 2 {
            MANY
        } else {
            0.0
        };
        let slender = SLENDER * self.visible().ln().clamp(-1.0, 1.0);
        let stands = if self.is_on(ground) { GROUND.0 } else { 0.0 };
        head + slender + stands
    }

    fn hypothesis(&self, petals: Option<Petals>, score: f32) -> Hypothesis {
        let petals = match petals {
            Some(petals) => petals.into_iter().map(|petal| Made::new(Tool::Petal, petal)).collect(),
            None => rose::petals(self.bounds.0.midpoint(self.bounds.1), 0.5 * self.size()),
        };
        let below = self.stem.points.iter().take_while(|p| p.y > self.bounds.1.y).count().max(2);
        let runs_along = below < self.stem.points.len() && self.stem.bends();
        let is_cut = self.stem.rest.is_some() || runs_along;
        let own_stem = is_cut.then(|| Made::new(Tool::Branch, self.stem.points.iter().copied().take(below)));
        let own_line = own_stem.as_ref().map(|_| self.stem.number);
        let mut uses: Vec<usize> = self.head.iter().copied().chain(own_line).collect();
        uses.sort_unstable();
        let parts = petals.into_iter().chain(own_stem).collect();
        let (reading, habit) = (Reading::Corolla, Some(Habit::Flower));
        Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit }
    }
}

#[cfg(test)]
#[path = "row_tests.rs"]
mod tests;
