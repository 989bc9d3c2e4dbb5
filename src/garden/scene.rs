//! A garden as one model: the individuals as shapes, the plants as copies of them, and the ground.
//!
//! For pictures and for OBJ each kind has a part for each of its materials, whose shapes are the individuals' surfaces in it
//! ([`Garden::model`]). For GLB each individual is one mesh with all its materials, and each plant one node or one row of a
//! table ([`Garden::instanced`]).

use super::plan::Place;
use super::stock::{Individual, KindStock, Stock};
use super::walls::{self, Wall};
use crate::model::{Copies, InstanceGroup, InstancedModel, Mesh, Model, Part, PartKind, Placement, Pose};
use crate::plant::{Material, OrganKind};
use glam::Vec3;
use smol_str::{SmolStr, format_smolstr};
use std::collections::BTreeSet;
use std::sync::Arc;

/// A garden in which everything stands.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Garden {
    /// The individuals.
    pub stock: Stock,
    /// The plants.
    pub places: Vec<Place>,
    /// The ground with its materials, the first for its first triangles; none for plants alone.
    pub ground: Option<(Mesh, Vec<Material>)>,
    /// What stands on it.
    pub walls: Vec<Wall>,
}

impl Garden {
    /// Triangles of all plants and the ground, every copy counted.
    pub fn triangle_count(&self) -> usize {
        self.triangles_alone() + self.of_plants(Individual::triangle_count)
    }

    /// The same if every plant were as coarse as it can be.
    pub fn fewest_triangles(&self) -> usize {
        self.triangles_alone() + self.of_plants(Individual::fewest_triangles)
    }

    /// Corners and triangles of all plants.
    pub fn counts_of_plants(&self) -> [usize; 2] {
        [self.of_plants(Individual::vertex_count), self.of_plants(Individual::triangle_count)]
    }

    fn of_plants(&self, of_individual: impl Fn(&Individual) -> usize) -> usize {
        let kinds = self.stock.kinds.iter();
        let counts: Vec<Vec<usize>> =
            kinds.map(|kind| kind.individuals.iter().map(&of_individual).collect()).collect();
        let of_place = |place: &Place| counts[place.kind as usize].get(place.variant as usize).copied();
        self.places.iter().filter_map(of_place).sum()
    }

    /// Triangles of what there is once.
    fn triangles_alone(&self) -> usize {
        let ground = self.ground.as_ref().map_or(0, |(mesh, _)| mesh.triangles.len());
        let walls = self.walls.iter().flat_map(|wall| &wall.surfaces);
        let walls: usize = walls.map(|mesh| mesh.triangles.len()).sum();
        ground + walls
    }

