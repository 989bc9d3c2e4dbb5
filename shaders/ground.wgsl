// Backdrop and ground in one: a paper without horizon on which only the plant's shadow shows where the ground is.

// Each lamp stands for a wide piece of sky: looked up this far away at most, in map widths, it draws no shadow of its own.
const SKY_BLUR: f32 = 0.035;
// Every how many-th lamp of the sky is looked at.
override SKY_STEP: u32 = 1u;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) at: vec2<f32>,
};

// One triangle that covers the picture.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let at = full_screen(index);
    return Corner(vec4(at, 1.0, 1.0), at);
}

fn unprojected(at: vec2<f32>, depth: f32) -> vec3<f32> {
    let world = frame.world_from_clip * vec4(at, depth, 1.0);
    return world.xyz / world.w;
}

// Light on open ground, and light on the ground at a world point.
fn light_on_ground(world: vec3<f32>, pixel: vec2<f32>) -> vec3<f32> {
    let turn = pixel_angle(pixel);
    let sun = light.sun.radiance.rgb * light.sun.toward.y;
    var open = sun;
    var here = sun * sun_visibility(world, pixel);
    for (var i = 0u; i < SKY_LAMPS; i += SKY_STEP) {
        let lamp = light.sky[i];
        let sky = lamp.radiance.rgb * lamp.toward.y;
        open += sky;
        here += sky * sky_visibility(i, world, SKY_BLUR * disc(i, SKY_LAMPS, turn));
    }
    return here / open;
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    let paper = backdrop(corner.at);
    let near = unprojected(corner.at, 0.0);
    let far = unprojected(corner.at, 1.0);
    let fall = near.y - far.y;
    let along = (near.y - frame.backdrop_centre.w) / fall;
    if fall <= 1e-6 || along <= 0.0 { return vec4(paper, 1.0); }
    let world = mix(near, far, along);
    let fade = 1.0 - smoothstep(0.4, 1.0, distance(world.xz, frame.foot.xz) / frame.foot.w);
    if fade <= 0.0 { return vec4(paper, 1.0); }
    let shade = mix(vec3(1.0), light_on_ground(world, corner.clip.xy), 0.8 * fade);
    return vec4(paper * shade, 1.0);
}
