// The opposite reading of n_b in eq. 1.

const BACK_SIGN: f32 = -1.0;
