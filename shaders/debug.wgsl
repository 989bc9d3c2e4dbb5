// Parts in colours that say what they are, lit from the eye; with LINES the edges of their triangles.

override LINES: bool = false;

// How far edges are lifted off their faces toward the eye, as a share of the picture's foot.
const LIFT: f32 = 0.0007;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tint: vec4<f32>,
};

@vertex
fn vertex(
    @location(0) point: vec3<f32>,
    @location(1) standing_normal: vec3<f32>,
    @location(3) tint: vec4<f32>,
    copy: Placement,
) -> Corner {
    let world = placed(point, copy);
    let normal = turned(standing_normal, copy);
    let lift = select(0.0, LIFT * frame.foot.w, LINES);
    let seen = world + toward_eye(world) * lift;
    return Corner(frame.clip_from_world * vec4(seen, 1.0), world, normal, tint);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    let colour = pow(corner.tint.rgb, vec3(2.2));
    if LINES { return vec4(colour * 0.12, 1.0); }
    let facing = abs(dot(normalize(corner.normal), toward_eye(corner.world)));
    return vec4(colour * (0.35 + 0.65 * facing), 1.0);
}
