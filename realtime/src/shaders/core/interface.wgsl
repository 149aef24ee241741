// Light at a smooth boundary. The same names as the exact renderer's interface.
// d: unit direction of travel. n: unit normal on the side the light comes from,
// so dot(d, n) < 0. eta_i, eta_t: absolute indices of that side and the other.

struct Bend {
    direction: vec3f,           // unit
    total: bool,                // total reflection: direction is the tangent
}

// Our own: the builtin refract() answers zero on total reflection.
// cos² t = (1 - r²) + r² cos² i keeps its digits where indices are nearly equal
// and where light grazes; 1 - r² sin² i loses them in 32 bits.
fn bend(d: vec3f, n: vec3f, eta_i_over_t: f32) -> Bend {
    let r = eta_i_over_t;
    let cos_i = -dot(d, n);
    let cos_t_2 = (1.0 - r) * (1.0 + r) + r * r * cos_i * cos_i;
    let t = r * d + (r * cos_i - sqrt(max(cos_t_2, 0.0))) * n;
    return Bend(normalize(t), cos_t_2 < 0.0);
}

// Share of unpolarised light that is reflected.
// Born & Wolf, Principles of Optics, 7th ed., 1.5.2.
fn fresnel_exact(d: vec3f, n: vec3f, eta_i: f32, eta_t: f32) -> f32 {
    let cos_i = clamp(-dot(d, n), 0.0, 1.0);
    let sin_t = eta_i / eta_t * length(cross(n, d));
    if (sin_t >= 1.0) {
        return 1.0;
    }
    let cos_t = sqrt((1.0 - sin_t) * (1.0 + sin_t));
    let r_s = (eta_i * cos_i - eta_t * cos_t) / (eta_i * cos_i + eta_t * cos_t);
    let r_p = (eta_t * cos_i - eta_i * cos_t) / (eta_t * cos_i + eta_i * cos_t);
    return 0.5 * (r_s * r_s + r_p * r_p);
}

// Schlick, "An inexpensive BRDF model for physically-based rendering", 1994.
fn fresnel_schlick(d: vec3f, n: vec3f, eta_i: f32, eta_t: f32) -> f32 {
    let root = (eta_i - eta_t) / (eta_i + eta_t);
    let r_0 = root * root;
    let away = 1.0 - clamp(-dot(d, n), 0.0, 1.0);
    return r_0 + (1.0 - r_0) * away * away * away * away * away;
}

// Seipel & Nivfors, eq. 4: zero at normal incidence whatever the index.
fn fresnel_cubed(d: vec3f, n: vec3f) -> f32 {
    let away = 1.0 - clamp(abs(dot(d, n)), 0.0, 1.0);
    return away * away * away;
}
