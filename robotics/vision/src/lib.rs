//! What the cameras see: the nodes of cycler `Vision`, one instance for each camera.
//!
//! In the order of a cycle: [`image_receiver`], [`camera_matrix_extractor`], [`limb_projector`],
//! [`field_color_detection`], [`image_segmenter`], [`field_border`], [`line_detection`], [`center_circle_detection`],
//! [`corner_detection`], [`penalty_mark_detection`], [`ball_detection`], [`obstacle_detection`]. Beside them the data that they share:
//! [`field_color`], [`segments`].

pub mod field_color;
pub mod segments;

mod landmarks;
mod nearest_pixel;
mod sampler;

pub mod ball_detection;
pub mod camera_matrix_extractor;
pub mod center_circle_detection;
pub mod corner_detection;
pub mod field_border;
pub mod field_color_detection;
pub mod image_receiver;
pub mod image_segmenter;
pub mod limb_projector;
pub mod line_detection;
pub mod obstacle_detection;
pub mod penalty_mark_detection;

#[cfg(test)]
mod painting;
