// Backdrop and ground in one: a paper without horizon on which only the plant's shadow shows where the ground is, or outdoors a lawn that
// goes over into the sky.

// Each lamp stands for a wide piece of sky: looked up this far away at most, in map widths, it draws no shadow of its own.
const SKY_BLUR: f32 = 0.035;
// Every how many-th lamp of the sky is looked at; each stands for so many.
override SKY_STEP: u32 = 1u;

// Linear colour of the lawn outdoors: that of gardens, `LAWN` in src/garden/surface.rs, and how much of it is seen without sun and sky.
const LAWN = vec3(0.085, 0.16, 0.035);
const LAWN_AMBIENT = 0.3;
// Distance over which the lawn goes over into the horizon: in distances of shadows, and at least so many metres.
const HAZE: f32 = 8.0;
const LEAST_HAZE: f32 = 300.0;

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

// Light on open ground.
fn light_on_open_ground() -> vec3<f32> {
    var open = light.sun.radiance.rgb * light.sun.toward.y;
    for (var i = 0u; i < SKY_LAMPS; i += SKY_STEP) {
        open += f32(SKY_STEP) * light.sky[i].radiance.rgb * light.sky[i].toward.y;
    }
    return open;
}

// Light on the ground at a world point.
fn light_on_ground(world: vec3<f32>, pixel: vec2<f32>) -> vec3<f32> {
    let turn = pixel_angle(pixel);
    var here = light.sun.radiance.rgb * light.sun.toward.y * sun_visibility(world, pixel);
    for (var i = 0u; i < SKY_LAMPS; i += SKY_STEP) {
        let lamp = light.sky[i];
        let sky = f32(SKY_STEP) * lamp.radiance.rgb * lamp.toward.y;
        here += sky * sky_visibility(i, world, SKY_BLUR * disc(i, SKY_LAMPS, turn));
    }
    return here;
}

// The sky so high over the horizon, 0 to 1.
fn sky_at(height: f32) -> vec3<f32> {
    return mix(frame.backdrop_edge.rgb, frame.backdrop_centre.rgb, sqrt(clamp(height, 0.0, 1.0)));
}

// The lawn at a world point so far from the eye, with the shadows of what stands there.
fn lawn(world: vec3<f32>, fade: f32, away: f32, pixel: vec2<f32>) -> vec3<f32> {
    var arriving = light_on_open_ground();
    if fade > 0.0 { arriving = mix(arriving, light_on_ground(world, pixel), fade); }
    let seen = LAWN * (arriving + LAWN_AMBIENT * light.ambient_above.rgb);
    let haze = 1.0 - exp(-away / max(HAZE * frame.foot.w, LEAST_HAZE));
    return mix(seen, frame.backdrop_edge.rgb, haze);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    let near = unprojected(corner.at, 0.0);
    let far = unprojected(corner.at, 1.0);
    let is_outdoors = frame.backdrop_edge.w > 0.5;
    let is_parallel = frame.eye.w < 0.5;
    let over_ground = near.y - frame.backdrop_centre.w;
    var paper = backdrop(corner.at);
    if is_outdoors {
        // A level parallel viewer sees the ground as a line, and what is below it as if it were cut there.
        paper = sky_at(select(normalize(far - near).y, over_ground / frame.foot.w, is_parallel));
        if is_parallel && over_ground < 0.0 { paper = lawn(near, 0.0, 0.0, corner.clip.xy); }
    }
    let fall = near.y - far.y;
    let along = over_ground / fall;
    if fall <= 1e-6 || along <= 0.0 { return vec4(paper, 1.0); }
    let world = mix(near, far, along);
    let fade = 1.0 - smoothstep(0.4, 1.0, distance(world.xz, frame.foot.xz) / frame.foot.w);
    if is_outdoors {
        let away = select(distance(near, world), distance(frame.foot.xyz, world), is_parallel);
        return vec4(lawn(world, fade, away, corner.clip.xy), 1.0);
    }
    if fade <= 0.0 { return vec4(paper, 1.0); }
    let arriving = light_on_ground(world, corner.clip.xy) / light_on_open_ground();
    let shade = mix(vec3(1.0), arriving, 0.8 * fade);
    return vec4(paper * shade, 1.0);
}
