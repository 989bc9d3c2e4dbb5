//! Foliage as cards: flat pictures of a plant's own leafy shoots in place of their leaves, flowers and thin twigs.
//!
//! A tree has tens of thousands of leaves, of which one sees in most pictures no more than that they are there. Leaves that stand
//! together become a cluster (`clusters`); a few of a plant's clusters are drawn from two sides, by the very surfaces that the
//! model would have had (`picture`, put together in `atlas`); and each cluster becomes two cards of four triangles that cross along its axis, or one where
//! it is flat (`frame`), which show those of the pictures that have about as many leaves. What somebody drew stays as it is. A plant that is
//! far away is one card, with its picture from the nearest of many sides (`views`).
//!
//! Pure and deterministic; nothing is left to chance.
//!
//! Limits: a card has the light of one surface, not of its leaves, whose own light and shade is painted into its picture. Seen
//! along its axis a cluster is a thin cross.

mod atlas;
mod clusters;
mod coverage;
mod frame;
mod picture;
mod raster;
mod sky;
mod surfaces;
mod views;

use crate::geom::simple_loop::area;
use crate::model::{Model, ModelParams, Part};
use crate::picture::Picture;
use crate::plant::{
    FinishedPlant, Material, Organ, OrganClass, OrganPart, Origin, Plant, Role, Shape, Texture,
};
use atlas::Atlas;
pub use atlas::Cache;
use clusters::{Cluster, clusters};
use frame::{Frame, Side};
use glam::Vec3;
use picture::Drawing;
use surfaces::{Surfaces, fine};

crate::parameters! {
    /// Foliage as pictures on rectangles.
    pub struct CardParams {
        /// Leaves, flowers and thin twigs that nobody drew become cards.
        used: bool = false, 0..=1, "";
        /// A budget of less than this share of the plant's triangles makes cards of the same foliage; 0 for never.
        below: f32 = 0.15, 0..=1, "of the plant's triangles";
        /// How far the shoots reach that become one card.
        size: f32 = 0.06, 0.01..=0.5, "of the plant's size";
        /// How many of the plant's own shoots are drawn.
        shoots: u32 = 6, 1..=16, "";
        /// Width and height of the picture of each shoot.
        pixels: u32 = 256, 32..=1024, "pixels";
    }
}

/// Fewest clusters that become cards: of less foliage each leaf is looked at.
const FEWEST: usize = 8;
/// Clusters that are thinner than this share of their width become one card.
const FLAT: f32 = 0.3;
/// Triangles of a card.
const TRIANGLES: u64 = 4;
/// How much larger clusters become at a time where there are too many, and how large at most, share of the plant's size.
const LARGER: f32 = 1.25;
const LARGEST: f32 = 0.4;

/// The plant with its foliage as cards where they are used; without much foliage as it was. Where `most` triangles are given, cards
/// are larger than the parameters say if they would be more.
pub fn with_cards(plant: FinishedPlant, params: &CardParams, most: Option<u64>) -> FinishedPlant {
    let with_cards = with_kept_cards(plant, params, most, &mut Cache::for_one_build(), &|| false);
    with_cards.unwrap_or_else(|| unreachable!("nothing stops it"))
}

