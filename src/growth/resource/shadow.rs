//! Light as the resource, estimated by shadows that fall through voxels (001 §2.2, eq. 2.2).
//!
//! A node in voxel (I, J, K) darkens a pyramid below itself: in the layer q below, for q = 0 … q_max, the voxels up to
//! q away in x and z, each by Δs = a·b^−q. A bud in a voxel of shadow s gets Q = max(C − s + a, 0), a because no bud
//! shades itself; it would grow along the negative gradient of s, or toward the least s of the 26 voxels around its own
//! (001 §2.2 has both; there only voxels that the bud perceives count, here those behind it do too).
//!
//! Where light comes from one side (ours), each layer of the pyramid lies a little further to the other side than the one above it.
//!
//! Shadows are whole numbers of a small unit, so what is added can be taken away again without a trace and the order of
//! adding does not matter. The unit is [`FINEST`], or larger where the darkest voxel that the plant's nodes could make
//! together would not fit into 32 bits otherwise. The grid grows with the plant.

use crate::growth::habit::{LightHabit, Toward};
use glam::{IVec2, IVec3, Vec2, Vec3};

/// Units of shadow in a shadow of 1, at most.
pub(crate) const FINEST: f32 = 65536.0;
/// Voxels beyond the plant that a grid is made larger by, at least.
const MARGIN: i32 = 4;
/// Farthest voxel from the origin, by its number along an axis.
const FARTHEST: f32 = 1e8;

/// Voxels with their shadows.
#[derive(Clone, Debug)]
pub struct Shadow {
    voxel: f32,
    low: IVec3,
    size: IVec3,
    /// Voxels along x follow each other, then along z, then along y.
    dark: Vec<u32>,
    /// Shadow of one node by layer.
    layers: Vec<u32>,
    /// How far to the side each layer lies, voxels along x and z.
    aside: Vec<IVec2>,
    /// Units of shadow in a shadow of 1.
    units: f32,
    /// Nodes that cast shadows now.
    nodes: u32,
    full: f32,
    own: f32,
    toward: Toward,
}

/// Adds or takes away.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// A node has grown.
    Grown,
    /// A node was shed.
    Shed,
}

impl Shadow {
    /// An empty grid with voxels of the given width in metres, for the shadows of about `nodes` nodes.
    pub fn new(light: &LightHabit, voxel: f32, nodes: usize) -> Self {
        // All nodes may stand in one voxel; the hundredth more is for rounding.
        let darkest = f64::from(light.darkening.max(f32::MIN_POSITIVE)) * nodes.max(1) as f64 * 1.01;
        let units = (f64::from(u32::MAX) / darkest).min(f64::from(FINEST)) as f32;
        let layer = |q: u32| (light.darkening * light.falloff.powi(-(q as i32)) * units).round() as u32;
        let (sin, cos) = light.side.to_radians().sin_cos();
        let aside = |q: u32| (Vec2::new(cos, sin) * (-light.slant * q as f32)).round().as_ivec2();
        Self {
            voxel,
            low: IVec3::ZERO,
            size: IVec3::ZERO,
            dark: Vec::new(),
            layers: (0..=light.depth).map(layer).collect(),
            aside: (0..=light.depth).map(aside).collect(),
            units,
            nodes: 0,
            full: light.full,
            own: light.darkening,
            toward: light.toward,
        }
    }

    fn place(&self, p: Vec3) -> IVec3 {
        (p / self.voxel).floor().as_ivec3()
    }

    fn index(&self, place: IVec3) -> Option<usize> {
        let q = place - self.low;
        let inside = q.cmpge(IVec3::ZERO).all() && q.cmplt(self.size).all();
        inside.then(|| ((q.y * self.size.z + q.z) * self.size.x + q.x) as usize)
    }

