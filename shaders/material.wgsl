// Look of one surface: Blinn-Phong colours and a picture. Mirrors `MaterialUniform` in src/render/material.rs.

struct Material {
    // Ambient colour Ka; w is the share of light that passes through.
    ambient: vec4<f32>,
    // Diffuse colour Kd; w is 1 when the picture's alpha cuts the surface out.
    diffuse: vec4<f32>,
    // Specular colour Ks; w is the exponent Ns.
    specular: vec4<f32>,
    // x: how much higher light places of the picture are than dark ones, in its widths.
    relief: vec4<f32>,
};

@group(1) @binding(0) var<uniform> material: Material;
@group(1) @binding(1) var picture: texture_2d<f32>;
@group(1) @binding(2) var picture_sampler: sampler;
