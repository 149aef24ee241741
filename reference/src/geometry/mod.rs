//! Lines and what they meet, without optics.

pub(crate) mod analytic_body;
pub(crate) mod bvh;
pub(crate) mod chord;
pub(crate) mod edge;
pub(crate) mod line;
pub(crate) mod shading_normals;
pub(crate) mod soup;
pub(crate) mod triangle;
