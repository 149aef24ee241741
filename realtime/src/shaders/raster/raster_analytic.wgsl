// needs: frame camera varyings vertex_vector intersect
// Draws an analytic body: one triangle over the image, a ray per pixel, exact
// to f32. intersect() of one shape works in object space.

struct Analytic {
    object_from_lc: mat4x4f,
    lc_from_object: mat4x4f,
    size_m: vec4f,              // meaning by shape
    body: f32,
    far_side: u32,              // 1: the surface where the ray leaves
}

@group(0) @binding(10) var<uniform> analytic: Analytic;

struct Met {
    hit: bool,
    t_near: f32,
    t_far: f32,
    n_near: vec3f,              // outward, object space
    n_far: vec3f,
}

@vertex
fn analytic_vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

// The body at a pixel. Where it is not, the pixel is discarded.
fn analytic_surface(at: vec4f) -> Varyings {
    let d_ws = view_direction_ws(at.xy);
    let origin = (analytic.object_from_lc * vec4f(view_origin_lc(at.xy), 1.0)).xyz;
    let along = (analytic.object_from_lc * vec4f(d_ws, 0.0)).xyz;
    let scale = length(along);
    let met = intersect(origin, along / scale);
    let far_side = analytic.far_side == 1u;
    let t = select(met.t_near, met.t_far, far_side);
    // A half-space has no far side: its t is 1e30.
    if (!met.hit || t < 0.0 || t >= 1e30) {
        discard;
    }
    let p_object = origin + t * along / scale;
    let p_lc = (analytic.lc_from_object * vec4f(p_object, 1.0)).xyz;
    let n_object = select(met.n_near, met.n_far, far_side);
    // Normals transform by the inverse transpose.
    let normal_ws = normalize((transpose(analytic.object_from_lc) * vec4f(n_object, 0.0)).xyz);
    let thickness_m = inward_m(p_object, n_object) / scale;
    let vector_ws = vertex_vector(d_ws, normal_ws, u32(analytic.body + 0.5) - 1u);
    return Varyings(at, p_lc, normal_ws, normal_ws, analytic.body, thickness_m, vector_ws);
}

// What a depth test compares, as for triangles: more where it is nearer, and more
// than nothing however far.
fn depth_of_clip(v: Varyings) -> f32 {
    let clip = frame.clip_from_lc * vec4f(v.p_lc, 1.0);
    return max(clip.z / clip.w, 0x1p-120f);
}
