// The paper's n_b points outwards, away from the eye.

const BACK_SIGN: f32 = 1.0;
