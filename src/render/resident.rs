//! A changing model that stays on the GPU: only parts whose mesh changed are uploaded.
//!
//! A part is known again by a fingerprint of its mesh and then by [`same_mesh`], not by its name: a new petal may give its
//! neighbours other names. Parts of one material share a [`Pool`] and are drawn in one call. A refused model changes
//! nothing: what was there before stays. Copies of a shape are a table beside the shape. A part of several materials, or of more triangles than a buffer holds, is several
//! residents.

use super::RenderError;
use super::copies::{self, ResidentCopies};
use super::corner::{Corner, Tint};
use super::crowd::CrowdDrawData;
use super::debug;
use super::drawn::Drawn;
use super::gpu::Gpu;
use super::material::{MaterialLayout, Pictures, TextureSource};
use super::pool::{Place, Pool};
use super::surface::{self, Batch, Room, Submesh, SurfaceDrawData};
use crate::garden::Seen;
use crate::model::{Mesh, Model, PartKind};
use crate::plant::Material;
use crate::random::mix;
use glam::Vec3;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

/// Pictures that are kept although no material uses them, so that changing one's mind is free.
const SPARE_PICTURES: usize = 64;
/// Points of a mesh that its fingerprint looks at.
const FINGERPRINT_POINTS: usize = 8;

/// How a part's mesh is kept for comparison.
type KeptMesh = Arc<Mesh>;

/// Whether a mesh is the one that was uploaded.
fn same_mesh(uploaded: &KeptMesh, now: &KeptMesh) -> bool {
    Arc::ptr_eq(uploaded, now) || uploaded == now
}

/// What an update of a live model did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UploadStats {
    /// Parts of the model.
    pub parts: usize,
    /// Parts whose mesh went to the GPU, each once for every material that it has.
    pub uploaded_parts: usize,
    /// Parts that were there before and are no more, counted alike.
    pub removed_parts: usize,
    /// Pictures that went to the GPU.
    pub uploaded_textures: usize,
    /// Bytes of meshes that went to the GPU, including overwritten places.
    pub bytes: u64,
}

/// Where a pool is found: by its material and its number among that material's.
type PoolKey = (usize, usize);

/// A submesh on the GPU.
struct Resident {
    pool: PoolKey,
    triangles: Range<usize>,
    fingerprint: u64,
    mesh: KeptMesh,
    place: Place,
    tint: Tint,
    repeats: bool,
    bounds: (Vec3, Vec3),
}

/// A changing model on the GPU.
#[derive(Default)]
pub(super) struct ResidentModel {
    residents: Vec<Resident>,
    pools: BTreeMap<PoolKey, Pool>,
    copies: Vec<ResidentCopies>,
    materials: Vec<Material>,
    /// By material: whether its picture repeats, and the bind group.
    groups: Vec<(bool, wgpu::BindGroup)>,
    pictures: Pictures,
    /// What the shaded view draws.
    pub(super) surface: SurfaceDrawData,
    /// Smallest and largest corner; none without parts.
    pub(super) bounds: Option<(Vec3, Vec3)>,
    /// Height of its own ground.
    pub(super) ground: Option<f32>,
    /// Grows with every change.
    pub(super) version: u64,
    /// Edges with their tints, and the version they belong to.
    edges: Option<(u64, Vec<(Drawn, wgpu::Buffer)>)>,
}

/// A submesh of the next model: known already, or its corners and triangles.
enum Next<'a> {
    Known(Resident),
    New(Vec<Corner>, Cow<'a, [[u32; 3]]>),
}

/// The plants of the next garden: none, known already, or uploaded with so many bytes.
enum NextCrowd {
    None,
    Known,
    New(Box<CrowdDrawData>, u64),
}

