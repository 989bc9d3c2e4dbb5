//! What was learned, judged on plants that were never trained on: the depth of crowns and boughs beside simpler rules, and the plant that
//! the whole program makes of the drawing, seen from the side.

use crate::other_shapes;
use crate::trees::{Kind, Tree};
use crate::views::{CELLS, View};
use anyhow::{Context as _, Result};
use glam::{Vec2, Vec3};
use penstemon::depth;
use penstemon::growth::Inflated;
use penstemon::learned_depth::Network;
use penstemon::learned_depth::picture::{self, Picture, SIDE};
use penstemon::pipeline::{self, Built};
use penstemon::plant::{OrganKind, Shape};
use penstemon::random::mix;
use penstemon::sketch::{Sketch, Stroke, StrokePoint, Tool};
use penstemon::species::Species;
use std::collections::BTreeMap;
use std::io::Write as _;
use std::sync::Arc;

/// Pixels of a drawing along a side of the picture.
const CANVAS: f32 = 1000.0;
/// Reach within which leaves hang together in a silhouette, cells of [`SIDE`].
const TOGETHER: f32 = 2.0;

/// Half depth that is guessed without a look at the drawing: the mean of the training set.
const CONSTANT: f32 = 0.155;
/// Shapes of each kind.
const SHAPES: u64 = 100;
/// Ways in which the plant of a drawing is made.
const HOW: [(&str, &[&str]); 3] = [
    ("learned", &[]),
    ("learned and guided", &["growth.guide=0.6"]),
    ("rules", &["depth.learned.crown=0", "depth.learned.branches=0"]),
];

/// Means by name, in the order of the names.
#[derive(Default)]
struct Table(BTreeMap<String, (f64, f64)>);

impl Table {
    fn add(&mut self, name: &str, value: f32) {
        let entry = self.0.entry(name.to_owned()).or_default();
        entry.0 += f64::from(value);
        entry.1 += 1.0;
    }

    fn print(&self, title: &str) -> Result<()> {
        let mut out = std::io::stdout().lock();
        writeln!(out, "{title}")?;
        for (name, (sum, count)) in &self.0 {
            writeln!(out, "  {name:<56} {:.4}", sum / count.max(1.0))?;
        }
        Ok(())
    }
}

/// Judges on so many plants of each habit.
pub(crate) fn judge(plants: u64, is_whole: bool) -> Result<()> {
    let network = Network::shipped().context("the program was built without weights")?;
    let (mut seeds, mut habits) = (Table::default(), Table::default());
    for (number, kind) in Kind::all()?.iter().enumerate() {
        let table = if kind.is_held_back() { &mut habits } else { &mut seeds };
        for plant in 0..plants {
            // Every tenth plant is not trained on.
            let seed = mix(number as u64, 10 * plant);
            let mut oldest = None;
            kind.grow(seed, |tree| oldest = Some(tree))?;
            let Some(tree) = oldest else { continue };
            let Some(view) = View::of(&tree, mix(seed, 400)) else { continue };
            judge_depth(network, &view, kind, table);
            let picture = Picture::new(&view.area, &view.frame, &view.lines);
            let is_plant = network.answer(&picture, None).plant > 0.5;
            table.add("recognised as plants", f32::from(u8::from(is_plant)));
            if is_whole {
                judge_whole(&tree, &view, (kind, seed), table)?;
            }
        }
    }
    seeds.print("habits that were trained on, other seeds")?;
    habits.print("habits that were not trained on")?;
    shapes(network)?.print("shapes that are no plants: share that is recognised as such")
}

/// How many of the shapes of each kind are no plants to the network.
fn shapes(network: &Network) -> Result<Table> {
    let mut table = Table::default();
    for (number, kind) in other_shapes::KINDS.iter().enumerate() {
        for shape in 0..SHAPES {
            let picture = other_shapes::picture_of(kind, mix(number as u64, shape))?;
            let is_plant = network.answer(&picture, None).plant > 0.5;
            table.add(kind, f32::from(u8::from(!is_plant)));
        }
    }
    Ok(table)
}

