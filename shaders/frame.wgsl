// One view of the scene: what every pass that draws into the picture knows about it.
// Mirrors `FrameUniform` in src/render/frame.rs.

struct Frame {
    clip_from_world: mat4x4<f32>,
    world_from_clip: mat4x4<f32>,
    // The eye's position with w = 1, or the direction toward a parallel viewer with w = 0.
    eye: vec4<f32>,
    // Linear colour in the middle of the backdrop, or of the sky overhead; w is the height of the ground, metres.
    backdrop_centre: vec4<f32>,
    // Linear colour in the corners of the backdrop, or of the horizon; w is 1 outdoors, else 0.
    backdrop_edge: vec4<f32>,
    // Middle of the plant's foot on the ground; w is the distance in metres over which its shadow fades out.
    foot: vec4<f32>,
};

@group(0) @binding(0) var<uniform> frame: Frame;

// Backdrop at a position in clip space: bright in the middle, a little darker toward the corners, as a lit paper is.
fn backdrop(clip: vec2<f32>) -> vec3<f32> {
    let out = smoothstep(0.1, 1.5, length(clip - vec2(0.0, 0.05)));
    return mix(frame.backdrop_centre.rgb, frame.backdrop_edge.rgb, out);
}

// A point of the model; outdoors none is below the lawn, where the slab of a garden would stand.
fn above_lawn(world: vec3<f32>) -> vec3<f32> {
    let lowest = select(-1e30, frame.backdrop_centre.w, frame.backdrop_edge.w > 0.5);
    return vec3(world.x, max(world.y, lowest), world.z);
}

// Unit vector from a world point to the eye.
fn toward_eye(world: vec3<f32>) -> vec3<f32> {
    return normalize(frame.eye.xyz - world * frame.eye.w);
}
