// Total reflection is followed, up to four times.

const REFLECT_TOTAL: bool = true;
const MAX_TOTAL_REFLECTIONS: u32 = 4u;