    /// Smallest and largest corner of the ground and of where plants stand, with room for these; none where nothing is.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let walls = self.walls.iter().flat_map(|wall| &wall.surfaces);
        let ground = self.ground.iter().map(|(mesh, _)| mesh).chain(walls);
        let ground = ground.flat_map(|mesh| mesh.points.iter().copied());
        let widths: Vec<f32> = self.stock.kinds.iter().map(KindStock::width).collect();
        let room = |place: &Place| place.scale * widths[place.kind as usize];
        let plants = self.places.iter().flat_map(|place| [place.at - room(place), place.at + room(place)]);
        let mut points = ground.chain(plants);
        let first = points.next()?;
        Some(points.fold((first, first), |(low, high), p| (low.min(p), high.max(p))))
    }

    /// How many plants there are of each kind.
    pub fn plants_of_each_kind(&self) -> Vec<usize> {
        let mut counts = vec![0; self.stock.kinds.len()];
        self.places.iter().for_each(|place| counts[place.kind as usize] += 1);
        counts
    }

    /// The garden with a part for each kind and material.
    pub fn model(&self) -> Model {
        let (mut parts, materials) = self.parts_alone();
        for (kind, stock) in self.stock.kinds.iter().enumerate() {
            let surfaces = || stock.individuals.iter().flat_map(|individual| &individual.surfaces);
            let of_kind: BTreeSet<usize> = surfaces().map(|surface| surface.material).collect();
            for material in of_kind {
                let Some(of) = surfaces().find(|surface| surface.material == material) else { continue };
                let name = format_smolstr!("{}_{}", stock.name, self.stock.materials[material].name);
                let copies = self.copies(kind, material);
                if !copies.placements.is_empty() {
                    let copies = Some(Arc::new(copies));
                    parts.push(Part { specimen: 1 + kind, copies, ..bare(name, of.kind, material) });
                }
            }
        }
        Model { parts, materials }
    }

    /// Puts what there is once, the ground and the walls, behind the parts of a model. Returns how many materials stand there before those
    /// of the individuals.
    pub fn join_without_plants(&self, model: &mut Model) -> usize {
        let (behind, (parts, materials)) = (Behind::new(model), self.parts_alone());
        model.parts.extend(parts.into_iter().map(|part| behind.part(part)));
        model.materials.extend(materials.into_iter().map(|material| behind.material(material)));
        behind.materials
    }

    /// Puts the garden behind the parts of a model.
    pub fn join(&self, model: &mut Model) {
        let (behind, garden) = (Behind::new(model), self.model());
        model.parts.extend(garden.parts.into_iter().map(|part| behind.part(part)));
        model.materials.extend(garden.materials.into_iter().map(|material| behind.material(material)));
    }

    /// The same of a model whose copies stand apart; each individual is one shape.
    pub fn join_instanced(&self, to: &mut InstancedModel) {
        let (behind, InstancedModel { model, groups }) = (Behind::new(&to.model), self.instanced());
        to.model.parts.extend(model.parts.into_iter().map(|part| behind.part(part)));
        to.model.materials.extend(model.materials.into_iter().map(|material| behind.material(material)));
        let moved = |group: InstanceGroup| InstanceGroup { shape: behind.part(group.shape), ..group };
        to.groups.extend(groups.into_iter().map(moved));
    }

    /// The copies of a kind's surfaces in a material.
    fn copies(&self, kind: usize, material: usize) -> Copies {
        let (mut shapes, mut shape_of) = (Vec::new(), Vec::new());
        for individual in &self.stock.kinds[kind].individuals {
            let surface = individual.surfaces.iter().find(|surface| surface.material == material);
            shape_of.push(surface.map(|surface| {
                shapes.push(surface.mesh.clone());
                shapes.len() as u32 - 1
            }));
        }
        let of_kind = self.places.iter().filter(|place| place.kind as usize == kind);
        let placement = |place: &Place| {
            let shape = shape_of.get(place.variant as usize).copied().flatten()?;
            let [u, v] = [Vec3::X, Vec3::Y].map(|axis| place.rotation * axis * place.scale);
            Some(Placement { shape, slot: 0, base: place.at, u, v })
        };
        Copies { placements: of_kind.filter_map(placement).collect(), shapes }
    }

    /// The garden with a mesh for each individual that is there.
    pub fn instanced(&self) -> InstancedModel {
        let (parts, materials) = self.parts_alone();
        let mut poses: Vec<Vec<Vec<Pose>>> =
            self.stock.kinds.iter().map(|kind| vec![Vec::new(); kind.individuals.len()]).collect();
        for Place { kind, variant, at, rotation, scale } in &self.places {
            let pose = Pose { base: *at, rotation: *rotation, scale: Vec3::splat(*scale) };
            poses[*kind as usize][*variant as usize].push(pose);
        }
        let kinds = self.stock.kinds.iter().zip(poses);
        let groups = kinds.flat_map(|(kind, poses)| {
            let individuals = kind.individuals.iter().zip(poses).zip(1..);
            individuals.filter_map(|((individual, poses), number)| {
                let name = format_smolstr!("{}_{number}", kind.name);
                (!poses.is_empty()).then(|| Some(InstanceGroup { shape: whole(name, individual)?, poses }))?
            })
        });
        InstancedModel { groups: groups.collect(), model: Model { parts, materials } }
    }

    /// What there is once: the ground and the walls. With the materials of everything, the individuals' first.
    fn parts_alone(&self) -> (Vec<Part>, Vec<Material>) {
        let (mut parts, mut materials) = (Vec::new(), self.stock.materials.clone());
        if let Some((mesh, own)) = &self.ground {
            let first = materials.len();
            materials.extend(own.iter().cloned());
            let more_materials = (first + 1..first + own.len()).collect();
            let ground = bare("ground".into(), PartKind::Ground, first);
            parts.push(Part { mesh: Arc::new(mesh.clone()), more_materials, ..ground });
        }
        let first = materials.len();
        let most = self.walls.iter().map(|wall| wall.surfaces.len()).max().unwrap_or(0);
        let names = materials.iter().map(|material| (&*material.name).into()).collect();
        let named = |material: Material| Material {
            name: unused(&names, (&*material.name).into()).to_string(),
            ..material
        };
        materials.extend(walls::materials().into_iter().take(most).map(named));
        parts.extend(self.walls.iter().zip(1..).filter_map(|(wall, number)| {
            let mesh = one_mesh(wall.surfaces.iter())?;
            let more_materials = (first + 1..first + wall.surfaces.len()).collect();
            let part = bare(format_smolstr!("wall_{number}"), PartKind::Organ(OrganKind::Pot), first);
            Some(Part { mesh: Arc::new(mesh), more_materials, ..part })
        }));
        (parts, materials)
    }
}

