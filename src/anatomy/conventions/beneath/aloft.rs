//! What hangs in the air beside plants and is none of them: the sun, clouds, birds, writing.
//!
//! Lines that touch are a cluster. Those whose foot is in the lowest part of the drawing stand; where they are most of
//! what is drawn, a small cluster high above the ground that no line leads to and that lies in none of them is looked at. A disc with rays
//! is the sun, a wide outline of several bows a cloud; open lines, several or one that winds, are a bird, a letter, a name. What stands
//! in a row with these is as well, such as the O of a word.
//!
//! Limits: single straight lines, round outlines and what may be a flower's head stay parts of the plant, for the stem may be drawn next;
//! writing on the ground or below a plant is not found.

use crate::anatomy::conventions::Hypothesis;
use crate::anatomy::conventions::page::{self, Line, Page, notches};
use crate::geom::{convex_hull::convex_hull, region::Region};
use crate::sketch::Reading;
use glam::{IVec2, Vec2};
use std::collections::HashSet;

/// Lowest part of the drawing in which what stands has its foot, and how high above the ground the foot of what hangs is at least, as
/// shares of the drawing's height.
const FOOT: (f32, f32) = (0.2, 0.25);
/// Least share of the length of all lines that stands.
const MOST: f32 = 0.5;
/// Most clusters above the ground that are looked at: leaves of a tree that touch nothing are no sky.
const MOST_CLUSTERS: usize = 64;
/// Largest cluster that hangs, and largest of open lines, as shares of the drawing's diagonal.
const LARGEST: (f32, f32) = (0.4, 0.3);
/// How near to what stands a cluster may not be but the sun, as a share of the drawing's diagonal, about.
const NEAR: f32 = 0.05;
/// How far beside a cluster, as a share of its width, and how far below, as a share of the drawing's height, a line ends that carries it.
const CARRIED: (f32, f32) = (0.25, 0.25);
/// Least opening of an open line, or greatest share of its hull that one encloses.
const OPEN: (f32, f32) = (0.35, 0.5);
/// Greatest chord of a single open line over its length: straighter ones are twigs.
const WINDS: f32 = 0.75;
/// Fewest rays of a sun, and least chord of one over its length.
const RAYS: (usize, f32) = (4, 0.85);
/// Least width of a cloud, in its heights, and fewest notches.
const CLOUD: (f32, usize) = (1.4, 3);
/// How far what stands in a row with other marks is from them, in its own sizes.
const BESIDE: f32 = 1.0;
/// Log-odds.
const SCORE: f32 = 3.0;

/// Proposes the sun, and all else that hangs in the air.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let hanging = hanging(page);
    let (suns, others): (Vec<&Cluster>, Vec<&Cluster>) = hanging.iter().partition(|it| it.is_sun(page));
    out.extend(suns.into_iter().map(|sun| Hypothesis::apart(sun.lines.clone(), SCORE, Reading::Sun)));
    let marks = with_neighbours(others, |it| it.is_mark(page) || it.is_cloud(page));
    if !marks.is_empty() {
        let mut uses: Vec<usize> = marks.into_iter().flat_map(|mark| mark.lines.iter().copied()).collect();
        uses.sort_unstable();
        out.push(Hypothesis::apart(uses, SCORE, Reading::Sky));
    }
}

/// Lines that touch.
struct Cluster {
    /// Ascending.
    lines: Vec<usize>,
    /// Smallest and largest corner.
    bounds: (Vec2, Vec2),
}

/// The small clusters high above the ground, if what stands there is most of the drawing.
fn hanging(page: &Page) -> Vec<Cluster> {
    let height = page.bounds.1.y - page.bounds.0.y;
    let is_at_foot = |it: &Cluster| it.bounds.1.y > page.bounds.1.y - FOOT.0 * height;
    let (upright, mut others): (Vec<Cluster>, Vec<Cluster>) =
        clusters(page).into_iter().partition(is_at_foot);
    let length = |it: &Cluster| it.lines.iter().map(|i| page.lines[*i].length).sum::<f32>();
    if others.is_empty() || upright.iter().map(length).sum::<f32>() < MOST * page.length {
        return Vec::new();
    }
    others.retain(|it| {
        it.bounds.1.y < page.bounds.1.y - FOOT.1 * height && it.diagonal() < LARGEST.0 * page.diagonal
    });
    if others.is_empty() || others.len() > MOST_CLUSTERS {
        return Vec::new();
    }
    let near = Squares::of(&upright, page, NEAR * page.diagonal);
    let hulls: Vec<Region> = upright.iter().map(|it| it.hull(page)).collect();
    let ends: Vec<Vec2> = upright
        .iter()
        .flat_map(|it| it.lines.iter().flat_map(|i| <[Vec2; 2]>::from(page.lines[*i].ends())))
        .collect();
    let is_free = |it: &Cluster| {
        let middle = it.bounds.0.midpoint(it.bounds.1);
        let is_near = !it.is_sun(page)
            && it.lines.iter().flat_map(|i| &page.lines[*i].points).any(|p| near.are_near(*p));
        !is_near
            && !hulls.iter().any(|hull| hull.contains(middle))
            && !ends.iter().any(|end| it.is_over(*end, height))
    };
    others.retain(is_free);
    others
}

