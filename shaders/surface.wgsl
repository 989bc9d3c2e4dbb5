// The plant itself: Blinn-Phong, two-sided, with light shining through.

// Light from the sky at the corners instead of at every pixel, and no relief: for drafts.
override SKY_PER_CORNER: bool = false;
// Whether materials with a relief show it.
override RELIEF: bool = true;

struct Corner {
    // The same in the depth pass and in the colour pass, to the last bit.
    @builtin(position) @invariant clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) sky_front: vec3<f32>,
    @location(4) sky_through: vec3<f32>,
};

// Light from the sky on the side that is seen, and through the surface from the other side.
struct SkyLight {
    front: vec3<f32>,
    through: vec3<f32>,
};

@vertex
fn vertex(
    @location(0) point: vec3<f32>,
    @location(1) standing_normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    copy: Placement,
) -> Corner {
    let world = above_lawn(placed(point, copy));
    let normal = turned(standing_normal, copy);
    var sky = SkyLight(vec3(0.0), vec3(0.0));
    if SKY_PER_CORNER {
        let seen = dot(normal, toward_eye(world)) >= 0.0;
        sky = sky_light(world, normal * select(-1.0, 1.0, seen), true);
    }
    let clip = frame.clip_from_world * vec4(world, 1.0);
    return Corner(clip, world, normal, vec2(uv.x, 1.0 - uv.y), sky.front, sky.through);
}

// Light that arrives from a lamp: x on the side that is seen, y through the surface from the other side.
fn incidence(normal: vec3<f32>, toward: vec3<f32>) -> vec2<f32> {
    let cosine = dot(normal, toward);
    return max(vec2(cosine, -cosine), vec2(0.0));
}

// Where to look up a lamp's shadow: a little off the surface on the lamp's side, so that it does not shade itself;
// for light from behind, through the thickness of the blade.
fn lifted(world: vec3<f32>, normal: vec3<f32>, lamp: vec4<f32>) -> vec3<f32> {
    let facing = dot(normal, lamp.xyz) >= 0.0;
    return world + normal * select(-(lamp.w + light.penumbra.z), lamp.w, facing);
}

fn sky_light(world: vec3<f32>, normal: vec3<f32>, translucent: bool) -> SkyLight {
    var sky = SkyLight(vec3(0.0), vec3(0.0));
    for (var i = 0u; i < SKY_LAMPS; i++) {
        let lamp = light.sky[i];
        let arriving = incidence(normal, lamp.toward.xyz);
        if arriving.x <= 0.0 && !translucent { continue; }
        let visible = sky_visibility(i, lifted(world, normal, lamp.toward), vec2(0.0));
        sky.front += visible * lamp.radiance.rgb * arriving.x;
        sky.through += visible * lamp.radiance.rgb * arriving.y;
    }
    return sky;
}

// Colour of light that went through pigment: the same brightness as reflected light, but deeper.
fn through(colour: vec3<f32>) -> vec3<f32> {
    let brightness = dot(colour, vec3(0.2126, 0.7152, 0.0722));
    return colour * mix(vec3(1.0), colour / max(brightness, 0.02), 0.6);
}

// Khronos PBR Neutral tone mapping: colours up to 0.8 stay as they are, brighter ones bend toward white.
fn tone_mapped(colour: vec3<f32>) -> vec3<f32> {
    let start = 0.76;
    let peak = max(colour.r, max(colour.g, colour.b));
    if peak < start { return colour; }
    let span = 1.0 - start;
    let mapped = 1.0 - span * span / (peak + span - start);
    let whiteness = 1.0 - 1.0 / (0.15 * (peak - mapped) + 1.0);
    return mix(colour * (mapped / peak), vec3(mapped), whiteness);
}

// Which opacity makes as many of a pixel's four samples covered as a share says, and over several pixels just that share: what lies between
// two numbers goes to either by an even noise (Jimenez 2014, interleaved gradient noise). A little less than a whole number of quarters, for
// devices that round up are as many as those that round to the nearest.
fn samples_covered(share: f32, pixel: vec2<f32>) -> f32 {
    let noise = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
    return max(floor(4.0 * share + noise) / 4.0 - 0.0625, 0.0);
}

