// Spots over the plant: discs that face the eye, and tapering lines. What the plant hides shines through faintly.

// Draws what is hidden, faintly, and not what is seen.
override HIDDEN: bool = false;

// How much of what is hidden is seen.
const FAINT: f32 = 0.3;
// Least radius of a disc, and half width of a line, as shares of the picture's foot.
const LEAST: f32 = 0.0013;
const LINE: f32 = 0.0009;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) across: vec2<f32>,
    @location(1) colour: vec4<f32>,
};

// `way` is where a line goes from its spot; a disc has none. Corners run 0 to 3 in a strip.
@vertex
fn vertex(
    @builtin(vertex_index) index: u32,
    @location(0) at: vec3<f32>,
    @location(1) radius: f32,
    @location(2) way: vec3<f32>,
    @location(3) colour: vec4<f32>,
) -> Corner {
    let side = vec2(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let eye = toward_eye(at);
    if dot(way, way) > 0.0 {
        // A triangle: wide at its spot, pointed at its end.
        let far = f32(index >> 1u);
        let aside = cross(way, eye);
        let out = aside / max(length(aside), 1e-9) * side.x * (1.0 - far) * max(LINE * frame.foot.w, 0.3 * radius);
        return Corner(frame.clip_from_world * vec4(at + way * far + out, 1.0), vec2(0.0), colour);
    }
    let up = select(vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0), abs(eye.y) > 0.99);
    let right = normalize(cross(up, eye));
    let above = cross(eye, right);
    let out = (right * side.x + above * side.y) * max(radius, LEAST * frame.foot.w);
    return Corner(frame.clip_from_world * vec4(at + out, 1.0), side, colour);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    if dot(corner.across, corner.across) > 1.0 { discard; }
    let share = select(1.0, FAINT, HIDDEN);
    return vec4(pow(corner.colour.rgb, vec3(2.2)), share * corner.colour.a);
}