impl ResidentModel {
    /// Makes the model on the GPU this one.
    ///
    /// # Errors
    /// A model that contradicts itself or a texture that cannot be used, both without any change; or a failure of the
    /// driver.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        layout: &MaterialLayout,
        seen: &Seen<'_>,
        textures: &TextureSource<'_>,
    ) -> Result<UploadStats, RenderError> {
        let model = &*seen.model;
        surface::check_materials(model)?;
        let known_pictures = self.pictures.len();
        let views = self.load_pictures(gpu, layout, &model.materials, textures)?;
        let mut stats = UploadStats {
            parts: model.parts.len(),
            uploaded_textures: self.pictures.len() - known_pictures,
            ..Default::default()
        };
        let crowd = self.new_crowd(gpu, seen)?;
        let corners = self.new_corners(model, Room::of(gpu))?;
        self.place_crowd(crowd, &mut stats);
        self.place(gpu, model, corners, &mut stats);
        self.place_copies(gpu, model, &mut stats);
        for pool in self.pools.values_mut() {
            stats.bytes += pool.flush(gpu);
        }
        let materials_changed = self.bind(gpu, layout, model, &views);
        if stats.uploaded_parts + stats.removed_parts > 0 || materials_changed || self.version == 0 {
            self.version += 1;
        }
        let boxes = self.residents.iter().map(|r| r.bounds).chain(self.copies.iter().map(|c| c.bounds));
        let boxes = boxes.filter(|(lo, _)| lo.is_finite());
        let of_crowd = seen.crowd.iter().filter_map(|crowd| crowd.bounds());
        self.ground = model.ground_level();
        self.bounds = boxes.chain(of_crowd).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        gpu.check()?;
        Ok(stats)
    }

    fn load_pictures(
        &mut self,
        gpu: &Gpu,
        layout: &MaterialLayout,
        materials: &[Material],
        textures: &TextureSource<'_>,
    ) -> Result<Vec<wgpu::TextureView>, RenderError> {
        if self.pictures.len() > SPARE_PICTURES {
            self.pictures.keep_only(&self.materials);
        }
        let pictures = &mut self.pictures;
        materials.iter().map(|m| layout.picture(gpu, pictures, m.texture.as_ref(), textures)).collect()
    }

    /// For each submesh the resident that it is, or its corners. Residents that are left over stay in the list.
    fn new_corners<'a>(&mut self, model: &'a Model, room: Room) -> Result<Vec<Next<'a>>, RenderError> {
        let mut by_mesh: BTreeMap<(usize, u64), Vec<usize>> = BTreeMap::new();
        for (i, resident) in self.residents.iter().enumerate().rev() {
            if !self.pools.get(&resident.pool).is_none_or(Pool::is_sparse) {
                by_mesh.entry((resident.pool.0, resident.fingerprint)).or_default().push(i);
            }
        }
        let mut claimed = Vec::with_capacity(model.parts.len());
        let mut corners = Vec::with_capacity(model.parts.len());
        for (part, (material, triangles)) in surface::submeshes(model, room) {
            let alike = by_mesh.get_mut(&(material, fingerprint(&part.mesh)));
            let claim = alike.and_then(|alike| {
                let is_this = |i: &usize| {
                    let resident = &self.residents[*i];
                    resident.triangles == triangles && same_mesh(&resident.mesh, &part.mesh)
                };
                Some(alike.remove(alike.iter().rposition(is_this)?))
            });
            claimed.push(claim);
            corners.push(match claim {
                Some(_) => None,
                None => Some(surface::geometry_of(part, &triangles)?),
            });
        }
        // From here on nothing fails.
        let mut residents: Vec<Option<Resident>> = self.residents.drain(..).map(Some).collect();
        let next = claimed.into_iter().zip(corners).filter_map(|(claim, corners)| match corners {
            Some((corners, triangles)) => Some(Next::New(corners, triangles)),
            None => residents.get_mut(claim?)?.take().map(Next::Known),
        });
        let next = next.collect();
        self.residents = residents.into_iter().flatten().collect();
        Ok(next)
    }

    /// Lets the residents go that are left over, and puts the next ones in their place.
    fn place(&mut self, gpu: &Gpu, model: &Model, next: Vec<Next<'_>>, stats: &mut UploadStats) {
        for resident in self.residents.drain(..) {
            stats.removed_parts += 1;
            if let Some(pool) = self.pools.get_mut(&resident.pool) {
                pool.remove(&resident.place);
            }
        }
        let room = Room::of(gpu);
        let levels = model.parts.iter().zip(levels(model));
        let levels = levels.flat_map(|(part, level)| surface::submeshes_of(part, room).map(move |_| level));
        for ((submesh, next), level) in surface::submeshes(model, room).zip(next).zip(levels) {
            let (part, (material, _)) = submesh;
            let tint = debug::tint(part.kind, level, &part.name);
            self.residents.push(match next {
                Next::Known(resident) => {
                    if let Some(pool) = self.pools.get_mut(&resident.pool).filter(|_| resident.tint != tint) {
                        pool.set_tint(&resident.place, tint);
                    }
                    Resident { tint, ..resident }
                }
                Next::New(corners, triangles) => {
                    stats.uploaded_parts += 1;
                    let key = self.pool_with_room(material, corners.len(), triangles.len());
                    let pool = self.pools.entry(key).or_insert_with(|| Pool::new(gpu));
                    resident(submesh, key, tint, &corners, pool.insert(&corners, &triangles, tint))
                }
            });
        }
        let used: BTreeSet<PoolKey> = self.residents.iter().map(|resident| resident.pool).collect();
        self.pools.retain(|key, _| used.contains(key));
    }

    /// Brings the copies in step: where their shape was there already, only their places are uploaded.
    fn place_copies(&mut self, gpu: &Gpu, model: &Model, stats: &mut UploadStats) {
        let mut known: Vec<Option<ResidentCopies>> = self.copies.drain(..).map(Some).collect();
        for group in copies::groups(model) {
            let part = &model.parts[group.part];
            let tint = debug::tint(part.kind, 0, &part.name);
            let same = known.iter_mut().find(|known| known.as_ref().is_some_and(|k| k.is_of(&group, tint)));
            let (resident, bytes) = match same.and_then(Option::take) {
                Some(mut resident) => {
                    let bytes = resident.place(gpu, &group);
                    (resident, bytes)
                }
                None => ResidentCopies::new(gpu, &group, tint),
            };
            stats.uploaded_parts += usize::from(bytes > 0);
            stats.bytes += bytes;
            self.copies.push(resident);
        }
        stats.removed_parts += known.iter().flatten().count();
    }

    /// The plants of a garden, where they are not those that are there; shapes that are there stay.
    fn new_crowd(&self, gpu: &Gpu, seen: &Seen<'_>) -> Result<NextCrowd, RenderError> {
        let known = self.surface.crowd.as_ref();
        match &seen.crowd {
            None => Ok(NextCrowd::None),
            Some(crowd) if known.is_some_and(|known| known.is_of(crowd)) => Ok(NextCrowd::Known),
            Some(crowd) => {
                let (crowd, bytes) = CrowdDrawData::new(gpu, &seen.model, crowd, known)?;
                Ok(NextCrowd::New(Box::new(crowd), bytes))
            }
        }
    }

    fn place_crowd(&mut self, next: NextCrowd, stats: &mut UploadStats) {
        let known = &mut self.surface.crowd;
        match next {
            NextCrowd::Known => {}
            NextCrowd::New(crowd, bytes) => {
                *known = Some(*crowd);
                stats.uploaded_parts += 1;
                stats.bytes += bytes;
            }
            NextCrowd::None => stats.removed_parts += usize::from(known.take().is_some()),
        }
    }

    /// The first pool of a material that can take so many corners and triangles in, or a new one.
    fn pool_with_room(&self, material: usize, corners: usize, triangles: usize) -> PoolKey {
        let mut number = 0;
        while self.pools.get(&(material, number)).is_some_and(|pool| !pool.has_room(corners, triangles)) {
            number += 1;
        }
        (material, number)
    }

    /// Binds materials that changed and lists what is drawn; whether any changed.
    fn bind(
        &mut self,
        gpu: &Gpu,
        layout: &MaterialLayout,
        model: &Model,
        views: &[wgpu::TextureView],
    ) -> bool {
        let mut repeats = vec![false; model.materials.len()];
        for resident in &self.residents {
            repeats[resident.pool.0] |= resident.repeats;
        }
        for copies in &self.copies {
            repeats[copies.material] |= copies.shape.repeats;
        }
        if let Some(crowd) = &self.surface.crowd {
            repeats.iter_mut().enumerate().for_each(|(i, repeat)| *repeat |= crowd.repeats(i));
        }
        let mut changed = self.materials.len() != model.materials.len();
        let mut groups = Vec::with_capacity(repeats.len());
        for (i, (material, repeat)) in model.materials.iter().zip(repeats).enumerate() {
            let kept =
                self.groups.get(i).filter(|g| g.0 == repeat && self.materials.get(i) == Some(material));
            groups.push(kept.cloned().unwrap_or_else(|| {
                changed = true;
                (repeat, layout.bind(gpu, material, &views[i], repeat))
            }));
        }
        self.groups = groups;
        self.materials.clone_from(&model.materials);
        let pools = self.pools.iter().map(|(&(material, _), pool)| (material, pool.drawn()));
        let copies = self.copies.iter().map(|copies| (copies.material, copies.drawn.clone()));
        let drawn = pools.chain(copies).filter(|(_, drawn)| !drawn.range.is_empty());
        let batch = |(material, drawn): (usize, Drawn)| {
            Batch::new(&self.materials[material], self.groups[material].1.clone(), drawn)
        };
        let crowd = self.surface.crowd.take();
        let of_crowd = crowd.iter().flat_map(CrowdDrawData::drawn);
        let batches = drawn.chain(of_crowd).map(batch).collect();
        self.surface = SurfaceDrawData { batches, crowd };
        changed
    }

    /// All faces with their tints.
    pub(super) fn faces(&self) -> impl Iterator<Item = (Drawn, &wgpu::Buffer)> {
        let pools = self.pools.values().map(|pool| (pool.drawn(), pool.tints()));
        let copies = self.copies.iter().map(|copies| (copies.drawn.clone(), &copies.shape.tints));
        pools.chain(copies).chain(self.surface.crowd.iter().flat_map(CrowdDrawData::faces))
    }

    /// The edges of all triangles with their tints, uploaded when they are first asked for.
    pub(super) fn edges(&mut self, gpu: &Gpu) -> Vec<(Drawn, wgpu::Buffer)> {
        let version = self.version;
        if self.edges.as_ref().is_none_or(|(of, _)| *of != version) {
            self.edges = Some((version, self.upload_edges(gpu)));
        }
        let of_crowd = self.surface.crowd.iter_mut().flat_map(|crowd| crowd.edges(gpu));
        self.edges.iter().flat_map(|(_, edges)| edges.iter().cloned()).chain(of_crowd).collect()
    }

    /// Lets the edges go.
    pub(super) fn forget_edges(&mut self) {
        self.edges = None;
        self.surface.crowd.iter_mut().for_each(CrowdDrawData::forget_edges);
    }

    fn upload_edges(&self, gpu: &Gpu) -> Vec<(Drawn, wgpu::Buffer)> {
        let mut pairs: BTreeMap<PoolKey, Vec<u32>> = BTreeMap::new();
        for resident in &self.residents {
            let first = resident.place.first_corner();
            let pairs = pairs.entry(resident.pool).or_default();
            for &[a, b, c] in surface::renumbered(&resident.mesh, &resident.triangles).1.iter() {
                pairs.extend([a, b, b, c, c, a].map(|i| first + i));
            }
        }
        let pairs = pairs.into_iter().filter(|(_, pairs)| !pairs.is_empty());
        let of_pools = pairs.filter_map(|(key, pairs)| {
            let pool = self.pools.get(&key)?;
            let indices = gpu.buffer("edges", bytemuck::cast_slice(&pairs), wgpu::BufferUsages::INDEX);
            let drawn = Drawn { indices, range: 0..pairs.len() as u32, ..pool.drawn() };
            Some((drawn, pool.tints().clone()))
        });
        of_pools
            .chain(self.copies.iter().map(|copies| (copies.edges(gpu), copies.shape.tints.clone())))
            .collect()
    }
}

