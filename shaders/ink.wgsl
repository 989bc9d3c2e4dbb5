// Ink on paper: each segment of a stroke is a capsule whose radius runs from one end's to the other's.
//
// Coverage is computed from the distance to the capsule; pixels keep the darkest of what is drawn on them (blend
// operation "min"), so that overlapping segments of one stroke join without seams or dark knots.

struct Sheet {
    // clip = canvas · scale + offset.
    clip_from_canvas: vec4<f32>,
    // Linear colour; w is the canvas size of one picture pixel.
    ink: vec4<f32>,
};

@group(0) @binding(0) var<uniform> sheet: Sheet;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) canvas: vec2<f32>,
    // Position and radius of the segment's ends.
    @location(1) @interpolate(flat) begin: vec3<f32>,
    @location(2) @interpolate(flat) end: vec3<f32>,
};

@vertex
fn vertex(@builtin(vertex_index) index: u32, @location(0) begin: vec3<f32>, @location(1) end: vec3<f32>) -> Corner {
    let reach = max(begin.z, end.z) + sheet.ink.w;
    let low = min(begin.xy, end.xy) - reach;
    let high = max(begin.xy, end.xy) + reach;
    let canvas = mix(low, high, vec2(f32(index & 1u), f32(index >> 1u)));
    let clip = canvas * sheet.clip_from_canvas.xy + sheet.clip_from_canvas.zw;
    return Corner(vec4(clip, 0.5, 1.0), canvas, begin, end);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    let axis = corner.end.xy - corner.begin.xy;
    let from_begin = corner.canvas - corner.begin.xy;
    let along = clamp(dot(from_begin, axis) / max(dot(axis, axis), 1e-12), 0.0, 1.0);
    let radius = mix(corner.begin.z, corner.end.z, along);
    let outside = length(from_begin - axis * along) - radius;
    let coverage = clamp(0.5 - outside / sheet.ink.w, 0.0, 1.0);
    return vec4(mix(vec3(1.0), sheet.ink.rgb, coverage), 1.0);
}