    /// Adds or takes away the shadow of a node. Where that needs more than `most` voxels, or more nodes cast shadows
    /// than can be counted, nothing happens and the answer is no.
    #[must_use]
    pub fn cast(&mut self, p: Vec3, change: Change, most: usize) -> bool {
        if !p.is_finite() || (p / self.voxel).abs().max_element() >= FARTHEST {
            return false;
        }
        // No voxel holds more than the darkest layers of all nodes, so no sum is ever cut off.
        let most_nodes = u32::MAX / self.layers[0].max(1);
        let nodes = match change {
            Change::Grown => self.nodes.checked_add(1).filter(|nodes| *nodes <= most_nodes),
            Change::Shed => self.nodes.checked_sub(1),
        };
        let Some(nodes) = nodes else { return false };
        let top = self.place(p);
        let depth = self.layers.len() as i32 - 1;
        let farthest = self.aside.last().map_or(0, |aside| aside.abs().max_element());
        let reach = IVec3::new(depth + farthest + 1, 0, depth + farthest + 1);
        if !self.make_room(top - reach - IVec3::Y * (depth + 1), top + reach + IVec3::Y, most) {
            return false;
        }
        self.nodes = nodes;
        for ((q, &layer), aside) in (0..).zip(&self.layers).zip(&self.aside) {
            let middle = top + IVec3::new(aside.x, -q, aside.y) - self.low;
            for z in middle.z - q..=middle.z + q {
                let row = (middle.y * self.size.z + z) * self.size.x;
                let first = (row + middle.x - q) as usize;
                let voxels = &mut self.dark[first..=first + 2 * q as usize];
                match change {
                    Change::Grown => voxels.iter_mut().for_each(|s| *s = s.saturating_add(layer)),
                    Change::Shed => voxels.iter_mut().for_each(|s| *s = s.saturating_sub(layer)),
                }
            }
        }
        true
    }

    /// Makes the grid hold the places from `low` to `high`; no if that takes too many voxels.
    fn make_room(&mut self, low: IVec3, high: IVec3, most: usize) -> bool {
        let end = self.low + self.size;
        if self.size.x > 0 && low.cmpge(self.low).all() && high.cmplt(end).all() {
            return true;
        }
        let (mut new_low, mut new_end) = (low - MARGIN, high + MARGIN + 1);
        if self.size.x > 0 {
            // Half as much again on every side that was too near, so that moving the voxels stays rare.
            let more = self.size / 2 + MARGIN;
            new_low = IVec3::select(low.cmplt(self.low), low.min(self.low - more), self.low);
            new_end = IVec3::select(high.cmpge(end), (high + 1).max(end + more), end);
        }
        let size = new_end - new_low;
        let count = size.as_dvec3().element_product();
        if count > most as f64 {
            return false;
        }
        let mut dark = vec![0; count as usize];
        for y in 0..self.size.y {
            for z in 0..self.size.z {
                let from = ((y * self.size.z + z) * self.size.x) as usize;
                let q = self.low - new_low + IVec3::new(0, y, z);
                let to = ((q.y * size.z + q.z) * size.x + q.x) as usize;
                let width = self.size.x as usize;
                dark[to..to + width].copy_from_slice(&self.dark[from..from + width]);
            }
        }
        (self.low, self.size, self.dark) = (new_low, size, dark);
        true
    }

    /// The shadow s at a point.
    pub fn shadow(&self, p: Vec3) -> f32 {
        self.index(self.place(p)).map_or(0.0, |i| self.dark[i] as f32 / self.units)
    }

    /// The exposure Q of a bud, eq. 2.2, as a share of full light.
    pub fn exposure(&self, p: Vec3) -> f32 {
        ((self.full - self.shadow(p) + self.own) / self.full).clamp(0.0, 1.0)
    }

    /// The direction in which a bud finds more light as its species looks for it, of length 0 to 1.
    pub fn lighter(&self, p: Vec3) -> Vec3 {
        match self.toward {
            Toward::Gradient => self.away(p),
            Toward::Least => self.lightest(p),
        }
    }

