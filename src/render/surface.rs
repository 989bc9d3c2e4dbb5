//! The plant: its corners grouped by material, in as many buffers as they need, copies of shapes beside them, and the
//! pipelines that shade them.

use super::RenderError;
use super::copies::{self, ResidentCopies};
use super::corner::{self, CORNER_LAYOUT, Corner, Tint};
use super::crowd::CrowdDrawData;
use super::drawn::{self, Drawn, PLACEMENT_LAYOUT};
use super::gpu::Gpu;
use super::material::{MaterialLayout, TextureSource};
use super::pipeline::{Into, PipelineSpec};
use super::scene::SceneLayout;
use super::shaders;
use super::sight::Sight;
use crate::garden::Seen;
use crate::model::{Mesh, Model, Part};
use crate::plant::Material;
use std::borrow::Cow;
use std::ops::Range;

/// How much one buffer of each kind holds.
#[derive(Clone, Copy)]
pub(super) struct Room {
    pub(super) corners: u32,
    /// Half of what would fit: the edges of triangles are twice as many as their corners.
    pub(super) indices: u32,
}

impl Room {
    pub(super) fn of(gpu: &Gpu) -> Self {
        let largest = |bytes: usize| (gpu.largest_buffer / bytes as u64).min(u32::MAX.into()) as u32;
        Self { corners: largest(size_of::<Corner>()), indices: largest(2 * size_of::<u32>()) }
    }

    /// Most triangles that surely fit, whatever corners they have.
    fn triangles(self) -> usize {
        (self.corners.min(self.indices) / 3).max(1) as usize
    }
}

/// Triangles of one part that share a material slot and fit one buffer: the part, the material and the triangles.
pub(super) type Submesh<'a> = (&'a Part, (usize, Range<usize>));

/// All submeshes of a model.
pub(super) fn submeshes(model: &Model, room: Room) -> impl Iterator<Item = Submesh<'_>> {
    model.parts.iter().flat_map(move |part| submeshes_of(part, room).map(move |submesh| (part, submesh)))
}

/// The materials of a part with their triangles, divided where they are too many for one buffer.
pub(super) fn submeshes_of(part: &Part, room: Room) -> impl Iterator<Item = (usize, Range<usize>)> {
    part.material_slots().flat_map(move |(material, all)| {
        let ends = all.clone().step_by(room.triangles()).skip(1).chain([all.end]);
        all.step_by(room.triangles()).zip(ends).map(move |(from, to)| (material, from..to))
    })
}

/// Refuses a part that contradicts itself.
///
/// # Errors
/// What is wrong with it.
fn check_part(part: &Part) -> Result<(), RenderError> {
    let mesh = &part.mesh;
    for vertex in &mesh.vertices {
        let point = mesh.points.get(vertex.point as usize);
        let point = point.ok_or_else(|| {
            RenderError::model(&part.name, "a corner refers to a point that does not exist")
        })?;
        if !point.is_finite() {
            return Err(RenderError::model(&part.name, "a point is not a finite number"));
        }
    }
    if mesh.triangles.iter().flatten().any(|&i| i as usize >= mesh.vertices.len()) {
        return Err(RenderError::model(&part.name, "a triangle refers to a corner that does not exist"));
    }
    Ok(())
}

/// Triangles by the places of their corners.
type Triangles<'a> = Cow<'a, [[u32; 3]]>;

/// Corners and triangles of what one material of a part covers; only the corners that it has.
///
/// # Errors
/// A part that contradicts itself.
pub(super) fn geometry_of<'a>(
    part: &'a Part,
    range: &Range<usize>,
) -> Result<(Vec<Corner>, Triangles<'a>), RenderError> {
    check_part(part)?;
    let mesh = &part.mesh;
    let (kept, triangles) = renumbered(mesh, range);
    let corners = match kept {
        Some(kept) => kept.into_iter().map(|i| Corner::of(mesh, &mesh.vertices[i as usize])).collect(),
        None => corner::corners(mesh).collect(),
    };
    Ok((corners, triangles))
}

/// The corners that some triangles of a mesh have, all if none, and the triangles by their places among those.
pub(super) fn renumbered<'a>(mesh: &'a Mesh, range: &Range<usize>) -> (Option<Vec<u32>>, Triangles<'a>) {
    let triangles = &mesh.triangles[range.clone()];
    if range.len() == mesh.triangles.len() {
        return (None, triangles.into());
    }
    let mut places = vec![u32::MAX; mesh.vertices.len()];
    let mut kept = Vec::new();
    let mut place = |i: u32| {
        let place = &mut places[i as usize];
        if *place == u32::MAX {
            *place = kept.len() as u32;
            kept.push(i);
        }
        *place
    };
    let triangles: Vec<[u32; 3]> = triangles.iter().map(|triangle| triangle.map(&mut place)).collect();
    (Some(kept), triangles.into())
}

