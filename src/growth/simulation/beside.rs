//! A plant among obstacles: they shade it and stand in its way, and what climbs holds on to them.

use crate::growth::habit::Habit;
use crate::growth::obstacle::{Contact, Obstacles};
use crate::growth::resource::markers::Markers;
use crate::growth::resource::shadow::{Change, Shadow};
use crate::growth::tree::{NONE, Tree};
use crate::growth::year::climbing::{self, Support};
use glam::Vec3;
use std::sync::Arc;

/// Distance that wood keeps from obstacles, in internodes.
const CLEARANCE: f32 = 0.6;
/// How far from the foot an obstacle still casts shadow, in heights of the grown plant.
const SHADES: f32 = 1.5;
/// Share of the way along a surface that a shoot takes where it cannot go on; the rest leads away.
const ASIDE: f32 = 0.9;

/// Obstacles as one plant meets them.
#[derive(Clone, Debug, Default)]
pub(super) struct Beside {
    obstacles: Option<Arc<Obstacles>>,
    /// Where they cast shadow from.
    shading: Vec<Vec3>,
}

impl Beside {
    /// What stands beside a plant of a habit.
    pub(super) fn new(obstacles: Arc<Obstacles>, habit: &Habit) -> Self {
        // What climbs bears the shade of what it climbs on.
        let shades = habit.climb.is_none();
        let voxel = habit.light.voxel * habit.internode;
        let shading = if shades { obstacles.shading(voxel, SHADES * habit.height) } else { Vec::new() };
        Self { obstacles: Some(obstacles), shading }
    }

    /// Casts their shadows; where there is no room for them the rest casts none.
    pub(super) fn shade(&self, shadow: &mut Shadow, most: usize) {
        for place in &self.shading {
            if !shadow.cast(*place, Change::Grown, most) {
                return;
            }
        }
    }

    /// Whether an internode may grow there: what climbs goes nearer than other wood.
    pub(super) fn lets_pass(&self, from: Vec3, to: Vec3, habit: &Habit) -> bool {
        let clearance = match &habit.climb {
            Some(climb) => 0.3 * climb.gap,
            None => CLEARANCE * habit.internode,
        };
        self.obstacles.as_ref().is_none_or(|obstacles| obstacles.lets_pass(from, to, clearance))
    }

    /// The way along the nearest surface in place of one that leads into it.
    pub(super) fn aside(&self, from: Vec3, way: Vec3) -> Option<Vec3> {
        let away = self.obstacles.as_ref()?.contact(from)?.away;
        let along = way.reject_from_normalized(away).try_normalize()?;
        (along * ASIDE + away * (1.0 - ASIDE)).try_normalize()
    }

    /// Elementary steps for each internode.
    pub(super) fn steps(&self) -> u64 {
        self.obstacles.as_ref().map_or(0, |obstacles| obstacles.steps())
    }

    /// What stands beside it.
    pub(super) fn obstacles(&self) -> Option<&Arc<Obstacles>> {
        self.obstacles.as_ref()
    }

    /// Places that cast shadow.
    pub(super) fn shading(&self) -> usize {
        self.shading.len()
    }

    /// Takes away the markers that wood would have to come too near to an obstacle for.
    pub(super) fn clear(&self, markers: &mut Markers, habit: &Habit) {
        if let Some(obstacles) = &self.obstacles {
            markers.keep(|p| !obstacles.is_within(CLEARANCE * habit.internode, *p));
        }
    }

    /// The surface that wood of a climbing species holds on to at a place; nothing for other species.
    pub(super) fn held_at(&self, p: Vec3, habit: &Habit) -> Option<Contact> {
        let support = self.support(habit)?;
        support.contact(p).filter(|contact| support.holds(contact, habit.internode))
    }

    /// The direction of an internode of that length, metres, from a node: along its support for a climbing species; none where
    /// it has had none for too long.
    pub(super) fn climbing_way(
        &self,
        (tree, node): (&Tree, u32),
        way: Vec3,
        length: f32,
        (habit, age): (&Habit, f32),
    ) -> Option<Vec3> {
        let Some(support) = self.support(habit) else { return Some(way) };
        let way = support.way(tree.nodes.at[node as usize], way, length, age);
        support.hanging(way, loose(tree, &support, node, habit.internode))
    }

    /// The side of a bud of a node that ends an internode; along its support for wood that holds on.
    pub(super) fn climbing_side(&self, at: Vec3, side: Vec3, way: Vec3, habit: &Habit) -> Vec3 {
        self.held_at(at, habit).map_or(side, |contact| climbing::side_along(side, way, contact.away))
    }

    fn support<'a>(&'a self, habit: &'a Habit) -> Option<Support<'a>> {
        let obstacles = self.obstacles.as_deref();
        habit.climb.as_ref().map(|habit| Support { habit, obstacles })
    }
}

/// Metres of wood up to a node since it last held on to anything.
fn loose(tree: &Tree, support: &Support<'_>, node: u32, internode: f32) -> f32 {
    let (mut node, mut length) = (node as usize, 0.0);
    while length < 2.0 * support.habit.free {
        let (at, parent) = (tree.nodes.at[node], tree.nodes.parent[node]);
        let holds = || support.contact(at).is_some_and(|contact| support.holds(&contact, internode));
        if parent == NONE || holds() {
            break;
        }
        length += at.distance(tree.nodes.at[parent as usize]);
        node = parent as usize;
    }
    length
}
