// Total reflection leaves along the tangent.

const REFLECT_TOTAL: bool = false;
const MAX_TOTAL_REFLECTIONS: u32 = 4u;
