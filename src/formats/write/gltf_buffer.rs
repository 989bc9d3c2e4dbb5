//! Descriptions of what lies in the one buffer of a glTF document: views of its bytes, and accessors of numbers in them.

use gltf_json as json;
use json::accessor::{ComponentType, GenericComponentType, Type};
use json::buffer::{Stride, Target, View};
use json::validation::{Checked::Valid, USize64};
use json::{Accessor, Index};

/// Bytes of a vertex: position, normal and texture coordinates, one after the other.
pub(super) const VERTEX_BYTES: usize = 32;
/// Bytes of a tangent.
pub(super) const TANGENT_BYTES: usize = 16;

/// So many bytes of the buffer; those for vertices hold whole vertices.
pub(super) fn view(offset: usize, length: usize, target: Option<Target>) -> View {
    let interleaved = target == Some(Target::ArrayBuffer);
    View {
        buffer: Index::new(0),
        byte_length: USize64::from(length),
        byte_offset: Some(USize64::from(offset)),
        byte_stride: interleaved.then_some(Stride(VERTEX_BYTES)),
        name: None,
        target: target.map(Valid),
        extensions: None,
        extras: Default::default(),
    }
}

/// So many numbers, or groups of them, from a byte of a view on.
pub(super) fn accessor(
    view: Option<Index<View>>,
    offset: usize,
    count: usize,
    component: ComponentType,
    kind: Type,
) -> Accessor {
    Accessor {
        buffer_view: view,
        byte_offset: Some(USize64::from(offset)),
        count: USize64::from(count),
        component_type: Valid(GenericComponentType(component)),
        type_: Valid(kind),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
        extensions: None,
        extras: Default::default(),
    }
}
