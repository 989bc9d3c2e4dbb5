// A picture under the drawing.

struct Placement {
    // Canvas axes and origin of the picture: its width, its height, its upper left corner.
    axes: vec4<f32>,
    // xy: origin; z: opacity.
    origin: vec4<f32>,
};

@group(1) @binding(0) var<uniform> placement: Placement;
@group(1) @binding(1) var reference: texture_2d<f32>;
@group(1) @binding(2) var reference_sampler: sampler;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
};

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let uv = vec2(f32(index & 1u), f32(index >> 1u));
    let canvas = placement.axes.xy * uv.x + placement.axes.zw * uv.y + placement.origin.xy;
    return Corner(clip_from_pixel(pixel_from_canvas(canvas)), uv);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    let texel = textureSample(reference, reference_sampler, corner.uv);
    return blended(encoded_from_linear(texel.rgb), texel.a * placement.origin.z);
}