fn resident(
    (part, (_, triangles)): Submesh<'_>,
    pool: PoolKey,
    tint: Tint,
    corners: &[Corner],
    place: Place,
) -> Resident {
    let (lo, hi) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let bounds = corners.iter().fold((lo, hi), |(lo, hi), c| (lo.min(c.world), hi.max(c.world)));
    Resident {
        pool,
        triangles,
        fingerprint: fingerprint(&part.mesh),
        mesh: part.mesh.clone(),
        place,
        tint,
        repeats: corners.iter().any(Corner::repeats),
        bounds,
    }
}

/// For each part how many ancestors its branch has.
fn levels(model: &Model) -> Vec<usize> {
    let mut levels: Vec<usize> = Vec::with_capacity(model.parts.len());
    for part in &model.parts {
        let parent = part.parent.filter(|_| part.kind == PartKind::Wood);
        levels.push(parent.and_then(|p| levels.get(p)).map_or(0, |level| level + 1));
    }
    levels
}

/// A number that differs between most meshes, from a few of their points.
fn fingerprint(mesh: &Mesh) -> u64 {
    let step = (mesh.points.len() / FINGERPRINT_POINTS).max(1);
    let points = mesh.points.iter().step_by(step).flat_map(|p| p.to_array()).map(|c| u64::from(c.to_bits()));
    let counts = [mesh.points.len(), mesh.vertices.len(), mesh.triangles.len()].map(|n| n as u64);
    counts.into_iter().chain(points).fold(0, mix)
}
