// needs: varyings noise
// Bump-mapped surfaces: normals tilted against the slope of the exact renderer's
// noise. The twin of bump_none.wgsl.

struct Bump {
    object_from_lc: mat4x4f,
    lc_from_object: mat4x4f,
    amplitude: f32,             // 0: no bumps
    frequency_per_m: f32,
    seed: u32,
}

@group(0) @binding(16) var<uniform> bumps: array<Bump, 16>;

fn surface_normal_ws(v: Varyings) -> vec3f {
    let normal_ws = normalize(v.normal_ws);
    let bump = bumps[u32(v.body + 0.5) - 1u];
    if (bump.amplitude == 0.0) {
        return normal_ws;
    }
    let p = (bump.object_from_lc * vec4f(v.p_lc, 1.0)).xyz;
    let n = normalize((transpose(bump.lc_from_object) * vec4f(normal_ws, 0.0)).xyz);
    let g = fbm_gradient(p * bump.frequency_per_m, bump.seed);
    let tilted = n - bump.amplitude * (g - dot(g, n) * n);
    return normalize((transpose(bump.object_from_lc) * vec4f(tilted, 0.0)).xyz);
}
