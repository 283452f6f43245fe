//! The zoo's nodes: each as small as it can be, together every kind of field in every form.

pub mod control;
pub mod hearing;
pub mod interfaces;
pub mod lights;
pub mod reflexes;
pub mod shared;
pub mod types;
pub mod vision;
