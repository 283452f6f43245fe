//! Finds spots in images.

pub mod exposure;
pub mod eye;
pub mod horizon_finder;
pub mod other_eye;
pub mod spot_finder;
