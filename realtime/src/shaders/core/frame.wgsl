// Spaces and the camera. Suffixes: _ws directions in world axes; _lc positions
// in local space: world axes, metres, from where the bodies are nearest to the eye;
// _px continuous pixels from the top left. Depth is linear, along the viewing
// axis, positive in front of the eye.

struct Frame {
    clip_from_lc: mat4x4f,
    eye_lc: vec3f,
    right_ws: vec3f,
    up_ws: vec3f,
    forward_ws: vec3f,
    half_extent: vec2f,         // tangents of the half angles, or metres
    resolution_px: vec2f,
    shift_px: vec2f,            // from a pixel's centre to the position in it that is drawn
    eta_outside: f32,
    radius_m: f32,              // of a ball around all bodies
    layer_capacity: u32,        // interfaces per pixel that are kept
    middle_lc: vec3f,           // of the bodies
    ball_lc: vec3f,             // centre of the ball around all bodies
    waist_lc: vec3f,            // on the viewing axis, nearest to the local origin
    waist_depth_m: f32,         // its depth
    unit_m: f32,                // of fixed places: a power of two, 2^-29 to 2^-30 of the reach
    waist_fixed: vec3i,         // of the upper left corner, in units
    across_fixed: vec3i,        // half a pixel to the right at the waist, whole units
    across_rest: vec3f,         // and parts of a unit
    down_fixed: vec3i,          // half a pixel down
    down_rest: vec3f,
}

struct Body {
    eta: f32,
    solid: u32,                 // same number: same medium and priority; falling priority
    absorption_per_m: vec3f,
    eta_channels: vec3f,        // of red, green and blue light
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> bodies: array<Body, 16>;

const FLAG_TIR_CLAMPED: u32 = 1u;
const FLAG_FALLBACK: u32 = 2u;
const FLAG_CAP: u32 = 4u;
const FLAG_LOST: u32 = 8u;
const FLAG_OVERFLOW: u32 = 16u;
const FLAG_NON_FINITE: u32 = 32u;
const FLAG_GEOMETRIC_NORMAL: u32 = 64u;
const FLAG_UNSUPPORTED: u32 = 128u;

// Position on the image plane: x to the right, y up.
fn on_image_plane(position_px: vec2f) -> vec2f {
    let at_px = position_px + frame.shift_px;
    let ndc = vec2f(2.0, -2.0) * at_px / frame.resolution_px + vec2f(-1.0, 1.0);
    return ndc * frame.half_extent;
}

fn depth_of_m(p_lc: vec3f) -> f32 {
    return dot(p_lc - frame.eye_lc, frame.forward_ws);
}

fn pixel_centre_px(pixel: vec2i) -> vec2f {
    return vec2f(pixel) + 0.5;
}

fn in_image(pixel: vec2i) -> bool {
    return all(pixel >= vec2i(0)) && all(vec2f(pixel) < frame.resolution_px);
}