/// All lines that are not set apart, by what touches.
fn clusters(page: &Page) -> Vec<Cluster> {
    let of_lines = |lines: &Vec<usize>| Cluster {
        lines: lines.clone(),
        bounds: page::bounds(lines.iter().map(|i| &page.lines[*i])),
    };
    page.groups.iter().map(of_lines).collect()
}

/// Squares with something in them, of a size that says what is near.
struct Squares {
    side: f32,
    taken: HashSet<IVec2>,
}

impl Squares {
    /// Those of all points of some clusters.
    fn of(clusters: &[Cluster], page: &Page, side: f32) -> Self {
        let points = clusters.iter().flat_map(|it| &it.lines).flat_map(|i| &page.lines[*i].points);
        Self { side, taken: points.map(|p| (p / side).floor().as_ivec2()).collect() }
    }

    /// Whether something is at a place or in a square beside it.
    fn are_near(&self, p: Vec2) -> bool {
        let at = (p / self.side).floor().as_ivec2();
        (-1..=1).any(|dx| (-1..=1).any(|dy| self.taken.contains(&(at + IVec2::new(dx, dy)))))
    }
}

/// Those of some clusters of which this is so, and what stands in a row with them.
fn with_neighbours(all: Vec<&Cluster>, is_one: impl Fn(&Cluster) -> bool) -> Vec<&Cluster> {
    let (mut found, mut others): (Vec<&Cluster>, Vec<&Cluster>) = all.into_iter().partition(|it| is_one(it));
    loop {
        let (near, far): (Vec<&Cluster>, Vec<&Cluster>) =
            others.into_iter().partition(|it| found.iter().any(|other| it.is_beside(other)));
        others = far;
        if near.is_empty() {
            return found;
        }
        found.extend(near);
    }
}

impl Cluster {
    fn size(&self) -> Vec2 {
        self.bounds.1 - self.bounds.0
    }

    fn diagonal(&self) -> f32 {
        self.size().length()
    }

    fn hull(&self, page: &Page) -> Region {
        let points: Vec<Vec2> = self.lines.iter().flat_map(|i| page.lines[*i].hull.iter().copied()).collect();
        Region::new(convex_hull(&points, |p| *p))
    }

    /// Whether it lies over the end of a line, which may be its stem.
    fn is_over(&self, end: Vec2, height: f32) -> bool {
        let aside = CARRIED.0 * self.size().x;
        let is_below = end.y > self.bounds.0.y && end.y < self.bounds.1.y + CARRIED.1 * height;
        is_below && end.x > self.bounds.0.x - aside && end.x < self.bounds.1.x + aside
    }

    /// Whether another is no farther from it than it is large.
    fn is_beside(&self, other: &Self) -> bool {
        let reach = Vec2::splat(BESIDE * self.size().max_element());
        (self.bounds.0 - reach).cmplt(other.bounds.1).all()
            && (self.bounds.1 + reach).cmpgt(other.bounds.0).all()
    }

    /// Whether it is a disc with rays, and nothing else.
    fn is_sun(&self, page: &Page) -> bool {
        let lines = || self.lines.iter().map(|i| &page.lines[*i]);
        let is_ray = |line: &&Line| line.ends().0.distance(line.ends().1) > RAYS.1 * line.length;
        let rays = lines().filter(is_ray).count();
        let discs = lines().filter(|line| line.openness < OPEN.0 && line.solidity() > 0.8).count();
        rays >= RAYS.0 && discs == 1 && rays + discs == self.lines.len()
    }

    /// Whether it consists of open lines, several or one that winds.
    fn is_mark(&self, page: &Page) -> bool {
        let is_open = |line: &Line| line.openness > OPEN.0 || line.solidity() < OPEN.1;
        let winds = |line: &Line| line.ends().0.distance(line.ends().1) < WINDS * line.length;
        let mut lines = self.lines.iter().map(|i| &page.lines[*i]);
        self.diagonal() < LARGEST.1 * page.diagonal
            && lines.clone().all(is_open)
            && (self.lines.len() > 1 || lines.all(winds))
    }

