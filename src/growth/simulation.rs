//! The plant through its years (001 fig. 2.1 b): sense, share out, decide, grow, shed.
//!
//! A [`Simulation`] is stepped year by year. All ages stay in its [`Tree`]; it can go back to any of them and grow on
//! from there, and the same seed gives the same tree whether or not it went back and on any number of threads: what is
//! done on many cores (scattering markers, sensing) does not depend on order, and nodes are added one after the other.
//!
//! Where we depart: a bud's length budget is cut at the habit's longest shoot; a shoot that would leave the envelope
//! turns to where its markers are, and ends if that does not help.

mod beside;
pub(super) mod effort;
pub(super) mod fit;
mod skeleton;

use self::beside::Beside;
use self::effort::Effort;
use self::fit::fitted;
use super::habit::{Arrangement, Control, CrownHabit, Habit, Resource};
use super::limits::{Limits, Outcome};
use super::obstacle::{Contact, Obstacles};
use super::resource::competition::{self, Crowd, Found};
use super::resource::field::{Field, field_for, lowest, perception};
use super::resource::priority::{self, Priority};
use super::resource::shadow::{Change, Shadow};
use super::resource::vigour::Flow;
use super::tree::{Fate, NONE, NewNode, Tree};
use super::volume::{Crown, Envelope, Lamp, Swept};
use super::year::direction::{self, Weights};
use super::year::fate::{self, Waiting};
use super::year::shedding;
use crate::plant::Plant;
use crate::random::{Choice, mix};
use glam::Vec3;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

/// Oldest age.
pub(super) const MAX_AGE: u16 = 10_000;
/// Open buds from which sensing light is worth several threads.
const MANY: usize = 4096;
/// Buds or nodes after which it is asked whether to stop.
const BREATH: usize = 64;
/// Questions of an internode to the volume that holds it, at most: for two directions, at its foot and in four places.
const QUESTIONS: u64 = 10;

/// Memory that is used again every year.
#[derive(Clone, Debug, Default)]
struct Scratch {
    at: Vec<Vec3>,
    look: Vec<Vec3>,
    found: Found,
    flow: Flow,
}

/// A plant that grows.
#[derive(Clone, Debug)]
pub struct Simulation {
    habit: Habit,
    envelope: Envelope,
    /// What stands beside it.
    beside: Beside,
    /// Light beside that of the sky.
    lamps: Vec<Lamp>,
    limits: Limits,
    seed: u64,
    tree: Tree,
    field: Field,
    year: u16,
    /// What its years have cost.
    effort: Effort,
    scratch: Scratch,
}

impl Simulation {
    /// A seed at the origin that grows in the species' own crown, or freely where it has none.
    pub fn new(habit: &Habit, seed: u64, limits: Limits) -> Self {
        let envelope = own_crown(habit, Vec3::ZERO, seed);
        let mut tree = Tree::default();
        skeleton::sow(&mut tree, habit, Vec3::ZERO, seed);
        let field = field_for(habit, habit.resource, &envelope, limits, seed);
        Self::begin(habit.clone(), envelope, field, limits, seed, tree)
    }

    /// A plant that fills a given volume: a trunk from the ground below it, then competition for the space inside.
    /// Where the volume is small for the species its internodes are shortened.
    pub fn in_envelope(habit: &Habit, envelope: Envelope, seed: u64, limits: Limits) -> Self {
        let habit = fitted(habit, &envelope, None);
        let field = field_for(&habit, Resource::Space, &envelope, limits, seed);
        let mut tree = Tree::default();
        let crown = match &field {
            Field::Space(markers) => lowest(markers),
            Field::Light(_) => None,
        };
        match crown {
            Some(crown) => {
                let ground = crown.y.min(0.0);
                skeleton::trunk(&mut tree, &habit, crown.with_y(ground), crown, seed);
            }
            None => skeleton::sow(&mut tree, &habit, Vec3::ZERO, seed),
        }
        Self::begin(habit, envelope, field, limits, seed, tree)
    }