// How high a place of the picture stands, 0 to 1: as `src/picture/relief.rs` says.
fn height_at(uv: vec2<f32>) -> f32 {
    let texel = textureSample(picture, picture_sampler, uv);
    return sqrt(dot(texel.rgb, vec3(0.2126, 0.7152, 0.0722)));
}

// The normal of the surface with the picture's relief on it. The directions in which u and v grow on the surface come from how position
// and uv change between neighbouring pixels (Mikkelsen 2010, "Bump Mapping Unparametrized Surfaces on the GPU").
fn with_relief(normal: vec3<f32>, world: vec3<f32>, uv: vec2<f32>) -> vec3<f32> {
    let uv_x = dpdx(uv);
    let uv_y = dpdy(uv);
    // At least a texel, so that a near surface is smooth, and at least a pixel, so that a far one does not flicker.
    let reach = max(1.0 / vec2<f32>(textureDimensions(picture)), max(abs(uv_x), abs(uv_y)));
    let u_step = vec2(reach.x, 0.0);
    let v_step = vec2(0.0, reach.y);
    let rise = vec2(
        height_at(uv + u_step) - height_at(uv - u_step),
        height_at(uv + v_step) - height_at(uv - v_step),
    ) / (2.0 * reach);
    let x = cross(dpdy(world), normal);
    let y = cross(normal, dpdx(world));
    let along_u = x * uv_x.x + y * uv_y.x;
    let along_v = x * uv_x.y + y * uv_y.y;
    let longest = sqrt(max(dot(along_u, along_u), dot(along_v, along_v)));
    let side = sign(dot(dpdx(world), x)) * material.relief.x / max(longest, 1e-20);
    return normalize(normal - side * (rise.x * along_u + rise.y * along_v));
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let texel = textureSample(picture, picture_sampler, corner.uv);
    // One pixel wide around the middle of the picture's alpha: what alpha-to-coverage turns into a smooth edge. What is clear may
    // have any alpha below the middle, and where that changes there is no edge.
    let middle = clamp(texel.a, 0.4, 0.6);
    let edge = clamp((middle - 0.5) / max(fwidth(middle), 1e-4) + 0.5, 0.0, 1.0);
    let cut = select(1.0, edge, material.diffuse.w > 0.5);
    let alpha = select(cut, samples_covered(texel.a, corner.clip.xy), material.diffuse.w > 1.5);

    var normal = normalize(corner.normal) * select(-1.0, 1.0, front);
    if RELIEF && !SKY_PER_CORNER && material.relief.x > 0.0 { normal = with_relief(normal, corner.world, corner.uv); }
    let eye = toward_eye(corner.world);
    let colour = material.diffuse.rgb * texel.rgb;
    let translucency = material.ambient.w;
    let glow = through(colour) * translucency;
    let matt = colour * (1.0 - 0.4 * translucency);

    let up = 0.5 + 0.5 * normal.y;
    var seen = material.ambient.rgb * texel.rgb * mix(light.ambient_below.rgb, light.ambient_above.rgb, up);
    let sheen = pow(1.0 - max(dot(normal, eye), 0.0), 4.0) * material.specular.rgb;
    var sky = SkyLight(corner.sky_front, corner.sky_through);
    if !SKY_PER_CORNER { sky = sky_light(corner.world, normal, translucency > 0.0); }
    seen += (matt + sheen) * sky.front + glow * sky.through;

    let sun = light.sun;
    let arriving = incidence(normal, sun.toward.xyz);
    if arriving.x + arriving.y * translucency > 0.0 {
        let halfway = normalize(sun.toward.xyz + eye);
        let shine = pow(max(dot(normal, halfway), 0.0), max(material.specular.w, 1.0));
        let sharp = material.specular.rgb * select(0.0, shine, arriving.x > 0.0);
        let visible = sun_visibility(lifted(corner.world, normal, sun.toward), corner.clip.xy);
        seen += visible * sun.radiance.rgb * (matt * arriving.x + glow * arriving.y + sharp);
    }
    return vec4(tone_mapped(seen), alpha);
}
