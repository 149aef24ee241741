// needs: varyings camera clip noise interior parameters
// A crack: a sheet with a rough normal that glitters in the light (Blinn's
// specular term), whichever side it shows. Premultiplied; sheets add up.

fn crack_light(v: Varyings) -> vec4f {
    if (!is_inside(v)) {
        discard;
    }
    let towards_eye_ws = -direction_to_ws(v.p_lc);
    let outward_ws = normalize(v.normal_ws);
    let facing_ws = select(-outward_ws, outward_ws, dot(outward_ws, towards_eye_ws) > 0.0);
    let slope = fbm_gradient(v.p_lc * (20.0 / interior.size_m), 7u);
    let rough_ws = normalize(facing_ws - 0.35 * (slope - dot(slope, facing_ws) * facing_ws));
    let half_ws = normalize(interior.towards_light_ws + towards_eye_ws);
    let shine = pow(max(dot(rough_ws, half_ws), 0.0), CRACK_SHININESS) * CRACK_STRENGTH;
    return vec4f(vec3f(shine), shine);
}

struct Targets {
    @location(0) cracks: vec4f,
    @location(1) crack_mask: f32,
}

fn targets(v: Varyings) -> Targets {
    return Targets(crack_light(v), 1.0);
}
