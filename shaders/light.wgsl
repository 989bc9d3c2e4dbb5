// The studio's light: one sun and a dome of weak sky lamps, each with its own shadow map.
// Mirrors `LightUniform` in src/render/light.rs.
//
// Sky lamps give what a single ambient term cannot: dim insides of a flower, and a dark foot where the plant stands.
// The sun's penumbra widens with the distance to what casts the shadow (percentage-closer soft shadows, Fernando 2005).

const SKY_LAMPS: u32 = 16u;
const GOLDEN_ANGLE: f32 = 2.3999632;
// Looks at the sun's map per pixel; a hurried picture takes fewer.
override BLOCKER_TAPS: u32 = 16u;
override SUN_TAPS: u32 = 48u;

struct Lamp {
    lamp_from_world: mat4x4<f32>,
    // Unit vector to the lamp; w is how far along its normal a point moves before its shadow is looked up, metres.
    toward: vec4<f32>,
    // Linear colour times strength.
    radiance: vec4<f32>,
};

struct Light {
    sky: array<Lamp, SKY_LAMPS>,
    sun: Lamp,
    // Growth of the sun's penumbra in map coordinates per unit of map depth; z: thickness that light shines through.
    penumbra: vec4<f32>,
    // Light bounced around the room, from above and from below.
    ambient_above: vec4<f32>,
    ambient_below: vec4<f32>,
};

@group(0) @binding(1) var<uniform> light: Light;
@group(0) @binding(2) var shadow_sampler: sampler_comparison;
@group(0) @binding(3) var sun_map: texture_depth_2d;
@group(0) @binding(4) var sun_depth: texture_2d<f32>;
@group(0) @binding(5) var sky_maps: texture_depth_2d_array;

// A fixed pattern of angles that differs between neighbouring pixels (Jimenez 2014), so that few taps look like many.
fn pixel_angle(pixel: vec2<f32>) -> f32 {
    return 6.2831853 * fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

// The i-th of n points spread evenly over the unit disc (Vogel's sunflower).
fn disc(i: u32, n: u32, turn: f32) -> vec2<f32> {
    let radius = sqrt((f32(i) + 0.5) / f32(n));
    let angle = f32(i) * GOLDEN_ANGLE + turn;
    return radius * vec2(cos(angle), sin(angle));
}

// Map coordinates and depth of a world point; the ground behind the plant may lie deeper than the map's end at 1.
fn map_from_world(lamp: Lamp, world: vec3<f32>) -> vec3<f32> {
    let clip = lamp.lamp_from_world * vec4(world, 1.0);
    return vec3(clip.xy * vec2(0.5, -0.5) + 0.5, clip.z);
}

// Mean depth of what stands between a point and the sun; 1, the value of an empty map, when nothing does.
fn blocker_depth(at: vec3<f32>, reach: vec2<f32>, turn: f32) -> f32 {
    let size = vec2<i32>(textureDimensions(sun_depth));
    var sum = vec2(0.0);
    for (var i = 0u; i < BLOCKER_TAPS; i++) {
        let uv = at.xy + disc(i, BLOCKER_TAPS, turn) * reach;
        let texel = clamp(vec2<i32>(uv * vec2<f32>(size)), vec2(0), size - 1);
        let depth = textureLoad(sun_depth, texel, 0).r;
        sum += select(vec2(0.0), vec2(depth, 1.0), depth < min(at.z, 1.0));
    }
    return select(1.0, sum.x / sum.y, sum.y > 0.0);
}

// Share of the sun seen from a world point, 0 to 1.
fn sun_visibility(world: vec3<f32>, pixel: vec2<f32>) -> f32 {
    let at = map_from_world(light.sun, world);
    let turn = pixel_angle(pixel);
    let blocker = blocker_depth(at, light.penumbra.xy * at.z, turn);
    if blocker >= 1.0 { return 1.0; }
    let texel = 1.5 / vec2<f32>(textureDimensions(sun_depth));
    let blur = max(light.penumbra.xy * (at.z - blocker), texel);
    var seen = 0.0;
    for (var i = 0u; i < SUN_TAPS; i++) {
        let uv = at.xy + disc(i, SUN_TAPS, turn) * blur;
        seen += textureSampleCompareLevel(sun_map, shadow_sampler, uv, min(at.z, 1.0));
    }
    return seen / f32(SUN_TAPS);
}

// Whether a sky lamp is seen from a world point, looked up `blur` map widths away from it.
fn sky_visibility(lamp: u32, world: vec3<f32>, blur: vec2<f32>) -> f32 {
    let at = map_from_world(light.sky[lamp], world);
    return textureSampleCompareLevel(sky_maps, shadow_sampler, at.xy + blur, lamp, min(at.z, 1.0));
}
