//! How far to believe a number: standard errors, intervals, p-values, and what
//! becomes of them when many questions are asked at once.
//!
//! Everything here is about numbers, not about images. The errors of images
//! that rest on it are in `metric::stack` (bias-corrected squared error,
//! jackknife over batches) and `gate::difference` (paired differences).

mod estimate;
mod family;
mod median;
mod student;

pub use estimate::{Estimate, jackknife, mean_of_samples};
pub use family::{Correction, adjusted};
pub use median::{FEWEST, Interval, median_interval, ratio_interval};
pub use student::{student_quantile, student_tail};