/// Errors over the crown and along the wood, as shares of the picture's side.
fn judge_depth(network: &Network, view: &View, kind: &Kind, table: &mut Table) {
    let picture = Picture::new(&view.area, &view.frame, &view.lines);
    let (known, blind) = (network.answer(&picture, Some(&kind.name)), network.answer(&picture, None));
    let inflated = &picture.channels()[SIDE * SIDE..2 * SIDE * SIDE];
    for i in 0..CELLS * CELLS {
        let at = 2 * (i / CELLS) * SIDE + 2 * (i % CELLS);
        let (front, back) = (view.front[at], view.back[at]);
        if !(view.area[at] && front.is_finite() && back.is_finite()) {
            continue;
        }
        let guesses = [
            ("learned, species known", known.half_depth[i]),
            ("learned, species unknown", blind.half_depth[i]),
            ("Poisson", inflated[at] * picture::DEEPEST),
            ("constant", CONSTANT),
        ];
        for (name, half) in guesses {
            table.add(&format!("crown: front, {name}"), (front - half).abs());
            table.add(&format!("crown: gap, {name}"), (front - back - 2.0 * half).abs());
        }
    }
    for (line, depths) in view.lines.iter().zip(&view.depths) {
        for (p, z) in line.points.iter().zip(depths) {
            let cell =
                (view.frame.place(*p) * CELLS as f32).clamp(Vec2::ZERO, Vec2::splat(CELLS as f32 - 1.0));
            let away = known.away[cell.y as usize * CELLS + cell.x as usize];
            let z = z / view.frame.side();
            table.add("wood: constant, in the plane", z.abs());
            table.add("wood: distance from the plane, learned", (z.abs() - away).abs());
        }
    }
}

/// The plant that the program makes of the drawing, with learned depth and without, beside the true one.
fn judge_whole(tree: &Tree, view: &View, (kind, seed): (&Kind, u64), table: &mut Table) -> Result<()> {
    let sketch = drawing(view, kind.species(), seed);
    let (turn, tall) = (view.turn, view.tall);
    let seen = |p: Vec3| {
        let p = turn * p;
        Vec3::new(p.x, -p.y * tall, p.z) / view.frame.side()
    };
    let truth: Vec<[Vec3; 2]> = tree.leaves.iter().map(|leaf| leaf.map(seen)).collect();
    let true_side = silhouette(&truth, |p| Vec2::new(p.z, p.y));
    let species = Species::built_in(kind.species())?;
    for (how, set) in HOW {
        let set: Vec<String> = set.iter().map(|&text| text.to_owned()).collect();
        let built = pipeline::build(&sketch, &species, &pipeline::params_of(&sketch, &species, &set)?);
        let world = built.provenance.world_from_canvas;
        let foot = view.frame.place(Vec2::ZERO);
        let place = |p: Vec3| (world.canvas(p) / CANVAS - foot).extend(p.z / world.scale / CANVAS);
        let leaves: Vec<[Vec3; 2]> = leaves(&built).map(|leaf| leaf.map(place)).collect();
        let front = silhouette(&leaves, |p| Vec2::new(p.x, p.y));
        let side = silhouette(&leaves, |p| Vec2::new(p.z, p.y));
        table.add(&format!("plant: front IoU with the drawing, {how}"), iou(&front, &view.area[..]));
        table.add(
            &format!("plant: largest part missing in front, {how}"),
            largest_missing(&front, &view.area),
        );
        table.add(&format!("plant: side IoU with the true plant, {how}"), iou(&side, &true_side));
        table.add(&format!("plant: IoU of its front and side, {how}"), iou(&side, &front));
        table.add(&format!("twigs: angle to the crown's arms, {how}"), angle_to_arms(&built));
        let drawn = built.wood.before_growth.as_deref().unwrap_or_default();
        let boughs = drawn.iter().filter(|b| b.origin.is_drawn() && b.parent.is_some());
        let ends = boughs.filter_map(|b| b.points.last());
        ends.for_each(|p| table.add(&format!("wood: distance of boughs' ends, {how}"), place(*p).z.abs()));
    }
    for (_, depths) in view.lines.iter().zip(&view.depths).filter(|(line, _)| !line.is_trunk) {
        let end = depths.last().map_or(0.0, |z| z.abs());
        table.add("wood: distance of boughs' ends, true", end / view.frame.side());
    }
    table.add(
        "plant: IoU of its front and side, true",
        iou(&true_side, &silhouette(&truth, |p| p.truncate())),
    );
    Ok(())
}

/// Base and tip of every leaf of a built plant, metres.
fn leaves(built: &Built) -> impl Iterator<Item = [Vec3; 2]> + '_ {
    built.plant.organs.iter().filter_map(|organ| match &organ.shape {
        Shape::Blade(blade) if organ.kind() == OrganKind::Leaf => {
            Some([blade.base, blade.base + blade.v * built.plant.templates[blade.template].length()])
        }
        _ => None,
    })
}

/// Mean angle between what grew and the direction in which the crown's arms lead there, degrees.
fn angle_to_arms(built: &Built) -> f32 {
    let crowns = depth::crowns(&built.anatomy, &built.provenance.world_from_canvas);
    let drawn: Vec<_> = built.plant.branches.iter().filter(|b| b.origin.is_drawn()).cloned().collect();
    let Some(crown) = Inflated::new(crowns, 1.0) else { return 0.0 };
    let crown = crown.guided(1.0, &drawn);
    let (mut sum, mut length) = (0.0, 0.0);
    for branch in built.plant.branches.iter().filter(|b| !b.origin.is_drawn()) {
        for pair in branch.points.windows(2) {
            let (way, along) = (crown.way(pair[0].midpoint(pair[1])), pair[1] - pair[0]);
            if way != Vec3::ZERO && along != Vec3::ZERO {
                sum += way.angle_between(along).to_degrees() * along.length();
                length += along.length();
            }
        }
    }
    sum / length.max(f32::MIN_POSITIVE)
}