    /// A plant that goes on from drawn branches, inside a volume or, where that is everywhere, a single trunk in the
    /// species' own crown. A plant without branches is a seed.
    pub fn from_skeleton(
        habit: &Habit,
        plant: &Plant,
        envelope: Envelope,
        seed: u64,
        limits: Limits,
    ) -> Self {
        if plant.branches.is_empty() {
            return match envelope {
                Envelope::Free => Self::new(habit, seed, limits),
                volume => Self::in_envelope(habit, volume, seed, limits),
            };
        }
        let thickest = plant.branches.iter().flat_map(|b| &b.radii).copied().fold(0.0, f32::max);
        let (habit, envelope, resource) = match envelope {
            Envelope::Free => {
                let mut trunks = plant.branches.iter().filter(|b| b.parent.is_none());
                match (trunks.next().and_then(|b| b.points.first()), trunks.next(), &habit.crown) {
                    (Some(foot), None, Some(_)) => {
                        (habit.clone(), own_crown(habit, *foot, seed), habit.resource)
                    }
                    // One crown would bind all trunks.
                    _ => (habit.clone(), Envelope::Free, Resource::Light),
                }
            }
            volume => (fitted(habit, &volume, Some(2.0 * thickest)), volume, Resource::Space),
        };
        let tree = skeleton::of_plant(plant, &habit, seed);
        let field = field_for(&habit, resource, &envelope, limits, seed);
        Self::begin(habit, envelope, field, limits, seed, tree)
    }

    /// A plant of which what a brush sweeps is filled; the habit is fitted to it already.
    pub fn in_swept(habit: &Habit, plant: &Plant, swept: Arc<Swept>, seed: u64, limits: Limits) -> Self {
        let tree = skeleton::of_plant(plant, habit, seed);
        let envelope = Envelope::Swept(swept);
        let field = field_for(habit, Resource::Space, &envelope, limits, seed);
        Self::begin(habit.clone(), envelope, field, limits, seed, tree)
    }

    /// The same plant from its beginning, with painted light.
    #[must_use]
    pub fn lit(mut self, lamps: Vec<Lamp>) -> Self {
        self.rewind(0);
        self.lamps = lamps;
        self
    }

    /// The same plant from its beginning, among obstacles.
    #[must_use]
    pub fn among(mut self, obstacles: Arc<Obstacles>) -> Self {
        self.rewind(0);
        self.beside = Beside::new(obstacles, &self.habit);
        match &mut self.field {
            Field::Light(shadow) => {
                let (light, most) = (&self.habit.light, self.limits.internodes + self.beside.shading());
                *shadow = Shadow::new(light, light.voxel * self.habit.internode, most);
                cast_anew(shadow, &self.tree, 0, self.limits.voxels, &self.beside);
            }
            Field::Space(markers) => self.beside.clear(markers, &self.habit),
        }
        self
    }

    fn begin(habit: Habit, envelope: Envelope, field: Field, limits: Limits, seed: u64, tree: Tree) -> Self {
        let scratch = Scratch::default();
        let effort = Effort::new(limits.steps);
        let (beside, lamps) = (Beside::default(), Vec::new());
        let mut simulation =
            Self { habit, envelope, beside, lamps, limits, seed, tree, field, year: 0, effort, scratch };
        // Where there is no room for the first shadows there is none for the first year either, which says so; nor are
        // there steps for it where there are none for these.
        let _ = simulation.settle_in(0..simulation.tree.len(), &|| false);
        simulation.effort.end_year();
        simulation
    }

    /// The plant with its history.
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// How it grows; its internodes may be shorter than the species' if it was fitted into a volume.
    pub fn habit(&self) -> &Habit {
        &self.habit
    }

    /// The volume that it may fill.
    pub fn envelope(&self) -> &Envelope {
        &self.envelope
    }

    /// What stands beside it.
    pub fn obstacles(&self) -> Option<&Arc<Obstacles>> {
        self.beside.obstacles()
    }

    /// The surface that wood of a climbing species holds on to at a place; nothing for other species.
    pub(super) fn held_at(&self, p: Vec3) -> Option<Contact> {
        self.beside.held_at(p, &self.habit)
    }

    /// What its buds compete for, for overlays.
    pub fn field(&self) -> &Field {
        &self.field
    }

    /// Age in years.
    pub fn age(&self) -> u16 {
        self.year
    }

    /// Elementary steps that its years have taken.
    pub fn steps(&self) -> u64 {
        self.effort.spent()
    }

    /// What it may not exceed.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Seed of everything random.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Grows until an age. `stop` is asked several times a year; a year that is stopped did not happen.
    pub fn grow_to(&mut self, age: u16, stop: &dyn Fn() -> bool) -> Outcome {
        let mut outcome = Outcome::Growing;
        while self.year < age && outcome.may_go_on() {
            outcome = self.step(stop);
        }
        outcome
    }

    /// Goes back to the end of a year; growing on from there gives the same plant again.
    pub fn rewind(&mut self, age: u16) {
        if age >= self.year {
            return;
        }
        self.tree.rewind(age);
        self.year = age;
        self.effort.rewind(age);
        match &mut self.field {
            Field::Space(markers) => markers.rewind(age),
            Field::Light(shadow) => cast_anew(shadow, &self.tree, age, self.limits.voxels, &self.beside),
        }
    }

