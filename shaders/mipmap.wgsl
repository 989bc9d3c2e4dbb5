// One level of a picture from the level above it; clear pixels do not bleed their colour into visible ones.

@group(0) @binding(0) var above: texture_2d<f32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(full_screen(index), 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let last = vec2<i32>(textureDimensions(above)) - 1;
    let first = vec2<i32>(pixel.xy) * 2;
    var sum = vec4(0.0);
    var plain = vec3(0.0);
    for (var i = 0; i < 4; i++) {
        let texel = textureLoad(above, min(first + vec2(i & 1, i >> 1u), last), 0);
        sum += vec4(texel.rgb * texel.a, texel.a);
        plain += texel.rgb;
    }
    let colour = select(plain / 4.0, sum.rgb / sum.a, sum.a > 0.0);
    return vec4(colour, sum.a / 4.0);
}
