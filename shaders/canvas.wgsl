// The canvas as every pass over it knows it. Mirrors `SheetUniform` in src/render/canvas/mod.rs.
//
// Colours arrive encoded (sRGB) and are blended as they are on a surface without sRGB; on one with it they are decoded.

struct Sheet {
    // clip = pixel · xy + zw.
    clip_from_pixel: vec4<f32>,
    // Where the canvas's axes point to in framebuffer pixels.
    pixel_axes: vec4<f32>,
    // xy: the canvas's origin in pixels; z: pixels per canvas unit; w: 1 when colours are to be decoded.
    pixel_origin: vec4<f32>,
    canvas_axes: vec4<f32>,
    canvas_origin: vec4<f32>,
    paper: vec4<f32>,
    surround: vec4<f32>,
    // xy: width and height of the sheet in canvas units, zero for a sheet without end; z: factor on the width of lines.
    size: vec4<f32>,
};

@group(0) @binding(0) var<uniform> sheet: Sheet;

fn pixel_from_canvas(at: vec2<f32>) -> vec2<f32> {
    return sheet.pixel_axes.xy * at.x + sheet.pixel_axes.zw * at.y + sheet.pixel_origin.xy;
}

fn canvas_from_pixel(at: vec2<f32>) -> vec2<f32> {
    return sheet.canvas_axes.xy * at.x + sheet.canvas_axes.zw * at.y + sheet.canvas_origin.xy;
}

fn clip_from_pixel(at: vec2<f32>) -> vec4<f32> {
    return vec4(at * sheet.clip_from_pixel.xy + sheet.clip_from_pixel.zw, 0.0, 1.0);
}

fn linear_from_encoded(colour: vec3<f32>) -> vec3<f32> {
    let bright = pow((colour + 0.055) / 1.055, vec3(2.4));
    return select(bright, colour / 12.92, colour <= vec3(0.04045));
}

fn encoded_from_linear(colour: vec3<f32>) -> vec3<f32> {
    let bright = 1.055 * pow(colour, vec3(1.0 / 2.4)) - 0.055;
    return select(bright, 12.92 * colour, colour <= vec3(0.0031308));
}

// An encoded colour as the surface blends it: multiplied by its opacity.
fn blended(colour: vec3<f32>, opacity: f32) -> vec4<f32> {
    let shown = select(colour, linear_from_encoded(colour), sheet.pixel_origin.w > 0.5);
    return vec4(shown * opacity, opacity);
}