    /// Shadows as they were at the end of a year; `now` are this plant's.
    pub(super) fn shadow_at<'a>(&self, now: &'a Shadow, year: u16) -> Cow<'a, Shadow> {
        let mut shadow = Cow::Borrowed(now);
        if year < self.year {
            cast_anew(shadow.to_mut(), &self.tree, year, self.limits.voxels, &self.beside);
        }
        shadow
    }

    /// Grows for a year; `stop` is asked many times. A year that is stopped, or that would take too many steps, did not
    /// happen.
    pub fn step(&mut self, stop: &dyn Fn() -> bool) -> Outcome {
        if self.year >= MAX_AGE {
            return Outcome::TooOld(MAX_AGE);
        }
        if self.tree.open.is_empty() {
            return Outcome::Finished;
        }
        if self.tree.len() >= self.limits.internodes {
            return Outcome::TooManyInternodes(self.limits.internodes);
        }
        let (before, first) = (self.year, self.tree.len());
        let grown = self.grow_year(first, stop);
        if let Err(outcome @ (Outcome::Stopped | Outcome::TooManySteps(_))) = grown {
            self.rewind(before);
            self.effort.rewind(before);
            return outcome;
        }
        self.effort.end_year();
        if let Err(outcome) = grown {
            return outcome;
        }
        if self.tree.len() >= self.limits.internodes {
            return Outcome::TooManyInternodes(self.limits.internodes);
        }
        Outcome::Growing
    }

    /// A year of a plant that had `first` nodes before it.
    fn grow_year(&mut self, first: usize, stop: &dyn Fn() -> bool) -> Result<(), Outcome> {
        if stop() {
            return Err(Outcome::Stopped);
        }
        let (nodes, buds) = (first as u64, self.tree.open.len() as u64);
        self.effort.spend(nodes * effort::NODE + buds * effort::BUD)?;
        self.sense()?;
        if stop() {
            return Err(Outcome::Stopped);
        }
        self.share_out();
        self.year += 1;
        self.grow(stop)?;
        self.settle_in(first..self.tree.len(), stop)?;
        let dead = shedding::shed(&mut self.tree, &self.scratch.flow, &self.habit, self.year);
        if let Field::Light(shadow) = &mut self.field {
            self.effort.spend(dead.len() as u64 * shadow_steps(shadow))?;
            for node in dead {
                // What was grown has room.
                let _ = shadow.cast(self.tree.nodes.at[node as usize], Change::Shed, self.limits.voxels);
            }
        }
        Ok(())
    }

    /// What each open bud earns, and where more is.
    fn sense(&mut self) -> Result<(), Outcome> {
        let Scratch { at, look, found, .. } = &mut self.scratch;
        let (tree, habit) = (&self.tree, &self.habit);
        at.clear();
        at.extend(tree.open.iter().map(|&b| tree.nodes.at[tree.buds.node[b as usize] as usize]));
        match &self.field {
            Field::Light(shadow) => {
                let one = |p: &Vec3| (shadow.exposure(*p), shadow.lighter(*p));
                if at.len() < MANY {
                    (found.q, found.best) = at.iter().map(one).unzip();
                } else {
                    (found.q, found.best) = at.par_iter().map(one).unzip();
                }
            }
            Field::Space(markers) => {
                look.clear();
                look.extend(tree.open.iter().map(|&b| tree.buds.direction[b as usize]));
                self.effort.spend(markers.grid.len() as u64)?;
                let crowd = Crowd::new(markers, at, look);
                self.effort.spend(crowd.comparisons(markers))?;
                competition::compete(markers, perception(habit), &crowd, found);
                let led = found.best.iter_mut().zip(at.iter());
                match &self.envelope {
                    Envelope::Inflated(crown) => led.for_each(|(best, at)| *best = crown.led(*at, *best)),
                    Envelope::Swept(swept) => {
                        let reach = perception(habit).radius;
                        led.for_each(|(best, at)| *best = swept.led(*at, *best, reach));
                    }
                    _ => {}
                }
            }
        }
        for lamp in &self.lamps {
            self.effort.spend(at.len() as u64 * lamp.steps())?;
            for ((at, q), best) in at.iter().zip(&mut found.q).zip(&mut found.best) {
                (*q, *best) = lamp.shine(*at, (*q, *best));
            }
        }
        Ok(())
    }

    fn share_out(&mut self) {
        let Scratch { found, flow, .. } = &mut self.scratch;
        let (habit, age) = (&self.habit, f32::from(self.year));
        flow.gather(&self.tree, &found.q);
        let supply = habit.supply.at(age);
        match habit.control {
            Control::BorchertHonda => {
                let (trunk, branch) = (habit.lambda.at(age), habit.lambda_branch.at(age));
                let lambda = |order| if order == 0 { trunk } else { branch };
                flow.share_out(&self.tree, &found.q, supply, lambda);
            }
            Control::Priority => {
                let most = habit.omega_max.at(age);
                let rule = Priority {
                    kappa: habit.kappa.at(age),
                    most,
                    least: habit.omega_min.at(age).min(most),
                    apical_first: habit.apical_first,
                };
                priority::share_out(flow, &self.tree, &found.q, supply, |_| rule);
            }
        }
    }

    /// Decides the fate of all open buds and lets those grow that may; ends in the middle of it where it is stopped or
    /// takes too many steps.
    fn grow(&mut self, stop: &dyn Fn() -> bool) -> Result<(), Outcome> {
        let waiting = self.tree.open.len();
        let each = effort::INTERNODE + QUESTIONS * (self.envelope.steps() + self.beside.steps());
        for place in 0..waiting {
            if place % BREATH == 0 && stop() {
                return Err(Outcome::Stopped);
            }
            let (bud, before) = (self.tree.open[place], self.tree.len());
            let b = bud as usize;
            let state = Waiting {
                v: self.scratch.flow.bud[place],
                waited: self.year - self.tree.buds.born[b],
                apical: self.tree.buds.apical[b],
                age: f32::from(self.year),
                key: mix(mix(Choice::BUD.key(self.seed), u64::from(bud)), u64::from(self.year)),
            };
            let fate = match fate::decide(&state, &self.habit) {
                Fate::Shoot => self.shoot(bud, self.scratch.found.best[place], &state),
                other => other,
            };
            if fate != Fate::Dormant {
                self.tree.settle(bud, fate, self.year);
            }
            // A shoot that found no room has asked, too.
            let asked = (self.tree.len() - before) as u64 + u64::from(fate != Fate::Dormant);
            self.effort.spend(asked * each)?;
        }
        self.tree.forget_settled();
        Ok(())
    }

    /// Grows the internodes of one bud; [`Fate::Aborted`] if there is no room for any.
    fn shoot(&mut self, bud: u32, best: Vec3, state: &Waiting) -> Fate {
        let Some((count, stretch)) = fate::shoot(state.v, self.habit.shoot) else { return Fate::Dormant };
        let mut node = self.tree.buds.node[bud as usize];
        let mut way = self.tree.buds.direction[bud as usize];
        let order = self.tree.nodes.order[node as usize].saturating_add(u8::from(!state.apical));
        let weights = Weights::of(&self.habit, order, state.age);
        let length = self.habit.internode * self.habit.shorter.at(state.age).powi(i32::from(order)) * stretch;
        let mut side = match state.apical {
            true => self.tree.nodes.side[node as usize],
            false => direction::first_side(way, state.key, &self.habit),
        };
        let mut grown = 0;
        for k in 0..count {
            if self.tree.len() >= self.limits.internodes {
                break;
            }
            let key = mix(state.key, u64::from(k));
            let from = self.tree.nodes.at[node as usize];
            let wanted = weights.next(way, best, key);
            let wanted =
                self.beside.climbing_way((&self.tree, node), wanted, length, (&self.habit, state.age));
            let Some(next) = wanted.and_then(|way| self.way_on(from, way, best, length, order)) else {
                break;
            };
            let lateral = k == 0 && !state.apical;
            let at = from + next * length;
            side = direction::next_side(side, (way, next), (order, state.age), &self.habit);
            side = self.beside.climbing_side(at, side, next, &self.habit);
            way = next;
            node = self.tree.add(NewNode { parent: node, at, side, lateral, year: self.year });
            grown += 1;
            if self.habit.arrangement != Arrangement::Whorl || k + 1 == count {
                self.lay_laterals(node, way, side, key, state.age);
            }
        }
        if grown == 0 {
            return Fate::Aborted;
        }
        self.tree.add_bud(node, way, true, self.year);
        Fate::Shoot
    }

    /// The direction that an internode takes; none if there is no room for it.
    fn way_on(&self, from: Vec3, way: Vec3, best: Vec3, length: f32, order: u8) -> Option<Vec3> {
        let clearance = self.habit.clearance.at(f32::from(self.year));
        let free = |way: Vec3| {
            let to = from + way * length;
            let above = to.y >= clearance.min(from.y) || to.y >= from.y;
            above && self.may_grow(from, to, order)
        };
        if free(way) {
            return Some(way);
        }
        if let Some(aside) = self.beside.aside(from, way).filter(|way| free(*way)) {
            return Some(aside);
        }
        let turned = (best * 2.0 + way * 0.5).try_normalize()?;
        (best != Vec3::ZERO && free(turned)).then_some(turned)
    }

    /// What is inside stays inside; only a trunk may be on its way there, and not to what a brush sweeps.
    fn may_grow(&self, from: Vec3, to: Vec3, order: u8) -> bool {
        if (to.y < from.y && to.y < 0.0) || !self.beside.lets_pass(from, to, &self.habit) {
            return false;
        }
        if self.envelope.contains(from) {
            self.envelope.holds(from, to)
        } else {
            let may_approach = order == 0 && !matches!(self.envelope, Envelope::Swept(_));
            may_approach || self.envelope.contains(to)
        }
    }

    fn lay_laterals(&mut self, node: u32, way: Vec3, side: Vec3, key: u64, age: f32) {
        if Choice::RAMIFIES.unit(key) >= self.habit.ramification.at(age) {
            return;
        }
        let order = self.tree.nodes.order[node as usize];
        let spread = self.habit.branching_spread.at(age) * Choice::BRANCHING_ANGLE.signed(key);
        let angle = (self.habit.branching.at(age) + spread).to_radians();
        for bud in direction::laterals(way, side, angle, direction::laterals_per_node(&self.habit, order)) {
            self.tree.add_bud(node, bud, false, self.year);
        }
    }

    /// New nodes take their space or cast their shadows; [`Outcome::TooLarge`] if there is no room for the shadows,
    /// [`Outcome::TooManySteps`] where that is too much work.
    fn settle_in(&mut self, nodes: std::ops::Range<usize>, stop: &dyn Fn() -> bool) -> Result<(), Outcome> {
        let most = self.limits.voxels;
        let radius = self.habit.space.occupancy * self.habit.internode;
        let mut room = true;
        if let Field::Light(shadow) = &self.field {
            self.effort.spend(nodes.len() as u64 * shadow_steps(shadow))?;
        }
        for i in nodes {
            if i % BREATH == 0 && stop() {
                return Err(Outcome::Stopped);
            }
            let at = self.tree.nodes.at[i];
            match &mut self.field {
                Field::Light(shadow) => room &= shadow.cast(at, Change::Grown, most),
                Field::Space(markers) => {
                    let seen = markers.occupy(at, radius, i as u32, self.year);
                    self.effort.spend(seen)?;
                }
            }
        }
        if room { Ok(()) } else { Err(Outcome::TooLarge(most)) }
    }

    /// Whether every internode inside the envelope stays there; called by tests.
    ///
    /// # Errors
    /// The first internode that leaves it.
    pub fn check_envelope(&self) -> Result<(), String> {
        let nodes = &self.tree.nodes;
        for i in 0..self.tree.len() {
            if nodes.parent[i] == NONE || nodes.born[i] == 0 {
                continue;
            }
            let (from, to) = (nodes.at[nodes.parent[i] as usize], nodes.at[i]);
            if self.envelope.contains(from) && !self.envelope.holds(from, to) {
                return Err(format!("internode {i} leaves the envelope at {to}"));
            }
        }
        Ok(())
    }
}

/// Steps for the shadow of one node: processors darken several voxels at once.
fn shadow_steps(shadow: &Shadow) -> u64 {
    shadow.voxels_per_node().div_ceil(4)
}

/// Only the shadows of the nodes that lived at the end of a year, and of what stands beside them.
fn cast_anew(shadow: &mut Shadow, tree: &Tree, year: u16, most: usize, beside: &Beside) {
    shadow.clear();
    beside.shade(shadow, most);
    for i in (0..tree.len()).filter(|i| tree.lives(*i, year)) {
        // There was room before.
        let _ = shadow.cast(tree.nodes.at[i], Change::Grown, most);
    }
}

/// The crown that a species keeps within, on its foot; everywhere if it has none.
fn own_crown(habit: &Habit, foot: Vec3, seed: u64) -> Envelope {
    let crown = |of: &CrownHabit| Crown { foot, profile: of.radii(), lumps: of.lumps, seed };
    habit.crown.as_ref().map_or(Envelope::Free, |of| Envelope::Crown(Arc::new(crown(of))))
}