/// Refuses a model whose parts name materials, triangles or shapes that are not there.
///
/// # Errors
/// The first such part.
pub(super) fn check_materials(model: &Model) -> Result<(), RenderError> {
    for part in &model.parts {
        let mut materials = std::iter::once(&part.material).chain(&part.more_materials);
        if materials.any(|material| *material >= model.materials.len()) {
            return Err(RenderError::model(&part.name, "its material does not exist"));
        }
        let end = [part.mesh.triangles.len() as u32];
        let breaks = part.mesh.breaks.iter().chain(&end);
        if part.more_materials.len() != part.mesh.breaks.len() || !breaks.is_sorted() {
            return Err(RenderError::model(&part.name, "its materials do not fit its triangles"));
        }
        part.copies.iter().try_for_each(|copies| copies::check(part, copies))?;
    }
    Ok(())
}

/// Triangles of one material.
pub(super) struct Batch {
    drawn: Drawn,
    group: wgpu::BindGroup,
    cut_out: bool,
    double_sided: bool,
}

impl Batch {
    /// Triangles in a material whose bind group is `group`.
    pub(super) fn new(material: &Material, group: wgpu::BindGroup, drawn: Drawn) -> Self {
        let cut_out = material.cut_out && material.texture.is_some();
        Self { drawn, group, cut_out, double_sided: material.double_sided }
    }
}

/// One uploaded model, with the plants of a garden.
#[derive(Default)]
pub(super) struct SurfaceDrawData {
    /// The last are those of the crowd's surfaces.
    pub(super) batches: Vec<Batch>,
    pub(super) crowd: Option<CrowdDrawData>,
}

impl SurfaceDrawData {
    /// Uploads a model with its textures.
    ///
    /// # Errors
    /// A model that contradicts itself, or a texture that cannot be used.
    pub(super) fn new(
        gpu: &Gpu,
        materials: &MaterialLayout,
        seen: &Seen<'_>,
        textures: &TextureSource<'_>,
    ) -> Result<Self, RenderError> {
        let model = &*seen.model;
        check_materials(model)?;
        let mut gathering = Gathering::new(gpu, model);
        for material in 0..model.materials.len() {
            for (part, (_, triangles)) in
                submeshes(model, gathering.room).filter(|(_, submesh)| submesh.0 == material)
            {
                gathering.append(material, part, &triangles)?;
            }
        }
        gathering.upload();
        let Gathering { mut uploaded, mut repeats, .. } = gathering;
        for group in copies::groups(model) {
            let (copies, _) = ResidentCopies::new(gpu, &group, Tint::default());
            repeats[group.material] |= copies.shape.repeats;
            uploaded.push((group.material, copies.drawn));
        }
        let crowd =
            seen.crowd.as_ref().map(|crowd| CrowdDrawData::new(gpu, model, crowd, None)).transpose()?;
        let crowd = crowd.map(|(crowd, _)| crowd);
        if let Some(crowd) = &crowd {
            repeats.iter_mut().enumerate().for_each(|(i, repeat)| *repeat |= crowd.repeats(i));
            uploaded.extend(crowd.drawn());
        }
        let groups = materials.upload(gpu, &model.materials, &repeats, textures)?;
        let batch = |(material, drawn): (usize, Drawn)| {
            Batch::new(&model.materials[material], groups[material].clone(), drawn)
        };
        Ok(Self { batches: uploaded.into_iter().map(batch).collect(), crowd })
    }

    /// Chooses for every plant of the garden the form in which a camera sees it. Whether any changed.
    pub(super) fn choose(&mut self, gpu: &Gpu, sight: &Sight) -> bool {
        let Some(crowd) = &mut self.crowd else { return false };
        let has_changed = crowd.choose(gpu, sight);
        if has_changed {
            let first = self.batches.len() - crowd.drawn().count();
            for (batch, (_, drawn)) in self.batches[first..].iter_mut().zip(crowd.drawn()) {
                batch.drawn = drawn;
            }
        }
        has_changed
    }

    /// Triangles of which something may be seen.
    pub(super) fn triangles_in_view(&self) -> u64 {
        self.batches.iter().map(|batch| batch.drawn.triangles_in_view()).sum()
    }

    /// Draws what may be seen of the batches for which a pipeline is chosen.
    fn draw<'a>(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: impl Fn(&Batch) -> Option<&'a wgpu::RenderPipeline>,
    ) {
        for (batch, pipeline) in self.batches.iter().filter_map(|b| Some((b, pipeline(b)?))) {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(1, &batch.group, &[]);
            batch.drawn.draw(pass);
        }
    }

    /// Draws everything, with one pipeline for what is solid and one for what is cut out.
    pub(super) fn draw_all(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        [solid, cut_out]: [&wgpu::RenderPipeline; 2],
    ) {
        for batch in &self.batches {
            pass.set_pipeline(if batch.cut_out { cut_out } else { solid });
            pass.set_bind_group(1, &batch.group, &[]);
            batch.drawn.draw_all(pass);
        }
    }
}