/// The very plant that [`with_cards`] gives, again and again while it changes: what is painted is kept in `cache`. Once `stop` says
/// yes it ends soon and gives nothing.
pub fn with_kept_cards(
    plant: FinishedPlant,
    params: &CardParams,
    most: Option<u64>,
    cache: &mut Cache,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<FinishedPlant> {
    if !params.used {
        return Some(plant);
    }
    let (size, framed) = fitting(&plant, params.size, most);
    if framed.len() < FEWEST {
        return Some(plant);
    }
    let ranks = ranks(&plant, &framed, params.shoots as usize);
    let surfaces = Surfaces::new(&plant, fine());
    let drawing = Drawing { pixels: params.pixels, share: size };
    let atlas = Atlas::draw(cache, (&surfaces, drawing), (&framed, &ranks.shown), stop);
    if stop() {
        return None;
    }
    let Some(atlas) = atlas else { return Some(plant) };
    let cards = cards(&plant, &framed, &ranks, &atlas);
    Some(replaced(plant, &framed, cards, atlas.picture))
}

/// Whether any of a plant's foliage is cards.
pub fn are_in(plant: &Plant) -> bool {
    plant.organs.iter().any(|organ| matches!(organ.shape, Shape::Card { .. }))
}

/// The whole plant as two crossing pictures, each so many pixels wide and high, for what is far away.
pub fn billboards(plant: &FinishedPlant, pixels: u32) -> FinishedPlant {
    let Some(frame) = Frame::upright(plant) else { return plant.clone() };
    let (organs, branches) = ((0..plant.organs.len()).collect(), (0..plant.branches.len()).collect());
    let all = [(Cluster { on: None, foot: Vec3::ZERO, along: Vec3::Y, organs, branches }, frame)];
    let surfaces = Surfaces::new(plant, ModelParams::default());
    let drawing = Drawing { pixels, share: 1.0 };
    let atlas = Atlas::draw(&mut Cache::for_one_build(), (&surfaces, drawing), (&all, &[0]), &|| false);
    let Some(atlas) = atlas else { return plant.clone() };
    let role = new_role(plant);
    let cards = Side::ALL.map(|side| card(role, None, atlas.card(&frame, 0, side))).to_vec();
    let mut flat = replaced(plant.clone(), &all, cards, atlas.picture);
    flat.reshape(|plant| plant.flowers.clear());
    flat
}

/// A plant as one card that shows it from one side.
#[derive(Clone, Debug)]
pub struct PlantView {
    /// Toward the viewer, of length 1.
    pub toward: Vec3,
    /// The card.
    pub flat: FinishedPlant,
}

/// A model as pictures from many sides, each at most so many pixels wide and high, for what is far away and drawn by somebody who chooses
/// the side that is nearest to the viewer's. Nothing of a model without surfaces. The material is the one with most triangles, with the
/// picture's colours.
pub fn views(model: &Model, pixels: u32) -> Vec<PlantView> {
    let Some((picture, views)) = views::painted(model, pixels) else { return Vec::new() };
    let material = Material { covers_in_part: true, ..material(most_seen(model), picture) };
    let flat = |shape| {
        let organs = vec![card(Role::of(OrganPart::Leaf), None, shape)];
        FinishedPlant::new(Plant { organs, ..Plant::default() }, &[], |_| material.clone())
    };
    views.into_iter().map(|view| PlantView { toward: view.toward, flat: flat(view.card) }).collect()
}

/// The material of a model that most of its triangles have.
fn most_seen(model: &Model) -> Option<&Material> {
    let mut counts = vec![0; model.materials.len()];
    let counted = |part: &Part| {
        let copies = part.copies.iter().flat_map(|copies| copies.iter());
        let of_copies = copies.map(|(shape, at)| (part.material_of_slot(at.slot), shape.triangles.len()));
        part.material_slots().map(|(material, faces)| (material, faces.len())).chain(of_copies).collect()
    };
    let all = model.parts.iter().flat_map(|part| -> Vec<(usize, usize)> { counted(part) });
    all.for_each(|(material, count)| counts[material] += count);
    let most = counts.iter().zip(&model.materials).max_by_key(|(count, _)| **count);
    most.map(|(_, material)| material)
}

/// The clusters of a plant and their size, a share of the plant's: that which is wanted, or a larger one whose cards have at most so
/// many triangles.
fn fitting(plant: &Plant, mut size: f32, most: Option<u64>) -> (f32, Vec<(Cluster, Frame)>) {
    let extent = extent(plant);
    loop {
        let framed: Vec<(Cluster, Frame)> = clusters(plant, size * extent)
            .into_iter()
            .filter_map(|cluster| Frame::new(plant, &cluster).map(|frame| (cluster, frame)))
            .collect();
        let cards = framed.iter().map(|(_, frame)| sides(frame).len() as u64).sum::<u64>();
        if size >= LARGEST || most.is_none_or(|most| cards * TRIANGLES <= most) {
            return (size, framed);
        }
        size *= LARGER;
    }
}

/// The sides from which a cluster is shown.
fn sides(frame: &Frame) -> &'static [Side] {
    if frame.flatness() < FLAT { &[Side::Wide] } else { &Side::ALL }
}

/// The largest extent of a plant's wood, metres.
fn extent(plant: &Plant) -> f32 {
    let points = plant.branches.iter().flat_map(|branch| branch.points.iter().copied());
    let first = points.clone().next().unwrap_or_default();
    let (low, high) = points.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
    (high - low).max_element()
}

/// Which clusters are drawn, and which of their pictures each cluster shows.
struct Ranks {
    /// Indices of the clusters that are drawn, those with the fewest organs first.
    shown: Vec<usize>,
    /// For each cluster an index into `shown`.
    of_cluster: Vec<usize>,
}

