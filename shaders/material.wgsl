// Look of one surface: Blinn-Phong colours and a picture. Mirrors `MaterialUniform` in src/render/material.rs.

struct Material {
    // Ambient colour Ka; w is the share of light that passes through.
    ambient: vec4<f32>,
    // Diffuse colour Kd; w is 1 when the picture's alpha cuts the surface out.
    diffuse: vec4<f32>,
    // Specular colour Ks; w is the exponent Ns.
    specular: vec4<f32>,
};

@group(1) @binding(0) var<uniform> material: Material;
@group(1) @binding(1) var picture: texture_2d<f32>;
@group(1) @binding(2) var picture_sampler: sampler;

// Alpha of a picture that cuts a surface out, seen from afar: in smaller copies of the picture fewer and fewer pixels are covered by
// half, so alpha grows with each (Golus 2017, "Anti-aliased Alpha Test").
fn cut_out_alpha(alpha: f32, uv: vec2<f32>) -> f32 {
    let size = vec2<f32>(textureDimensions(picture));
    let across = dpdx(uv) * size;
    let down = dpdy(uv) * size;
    let level = 0.5 * log2(max(dot(across, across), dot(down, down)));
    return alpha * (1.0 + 0.15 * clamp(level, 0.0, 4.0));
}
