//! Parts of one material on the GPU: a few growing buffers in which parts come and go, drawn in one call. A pool holds no
//! more than the device's largest buffer; then another is begun.
//!
//! Indices that no part uses are zero: triangles without area, which draw nothing. Writes are gathered into runs, because
//! each write to the GPU costs the same however short it is.

use super::arena::Arena;
use super::corner::{Corner, Tint};
use super::drawn::{self, Drawn};
use super::gpu::Gpu;
use super::surface::Room;
use bytemuck::Pod;
use std::ops::Range;

/// Fewest elements of a buffer.
const LEAST: u32 = 1024;

/// Elements to be written, by place; neighbours join.
struct Runs<T>(Vec<(u32, Vec<T>)>);

impl<T: Pod> Runs<T> {
    fn push(&mut self, start: u32, elements: impl IntoIterator<Item = T>) {
        match self.0.last_mut() {
            Some((first, run)) if *first as usize + run.len() == start as usize => run.extend(elements),
            _ => self.0.push((start, elements.into_iter().collect())),
        }
    }
}

/// A buffer that grows by copying itself.
struct Growing<T> {
    buffer: wgpu::Buffer,
    capacity: u32,
    zeros: Runs<T>,
    runs: Runs<T>,
}

impl<T: Pod> Growing<T> {
    fn new(gpu: &Gpu, label: &str, usage: wgpu::BufferUsages) -> Self {
        let buffer = Self::allocate(gpu, label, usage, LEAST);
        Self { buffer, capacity: LEAST, zeros: Runs(Vec::new()), runs: Runs(Vec::new()) }
    }

    fn allocate(gpu: &Gpu, label: &str, usage: wgpu::BufferUsages, capacity: u32) -> wgpu::Buffer {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: u64::from(capacity) * size_of::<T>() as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        })
    }

    /// Writes what is waiting and returns how many bytes that was. The buffer will hold at least `len` elements, and `most`
    /// at most.
    fn flush(&mut self, gpu: &Gpu, label: &str, usage: wgpu::BufferUsages, (len, most): (u32, u32)) -> u64 {
        if len > self.capacity {
            let capacity = len.max(self.capacity.saturating_mul(2).min(most));
            let larger = Self::allocate(gpu, label, usage, capacity);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            encoder.copy_buffer_to_buffer(&self.buffer, 0, &larger, 0, self.buffer.size());
            // Before any write to the larger buffer, which would otherwise come first.
            gpu.queue.submit([encoder.finish()]);
            (self.buffer, self.capacity) = (larger, capacity);
        }
        let mut bytes = 0;
        for (start, run) in self.zeros.0.drain(..).chain(self.runs.0.drain(..)) {
            let run: &[u8] = bytemuck::cast_slice(&run);
            gpu.queue.write_buffer(&self.buffer, u64::from(start) * size_of::<T>() as u64, run);
            bytes += run.len() as u64;
        }
        bytes
    }
}

/// Where a part lies in its pool.
#[derive(Clone, Debug)]
pub(super) struct Place {
    vertices: Range<u32>,
    indices: Range<u32>,
}

impl Place {
    /// Index of the part's first corner in the pool.
    pub(super) fn first_corner(&self) -> u32 {
        self.vertices.start
    }
}

/// The parts of one material.
pub(super) struct Pool {
    corners: Growing<Corner>,
    tints: Growing<Tint>,
    indices: Growing<u32>,
    vertex_arena: Arena,
    index_arena: Arena,
    room: Room,
    placement: wgpu::Buffer,
}

impl Pool {
    pub(super) fn new(gpu: &Gpu) -> Self {
        Self {
            corners: Growing::new(gpu, "corners", wgpu::BufferUsages::VERTEX),
            tints: Growing::new(gpu, "tints", wgpu::BufferUsages::VERTEX),
            indices: Growing::new(gpu, "indices", wgpu::BufferUsages::INDEX),
            vertex_arena: Arena::default(),
            index_arena: Arena::default(),
            room: Room::of(gpu),
            placement: drawn::alone(gpu),
        }
    }

    /// Whether a part of so many corners and triangles can be taken in.
    pub(super) fn has_room(&self, corners: usize, triangles: usize) -> bool {
        let (corners, indices) = (u32::try_from(corners), u32::try_from(3 * triangles));
        corners.is_ok_and(|corners| self.vertex_arena.has_room(corners, self.room.corners))
            && indices.is_ok_and(|indices| self.index_arena.has_room(indices, self.room.indices))
    }

    /// Whether most of it is holes, so that starting afresh is worth it.
    pub(super) fn is_sparse(&self) -> bool {
        self.vertex_arena.is_sparse() || self.index_arena.is_sparse()
    }

    /// Takes a part in; it is on the GPU after the next flush.
    pub(super) fn insert(&mut self, corners: &[Corner], triangles: &[[u32; 3]], tint: Tint) -> Place {
        let vertices = self.vertex_arena.take(corners.len() as u32);
        let indices = self.index_arena.take(3 * triangles.len() as u32);
        self.corners.runs.push(vertices.start, corners.iter().copied());
        self.tints.runs.push(vertices.start, corners.iter().map(|_| tint));
        self.indices.runs.push(indices.start, triangles.iter().flatten().map(|i| vertices.start + i));
        Place { vertices, indices }
    }

    /// Lets a part go.
    pub(super) fn remove(&mut self, place: &Place) {
        self.vertex_arena.give_back(&place.vertices);
        self.index_arena.give_back(&place.indices);
        self.indices.zeros.push(place.indices.start, place.indices.clone().map(|_| 0));
    }

    /// Gives a part another colour in the debugging views.
    pub(super) fn set_tint(&mut self, place: &Place, tint: Tint) {
        self.tints.runs.push(place.vertices.start, place.vertices.clone().map(|_| tint));
    }

    /// Sends what changed to the GPU and returns how many bytes that was.
    pub(super) fn flush(&mut self, gpu: &Gpu) -> u64 {
        let vertices = (self.vertex_arena.end(), self.room.corners);
        let indices = (self.index_arena.end(), self.room.indices);
        self.corners.flush(gpu, "corners", wgpu::BufferUsages::VERTEX, vertices)
            + self.tints.flush(gpu, "tints", wgpu::BufferUsages::VERTEX, vertices)
            + self.indices.flush(gpu, "indices", wgpu::BufferUsages::INDEX, indices)
    }

    /// All parts, and the holes between them.
    pub(super) fn drawn(&self) -> Drawn {
        Drawn {
            corners: self.corners.buffer.clone(),
            placements: self.placement.clone(),
            indices: self.indices.buffer.clone(),
            range: 0..self.index_arena.end(),
            copies: 0..1,
            in_view: 0..1,
        }
    }

    /// Colours of the corners in the debugging views.
    pub(super) fn tints(&self) -> &wgpu::Buffer {
        &self.tints.buffer
    }
}
