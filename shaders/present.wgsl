// A finished picture for the window: encoded, with opacity instead of what is seen through, and colours multiplied by it.

@group(0) @binding(0) var finished: texture_2d<f32>;
@group(0) @binding(1) var finished_sampler: sampler;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
};

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let at = full_screen(index);
    return Corner(vec4(at, 0.0, 1.0), at * vec2(0.5, -0.5) + 0.5);
}

fn encoded(linear: vec3<f32>) -> vec3<f32> {
    let bright = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return select(bright, 12.92 * linear, linear <= vec3(0.0031308));
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    let texel = textureSampleLevel(finished, finished_sampler, corner.uv, 0.0);
    let opacity = 1.0 - texel.a;
    let colour = clamp(texel.rgb / max(opacity, 1e-3), vec3(0.0), vec3(1.0));
    return vec4(encoded(colour) * opacity, opacity);
}