    /// The shadows of the voxels next to a point's own, and the steps to them; there is none outside the grid.
    fn around(&self, p: Vec3) -> impl Iterator<Item = (Vec3, u32)> + '_ {
        let place = self.place(p);
        let steps = (0..27).filter(|k| *k != 13).map(|k| IVec3::new(k % 3 - 1, k / 9 - 1, k / 3 % 3 - 1));
        steps.map(move |step| (step.as_vec3(), self.index(place + step).map_or(0, |i| self.dark[i])))
    }

    /// The direction of the lightest of the 26 voxels next to a point's own, of length 0 to 1: the mean of all that are
    /// as light, so short where they lie on opposite sides, and where the others are hardly darker.
    pub fn lightest(&self, p: Vec3) -> Vec3 {
        let least = self.around(p).map(|(_, dark)| dark).min().unwrap_or(0);
        let (mut sum, mut count, mut darker) = (Vec3::ZERO, 0.0, 0.0);
        for (step, dark) in self.around(p) {
            if dark == least {
                sum += step.normalize();
                count += 1.0;
            }
            darker += (dark - least) as f32 / (26.0 * self.units);
        }
        sum / count * (darker / (darker + 0.05 * self.full))
    }

    /// The direction in which shadow falls most steeply, of length 0 to 1: short where there is little shadow.
    pub fn away(&self, p: Vec3) -> Vec3 {
        let place = self.place(p);
        let mut sum = Vec3::ZERO;
        for y in -1..=1 {
            for z in -1..=1 {
                for x in -1..=1 {
                    let step = IVec3::new(x, y, z);
                    let Some(i) = self.index(place + step) else { continue };
                    sum -= step.as_vec3() * (self.dark[i] as f32 / self.units);
                }
            }
        }
        let slope = sum / 18.0;
        slope / (slope.length() + 0.05 * self.full)
    }

    /// Full light C.
    pub fn full(&self) -> f32 {
        self.full
    }

    /// Width of a voxel, metres.
    pub fn voxel(&self) -> f32 {
        self.voxel
    }

    /// The middle of every voxel with at least this shadow, and the exposure of a bud there.
    pub fn shaded(&self, least: f32) -> impl Iterator<Item = (Vec3, f32)> + '_ {
        let least = ((least * self.units) as u32).max(1);
        let dark = self.dark.iter().enumerate().filter(move |(_, dark)| **dark >= least);
        dark.map(|(i, _)| {
            let (row, x) = (i as i32 / self.size.x, i as i32 % self.size.x);
            let place = self.low + IVec3::new(x, row / self.size.z, row % self.size.z);
            let middle = (place.as_vec3() + 0.5) * self.voxel;
            (middle, self.exposure(middle))
        })
    }

    /// Number of voxels that the shadow of one node darkens.
    pub fn voxels_per_node(&self) -> u64 {
        (0..self.layers.len() as u64).map(|q| (2 * q + 1) * (2 * q + 1)).sum()
    }

    /// Number of voxels.
    pub fn len(&self) -> usize {
        self.dark.len()
    }

    /// Whether nothing has cast a shadow yet.
    pub fn is_empty(&self) -> bool {
        self.dark.is_empty()
    }

    /// Takes all shadows away.
    pub fn clear(&mut self) {
        self.dark.fill(0);
        self.nodes = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Shadow {
        let light = LightHabit { darkening: 0.2, falloff: 2.0, depth: 3, ..LightHabit::default() };
        Shadow::new(&light, 1.0, 1000)
    }

    #[test]
    fn a_node_darkens_a_pyramid_below_itself() {
        let mut shadow = grid();
        assert!(shadow.cast(Vec3::new(0.5, 5.5, 0.5), Change::Grown, 1 << 20));
        let at = |x: f32, y: f32| shadow.shadow(Vec3::new(x + 0.5, y + 0.5, 0.5));
        for (x, y, s) in
            [(0.0, 5.0, 0.2), (0.0, 6.0, 0.0), (1.0, 5.0, 0.0), (1.0, 4.0, 0.1), (-3.0, 2.0, 0.025)]
        {
            assert!((at(x, y) - s).abs() < 1e-4, "{} instead of {s} at {x}, {y}", at(x, y));
        }
        assert_eq!([at(4.0, 2.0), at(0.0, 1.0)], [0.0, 0.0]);
        // Nobody shades itself.
        assert!((shadow.exposure(Vec3::new(0.5, 5.5, 0.5)) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn slanting_light_casts_shadows_to_the_other_side() {
        let light = LightHabit { depth: 3, slant: 1.5, side: 90.0, ..LightHabit::default() };
        let mut shadow = Shadow::new(&light, 1.0, 10);
        let at = Vec3::new(0.5, 9.5, 0.5);
        assert!(shadow.cast(at, Change::Grown, 1 << 20));
        let deepest = |shadow: &Shadow, z: f32| shadow.shadow(Vec3::new(0.5, 6.5, z));
        assert!(
            deepest(&shadow, -4.5) > 0.0 && deepest(&shadow, -1.4) > 0.0,
            "three layers down it lies four or five voxels behind"
        );
        assert_eq!((deepest(&shadow, 0.5), deepest(&shadow, 4.5)), (0.0, 0.0));
        assert!(
            shadow.shadow(at) > 0.0 && shadow.away(at - Vec3::Y).z > 0.0,
            "lighter where the light comes from"
        );
        assert!(shadow.cast(at, Change::Shed, 1 << 20) && deepest(&shadow, -4.5) == 0.0);
    }

    #[test]
    fn shadows_go_without_a_trace_and_away_points_to_the_light() {
        let mut shadow = grid();
        let nodes: Vec<Vec3> = (0..40).map(|k| Vec3::new(k as f32 * 1.7, (k % 7) as f32, 0.3)).collect();
        assert!(nodes.iter().all(|p| shadow.cast(*p, Change::Grown, 1 << 20)));
        assert!(shadow.away(Vec3::new(20.0, 1.5, 2.0)).z > 0.05);
        assert!(nodes.iter().rev().all(|p| shadow.cast(*p, Change::Shed, 1 << 20)));
        assert!(shadow.dark.iter().all(|s| *s == 0));
    }

    #[test]
    fn the_lightest_voxel_wins_and_equals_pull_alike() {
        let light = LightHabit {
            darkening: 0.2,
            falloff: 2.0,
            depth: 3,
            toward: Toward::Least,
            ..LightHabit::default()
        };
        let mut shadow = Shadow::new(&light, 1.0, 1000);
        let bud = Vec3::splat(0.5);
        assert_eq!(shadow.lighter(bud), Vec3::ZERO, "nothing is darker than anything");
        // A roof over all of the voxels above but the one before and to the left: only light from there comes in.
        let gap = Vec3::new(-1.0, 1.0, 1.0);
        let cast = |shadow: &mut Shadow, at: Vec3| assert!(shadow.cast(bud + at, Change::Grown, 1 << 20));
        let ring = |y: f32| (0..9).map(move |k: i8| Vec3::new(f32::from(k % 3 - 1), y, f32::from(k / 3 - 1)));
        for at in ring(1.0).filter(|at| *at != gap) {
            cast(&mut shadow, at);
        }
        let way = shadow.lighter(bud);
        assert!(way.normalize().abs_diff_eq(gap.normalize(), 1e-4) && way.length() > 0.3, "{way}");
        let mean = shadow.away(bud).normalize();
        assert!(mean.dot(gap.normalize()) < 0.9, "the gradient knows no gap: {mean}");
        // With the same gap on the other side both pull alike.
        let both = gap * Vec3::new(-1.0, 1.0, 1.0);
        let mut two = Shadow::new(&light, 1.0, 1000);
        for at in ring(1.0).filter(|at| *at != gap && *at != both) {
            cast(&mut two, at);
        }
        let way = two.lighter(bud);
        assert!(way.x == 0.0 && way.y > 0.0 && way.z > 0.0 && way.y == way.z, "{way}");
    }

    #[test]
    fn many_dark_nodes_in_one_voxel_never_turn_to_light() {
        let light = LightHabit { darkening: 10.0, falloff: 1.01, depth: 1, ..LightHabit::default() };
        for nodes in [20_000, 5_000_000] {
            let mut shadow = Shadow::new(&light, 1.0, nodes);
            let first = shadow.layers[0];
            assert!(
                (first as f32 / shadow.units - 10.0).abs() < 0.02,
                "{} for 10",
                first as f32 / shadow.units
            );
            // As if all but the last thousand had grown.
            assert!(shadow.cast(Vec3::splat(0.5), Change::Grown, 1 << 20));
            let before = nodes as u32 - 1000;
            shadow.dark.iter_mut().for_each(|s| *s *= before);
            shadow.nodes = before;
            let mut last = shadow.shadow(Vec3::splat(0.5));
            for _ in 0..1000 {
                assert!(shadow.cast(Vec3::splat(0.5), Change::Grown, 1 << 20));
                let now = shadow.shadow(Vec3::splat(0.5));
                assert!(now >= last && shadow.exposure(Vec3::splat(0.5)) == 0.0);
                last = now;
            }
            assert!((last / (10.0 * nodes as f32) - 1.0).abs() < 0.01, "{last} of {nodes} nodes");
            let more = (0..u32::MAX).take_while(|_| shadow.cast(Vec3::splat(0.5), Change::Grown, 1 << 20));
            assert!(
                more.count() < nodes && shadow.shadow(Vec3::splat(0.5)) >= last,
                "refused before it wraps"
            );
        }
    }

    #[test]
    fn a_grid_that_would_be_too_large_is_refused() {
        let mut shadow = grid();
        assert!(shadow.cast(Vec3::ZERO, Change::Grown, 10_000));
        assert!(!shadow.cast(Vec3::splat(1e6), Change::Grown, 10_000));
        assert!((shadow.shadow(Vec3::splat(0.1)) - 0.2).abs() < 1e-4);
    }
}
