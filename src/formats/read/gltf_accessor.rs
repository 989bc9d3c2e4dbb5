//! Reading accessors of a glTF document whose every number may be a lie.
//!
//! An accessor is resolved to bytes of the buffer before anything is allocated, so counts are bounded by the file. As
//! many accessors may name the same bytes, what is decoded altogether is bounded too, by [`Budget`].
//!
//! Limits: floats for vectors, unsigned integers for indices; sparse, compressed and outside data are refused by name.

use super::error::Malformed;
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::buffer::View;
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root};

/// How many elements may be decoded from one file.
pub(super) struct Budget(usize);

impl Budget {
    /// Elements per byte of the buffer: honest files have at most one, and several where meshes share vertices.
    const SHARING: usize = 4;
    /// Vertices and triangles of a plant of all the triangles that one may have, with as many vertices and half as many
    /// again.
    const COPIES: usize = crate::budget::Budget::PLANT.triangles as usize * 5 / 2;

    /// The budget of a file with this much data.
    pub(super) fn of(buffer: &[u8]) -> Self {
        Self(Self::SHARING * buffer.len())
    }

    /// The vertices and triangles that the meshes of such a file may have where its nodes place them: what a large plant has, or
    /// more in a larger file.
    pub(super) fn of_copies(buffer: &[u8]) -> Self {
        Self((Self::SHARING * buffer.len()).max(Self::COPIES))
    }

    /// Takes `count` elements from what is left.
    pub(super) fn spend(&mut self, count: usize) -> Result<(), String> {
        self.0 = self.0.checked_sub(count).ok_or("the file unfolds into far more data than it holds")?;
        Ok(())
    }
}

/// A document with its buffer.
#[derive(Clone, Copy)]
pub(super) struct Data<'a> {
    pub(super) root: &'a Root,
    pub(super) buffer: &'a [u8],
}

impl<'a> Data<'a> {
    /// Vectors of `N` floats, 2 to 4.
    pub(super) fn floats<const N: usize>(
        &self,
        index: Index<Accessor>,
        budget: &mut Budget,
    ) -> Result<Vec<[f32; N]>, Malformed> {
        let kind = match N {
            2 => Type::Vec2,
            4 => Type::Vec4,
            _ => Type::Vec3,
        };
        let mut read = || -> Result<_, String> {
            let elements = self.elements(index, kind, budget)?;
            if elements.component != ComponentType::F32 {
                return Err("only 32-bit floats are read here".to_owned());
            }
            let component =
                |bytes: &[u8], i: usize| le_bytes(bytes, 4 * i).map(f32::from_le_bytes).unwrap_or_default();
            Ok(elements.map(|bytes| std::array::from_fn(|i| component(bytes, i))).collect())
        };
        read().map_err(|reason| at(index, reason))
    }

    /// Vertex indices.
    pub(super) fn indices(&self, index: Index<Accessor>, budget: &mut Budget) -> Result<Vec<u32>, Malformed> {
        let mut read = || -> Result<_, String> {
            let elements = self.elements(index, Type::Scalar, budget)?;
            let decode = match elements.component {
                ComponentType::U8 => |bytes: &[u8]| bytes.first().copied().map(u32::from),
                ComponentType::U16 => {
                    |bytes: &[u8]| le_bytes(bytes, 0).map(u16::from_le_bytes).map(u32::from)
                }
                ComponentType::U32 => |bytes: &[u8]| le_bytes(bytes, 0).map(u32::from_le_bytes),
                _ => return Err("indices must be unsigned integers".to_owned()),
            };
            Ok(elements.map(|bytes| decode(bytes).unwrap_or_default()).collect())
        };
        read().map_err(|reason| at(index, reason))
    }

    fn elements(
        &self,
        index: Index<Accessor>,
        kind: Type,
        budget: &mut Budget,
    ) -> Result<Elements<'a>, String> {
        let accessor = self.root.accessors.get(index.value()).ok_or("there is no such accessor")?;
        if accessor.sparse.is_some() {
            return Err("sparse accessors are not read".to_owned());
        }
        let (Checked::Valid(component), Checked::Valid(found)) = (accessor.component_type, accessor.type_)
        else {
            return Err("its component type or type is unknown".to_owned());
        };
        if found != kind {
            return Err(format!("it holds {found:?}, not {kind:?}"));
        }
        let size = component.0.size() * kind.multiplicity();
        let (bytes, stride) = self.view(accessor, size)?;
        let count = usize::try_from(accessor.count.0).map_err(|_| "its count overflows")?;
        // A stride shorter than an element would let a small file claim many.
        let needed =
            count.checked_sub(1).and_then(|n| n.checked_mul(stride)).and_then(|n| n.checked_add(size));
        if needed.is_none_or(|needed| needed > bytes.len()) {
            return Err(format!("its {count} elements do not fit into its buffer view"));
        }
        budget.spend(count)?;
        Ok(Elements { bytes, stride, size, count, component: component.0 })
    }

    /// The bytes from an accessor's first element to the end of its view, and the distance between elements.
    fn view(&self, accessor: &Accessor, size: usize) -> Result<(&'a [u8], usize), String> {
        let index = accessor.buffer_view.ok_or("it has no buffer view; compressed meshes are not read")?;
        let view = self.root.buffer_views.get(index.value()).ok_or("its buffer view does not exist")?;
        if !self.is_inside(view) {
            return Err("its data are outside the file; only self-contained files are read".to_owned());
        }
        let start = accessor.byte_offset.map_or(Some(0), |offset| usize::try_from(offset.0).ok());
        let bytes = self.region(index).zip(start).and_then(|(region, start)| region.get(start..));
        let stride = view.byte_stride.map_or(size, |stride| stride.0);
        if stride < size {
            return Err(format!("its stride of {stride} bytes is shorter than an element"));
        }
        Ok((bytes.ok_or("it reaches beyond the file's data")?, stride))
    }

    /// The bytes of a buffer view, if they are in the file.
    pub(super) fn region(&self, index: Index<View>) -> Option<&'a [u8]> {
        let view = self.root.buffer_views.get(index.value()).filter(|view| self.is_inside(view))?;
        let start = usize::try_from(view.byte_offset.map_or(0, |offset| offset.0)).ok()?;
        self.buffer.get(start..start.checked_add(usize::try_from(view.byte_length.0).ok()?)?)
    }

    fn is_inside(&self, view: &View) -> bool {
        view.buffer.value() == 0 && self.root.buffers.first().is_some_and(|b| b.uri.is_none())
    }
}

fn at(index: Index<Accessor>, reason: String) -> Malformed {
    Malformed::new(format!("accessor {}", index.value()), reason)
}

fn le_bytes<const N: usize>(bytes: &[u8], from: usize) -> Option<[u8; N]> {
    bytes.get(from..from + N)?.try_into().ok()
}

/// The bytes of each element in turn.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    count: usize,
    component: ComponentType,
}

impl<'a> Iterator for Elements<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        self.count = self.count.checked_sub(1)?;
        let element = self.bytes.get(..self.size)?;
        self.bytes = self.bytes.get(self.stride..).unwrap_or_default();
        Some(element)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.count, Some(self.count))
    }
}