/// Clusters with and without flowers are ordered by the number of their organs, and divided into groups of about equally many; of each
/// group that is drawn which fills its card as well as the middle one of the group does.
fn ranks(plant: &Plant, framed: &[(Cluster, Frame)], shoots: usize) -> Ranks {
    let has_flowers = |i: &usize| framed[*i].0.organs.iter().any(|organ| is_of_flower(&plant.organs[*organ]));
    let (flowering, leafy): (Vec<usize>, Vec<usize>) = (0..framed.len()).partition(has_flowers);
    let shoots = shoots.max(1);
    let (of_leafy, of_flowering) = match (leafy.len(), flowering.len()) {
        (0, _) | (_, 0) => (shoots, shoots),
        (_, flowers) => {
            let of_flowering = (shoots * flowers).div_ceil(framed.len());
            ((shoots - of_flowering).max(1), of_flowering.min(shoots.max(2) - 1))
        }
    };
    let mut ranks = Ranks { shown: Vec::new(), of_cluster: vec![0; framed.len()] };
    for (mut order, shoots) in [(leafy, of_leafy), (flowering, of_flowering)] {
        order.sort_by_key(|&i| (framed[i].0.organs.len(), i));
        let shoots = shoots.min(order.len());
        for shoot in 0..shoots {
            let group = &order[shoot * order.len() / shoots..(shoot + 1) * order.len() / shoots];
            let mut filled: Vec<(f32, usize)> = group.iter().map(|&i| (fill(plant, &framed[i]), i)).collect();
            filled.iter().for_each(|(_, i)| ranks.of_cluster[*i] = ranks.shown.len());
            filled.sort_by(|(a, i), (b, j)| a.total_cmp(b).then(i.cmp(j)));
            ranks.shown.push(filled[filled.len() / 2].1);
        }
    }
    ranks
}

/// Whether an organ is part of a flower.
fn is_of_flower(organ: &Organ) -> bool {
    organ.kind().class() == OrganClass::Flower
}

/// The area of a cluster's blades as a share of its card's.
fn fill(plant: &Plant, (cluster, frame): &(Cluster, Frame)) -> f32 {
    let area = |organ: &usize| match &plant.organs[*organ].shape {
        Shape::Blade(blade) => {
            area(plant.templates[blade.template].outline()) * blade.u.length() * blade.v.length()
        }
        _ => 0.0,
    };
    let (_, u, v) = frame.card(Side::Wide);
    cluster.organs.iter().map(area).sum::<f32>() / (u.length() * v.length())
}

/// The cards of all clusters.
fn cards(plant: &Plant, framed: &[(Cluster, Frame)], ranks: &Ranks, atlas: &Atlas) -> Vec<Organ> {
    let role = new_role(plant);
    let mut cards = Vec::with_capacity(2 * framed.len());
    for ((cluster, frame), shoot) in framed.iter().zip(&ranks.of_cluster) {
        let shape = |side: &Side| atlas.card(frame, *shoot, *side);
        cards.extend(sides(frame).iter().map(shape).map(|shape| card(role, cluster.on, shape)));
    }
    cards
}

/// A role of leaves that the plant does not have yet.
fn new_role(plant: &Plant) -> Role<OrganPart> {
    let variant = plant.organs.iter().map(|organ| organ.role.variant + 1).max().unwrap_or(0);
    Role { variant, ..Role::of(OrganPart::Leaf) }
}

/// A card on a branch.
fn card(role: Role<OrganPart>, branch: Option<usize>, shape: Shape) -> Organ {
    Organ { role, origin: Origin::Generated, branch, flower: None, shape }
}

/// The plant without what the clusters hold, and with the cards.
fn replaced(
    mut plant: FinishedPlant,
    framed: &[(Cluster, Frame)],
    cards: Vec<Organ>,
    picture: Picture,
) -> FinishedPlant {
    let (mut organ_stays, mut branch_stays) =
        (vec![true; plant.organs.len()], vec![true; plant.branches.len()]);
    for (cluster, _) in framed {
        cluster.organs.iter().for_each(|organ| organ_stays[*organ] = false);
        cluster.branches.iter().for_each(|branch| branch_stays[*branch] = false);
    }
    let Some(role) = cards.first().map(|card| card.role) else { return plant };
    let first = framed.iter().flat_map(|(cluster, _)| &cluster.organs).next();
    let of_first = first.map(|organ| &plant.materials()[plant.material(plant.organs[*organ].role)]);
    let mut material = material(of_first, picture);
    if framed.iter().any(|(_, frame)| frame.is_whole()) {
        // Leaves of a whole tree shine in all directions, its picture would in one.
        material.specular = [0.0; 3];
    }
    plant.add_material(role.into(), material);
    plant.reshape(|plant| {
        let mut stays = organ_stays.into_iter();
        plant.organs.retain(|_| stays.next().unwrap_or(true));
        plant.organs.extend(cards);
        plant.keep_branches(&branch_stays);
        plant.drop_unused_templates();
    });
    plant
}

