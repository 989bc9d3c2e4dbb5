//! Foliage as cards: flat pictures of a plant's own leafy shoots in place of their leaves, flowers and thin twigs.
//!
//! A tree has tens of thousands of leaves, of which one sees in most pictures no more than that they are there. Leaves that stand
//! together become a cluster (`clusters`); a few of a plant's clusters are drawn from two sides, by the very surfaces that the
//! model would have had (`picture`); and each cluster becomes two cards of four triangles that cross along its axis, or one where
//! it is flat (`frame`), which show those of the pictures that have about as many leaves. What somebody drew stays as it is.
//!
//! Pure and deterministic; nothing is left to chance.
//!
//! Limits: a card has the light of one surface, not of its leaves, whose own light and shade is painted into its picture. Seen
//! along its axis a cluster is a thin cross.

mod clusters;
mod frame;
mod picture;

use crate::model::ModelParams;
use crate::picture::Picture;
use crate::plant::{FinishedPlant, Material, Organ, OrganPart, Origin, Plant, Role, Shape, Texture};
use clusters::{Cluster, clusters};
use frame::{Frame, Side};
use picture::Atlas;

crate::parameters! {
    /// Foliage as pictures on rectangles.
    pub struct CardParams {
        /// Leaves, flowers and thin twigs that nobody drew become cards.
        used: bool = false, 0..=1, "";
        /// How far the shoots reach that become one card.
        size: f32 = 0.06, 0.01..=0.5, "of the plant's size";
        /// How many of the plant's own shoots are drawn.
        shoots: u32 = 4, 1..=8, "";
        /// Width and height of the picture of each shoot.
        pixels: u32 = 256, 32..=1024, "pixels";
    }
}

/// Fewest clusters that become cards: of less foliage each leaf is looked at.
const FEWEST: usize = 8;
/// Clusters that are thinner than this share of their width become one card.
const FLAT: f32 = 0.3;

/// The plant with its foliage as cards where they are used; without much foliage as it was.
pub fn with_cards(plant: FinishedPlant, params: &CardParams) -> FinishedPlant {
    if !params.used {
        return plant;
    }
    let found = clusters(&plant, params.size * extent(&plant));
    if found.len() < FEWEST {
        return plant;
    }
    let framed: Vec<(Cluster, Frame)> = found
        .into_iter()
        .filter_map(|cluster| Some((Frame::new(&plant, &cluster)?, cluster)))
        .map(|(frame, cluster)| (cluster, frame))
        .collect();
    let ranks = ranks(&framed, params.shoots as usize);
    let Some(atlas) = Atlas::draw(&plant, &framed, &ranks.shown, params.pixels) else { return plant };
    let cards = cards(&plant, &framed, &ranks, &atlas);
    replaced(plant, &framed, cards, atlas.picture)
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

/// Clusters are drawn that stand evenly among all when these are ordered by the number of their organs.
fn ranks(framed: &[(Cluster, Frame)], shoots: usize) -> Ranks {
    let shoots = shoots.min(framed.len()).max(1);
    let mut order: Vec<usize> = (0..framed.len()).collect();
    order.sort_by_key(|&i| (framed[i].0.organs.len(), i));
    let group = |place: usize| place * shoots / order.len().max(1);
    let mut of_cluster = vec![0; order.len()];
    order.iter().enumerate().for_each(|(place, &i)| of_cluster[i] = group(place));
    let middle = |shoot: usize| order[(2 * shoot + 1) * order.len() / (2 * shoots)];
    Ranks { shown: (0..shoots).map(middle).collect(), of_cluster }
}

/// The cards of all clusters.
fn cards(plant: &Plant, framed: &[(Cluster, Frame)], ranks: &Ranks, atlas: &Atlas) -> Vec<Organ> {
    let variant = plant.organs.iter().map(|organ| organ.role.variant + 1).max().unwrap_or(0);
    let role = Role { variant, ..Role::of(OrganPart::Leaf) };
    let of_cluster = |((cluster, frame), shoot): (&(Cluster, Frame), usize)| {
        let branch = cluster.on;
        let sides: &[Side] =
            if frame.flatness() < FLAT { &[Side::Wide] } else { &[Side::Wide, Side::Narrow] };
        let card = move |side: &Side| {
            let (base, u, v) = frame.card(*side);
            Shape::Card { base, u, v, window: atlas.window(shoot, *side) }
        };
        let shapes: Vec<Shape> = sides.iter().map(card).collect();
        shapes.into_iter().map(move |shape| Organ {
            role,
            origin: Origin::Generated,
            branch: Some(branch),
            flower: None,
            shape,
        })
    };
    framed.iter().zip(ranks.of_cluster.iter().copied()).flat_map(of_cluster).collect()
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
    let material = material(&plant, framed, picture);
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
fn material(plant: &FinishedPlant, framed: &[(Cluster, Frame)], picture: Picture) -> Material {
    let first = framed.iter().flat_map(|(cluster, _)| &cluster.organs).next();
    let of_first = first.map(|organ| plant.materials()[plant.material(plant.organs[*organ].role)].clone());
    let plain = Material::plain("", [1.0; 3]);
    Material {
        name: "foliage".to_owned(),
        ambient: plain.ambient,
        diffuse: plain.diffuse,
        texture: Some(Texture::Own(picture)),
        cut_out: true,
        double_sided: false,
        ..of_first.unwrap_or(plain)
    }
}

/// How clusters are meshed to be drawn: finely, for nothing of that is left but a picture.
fn mesh_params() -> ModelParams {
    let mut params = ModelParams::default();
    let blade = &mut params.blade;
    (blade.template_tolerance, blade.template_outline_points) = (0.004, 80);
    (blade.template_rows, blade.template_columns) = (4, 1);
    params
}
