//! What the cameras see: the nodes of cycler `Vision`, one instance for each camera.
//!
//! In the order of a cycle: [`image_receiver`], [`camera_matrix_extractor`], [`image_segmenter`],
//! [`ball_detection`]. Beside them the data that they share: [`field_color`], [`segments`].

pub mod field_color;
pub mod segments;

pub mod ball_detection;
pub mod camera_matrix_extractor;
pub mod image_receiver;
pub mod image_segmenter;
