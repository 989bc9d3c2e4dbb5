// Depth of the plant as one lamp sees it.

@group(0) @binding(0) var<uniform> lamp_from_world: mat4x4<f32>;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
};

@vertex
fn vertex(
    @location(0) point: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    copy: Placement,
) -> Corner {
    return Corner(lamp_from_world * vec4(placed(point, copy), 1.0), vec2(uv.x, 1.0 - uv.y));
}

// Only for materials that are cut out by their picture.
@fragment
fn fragment(corner: Corner) {
    if textureSample(picture, picture_sampler, corner.uv).a < 0.5 { discard; }
}
