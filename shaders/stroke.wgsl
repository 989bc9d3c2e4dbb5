// Strokes: each piece of a stroke is a capsule whose radius runs from one end's to the other's.
//
// Where pieces of one stroke overlap each pixel belongs to the nearest of them, so that a smooth edge is blended once and
// stays smooth however dense the samples are. A piece therefore knows its neighbours; a point with a negative radius is a
// gap between strokes.

// Thinnest line in pixels of radius; thinner ones become paler instead.
const THINNEST: f32 = 0.5;
// Pieces as near as this share a pixel: rounding must never leave it to nobody.
const TIE: f32 = 1e-3;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    // Pixel position and radius of four points in a row; the piece lies between the second and the third.
    @location(0) @interpolate(flat) before: vec3<f32>,
    @location(1) @interpolate(flat) begin: vec3<f32>,
    @location(2) @interpolate(flat) end: vec3<f32>,
    @location(3) @interpolate(flat) after: vec3<f32>,
    @location(4) @interpolate(flat) colour: vec4<f32>,
};

fn seen(point: vec3<f32>) -> vec3<f32> {
    return vec3(pixel_from_canvas(point.xy), point.z * sheet.pixel_origin.z * sheet.size.z);
}

@vertex
fn vertex(
    @builtin(vertex_index) index: u32,
    @location(0) before: vec3<f32>,
    @location(1) begin: vec3<f32>,
    @location(2) end: vec3<f32>,
    @location(3) after: vec3<f32>,
    @location(4) colour: vec4<f32>,
) -> Corner {
    let from_end = vec2(f32(index & 1u), f32(index >> 1u));
    let a = seen(begin);
    let b = seen(end);
    let axis = b.xy - a.xy;
    let long = length(axis);
    let forward = select(vec2(1.0, 0.0), axis / max(long, 1e-6), long > 1e-6);
    let reach = max(max(a.z, b.z), THINNEST) + 1.0;
    let first = select(-reach, -1.0, before.z >= 0.0 && long > 1e-6);
    let at = a.xy + forward * mix(first, long + reach, from_end.x)
        + vec2(-forward.y, forward.x) * (reach * (2.0 * from_end.y - 1.0));
    var clip = clip_from_pixel(at);
    // Nothing is drawn across a gap.
    if begin.z < 0.0 || end.z < 0.0 { clip = vec4(2.0, 2.0, 0.0, 1.0); }
    return Corner(clip, seen(before), a, b, seen(after), colour);
}

// How far outside a piece a pixel lies (x), and at which share of its length (y).
fn piece(at: vec2<f32>, begin: vec3<f32>, end: vec3<f32>) -> vec2<f32> {
    let axis = end.xy - begin.xy;
    let from_begin = at - begin.xy;
    let along = clamp(dot(from_begin, axis) / max(dot(axis, axis), 1e-12), 0.0, 1.0);
    let radius = max(mix(begin.z, end.z, along), THINNEST);
    return vec2(length(from_begin - axis * along) - radius, along);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    let at = corner.clip.xy;
    let own = piece(at, corner.begin, corner.end);
    if own.x >= 0.5 { discard; }
    if corner.before.z >= 0.0 {
        if own.y <= 0.0 || piece(at, corner.before, corner.begin).x < own.x - TIE { discard; }
    }
    if corner.after.z >= 0.0 {
        let next = piece(at, corner.end, corner.after);
        if (own.y >= 1.0 && next.y > 0.0) || next.x < own.x - TIE { discard; }
    }
    let radius = mix(corner.begin.z, corner.end.z, own.y);
    let coverage = clamp(0.5 - own.x, 0.0, 1.0) * min(radius / THINNEST, 1.0);
    return blended(corner.colour.rgb, corner.colour.a * coverage);
}