/// The largest connected part of an area that is not covered, as a share of the area.
fn largest_missing(covered: &[bool], area: &[bool; SIDE * SIDE]) -> f32 {
    let mut open: Vec<bool> = area.iter().zip(covered).map(|(area, covered)| *area && !covered).collect();
    let mut largest = 0;
    for first in 0..open.len() {
        let (mut front, mut size) = (vec![first], 0);
        while let Some(i) = front.pop() {
            if std::mem::take(&mut open[i]) {
                size += 1;
                let near = [i.checked_sub(1), i.checked_sub(SIDE), Some(i + 1), Some(i + SIDE)];
                front.extend(near.into_iter().flatten().filter(|i| *i < SIDE * SIDE));
            }
        }
        largest = largest.max(size);
    }
    largest as f32 / area.iter().filter(|set| **set).count().max(1) as f32
}

/// The drawing of a view: its crown's outlines and its wood.
fn drawing(view: &View, species: &str, seed: u64) -> Sketch {
    let mut strokes = Vec::new();
    let mut add = |tool: Tool, points: Vec<Vec2>| {
        let points = points.into_iter().map(|p| StrokePoint::at(p * CANVAS)).collect();
        strokes.push(Arc::new(Stroke { id: strokes.len() as u64 + 1, tool, points, brush: None }));
    };
    for line in view.lines.iter().rev() {
        add(Tool::Branch, line.points.iter().map(|p| view.frame.place(*p)).collect());
    }
    for outline in outlines(&view.area) {
        add(Tool::Crown, outline);
    }
    Sketch { species: Some(species.to_owned()), seed, strokes, ..Sketch::empty() }
}

/// Closed outlines of an area, in shares of the picture, corners cut.
fn outlines(area: &[bool; SIDE * SIDE]) -> Vec<Vec<Vec2>> {
    let inside = |x: i32, y: i32| {
        (0..SIDE as i32).contains(&x) && (0..SIDE as i32).contains(&y) && area[y as usize * SIDE + x as usize]
    };
    // Edges with the area to their left, by where they begin.
    let mut next: BTreeMap<(i32, i32), Vec<(i32, i32)>> = BTreeMap::new();
    for y in 0..SIDE as i32 {
        for x in 0..SIDE as i32 {
            if !inside(x, y) {
                continue;
            }
            let edges = [
                ((x, y - 1), (x + 1, y), (x, y)),
                ((x, y + 1), (x, y + 1), (x + 1, y + 1)),
                ((x - 1, y), (x, y), (x, y + 1)),
                ((x + 1, y), (x + 1, y + 1), (x + 1, y)),
            ];
            for ((nx, ny), from, to) in edges {
                if !inside(nx, ny) {
                    next.entry(from).or_default().push(to);
                }
            }
        }
    }
    let mut all = Vec::new();
    while let Some((&start, _)) = next.first_key_value() {
        let (mut at, mut ring) = (start, Vec::new());
        while let Some(ways) = next.get_mut(&at) {
            ring.push(Vec2::new(at.0 as f32, at.1 as f32) / SIDE as f32);
            let to = ways.pop().unwrap_or(start);
            if ways.is_empty() {
                next.remove(&at);
            }
            at = to;
        }
        for _ in 0..3 {
            let n = ring.len();
            ring = (0..n)
                .map(|i| 0.25 * ring[(i + n - 1) % n] + 0.5 * ring[i] + 0.25 * ring[(i + 1) % n])
                .collect();
        }
        if ring.len() > 24 {
            ring.push(ring[0]);
            all.push(ring);
        }
    }
    all
}

/// The cells that leaves cover, gaps of [`TOGETHER`] closed; places in shares of the picture from its foot.
fn silhouette(leaves: &[[Vec3; 2]], flat: impl Fn(Vec3) -> Vec2) -> Vec<bool> {
    let mut set = Box::new([false; SIDE * SIDE]);
    let place = |p: Vec3| (flat(p) + Vec2::new(0.5, 1.0 - picture::FOOT)) * SIDE as f32;
    for leaf in leaves {
        picture::for_cells_near((place(leaf[0]), place(leaf[1])), 0.8, SIDE, |i| set[i] = true);
    }
    let grown = crate::views::within(&set, TOGETHER, true);
    crate::views::within(&grown, TOGETHER, false).to_vec()
}

fn iou(a: &[bool], b: &[bool]) -> f32 {
    let both = a.iter().zip(b).filter(|(a, b)| **a && **b).count();
    let either = a.iter().zip(b).filter(|(a, b)| **a || **b).count();
    both as f32 / either.max(1) as f32
}
