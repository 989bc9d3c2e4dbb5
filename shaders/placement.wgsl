// Where a copy of a shape stands: where the axes and the origin of the shape go.
struct Placement {
    @location(4) x: vec3<f32>,
    @location(5) y: vec3<f32>,
    @location(6) z: vec3<f32>,
    @location(7) origin: vec3<f32>,
};

fn placed(point: vec3<f32>, copy: Placement) -> vec3<f32> {
    return copy.origin + mat3x3<f32>(copy.x, copy.y, copy.z) * point;
}

// A normal follows the cofactors of the map, which keep it at a right angle to a stretched surface.
fn turned(normal: vec3<f32>, copy: Placement) -> vec3<f32> {
    let cofactors = mat3x3<f32>(cross(copy.y, copy.z), cross(copy.z, copy.x), cross(copy.x, copy.y));
    return normalize(cofactors * normal);
}
