// The sheet that is drawn on, and what surrounds it.

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(full_screen(index), 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    if sheet.size.x <= 0.0 { return blended(sheet.paper.rgb, 1.0); }
    let at = canvas_from_pixel(pixel.xy);
    let middle = sheet.size.xy / 2.0;
    let outside = (abs(at - middle) - middle) * sheet.pixel_origin.z;
    let inside = clamp(0.5 - max(outside.x, outside.y), 0.0, 1.0);
    return blended(mix(sheet.surround.rgb, sheet.paper.rgb, inside), 1.0);
}