/// The look of the cards: that of the first leaf, with the picture's colours.
fn material(of_first: Option<&Material>, picture: Picture) -> Material {
    let plain = Material::plain("", [1.0; 3]);
    Material {
        name: "foliage".to_owned(),
        ambient: plain.ambient,
        diffuse: plain.diffuse,
        texture: Some(Texture::Own(picture)),
        cut_out: true,
        double_sided: false,
        ..of_first.unwrap_or(&plain).clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::{Limits, PlantAtAge, Simulation, plant_at};
    use crate::model::{self, PartKind};
    use crate::plant::Provenance;
    use crate::species::{self, Species};

    fn grown(name: &str, age: u16) -> FinishedPlant {
        let species = Species::built_in(name).unwrap();
        let mut simulation = Simulation::new(species.growth.as_ref().unwrap(), 1, Limits::default());
        simulation.grow_to(age, &|| false);
        let PlantAtAge { plant, buds } = plant_at(&simulation, f32::from(age));
        species::apply(plant, &buds, &Provenance::default(), &species, 1).plant
    }

    fn used() -> CardParams {
        CardParams { used: true, ..CardParams::default() }
    }

    fn built(plant: &FinishedPlant) -> Model {
        let mut params = ModelParams::default();
        params.blade.gathered = true;
        model::build(plant, &params)
    }

    /// Share of the area of one box, seen from the front, that another has.
    fn covered(of: &Model, by: &Model) -> f32 {
        let area = |(low, high): (Vec3, Vec3)| (high - low).x * (high - low).y;
        area(by.bounds().unwrap()) / area(of.bounds().unwrap())
    }

    /// Triangles of what is no wood.
    fn foliage(model: &Model) -> usize {
        model
            .parts
            .iter()
            .filter(|part| matches!(part.kind, PartKind::Organ(_)))
            .map(Part::triangle_count)
            .sum()
    }

    #[test]
    fn foliage_becomes_few_triangles_of_the_same_extent() {
        for (name, age) in [("oak", 12), ("spruce", 8), ("cherry", 12), ("ash", 8), ("willow", 8)] {
            let plant = grown(name, age);
            let with = with_cards(plant.clone(), &used(), None);
            assert_eq!(with.check_invariants(), Ok(()), "{name}");
            assert!(with.organs.iter().all(|organ| matches!(organ.shape, Shape::Card { .. })), "{name}");
            let (leaves, cards) = (built(&plant), built(&with));
            assert_eq!(cards.check_invariants(), Ok(()), "{name}");
            let share = foliage(&cards) as f32 / foliage(&leaves) as f32;
            assert!(share < 0.25, "{name}: {share} of the foliage's triangles");
            let extent = covered(&leaves, &cards);
            assert!((0.9..1.2).contains(&extent), "{name}: {extent} of the extent");
            assert!(with == with_cards(plant, &used(), None), "{name}: not the same again");
        }
    }

    #[test]
    fn what_was_drawn_and_little_foliage_stay() {
        let plant = grown("oak", 1);
        assert!(with_cards(plant.clone(), &used(), None) == plant);
        let oak = grown("oak", 8);
        assert!(with_cards(oak.clone(), &CardParams::default(), None) == oak);
        let mut drawn = oak;
        let origin = Provenance::default().record(Some(7));
        drawn.reshape(|plant| {
            plant.branches.iter_mut().for_each(|branch| branch.origin = origin);
            plant.organs.iter_mut().step_by(2).for_each(|organ| organ.origin = origin);
        });
        let with = with_cards(drawn.clone(), &used(), None);
        assert_eq!(with.branches, drawn.branches);
        let leaves = |plant: &Plant| plant.organs.iter().filter(|organ| organ.origin.is_drawn()).count();
        assert_eq!(leaves(&with), leaves(&drawn));
    }

    #[test]
    fn a_whole_plant_is_two_pictures() {
        let plant = grown("apple", 8);
        let flat = billboards(&plant, 64);
        assert_eq!(flat.check_invariants(), Ok(()));
        let (whole, two) = (built(&plant), built(&flat));
        assert_eq!(two.triangle_count(), 8);
        assert!((0.95..1.3).contains(&covered(&whole, &two)), "{}", covered(&whole, &two));
        let nothing = FinishedPlant::plain(Plant::default());
        assert!(billboards(&nothing, 64) == nothing);
    }
}
