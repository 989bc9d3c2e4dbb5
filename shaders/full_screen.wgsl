// The corners, in clip space, of one triangle that covers everything.

fn full_screen(index: u32) -> vec2<f32> {
    return vec2(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
}