/// What parts and materials of a garden are called and numbered behind those of a model.
struct Behind {
    materials: usize,
    specimens: usize,
    names: BTreeSet<SmolStr>,
    names_of_materials: BTreeSet<SmolStr>,
}

impl Behind {
    fn new(model: &Model) -> Self {
        Self {
            materials: model.materials.len(),
            specimens: model.parts.iter().map(|part| part.specimen + 1).max().unwrap_or(0),
            names: model.parts.iter().map(|part| part.name.clone()).collect(),
            names_of_materials: model.materials.iter().map(|material| (&*material.name).into()).collect(),
        }
    }

    fn part(&self, part: Part) -> Part {
        Part {
            name: unused(&self.names, part.name),
            material: part.material + self.materials,
            more_materials: part.more_materials.iter().map(|material| material + self.materials).collect(),
            specimen: part.specimen + self.specimens,
            ..part
        }
    }

    fn material(&self, material: Material) -> Material {
        let name = unused(&self.names_of_materials, (&*material.name).into()).to_string();
        Material { name, ..material }
    }
}

/// A name, with what says that it is the garden's where the model has it.
fn unused(taken: &BTreeSet<SmolStr>, name: SmolStr) -> SmolStr {
    let numbered = (2..).map(|number| format_smolstr!("garden_{name}_{number}"));
    let mut names = [name.clone(), format_smolstr!("garden_{name}")].into_iter().chain(numbered);
    names.find(|name| !taken.contains(name)).unwrap_or(name)
}

/// A part at the origin without any surface.
fn bare(name: SmolStr, kind: PartKind, material: usize) -> Part {
    Part::alone(name, kind, material, Arc::new(Mesh::default()))
}

/// An individual as one part with all its materials; none without any surface.
fn whole(name: SmolStr, individual: &Individual) -> Option<Part> {
    let (first, more) = individual.surfaces.split_first()?;
    let mesh = one_mesh(individual.surfaces.iter().map(|surface| &*surface.mesh))?;
    let more_materials = more.iter().map(|surface| surface.material).collect();
    Some(Part { mesh: Arc::new(mesh), more_materials, ..bare(name, first.kind, first.material) })
}