/// A model's submeshes on their way to the GPU, material by material; buffers are filled one after the other.
struct Gathering<'a> {
    gpu: &'a Gpu,
    room: Room,
    corners: Vec<Corner>,
    indices: Vec<u32>,
    /// The indices of each material since the last upload.
    ranges: Vec<(usize, Range<u32>)>,
    /// By material.
    uploaded: Vec<(usize, Drawn)>,
    /// For each material, whether any UV lies outside the picture, so that it must repeat.
    repeats: Vec<bool>,
}

impl<'a> Gathering<'a> {
    fn new(gpu: &'a Gpu, model: &Model) -> Self {
        let room = Room::of(gpu);
        let vertices: usize = model.parts.iter().map(|part| part.mesh.vertices.len()).sum();
        let triangles: usize = model.parts.iter().map(|part| part.mesh.triangles.len()).sum();
        Self {
            gpu,
            room,
            corners: Vec::with_capacity(vertices.min(room.corners as usize)),
            indices: Vec::with_capacity((3 * triangles).min(room.indices as usize)),
            ranges: Vec::new(),
            uploaded: Vec::new(),
            repeats: vec![false; model.materials.len()],
        }
    }

    fn append(&mut self, material: usize, part: &Part, submesh: &Range<usize>) -> Result<(), RenderError> {
        let (corners, triangles) = geometry_of(part, submesh)?;
        let fits = self.corners.len() + corners.len() <= self.room.corners as usize
            && self.indices.len() + 3 * triangles.len() <= self.room.indices as usize;
        if !fits {
            self.upload();
        }
        self.repeats[material] |= corners.iter().any(Corner::repeats);
        let base = self.corners.len() as u32;
        let first = self.indices.len() as u32;
        self.corners.extend(corners);
        self.indices.extend(triangles.iter().flatten().map(|i| base + i));
        let end = self.indices.len() as u32;
        match self.ranges.last_mut() {
            Some((last, range)) if *last == material => range.end = end,
            _ => self.ranges.push((material, first..end)),
        }
        Ok(())
    }

    /// Sends what is gathered to the GPU and begins anew.
    fn upload(&mut self) {
        if self.ranges.is_empty() {
            return;
        }
        let buffer = |label, bytes, usage| self.gpu.buffer(label, bytes, usage);
        let corners = buffer("corners", bytemuck::cast_slice(&self.corners), wgpu::BufferUsages::VERTEX);
        let indices = buffer("indices", bytemuck::cast_slice(&self.indices), wgpu::BufferUsages::INDEX);
        let (placements, one) = (drawn::alone(self.gpu), 0..1);
        let all = Drawn { corners, placements, indices, range: 0..0, copies: one.clone(), in_view: one };
        self.uploaded.extend(
            self.ranges.drain(..).map(|(material, range)| (material, Drawn { range, ..all.clone() })),
        );
        self.corners.clear();
        self.indices.clear();
    }
}

/// Shades surfaces.
pub(super) struct SurfaceRenderer {
    /// By `double_sided`.
    depth: [wgpu::RenderPipeline; 2],
    /// By `[cut_out][double_sided]`.
    colour: [[wgpu::RenderPipeline; 2]; 2],
}

impl SurfaceRenderer {
    /// `taps` are constants of `light.wgsl` and `surface.wgsl`.
    pub(super) fn new(
        gpu: &Gpu,
        scene: &SceneLayout,
        materials: &MaterialLayout,
        taps: &[(&str, f64)],
    ) -> Self {
        let build = |double_sided: bool, constants, into| {
            PipelineSpec {
                label: "surface",
                wgsl: shaders::SURFACE,
                groups: &[&scene.layout, &materials.layout],
                buffers: &[CORNER_LAYOUT, PLACEMENT_LAYOUT],
                topology: wgpu::PrimitiveTopology::TriangleList,
                cull: !double_sided,
                fragment: matches!(into, Into::Picture { .. }),
                into,
                constants,
            }
            .build(gpu)
        };
        let blend = wgpu::BlendComponent::REPLACE;
        let colour = |coverage_from_alpha| Into::Picture { blend, solid: true, coverage_from_alpha };
        let both = [false, true];
        Self {
            depth: both.map(|double| build(double, &[], Into::PictureDepth)),
            colour: both.map(|cut_out| both.map(|double| build(double, taps, colour(cut_out)))),
        }
    }

    /// Draws the depth of everything solid, so that only what is seen is shaded.
    pub(super) fn draw_depth(&self, pass: &mut wgpu::RenderPass<'_>, surface: &SurfaceDrawData) {
        surface.draw(pass, |b| (!b.cut_out).then_some(&self.depth[usize::from(b.double_sided)]));
    }

    /// Draws into a pass with the scene's bind group already set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, surface: &SurfaceDrawData) {
        surface.draw(pass, |b| Some(&self.colour[usize::from(b.cut_out)][usize::from(b.double_sided)]));
    }
}