    /// Whether it is one outline, wide and with bows.
    fn is_cloud(&self, page: &Page) -> bool {
        let [line] = self.lines[..] else { return false };
        let line = &page.lines[line];
        line.openness < OPEN.0
            && line.size().x > CLOUD.0 * line.size().y
            && notches(&line.points).len() >= CLOUD.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::{line, read_by};
    use std::f32::consts::{PI, TAU};

    /// A crown on a trunk of two lines, its foot at the origin.
    fn tree() -> Vec<Vec<Vec2>> {
        let crown = (0..=60).map(|k| {
            let angle = TAU * k as f32 / 60.0;
            Vec2::new(0.0, -160.0) + (80.0 + 6.0 * (7.0 * angle).sin()) * Vec2::from_angle(angle)
        });
        vec![crown.collect(), line(&[(-12.0, -85.0), (-14.0, 0.0)]), line(&[(12.0, -85.0), (14.0, 0.0)])]
    }

    fn ring(x: f32, y: f32, radius: Vec2) -> Vec<Vec2> {
        (0..=40).map(|k| Vec2::new(x, y) + radius * Vec2::from_angle(TAU * k as f32 / 40.0)).collect()
    }

    /// Places in the list of what is beside the tree, and as what it is set apart.
    fn apart(beside: Vec<Vec<Vec2>>) -> Vec<(Reading, Vec<usize>)> {
        let found = read_by(propose, &[tree(), beside].concat());
        found.into_iter().map(|it| (it.reading, it.uses.iter().map(|i| i - 3).collect())).collect()
    }

    #[test]
    fn a_disc_with_rays_is_the_sun() {
        let ray = |k: usize| {
            let along = Vec2::from_angle(TAU * k as f32 / 7.0);
            vec![Vec2::new(170.0, -250.0) + 20.0 * along, Vec2::new(170.0, -250.0) + 34.0 * along]
        };
        let sun = std::iter::once(ring(170.0, -250.0, Vec2::splat(15.0))).chain((0..7).map(ray)).collect();
        assert_eq!(apart(sun), [(Reading::Sun, (0..8).collect())]);
    }

    #[test]
    fn birds_clouds_and_letters_are_in_the_sky() {
        let wing = |x: f32| {
            (0..=12).map(move |k| Vec2::new(x, -250.0) + 14.0 * Vec2::from_angle(PI + PI * k as f32 / 12.0))
        };
        let bird = wing(160.0).chain(wing(188.0)).collect();
        let cloud = (0..=72).map(|k| {
            let angle = TAU * k as f32 / 72.0;
            Vec2::new(-180.0, -250.0)
                + (1.0 + 0.2 * (4.0 * angle).sin().abs()) * Vec2::new(36.0, 16.0) * Vec2::from_angle(angle)
        });
        assert_eq!(apart(vec![bird, cloud.collect()]), [(Reading::Sky, vec![0, 1])]);
        let t = [line(&[(150.0, -140.0), (170.0, -140.0)]), line(&[(160.0, -140.0), (160.0, -110.0)])];
        let word = [t.to_vec(), vec![ring(200.0, -125.0, Vec2::new(9.0, 15.0))]].concat();
        assert_eq!(apart(word), [(Reading::Sky, vec![0, 1, 2])]);
    }

    #[test]
    fn what_may_belong_to_a_plant_stays() {
        assert!(
            apart(vec![ring(180.0, -150.0, Vec2::splat(20.0))]).is_empty(),
            "a head whose stem comes next"
        );
        assert!(apart(vec![line(&[(150.0, -120.0), (190.0, -180.0)])]).is_empty(), "a twig");
        let stem = line(&[(200.0, 0.0), (200.0, -120.0)]);
        let ray = |k: usize| {
            let along = Vec2::from_angle(TAU * k as f32 / 7.0);
            vec![Vec2::new(200.0, -190.0) + 20.0 * along, Vec2::new(200.0, -190.0) + 34.0 * along]
        };
        let flower = [vec![stem, ring(200.0, -190.0, Vec2::splat(15.0))], (0..7).map(ray).collect()].concat();
        assert!(apart(flower).is_empty(), "a head over its stem");
        assert!(
            apart(vec![line(&[(-20.0, -160.0), (0.0, -150.0), (20.0, -165.0), (10.0, -150.0)])]).is_empty(),
            "foliage"
        );
    }
}