/// Surfaces of one part, each with a material of its own.
fn one_mesh<'a>(mut surfaces: impl Iterator<Item = &'a Mesh>) -> Option<Mesh> {
    let mut mesh = surfaces.next()?.clone();
    for surface in surfaces {
        mesh.breaks.push(mesh.triangles.len() as u32);
        mesh.append(surface);
    }
    Some(mesh)
}

#[cfg(test)]
mod tests {
    use super::super::stock::Surface;
    use super::*;
    use crate::model::Vertex;
    use glam::{Quat, Vec2};

    /// A garden of triangles: two individuals, of which the second has a second material.
    fn triangles() -> Garden {
        let vertex = |point| Vertex { point, normal: Vec3::Z, uv: Vec2::ZERO };
        let mesh = |height: f32| {
            let points = vec![Vec3::ZERO, Vec3::X, Vec3::Y * height];
            Mesh {
                points,
                vertices: (0..3).map(vertex).collect(),
                triangles: vec![[0, 1, 2]],
                breaks: vec![],
            }
        };
        let surface =
            |material, height| Surface { material, kind: PartKind::Wood, mesh: Arc::new(mesh(height)) };
        let individuals = vec![
            Individual { surfaces: vec![surface(0, 1.0)], ..Individual::default() },
            Individual { surfaces: vec![surface(0, 2.0), surface(1, 0.5)], ..Individual::default() },
        ];
        let kind = KindStock { name: "reed".into(), individuals, remarks: Vec::new() };
        let materials = ["green", "brown"].map(|name| Material::plain(name, [0.2; 3])).to_vec();
        let place = |variant, x: f32, turn| Place {
            kind: 0,
            variant,
            at: Vec3::X * x,
            rotation: Quat::from_rotation_y(turn),
            scale: 1.0 + 0.1 * x,
        };
        let places = vec![place(1, 0.0, 0.3), place(0, 2.0, 1.0), place(1, 5.0, 4.0)];
        let ground = Some((mesh(0.1), vec![Material::plain("soil", [0.1; 3])]));
        Garden { stock: Stock { materials, kinds: vec![kind] }, places, ground, walls: Vec::new() }
    }

    #[test]
    fn both_forms_of_a_garden_have_the_same_triangles_in_the_same_places() {
        let garden = triangles();
        let (model, instanced) = (garden.model(), garden.instanced());
        assert_eq!(model.check_invariants(), Ok(()));
        assert_eq!(instanced.model.check_invariants(), Ok(()));
        assert_eq!((model.triangle_count(), garden.triangle_count()), (6, 6));
        assert_eq!(model.parts[0].kind, PartKind::Ground);
        assert_eq!(
            model.parts.iter().map(|part| part.name.as_str()).collect::<Vec<_>>(),
            ["ground", "reed_green", "reed_brown"]
        );
        let names: Vec<_> = instanced.groups.iter().map(|group| group.shape.name.as_str()).collect();
        assert_eq!(names, ["reed_1", "reed_2"]);
        assert_eq!(instanced.groups[1].shape.mesh.breaks, [1]);
        let posed = instanced.groups.iter().flat_map(|group| {
            let points = &group.shape.mesh.points;
            group.poses.iter().flat_map(move |pose| points.iter().map(|point| pose.place(*point)))
        });
        let mut posed: Vec<Vec3> = posed.chain(instanced.model.parts.iter().flat_map(Part::points)).collect();
        let mut flat: Vec<Vec3> = model.flattened().parts.iter().flat_map(Part::points).collect();
        let order =
            |a: &Vec3, b: &Vec3| (a.x + 7.0 * a.y + 3.0 * a.z).total_cmp(&(b.x + 7.0 * b.y + 3.0 * b.z));
        posed.sort_by(order);
        flat.sort_by(order);
        assert_eq!(posed.len(), flat.len());
        assert!(posed.iter().zip(&flat).all(|(a, b)| a.distance(*b) < 1e-5), "{posed:?} {flat:?}");
    }
}
